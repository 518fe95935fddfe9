"""How a chain of shafts is held: the balance of every shaft, the flexibility of what holds it, as matrices.

The unknowns are the forces in the joint centres, three each, and what the bearings hold: forces across, forces along,
couples across. Each is an action: a force and a couple on one shaft or, in a joint, on two.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.maths.linear import beams
from cardan.maths.linear.systems import least_energy

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
    # per joint, along which of the directions of `Crosses` no force acts; empty when along none
    slides: tuple[tuple[bool, ...], ...] = ()
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


def actions(
    axis: Array,
    length: Array,
    layout: Layout,
    position: Array,
    cut: Array | None = None,
    levered: Callable[[int, Array], tuple[Array, Array]] | None = None,
) -> Actions:
    """Return the unknowns as forces and couples on the shafts.

    axis (..., n+1, 3): directions e_i of the shafts along the power flow; length (..., n+1) [m].
    position (..., k) [m]: places of the bearings from the beginning of their shafts on; they may lie beyond the ends.
    cut (..., number of splines) [m]: places of the splines; the middle of the shafts when not given.
    levered: couples that go with a force in a joint, `KinematicState.levered`; none when not given.
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
            ahead, behind = (zero, zero) if levered is None else levered(i, unit)
            add({i: (-unit, -behind, length[..., i]), i + 1: (unit, ahead, none)})
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


# What parts that do not fit do to each other: forces of assembly in a chain of shafts, as arrays.


@dataclass(frozen=True, eq=False, kw_only=True)
class Crosses:
    """Where the crosses stand, and how they turn with the input; the axes (...) are those of drives and positions."""

    # driving, driven (..., n, 3): arms u_i and v_{i+1}; of other joints two directions in which they are free
    driving: Array
    driven: Array  # (..., n, 3)
    driving_rate: Array  # driving_rate, driven_rate (..., n, 3) [1/rad]: their derivatives by φ_1
    driven_rate: Array  # (..., n, 3) [1/rad]
    # (..., n, 3): a third direction in which a joint is free, and its derivative [1/rad]; None with crosses alone
    across: Array | None = None
    across_rate: Array | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Misalignment:
    """Forces that balance themselves; the axes (...) are those of drives and positions."""

    unknowns: Array  # (..., u) [N]: joint forces and what the bearings hold, in the order of the layout; couples in N·m
    energy: Array  # (...) [J]: what bending and pressing the parts together has stored
    torque: Array  # (...) [N·m]: torque the input needs beside all others to turn against that energy, without friction


def crosses(axis: Array, driving: Array, driven: Array, *, speed: Array | None = None) -> Crosses:
    """Return the arms of the crosses with their rates.

    axis (..., n+1, 3): directions e_i of the shafts; driving, driven (..., n, 3): arms u_i and v_{i+1}.
    speed (..., n+1): ω_i/ω_1, where a joint is none.
    An arm turns with its shaft: u_i' = (ω_i/ω_1) e_i×u_i; ω_{i+1}/ω_i = (e_i·e_{i+1})/|e_{i+1}×u_i|².
    """
    xp = namespace(axis, driving)
    whole = 0.0 * driving
    before, after = axis[..., :-1, :] + whole, axis[..., 1:, :] + whole
    square = frames.cross(after, driving)
    step = frames.dot(before, after) / frames.dot(square, square)
    ratio = [xp.ones_like(step[..., 0])]
    for i in range(step.shape[-1]):
        ratio.append(ratio[-1] * step[..., i])
    turned = xp.stack(ratio, axis=-1)[..., None] if speed is None else speed[..., None]
    swept = turned[..., :-1, :] * frames.cross(before, driving)
    behind = turned[..., 1:, :] * frames.cross(after, driven)
    return Crosses(driving=driving, driven=driven, driving_rate=swept, driven_rate=behind)


