"""The tables of ``cardan forces``: what shafts, joints and supports carry at most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.drive.joints.joint import Joint
    from cardan.questions.forces.forces import Forces

    from .answer import Cell, Table


def both(found: Forces) -> tuple[Forces, ...]:
    """Return the answer, and that with the splines sliding the other way, where there is one."""
    return (found,) if found.reverse is None else (found, found.reverse)


def balanced(found: Forces) -> str:
    """Return how closely all balances hold."""
    from cardan.figures.wording import closely

    if found.force_left is None or found.moment_left is None:
        return _("Power balance checked: it closes {closely}.").format(closely=closely(float(found.power_left.max())))
    rest = max(float(part.max()) for part in (found.power_left, found.force_left, found.moment_left))
    return _("Balances of power, forces and moments checked: they close {closely}.").format(closely=closely(rest))


def tables(drive: Drive, found: Forces) -> list[Table]:
    """Return the tables for the terminal; those that would be empty are left out."""
    shown = [shaft_table(drive, found)]
    joints = joint_table(drive, found)
    if any(cell is not None for row in joints.rows for cell in row[1:]):
        shown.append(joints)
    if found.reaction is not None:
        shown.append(support_table(drive, found))
    return shown


def shaft_table(drive: Drive, found: Forces) -> Table:
    """Return torque and bending of every shaft."""
    from cardan.maths.curves.over_turn import harmonics

    from .answer import Column, Table, named
    from .asked import degrees, tidy, turn

    torque, bent = turn(found.angle, found.shaft_torque), turn(found.angle, found.bending_couple)
    twice = harmonics(found.angle, tidy(found.shaft_torque)).amplitude[:, 2]
    rows = [
        (
            named(shaft.number, shaft.name or end(shaft.number, len(drive.shafts))),
            float(torque.low[k]),
            float(torque.high[k]),
            float(tidy([twice[k], torque.high[k]])[0]),
            float(bent.high[k]),
            degrees(bent.high_angle[k]) if bent.high[k] > 0.0 else None,
        )
        for k, shaft in enumerate(drive.shafts)
    ]
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="torque_min_Nm", heading=_("torque"), unit=_("min N·m")),
        Column(key="torque_max_Nm", unit=_("max N·m")),
        Column(key="torque_order_2_Nm", heading=_("order 2"), unit="± N·m"),
        Column(key="bending_max_Nm", heading=_("bent"), unit=_("max N·m")),
        Column(key="bending_max_at_deg", unit=_("at °"), form=".1f"),
    )
    return Table(columns=columns, rows=rows)


def end(number: int, shafts: int) -> str:
    """Return what a shaft without a name is called."""
    return _("input") if number == 1 else _("output") if number == shafts else ""


def joint_table(drive: Drive, found: Forces) -> Table:
    """Return the loads in the centre and in the journals of every joint, and its heat."""
    import numpy as np

    from .answer import Column, Table, named
    from .asked import ROUNDING, size

    sides = found.journals.size
    held = found.joint_force is not None
    force = np.max([size(one.joint_force).max(axis=-1) for one in both(found)], axis=0) if held else None
    if force is not None:
        scale = np.max([_journal(one) for one in both(found)])
        force = np.where(force <= ROUNDING * scale, 0.0, force)
    largest = [np.max([_journal(one)[k] for one in both(found)], axis=0) for k in (0, 1)]
    heat = _mean_heat(drive, found)
    rows = [
        (
            named(i + 1, joint.name),
            None if force is None else float(force[i]),
            float(largest[0][i]) if np.isfinite(sides[i]).all() else None,
            float(largest[1][i]) if np.isfinite(sides[i]).all() else None,
            heat[i],
        )
        for i, joint in enumerate(drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="force_max_N", heading=_("centre"), unit=_("max N")),
        Column(key="driving_journal_max_N", heading=_("journals of"), unit=_("driving yoke N")),
        Column(key="driven_journal_max_N", unit=_("driven yoke N")),
        Column(key="heat_mean_W", heading=_("heat"), unit=_("mean W")),
    )
    return Table(columns=columns, rows=rows)


def _journal(found: Forces) -> tuple[Any, Any]:
    """Return the largest load of the journals in the driving and in the driven yoke of each joint, arrays (n,) [N]."""
    import numpy as np

    size = np.nan_to_num(found.journals.size)
    return np.max(size[..., :2], axis=(-1, -2)), np.max(size[..., 2:], axis=(-1, -2))


def rubs(joint: Joint) -> bool:
    """Return whether friction in the journals of a joint counts."""
    given = joint.friction is not None or joint.material_friction is not None
    return given and joint.cross is not None and None not in (joint.cross.span, joint.cross.journal)


def _mean_heat(drive: Drive, found: Forces) -> list[float | None]:
    """Return the mean heat of each joint [W]; None where the drive does not say how fast it turns or how it rubs."""
    import numpy as np

    mean = np.mean(found.loss[:, :-1], axis=-1)
    known = "duty.speed" not in found.assumed
    return [float(one) if known and rubs(joint) else None for one, joint in zip(mean, drive.joints, strict=True)]


def support_table(drive: Drive, found: Forces) -> Table:
    """Return radial force, axial force and couple of every support, of both ways of sliding."""
    import numpy as np

    from cardan.maths.ties import foremost

    from .answer import Column, Table, named
    from .asked import ROUNDING, degrees, size, tidy, turn

    ways = both(found)
    across = [turn(one.angle, one.radial) for one in ways]
    along = [turn(one.angle, along_axis(one)) for one in ways]
    high = np.max([one.high for one in across], axis=0)
    low = np.min([one.low for one in across], axis=0)
    low = np.where(low <= ROUNDING * high, 0.0, low)
    push, pull = np.min([one.low for one in along], axis=0), np.max([one.high for one in along], axis=0)
    tilted = any(one.tilt for one in drive.supports)
    couple = tidy(np.max([size(one.support_couple).max(axis=-1) for one in ways], axis=0))
    rows: list[list[Cell]] = []
    for k, support in enumerate(drive.supports):
        place = across[int(foremost([float(one.high[k]) for one in across]))].high_angle[k]
        row: list[Cell] = [
            named(k + 1, support.name),
            support.shaft,
            float(low[k]) if support.radial else None,
            float(high[k]) if support.radial else None,
            degrees(place) if support.radial and high[k] > 0.0 else None,
            float(push[k]) if support.axial else None,
            float(pull[k]) if support.axial else None,
        ]
        rows.append([*row, float(couple[k]) if support.tilt else None] if tilted else row)
    columns = [
        Column(key="support", heading=_("support"), left=True),
        Column(key="shaft", heading=_("shaft")),
        Column(key="radial_min_N", heading=_("radial"), unit=_("min N")),
        Column(key="radial_max_N", unit=_("max N")),
        Column(key="radial_max_at_deg", unit=_("at °"), form=".1f"),
        Column(key="axial_min_N", heading=_("axial"), unit=_("min N")),
        Column(key="axial_max_N", unit=_("max N")),
    ]
    if tilted:
        columns.append(Column(key="couple_max_Nm", heading=_("couple"), unit=_("max N·m")))
    return Table(columns=tuple(columns), rows=rows)


def along_axis(found: Forces) -> Any:
    """Return the axial reactions; beside the radial ones, what is nothing but rounding is zero."""
    import numpy as np

    from .asked import ROUNDING, size

    axial = np.asarray(found.axial)
    return np.where(np.abs(axial) <= ROUNDING * np.max(size(found.reaction), initial=0.0), 0.0, axial)
