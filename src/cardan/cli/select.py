"""``cardan select``: which types and sizes of joints do a job, under which conditions, and why not the others?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .asked import TorqueNm
from .options import AsCsv, AsJson, MoreRows, SpeedRpm

if TYPE_CHECKING:
    from cardan.catalogue import Catalogue
    from cardan.choices.selection import Candidate, Need
    from cardan.choices.selection_reasons import SizeFit

    from .answer import Answer, Cell, Remark, Table, Tone


def select(
    file: Annotated[
        Path | None,
        typer.Argument(
            metavar="[FILE]",
            help=_("Drive file whose joints are to be chosen; - reads standard input. Options count before it."),
            show_default=False,
        ),
    ] = None,
    joint: Annotated[
        int | None,
        typer.Option(
            "--joint",
            metavar="NUMBER",
            help=_("Only this joint of the file; all of them by default."),
            show_default=False,
        ),
    ] = None,
    torque: TorqueNm = None,
    bend_deg: Annotated[
        float | None, typer.Option("--bend-deg", metavar="DEG", help=_("Bend of the joint."), show_default=False)
    ] = None,
    speed_rpm: SpeedRpm = None,
    factor: Annotated[
        float | None,
        typer.Option("--service-factor", metavar="FACTOR", help=_("Factor on the torque."), show_default=False),
    ] = None,
    outer_mm: Annotated[
        float | None,
        typer.Option(
            "--outer-mm", metavar="MM", help=_("Outer diameter, for the speed of the rim."), show_default=False
        ),
    ] = None,
    synchronous: Annotated[
        bool | None,
        typer.Option("--synchronous/--uneven", help=_("Whether the output must turn evenly."), show_default=False),
    ] = None,
    continuous: Annotated[
        bool | None,
        typer.Option("--continuous/--short", help=_("Whether it runs for long at a time."), show_default=False),
    ] = None,
    modern: Annotated[
        bool,
        typer.Option(
            "--modern", help=_("Count modern types too, whose limits are typical values."), show_default=False
        ),
    ] = False,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Tell which types and sizes of joints do a job: accepted, under conditions, or rejected, and why."""
    from .asked import check_options, keys_of
    from .show import show

    check_options(speed_rpm, torque, json=json, csv=csv)

    from cardan.catalogue import catalogue, with_files
    from cardan.choices.selection import select_joint
    from cardan.choices.selection_reasons import fitting_sizes
    from cardan.errors import InputError

    files = tuple(more or ())
    changes = _changes(bend_deg, factor, outer_mm, synchronous, continuous)
    if file is None:
        known = with_files(catalogue(), files) if files else catalogue()
        need = _need(torque, speed_rpm, changes)
        name = ""
    else:
        from cardan.io.drive_file import known_to

        from .source import STDIN, read, title

        drive = read(file, files)
        known = known_to(drive, "." if file == STDIN else file.parent, files)
        name = title(drive, file)
        with keys_of(file):
            need = _of_drive(drive, joint, torque, speed_rpm, changes, known)
    try:
        found = select_joint(need, known=known, include_beyond=modern)
    except InputError as error:
        raise error.renamed(_option) from error
    sizes = fitting_sizes(need, known=known)
    return show(_answer(name, need, found, sizes), json=json, csv=csv)


OPTIONS = {
    "torque": "--torque-Nm",
    "bend": "--bend-deg",
    "speed": "--speed-rpm",
    "service_factor": "--service-factor",
    "outer": "--outer-mm",
    "joint": "--joint",
}


def _option(field: str) -> str:
    return OPTIONS.get(field, field)


