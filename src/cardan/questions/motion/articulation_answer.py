"""What there is to say of a drive that moves: its worst instants, joint angles, sliding shafts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Tone, heads
from cardan.answers.palette import colour
from cardan.answers.palette import shaft as shaft_role
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.models.wobble import wobbling
from cardan.later import later
from cardan.texts import _, mark
from cardan.units import deg, mm

from .articulation import Articulation, Worst, takes_up
from .articulation import articulation as ask
from .equivalence import SPECK, SYNCHRONOUS
from .instants import Position
from .length import LengthCompensation, plunge_of
from .random_motion import Expected, RandomMotion

drawn = later("cardan.questions.motion.figures")

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

KEYS = {
    "joint_angle": "joint_angle",
    "speed_fluctuation": "speed_fluctuation",
    "moving_speed_fluctuation": "moving_speed_fluctuation",
}
"""What a worst instant is called for programs, where that is not its name in Python."""


CLOSE = 0.9
"""Share of a limit from which it is near."""

COUNTS, LEAST = 1.05, 1e-9
"""The rate of the movement is told by itself where it multiplies the speed fluctuation, and adds to it, by more."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for its movement."""
    return absent((bool(drive.movements), "movements"))


def answer(drive: Drive, result: Articulation) -> Answer:
    """Return what there is to say of a drive that moves."""
    failed = any(one.flags for one in result.splines) or not _turns(result)
    return Answer(
        name="articulation",
        title=_("Articulation"),
        sentence=_sentence(result),
        tone="failed" if failed else "plain",
        figures=lambda: drawn().articulation_figures(result),
        tables=(
            _joints(drive, result),
            *((_shafts(drive, result),) if result.splines else ()),
            _worst_instants(result),
            *(() if result.random is None else random_tables(result.random)),
        ),
        remarks=tuple(_remarks(drive, result)),
        keys=tuple(_keys(drive, result)),
        facts=_facts(drive, result),
        full=lambda: _history(result),
        code=1 if failed else 0,
    )


def _turns(found: Articulation) -> bool:
    return bool((found.status < Position.IMPOSSIBLE).all())


def _worst(found: Articulation, what: str) -> Worst | None:
    return next((one for one in found.worst if one.what == what), None)


def _time(value: float) -> Quantity:
    return Quantity(float(value), "time", 3)


def _sentence(found: Articulation) -> Say:
    span = _time(found.times[-1] - found.times[0])
    worst = _worst(found, "speed_fluctuation")
    if worst is None:
        return say(_("at no instant of {span} the drive can turn."), span=span)
    if worst.value < SYNCHRONOUS:
        return say(_("uniform in every position that it passes in {span}."), span=span)
    return say(
        _("over {span} the speed fluctuation is at most δ = {share}, at {time}."),
        span=span,
        share=Quantity(worst.value, "share"),
        time=_time(worst.time),
    )


def _joints(drive: Drive, found: Articulation) -> Table:
    low, high = found.envelope["joint_angle"]
    worst = {one.number: one for one in found.worst if one.what == "joint_angle"}
    numbers = range(1, len(drive.joints) + 1)
    high = [worst[k].value if k in worst else most for k, most in zip(numbers, high, strict=True)]
    return Table(
        name="joints",
        records=True,
        columns=(
            *heads(_("joint"), [joint.name for joint in drive.joints]),
            Column(key="joint_angle_min", heading=_("least joint angle"), values=low, dimension="angle", decimals=2),
            Column(
                key="joint_angle_max", heading=_("greatest joint angle"), values=high, dimension="angle", decimals=2
            ),
            Column(
                key="time",
                heading=_("at"),
                values=[worst[k].time if k in worst else None for k in numbers],
                dimension="time",
                decimals=3,
            ),
        ),
    )


