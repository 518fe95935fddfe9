"""How links and pairs move and what they carry where they stand: rates, reactions, friction, influence of errors.

One position or many at once: the leading axes (...) of all arrays are the positions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws

from .constraints import FRAME
from .mechanism import Kind

REACH = 1e-10
"""Singular values below this share of the largest count as nought: what is held twice shares alike."""

ROUNDS = 200
"""Rounds between reactions and the friction that they make, at most."""

RESTS = 1e-14
"""Change of the friction in a round over the largest reaction at which the rounds end."""

NO_SIZE = 1e-12
"""Distance [m] of points below which all stand in one: no mechanism is so small."""

NEAR = 1e-6
"""Singular values below this share of the largest leave a motion: a mechanism within rounding of a change point."""

LOCKED = 1e-8
"""Share of the friction that the last round may have left; more where it grows without end."""

EPS = float(np.finfo(float).eps)

SLOW = 1e-12
"""Speeds below this share of the largest are rounding, and rub nowhere."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Placed:
    """Links and pairs where they stand."""

    links: int  # number of moving links n
    ends: tuple[tuple[int, int], ...]  # the two links of each pair, counted from 0; `FRAME` is the frame
    kinds: tuple[Kind, ...]  # of each pair
    point: Array  # (..., m, 3) [m]
    axis: Array  # axis, second (..., m, 3): unit vectors; any where a kind has none
    second: Array
    # of each pair: coefficient of friction, lever [m] at which what turns in it rubs, distance [m] of its two bearings
    friction: tuple[float, ...] = ()
    lever: tuple[float, ...] = ()
    spread: tuple[float, ...] = ()
    pitch: tuple[float, ...] = ()  # of each pair [m/rad], nought where it is not helical
    carriers: tuple[int | None, ...] = ()  # of each pair, the link that its point and axis go with; None: its own

    @property
    def size(self) -> float:
        """Length that counts as one [m]."""
        flat = np.reshape(self.point, (-1, 3))
        found = float(np.max(frames.norm(flat - np.mean(flat, axis=0))))
        return found if found > NO_SIZE else 1.0


@dataclass(frozen=True, eq=False, kw_only=True)
class Carried:
    """How the links move and what the pairs carry."""

    speed: Array  # (..., n, 6): twist (ω; v) of each link about the origin [rad/s, m/s], for the twist of the input
    rate: Array  # (..., m, 6): of the second link of each pair against the first, v at the pair's point
    reaction: Array  # (..., m, 6): wrench (couple; force) of the first link on the second, about the point [N·m, N]
    locked: Array  # (...) of bool: whether friction outgrows what drives, so that no forces are found
    input_torque: Array  # (...) [N·m]: what drives the input about its axis; the force [N] on one that slides
    loss: Array  # (..., m) [W]: rubbed away in each pair
    open: Array  # (...): what keeps the rates of the pairs from closing, over the largest
    unbalanced: Array  # (...): what keeps the links from balance, over the largest reaction


def held(kind: Kind, point: Array, axis: Array, second: Array, pitch: float = 0.0) -> Array:
    """Return what a pair holds, wrenches (couple; force) about the origin on its second link, array (..., s, 6).

    point [m], axis, second (..., 3): as `Placed` has them; pitch [m/rad]: of a helical pair.

    >>> from .mechanism import PAIRS
    >>> x, y, z = np.eye(3)
    >>> [held(PAIRS[name], 0.0 * x, z, x).shape[-2] for name in ("R", "P", "H", "C", "U", "S", "E", "SG", "L4", "PT")]
    [5, 5, 5, 4, 4, 3, 3, 2, 2, 1]
    """
    forces, couples = _ways(kind, axis, second)
    rows = [np.concatenate((frames.cross(point, one), one), axis=-1) for one in forces]
    if kind.screw:
        rows.append(np.concatenate((frames.cross(point, axis) - pitch * axis, axis), axis=-1))
    rows += [np.concatenate((one, np.zeros_like(one)), axis=-1) for one in couples]
    return np.stack(np.broadcast_arrays(*rows), axis=-2)


