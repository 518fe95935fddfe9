"""How supports and shafts give way, and what is off before they do: reactions of what is held too much."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.geometry import geometry_from_points
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, namespace
from cardan.maths.linear import beams
from cardan.maths.linear.systems import RANK, least_energy, surplus
from cardan.texts import _, plural

from .kinetostatics import Couples, KinematicState
from .reactions import Frame, Load, arms_of
from .support_statics import HOLDS, WIDTH, Crosses, Hold, Layout, joint_gap, shaft_flexibility, stretches

KEYS: dict[Hold, str] = {"radial": "stiffness", "axial": "axial_stiffness", "tilt": "tilt_stiffness"}
"""Key of a support that says how stiff it holds."""


def compliance(whole: Train, held: Frame) -> Array:
    """Return how supports and shafts give way to the unknowns, array (..., p or 1, u, u) [m/N].

    A stiffness that is not given counts as infinite here; `missing_stiffness` tells where that will not do.
    """
    xp = namespace(whole.points)
    size = [xp.zeros(whole.points.shape[:-2], dtype=xp.float64)] * (3 * held.layout.joints)
    for k, hold in held.layout.unknowns[3 * held.layout.joints :]:
        if hold is None or whole.stiffness is None:
            size.append(size[0])
            continue
        given = whole.stiffness[..., k, HOLDS.index(hold)]
        size.append(xp.where(xp.isnan(given), 0.0, 1.0 / given) + size[0])
    soft = xp.stack(size, axis=-1)[..., None, :]
    whole_soft = soft[..., None] * xp.eye(soft.shape[-1], dtype=xp.float64)
    if whole.bending is None or whole.stretching is None or not bool(xp.any(whole.bending > 0.0)):
        return whole_soft
    bending, stretching = whole.bending[..., None, :, :], whole.stretching[..., None, :, :]
    start = None if whole.stretch_start is None else whole.stretch_start[..., None, :, :]
    return whole_soft + shaft_flexibility(held.acting, bending, stretching, start)


def missing_stiffness(whole: Train, found: Redundancy) -> tuple[tuple[int, Hold], ...]:
    """Return which stiffness is missing of what takes part in forces that statics cannot tell."""
    if whole.stiffness is None:
        return found.strained
    return tuple((k, hold) for k, hold in found.strained if math.isnan(float(whole.stiffness[k, HOLDS.index(hold)])))


def housing_gap(whole: Train, held: Frame) -> Array:
    """Return how far the housings are off in the directions of the unknowns, array (..., p or 1, u) [m]."""
    xp = namespace(whole.points)
    force = held.acting.force
    none = 0.0 * force[..., 0, 0, 0]
    rows = [none] * (3 * held.layout.joints)
    column = len(rows)
    for k, hold in held.layout.unknowns[column:]:
        shaft = held.layout.bearings[k][0]
        if hold == "tilt" or whole.offset is None:
            rows.append(none)
        else:
            rows.append(xp.sum(force[..., shaft, len(rows), :] * whole.offset[..., None, k, :], axis=-1))
    return xp.stack(rows, axis=-1)


def gaps(whole: Train, held: Frame, arms: Crosses) -> tuple[Array, Array]:
    """Return what is off in the joints by their errors, and its derivative by φ_1, arrays (..., p, n, 3)."""
    xp = namespace(held.points)
    if whole.error is None:
        none = xp.zeros_like(arms.driving)
        return none, none
    known = whole.normal
    normal = geometry_from_points(held.points).normal if known is None else known[..., None, :, :]
    return joint_gap(held.acting.axis, normal, arms, whole.error[..., None, :, :])


def bent_by_loads(whole: Train, held: Frame, found: Couples, loads: list[Load], thrust: Array) -> Array:
    """Return how far known couples and forces bend the shafts at the unknowns, array (..., p, u) [m].

    held: where the unknowns act; found: couples of the joints on the shafts.
    loads: weights and inertia forces; the couples of swinging shafts are left out: they are spread along them.
    thrust (..., p, number of splines) [N]: friction thrust of the splines.
    """
    xp = namespace(held.points, found.secondary)
    acting, n = held.acting, held.layout.joints
    total = 0.0 * found.secondary[..., 0, :1]
    if whole.bending is None or whole.stretching is None:
        return total
    for s in range(n + 1):
        e, length = acting.axis[..., s, :], acting.length[..., s]
        none = 0.0 * found.secondary[..., s, :]
        place, force, couple = [], [], []
        if s:
            place, force, couple = [0.0 * length], [none], [found.driven[..., s - 1, :]]
        if s < n:
            place, force, couple = [*place, length], [*force, none], [*couple, -found.driving[..., s, :]]
        for load in loads:
            if load.shaft == s:
                place, force, couple = [*place, load.place], [*force, load.force + none], [*couple, none]
        if s in acting.cut:
            push = thrust[..., held.layout.splines.index(s), None] * e
            place, force, couple = [*place, acting.cut[s]], [*force, push + none], [*couple, none]
        where = xp.stack([one + none[..., 0] for one in place], axis=-1)
        given = where, xp.stack(force, axis=-2), xp.stack([one + none for one in couple], axis=-2)
        own = acting.place[..., s, :], acting.force[..., s, :, :], acting.couple[..., s, :, :]
        end = xp.maximum(xp.max(own[0], axis=-1), xp.max(where, axis=-1))
        for since, bending, stretching in stretches(whole.bending, whole.stretching, whole.stretch_start, s):
            from_here = None if since is None else since[..., None]
            bent = beams.bending_between(e, own, given, end, from_here)
            pulled = beams.stretching_between(e, own[:2], given[:2], end, acting.cut.get(s), from_here)
            total = total + bending[..., None, None] * xp.sum(bent, axis=-1)
            total = total + stretching[..., None, None] * xp.sum(pulled, axis=-1)
    return total


def elastic(
    whole: Train, held: Frame, stand: KinematicState, found: Couples, loads: list[Load], thrust: Array, known: Array
) -> Array:
    """Return the unknowns of a frame that is held too much, array (..., p, u).

    whole (...): how supports and shafts give way, and what is off; held: balance of the shafts.
    stand, found: how crosses stand, and what they carry.
    loads, thrust, list of Load, array (..., p, number of splines): other known forces.
    known (..., p, rows): known side of the balance.
    Least complementary energy under load and misalignment at once: d of `least_energy` holds the offsets of the
    housings, the gaps in the joints, and what the loads bend the shafts by.
    """
    xp = namespace(known)
    off, _rate = gaps(whole, held, arms_of(whole, stand))
    joints = xp.reshape(off, (*off.shape[:-2], 3 * held.layout.joints))
    rest = xp.zeros((*off.shape[:-2], held.matrix.shape[-1] - joints.shape[-1]), dtype=xp.float64)
    gap = xp.concat((joints, rest), axis=-1) + housing_gap(whole, held)
    gap = gap - bent_by_loads(whole, held, found, loads, thrust)
    return least_energy(held.matrix, known, compliance(whole, held), gap)[0]


def refuse_soft(whole: Train, found: Redundancy, field: str = "") -> None:
    """Refuse a frame whose forces follow from a stiffness that is not given.

    whole: one drive; found: how far it is held too much.
    field: what the error names: the list of supports, or each missing key by itself where this is empty.
    """
    missing = missing_stiffness(whole, found)
    if not missing:
        return
    keys = [f"supports[{k}].{KEYS[hold]}" for k, hold in missing]
    if not field:
        text = _("missing; the drive is held by {degree} more than statics can tell, so forces follow from stiffness")
        check(Problem(key, text.format(degree=found.degree)) for key in keys)
    text = _(
        "the shafts are held by {degree} forces or couples more than statics can tell; take supports away, let them "
        "slide or tilt, or give {keys}"
    )
    if field != "supports":
        keys = [
            _("the stiffness of {place}").format(place=f"{field}[{k}]")
            for k in dict.fromkeys(k for k, _hold in missing)
        ]
    raise refuse(field, text.format(degree=found.degree, keys=", ".join(keys)))


# Is a chain of shafts held just enough, too much, or not enough? Which bearing is the one too many?

TAKES_PART = 1e-7
"""An unknown of less than this share of a force that balances itself does not take part in it."""

READY: dict[Hold, float] = {"tilt": 4.0, "axial": 2.0, "radial": 1.0}
"""How readily each hold is let go: a self-aligning bearing and a floating one are cheap, one bearing less is not."""

MOST_TRIALS = 1024
"""Layouts looked at when searching for what to let go; in the order of search the first is nearly always the answer."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Redundancy:
    """How far a drive is statically indeterminate, and where."""

    degree: int  # how many forces and couples the balance of the shafts leaves open
    strained: tuple[tuple[int, Hold], ...] = ()  # bearings, counted from 0, and what of them misalignment can load
    # what could be let go all at once without setting anything free: the components too many. Another choice among
    # `strained` may do as well.
    spare: tuple[tuple[int, Hold], ...] = ()


