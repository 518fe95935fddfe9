"""What the ball bearings of the supports go through in a turn: forces, equivalent loads, and the life they leave."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import key_of
from cardan.errors import InputError
from cardan.formulas.ball_bearing import POWER, ball_life, equivalent_load, static_load
from cardan.maths.arrays import Array
from cardan.questions.forces.forces import Forces, forces
from cardan.questions.forces.moving_forces import moving_forces
from cardan.texts import _

from .joint_bearings import Missing


@dataclass(frozen=True, eq=False, kw_only=True)
class SupportLoads:
    """Loads of the ball bearings of supports; leading axes (...) are those of the parts of the duty."""

    radial: Array  # radial, axial, static (..., m) [N]: largest forces, and largest equivalent load at rest P_0
    axial: Array
    static: Array
    load: Array  # (..., m) [N]: constant equivalent load P that damages as much
    life: Array  # (..., m) [s]: a_1 L_10


@dataclass(frozen=True, eq=False, kw_only=True)
class SupportLives:
    """The ball bearings of supports in each part of a duty, their loads with the factor for shocks."""

    number: tuple[int, ...]  # (m,): of the supports that have one
    capacity: Array  # capacity, static_capacity (m,) [N]: C and C_0, nan where this is not given
    static_capacity: Array
    loads: SupportLoads  # (b, m)


def rated_supports(drive: Drive) -> tuple[tuple[int, ...], tuple[Missing, ...]]:
    """Return the supports whose bearings can be rated, from 0, and what keeps others from it."""
    found, missing = [], []
    for k, one in enumerate(drive.supports):
        if one.capacity is None:
            continue
        if one.tilt:
            text = _("the bearing of support {number} is not rated, as it holds the slope of its shaft too")
            missing.append(Missing(field=f"supports[{k}].tilt", message=text.format(number=k + 1), key=False))
        elif one.axial and one.static_capacity is None:
            text = _("missing; without it ISO 281 cannot rate the bearing of support {number} under axial force")
            missing.append(Missing(field=f"supports[{k}].static_capacity", message=text.format(number=k + 1)))
        else:
            found.append(k)
    return tuple(found), tuple(missing)


def capacities(drive: Drive, which: Sequence[int]) -> tuple[Array, Array]:
    """Return C and C_0 of the bearings of supports, counted from 0, two arrays (m,) [N]; nan where not given."""
    own = [drive.supports[k] for k in which]
    dynamic, static = ([getattr(one, name) for one in own] for name in ("capacity", "static_capacity"))
    return np.asarray(dynamic, dtype=float), np.asarray(static, dtype=float)


def support_loads(drive: Drive, which: Sequence[int], shock: float, *, factor: float) -> SupportLoads | str:
    """Return the loads of the bearings of supports over the turns of a drive in one condition, or why they lack.

    drive: with one way of running as its duty; while it moves, over its movements.
    which (m,): supports, counted from 0; shock: factor on the forces; factor: a_1.
    The damage of an instant is |ω| P^3, ω the speed of the shaft; splines that slide both ways do so by halves.
    """
    try:
        one = moving_forces(drive).forces if drive.movements else forces(drive)
    except InputError as error:
        text = _("the bearings of the supports are not rated, as their forces are not known: {why}")
        return text.format(why="; ".join(f"{key_of(each.field)}: {each.message}" for each in error.problems))
    ways = [one] if one.reverse is None else [one, one.reverse]
    dynamic, static = capacities(drive, which)
    rows = [_each(way, drive, which, shock, closed=not drive.movements) for way in ways]
    radial, axial, speed = (np.concatenate([row[k] for row in rows], axis=-1) for k in range(3))
    load = equivalent_load(radial, axial, static[:, None])
    turning = np.mean(speed, axis=-1)
    same = (np.mean(speed * load**POWER, axis=-1) / turning) ** (1.0 / POWER)
    return SupportLoads(
        radial=np.max(radial, axis=-1),
        axial=np.max(axial, axis=-1),
        static=np.max(static_load(radial, axial), axis=-1),
        load=same,
        life=factor * ball_life(dynamic, same, speed=turning),
    )


def _each(found: Forces, drive: Drive, which: Sequence[int], shock: float, *, closed: bool) -> tuple[Array, ...]:
    """Return radial and axial forces of supports and the speeds of their shafts, arrays (m, p); none twice."""
    rows, shafts = list(which), [drive.supports[k].shaft - 1 for k in which]
    along = np.asarray([[drive.supports[k].axial] for k in which])
    end = -1 if closed else None
    tables = (shock * found.radial[rows], shock * along * np.abs(found.axial[rows]), np.abs(found.speed[shafts]))
    return tuple(np.asarray(one)[..., :end] for one in tables)
