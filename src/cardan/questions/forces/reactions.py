"""What the supports and the joints of a drive hold: the balance of every shaft, solved for all forces at once.

Of the unknowns and the matrix of the balance see `forces.held`; here are the loads, the solution, and what is
left of the balance when everything is summed up again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.dynamics_model import Train, place_of, train
from cardan.drive.models.machine_held import machine_held
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import frames
from cardan.maths.linear.systems import RANK, broadcast_shapes, solve_regular, surplus

from .kinetostatics import Couples, KinematicState, seen_by, standing, swing_need
from .support_statics import Actions, Crosses, Layout, actions, balance, crosses, sliding

STEP = 1e-3
"""Step [rad] of the differences by which directions are derived: what they leave out is 1e-12 of them."""


class Determinacy(IntEnum):
    """Whether the supports hold a drive just enough."""

    DETERMINATE = 0
    LOOSE = 1
    INDETERMINATE = 2


@dataclass(frozen=True, eq=False, kw_only=True)
class Load:
    """Known forces on the shafts, as they act at places of their own."""

    shaft: int  # which one, counted from 0
    force: Array  # (..., p or 1, 3) [N]
    place: Array  # (..., p or 1) [m]: where, from the beginning of the shaft
    behind: bool | None = None  # whether on the part of its shaft behind the spline; by its place where None


@dataclass(frozen=True, eq=False, kw_only=True)
class Frame:
    """How a drive is held: its layout and where everything acts; lead axes (..., p or 1)."""

    layout: Layout  # what holds what
    acting: Actions  # the unknowns as forces and couples
    matrix: Array  # (..., p or 1, rows, unknowns): balance of the shafts, then no force along journals that slide
    points: Array  # (..., p or 1, n+2, 3) [m]: B_0 … B_{n+1}
    starts: Array  # (..., p or 1, n+1, 3) [m]: where the shafts begin
    place: Array  # (..., p or 1, k) [m]: places of the supports, from there on
    # (..., n, 3): first, second and third direction in which each joint is free; none where no joint is
    ways: tuple[Array | None, ...] = ()

    @property
    def slides(self) -> int:
        """How many conditions say that no force acts along a journal."""
        return sum(sum(pair) for pair in self.layout.slides)

    @property
    def equations(self) -> int:
        """Number of equations of balance, 5(n+1) and one for each spline."""
        return int(self.matrix.shape[-2]) - self.slides

    @property
    def unknowns(self) -> int:
        """Number of unknown forces and couples, those that a sliding journal excludes left out."""
        return int(self.matrix.shape[-1]) - self.slides


def layout_of(train: Train) -> Layout:
    """Return what holds what in a train."""
    return Layout(joints=train.joints, bearings=train.bearings, slides=train.slides, splines=train.splines)


def frame(train: Train, stand: KinematicState, points: Array) -> Frame:
    """Return how a train is held.

    train (...): supports and splines; stand (..., p); points (..., p or 1, n+2, 3) [m]: B_0 … B_{n+1}.
    """
    xp = namespace(points)
    layout = layout_of(train)
    starts = points[..., :-1, :]
    position = xp.zeros(0, dtype=xp.float64) if train.position is None else train.position
    outer = tuple(stand.axis.shape[:-2])
    place = xp.broadcast_to(position[..., None, :], (*outer, position.shape[-1]))
    if stand.head is not None:
        place = _standing_places(train, stand, place)
        starts = xp.concat((starts[..., :1, :], starts[..., 1:, :] + stand.head), axis=-2)
    length = frames.norm(points[..., 1:, :] - starts)
    levered = None if stand.head is None else stand.levered
    acting = actions(stand.axis, length, layout, place, _cut(train), levered)
    rows = balance(acting)
    arms = arms_of(train, stand) if any(map(any, layout.slides)) else None
    free = None if arms is None else sliding(layout, arms)
    ways = () if arms is None else (arms.driving, arms.driven, arms.across)
    if free is not None:
        outer = broadcast_shapes(rows.shape[:-2], free.shape[:-2])
        rows = xp.concat(
            (xp.broadcast_to(rows, (*outer, *rows.shape[-2:])), xp.broadcast_to(free, (*outer, *free.shape[-2:]))),
            axis=-2,
        )
    return Frame(layout=layout, acting=acting, matrix=rows, points=points, starts=starts, place=place, ways=ways)


def _standing_places(train: Train, stand: KinematicState, drawn: Array) -> Array:
    """Return how far from where their shafts begin the supports stand, on shafts that wobble; drawn (p, k) [m]."""
    assert stand.head is not None
    assert stand.rest is not None
    rows = []
    for k, (s, _holds) in enumerate(train.bearings):
        place = drawn[..., k]
        if s:
            e = stand.axis[..., s, :]
            from_start = place[..., None] * stand.rest[s] - stand.head[..., s - 1, :]
            place = frames.dot(from_start if stand.shift is None else from_start - stand.shift[..., s - 1, :], e)
        rows.append(place)
    return np.stack(rows, axis=-1)


def arms_of(train: Train, stand: KinematicState, *, rates: bool = False) -> Crosses:
    """Return the arms of the crosses of a train, of other joints the directions in which they are free.

    rates: with the derivatives of these directions, the axes at rest; else they are left out.
    """
    if all(train.crossed):
        return crosses(stand.axis, stand.driving_arm, stand.driven_arm)
    speed = stand.speed / stand.speed[..., :1]
    found = crosses(stand.axis, stand.driving_arm, stand.driven_arm, speed=speed)
    none = 0.0 * found.driving
    ways = [np.array(found.driving), np.array(found.driven), none.copy()]
    turned = [np.array(found.driving_rate), np.array(found.driven_rate), none.copy()]
    for i, joint in enumerate(train.kinds):
        if train.crossed[i]:
            continue
        free = _freed(train, stand, i, 0.0)
        change = _freed_rate(train, stand, i) * speed[..., i, None, None] if rates and joint.free_ways else 0.0 * free
        for k in range(3):
            held = k >= joint.free_ways
            ways[k][..., i, :] = 0.0 if held else free[..., k, :]
            turned[k][..., i, :] = 0.0 if held else change[..., k, :]
    return Crosses(
        driving=ways[0],
        driven=ways[1],
        driving_rate=turned[0],
        driven_rate=turned[1],
        across=ways[2],
        across_rate=turned[2],
    )


def _freed(train: Train, stand: KinematicState, i: int, ahead: float) -> Array:
    """Return the directions in which joint i is free with its driving mark turned ahead [rad], (..., p, k, 3)."""
    normal, aside, theta, alpha, before = seen_by(train, stand, i)
    found = train.kinds[i].freed(theta + ahead, alpha)
    basis = np.stack(np.broadcast_arrays(before, aside, normal), axis=-2)
    return np.asarray(found @ basis)


def _freed_rate(train: Train, stand: KinematicState, i: int) -> Array:
    """Return how they change with the angle of the mark, (..., p, k, 3) [1/rad], but for turns among themselves.

    By differences of the projector P on them, of fourth order: v' = P' v.
    """
    two, one, other, far = (
        np.swapaxes(ways, -1, -2) @ ways for ways in (_freed(train, stand, i, k * STEP) for k in (2, 1, -1, -2))
    )
    change = (8.0 * (one - other) - (two - far)) / (12.0 * STEP)
    return np.asarray(_freed(train, stand, i, 0.0) @ change)


def _cut(train: Train) -> Array | None:
    return None if train.cut is None or not train.splines else train.cut[..., None, :]


def weights(train: Train, frame: Frame, stand: KinematicState, acceleration: Array | None) -> list[Load]:
    """Return weight and inertia force of shafts and crosses.

    frame: where the points lie.
    acceleration (p, n+2, 3) [m/s²]: of the points; None where they stand still.
    The weight of a cross counts on its driving shaft, at the joint; a shaft's mass stays at its place from the joint
    before it, on the input shaft from joint 1. A splined shaft is two bodies: the one behind its spline keeps its
    place from the joint behind it, where its acceleration along the shaft is L̈ - (L - L0)|ȧ|² more.
    """
    xp = namespace(frame.points)
    loads: list[Load] = []
    if train.gravity is None:
        return loads
    gravity = xp.asarray(train.gravity)
    if train.mass is not None and train.centre_of_mass is not None:
        drawn = frames.norm(train.points[..., 1:, :] - train.points[..., :-1, :])
        for i in range(train.joints + 1):
            mass, centre = train.mass[..., None, i], train.centre_of_mass[..., None, i]
            if i and stand.ahead is not None:
                centre = centre - stand.ahead[i - 1]
            parts: list[tuple[Array, Array, bool | None]] = [(mass, centre, None)]
            if i in train.splines and train.behind is not None:
                heavy, far, _inertia = (train.behind[..., None, train.splines.index(i), k] for k in range(3))
                left = mass - heavy
                near = xp.where(left > 0.0, (mass * centre - heavy * far) / xp.where(left > 0.0, left, 1.0), centre)
                parts = [(left, near, False), (heavy, far, True)]
            for amount, place, behind in parts:
                start, ahead = (1 if i == 0 else i), (place - drawn[..., None, 0] if i == 0 else place)
                if behind:
                    start, ahead = i + 1, place - drawn[..., None, i]
                slides = behind or (i == 0 and stand.shift is not None and behind is None)  # with the joint behind it
                if i == 0 and stand.shift is not None and behind is False:
                    start = 0
                where = frame.acting.length[..., i] + ahead if slides else place
                pull = gravity
                if acceleration is not None:
                    if stand.axis_acceleration is None:
                        raise AssertionError
                    pull = gravity - acceleration[..., start, :] - ahead[..., None] * stand.axis_acceleration[..., i, :]
                    if stand.head_acceleration is not None and i and not behind:
                        pull = pull - stand.head_acceleration[..., i - 1, :]
                loads.append(Load(shaft=i, force=amount[..., None] * pull, place=where, behind=behind))
    if train.cross_mass is not None:
        for i in range(train.joints):
            pull = gravity if acceleration is None else gravity - acceleration[..., i + 1, :]
            force = train.cross_mass[..., None, i, None] * pull
            loads.append(Load(shaft=i, force=force, place=frame.acting.length[..., i]))
    return loads


def pulled(frame: Frame, stand: KinematicState, loads: list[Load], crosses: int, thrust: Array) -> Array:
    """Return the power of weights, inertia forces and friction thrusts on shafts that wobble, array (..., p) [W].

    loads: of `weights`, those of the crosses, so many, last; thrust (..., p, number of splines) [N]: of `thrusts`.
    Nothing else that acts along or across a shaft does work: supports stand still, joint forces meet each other.
    """
    assert stand.head_rate is not None
    assert stand.point_rate is not None
    assert stand.axis_rate is not None
    power = 0.0 * stand.speed[..., 0]
    length, points = frame.acting.length, stand.point_rate
    for k, load in enumerate(loads):
        i = load.shaft
        if k >= len(loads) - crosses:
            rate = points[..., i + 1, :]
        elif i == 0:
            rate = points[..., 0 if load.behind is False else 1, :]
        elif load.behind:
            rate = points[..., i + 1, :] + (load.place - length[..., i])[..., None] * stand.axis_rate[..., i, :]
        else:
            rate = points[..., i, :] + stand.head_rate[..., i - 1, :]
            rate = rate + load.place[..., None] * stand.axis_rate[..., i, :]
        power = power + frames.dot(load.force, rate)
    for k, s in enumerate(frame.layout.splines):
        none = 0.0 * stand.axis[..., s, :]
        rear = none if s == points.shape[-2] - 2 else points[..., s + 1, :]
        front = none if s == 0 else points[..., s, :] + stand.head_rate[..., s - 1, :]
        power = power + thrust[..., k] * frames.dot(rear - front, stand.axis[..., s, :])
    return power


def shoves(
    train: Train,
    frame: Frame,
    stand: KinematicState,
    torque: Array,
    forces: Sequence[Array | None],
    pushed: Sequence[Array | None] | None = None,
) -> list[Array]:
    """Return the known forces along all that slides, each (..., p) [N], in the order of `support_statics.sliding`.

    torque (..., p, n) [N·m]: of the driven shaft of each joint, with which a joint pushes it.
    forces: what friction within each joint and its stiffness add to that, (..., p, 3) [N]; None without any.
    pushed: of `pushes`, for who asks for several torques.
    """
    if pushed is None:
        pushed = pushes(train, frame, stand)
    rows: list[Array] = []
    for i, free in enumerate(frame.layout.slides):
        known = _known_force(pushed[i], torque[..., i], forces[i])
        for slides, way in zip(free, frame.ways, strict=False):
            if slides:
                still = 0.0 * stand.speed[..., i]
                rows.append(still if known is None or way is None else frames.dot(known, way[..., i, :]))
    return rows


def pushes(train: Train, frame: Frame, stand: KinematicState) -> list[Array | None]:
    """Return the force (..., p, 3) [1/m] with which each joint pushes its driven shaft for 1 N·m on this.

    None for one that pushes with none, or whose shafts do not slide.
    """
    found: list[Array | None] = []
    for i, free in enumerate(frame.layout.slides):
        size = None
        if any(free) and train.kinds and not train.crossed[i]:
            normal, aside, theta, alpha, before = seen_by(train, stand, i)
            size = train.kinds[i].push(theta, alpha)
        found.append(
            None if size is None else sum(size[..., k, None] * way for k, way in enumerate((before, aside, normal)))
        )
    return found


def _known_force(push: Array | None, torque: Array, added: Array | None) -> Array | None:
    """Return the force (..., p, 3) [N] that a joint puts on its driven shaft by itself; None where it puts none."""
    if push is None:
        return added
    return torque[..., None] * push if added is None else torque[..., None] * push + added


def thrusts(train: Train, stand: KinematicState, couples: Couples, sense: Array | None = None) -> Array:
    """Return the friction thrust of every spline, array (..., p, number of splines) [N]; positive pushes apart.

    2 μ|τ|/d, Book (123), with the torque at the spline: what enters the shaft, less what turns the part before it; a
    torque that resists the shaft counts behind it.
    """
    xp = namespace(couples.shaft_torque)
    if train.grip is None or train.sliding is None or not train.splines:
        return xp.zeros((*couples.shaft_torque.shape[:-1], 0), dtype=xp.float64)
    way = train.sliding[..., None, :] if sense is None else sense
    torque = xp.stack([couples.shaft_torque[..., s] for s in train.splines], axis=-1)
    if train.inertia is not None and train.behind is not None:
        whole = xp.stack([train.inertia[..., s] for s in train.splines], axis=-1)
        gain = xp.stack([stand.acceleration[..., s] for s in train.splines], axis=-1)
        torque = torque - (whole - train.behind[..., 2])[..., None, :] * gain
    return way * train.grip[..., None, :] * xp.abs(torque)


def right_side(frame: Frame, secondary: Array, loads: list[Load], thrust: Array, shoved: Sequence[Array] = ()) -> Array:
    """Return the known side of the balance, array (..., p, rows), in the order of `held.balance`.

    shoved: of `shoves`; nothing pushes along what slides when empty.
    """
    xp = namespace(secondary, thrust)
    acting = frame.acting
    size = xp.mean(acting.length, axis=-1)
    ahead, behind = [], []
    for s in range(acting.axis.shape[-2]):
        e, across = acting.axis[..., s, :], acting.across[..., s, :, :]
        moment = secondary[..., s, :]
        force = 0.0 * moment
        first = 0.0 * moment[..., 0]
        second = first
        for load in loads:
            if load.shaft != s:
                continue
            force = force + load.force
            moment = moment + load.place[..., None] * frames.cross(e + 0.0 * load.force, load.force)
            along = frames.dot(load.force, e)
            if s in acting.cut:
                before = load.place < acting.cut[s] if load.behind is None else xp.asarray(not load.behind)
                first = first + xp.where(before, along, 0.0)
                second = second + xp.where(before, 0.0, along)
            else:
                first = first + along
        if s in acting.cut:
            push = thrust[..., frame.layout.splines.index(s)]
            first, second = first - push, second + push
            behind.append(-second)
        turn = [frames.dot(across[..., k, :], moment) / size for k in range(2)]
        shove = [frames.dot(across[..., k, :], force) for k in range(2)]
        ahead += [-row for row in (*shove, first, *turn)]
    rows = [*ahead, *behind]
    rows += shoved or [0.0 * rows[0]] * frame.slides
    shape = broadcast_shapes(*(tuple(row.shape) for row in rows))
    return xp.stack([xp.broadcast_to(row, shape) for row in rows], axis=-1)


def solved(frame: Frame, load: Array) -> tuple[Array, Array]:
    """Return the unknowns of a determinate frame, array (..., p, u), and where it is one, array of bool (..., p or 1).

    While the axes stand still and no journal slides, the matrix is the same at all positions and is solved once.
    """
    xp = namespace(load)
    if frame.matrix.shape[-3] == 1:
        found, regular = solve_regular(frame.matrix[..., 0, :, :], load)
        return found, regular[..., None]
    found, regular = solve_regular(
        xp.broadcast_to(frame.matrix, (*load.shape[:-1], *frame.matrix.shape[-2:])), load[..., None, :]
    )
    return found[..., 0, :], regular


def solved_each(frame: Frame, loads: Sequence[Array]) -> list[Array]:
    """Return the unknowns of a determinate frame for several loads, as `solved`; each matrix is looked at once."""
    if frame.matrix.shape[-3] == 1:
        return [solved(frame, load)[0] for load in loads]
    xp = namespace(*loads)
    every = xp.stack(xp.broadcast_arrays(*loads), axis=-2)
    matrix = xp.broadcast_to(frame.matrix, (*every.shape[:-2], *frame.matrix.shape[-2:]))
    found = solve_regular(matrix, every)[0]
    return [found[..., k, :] for k in range(len(loads))]


def forces_of(frame: Frame, unknowns: Array) -> tuple[Array, Array, Array]:
    """Return joint forces (..., p, n, 3), forces (..., p, k, 3) and couples (..., p, k, 3) of the supports."""
    xp = namespace(unknowns)
    n = frame.layout.joints
    outer = unknowns.shape[:-1]
    joint = xp.reshape(unknowns[..., : 3 * n], (*outer, n, 3))
    none = xp.zeros((*outer, 3), dtype=xp.float64)
    reaction, couple = [], []
    for k, (shaft, holds) in enumerate(frame.layout.bearings):
        force, turn = none, none
        for hold in holds:
            columns = frame.layout.columns(k, hold)
            amount = unknowns[..., columns, None]
            if hold == "tilt":
                turn = turn + xp.sum(amount * frame.acting.couple[..., shaft, columns, :], axis=-2)
            else:
                force = force + xp.sum(amount * frame.acting.force[..., shaft, columns, :], axis=-2)
        reaction.append(force)
        couple.append(turn)
    if not reaction:
        empty = xp.zeros((*outer, 0, 3), dtype=xp.float64)
        return joint, empty, empty
    return joint, xp.stack(reaction, axis=-2), xp.stack(couple, axis=-2)


def whole_balance(
    train: Train,
    frame: Frame,
    stand: KinematicState,
    couples: Couples,
    loads: list[Load],
    held: tuple[Array, Array],
    output: Array,
) -> tuple[Array, Array]:
    """Return what external forces and moments on the whole drive leave, over the largest of them.

    train, frame, stand, couples: the drive and its state; loads: weights and inertia forces.
    held (array (..., p, k, 3) [N], array (..., p, k, 3) [N·m]): forces and couples of the supports.
    output (..., p) [N·m]: torque that resists the output.
    Returns force, moment (..., p).
    Sums over the whole drive about joint 1, from the results alone: torque at both ends and along the shafts, support
    forces and couples, weights, and what turning masses need. Joint forces do not appear: they are internal.
    """
    xp = namespace(output)
    reaction, couple = held
    origin = frame.points[..., 1, :]
    e = stand.axis
    force = 0.0 * couples.secondary[..., 0, :]
    moment = couples.shaft_torque[..., 0, None] * e[..., 0, :] - output[..., None] * e[..., -1, :]
    largest = xp.abs(couples.shaft_torque[..., 0]) + xp.abs(output)
    strongest = 0.0 * largest
    reach = xp.mean(frame.acting.length, axis=-1)
    for k, (s, _holds) in enumerate(train.bearings):
        at = frame.starts[..., s, :] - origin + frame.place[..., k, None] * e[..., s, :]
        force = force + reaction[..., k, :]
        turn = frames.cross(at + 0.0 * reaction[..., k, :], reaction[..., k, :])
        moment = moment + couple[..., k, :] + turn
        strongest = xp.maximum(strongest, frames.norm(reaction[..., k, :]))
        largest = xp.maximum(largest, frames.norm(turn))
    for load in loads:
        at = frame.starts[..., load.shaft, :] - origin + load.place[..., None] * e[..., load.shaft, :]
        force = force + load.force
        moment = moment + frames.cross(at + 0.0 * load.force, load.force + 0.0 * at)
        strongest = xp.maximum(strongest, frames.norm(load.force))
    for i in range(train.joints + 1):
        moment = moment - _turning_need(train, stand, couples, i)
    for i in range(train.joints):
        moment = moment - (couples.driving[..., i, :] - couples.driven[..., i, :])
    safe = xp.where(strongest > 0.0, strongest, 1.0)
    most = xp.maximum(largest, reach * strongest)
    return frames.norm(force) / safe, frames.norm(moment) / xp.where(most > 0.0, most, 1.0)


def _turning_need(train: Train, stand: KinematicState, couples: Couples, i: int) -> Array:
    """Return what shaft i needs to turn as it does: its resisting torque, its inertia, the swing of its axis."""
    e = stand.axis[..., i, :]
    total = 0.0 * couples.secondary[..., i, :]
    if train.resisting_torque is not None:
        total = total + train.resisting_torque[..., None, i, None] * e
    if train.inertia is not None:
        total = total + (train.inertia[..., None, i] * stand.acceleration[..., i])[..., None] * e
    return total + swing_need(train, stand, i)


# In which groups of shafts do the forces of a drive follow from each other?

LOOK = 8
"""Positions of a turn looked at where crosses slide."""


def reaction_groups(drive: Drive) -> tuple[tuple[int, ...], ...]:
    """Return the groups of shafts in whose order the reactions of a drive can be found.

    drive: the drive with its supports.
    Returns: numbers of the shafts of each group; empty where supports miss, or do not hold the drive just enough.
    """
    if not drive.supports:
        return ()
    whole = train(machine_held(drive), kinds=True)
    place = place_of(whole)
    turn = np.arange(LOOK) * (2.0 * np.pi / LOOK)
    stand = standing(whole.chain, place.axis, place.normal, turn, speed=1.0)
    held = frame(whole, stand, whole.points[None])
    if np.any(np.asarray(surplus(held.matrix)) != 0):
        return ()
    return solving_order(held.matrix, held.layout)


def solving_order(matrix: Array, layout: Layout) -> tuple[tuple[int, ...], ...]:
    """Return the groups of shafts whose forces can be found one after the other, each group by itself.

    matrix (p, m, m) or (m, m): balance of the shafts of a drive held just enough, at one position or at several; then
    the conditions that no force acts along journals that slide.
    Returns: numbers of the shafts of each group. The forces on a group follow from its own balance and from those of
    the groups before it; the last group is, as a rule, the one that is driven.

    Book p. 148-150 takes statically determinate groups away from the far end of the drive: a shaft with the cross
    before it is a group of two links and three pairs (Fig. 67), two of them a group of four links and five pairs
    (Fig. 69). Smallest groups first, those farther from the input before others.
    """
    rows = np.reshape(matrix, (-1, *matrix.shape[-2:]))
    left, known, found = list(range(layout.joints + 1)), set[int](), []
    while left:
        group = next((run for run in _runs(left) if _solvable(rows, layout, run, known)), tuple(left))
        found.append(tuple(shaft + 1 for shaft in group))
        left = [shaft for shaft in left if shaft not in group]
        known |= _joints(layout, group)
    return tuple(found)


def _runs(left: list[int]) -> Iterator[tuple[int, ...]]:
    """Yield runs of neighbouring shafts, short ones first, of these the last."""
    for count in range(1, len(left)):
        for start in reversed(range(len(left) - count + 1)):
            run = left[start : start + count]
            if run[-1] - run[0] == count - 1:
                yield tuple(run)


def _joints(layout: Layout, group: tuple[int, ...]) -> set[int]:
    """Return the joints at the ends of the shafts of a group."""
    return {i for shaft in group for i in (shaft - 1, shaft) if 0 <= i < layout.joints}


def _solvable(rows: Array, layout: Layout, group: tuple[int, ...], known: set[int]) -> bool:
    """Tell whether the balance of a group by itself has exactly one solution, the forces of some joints known."""
    open_ = _joints(layout, group) - known
    shafts, splined = layout.joints + 1, sorted(layout.splines)
    sliding = [i for i, pair in enumerate(layout.slides) for slides in pair if slides]
    lines = [5 * shaft + k for shaft in group for k in range(5)]
    lines += [5 * shafts + k for k, shaft in enumerate(splined) if shaft in group]
    lines += [5 * shafts + len(splined) + k for k, i in enumerate(sliding) if i in open_]
    columns = [3 * i + k for i in sorted(open_) for k in range(3)]
    for bearing, (shaft, holds) in enumerate(layout.bearings):
        if shaft in group:
            for hold in holds:
                own = layout.columns(bearing, hold)
                columns += range(own.start, own.stop)
    if len(lines) != len(columns):
        return False
    size = np.linalg.svd(rows[:, lines][:, :, columns], compute_uv=False)
    return bool(np.all(size[:, -1] > RANK * size[:, 0]))
