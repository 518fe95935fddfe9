"""What the inner mechanism of a joint does: how it turns, what its shafts and pairs carry, what it rubs away."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.drive.joints import Joint
from cardan.drive.joints.common import inner
from cardan.drive.joints.common.inner import InnerPair, Stance
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames
from cardan.mechanism.constraints import FRAME
from cardan.mechanism.kinetostatics import Carried, Placed, each_carried
from cardan.mechanism.mechanism import PAIRS
from cardan.texts import _

BEFORE, ASIDE, NORMAL = np.eye(3)
"""Driving shaft, direction in the plane of the shafts across it toward the driven one, and normal of that plane."""


STRAIGHT = 1e-6
"""Joint angle [rad] up to which nothing in a joint rubs."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointCarried:
    """A joint with a torque of 1 N·m on its driven shaft, at places of a turn (p,); its driving shaft along x."""

    pairs: tuple[InnerPair, ...]  # of the joint, then those that hold its shafts
    inner: int  # how many of them are of the joint
    placed: Placed
    found: Carried
    axis: Array  # (p, 3): direction of the driven shaft, the way it lies

    @property
    def ratio(self) -> Array:
        """Speed of the driven shaft about its axis over that of the driving shaft, array (p,)."""
        speed = self.found.speed[:, 1, :3]
        return np.asarray(frames.dot(speed, self.axis)) / np.abs(self.found.speed[:, 0, 0])

    @property
    def input_torque(self) -> Array:
        """Torque that drives the driving shaft, array (p,) [N·m]."""
        return self.found.input_torque

    @property
    def wrench(self) -> Array:
        """Wrench (couple; force) of the joint on the driven shaft about the joint's centre, array (p, 6) [N·m, N]."""
        whole = np.concatenate((self.axis, np.zeros_like(self.axis)), axis=-1)
        for k in range(self.inner, len(self.pairs)):
            a, b = self.placed.ends[k]
            if 1 in (a, b):
                own = self.found.reaction[:, k]
                turn = own[:, :3] + frames.cross(self.placed.point[:, k], own[:, 3:])
                whole = whole - (1.0 if b == 1 else -1.0) * np.concatenate((turn, own[:, 3:]), axis=-1)
        return whole

    @property
    def loss(self) -> Array:
        """Power that the joint rubs away over that of its driving shaft, array (p,)."""
        return np.asarray(np.sum(self.found.loss, axis=-1) / np.abs(self.input_torque * self.found.speed[:, 0, 0]))


def stance_of(joint: Joint, joint_angle: float, angle: Array, *, length: float = 1.0) -> Stance:
    """Return how a joint stands at the origin, its driving shaft along x.

    joint_angle [rad]; angle (p,) [rad]: of its driving mark from the plane of the shafts; length [m]: of the shaft
    behind it.
    """
    cosine, sine = np.cos(joint_angle), np.sin(joint_angle)
    after, beyond = cosine * BEFORE + sine * ASIDE, cosine * ASIDE - sine * BEFORE
    with np.errstate(invalid="ignore", divide="ignore"):
        lead = np.asarray(joint.deviation(angle, np.asarray(joint_angle))[0])
    turned = angle + lead + (0.5 * np.pi if joint.crossed else 0.0)
    return Stance(
        centre=np.zeros(3),
        before=BEFORE,
        after=after,
        normal=NORMAL,
        joint_angle=joint_angle,
        driving=np.cos(angle)[:, None] * ASIDE + np.sin(angle)[:, None] * NORMAL,
        driven=np.cos(turned)[:, None] * beyond + np.sin(turned)[:, None] * NORMAL,
        length=length,
    )


def joint_carried(
    joint: Joint, joint_angle: float, angle: ArrayLike, *, friction: float = 0.0, fed: bool = True, loads: bool = False
) -> JointCarried:
    """Return how the inner mechanism of a joint moves and what it carries.

    joint_angle [rad]; angle (p,) [rad]: of its driving mark from the plane of the shafts.
    friction: coefficient of its pairs that rub; fed: whether the driving shaft drives, else the driven one.
    loads: of the pairs whose loads it tells, see `Joint.loaded`.
    """
    return each_carried_in(joint, joint_angle, angle, [(friction, fed)], loads=loads)[0]


