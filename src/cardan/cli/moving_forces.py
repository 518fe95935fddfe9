"""What ``cardan forces --movement`` answers: what shafts, joints and supports carry while the drive moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.errors import refuse
from cardan.texts import _, plural

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.drive.movement import Movement
    from cardan.questions.forces.moving_forces import MovingForces

    from .answer import Answer, Cell, Remark, Table

ALL = "all"
"""Stands for every movement of the file."""


def chosen(drive: Drive, names: Sequence[str]) -> tuple[Movement, ...]:
    """Return the movements that are asked for, in the order of the file.

    Parameters
    ----------
    drive : Drive
        The drive.
    names : sequence of str
        Names or numbers, from 1; or all.

    Raises
    ------
    InputError
        The file has none, or none of that name.
    """
    if not drive.movements:
        raise refuse("--movement", _("the file has no [[movements]]"))
    if ALL in names:
        return drive.movements
    known = {str(k): k for k in range(1, len(drive.movements) + 1)}
    known |= {one.name: k for k, one in enumerate(drive.movements, 1) if one.name}
    for name in names:
        if name not in known:
            there = ", ".join(f"{k} {one.name}".strip() for k, one in enumerate(drive.movements, 1))
            text = _("there is no movement {name}; there is {known}, or {all} of them")
            raise refuse("--movement", text.format(name=repr(name), known=there, all=ALL))
    wanted = {known[name] for name in names}
    return tuple(one for k, one in enumerate(drive.movements, 1) if k in wanted)


def answer(drive: Drive, file: Path, names: Sequence[str]) -> Answer:
    """Return what the drive carries while it moves."""
    from cardan.questions.forces.moving_forces import moving_forces

    from .answer import Answer
    from .asked import keys_of
    from .progress import watching

    moves = chosen(drive, names)
    with keys_of(file), watching(_("following the movement")) as progress:
        found = moving_forces(drive, None, moves, progress=progress)

    def drawn() -> Any:
        from cardan.questions.forces.figures.moving_forces import moving_forces_figures

        return moving_forces_figures(found, [one.name for one in drive.supports])

    return Answer(
        sentence=_sentence(drive, file, found),
        tables=lambda: _tables(drive, found),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _trace(drive, found),
        figure=drawn,
    )


def _sentence(drive: Drive, file: Path, found: MovingForces) -> str:
    from cardan.maths.ties import foremost

    from .answer import significant
    from .asked import called
    from .source import title

    forces = found.forces
    at_input = drive.duty.torque_at == "input"
    other = found.extreme(forces.output_torque if at_input else forces.shaft_torque[0])
    text = _("{name}: while it moves, {given} N·m at the output need {low} to {high} N·m at the input")
    if at_input:
        text = _("{name}: while it moves, {given} N·m at the input meet {low} to {high} N·m at the output")
    text = text.format(
        name=title(drive, file),
        given=significant(drive.duty.torque or 0.0),
        low=significant(float(other.low)),
        high=significant(float(other.high)),
    )
    if forces.reaction is None:
        return text + "."
    most = found.extreme(found.reaction_size)
    worst = int(foremost(most.high))
    more = _("; support {support} carries most, up to {size} N at {time} s.")
    return text + more.format(
        support=called(worst + 1, drive.supports[worst].name),
        size=significant(float(most.high[worst])),
        time=significant(float(most.high_time[worst]), 3),
    )


def _tables(drive: Drive, found: MovingForces) -> list[Table]:
    shown = [_shaft_table(drive, found), _joint_table(drive, found)]
    return [*shown, _support_table(drive, found)] if found.forces.reaction is not None else shown


def _shaft_table(drive: Drive, found: MovingForces) -> Table:
    from .answer import Column, Table, named
    from .asked import tidy
    from .force_tables import end

    torque = found.extreme(tidy(found.forces.shaft_torque))
    bent = found.extreme(tidy(found.forces.bending_couple))
    rows = [
        (
            named(one.number, one.name or end(one.number, len(drive.shafts))),
            float(torque.low[k]),
            float(torque.high[k]),
            float(bent.high[k]),
            float(bent.high_time[k]) if bent.high[k] > 0.0 else None,
        )
        for k, one in enumerate(drive.shafts)
    ]
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="torque_min_Nm", heading=_("torque"), unit=_("min N·m")),
        Column(key="torque_max_Nm", unit=_("max N·m")),
        Column(key="bending_max_Nm", heading=_("bent"), unit=_("max N·m")),
        Column(key="bending_max_at_s", unit=_("at s"), form=".3f"),
    )
    return Table(columns=columns, rows=rows)


def _joint_table(drive: Drive, found: MovingForces) -> Table:
    import numpy as np

    from .answer import Column, Table, named
    from .asked import size, tidy

    forces = found.forces
    bend = found.extreme(np.rad2deg(_bends(found)))
    centre = None if forces.joint_force is None else found.extreme(tidy(size(forces.joint_force)))
    journal = found.extreme(np.max(forces.journals.size, axis=-1))
    rows: list[list[Cell]] = [
        [
            named(i + 1, joint.name),
            float(bend.low[i]),
            float(bend.high[i]),
            None if centre is None else float(centre.high[i]),
            float(journal.high[i]) if np.isfinite(journal.high[i]) else None,
            float(journal.high_time[i]) if np.isfinite(journal.high[i]) else None,
        ]
        for i, joint in enumerate(drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="bend_min_deg", heading=_("bend"), unit=_("least °"), form=".2f"),
        Column(key="bend_max_deg", unit=_("most °"), form=".2f"),
        Column(key="force_max_N", heading=_("centre"), unit=_("max N")),
        Column(key="journal_max_N", heading=_("journal"), unit=_("max N")),
        Column(key="journal_max_at_s", unit=_("at s"), form=".3f"),
    )
    return Table(columns=columns, rows=rows)


def _bends(found: MovingForces) -> Any:
    """Return the bends of all joints, array (n, p) [rad]."""
    import numpy as np

    from cardan.maths.kernel import frames

    axis = np.asarray(found.forces.axis)
    return frames.angle_between(axis[:-1], axis[1:])


def _support_table(drive: Drive, found: MovingForces) -> Table:
    from .answer import Column, Table, named
    from .force_tables import along_axis

    radial = found.extreme(found.forces.radial)
    axial = found.extreme(along_axis(found.forces))
    rows: list[list[Cell]] = [
        [
            named(k + 1, one.name),
            one.shaft,
            float(radial.high[k]) if one.radial else None,
            float(radial.high_time[k]) if one.radial and radial.high[k] > 0.0 else None,
            float(axial.low[k]) if one.axial else None,
            float(axial.high[k]) if one.axial else None,
        ]
        for k, one in enumerate(drive.supports)
    ]
    columns = (
        Column(key="support", heading=_("support"), left=True),
        Column(key="shaft", heading=_("shaft")),
        Column(key="radial_max_N", heading=_("radial"), unit=_("max N")),
        Column(key="radial_max_at_s", unit=_("at s"), form=".3f"),
        Column(key="axial_min_N", heading=_("axial"), unit=_("min N")),
        Column(key="axial_max_N", unit=_("max N")),
    )
    return Table(columns=columns, rows=rows)


def _remarks(drive: Drive, file: Path, found: MovingForces) -> Iterator[Remark]:
    import numpy as np

    from cardan.questions.forces.reactions import Held
    from cardan.questions.motion.equivalence import WARN_BEND

    from .answer import Remark, significant
    from .force_tables import balanced

    steepest = float(np.rad2deg(np.max(_bends(found))))
    if steepest > WARN_BEND:
        text = _("Warning: a joint bends {bend:.1f}° on the way; above {limit:g}° no real cross joint works.")
        yield Remark(text=text.format(bend=steepest, limit=WARN_BEND), tone="warning")
    if found.cancelled:
        yield Remark(text=_("Warning: stopped; this is of the turns looked at by then."), tone="warning")
    span = significant(float(found.times[-1] - found.times[0]), 3)
    turns = round(found.turns)
    what = plural("{n} movement", "{n} movements", len(found.movements)).format(n=len(found.movements))
    if found.complete:
        text = _("{what} over {span} s, {turns:.4g} turns of the input, every 5° or closer.")
    else:
        text = _("{what}; {some} of {turns:.0f} turns looked at, evenly spread, every 5°.")
    some = found.turn_times.size
    yield Remark(text=text.format(what=what, span=span, turns=found.turns if found.complete else turns, some=some))
    if int(found.forces.status) == int(Held.INDETERMINATE):
        text = _("Warning: the bearings hold more than statics can tell; they share by stiffness, misfit included.")
        yield Remark(text=text, tone="warning")
    if found.forces.force_left is None:
        yield Remark(text=_("Add [[supports]] to {file} for the loads of bearings.").format(file=file), tone="next")
    yield Remark(text=balanced(found.forces))
    yield Remark(text=_("The same standing still, as drawn:"), command=("cardan", "forces", str(file)), tone="next")


def _trace(drive: Drive, found: MovingForces) -> Table:
    """Return the largest and least of every turn."""
    import numpy as np

    from .answer import Column, Table
    from .asked import size

    forces = found.forces
    named: list[tuple[str, Any]] = [("time_s", found.turn_times)]

    def both(key: str, unit: str, values: Any) -> None:
        low, high = found.each_turn(np.asarray(values))
        named.extend(((f"{key}_min_{unit}", low), (f"{key}_max_{unit}", high)))

    for k, torque in enumerate(forces.shaft_torque, 1):
        both(f"shaft_{k}_torque", "Nm", torque)
        named.append((f"shaft_{k}_bending_max_Nm", found.each_turn(forces.bending_couple[k - 1])[1]))
    for i, loads in enumerate(forces.journals.size, 1):
        if np.isfinite(loads).all():
            named.append((f"joint_{i}_journal_max_N", found.each_turn(np.max(loads, axis=-1))[1]))
        if forces.joint_force is not None:
            named.append((f"joint_{i}_force_max_N", found.each_turn(size(forces.joint_force[i - 1]))[1]))
    for k, thrust in enumerate(forces.spline_thrust, 1):
        both(f"spline_{k}_thrust", "N", thrust)
    if forces.reaction is not None:
        for k, radial in enumerate(forces.radial, 1):
            named.append((f"support_{k}_radial_max_N", found.each_turn(radial)[1]))
            if drive.supports[k - 1].axial:
                both(f"support_{k}_axial", "N", forces.axial[k - 1])
    table = np.stack([np.asarray(values) for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _content(drive: Drive, file: Path, found: MovingForces) -> dict[str, Any]:
    from cardan.questions.forces.reactions import Held
    from cardan.units import rpm

    from .asked import columns_of
    from .show import records

    forces = found.forces
    held = forces.reaction is not None
    supports = [(k, one.name) for k, one in enumerate(drive.supports, 1)]
    return {
        "question": "forces",
        "drive": drive.name,
        "file": str(file),
        "movements": [one.name or one.kind for one in found.movements],
        "speed_rpm": (drive.duty.speed or 0.0) / rpm,
        "torque_Nm": drive.duty.torque,
        "torque_at": drive.duty.torque_at,
        "status": Held(int(forces.status)).name.lower(),
        "turns": found.turns,
        "complete": found.complete and not found.cancelled,
        "shafts": records(_shaft_table(drive, found), [(one.number, one.name) for one in drive.shafts]),
        "joints": records(_joint_table(drive, found), [(i, one.name) for i, one in enumerate(drive.joints, 1)]),
        "supports": records(_support_table(drive, found), supports) if held else [],
        "power_left": forces.power_left.max(),
        "force_left": None if forces.force_left is None else forces.force_left.max(),
        "moment_left": None if forces.moment_left is None else forces.moment_left.max(),
        "assumed": forces.assumed,
        "each_turn": columns_of(_trace(drive, found)),
    }