def _ways(kind: Kind, axis: Array, second: Array) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
    """Return the directions in which a pair holds forces and couples."""
    aside = frames.perpendicular(axis)
    across = aside, frames.cross(axis, aside)
    every = (axis, *across)
    forces = {"": every, "axis": across, "across": (axis,)}[kind.slides]
    couples = {"": every, "axis": across, "both": (), "all": ()}[kind.turns]
    if kind.turns == "both":
        couples = (frames.unit(frames.cross(axis, second)),)
    return forces, couples


def _held_rate(
    kind: Kind, point: Array, axis: Array, second: Array, pitch: float, first: Array, other: Array, place: Array
) -> Array:
    """Return how fast what a pair holds changes, array (..., s, 6), but for what its rows share.

    first, other, place (..., 6): twists of both its links and of that with which its point goes.
    """
    forces, couples = _ways(kind, axis, second)
    turn = first[..., :3]
    moved = place[..., 3:] + frames.cross(place[..., :3], point + 0.0 * place[..., 3:])

    def pulled(one: Array) -> Array:
        turned = frames.cross(turn, one + 0.0 * turn)
        return np.concatenate(
            (frames.cross(moved, one + 0.0 * turn) + frames.cross(point + 0.0 * turn, turned), turned), axis=-1
        )

    rows = [pulled(one) for one in forces]
    if kind.screw:
        leads = pitch * frames.cross(turn, axis + 0.0 * turn)
        rows.append(pulled(axis) - np.concatenate((leads, 0.0 * leads), axis=-1))
    if kind.turns == "both":
        size = frames.norm(frames.cross(axis, second))[..., None]
        ahead = frames.cross(frames.cross(turn, axis + 0.0 * turn), second + 0.0 * turn)
        ahead = ahead + frames.cross(axis + 0.0 * turn, frames.cross(other[..., :3], second + 0.0 * turn))
        turns = [ahead / size]
    else:
        turns = [frames.cross(turn, one + 0.0 * turn) for one in couples]
    rows += [np.concatenate((one, np.zeros_like(one)), axis=-1) for one in turns]
    return np.stack(np.broadcast_arrays(*rows), axis=-2)


def _matrix_of(placed: Placed, shape: tuple[int, ...], speed: Array | None = None) -> list[Array]:
    """Return the rows w·(t_b - t_a) of each pair, arrays (..., s, 6n), lengths over the size.

    speed (..., n, 6): twists over the size of the links; how fast the rows change is returned then.
    """
    size, blocks = placed.size, []
    none = np.zeros((*shape, 6))
    for k, (kind, ends) in enumerate(zip(placed.kinds, placed.ends, strict=True)):
        at = placed.point[..., k, :] / size, placed.axis[..., k, :], placed.second[..., k, :]
        pitch = placed.pitch[k] / size if placed.pitch else 0.0
        if speed is None:
            own = held(kind, *at, pitch)
        else:
            first, other = (none if link == FRAME else speed[..., link, :] for link in ends)
            carrier = placed.carriers[k] if placed.carriers else None
            place = other
            if carrier is not None:
                first = place = none if carrier == FRAME else speed[..., carrier, :]
            own = _held_rate(kind, *at, pitch, first, other, place)
        rows = np.zeros((*shape, own.shape[-2], 6 * placed.links))
        for link, sign in zip(ends, (-1.0, 1.0), strict=True):
            if link != FRAME:
                rows[..., 6 * link : 6 * link + 6] += sign * own
        blocks.append(rows)
    return blocks


def speeds(placed: Placed, *, input_link: int, about: Array, base: int = FRAME) -> Array:
    """Return the twists (..., n, 6) of all links while one of them has a twist ``about`` (..., 6) against a base."""
    size = placed.size
    lengths = np.asarray([1.0, 1.0, 1.0, size, size, size])
    shape = np.broadcast_shapes(placed.point.shape[:-2], about.shape[:-1])
    matrix = np.concatenate(_matrix_of(placed, shape), axis=-2)
    return _speeds(matrix, (input_link, base), np.broadcast_to(about / lengths, (*shape, 6)))[0] * lengths