def _shafts(drive: Drive, found: Articulation) -> Table:
    ones = found.splines
    names = [drive.shafts[one.shaft - 1].name for one in ones]
    short = {
        name: [any(flag.field.endswith(name) for flag in one.flags) for one in ones] for name in ("engaged", "gap")
    }

    def limited(values: list[float | None], name: str) -> list[Cell]:
        return [
            Cell(value=one, tone="failed" if bad else "plain") for one, bad in zip(values, short[name], strict=True)
        ]

    def length(key: str, heading: str, values: Any) -> Column:
        return Column(key=key, heading=heading, values=values, dimension="length", decimals=1)

    note = _("Over the {span} looked at; engaged length and gap are the least.")
    if drive.poses:
        note = f"{note} {_('The movement starts from the drive as drawn; its poses are judged with the limits.')}"
    return Table(
        title=_("Sliding shafts"),
        columns=(
            Column(
                key="shaft",
                heading=_("shaft"),
                values=[
                    Cell(value=f"{one.shaft} {name}".strip(), chip=colour(shaft_role(one.shaft)))
                    for one, name in zip(ones, names, strict=True)
                ],
            ),
            length("length_min", _("shortest"), [one.length_min for one in ones]),
            length("length_max", _("longest"), [one.length_max for one in ones]),
            length("stroke", _("stroke"), [one.stroke for one in ones]),
            Column(
                key="max_sliding_speed",
                heading=_("top speed"),
                values=[one.max_rate for one in ones],
                dimension="speed",
                unit="mm_s",
            ),
            Column(
                key="max_acceleration",
                heading=_("acceleration"),
                values=[one.max_acceleration for one in ones],
                dimension="acceleration",
                digits=3,
                depth="full",
            ),
            Column(
                key="slip_path",
                heading=_("slip path, back and forth"),
                values=[one.slip_path for one in ones],
                dimension="length",
                decimals=1,
                depth="full",
            ),
            length("engaged_min", _("engaged"), limited([one.engaged_min for one in ones], "engaged")),
            length("gap_min", _("gap"), limited([one.gap_min for one in ones], "gap")),
            Column(key="limits", heading=_("limits"), values=[_state(drive, one) for one in ones]),
        ),
        note=say(note, span=_time(np.ptp(found.times))),
    )


def _state(drive: Drive, one: LengthCompensation) -> Cell:
    if one.flags:
        return Cell(value=_("failed"), tone="failed")
    plunge = plunge_of(drive, one.shaft - 1)
    if drive.shafts[one.shaft - 1].spline or (plunge is not None and None not in (plunge.out, plunge.back)):
        return Cell(value=_("passed"), tone="good")
    return Cell(value="" if takes_up(drive, one.shaft) else _("no spline"))


def _worst_instants(found: Articulation) -> Table:
    names = {
        "joint_angle": _("angle of joint {number}"),
        "speed_fluctuation": _("speed fluctuation of the output if it stopped there"),
        "moving_speed_fluctuation": _("speed fluctuation of the output while moving, peak to peak"),
        "speed_error": _("speed error of the output while moving"),
        "acceleration": _("acceleration of the output while moving"),
        "length_max": _("longest shaft {number}"),
        "length_min": _("shortest shaft {number}"),
    }
    return Table(
        title=_("Worst instants"),
        depth="full",
        columns=(
            Column(
                key="what",
                heading=_("what"),
                values=[names.get(one.what, one.what).format(number=one.number) for one in found.worst],
            ),
            Column(key="value", heading=_("value"), values=[_value(one) for one in found.worst]),
            Column(key="time", heading=_("at"), values=[one.time for one in found.worst], dimension="time", digits=3),
        ),
    )


def _value(one: Worst) -> Quantity:
    if one.what == "joint_angle":
        return Quantity(one.value, "angle", decimals=2)
    if one.what.startswith("length"):
        return Quantity(one.value, "length", decimals=1)
    if one.what == "acceleration":
        return Quantity(one.value, "angular_acceleration")
    return Quantity(one.value, "share", 3)