def each_carried_in(
    joint: Joint, joint_angle: float, angle: ArrayLike, asked: Sequence[tuple[float, bool]], *, loads: bool = False
) -> list[JointCarried]:
    """Return the same for several coefficients of friction, and whether the driving shaft drives."""
    if any(friction for friction, _fed in asked):
        joint = joint.fitting()
    stance = stance_of(joint, joint_angle, np.atleast_1d(np.asarray(angle, dtype=float)))
    own = tuple(joint.loaded(stance) if loads else joint.mechanism(stance))
    pairs = (*own, *joint.carried(stance))
    every = dict.fromkeys(link_of(one, end) for one in pairs for end in (0, 1))
    moving = [
        inner.DRIVING,
        inner.DRIVEN,
        *(one for one in every if one not in (inner.DRIVING, inner.DRIVEN, inner.FRAME)),
    ]
    number = {link: k for k, link in enumerate(moving)} | {inner.FRAME: FRAME}
    wide = stance.driving.shape

    def rows(name: str) -> Array:
        table = [getattr(one, name) if getattr(one, name) is not None else NORMAL for one in pairs]
        return np.stack([np.broadcast_to(one, wide) for one in table], axis=-2)

    if not np.all(np.isfinite(rows("point"))) or not np.all(np.isfinite(stance.driven)):
        raise refuse("joint_angle", joint.stuck(joint_angle), "out_of_range")
    placed = Placed(
        links=len(moving),
        ends=tuple((number[link_of(one, 0)], number[link_of(one, 1)]) for one in pairs),
        kinds=tuple(PAIRS[one.type] for one in pairs),
        point=rows("point"),
        axis=frames.unit(rows("axis")),
        second=rows("second"),
        lever=tuple(one.lever for one in pairs),
        spread=tuple(one.spread for one in pairs),
    )
    axis = np.broadcast_to(joint.shaft_behind(stance)[1], wide)
    load = np.zeros((wide[0], len(moving), 6))
    load[:, 1, :3] = -axis
    about = np.concatenate((BEFORE, np.zeros(3)))
    ways = [(tuple(_rubs(one, mu) for one in pairs), fed) for mu, fed in asked]
    return [
        JointCarried(pairs=pairs, inner=len(own), placed=placed, found=found, axis=axis)
        for found in each_carried(placed, ways, input_link=0, about=about, load=load)
    ]


def _rubs(pair: InnerPair, friction: float) -> float:
    """Return the coefficient of friction of a pair in a joint with such a one, none where this has none."""
    return 0.0 if not (pair.rubs and friction) else friction if pair.friction is None else pair.friction


def link_of(pair: InnerPair, end: int) -> str:
    """Return the name of the first or second link of a pair, of several alike each with its number."""
    return pair.links[end].replace("{count}", str(pair.count))


# What a joint rubs away and how that pushes its shafts, as tables over its turn.

PLACES = 72
"""Places of a turn at which what a joint rubs away is taken; its curve has kinks, between them it is straight."""

CLOSER = 360
"""The same of what friction does to its shafts, which jumps, where few joint angles are asked."""

NODE = np.radians(1.0)
"""Step of the joint angles at which it is taken where many are asked."""

FEW = 4
"""Joint angles up to which each is taken by itself."""

HALVINGS = 7
"""How often the friction at which a joint locks is halved about: to a per cent."""

DIGITS = 12
"""Decimals to which a joint angle counts: two that differ by rounding are one."""


def rubbed_share(joint: Joint, joint_angle: ArrayLike, angle: Array, *, many: bool = False) -> tuple[Array, Array]:
    """Return what a joint rubs away over the power of its driving shaft, while this drives and while the other does.

    joint_angle (...) [rad]; angle (...) [rad]: of its driving mark from the plane of the shafts.
    many: whether many joint angles are asked: by a cubic through those at full degrees, each solved once.
    Returns two arrays (...).
    """
    fed, back = _looked_up(_shares, PLACES, joint, joint_angle, angle, many=many)[:, 0]
    return (np.maximum(fed, 0.0), np.maximum(back, 0.0)) if many else (fed, back)