def _changes(
    bend: float | None, factor: float | None, outer: float | None, even: bool | None, long: bool | None
) -> dict[str, Any]:
    """Return what the options say beside torque and speed, in SI."""
    from math import isfinite

    from cardan.errors import Problem, check
    from cardan.units import deg, mm

    given = (("--bend-deg", bend), ("--service-factor", factor), ("--outer-mm", outer))
    text = _("{value} is not a finite number")
    check(Problem(name, text.format(value=one)) for name, one in given if one is not None and not isfinite(one))
    said = {
        "bend": None if bend is None else bend * deg,
        "service_factor": factor,
        "outer": None if outer is None else outer * mm,
        "synchronous": even,
        "continuous": long,
    }
    return {name: value for name, value in said.items() if value is not None}


def _need(torque: float | None, speed_rpm: float | None, changes: dict[str, Any]) -> Need:
    """Return a need from options alone."""
    from cardan.choices.selection import Need
    from cardan.errors import InputError, Problem, check
    from cardan.units import rpm

    given = {"--torque-Nm": torque, "--bend-deg": changes.get("bend"), "--speed-rpm": speed_rpm}
    check(
        Problem(name, _("missing; give it, or a drive file"), "missing") for name, one in given.items() if one is None
    )
    try:
        return Need(torque=torque or 0.0, speed=(speed_rpm or 0.0) * rpm, **changes)
    except InputError as error:
        raise error.renamed(_option) from error


def _of_drive(
    drive: Any,
    joint: int | None,
    torque: float | None,
    speed_rpm: float | None,
    changes: dict[str, Any],
    known: Catalogue,
) -> Need:
    """Return the need of a drive, what the options say in place of it."""
    from dataclasses import replace

    from cardan.choices.selection_reasons import need_of
    from cardan.errors import InputError

    from .asked import on_duty

    try:
        return replace(need_of(on_duty(drive, speed_rpm, torque), joint=joint, known=known), **changes)
    except InputError as error:
        raise error.renamed(_option) from error


def _answer(name: str, need: Need, found: Sequence[Candidate], sizes: Sequence[SizeFit]) -> Answer:
    from .answer import Answer

    accepted = [one for one in found if one.state == "ok"]
    conditional = [one for one in found if one.state == "conditional"]
    return Answer(
        sentence=_sentence(name, need, accepted, conditional),
        tone="good" if accepted else "warning" if conditional else "failed",
        tables=lambda: list(_tables(need, found, sizes)),
        remarks=tuple(_remarks(need, sizes)),
        content=lambda: _content(need, found, sizes),
        csv=lambda: _rows(need, found),
        code=0 if accepted or conditional else 1,
    )


def _sentence(name: str, need: Need, accepted: Sequence[Candidate], conditional: Sequence[Candidate]) -> str:
    from .answer import significant

    count = plural("one type does it", "{count} types do it", len(accepted))
    if not accepted:
        count = _("no type does it without conditions")
    more = plural("one more under conditions", "{count} more under conditions", len(conditional))
    if not conditional:
        more = _("none under conditions")
    text = _("{duty}: {accepted}, {more}.")
    duty = _("{torque} N·m at {bend}° and {speed} rpm").format(
        torque=significant(need.torque * need.service_factor),
        bend=significant(need.bend * 57.29577951308232, 3),
        speed=significant(need.speed * 9.549296585513721),
    )
    if name:
        duty = f"{name}, {duty}"
    return text.format(duty=duty, accepted=count.format(count=len(accepted)), more=more.format(count=len(conditional)))


WORDS = {"ok": _("● accepted"), "conditional": _("▲ with conditions"), "rejected": _("✖ rejected")}

TONES: dict[str, Tone] = {"ok": "good", "conditional": "warning", "rejected": "failed"}


