"""What joints turn beside their nearest map tan θ' = κ tan θ, as Fourier sums: every law, exactly."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.drive.joints import Joint
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.texts import _

from .kinematics_model import NEGLIGIBLE, Chain, unmapped

PLACES = (128, 512, 2048)
"""Places of a turn at which a law is taken: more where it has more harmonics."""

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
        rows = [_series(joints[i], i, *each) for each in zip(bends, alike[first], turned[first], strict=True)]
        wide = max(len(row) for row in rows)
        sums = np.stack([np.pad(row, (0, wide - len(row))) for row in rows])[place.reshape(-1)]
        found[i] = sums.reshape(*shape[:-1], wide)
    if not any(np.any(one) for one in found.values()):
        return None
    sums = np.zeros((*shape[:-1], max(one.shape[-1] for one in found.values()), len(joints)), dtype=complex)
    for i, one in found.items():
        sums[..., : one.shape[-1], i] = one
    return sums


def _series(joint: Joint, i: int, joint_angle: float, alike: float, ahead: float) -> Array:
    """Return c_k, array (K+1,), of one joint at a bend [rad] beside the Hooke joint of another, turned ahead [rad]."""
    upper = np.zeros(1)
    for count in PLACES:
        theta = np.arange(count) * (2.0 * np.pi / count)
        with np.errstate(invalid="ignore", divide="ignore"):
            rest = joint.deviation(theta - ahead, np.asarray(joint_angle))[0]
        rest = rest - mobius.angle_error(mobius.hooke(np.asarray(alike)), unit_complex(2.0 * theta))
        if not np.max(np.abs(rest)) > NEGLIGIBLE:
            return np.zeros(1, dtype=complex)
        wave = np.fft.rfft(rest) * (2.0 / count)
        wave[0] *= 0.5
        size = np.abs(wave)
        upper = size[3 * count // 8 :]
        if np.max(upper) <= FLOOR:
            break
    text = _("its law is too sharp to be followed: at order {order} of the turn it still has {size:.2g}°")
    sharp = text.format(order=len(wave) - 1, size=float(np.degrees(np.max(upper))))
    check([Problem(f"joints[{i}].joint_angle", sharp, "out_of_range")] if np.max(upper) > ROUGH else [])
    kept = np.flatnonzero(size > max(FLOOR, 4.0 * float(np.max(upper))))
    return np.asarray(wave[: kept[-1] + 1])