RANDOM_UNITS = {
    "angle": (deg, "deg2_per_Hz"),
    "length": (mm, "mm2_per_Hz"),
    "share": (1.0, "per_Hz"),
    "angular_acceleration": (1.0, "rad2_s4_per_Hz"),
    "torque": (1.0, "N2_m2_per_Hz"),
}
"""Dimension of a result -> the unit of its density for programs."""


def _random_names() -> dict[str, tuple[str, str]]:
    """Return title and dimension of the results of random movements."""
    return {
        "joint_angle": (_("angle of joint {number}"), "angle"),
        "length": (_("length of shaft {number}"), "length"),
        "speed_fluctuation": (_("speed fluctuation of the output if it stopped there"), "share"),
        "angle_error": (_("angle error of the output, ±"), "angle"),
        "acceleration": (_("acceleration of the output"), "angular_acceleration"),
        "couple": (_("couple of the cross of joint {number}"), "torque"),
        "shaft_torque": (_("torque of shaft {number}"), "torque"),
        "secondary_couple": (_("secondary couple of shaft {number}"), "torque"),
    }


def random_tables(found: RandomMotion) -> Iterator[Table]:
    """Yield what random movements make of a drive: means, deviations and rare levels; spectra for programs."""
    names = _random_names()

    def column(key: str, heading: Text, values: list[float]) -> Column:
        cells = [
            Quantity(value, names[one.what][1], 4) if np.isfinite(value) else None
            for one, value in zip(found.results, values, strict=True)
        ]
        return Column(key=key, heading=heading, values=cells)

    rows, span = found.results, _time(found.span)
    note = _(
        "Expectations over all that chance may bring, of the drive as it stands at each instant; the levels are "
        "crossed once in {span} on average. All else here is of one sample path."
    )
    if found.resting:
        note = f"{note} {_('The other movements rest meanwhile.')}"
    if any(one.error > 0.0 for one in rows):
        worst = max(one.error / one.deviation for one in rows if one.deviation > 0.0)
        note = f"{note} {_('The standard error of the means is at most {share} of the deviations.')}"
        said = say(note, span=span, share=Quantity(worst, "share", 2))
    else:
        said = say(note, span=span)
    yield Table(
        title=_("Under the random movements"),
        columns=(
            Column(
                key="what",
                heading=_("what"),
                values=[names[one.what][0].format(number=one.number) for one in rows],
                left=True,
            ),
            column("mean", _("mean"), [one.mean for one in rows]),
            column("deviation", _("standard deviation"), [one.deviation for one in rows]),
            column("high", _("exceeded once"), [one.high for one in rows]),
            column("low", _("fallen below once"), [one.low for one in rows]),
        ),
        note=said,
    )
    columns = [Column(key="frequency_Hz", values=found.frequency / (2.0 * np.pi))]
    for one, density in zip(rows, found.density, strict=True):
        scale, unit = RANDOM_UNITS[names[one.what][1]]
        key = f"{one.what}_{one.number}_{unit}"
        columns.append(Column(key=key, values=2.0 * np.pi * density / scale**2))
    yield Table(name="random_spectrum", depth="data", columns=columns)


def random_facts(found: RandomMotion | None) -> dict[str, Any]:
    """Return what random movements make of a drive, for programs."""
    if found is None:
        return {}
    names = _random_names()

    def quantity(one: Expected, value: float) -> Quantity:
        return Quantity(value if np.isfinite(value) else None, names[one.what][1])

    return {
        "random_span": Quantity(found.span, "time"),
        "random_results": [
            {
                "what": one.what,
                "number": one.number,
                "mean": quantity(one, one.mean),
                "deviation": quantity(one, one.deviation),
                "exceeded_once": quantity(one, one.high),
                "fallen_below_once": quantity(one, one.low),
                "spectrum_holds": Quantity(one.held, "share"),
            }
            for one in found.results
        ],
    }