@dataclass(frozen=True, eq=False, kw_only=True)
class Rates:
    """How the links move while the input turns at 1 rad/s, uniformly."""

    speed: Array  # (..., n, 6): twist (ω; v) of each link about the origin [rad/s, m/s]
    acceleration: Array  # (..., n, 6): its rate [rad/s², m/s²]
    free: Array  # (..., w, n, 6): motions left while the input stands, w the most anywhere; those that are not are 0
    count: Array  # (...) of int: how many there are
    open: Array  # (...): what keeps the rates of the pairs from closing, over the largest
    steep: Array  # (...): largest over least of what the pairs hold, without bounds toward a change point

    def blur(self, order: int) -> Array:
        """Return what rounding may make of places (0), speeds (1) and accelerations (2), (...), lengths over the size.

        What a place is off by tilts what the pairs hold, and that again grows by how little of it is left.
        """
        found: Array = EPS * self.steep ** (order + 1)
        return found


def rates(placed: Placed, *, input_link: int, about: Array, base: int = FRAME) -> Rates:
    """Return how the links move while one of them turns.

    input_link: link that turns with a twist ``about`` (..., 6), always the same, against a base that it goes with.
    With the rows A of what the pairs hold: A t = 0, and A ṫ = -Ȧ t; what nothing holds rests.
    """
    size, n = placed.size, placed.links
    shape = np.broadcast_shapes(placed.point.shape[:-2], about.shape[:-1])
    lengths = np.asarray([1.0, 1.0, 1.0, size, size, size])
    matrix = np.concatenate(_matrix_of(placed, shape), axis=-2)
    driven = _Driven(matrix, input_link, base)
    own, rest = driven.own, driven.rest
    left, sizes, right = np.linalg.svd(driven.matrix, full_matrices=True)
    known = min(matrix.shape[-2], len(rest))
    holds = np.zeros((*shape, len(rest)), dtype=bool)
    holds[..., :known] = sizes > NEAR * np.max(sizes, axis=-1, keepdims=True) if known else False
    inverse = np.zeros((*shape, len(rest)))
    inverse[..., :known] = np.where(holds[..., :known], 1.0 / np.where(holds[..., :known], sizes, 1.0), 0.0)

    def solved(target: Array) -> Array:
        shares = (np.swapaxes(left, -1, -2) @ target[..., None])[..., 0]
        wide = np.zeros((*shape, len(rest)))
        wide[..., :known] = shares[..., :known]
        return (np.swapaxes(right, -1, -2) @ (inverse * wide)[..., None])[..., 0]

    twist = np.broadcast_to(about / lengths, (*shape, 6))
    target = -(matrix[..., own] @ twist[..., None])[..., 0]
    whole = driven.whole(solved(target), twist)
    miss = np.max(np.abs((matrix @ whole[..., None])[..., 0]), axis=-1) / np.max(np.abs(whole), axis=-1)
    speed = np.reshape(whole, (*shape, n, 6))
    changing = np.concatenate(_matrix_of(placed, shape, speed), axis=-2)
    swept = np.zeros((*shape, 6)) if base == FRAME else screws.bracket(speed[..., base, :], twist)
    gone = (changing @ whole[..., None])[..., 0] + (matrix[..., own] @ swept[..., None])[..., 0]
    steep = driven.whole(solved(-gone), swept)
    count = np.sum(~holds, axis=-1)
    most = int(np.max(count, initial=0))
    loose = right[..., len(rest) - most :, :] * ~holds[..., len(rest) - most :, None]
    ways = driven.whole(loose[..., ::-1, :])
    return Rates(
        speed=speed * lengths,
        acceleration=np.reshape(steep, (*shape, n, 6)) * lengths,
        free=np.reshape(ways, (*shape, most, n, 6)) * lengths,
        count=count,
        open=miss,
        steep=np.max(inverse, axis=-1, initial=0.0) * np.max(sizes, axis=-1, initial=0.0),
    )


