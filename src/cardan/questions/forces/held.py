"""How a chain of shafts is held: the balance of every shaft, the flexibility of what holds it, as matrices.

The unknowns are the forces in the joint centres, three each, and what the bearings hold: forces across, forces along,
couples across. Each is an action: a force and a couple on one shaft or, in a joint, on two.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.maths.linear import beams

Hold: TypeAlias = Literal["radial", "axial", "tilt"]

HOLDS: tuple[Hold, ...] = ("radial", "axial", "tilt")

WIDTH: dict[Hold, int] = {"radial": 2, "axial": 1, "tilt": 2}
"""How many unknowns a bearing adds by what it holds."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Layout:
    """What holds what, without a number: the same for a whole batch."""

    joints: int  # number of joints n
    # tuple of (int, tuple of Hold): shaft of each bearing, counted from 0, and what it holds
    bearings: tuple[tuple[int, tuple[Hold, ...]], ...]
    # per joint, whether the cross slides along the driving and the driven journals; empty when none does
    slides: tuple[tuple[bool, bool], ...] = ()
    splines: tuple[int, ...] = ()  # shafts with a spline that slides, counted from 0

    @property
    def unknowns(self) -> tuple[tuple[int, Hold | None], ...]:
        """Owner of each unknown: (joint, None) for its force, (bearing, hold) for what a bearing holds."""
        forces: list[tuple[int, Hold | None]] = [(i, None) for i in range(self.joints) for _axis in range(3)]
        for k, (_shaft, holds) in enumerate(self.bearings):
            forces += [(k, hold) for hold in holds for _axis in range(WIDTH[hold])]
        return tuple(forces)

    def columns(self, bearing: int, hold: Hold) -> slice:
        """Return where the unknowns of what a bearing holds stand."""
        owners = self.unknowns
        first = owners.index((bearing, hold))
        return slice(first, first + WIDTH[hold])


@dataclass(frozen=True, eq=False, kw_only=True)
class Actions:
    """The unknowns as forces and couples on the shafts, per unit of each."""

    axis: Array  # (..., s, 3): directions of the shafts
    across: Array  # (..., s, 2, 3): two directions across each shaft
    length: Array  # (..., s) [m]: lengths of the shafts
    force: Array  # force, couple (..., s, u, 3): on every shaft, of every unknown
    couple: Array  # (..., s, u, 3)
    place: Array  # (..., s, u) [m]: where it acts, from the beginning of the shaft on
    cut: dict[int, Array]  # dict from int to array (...) [m]: places of splines by their shaft, counted from 0


def actions(axis: Array, length: Array, layout: Layout, position: Array, cut: Array | None = None) -> Actions:
    """Return the unknowns as forces and couples on the shafts.

    axis (..., n+1, 3): directions e_i of the shafts along the power flow; length (..., n+1) [m].
    position (..., k) [m]: places of the bearings from the beginning of their shafts on; they may lie beyond the ends.
    cut (..., number of splines) [m]: places of the splines; the middle of the shafts when not given.
    """
    xp = namespace(axis, length, position)
    n = layout.joints
    zero = 0.0 * axis[..., 0, :]
    none = 0.0 * length[..., 0]
    aside = frames.perpendicular(axis)
    across = xp.stack((aside, frames.cross(axis, aside)), axis=-2)
    force: list[list[Array]] = [[] for _shaft in range(n + 1)]
    couple: list[list[Array]] = [[] for _shaft in range(n + 1)]
    place: list[list[Array]] = [[] for _shaft in range(n + 1)]

    def add(on: dict[int, tuple[Array, Array, Array]]) -> None:
        for s in range(n + 1):
            pull, turn, where = on.get(s, (zero, zero, none))
            force[s].append(pull)
            couple[s].append(turn)
            place[s].append(where)

    for i in range(n):
        for k in range(3):
            unit = xp.stack([none + (1.0 if k == m else 0.0) for m in range(3)], axis=-1)
            add({i: (-unit, zero, length[..., i]), i + 1: (unit, zero, none)})
    for k, (shaft, holds) in enumerate(layout.bearings):
        sides = [across[..., shaft, 0, :], across[..., shaft, 1, :]]
        where = position[..., k]
        for hold in holds:
            for way in sides if hold != "axial" else [axis[..., shaft, :]]:
                add({shaft: (zero, way, where) if hold == "tilt" else (way, zero, where)})
    cuts = {shaft: 0.5 * length[..., shaft] if cut is None else cut[..., k] for k, shaft in enumerate(layout.splines)}
    return Actions(
        axis=axis,
        across=across,
        length=length,
        force=xp.stack([xp.stack(rows, axis=-2) for rows in force], axis=-3),
        couple=xp.stack([xp.stack(rows, axis=-2) for rows in couple], axis=-3),
        place=xp.stack([xp.stack(rows, axis=-1) for rows in place], axis=-2),
        cut=cuts,
    )


