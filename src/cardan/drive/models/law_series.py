"""What joints turn beside their nearest map tan θ' = κ tan θ, as Fourier sums: every law, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from cardan.drive.joints import Joint
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.texts import _

from .kinematics_model import NEGLIGIBLE, Chain, unmapped

PLACES = (128, 512, 2048)
"""Places of a turn at which a law is taken: more where it has more harmonics."""

POINTS = 64 * PLACES[0]
"""Places of all bends at which a law is taken at once."""

KEPT = 4096
"""Bends of a joint whose sums are kept."""

FLOOR = 1e-13
"""Harmonics below this [rad], or below four times the largest of the upper quarter, are rounding."""

ROUGH = 1e-9
"""Largest harmonic of the upper quarter [rad] of a law that is not followed closely enough."""


def beside_maps(joints: Sequence[Joint], given: Chain, near: Chain) -> Array | None:
    """Return what each joint turns beside the Hooke joint of a chain, or None where no joint is far from its map.

    joints; given (..., n): their bends as they are; near (..., n): the Hooke joints nearest to them.
    Returns complex (..., K+1, n) [rad]: c_k of T(θ) - T_near(θ) = Re Σ c_k e^(ikθ), θ the angle of the driving yoke of
    the Hooke joint from the plane of its shafts; 0 for a joint that no more than `NEGLIGIBLE` is off its map.
    Raises InputError: a law so sharp that no sum follows it.
    """
    own = unmapped(joints)
    if not own or near.laws is None:
        return None
    shape = np.shape(given.joint_angle)
    ahead = np.broadcast_to(near.laws.ahead, shape)
    found: dict[int, Array] = {}
    for i in own:
        bends, place = np.unique(np.asarray(given.joint_angle)[..., i], return_inverse=True)
        alike = np.asarray(near.joint_angle)[..., i].reshape(-1)
        turned = ahead[..., i].reshape(-1)
        first = np.unique(place.reshape(-1), return_index=True)[1]
        rows = _rows(joints[i], i, bends, alike[first], turned[first])
        wide = max(len(row) for row in rows)
        sums = np.stack([np.pad(row, (0, wide - len(row))) for row in rows])[place.reshape(-1)]
        found[i] = sums.reshape(*shape[:-1], wide)
    if not any(np.any(one) for one in found.values()):
        return None
    sums = np.zeros((*shape[:-1], max(one.shape[-1] for one in found.values()), len(joints)), dtype=complex)
    for i, one in found.items():
        sums[..., : one.shape[-1], i] = one
    return sums


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
    kept = np.flatnonzero(size > max(FLOOR, 4.0 * upper))
    return np.asarray(wave[: kept[-1] + 1])
