"""What joints turn beside their nearest map tan θ' = κ tan θ, as Fourier sums: every law, exactly."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.texts import _

from .geometry import Geometry, geometry, geometry_from_angles, one_of
from .kinematics_model import NEGLIGIBLE, Chain, unmapped
from .wobble import leads, wobbling

PLACES = (128, 512, 2048)
"""Places of a turn at which a law is taken: more where it has more harmonics."""

POINTS = 64 * PLACES[0]
"""Places of all bends at which a law is taken at once."""

SEEN = 512
"""Places of a turn at which the laws of joints are seen that wobbling shafts change."""

KEPT = 4096
"""Bends of a joint whose sums are kept."""

FLOOR = 1e-13
"""Harmonics below this [rad], or below four times the largest of the upper quarter, are rounding."""

ROUGH = 1e-9
"""Largest harmonic of the upper quarter [rad] of a law that is not followed closely enough."""


def beside_maps(drive: Drive, given: Chain, near: Chain, place: Geometry | None = None) -> Array | None:
    """Return what each joint turns beside the Hooke joint of a chain, or None where no joint is far from its map.

    given (..., n): bends of the joints of a drive as they are; near (..., n): the Hooke joints nearest to them.
    place (...): where the joints are then; from their angles, with lengths as drawn, when not given.
    What a joint feels of a wobbling shaft before it is in its law, see `leads`.
    Returns complex (..., K+1, n) [rad]: c_k of T(θ) - T_near(θ) = Re Σ c_k e^(ikθ), θ the angle of the driving yoke of
    the Hooke joint from the plane of its shafts; 0 for a joint that no more than `NEGLIGIBLE` is off its map.
    Raises InputError: a law so sharp that no sum follows it.
    """
    joints = drive.joints
    shape = np.shape(given.joint_angle)
    if near.laws is None:
        return None
    ahead = np.broadcast_to(near.laws.ahead, shape)
    found: dict[int, Array] = {}
    felt = wobbling(drive)
    if felt:
        seen = _beside_wobbles(drive, given, near.joint_angle, ahead, place)
        found = {i: np.stack(row).reshape(*shape[:-1], -1) for i, row in seen.items()}
    for i in unmapped(joints) if not felt else ():
        bends, spot = np.unique(np.asarray(given.joint_angle)[..., i], return_inverse=True)
        alike = np.asarray(near.joint_angle)[..., i].reshape(-1)
        turned = ahead[..., i].reshape(-1)
        first = np.unique(spot.reshape(-1), return_index=True)[1]
        rows = _rows(joints[i], i, bends, alike[first], turned[first])
        wide = max(len(row) for row in rows)
        sums = np.stack([np.pad(row, (0, wide - len(row))) for row in rows])[spot.reshape(-1)]
        found[i] = sums.reshape(*shape[:-1], wide)
    if not any(np.any(one) for one in found.values()):
        return None
    sums = np.zeros((*shape[:-1], max(one.shape[-1] for one in found.values()), len(joints)), dtype=complex)
    for i, one in found.items():
        sums[..., : one.shape[-1], i] = one
    return sums


def _beside_wobbles(
    drive: Drive, given: Chain, alike: Array, ahead: Array, place: Geometry | None
) -> dict[int, list[Array]]:
    """Return the same where shafts wobble: c_k of each joint at every bend, array (K+1,) each, of one length."""
    many = np.shape(given.joint_angle)[:-1]
    each = (given.joint_angle, given.plane_twist, given.yoke_angle, alike, ahead)
    wide = (np.broadcast_to(one, (*many, np.shape(one)[-1])) for one in each)
    rows = zip(*(np.reshape(one, (math.prod(many), one.shape[-1])) for one in wide), strict=True)
    length = geometry(drive).length
    parts = drive.joints, drive.supports, tuple((one.number, one.length, one.spline) for one in drive.shafts)
    found: list[tuple[Array, ...]] = []
    for k, (bends, twists, yokes, hooke, turned) in enumerate(rows):
        there = geometry_from_angles(bends, np.append(0.0, twists), length) if place is None else one_of(place, k)
        key = (parts, *(one.tobytes() for one in (there.points, there.normal, yokes, hooke, turned)))
        known = _WOBBLES.get(key)
        if known is None:
            if len(_WOBBLES) >= KEPT:
                _WOBBLES.clear()
            known = _WOBBLES[key] = _beside_wobble(drive, there, yokes, hooke, turned)
        found.append(known)
    longest = max(len(row) for one in found for row in one)
    return {i: [np.pad(one[i], (0, longest - len(one[i]))) for one in found] for i in range(given.joints)}


def _beside_wobble(drive: Drive, place: Geometry, yokes: Array, hooke: Array, turned: Array) -> tuple[Array, ...]:
    """Return c_k of each joint of one drive, array (K+1,) each, beside Hooke joints at angles, turned ahead (n,)."""
    theta = np.arange(SEEN) * (2.0 * np.pi / SEEN)
    led = leads(drive, place, yokes, theta - turned[:, None])
    rest = led - mobius.angle_error(mobius.hooke(hooke[:, None]), unit_complex(2.0 * theta))
    rows = (_sums(one, i, last=True) for i, one in enumerate(rest))
    return tuple(np.zeros(1, dtype=complex) if row is None else row.copy() for row in rows)


_WOBBLES: dict[Any, tuple[Array, ...]] = {}
"""What is known of joints behind shafts that wobble: variants of a drive, and verdicts, ask for the same again."""


@lru_cache(maxsize=64)
def _known(joint: Joint) -> dict[tuple[float, float, float], Array]:
    """Return the sums of a joint that are known, by joint angle, that of the Hooke joint and its turn ahead [rad]."""
    return {}


def _rows(joint: Joint, i: int, joint_angle: Array, alike: Array, ahead: Array) -> list[Array]:
    """Return c_k, array (K+1,) each, of one joint at bends (m,) [rad] beside Hooke joints of others, turned ahead.

    Variants of a drive ask for the same bends again and again, and movements for many at once.
    """
    keys = list(zip(joint_angle.tolist(), alike.tolist(), ahead.tolist(), strict=True))
    known = _known(joint)
    if len(known) > KEPT:
        known.clear()
    new = np.asarray([k for k, key in enumerate(keys) if key not in known], dtype=int)
    own = {
        keys[k]: row for k, row in zip(new, _series(joint, i, joint_angle[new], alike[new], ahead[new]), strict=True)
    }
    known.update(own)
    return [known[key] if key in known else own[key] for key in keys]


def _series(joint: Joint, i: int, joint_angle: Array, alike: Array, ahead: Array) -> list[Array]:
    """Return c_k of one joint at bends (m,) [rad], found anew: those together whose law takes many."""
    found: list[Array] = [np.zeros(1, dtype=complex)] * len(joint_angle)
    left = list(range(len(joint_angle)))
    for count in PLACES:
        theta = np.arange(count) * (2.0 * np.pi / count)
        together = max(1, POINTS // count) if joint.many_angles else 1
        coarse: list[int] = []
        for first in range(0, len(left), together):
            some = np.asarray(left[first : first + together])
            with np.errstate(invalid="ignore", divide="ignore"):
                if len(some) > 1:
                    lead = joint.deviation(theta - ahead[some, None], joint_angle[some, None])[0]
                else:
                    lead = joint.deviation(theta - ahead[some[0]], np.asarray(joint_angle[some[0]]))[0]
            hooke = mobius.angle_error(mobius.hooke(alike[some, None]), unit_complex(2.0 * theta))
            for k, rest in zip(some.tolist(), lead - hooke, strict=True):
                row = _sums(rest, i, last=count == PLACES[-1])
                if row is None:
                    coarse.append(k)
                else:
                    found[k] = row
        left = coarse
    return found


def _sums(rest: Array, i: int, *, last: bool) -> Array | None:
    """Return c_k of what a law leaves at even places (p,) [rad], None where more of them are to tell it."""
    count = len(rest)
    if not np.max(np.abs(rest)) > NEGLIGIBLE:
        return np.zeros(1, dtype=complex)
    wave = np.fft.rfft(rest) * (2.0 / count)
    wave[0] *= 0.5
    size = np.abs(wave)
    upper = float(np.max(size[3 * count // 8 :]))
    if upper > FLOOR and not last:
        return None
    text = _("its law is too sharp to be followed: at order {order} of the turn it still has {size:.2g}°")
    sharp = text.format(order=len(wave) - 1, size=float(np.degrees(upper)))
    check([Problem(f"joints[{i}].joint_angle", sharp, "out_of_range")] if upper > ROUGH else [])
    there = size > max(FLOOR, 4.0 * upper)
    return np.asarray(np.where(there, wave, 0.0)[: np.flatnonzero(there)[-1] + 1])