def _remarks(drive: Drive, found: Articulation) -> Iterator[Remark]:
    failed = [flag.message for one in found.splines for flag in one.flags]
    for what in found.warnings:
        bad = what in failed or not _turns(found)
        tone: Tone = "failed" if bad else "warning"
        yield Remark(text=say(_("Failed: {what}.") if bad else _("Warning: {what}."), what=what), tone=tone)
    moving, frozen = _worst(found, "moving_speed_fluctuation"), _worst(found, "speed_fluctuation")
    if moving is not None and wobbling(drive):
        yield Remark(text=_("A shaft wobbles: δ counts it, speeds that include the articulation rate do not."))
    elif moving is not None and frozen is not None:
        text = _("Including the articulation rate: δ = {share} peak to peak, at {time}.")
        if moving.value < SYNCHRONOUS:
            text = _("Including the articulation rate, the output stays uniform.")
        yield Remark(text=say(text, share=Quantity(moving.value, "share"), time=_time(moving.time)))
    elif found.speed is None:
        yield Remark(text=_("δ is that of the drive standing still at each instant."))
        yield Remark(text=_("--speed-rpm includes the articulation rate, too."), tone="next")
    if len(drive.joints) > 1 and frozen is not None and frozen.value > SPECK:
        text = _("Put the worst positions into the file as [[poses]], then find yoke angles for all of them:")
        if drive.poses:
            text = _("Find the yoke angles that suit all poses:")
        yield Remark(text=text, command=("cardan", "phasing", FILE), tone="next")


def _keys(drive: Drive, found: Articulation) -> Iterator[KeyFigure]:
    titles = {
        "speed_fluctuation": _("largest speed fluctuation if it stopped on its way"),
        "moving_speed_fluctuation": _("largest speed fluctuation while moving"),
    }
    frozen = _worst(found, "speed_fluctuation")
    for one in found.worst:
        if one is frozen or (one.what in titles and rate_counts(one.value, 0.0 if frozen is None else frozen.value)):
            yield KeyFigure(
                name=f"{one.what}_moving",
                title=titles[one.what],
                place=say(_("at {time}"), time=_time(one.time)),
                value=Quantity(one.value, "share", 3),
                repeats="speed_fluctuation",
            )
    for spline in found.splines:
        short = {flag.field.rpartition(".")[2] for flag in spline.flags}
        for field, left in (("engaged", spline.engaged_min), ("gap", spline.gap_min)):
            if left is not None:
                yield spline_key(drive, spline.shaft, field, left, failed=field in short)


def rate_counts(moving: float, stopped: float) -> bool:
    """Tell whether the rate of the movement adds to the speed fluctuation so much that it is told by itself."""
    return moving > COUNTS * stopped and moving - stopped > LEAST


def spline_key(drive: Drive, shaft: int, field: str, left: float, *, failed: bool, note: Text = "") -> KeyFigure:
    """Return what is left of a spline as a key figure.

    field: whether engaged length or remaining travel is left; left [m]; failed: whether that is too little.
    note: when it is so.
    """
    limit = drive.limits.spline_overlap if field == "engaged" else None
    titles = {"engaged": _("shortest engaged length of the spline"), "gap": _("least remaining travel of the spline")}
    close = limit is not None and left > 0.0 and limit / left >= CLOSE
    tone: Tone = "failed" if failed else "warning" if close else "good"
    return KeyFigure(
        name=f"spline_{field}_{shaft}",
        title=titles[field],
        place=Joined([say(_("shaft {number}"), number=shaft), note]),
        value=Quantity(left, "length", decimals=1),
        limit=None if limit is None else Quantity(limit, "length", 6, trim=True),
        better="more",
        tone=tone,
        verdict={"failed": _("too little"), "warning": _("near the limit"), "good": _("passed")}[tone],
        check="spline_overlap",
    )