def carried(
    placed: Placed,
    *,
    input_link: int,
    about: Array,
    load: Array,
    fed: bool = True,
    base: int = FRAME,
    drive: Array | None = None,
) -> Carried:
    """Return how the links move and what the pairs carry, see `each_carried`."""
    asked = [(placed.friction, fed)]
    return each_carried(placed, asked, input_link=input_link, about=about, load=load, base=base, drive=drive)[0]


def each_carried(
    placed: Placed,
    asked: Sequence[tuple[tuple[float, ...], bool]],
    *,
    input_link: int,
    about: Array,
    load: Array,
    base: int = FRAME,
    drive: Array | None = None,
) -> list[Carried]:
    """Return how the links move and what the pairs carry, Coulomb's friction acting on itself, in several ways.

    asked: coefficient of friction of each pair, and whether the speeds have the sense of ``about``; False where the
    load drives.
    input_link: link that turns with a twist ``about`` (..., 6), whose turning part is along its axis; a torque about
    this axis drives it, or 1 N·m or 1 N of the wrench ``drive`` (..., 6).
    base: link against which it moves with this twist, and which takes what drives it back.
    load (..., n, 6): wrenches (couple; force) about the origin on each link [N·m, N].

    Power of what holds is nought on all motions it leaves: with the rows w·(t_b - t_a) of `Constraints.matrix` the
    speeds are its null vector, and the reactions λ meet wᵀλ + τ + load = 0 for every link. What is held too often
    shares so that the sum of squares is least. Friction: μ(|F| + 2|M|/l) against sliding, r times as much against
    turning.
    """
    size, n = placed.size, placed.links
    shape = np.broadcast_shapes(placed.point.shape[:-2], about.shape[:-1], load.shape[:-2])
    lengths = np.asarray([1.0, 1.0, 1.0, size, size, size])
    couples = np.asarray([size, size, size, 1.0, 1.0, 1.0])  # lengths over the size, so that couples are forces
    blocks = _matrix_of(placed, shape)
    matrix = np.concatenate(blocks, axis=-2)
    speed, open_ = _speeds(matrix, (input_link, base), np.broadcast_to(about / lengths, (*shape, 6)))
    speed = speed * lengths
    rate = _rates(placed, speed)
    if drive is None:
        drive = np.concatenate((frames.unit(about[..., :3]), 0.0 * about[..., :3]), axis=-1)
    unit = size if np.any(about[..., :3]) else 1.0
    push = np.zeros((*shape, 6 * n, 1))
    push[..., 6 * input_link : 6 * input_link + 6, 0] = drive / couples * unit
    if base != FRAME:
        push[..., 6 * base : 6 * base + 6, 0] = -drive / couples * unit
    columns = np.concatenate((np.swapaxes(matrix, -1, -2), push), axis=-1)
    inverse = np.linalg.pinv(columns, rcond=REACH)
    known = np.broadcast_to(load, (*shape, n, 6)) / couples

    def solved(rubbed: Array) -> tuple[Array, Array]:
        right = np.reshape(-(known + rubbed), (*shape, 6 * n, 1))
        found = inverse @ right
        return found[..., 0], np.max(np.abs(columns @ found - right)[..., 0], axis=-1)

    bare = solved(np.zeros_like(known))
    smooth = _reactions(placed, blocks, bare[0], couples)

    def rubbing(friction: tuple[float, ...], fed: bool) -> Carried:
        (amounts, rest), reaction = bare, smooth
        rubbed, loss = np.zeros_like(known), np.zeros((*shape, len(placed.ends)))
        for _round in range(ROUNDS if any(friction) else 0):
            before = rubbed
            wrench, loss = _friction(replace(placed, friction=friction), rate, reaction, 1.0 if fed else -1.0)
            rubbed = np.zeros_like(known)
            for k, (a, b) in enumerate(placed.ends):
                for link, sign in ((a, -1.0), (b, 1.0)):
                    if link != FRAME:
                        rubbed[..., link, :] += sign * wrench[..., k, :] / couples
            amounts, rest = solved(rubbed)
            reaction = _reactions(placed, blocks, amounts, couples)
            if np.max(np.abs(rubbed - before)) <= RESTS * np.max(np.abs(amounts)):
                break
        largest = np.max(np.abs(amounts), axis=-1)
        again = loss
        if any(friction):
            again = _friction(replace(placed, friction=friction), rate, reaction, 1.0 if fed else -1.0)[1]
        rest_of = np.max(np.abs(again - loss), axis=-1)
        return Carried(
            speed=speed if fed else -speed,
            rate=rate if fed else -rate,
            reaction=reaction,
            locked=~(rest_of <= LOCKED * np.max(np.abs(loss), axis=-1)),
            input_torque=amounts[..., -1] * unit,
            loss=loss,
            open=open_,
            unbalanced=rest / np.where(largest > 0.0, largest, 1.0),
        )

    return [rubbing(friction, fed) for friction, fed in asked]