def joint_gap(axis: Array, normal: Array, arms: Crosses, error: Array) -> tuple[Array, Array]:
    """Return how far shaft i+1 is off its place in the centre of joint i, before anything gives way.

    axis (..., n+1, 3): directions e_i of the shafts; normal (..., n, 3): normals N_i of the joints' planes.
    arms: where the crosses stand; error (..., n, 5) [m]: s_1, a_1, a_2, a_3, a_4 of each joint.
    Returns gap (..., n, 3) [m]: s_1 z_1 + a_1 x_2 + a_2 x_3 + a_3 x_4 + a_4 x_1 of the loop of axes shaft, journals,
    journals, shaft: where the end of the parts of shaft i lies, seen from the end of shaft i+1; rate
    (..., n, 3) [m/rad]: its derivative by φ_1.

    The common normals of the ideal loop are x_2 = -e_i×u_i, x_3 = u_i×v_{i+1}, x_4 = e_{i+1}×v_{i+1}, x_1 = -N_i:
    the cross turns, x_1 stands still. With the errors free to slide this gap is what the pairs take up, -(s_2 z_2 +
    s_3 z_3 + s_4 z_4), Book (171). Errors of angles change it in the second order only.
    """
    u, v, du, dv = arms.driving, arms.driven, arms.driving_rate, arms.driven_rate
    whole = 0.0 * u
    before, after = axis[..., :-1, :] + whole, axis[..., 1:, :] + whole
    s1, a1, a2, a3, a4 = (error[..., k, None] for k in range(5))
    turning = -a1 * frames.cross(before, u) + a2 * frames.cross(u, v) + a3 * frames.cross(after, v)
    rate = -a1 * frames.cross(before, du) + a2 * (frames.cross(du, v) + frames.cross(u, dv))
    return s1 * before + turning - a4 * normal, rate + a3 * frames.cross(after, dv)


def sliding(layout: Layout, arms: Crosses, *, rate: bool = False) -> Array | None:
    """Return the conditions that no force acts along journals that slide, array (..., slides, u); None without any.

    arms: where the crosses stand; rate: the derivatives by φ_1 instead.
    """
    xp = namespace(arms.driving)
    count = len(layout.unknowns)
    rates = arms.driving_rate, arms.driven_rate, arms.across_rate
    pairs = rates if rate else (arms.driving, arms.driven, arms.across)
    rows = []
    for i, free in enumerate(layout.slides):
        for slides, arm in zip(free, pairs, strict=False):
            if slides and arm is not None:
                none = 0.0 * arm[..., 0, :1]
                before = xp.zeros(3 * i, dtype=xp.float64) + none
                after = xp.zeros(count - 3 * i - 3, dtype=xp.float64) + none
                rows.append(xp.concat((before, arm[..., i, :], after), axis=-1))
    return xp.stack(rows, axis=-2) if rows else None


def conditions(acting: Actions, layout: Layout, arms: Crosses) -> Array:
    """Return all conditions the unknowns meet: balance of the shafts, and no force along what slides."""
    xp = namespace(acting.force)
    rows, free = balance(acting), sliding(layout, arms)
    if free is None:
        return rows
    outer = free.shape[:-2]
    return xp.concat((xp.broadcast_to(rows, (*outer, *rows.shape[-2:])), free), axis=-2)


def misalignment(
    acting: Actions, layout: Layout, arms: Crosses, compliance: Array, gap: tuple[Array, Array], housing: Array
) -> Misalignment:
    """Return the forces that parts which do not fit put on each other.

    acting: the unknowns; its arrays have the axes of the drives, and one or none for the positions.
    arms: where the crosses stand, (..., n, 3); compliance (..., u, u) [m/N]: how bearings and shafts give way.
    gap (array (..., n, 3) [m], array (..., n, 3) [m/rad]): what is off in the joints, and its derivative by φ_1.
    housing (..., u) [m]: how far each bearing's housing is off in the direction of its unknown; 0 for the joints.
    The stationary value of L = d·X - ½ X·C X - y·A X is the stored energy, so the torque is dU/dφ_1 = X·d' - y·A'X:
    the gaps turn with the crosses, and so do the directions in which they slide.
    """
    xp = namespace(acting.force, arms.driving)
    off, rate = gap
    outer = off.shape[:-2]
    rest = xp.zeros((*outer, len(layout.unknowns) - 3 * layout.joints), dtype=xp.float64)

    def joined(joints: Array) -> Array:
        return xp.concat((xp.reshape(joints, (*outer, 3 * layout.joints)), rest), axis=-1)

    matrix = conditions(acting, layout, arms)
    given = joined(off) + housing
    load = xp.zeros(matrix.shape[-2], dtype=xp.float64)
    found, give = least_energy(matrix, load, compliance, given)
    torque = frames.dot(joined(rate), found)
    turned = sliding(layout, arms, rate=True)
    if turned is not None:
        along = xp.matmul(turned, found[..., None])[..., 0]
        torque = torque - frames.dot(give[..., -turned.shape[-2] :], along)
    return Misalignment(unknowns=found, energy=0.5 * frames.dot(given, found), torque=torque)