def _history(found: Articulation) -> Table:
    n = found.joint_angle.shape[1]

    def column(key: str, values: Any, dimension: str = "", unit: str = "") -> Column:
        return Column(key=key, values=values, dimension=dimension, unit=unit)

    columns = [column("time", found.times, "time"), column("status", found.status)]
    columns += [column(f"joint_{k + 1}_joint_angle", found.joint_angle[:, k], "angle") for k in range(n)]
    columns += [column(f"joint_{k + 2}_plane_twist", found.plane_twist[:, k], "angle") for k in range(n - 1)]
    for k in range(1, n):
        name = f"shaft_{k + 1}"
        columns += [
            column(f"{name}_length", found.length[:, k], "length"),
            column(f"{name}_sliding", found.length_rate[:, k], "speed", "mm_s"),
            column(f"{name}_sliding_acceleration", found.length_acceleration[:, k], "acceleration", "mm_s2"),
        ]
    columns += [
        column(f"shaft_{k + 2}_speed_fluctuation", found.shaft_speed_fluctuation[:, k], "share") for k in range(n)
    ]
    if found.speed_low is not None and found.speed_high is not None:
        columns += [column("moving_speed_fluctuation", found.moving_speed_fluctuation, "share")]
        for k in range(1, n + 1):
            columns += [
                column(f"shaft_{k + 1}_speed_min", found.speed_low[:, k], "angular_speed"),
                column(f"shaft_{k + 1}_speed_max", found.speed_high[:, k], "angular_speed"),
            ]
    return Table(name="history", columns=columns)


def _facts(drive: Drive, found: Articulation) -> dict[str, Any]:
    scales = {"joint_angle": ("deg", deg), "length_min": ("mm", mm), "length_max": ("mm", mm)}
    units = [scales.get(one.what, ("", 1.0)) for one in found.worst]
    return {
        "speed": Quantity(found.speed, "angular_speed"),
        "passed": not any(one.flags for one in found.splines) and _turns(found),
        "worst": [
            {
                "what": KEYS.get(one.what, one.what),
                "number": one.number,
                "time": Quantity(one.time, "time"),
                "value": one.value / scale,
                "unit": unit,
            }
            for one, (unit, scale) in zip(found.worst, units, strict=True)
        ],
        "splines": [_spline(drive, one) for one in found.splines],
        "warnings": list(found.warnings),
        "assumed": list(found.assumed),
        **random_facts(found.random),
    }


def _spline(drive: Drive, one: LengthCompensation) -> dict[str, Any]:
    def length(value: float | None) -> Quantity:
        return Quantity(value, "length")

    return {
        "number": one.shaft,
        "name": drive.shafts[one.shaft - 1].name,
        "length_min": length(one.length_min),
        "length_max": length(one.length_max),
        "stroke": length(one.stroke),
        "max_sliding_speed": Quantity(one.max_rate, "speed", unit="mm_s"),
        "engaged_min": length(one.engaged_min),
        "gap_min": length(one.gap_min),
        "slip_path": length(one.slip_path),
        "passed": not one.flags,
        "flags": [
            {
                "field": flag.field,
                "message": flag.message,
                "time": Quantity(flag.time, "time"),
                "value": length(flag.value),
                "limit": length(flag.limit),
                "spans": [Quantity(list(span), "time") for span in flag.spans],
            }
            for flag in one.flags
        ],
    }


def _column_values(drive: Drive) -> tuple[float, float, float]:
    found = ask(drive)
    joint_angle, uneven = (
        max((one.value for one in found.worst if one.what == what), default=math.nan)
        for what in ("joint_angle", "speed_fluctuation")
    )
    return joint_angle, uneven, max((one.stroke for one in found.splines), default=0.0)


COLUMNS = (
    SweepQuestion(
        name="movement",
        doc=mark("what the movements of the drive ask: joint angle, speed fluctuation, stroke of the splines"),
        told=(
            OutputColumn.of("moving_joint_angle_deg", mark("greatest joint angle while it moves")),
            OutputColumn.of("moving_speed_fluctuation_percent", mark("greatest speed fluctuation while it moves")),
            OutputColumn.of("stroke_mm", mark("stroke of the splines")),
        ),
        of_one=_column_values,
        counts=("movement",),
    ),
)
"""What a sweep may ask of a drive that moves."""
