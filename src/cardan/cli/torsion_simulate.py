"""``cardan torsion simulate``: how do torques and speeds run in time?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm
from .torsion_parts import Pieces

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.transient.torsion_transient import Transient

    from .answer import Answer, Cell, Remark, Table, Tone

MOST_SAMPLES = 1_000_000
"""More samples than this are refused."""


def torsion_simulate(
    file: DriveFile,
    span: Annotated[
        float | None,
        typer.Option(
            "--span-s",
            "--span",
            metavar="S",
            help=_("How long; behind the run-up or to the end of the history, else some turns."),
            show_default=False,
        ),
    ] = None,
    samples: Annotated[
        int, typer.Option("--samples", metavar="N", min=2, max=MOST_SAMPLES, help=_("Samples of the curves."))
    ] = 2001,
    settled: Annotated[
        bool,
        typer.Option(
            "--settled",
            help=_("Start from the steady motion, not from even rotation with untwisted shafts."),
            show_default=False,
        ),
    ] = False,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how torques and speeds run in time."""
    from .asked import check_torque, on_duty
    from .output import check_speed
    from .show import check_common, show
    from .torsion_band import asked_of
    from .torsion_parts import ended, keeping

    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)
    check_torque(torque)
    _check_span(span)

    from cardan.questions.torsion.transient.torsion_transient import transient as question

    from .source import read

    drive = on_duty(read(file), speed_rpm, torque)
    with asked_of(file, {"span": "--span-s"}), keeping(_("following the motion")) as progress:
        found = question(
            drive,
            span=span,
            times=samples,
            start="settled" if settled else "even",
            pieces=pieces,
            progress=progress,
        )
    return ended(show(_answer(drive, file, found), json=json, csv=csv, plot=plot), progress)


def _check_span(span: float | None) -> None:
    from math import isfinite

    from cardan.errors import refuse

    if span is not None and not (isfinite(span) and span > 0.0):
        raise refuse("--span-s", _("{value} is not allowed; allowed is a finite time above 0").format(value=span))


def _answer(drive: Drive, file: Path, found: Transient) -> Answer:
    from .answer import Answer
    from .asked import figures

    tone, sentence, code = _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: [_element_table(found), _station_table(found)],
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
        code=code,
    )


def _sentence(drive: Drive, file: Path, found: Transient) -> tuple[Tone, str, int]:
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.questions.torsion.transient.simulation import Status

    from .answer import significant
    from .source import title

    ends = found.motion.extremes
    size = np.maximum(np.abs(ends.torque_low), np.abs(ends.torque_high))
    e = int(foremost(np.nan_to_num(size)))
    high = abs(float(ends.torque_high[e])) >= abs(float(ends.torque_low[e]))
    text = _("{name}: in {span} s the torque reaches {peak} N·m after {time} s, in {element}")
    text = text.format(
        name=title(drive, file),
        span=significant(float(found.motion.ended), 3),
        peak=significant(float(ends.torque_high[e] if high else ends.torque_low[e])),
        time=significant(float(ends.torque_high_time[e] if high else ends.torque_low_time[e]), 3),
        element=found.train.element_names[e],
    )
    status = int(found.motion.status)
    if status == Status.DIVERGED:
        return "failed", text + _("; then the motion left all bounds."), 1
    if status == Status.SNAPPED:
        return "failed", text + _("; then the torque snapped a joint without inertia through."), 1
    if status == Status.STALLED:
        return "failed", text + _("; then no step was short enough."), 1
    lifts = (ends.torque_low < 0.0) & (ends.torque_high > 0.0) & np.any(found.train.model.backlash > 0.0)
    if np.any(lifts):
        return "warning", text + _("; torques change their sign, so that play is passed through and strikes."), 0
    return "plain", text + ".", 0


def _element_table(found: Transient) -> Table:
    from .answer import Column, Table
    from .torsion_parts import short

    ends = found.motion.extremes
    rows: list[list[Cell]] = [
        [
            short(name, 34),
            float(ends.torque_low[e]),
            float(ends.torque_low_time[e]),
            float(ends.torque_high[e]),
            float(ends.torque_high_time[e]),
        ]
        for e, name in enumerate(found.train.element_names)
    ]
    columns = (
        Column(key="element", heading=_("torque in"), left=True),
        Column(key="min_Nm", heading=_("lowest"), unit="N·m"),
        Column(key="min_at_s", unit=_("at s"), form="3"),
        Column(key="max_Nm", heading=_("highest"), unit="N·m"),
        Column(key="max_at_s", unit=_("at s"), form="3"),
    )
    return Table(columns=columns, rows=rows)


