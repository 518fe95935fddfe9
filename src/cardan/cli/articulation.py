"""``cardan articulation``: how does the drive turn and slide while it moves?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.motion.articulation import Articulation, Worst

    from .answer import Answer, Remark, Table

MOST_INSTANTS = 1_000_000
"""More instants than this are refused."""


def articulation(
    file: DriveFile,
    until: Annotated[
        float | None,
        typer.Option(
            "--until-s",
            "--until",
            metavar="S",
            help=_("Time span from 0, instead of a whole period."),
            show_default=False,
        ),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option(
            "--step-s",
            "--step",
            metavar="S",
            help=_("Step of --until-s; fine enough to follow the movement by default."),
            show_default=False,
        ),
    ] = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how the drive turns and slides while it moves."""
    from .output import check_speed
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_times(until, step)
    check_speed(speed_rpm)

    from cardan.questions.motion.articulation import articulation as question
    from cardan.units import rpm

    from .source import read

    drive = read(file)
    speed = None if speed_rpm is None else speed_rpm * rpm
    times = instants(until, step)
    found = question(drive, times=times, until=until if times is None else None, speed=speed)
    return show(_answer(drive, file, found), json=json, csv=csv, plot=plot)


def check_times(until: float | None, step: float | None) -> None:
    """Refuse a time span or step that makes no series of instants."""
    from math import isfinite

    from cardan.errors import Problem, check

    problems = [
        Problem(option, _("{value} is not allowed; allowed is a finite time above 0").format(value=value))
        for option, value in (("--until-s", until), ("--step-s", step))
        if value is not None and not (isfinite(value) and value > 0.0)
    ]
    if step is not None and until is None:
        problems.append(Problem("--step-s", _("belongs to --until-s; how long shall it last?")))
    if not problems and step is not None and until is not None and until / step > MOST_INSTANTS:
        text = _("{count:.3g} instants asked for; the limit is {limit}")
        problems.append(Problem("--step-s", text.format(count=until / step, limit=MOST_INSTANTS)))
    check(problems)


def instants(until: float | None, step: float | None) -> Any:
    """Return the instants asked for [s], or None for those that fit the movement."""
    if until is None or step is None:
        return None
    import numpy as np

    return step * np.arange(int(until / step + 1e-9) + 1)


def _answer(drive: Drive, file: Path, found: Articulation) -> Answer:
    from .answer import Answer

    failed = any(one.flags for one in found.splines) or not _turns(found)
    return Answer(
        sentence=_sentence(drive, file, found),
        tone="failed" if failed else "plain",
        tables=lambda: [table for table in (_joint_table(drive, found), _shaft_table(drive, found)) if table.rows],
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _history(found),
        figure=lambda: _figures(found),
        code=1 if failed else 0,
    )


def _figures(found: Articulation) -> Any:
    from cardan.figures import for_result

    return for_result(found)


def _turns(found: Articulation) -> bool:
    from cardan.questions.motion.instants import Position

    return bool((found.status < Position.IMPOSSIBLE).all())


def _worst(found: Articulation, what: str) -> Worst | None:
    return next((one for one in found.worst if one.what == what), None)


def _sentence(drive: Drive, file: Path, found: Articulation) -> str:
    from cardan.questions.motion.equivalence import SYNCHRONOUS

    from .answer import percent, significant
    from .source import title

    span = significant(float(found.times[-1] - found.times[0]), 3)
    name = title(drive, file)
    uneven = _worst(found, "irregularity")
    if uneven is None:
        return _("{name}: nothing turns at any instant of {span} s").format(name=name, span=span)
    if uneven.value < SYNCHRONOUS:
        return _("{name}: synchronous in every position it passes in {span} s").format(name=name, span=span)
    text = _("{name}: over {span} s at worst {share} irregular, at {time} s")
    return text.format(name=name, span=span, share=percent(uneven.value), time=significant(uneven.time, 3))


def _joint_table(drive: Drive, found: Articulation) -> Table:
    from cardan.units import deg

    from .answer import Column, Table, named

    low, high = found.envelope["bend"]
    when = {one.number: one.time for one in found.worst if one.what == "bend"}
    rows = [
        (named(k + 1, joint.name), float(low[k]) / deg, float(high[k]) / deg, when.get(k + 1))
        for k, joint in enumerate(drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="bend_min_deg", heading=_("bend"), unit=_("least °"), form=".2f"),
        Column(key="bend_max_deg", unit=_("most °"), form=".2f"),
        Column(key="time_s", unit=_("at s"), form=".3f"),
    )
    return Table(columns=columns, rows=rows)


