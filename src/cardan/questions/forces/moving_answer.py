"""What there is to say of the forces of a drive while it moves: extremes over the movement, turn by turn."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, Remark, Table
from cardan.answers.quantity import Quantity, Say, say
from cardan.drive.drive import Drive
from cardan.drive.models.machine_held import machine_held, machines_of
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.assumed import held_by_machines, yokes_estimated
from cardan.questions.motion.equivalence import WARN_JOINT_ANGLE
from cardan.texts import _, plural
from cardan.units import deg

from .answer import balance_facts, balanced, duty_facts, needed, worst_moving
from .force_tables import (
    along_axis,
    curve,
    joint_heads,
    shaft_heads,
    size,
    support_heads,
    support_names,
    tidy,
)
from .moving_forces import MovingForces
from .reactions import Determinacy

drawn = later("cardan.questions.forces.figures")

__all__ = ["answer"]


def answer(drive: Drive, result: MovingForces) -> Answer:
    """Return what there is to say of what a drive carries while it moves."""
    machines, drive = machines_of(drive), machine_held(drive)
    return Answer(
        name="forces",
        title=_("Forces while the drive moves"),
        sentence=_sentence(drive, result),
        figures=lambda: drawn().moving_forces_figures(result, support_names(drive)),
        tables=tuple(_tables(drive, result)),
        remarks=(*yokes_estimated(drive), *held_by_machines(machines), *_remarks(result)),
        facts=_facts(drive, result),
        full=lambda: _trace(drive, result),
    )


def _sentence(drive: Drive, result: MovingForces) -> Say:
    found = result.forces
    other = result.extreme(found.output_torque if drive.duty.torque_at == "input" else found.shaft_torque[0])
    torque = needed(drive, float(other.low), float(other.high))
    if found.reaction is None:
        return say(_("while it moves, {torque}."), torque=torque)
    text = _("while it moves, {torque}; support {which} carries most, up to {most} at {time}.")
    return say(text, torque=torque, **worst_moving(drive, result))


def _tables(drive: Drive, result: MovingForces) -> Iterator[Table]:
    found = result.forces
    torque, bent = result.extreme(tidy(found.shaft_torque)), result.extreme(tidy(found.bending_couple))
    yield Table(
        name="shafts",
        records=True,
        columns=(
            *shaft_heads(drive),
            Column(key="torque_min", heading=_("torque, least"), values=torque.low, dimension="torque"),
            Column(key="torque_max", heading=_("largest"), values=torque.high, dimension="torque"),
            Column(key="secondary_couple_max", heading=_("secondary couple"), values=bent.high, dimension="torque"),
            _when("secondary_couple_max_at", bent.high_time, bent.high > 0.0),
        ),
    )
    yield _joints(drive, result)
    if found.reaction is not None:
        yield _supports(drive, result)


def _when(key: str, times: Array, known: Array) -> Column:
    values = [float(time) if there else None for time, there in zip(times, known, strict=True)]
    return Column(key=key, heading=_("at"), values=values, dimension="time", decimals=3)


def _joints(drive: Drive, result: MovingForces) -> Table:
    found = result.forces
    angle = result.extreme(_joint_angles(result))
    centre = None if found.joint_force is None else result.extreme(tidy(size(found.joint_force)))
    journal = result.extreme(np.max(found.journals.size, axis=-1))
    known = np.isfinite(journal.high)
    return Table(
        name="joints",
        records=True,
        columns=(
            *joint_heads(drive),
            Column(
                key="joint_angle_min", heading=_("joint angle, least"), values=angle.low, dimension="angle", decimals=2
            ),
            Column(key="joint_angle_max", heading=_("largest"), values=angle.high, dimension="angle", decimals=2),
            Column(
                key="force_max",
                heading=_("joint force"),
                values=[None] * len(drive.joints) if centre is None else centre.high,
                dimension="force",
            ),
            Column(
                key="journal_max",
                heading=_("journal"),
                values=[float(most) if there else None for most, there in zip(journal.high, known, strict=True)],
                dimension="force",
            ),
            _when("journal_max_at", journal.high_time, known),
        ),
    )


def _joint_angles(result: MovingForces) -> Array:
    """Return the joint angles, array (n, p) [rad]."""
    axis = np.asarray(result.forces.axis)
    return np.asarray(frames.angle_between(axis[:-1], axis[1:]))


def _supports(drive: Drive, result: MovingForces) -> Table:
    radial, axial = result.extreme(result.forces.radial), result.extreme(along_axis(result.forces))
    across = np.asarray([one.radial for one in drive.supports], dtype=bool)

    def along(values: Array) -> list[float | None]:
        return [float(one) if support.axial else None for one, support in zip(values, drive.supports, strict=True)]

    return Table(
        name="supports",
        records=True,
        columns=(
            *support_heads(drive),
            Column(
                key="radial_max",
                heading=_("radial, largest"),
                values=[float(one) if there else None for one, there in zip(radial.high, across, strict=True)],
                dimension="force",
            ),
            _when("radial_max_at", radial.high_time, across & (radial.high > 0.0)),
            Column(key="axial_min", heading=_("axial, from"), values=along(axial.low), dimension="force"),
            Column(key="axial_max", heading=_("to"), values=along(axial.high), dimension="force"),
        ),
        note=_("Forces on the shaft; axial ones are positive along the power flow."),
    )


def _remarks(result: MovingForces) -> Iterator[Remark]:
    steepest = float(np.max(_joint_angles(result)))
    if steepest > WARN_JOINT_ANGLE * deg:
        text = _("Warning: a joint angle reaches {angle} on the way; above {limit} no real cross joint works.")
        limit = Quantity(WARN_JOINT_ANGLE * deg, "angle", trim=True)
        yield Remark(text=say(text, angle=Quantity(steepest, "angle", decimals=1), limit=limit), tone="warning")
    if result.cancelled:
        yield Remark(text=_("Warning: stopped; this is of the turns looked at by then."), tone="warning")
    yield Remark(text=_looked_at(result))
    if int(result.forces.status) == int(Determinacy.INDETERMINATE):
        text = _(
            "Warning: statically indeterminate: the supports share the forces by their stiffness, misalignment "
            "included."
        )
        yield Remark(text=text, tone="warning")
    yield balanced(result.forces)
    if result.forces.force_left is None:
        yield Remark(text=_("Add [[supports]] to the file for the loads of bearings."), tone="next")
    text = _("The same standing still, as drawn:")
    yield Remark(text=text, command=("cardan", "forces", FILE), tone="next")


def _looked_at(result: MovingForces) -> Say:
    """Return what was looked at."""
    what = plural("{n} movement", "{n} movements", len(result.movements)).format(n=len(result.movements))
    if result.complete:
        return say(
            _("{what} over {span}, {turns} turns of the input, every 5° or closer."),
            what=what,
            span=Quantity(float(result.times[-1] - result.times[0]), "time", 3),
            turns=Quantity(result.turns, trim=True),
        )
    text = _("{what}; {some} of {turns} turns looked at, equally spread, every 5°.")
    return say(text, what=what, some=result.turn_times.size, turns=round(result.turns))


def _facts(drive: Drive, result: MovingForces) -> dict[str, Any]:
    found = result.forces
    return {
        "movements": [one.name or one.kind for one in result.movements],
        **duty_facts(drive),
        "status": Determinacy(int(found.status)).name.lower(),
        "turns": result.turns,
        "complete": result.complete and not result.cancelled,
        **({} if found.reaction is not None else {"supports": []}),
        **balance_facts(found),
        "assumed": found.assumed,
    }


def _trace(drive: Drive, result: MovingForces) -> Table:
    """Return the largest and least of every turn."""
    return Table(name="each_turn", columns=tuple(_columns(drive, result)))


def _columns(drive: Drive, result: MovingForces) -> Iterator[Column]:
    found = result.forces

    def both(key: str, dimension: str, values: Array) -> Iterator[Column]:
        low, high = result.each_turn(np.asarray(values))
        yield curve(f"{key}_min", low, dimension)
        yield curve(f"{key}_max", high, dimension)

    def most(key: str, dimension: str, values: Array) -> Column:
        return curve(f"{key}_max", result.each_turn(np.asarray(values))[1], dimension)

    yield curve("time", result.turn_times, "time")
    for k, torque in enumerate(found.shaft_torque, 1):
        yield from both(f"shaft_{k}_torque", "torque", torque)
        yield most(f"shaft_{k}_secondary_couple", "torque", found.bending_couple[k - 1])
    for i, loads in enumerate(found.journals.size, 1):
        if np.all(np.isfinite(loads)):
            yield most(f"joint_{i}_journal", "force", np.max(loads, axis=-1))
        if found.joint_force is not None:
            yield most(f"joint_{i}_force", "force", size(found.joint_force[i - 1]))
    for k, thrust in enumerate(found.spline_thrust, 1):
        yield from both(f"spline_{k}_thrust", "force", thrust)
    if found.reaction is not None:
        for k, radial in enumerate(found.radial, 1):
            yield most(f"support_{k}_radial", "force", radial)
            if drive.supports[k - 1].axial:
                yield from both(f"support_{k}_axial", "force", found.axial[k - 1])