def balance(acting: Actions) -> Array:
    """Return the matrix of the balance of every shaft, array (..., 5 s + splines, u).

    Rows of each shaft: forces along its two cross directions and along its axis, moments about the two directions
    through its beginning, these over the mean length of the shafts so that all rows are of order one. A spline parts
    the balance along the axis: the part behind it comes as a row of its own at the end.
    """
    xp = namespace(acting.force)
    e = acting.axis[..., None, :]
    moment = acting.couple + acting.place[..., None] * frames.cross(e + 0.0 * acting.force, acting.force)
    size = xp.mean(acting.length, axis=-1)[..., None, None, None]
    sideways = xp.matmul(acting.across, xp.matrix_transpose(acting.force))
    turning = xp.matmul(acting.across, xp.matrix_transpose(moment)) / size
    along = frames.dot(acting.force, e + 0.0 * acting.force)
    ahead, behind = [], []
    for s in range(acting.axis.shape[-2]):
        row = along[..., s, :]
        if s in acting.cut:
            first = acting.place[..., s, :] < acting.cut[s][..., None]
            behind.append(xp.where(first, 0.0, row)[..., None, :])
            row = xp.where(first, row, 0.0)
        ahead.append(row)
    blocks = xp.concat((sideways, xp.stack(ahead, axis=-2)[..., None, :], turning), axis=-2)
    rows = xp.reshape(blocks, (*blocks.shape[:-3], 5 * blocks.shape[-3], blocks.shape[-1]))
    return xp.concat((rows, *behind), axis=-2)


def shaft_flexibility(acting: Actions, bending: Array, stretching: Array, stretch_start: Array | None = None) -> Array:
    """Return how shafts give way to the unknowns, array (..., u, u) [m/N].

    bending (..., n+1, s) [1/(N m²)]: 1/EI of each stretch of each shaft; 0 where it is rigid.
    stretching (..., n+1, s) [1/N]: 1/EA of each stretch of each shaft; 0 where it is rigid.
    stretch_start (..., n+1, s) [m]: where each stretch begins, from the beginning of its shaft.
    """
    xp = namespace(acting.force)
    total = 0.0
    for s in range(acting.axis.shape[-2]):
        parts = acting.axis[..., s, :], acting.place[..., s, :], acting.force[..., s, :, :]
        end = xp.max(acting.place[..., s, :], axis=-1)
        for since, soft, slack in stretches(bending, stretching, stretch_start, s):
            bent = beams.bending(*parts, acting.couple[..., s, :, :], end, since)
            pulled = beams.stretching(*parts, end, acting.cut.get(s), since)
            total = total + soft[..., None, None] * bent + slack[..., None, None] * pulled
    return total


def stretches(
    bending: Array, stretching: Array, stretch_start: Array | None, shaft: int
) -> Iterator[tuple[Array | None, Array, Array]]:
    """Yield from where on a shaft gives way by how much more than before: place, 1/EI and 1/EA, arrays (...).

    A stepped shaft is a uniform one with the stiffness of its first stretch, plus what each step adds from there on.
    """
    yield None, bending[..., shaft, 0], stretching[..., shaft, 0]
    for k in range(1, bending.shape[-1]):
        assert stretch_start is not None
        more = (values[..., shaft, k] - values[..., shaft, k - 1] for values in (bending, stretching))
        yield stretch_start[..., shaft, k], *more