def check_turning(field: str, joint: Joint, joint_angle: ArrayLike, angle: Array, share: Array) -> None:
    """Refuse a joint that its own friction locks.

    field: what the refusal names; share: of `rubbed_share` at joint_angle and angle, while its driving shaft drives.
    """
    locked = ~(share < 1.0)
    if not np.any(locked):
        return
    alpha, theta = (np.broadcast_to(one, locked.shape)[locked].flat[0] for one in (joint_angle, angle))
    mu = joint.friction or 0.0
    low, high = 0.0, mu
    with np.errstate(all="ignore"):
        for _half in range(HALVINGS):
            middle = 0.5 * (low + high)
            own = replace(joint, friction=middle)
            turns = bool(over(_shares(own, round(float(alpha), DIGITS), PLACES)[0, 0], np.asarray(theta)) < 1.0)
            low, high = (middle, high) if turns else (low, middle)
    text = _(
        "with a friction of {friction:.3g} it locks: where its driving mark stands {angle:.4g}° from the plane of the "
        "shafts, at a joint angle of {joint_angle:.4g}°, all power rubs away; it turns there below {most:.2g}"
    )
    if not low:  # pairs of a joint of one's own with a friction of their own lock it
        text = _(
            "with the friction of its pairs it locks: where its driving mark stands {angle:.4g}° from the plane of the "
            "shafts, at a joint angle of {joint_angle:.4g}°, all power rubs away"
        )
    place = {"angle": np.degrees(theta) % 360.0, "joint_angle": np.degrees(alpha)}
    raise refuse(field, text.format(friction=mu, most=low, **place), "out_of_range")


def rubbed_push(joint: Joint, joint_angle: ArrayLike, angle: Array, *, many: bool = False) -> Array:
    """Return what friction in a joint adds to its couple and force on the driven shaft, for 1 N·m on this.

    As `rubbed_share`. Returns (2, 4, ...) [1, 1/m]: while the driving shaft drives and while the other does, the couple
    about the normal N of the plane of the shafts, and the force along e, N×e and N; the couple across N follows from
    the share, as that about the driven shaft is given.
    """
    return _looked_up(_pushes, PLACES if many else CLOSER, joint, joint_angle, angle, many=many)


def rubbed_pins(joint: Joint, joint_angle: ArrayLike, angle: Array) -> Array:
    """Return the couples of friction about both pins of a cross for 1 N·m on its driven shaft, array (2, 2, ...).

    As `rubbed_share`: while the driving shaft drives and while the other does, of the driving yoke on the cross and of
    the cross on the driven yoke.
    """
    return _looked_up(_pins, CLOSER, joint, joint_angle, angle, many=False)


def _looked_up(
    table: Callable[[Joint, float, int], Array],
    places: int,
    joint: Joint,
    joint_angle: ArrayLike,
    angle: Array,
    *,
    many: bool,
) -> Array:
    """Return tables (2, r, places) of a joint at joint angles and angles (...) of its mark, array (2, r, ...)."""
    alpha, theta = (np.asarray(one, dtype=float) for one in (joint_angle, angle))
    shape = np.broadcast_shapes(alpha.shape, theta.shape)
    alpha, theta = (np.ravel(np.broadcast_to(one, shape)) for one in (alpha, theta))
    found: list[tuple[Array, Array]] = []
    if many:
        cell = np.maximum((alpha / NODE).astype(int) - 1, 0)
        for first in np.unique(cell):
            own = cell == first
            nodes = [(int(first) + k) * NODE for k in range(4)]
            rows = 0.0
            for a in nodes:
                weight = np.prod([(alpha[own] - b) / (a - b) for b in nodes if b != a], axis=0)
                rows = rows + weight * over(table(joint, a, places), theta[own])
            found.append((own, rows))
    else:
        rounded = np.round(alpha, DIGITS)
        for one in np.unique(rounded):
            own = rounded == one
            found.append((own, over(table(joint, float(one), places), theta[own])))
    whole = np.empty((*found[0][1].shape[:-1], alpha.size))
    for own, rows in found:
        whole[..., own] = rows
    return np.reshape(whole, (*whole.shape[:-1], *shape))