def _station_table(found: Transient) -> Table:
    from cardan.units import rpm

    from .answer import Column, Table
    from .torsion_parts import short

    ends = found.motion.extremes
    rows: list[list[Cell]] = [
        [
            short(name, 34),
            float(ends.speed_low[k]) / rpm,
            float(ends.speed_high[k]) / rpm,
            float(found.motion.speed[-1, k]) / rpm,
        ]
        for k, name in enumerate(found.train.model.names)
    ]
    columns = (
        Column(key="station", heading=_("speed of"), left=True),
        Column(key="min_rpm", heading=_("lowest"), unit="rpm"),
        Column(key="max_rpm", heading=_("highest"), unit="rpm"),
        Column(key="end_rpm", heading=_("at the end"), unit="rpm"),
    )
    return Table(columns=columns, rows=rows)


def _remarks(file: Path, found: Transient) -> Iterator[Remark]:
    import numpy as np

    from cardan.answers.checks import closely
    from cardan.questions.torsion.transient.simulation import Status
    from cardan.units import rpm

    from .answer import Remark, significant
    from .torsion_parts import assumptions

    if int(found.motion.status) == Status.CANCELLED:
        text = _("Warning: stopped after {ended} s; what was done is shown.")
        yield Remark(text=text.format(ended=significant(float(found.motion.ended), 3)), tone="warning")
    for hang in found.hangs:
        text = _(
            "Warning: from {start} s to {end} s the speed hangs at {speed} rpm although the motor could raise it by "
        )
        text += _("{could} rpm a second: swinging takes {power} kW.")
        yield Remark(
            text=text.format(
                start=significant(hang.start, 3),
                end=significant(hang.end, 3),
                speed=significant(hang.speed / rpm, 3),
                could=significant(hang.could / rpm, 3),
                power=significant(hang.power / 1e3, 3),
            ),
            tone="warning",
        )
    if found.start == "even":
        text = _("It starts from even rotation with untwisted shafts: all torques come on at once. --settled starts ")
        yield Remark(text=text + _("from the steady motion."))
    if np.any(found.train.model.loss_factor):
        yield Remark(text=_("Structural damping counts as viscous, equal at order 2 of the highest speed."))
    yield from assumptions(found.train)
    text = _("Account of energy checked: it closes {closely} ({steps} steps, {method}).")
    known = {"explicit": _("explicit"), "implicit": _("implicit"), "fixed steps": _("of one length")}
    how = known.get(found.motion.method, found.motion.method)
    yield Remark(text=text.format(closely=closely(float(found.motion.imbalance)), steps=found.motion.steps, method=how))
    yield Remark(
        text=_("Whether such vibration dies out:"), command=("cardan", "torsion", "stability", str(file)), tone="next"
    )


def _rows(found: Transient) -> Table:
    """Return torques and speeds, one moment a row."""
    import numpy as np

    from cardan.units import rpm

    from .answer import Column, Table

    motion = found.motion
    named: list[tuple[str, Any]] = [("time_s", motion.times)]
    named += [(f"element_{e}_torque_Nm", one) for e, one in enumerate(motion.torque.T, 1)]
    named += [(f"station_{k}_speed_rpm", one / rpm) for k, one in enumerate(motion.speed.T, 1)]
    named += [(f"station_{k}_angle_deg", np.degrees(one)) for k, one in enumerate(motion.angle.T, 1)]
    if motion.input_torque is not None:
        named.append(("input_torque_Nm", motion.input_torque))
    named.append(("energy_J", motion.energy))
    table = np.stack([np.asarray(values, dtype=float) for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _content(drive: Drive, file: Path, found: Transient) -> dict[str, Any]:
    from cardan.units import rpm

    from .asked import columns_of

    ends = found.motion.extremes
    return {
        "question": "torsion simulate",
        "drive": drive.name,
        "file": str(file),
        "start": found.start,
        "complete": found.complete,
        "ended_s": found.motion.ended,
        "elements": [
            {
                "name": name,
                "min_Nm": ends.torque_low[e],
                "min_at_s": ends.torque_low_time[e],
                "max_Nm": ends.torque_high[e],
                "max_at_s": ends.torque_high_time[e],
            }
            for e, name in enumerate(found.train.element_names)
        ],
        "stations": [
            {"name": name, "min_rpm": ends.speed_low[k] / rpm, "max_rpm": ends.speed_high[k] / rpm}
            for k, name in enumerate(found.train.model.names)
        ],
        "hangs": [
            {
                "from_s": hang.start,
                "to_s": hang.end,
                "speed_rpm": hang.speed / rpm,
                "could_rise_rpm_per_s": hang.could / rpm,
                "power_W": hang.power,
            }
            for hang in found.hangs
        ],
        "energy_imbalance": found.motion.imbalance,
        "steps": found.motion.steps,
        "method": found.motion.method,
        "assumed": found.train.assumed,
        "curves": columns_of(_rows(found)),
    }