def _tables(need: Need, found: Sequence[Candidate], sizes: Sequence[SizeFit]) -> Iterator[Table]:
    from cardan.choices.selection_reasons import reasons

    from .answer import Column, Table

    rows: list[list[Cell]] = [
        [
            WORDS[one.state],
            one.row.id,
            one.headroom,
            "; ".join(reason.message for reason in reasons(one, need)) or one.row.name,
        ]
        for one in found
    ]
    columns = (
        Column(key="state", heading=_("verdict"), left=True),
        Column(key="type", heading=_("type"), left=True),
        Column(key="headroom", heading=_("torque"), unit=_("room"), form="3"),
        Column(key="why", heading=_("why"), left=True, wrap=True),
    )
    yield Table(columns=columns, rows=rows, tones=[TONES[one.state] for one in found], fixed=2)
    if sizes:
        yield _sizes(sizes)


def _sizes(sizes: Sequence[SizeFit]) -> Table:
    from .answer import Column, Table

    rows: list[list[Cell]] = [
        [
            _("● fits") if one.fits else _("✖ no"),
            one.row.id,
            None if one.row.rating is None or one.row.rating.outer is None else 1e3 * one.row.rating.outer,
            one.row.mass,
            one.headroom,
            "; ".join(reason.message for reason in one.reasons) or one.row.source,
        ]
        for one in sizes
    ]
    columns = (
        Column(key="state", heading=_("size"), left=True),
        Column(key="size", left=True),
        Column(key="outer_mm", heading=_("outer"), unit="mm"),
        Column(key="mass_kg", heading=_("mass"), unit="kg", form="3"),
        Column(key="headroom", heading=_("torque"), unit=_("room"), form="3"),
        Column(key="why", heading=_("why"), left=True, wrap=True),
    )
    title = _("Sizes of the catalogue by their makers' ratings")
    return Table(
        columns=columns, rows=rows, title=title, tones=["good" if one.fits else "failed" for one in sizes], fixed=2
    )


def _remarks(need: Need, sizes: Sequence[SizeFit]) -> Iterator[Remark]:
    from .answer import Remark

    yield Remark(text=_("A key that the source of a type does not give is a condition: look it up at the maker's."))
    if any(one.fits and one.row.confidence == "made_up" for one in sizes):
        text = _("The shipped sizes are made up for examples; a maker's own rows come with --catalogue FILE.")
        yield Remark(text=text, tone="warning")
    yield Remark(
        text=_("Where every figure comes from:"), command=("cardan", "catalogue", "joint_types", "TYPE"), tone="next"
    )


def _rows(need: Need, found: Sequence[Candidate]) -> Table:
    from cardan.choices.selection_reasons import reasons

    from .answer import Column, Table

    keys = ("type", "state", "codes", "why", "headroom", "confidence", "source")
    rows: list[list[Cell]] = [
        [
            one.row.id,
            one.state,
            " ".join((*one.causes, *one.flags)),
            "; ".join(reason.message for reason in reasons(one, need)),
            one.headroom,
            one.row.confidence,
            one.row.source,
        ]
        for one in found
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(need: Need, found: Sequence[Candidate], sizes: Sequence[SizeFit]) -> dict[str, Any]:
    from dataclasses import asdict

    from cardan.choices.selection_reasons import reasons
    from cardan.units import deg, mm, rpm

    return {
        "question": "select",
        "need": {
            "torque_Nm": need.torque,
            "bend_deg": need.bend / deg,
            "speed_rpm": need.speed / rpm,
            "service_factor": need.service_factor,
            "synchronous": need.synchronous,
            "continuous": need.continuous,
            "outer_mm": None if need.outer is None else need.outer / mm,
        },
        "types": [
            {
                "type": one.row.id,
                "name": one.row.name,
                "state": one.state,
                "headroom": one.headroom,
                "reasons": [asdict(reason) for reason in reasons(one, need)],
                "confidence": one.row.confidence,
                "source": one.row.source,
            }
            for one in found
        ],
        "sizes": [
            {
                "size": one.row.id,
                "fits": one.fits,
                "headroom": one.headroom,
                "reasons": [asdict(reason) for reason in one.reasons],
                "confidence": one.row.confidence,
                "source": one.row.source,
            }
            for one in sizes
        ],
    }
