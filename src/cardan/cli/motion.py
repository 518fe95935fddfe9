"""``cardan motion``: how does every shaft turn?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.forces.swing import Evenness
    from cardan.questions.motion.motion import Motion

    from .answer import Answer, Remark, Table

STEP = 30.0
"""Step of the printed table [deg]; JSON, CSV and figures have steps of one degree."""

ORDERS = 3
"""So many orders of the input speed are listed: 2, 4, 6."""

NOISE = 1e-12
"""Accelerations below this share of a shaft's largest one are rounding and are shown as 0."""

MOST_POSITIONS = 1_000_000
"""More positions than this would not fit a table anyone reads."""


def motion(
    file: DriveFile,
    angle: Annotated[
        list[float] | None,
        typer.Option(
            "--angle-deg",
            "--angle",
            metavar="DEG",
            help=_("Input angle from the start position; may be repeated. Instead of a whole turn."),
            show_default=False,
        ),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option(
            "--angle-step-deg",
            "--angle-step",
            metavar="DEG",
            help=_("Step of the input angle over one turn: 30 in the terminal, 1 otherwise."),
            show_default=False,
        ),
    ] = None,
    speed_rpm: SpeedRpm = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how every shaft turns: angle, speed ratio, acceleration."""
    from .output import check_speed
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_positions(angle, step)
    check_speed(speed_rpm)

    from cardan.questions.forces.swing import each_shaft
    from cardan.questions.motion.motion import motion as question
    from cardan.units import rpm

    from .source import read

    drive = read(file)
    speed = drive.duty.speed if speed_rpm is None else speed_rpm * rpm
    finely = question(drive, positions(angle, step or 1.0), speed=speed)
    coarse = finely if json or csv else question(drive, positions(angle, step or STEP), speed=speed)
    answer = _answer(drive, file, coarse, each_shaft(drive), finely)
    return show(answer, json=json, csv=csv, plot=plot)


def check_positions(angle: list[float] | None, step: float | None) -> None:
    """Refuse positions that are not numbers, that contradict each other, or that are too many."""
    import math

    from cardan.errors import Problem, check

    problems = []
    if angle and step is not None:
        problems.append(Problem("--angle-step-deg", _("choose --angle-deg or --angle-step-deg, not both")))
    problems += [
        Problem("--angle-deg", _("{value} is not a finite number").format(value=value))
        for value in angle or ()
        if not math.isfinite(value)
    ]
    if step is not None and not 360.0 / MOST_POSITIONS <= step <= 360.0:
        text = _("{value} is not allowed; allowed is {low:g} to 360")
        problems.append(Problem("--angle-step-deg", text.format(value=step, low=360.0 / MOST_POSITIONS)))
    check(problems)


def positions(angle: list[float] | None, step: float) -> Any:
    """Return the input angles asked for [rad]: those given, or one turn with both its ends."""
    import numpy as np

    from cardan.units import deg

    return deg * (np.asarray(angle) if angle else step * np.arange(int(360.0 / step + 1e-9) + 1))


def _answer(drive: Drive, file: Path, found: Motion, each: Evenness, drawn: Motion) -> Answer:
    from .answer import Answer

    return Answer(
        sentence=sentence(drive, file, each),
        tone="good" if _even(each) else "plain",
        tables=lambda: (
            _joint_table(drive),
            _shaft_table(drive, found, each, tidy=True),
            _turn_table(found, _accelerations(found, each, tidy=True)),
        ),
        remarks=tuple(_remarks(drive, file, found, each)),
        content=lambda: _content(drive, file, found, each),
        csv=lambda: _trace(found),
        figure=lambda: _figures(drive, drawn),
    )


def _figures(drive: Drive, found: Motion) -> Any:
    from cardan.drive.models.laws import unmapped
    from cardan.figures import for_result
    from cardan.questions.motion.equivalence import equivalent_joint

    return for_result(found) if unmapped(drive.joints) else (*for_result(found), *for_result(equivalent_joint(drive)))


def _even(each: Evenness) -> bool:
    from cardan.questions.motion.equivalence import SYNCHRONOUS

    return bool(each.irregularity[-1] < SYNCHRONOUS)


def sentence(drive: Drive, file: Path, each: Evenness) -> str:
    """Return in one sentence how even a drive is; ``each`` as of `each_shaft`."""
    from cardan.units import deg

    from .answer import percent
    from .source import title

    count = plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints))
    if _even(each):
        text = _("{name}: {count}, the output turns exactly evenly.")
        if drive.movements:
            text = _("{name}: {count}, the output turns exactly evenly as drawn, standing still.")
        return text.format(name=title(drive, file), count=count)
    from cardan.drive.models.laws import unmapped

    if unmapped(drive.joints):
        text = _("{name}: {count}, {share} irregular, as much as one cross joint bent {bend:.2f}°.")
    elif len(drive.joints) == 1 and drive.joints[0].single_cross:
        text = _("{name}: one joint bent {bend:.2f}°, {share} irregular.")
    else:
        text = _("{name}: {count} turn the output like one joint bent {bend:.2f}°, {share} irregular.")
    share = percent(float(each.irregularity[-1]))
    return text.format(name=title(drive, file), count=count, bend=float(each.bend[-1]) / deg, share=share)


def _joint_table(drive: Drive) -> Table:
    import numpy as np

    from cardan.drive.models.chain import given_chain
    from cardan.drive.models.laws import mixed
    from cardan.questions.motion.motion import motion

    from .answer import Column, Table, named

    whole = given_chain(drive)
    bend, twist = np.rad2deg(whole.bend), np.rad2deg(whole.plane_twist)
    phase = half_turn(np.rad2deg(motion(drive, [0.0]).joint_angle[:, 0]))
    kinds = mixed(drive.joints)
    rows = [
        (
            named(k + 1, joint.name),
            *((joint.kind,) if kinds else ()),
            float(bend[k]),
            float(twist[k - 1]) if k else None,
            float(phase[k]),
        )
        for k, joint in enumerate(drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        *((Column(key="kind", heading=_("kind"), left=True),) if kinds else ()),
        Column(key="bend_deg", heading=_("bend"), unit="°", form=".2f"),
        Column(key="plane_twist_deg", heading=_("plane twist"), unit="°", form=".2f"),
        Column(key="phase_angle_deg", heading=_("phase angle"), unit="°", form=".2f"),
    )
    return Table(columns=columns, rows=rows)


def _shaft_table(drive: Drive, found: Motion, each: Evenness, *, tidy: bool = False) -> Table:
    from cardan.units import deg

    from .answer import Column, Table, named

    steep = _accelerations(found, each, tidy=tidy)
    rows = []
    for k, shaft in enumerate(drive.shafts[1:]):
        last = shaft.number == len(drive.shafts)
        rows.append(
            (
                named(shaft.number, shaft.name or (_("output") if last else "")),
                None if last else shaft.yoke_angle / deg,
                float(each.irregularity[k]) * 100.0,
                float(each.ratio_min[k]),
                float(each.ratio_max[k]),
                float(each.max_lead[k]) / deg,
                steep[k],
            )
        )
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="yoke_angle_deg", heading=_("yoke angle"), unit="°", form=".2f"),
        Column(key="irregularity_percent", heading=_("irregular"), unit="%", form=".3f"),
        Column(key="ratio_min", heading=_("ratio"), unit=_("min"), form=".4f"),
        Column(key="ratio_max", unit=_("max"), form=".4f"),
        Column(key="max_lead_deg", heading=_("lead"), unit="± °", form=".3f"),
        Column(key="max_acceleration", heading=_("acceleration"), unit=_unit(found)),
    )
    return Table(columns=columns, rows=rows)


def _turn_table(found: Motion, largest: list[float]) -> Table:
    from cardan.units import deg

    from .answer import Column, Table

    last = found.shaft_ratio.shape[-2]
    steep, lead, ratio = _acceleration_rows(found), found.lead, found.shaft_ratio
    columns = [
        Column(key="angle_deg", heading=_("input"), unit="°", form=".7g"),
        Column(key="lead_deg", heading=_("output lead"), unit="°", form=".3f"),
        Column(key="ratio", heading=_("ratio"), form=".4f"),
        Column(key="acceleration", heading=_("acceleration"), unit=_unit(found)),
    ]
    columns += [
        Column(key=f"shaft_{k}_ratio", heading=_("ratio of"), unit=_("shaft {number}").format(number=k), form=".4f")
        for k in range(2, last)
    ]
    rows = [
        (
            float(found.angle[p]) / deg,
            float(lead[-1, p]) / deg,
            float(ratio[-1, p]),
            float(steep[-1, p]) if abs(steep[-1, p]) > NOISE * largest[-1] > 0.0 else 0.0,
            *(float(ratio[k, p]) for k in range(1, last - 1)),
        )
        for p in range(len(found.angle))
    ]
    return Table(columns=tuple(columns), rows=rows)


def _trace(found: Motion) -> Table:
    """Return angle, ratio and acceleration of every shaft at every position."""
    import numpy as np

    from .answer import Column, Table

    unit = "acceleration_rad_s2" if found.speed is not None else "acceleration_per_speed_squared"
    steep = _acceleration_rows(found)
    columns = [Column(key="angle_deg")]
    values = [np.rad2deg(found.angle)]
    for k in range(1, found.shaft_ratio.shape[-2]):
        for key, rows in (
            ("angle_deg", np.rad2deg(found.shaft_angle)),
            ("ratio", found.shaft_ratio),
            (unit, steep),
        ):
            columns.append(Column(key=f"shaft_{k + 1}_{key}"))
            values.append(rows[k])
    return Table(columns=tuple(columns), rows=np.stack(values, axis=-1).tolist())


def _acceleration_rows(found: Motion) -> Any:
    return found.shaft_slope if found.speed is None else found.shaft_acceleration


def _accelerations(found: Motion, each: Evenness, *, tidy: bool = False) -> list[float]:
    """Return the largest acceleration of shafts 2 … n+1 at uniform input [rad/s²], over ω² without a speed.

    ``tidy`` makes it 0 where a shaft is even but for rounding.
    """
    from cardan.questions.motion.equivalence import SYNCHRONOUS

    scale = 1.0 if found.speed is None else float(found.speed) ** 2
    even = [tidy and bool(share < SYNCHRONOUS) for share in each.irregularity]
    return [0.0 if e else scale * float(value) for e, value in zip(even, each.max_acceleration, strict=True)]


def _unit(found: Motion) -> str:
    return "ω²" if found.speed is None else "rad/s²"


def _remarks(drive: Drive, file: Path, found: Motion, each: Evenness) -> Iterator[Remark]:
    from cardan.drive.models.laws import unmapped
    from cardan.units import deg, rpm

    from .answer import Remark, significant

    if not _even(each):
        twice = _("The output runs ahead and back by {lead:.3f}° twice a turn")
        text = (twice if unmapped(drive.joints) == () else _("The output runs ahead and back by {lead:.3f}°")).format(
            lead=float(each.max_lead[-1]) / deg
        )
        if found.speed is not None:
            text += _("; at {speed} rpm its acceleration reaches {steep} rad/s².").format(
                speed=significant(float(found.speed) / rpm), steep=significant(_accelerations(found, each)[-1])
            )
        else:
            text += _("; --speed-rpm gives its acceleration in rad/s².")
        yield Remark(text=text)
    if not _even(each):
        text = _("Its orders: {orders}.")
        shown = (_("{order} with {size}°").format(order=k, size=significant(w / deg, 3)) for k, w in _orders(each))
        yield Remark(text=text.format(orders=", ".join(shown)))
    yield from _own_motion(drive)
    yield from steep_joints(drive)
    if _even(each):
        yield Remark(text=_("The whole drive on one page:"), command=("cardan", "report", str(file)), tone="next")
    elif len(drive.joints) == 1:
        if drive.joints[0].single_cross:
            yield Remark(text=_("One joint is never even; a second one of equal bend can undo it."), tone="next")
    elif not unmapped(drive.joints):
        text = _("Find the yoke angles that leave least:")
        yield Remark(text=text, command=("cardan", "phases", str(file)), tone="next")


def steep_joints(drive: Drive) -> Iterator[Remark]:
    """Yield a warning for every joint that bends more than one of its kind can."""
    from cardan.drive.models.chain import given_chain
    from cardan.questions.motion.kinds import too_steep

    from .answer import Remark

    for number, (joint, bend) in enumerate(zip(drive.joints, given_chain(drive).bend, strict=True), start=1):
        text = too_steep(joint, number, float(bend))
        if text:
            yield Remark(text=_("Warning: {text}").format(text=text[:1].lower() + text[1:]), tone="warning")


def _orders(each: Evenness) -> list[tuple[int, float]]:
    """Return orders of the output's angle error with their amplitudes [1/turn, rad]."""
    from cardan.questions.forces.swing import Swing

    if isinstance(each, Swing):
        return each.orders(ORDERS)
    return [(2 * k, float(wave)) for k, wave in enumerate(each.harmonics(ORDERS)[-1], start=1)]


def _own_motion(drive: Drive) -> Iterator[Remark]:
    """Yield what joints do beside turning."""
    from cardan.questions.motion.kinds import beside_turning

    from .answer import Remark

    for text in beside_turning(drive):
        yield Remark(text=text)


def _content(drive: Drive, file: Path, found: Motion, each: Evenness) -> dict[str, Any]:
    from cardan.units import deg, rpm

    from .show import records

    trace = _trace(found)
    return {
        "question": "motion",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": None if found.speed is None else found.speed / rpm,
        "synchronous": _even(each),
        "irregularity": each.irregularity[-1],
        "equivalent_bend_deg": each.bend[-1] / deg,
        "ratio_min": each.ratio_min[-1],
        "ratio_max": each.ratio_max[-1],
        "max_lead_deg": each.max_lead[-1] / deg,
        "max_acceleration_per_speed_squared": each.max_acceleration[-1],
        "orders": [{"order": k, "lead_deg": wave / deg, "ratio": k * wave} for k, wave in _orders(each)],
        "joints": records(_joint_table(drive), [(k, joint.name) for k, joint in enumerate(drive.joints, 1)]),
        "shafts": records(_shaft_table(drive, found, each), [(shaft.number, shaft.name) for shaft in drive.shafts[1:]]),
        "motion": {column.key: [row[k] for row in trace.rows] for k, column in enumerate(trace.columns)},
    }


def half_turn(angle: Any) -> Any:
    """Return angles [deg] in (-90, 90]: yokes and cross arms are lines, not arrows."""
    return 90.0 - (90.0 - angle) % 180.0
