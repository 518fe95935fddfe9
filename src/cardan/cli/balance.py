"""``cardan balance``: what unbalance may each shaft have, and what cancels what it has?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, MoreRows, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.bending.shaft_balance import Balance

    from .answer import Answer, Cell, Remark, Table, Tone


def balance(
    file: DriveFile,
    grade: Annotated[
        str | None,
        typer.Option(
            "--grade",
            metavar="GRADE",
            help=_("Balance grade, as G16 or G40, instead of the one in the file."),
            show_default=False,
        ),
    ] = None,
    speed_rpm: SpeedRpm = None,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Tell what unbalance each shaft may have, the force of it, and the masses that cancel what was measured."""
    from .asked import check_options, keys_of, on_duty
    from .show import show

    check_options(speed_rpm, json=json, csv=csv)

    from cardan.errors import InputError
    from cardan.io.drive_file import known_to
    from cardan.questions.bending.shaft_balance import balance as question

    from .source import STDIN, read

    files = tuple(more or ())
    drive = on_duty(read(file, files), speed_rpm, None)
    known = known_to(drive, "." if file == STDIN else file.parent, files)
    with keys_of(file):
        try:
            found = question(drive, grade=grade, known=known)
        except InputError as error:
            raise error.renamed(lambda field: "--grade" if field == "grade" else field) from error
    return show(_answer(drive, file, found), json=json, csv=csv)


def _answer(drive: Drive, file: Path, found: Balance) -> Answer:
    from .answer import Answer

    tone: Tone = "plain" if found.balanced is None else "good" if found.balanced else "failed"
    return Answer(
        sentence=_sentence(drive, file, found),
        tone=tone,
        tables=lambda: list(_tables(drive, found)),
        remarks=tuple(_remarks(found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _table(drive, found),
        code=1 if found.balanced is False else 0,
    )


def _sentence(drive: Drive, file: Path, found: Balance) -> str:
    from math import isnan

    from cardan.units import rpm

    from .answer import significant
    from .source import title

    name, speed = title(drive, file), significant(found.speed / rpm)
    limits = [one for one in found.shafts if not isnan(one.limit)]
    if found.balanced is not None:
        bad = [str(one.number) for one in found.shafts if one.balanced is False]
        if bad:
            return _("{name}: too much unbalance on shaft {which} at {speed} rpm.").format(
                name=name, which=", ".join(bad), speed=speed
            )
        return _("{name}: balanced well enough for {speed} rpm.").format(name=name, speed=speed)
    if not limits:
        return _("{name}: no limit could be told; masses are missing.").format(name=name)
    least = min(limits, key=lambda one: one.limit)
    return _("{name}: at {speed} rpm shaft {number} may have {limit} g·mm at most.").format(
        name=name, speed=speed, number=least.number, limit=significant(1e6 * least.limit, 3)
    )


def _table(drive: Drive, found: Balance) -> Table:
    from .answer import Column, Table, named

    names = {shaft.number: shaft.name for shaft in drive.shafts}
    states = {True: _("● balanced"), False: _("✖ too much"), None: ""}
    rows: list[list[Cell]] = [
        [
            named(one.number, names.get(one.number, "")),
            one.mass,
            1e6 * one.allowed,
            1e6 * one.allowed_plane,
            1e6 * one.norm,
            1e6 * one.unbalance,
            one.force,
            states[one.balanced],
        ]
        for one in found.shafts
    ]
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="mass_kg", heading=_("mass"), unit="kg"),
        Column(key="allowed_g_mm", heading=_("allowed"), unit="g·mm"),
        Column(key="plane_g_mm", heading=_("a plane"), unit="g·mm"),
        Column(key="norm_g_mm", heading=_("book"), unit="g·mm"),
        Column(key="unbalance_g_mm", heading=_("measured"), unit="g·mm"),
        Column(key="force_N", heading=_("turning"), unit="N"),
        Column(key="state", left=True),
    )
    return Table(columns=columns, rows=rows)


def _tables(drive: Drive, found: Balance) -> Iterator[Table]:
    from .answer import Column, Table

    yield _table(drive, found)
    rows = list(_corrections(found))
    if rows:
        columns = (
            Column(key="shaft", heading=_("shaft"), left=True),
            Column(key="position_mm", heading=_("place"), unit="mm"),
            Column(key="angle_deg", heading=_("angle"), unit="°", form=".1f"),
            Column(key="unbalance_g_mm", heading=_("unbalance"), unit="g·mm"),
            Column(key="mass_g", heading=_("mass"), unit="g", form="3"),
            Column(key="force_N", heading=_("on the joint"), unit="N"),
        )
        yield Table(columns=columns, rows=rows, title=_("Masses at the ends of the tubes that cancel it"))


def _corrections(found: Balance) -> Iterator[list[Cell]]:
    from math import degrees

    for one in found.shafts:
        for fix, force in zip(one.corrections, one.joint_forces, strict=True):
            yield [
                str(one.number),
                1e3 * fix.position,
                degrees(fix.angle),
                1e6 * fix.unbalance,
                1e3 * fix.mass,
                force,
            ]


def _remarks(found: Balance) -> Iterator[Remark]:
    from .answer import Remark
    from .asked import key_of

    if found.grade is not None:
        text = _("Grade {grade}: {source}.")
        yield Remark(text=text.format(grade=found.grade.id, source=found.grade.source))
    if found.assumed:
        text = _("Neither grade nor vehicle is given; {grade} is usual for these shafts.")
        yield Remark(text=text.format(grade=found.grade.id if found.grade else ""))
    if found.norm is not None:
        yield Remark(
            text=_("The book's norm: {note}; {source}.").format(
                note=found.norm.note or found.norm.id, source=found.norm.source
            )
        )
    if not found.needed:
        yield Remark(text=_("Below 500 rpm makers do not balance."))
    missing = [path for one in found.shafts for path in one.missing]
    if missing:
        text = _("Warning: some limits could not be told; the file lacks {keys}, or a body.")
        yield Remark(text=text.format(keys=", ".join(map(key_of, missing))), tone="warning")
    if not any(one.corrections for one in found.shafts):
        yield Remark(text=_("Measured unbalances go into the file as shafts[…].unbalance: place, amount and angle."))
    yield Remark(text=_("Unbalance from clearances cannot be balanced out. Mark parts before they come apart."))


def _content(drive: Drive, file: Path, found: Balance) -> dict[str, Any]:
    from math import degrees

    from cardan.units import rpm

    return {
        "question": "balance",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": found.speed / rpm,
        "grade": None if found.grade is None else found.grade.id,
        "grade_assumed": found.assumed,
        "norm": None if found.norm is None else found.norm.id,
        "balanced": found.balanced,
        "shafts": [
            {
                "number": one.number,
                "mass_kg": one.mass,
                "allowed_g_mm": 1e6 * one.allowed,
                "allowed_plane_g_mm": 1e6 * one.allowed_plane,
                "eccentricity_mm": 1e3 * one.eccentricity,
                "norm_g_mm": 1e6 * one.norm,
                "unbalance_g_mm": 1e6 * one.unbalance,
                "force_N": one.force,
                "joint_forces_N": one.joint_forces,
                "balanced": one.balanced,
                "corrections": [
                    {
                        "position_mm": 1e3 * fix.position,
                        "unbalance_g_mm": 1e6 * fix.unbalance,
                        "angle_deg": degrees(fix.angle),
                        "mass_g": 1e3 * fix.mass,
                    }
                    for fix in one.corrections
                ],
                "missing": one.missing,
            }
            for one in found.shafts
        ],
    }