def over(values: Array, angle: Array) -> Array:
    """Return values (..., p) at even places of a turn at angles [rad] of any shape, straight between them."""
    place = np.remainder(angle, 2.0 * np.pi) * (values.shape[-1] / (2.0 * np.pi))
    low = np.floor(place)
    here, share = low.astype(int) % values.shape[-1], place - low
    found: Array = (1.0 - share) * values[..., here] + share * values[..., (here + 1) % values.shape[-1]]
    return found


@lru_cache(maxsize=512)
def _shares(joint: Joint, joint_angle: float, places: int) -> Array:
    """Return both shares of `rubbed_share` at even places of a turn, array (2, 1, places)."""
    turned = _turned(joint, joint_angle, places)
    more = (
        (joint.friction or 0.0) * _slipping(joint, joint_angle, turned[0].placed.point.shape[0], places)
        if turned
        else 0
    )
    found = []
    for one, sense in zip(turned[:2], (1.0, -1.0), strict=False):
        power = np.abs(one.input_torque * one.found.speed[:, 0, 0])
        with np.errstate(all="ignore"):
            share = (one.loss * power + more) / (power + sense * more)
        found.append(np.where(one.found.locked, np.nan, share) if sense > 0.0 else share)
    return _all_round(joint, np.reshape(np.stack(found), (2, 1, -1)) if found else np.zeros((2, 1, places)), places)


def _slipping(joint: Joint, joint_angle: float, count: int, places: int) -> Array:
    """Return the sum of forces times speeds of sliding that a joint tells beside its mechanism, array (count,).

    For 1 N·m on its driven shaft and 1 rad/s of its driving one, without friction, at places of a turn from 0.
    """
    angle = np.arange(count) * (2.0 * np.pi / places)
    if not any(np.any(pair.slip) for pair in joint.loaded(stance_of(joint, joint_angle, angle[:1]))):
        return np.zeros(count)
    found = joint_carried(joint, joint_angle, angle, loads=True)
    force = frames.norm(found.found.reaction[..., 3:])
    return np.asarray(sum(force[:, k] * pair.slip for k, pair in enumerate(found.pairs)))


@lru_cache(maxsize=512)
def _pushes(joint: Joint, joint_angle: float, places: int) -> Array:
    """Return what `rubbed_push` finds at even places of a turn, array (2, 4, places)."""
    found = [one.wrench[:, 2:] for one in _turned(joint, joint_angle, places)]
    if not found:
        return np.zeros((2, 4, places))
    return _all_round(joint, np.stack([np.swapaxes(one - found[2], 0, 1) for one in found[:2]]), places)


@lru_cache(maxsize=512)
def _pins(joint: Joint, joint_angle: float, places: int) -> Array:
    """Return what `rubbed_pins` finds at even places of a turn, array (2, 2, places)."""
    rows = []
    for one in _turned(joint, joint_angle, places)[:2]:
        rate = frames.dot(one.found.rate[:, :2, :3], one.placed.axis[:, :2])
        turns = np.abs(rate) > STRAIGHT * np.max(np.abs(rate))
        rows.append(-np.where(turns, one.found.loss[:, :2] / np.where(turns, rate, 1.0), 0.0).T)
    return _all_round(joint, np.stack(rows), places) if rows else np.zeros((2, 2, places))


@lru_cache(maxsize=64)  # what it rubs away and how that pushes are asked one after the other
def _turned(joint: Joint, joint_angle: float, places: int) -> list[JointCarried]:
    """Return a joint over a turn, or the part after which it repeats, while either shaft drives, then frictionless."""
    if joint_angle < STRAIGHT:
        return []
    count = places // (joint.alike if places % joint.alike == 0 else 1)
    angle = np.arange(count) * (2.0 * np.pi / places)
    mu = joint.friction or 0.0
    with np.errstate(all="ignore"):  # friction that locks grows beyond all numbers
        return each_carried_in(joint, joint_angle, angle, [(mu, True), (mu, False), (0.0, True)])


def _all_round(joint: Joint, rows: Array, places: int) -> Array:
    """Return rows over the part of a turn after which a joint repeats as rows over the whole turn."""
    return np.tile(rows, places // rows.shape[-1])