def influence(placed: Placed, found: Carried, output_torque: float) -> Array:
    """Return how far an error of each pair turns the output on, the input held, array (..., m, 6) [1, rad/m].

    found: without friction, with nothing but a torque ``output_torque`` that resists the output.
    An error is a small displacement (turn; shift at the pair's point) of the second half of a pair against where it
    should be. Virtual power: the reactions work on the errors as much as the load on the turn of the output.
    """
    return found.reaction / output_torque


class _Driven:
    """The columns of a link that moves against a base with a twist that is known, among those of all links."""

    def __init__(self, matrix: Array, input_link: int, base: int) -> None:
        self.own = np.arange(6 * input_link, 6 * input_link + 6)
        self.rest = np.delete(np.arange(matrix.shape[-1]), self.own)
        self.below = None if base == FRAME else np.arange(6 * base, 6 * base + 6)
        if self.below is not None:  # what moves the base moves the link with it
            matrix = np.array(matrix)
            matrix[..., self.below] += matrix[..., self.own]
        self.matrix = matrix[..., self.rest]

    def whole(self, rest: Array, own: Array | float = 0.0) -> Array:
        """Return what moves of all links, where that of the rest and of the link against its base is known."""
        found = np.zeros((*rest.shape[:-1], rest.shape[-1] + 6))
        found[..., self.rest] = rest
        found[..., self.own] = own if self.below is None else own + found[..., self.below]
        return found


def _speeds(matrix: Array, ends: tuple[int, int], twist: Array) -> tuple[Array, Array]:
    """Return the twists of all links (..., n, 6) for that of the input, and what keeps the pairs from closing."""
    n = matrix.shape[-1] // 6
    driven = _Driven(matrix, *ends)
    right = -(matrix[..., driven.own] @ twist[..., None])
    free = np.linalg.pinv(driven.matrix, rcond=REACH) @ right
    miss = np.max(np.abs(driven.matrix @ free - right)[..., 0], axis=-1)
    whole = driven.whole(free[..., 0], twist)
    return np.reshape(whole, (*twist.shape[:-1], n, 6)), miss / np.max(np.abs(whole), axis=-1)


def _rates(placed: Placed, speed: Array) -> Array:
    """Return the twist of the second link of each pair against the first, v at the pair's point, array (..., m, 6)."""
    rows = []
    for k, (a, b) in enumerate(placed.ends):
        zero = np.zeros_like(speed[..., 0, :])
        one = (zero if b == FRAME else speed[..., b, :]) - (zero if a == FRAME else speed[..., a, :])
        swept = frames.cross(one[..., :3], placed.point[..., k, :] + 0.0 * one[..., :3])
        rows.append(np.concatenate((one[..., :3], one[..., 3:] + swept), axis=-1))
    return np.stack(rows, axis=-2)