def _shaft_table(drive: Drive, found: Articulation) -> Table:
    from cardan.units import mm

    from .answer import Column, Table, named

    rows = [
        (
            named(one.shaft, drive.shafts[one.shaft - 1].name),
            one.length_min / mm,
            one.length_max / mm,
            one.stroke / mm,
            one.max_rate / mm,
            None if one.engaged_min is None else one.engaged_min / mm,
            None if one.gap_min is None else one.gap_min / mm,
            _("✖ failed") if one.flags else _("● held") if drive.shafts[one.shaft - 1].spline else _("– no spline"),
        )
        for one in found.splines
    ]
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="length_min_mm", heading=_("length"), unit=_("min mm"), form=".1f"),
        Column(key="length_max_mm", unit=_("max mm"), form=".1f"),
        Column(key="stroke_mm", heading=_("stroke"), unit="mm", form=".1f"),
        Column(key="max_sliding_speed_mm_s", heading=_("sliding"), unit="mm/s", form="4"),
        Column(key="engaged_min_mm", heading=_("engaged"), unit=_("min mm"), form=".1f"),
        Column(key="gap_min_mm", heading=_("gap"), unit=_("min mm"), form=".1f"),
        Column(key="limits", heading=_("limits"), left=True),
    )
    return Table(columns=columns, rows=rows)


def _remarks(drive: Drive, file: Path, found: Articulation) -> Iterator[Remark]:
    from .answer import Remark, percent, significant

    failed = {flag.message for one in found.splines for flag in one.flags}
    for text in found.warnings:
        tone, word = ("failed", _("Failed:")) if text in failed or not _turns(found) else ("warning", _("Warning:"))
        yield Remark(text=f"{word} {text}", tone=tone)  # type: ignore[arg-type]
    moving = _worst(found, "moving_irregularity")
    frozen = _worst(found, "irregularity")
    if moving is not None and frozen is not None:
        text = _("Counting the movement itself, the output's speed swings by {share}, at {time} s.")
        if percent(moving.value) == percent(0.0):
            text = _("Counting the movement itself, the output stays even.")
        yield Remark(text=text.format(share=percent(moving.value), time=significant(moving.time, 3)))
    elif found.speed is None:
        yield Remark(text=_("Irregularity of the drive standing at each instant; --speed-rpm counts the movement too."))
    if len(drive.joints) > 1 and frozen is not None and frozen.value > 1e-6:
        if drive.poses:
            text = _("Find the yoke angles that suit all poses:")
        else:
            text = _("Put the worst positions into the file as [[poses]], then find yoke angles for all of them:")
        yield Remark(text=text, command=("cardan", "phases", str(file)), tone="next")


def _history(found: Articulation) -> Table:
    import numpy as np

    from cardan.units import mm, rpm

    from .answer import Column, Table

    n = found.bend.shape[1]
    named: list[tuple[str, Any]] = [("time_s", found.times), ("status", found.status)]
    named += [(f"joint_{k + 1}_bend_deg", np.rad2deg(found.bend[:, k])) for k in range(n)]
    named += [(f"joint_{k + 2}_plane_twist_deg", np.rad2deg(found.plane_twist[:, k])) for k in range(n - 1)]
    for k in range(1, n):
        named += [
            (f"shaft_{k + 1}_length_mm", found.length[:, k] / mm),
            (f"shaft_{k + 1}_sliding_mm_s", found.length_rate[:, k] / mm),
            (f"shaft_{k + 1}_sliding_acceleration_mm_s2", found.length_acceleration[:, k] / mm),
        ]
    named += [(f"shaft_{k + 2}_irregularity", found.shaft_irregularity[:, k]) for k in range(n)]
    if found.speed_low is not None and found.speed_high is not None:
        named += [("moving_irregularity", found.moving_irregularity)]
        for k in range(1, n + 1):
            named += [
                (f"shaft_{k + 1}_speed_min_rpm", found.speed_low[:, k] / rpm),
                (f"shaft_{k + 1}_speed_max_rpm", found.speed_high[:, k] / rpm),
            ]
    columns = tuple(Column(key=key) for key, _values in named)
    return Table(columns=columns, rows=list(zip(*(values.tolist() for _key, values in named), strict=True)))


def _content(drive: Drive, file: Path, found: Articulation) -> dict[str, Any]:
    from cardan.units import deg, mm, rpm

    from .show import records

    scales = {"bend": ("deg", deg), "length_min": ("mm", mm), "length_max": ("mm", mm)}
    worst = []
    for one in found.worst:
        unit, scale = scales.get(one.what, ("", 1.0))
        worst.append(
            {"what": one.what, "number": one.number, "time_s": one.time, "value": one.value / scale, "unit": unit}
        )
    history = _history(found)
    names = [(one.shaft, drive.shafts[one.shaft - 1].name) for one in found.splines]
    splines = []
    for row, spline in zip(records(_shaft_table(drive, found), names), found.splines, strict=True):
        flags = [
            {
                "field": flag.field,
                "message": flag.message,
                "time_s": flag.time,
                "value_mm": flag.value / mm,
                "limit_mm": flag.limit / mm,
                "spans_s": flag.spans,
            }
            for flag in spline.flags
        ]
        row.pop("limits")
        splines.append({**row, "slip_path_mm": spline.slip_path / mm, "passed": not spline.flags, "flags": flags})
    return {
        "question": "articulation",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": None if found.speed is None else found.speed / rpm,
        "passed": not any(one.flags for one in found.splines) and _turns(found),
        "worst": worst,
        "joints": records(_joint_table(drive, found), [(k, joint.name) for k, joint in enumerate(drive.joints, 1)]),
        "splines": splines,
        "warnings": found.warnings,
        "assumed": found.assumed,
        "history": {column.key: [row[k] for row in history.rows] for k, column in enumerate(history.columns)},
    }