def redundancy(matrix: Array, layout: Layout, *, field: str = "supports") -> Redundancy:
    """Return what of the bearings is too many.

    matrix (m, u) or (p, m, u): balance of the shafts, at one position or at several.
    Degree = unknowns - rank A, loose = equations - rank A; statics of rigid shafts. A force state that balances itself
    is a null vector of A: what has a share in it can be loaded by misalignment. A shaft that can move without a bearing
    giving way is a null vector of Aᵀ.
    """
    rows = np.reshape(matrix, (-1, *matrix.shape[-2:]))
    open_, unmet = surplus(rows)
    worst = int(np.argmax(unmet))
    if unmet[worst] > 0:
        check(_movements(rows[worst], layout, field))
    degree = int(np.max(open_))
    if degree <= 0:
        return Redundancy(degree=0)
    strained = _strained(rows, layout)
    return Redundancy(degree=degree, strained=strained, spare=_spare(rows, layout, strained, degree))


def _holds(layout: Layout) -> list[tuple[int, Hold]]:
    return [(k, hold) for k, (_shaft, holds) in enumerate(layout.bearings) for hold in holds]


def _strained(rows: Array, layout: Layout) -> tuple[tuple[int, Hold], ...]:
    """Return which bearings have a share in a force state that balances itself, at any of the positions."""
    _left, size, right = np.linalg.svd(rows)
    share = np.zeros(rows.shape[-1])
    for values, states in zip(size, right, strict=True):
        null = states[int(np.sum(values > RANK * values[0])) :]
        if len(null):
            share = np.maximum(share, np.max(np.abs(null), axis=0))
    return tuple(one for one in _holds(layout) if np.max(share[layout.columns(*one)]) > TAKES_PART)