def _reactions(placed: Placed, blocks: Sequence[Array], amounts: Array, couples: Array) -> Array:
    """Return the wrench of each pair on its second link, about its point, array (..., m, 6)."""
    rows, first = [], 0
    for k, (block, (a, b)) in enumerate(zip(blocks, placed.ends, strict=True)):
        count = block.shape[-2]
        link, sign = (b, 1.0) if b != FRAME else (a, -1.0)
        own = sign * block[..., 6 * link : 6 * link + 6]
        wrench = (amounts[..., None, first : first + count] @ own)[..., 0, :] * couples
        first += count
        point = placed.point[..., k, :] + 0.0 * wrench[..., :3]
        turn = wrench[..., :3] - frames.cross(point, wrench[..., 3:])
        rows.append(np.concatenate((turn, wrench[..., 3:]), axis=-1))
    return np.stack(rows, axis=-2)


def _friction(placed: Placed, rate: Array, reaction: Array, sense: float) -> tuple[Array, Array]:
    """Return the wrench (..., m, 6) of friction on the second link of each pair about the origin, and its power."""
    wrenches, losses = [], []
    fastest = np.max(np.abs(rate), axis=(-2, -1))
    for k, mu in enumerate(placed.friction):
        turn, slide = sense * rate[..., k, :3], sense * rate[..., k, 3:]
        force = frames.norm(reaction[..., k, 3:])
        arm = placed.lever[k] if placed.lever else 0.0
        tilt = 2.0 * frames.norm(reaction[..., k, :3]) / placed.spread[k] if placed.spread else 0.0 * force
        if placed.kinds[k].screw and mu:
            wrench, power = _thread_friction(placed, k, mu, (turn, slide), reaction[..., k, :])
            wrenches.append(wrench)
            losses.append(power)
            continue
        spin, way = frames.norm(turn), frames.norm(slide)
        turns, moves = spin > SLOW * fastest, way > SLOW * fastest * placed.size
        couple = np.where(turns, mu * arm * (force + tilt), 0.0)
        push = np.where(moves, mu * (force + tilt), 0.0)
        about = -couple[..., None] * turn / np.where(turns, spin, 1.0)[..., None]
        along = -push[..., None] * slide / np.where(moves, way, 1.0)[..., None]
        point = placed.point[..., k, :] + 0.0 * along
        wrenches.append(np.concatenate((about + frames.cross(point, along), along), axis=-1))
        losses.append(couple * spin + push * way)
    return np.stack(wrenches, axis=-2), np.stack(losses, axis=-1)


def _thread_friction(
    placed: Placed, k: int, mu: float, rate: tuple[Array, Array], reaction: Array
) -> tuple[Array, Array]:
    """Return the same of a helical pair, which rubs along its thread of radius r and lead angle λ.

    tan λ = p/r. The thread is pressed by F_a/cos λ, F_a the force along its axis, and by what is held across it.
    """
    turn, slide = rate
    axis, arm, pitch = placed.axis[..., k, :], placed.lever[k], placed.pitch[k]
    slope = np.hypot(1.0, pitch / arm)
    along = frames.dot(reaction[..., 3:], axis)
    aside = frames.norm(reaction[..., 3:] - along[..., None] * axis)
    across = reaction[..., :3] - frames.dot(reaction[..., :3], axis)[..., None] * axis
    push = mu * (np.abs(along) * slope + aside + 2.0 * frames.norm(across) / placed.spread[k])
    spin = frames.dot(turn, axis)
    way = np.sign(spin) * push / slope
    force = -(way * pitch / arm)[..., None] * axis
    point = placed.point[..., k, :] + 0.0 * force
    wrench = np.concatenate((frames.cross(point, force) - (way * arm)[..., None] * axis, force), axis=-1)
    return wrench, push * slope * arm * np.abs(spin) + 0.0 * slide[..., 0]