def _spare(
    rows: Array, layout: Layout, strained: tuple[tuple[int, Hold], ...], degree: int
) -> tuple[tuple[int, Hold], ...]:
    """Return what can be let go: first that without which the drive is still held best; turned back from dead ends.

    A hold that goes first may leave one degree over where every other hold counts two; another order then lets all go.
    Where no order does, as few degrees as can be stay open.
    """
    trials = MOST_TRIALS

    def search(kept: Array, left: list[tuple[int, Hold]], open_: int) -> list[tuple[int, Hold]]:
        nonlocal trials
        most: list[tuple[int, Hold]] = []
        if open_ <= 0:
            return most
        scores = {one: READY[one[1]] * _firm(rows, kept, layout, one) for one in left if WIDTH[one[1]] <= open_}
        trials -= len(scores)
        ranked = sorted((one for one in scores if scores[one] > RANK), key=scores.__getitem__, reverse=True)
        for k, one in enumerate(ranked):
            fewer = kept.copy()
            fewer[layout.columns(*one)] = False
            # What was tried first here led nowhere in any order, so it is not tried again behind this one.
            rest = [other for other in left if other != one and other not in ranked[:k]]
            found = [one, *search(fewer, rest, open_ - WIDTH[one[1]])]
            if _width(found) > _width(most):
                most = found
            if _width(most) == open_ or trials <= 0:
                break
        return most

    return tuple(search(np.ones(rows.shape[-1], dtype=bool), list(strained), degree))


def _width(holds: list[tuple[int, Hold]]) -> int:
    """Return how many forces and couples some holds take together."""
    return sum(WIDTH[hold] for _k, hold in holds)


def _firm(rows: Array, kept: Array, layout: Layout, one: tuple[int, Hold]) -> float:
    """Return how firmly the drive is held without one more hold: the smallest singular value of its balance."""
    trial = kept.copy()
    trial[layout.columns(*one)] = False
    if int(np.sum(trial)) < rows.shape[-2]:
        return 0.0
    return float(np.min(np.linalg.svd(rows[..., trial], compute_uv=False)[..., -1]))


def _movements(matrix: Array, layout: Layout, field: str) -> Iterator[Problem]:
    """Say which shafts are free, and along what."""
    left, size, _right = np.linalg.svd(matrix)
    rank = int(np.sum(size > RANK * size[0]))
    shafts = layout.joints + 1
    moved = np.abs(left[: 5 * shafts, rank:]).reshape(shafts, 5, -1).max(axis=-1)
    parted = np.abs(left[5 * shafts : 5 * shafts + len(layout.splines), rank:]).max(axis=-1, initial=0.0)
    ways = []
    for s in range(shafts):
        along = max(float(moved[s, 2]), *(float(parted[k]) for k, one in enumerate(layout.splines) if one == s), 0.0)
        across = float(np.max(moved[s, [0, 1, 3, 4]]))
        if max(along, across) <= TAKES_PART:
            continue
        if across <= TAKES_PART:
            text = _("shaft {number} from moving along its axis")
        elif along <= TAKES_PART:
            text = _("shaft {number} from moving sideways")
        else:
            text = _("shaft {number} from moving sideways and along its axis")
        ways.append(text.format(number=s + 1))
    count = matrix.shape[-2] - rank
    text = plural(
        "not held, {count} hold too few: nothing keeps {ways}",
        "not held, {count} holds too few: nothing keeps {ways}",
        count,
    )
    yield Problem(field, text.format(count=count, ways=", ".join(ways)))
