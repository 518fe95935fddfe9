"""What a drive under torque asks of its shafts and crosses over a turn: largest torques, secondary couples, moments."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm

import numpy as np

from cardan.drive.conditions import LoadCase
from cardan.drive.drive import Drive
from cardan.drive.duty import Harmonic
from cardan.drive.joints import Joint
from cardan.drive.models.kinematics_model import Chain, Laws, given_chain, turning
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peak
from cardan.questions.motion.motion import Motion, motion

LOOK = 120
"""Places in half a turn at which loads are looked at, before a curve is laid through the largest."""

STRAIGHT = 1e-9
"""Sine of the joint angle below which a joint passes on a torque as a straight one."""

LONGEST = 12
"""Turns over which torques that swing out of step with the turning are followed at most."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TurnLoads:
    """Loads of drives over a turn, masses and friction not counted; leading axes (...) are those of the drives."""

    low: Array  # low, high (..., n+1) [N·m]: least and largest torque of each shaft, counted along its mean
    high: Array  # (..., n+1) [N·m]
    couple: Array  # (..., n) [N·m]: largest couple of each cross; over the span it is the load of a journal
    # driving, driven (..., n) [N·m]: largest secondary couple of each joint on its driving and on its driven shaft
    driving: Array
    driven: Array  # (..., n) [N·m]
    # (..., n+1) [N·m]: largest √(4 M_b² + 3 T²) at either end of each shaft: over W_t it is the stress by von Mises
    mises: Array

    @property
    def torque(self) -> Array:
        """Largest size of the torque of each shaft, array (..., n+1) [N·m]."""
        return np.maximum(np.abs(self.low), np.abs(self.high))

    @property
    def bending(self) -> Array:
        """Largest secondary couple at either end of each shaft, array (..., n+1) [N·m]."""
        return _at_ends(self.driving, self.driven)

    @property
    def moment(self) -> Array:
        """Largest √(T² + M_b²) at either end of each shaft, that of Book (261), array (..., n+1) [N·m]."""
        return np.maximum(_at_ends(self.couple, self.couple), self.torque)


def turn_loads(
    chain: Chain,
    torque: ArrayLike,
    *,
    torque_at: str = "output",
    harmonics: Sequence[Harmonic] = (),
    scale: ArrayLike = 0.0,
    look: int = LOOK,
) -> TurnLoads:
    """Return the largest loads of the shafts and crosses of drives over a turn.

    Parameters
    ----------
    chain : Chain
        Kinematic half of one drive or of many (...).
    torque : array (...) [N·m]
        Mean torque at the end where it is given.
    torque_at : str
        ``output`` or ``input``.
    harmonics : sequence of Harmonic
        Its swinging parts, in the angle of the shaft there.
    scale : float or array (...) [N·m]
        Mean torque that the harmonics belong to, and with which they grow; they do not where it is zero.
    look : int
        Places in half a turn at which loads are looked at.

    Notes
    -----
    Without masses and friction the power is the same in every shaft: M_i ω_i = M ω. A cross carries the couple
    K = M_i/cos θ, of which K sin θ bends its shaft, in a direction fixed in it: Book (100), (103), (114).

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.drive.models.kinematics_model import chain
    >>> found = turn_loads(chain(Drive.from_angles([0.35])), 100.0)
    >>> print(found.high.round(3), found.bending.round(3))
    [106.454 100.   ] [34.29  36.503]
    """
    period = 2.0 * math.pi * turns(harmonics) if harmonics else math.pi
    places = round(look * period / math.pi)
    angle = np.arange(places) * (period / places)
    found = motion(chain, angle)
    ratio = found.shaft_ratio
    end = -1 if torque_at == "output" else 0
    mean = np.asarray(torque, dtype=float)[..., None]
    turned = found.shaft_angle[..., end, :]
    swing = sum((one.torque * np.cos(one.order * turned + one.phase) for one in harmonics), 0.0 * turned)
    base = np.asarray(scale, dtype=float)[..., None]
    grown = np.where(base == 0.0, 1.0, mean / np.where(base == 0.0, 1.0, base))
    sign = np.where(mean < 0.0, -1.0, 1.0)
    given = sign * (mean + grown * swing)
    passing = given[..., None, :] * ratio[..., [end], :] / ratio
    low, high = -peak(-passing), peak(passing)
    return largest_loads(chain, found, passing[..., :-1, :], passing[..., 1:, :], low=low, high=high)


def largest_loads(
    chain: Chain, moved: Motion, entering: Array, leaving: Array, *, low: Array, high: Array
) -> TurnLoads:
    """Return the largest loads over a turn from the torques in the shafts on either side of every joint.

    moved: the motion at evenly spaced places (p,) of a period; entering, leaving (..., n, p) [N·m]: torques of the
    driving and of the driven shaft of every joint there; low, high (..., n+1) [N·m]: least and largest of each shaft.
    """
    ratio, theta = moved.shaft_ratio, moved.yoke_rotation
    joint_angle = np.asarray(moved.joint_angle, dtype=float)[..., None]
    before, after = np.abs(entering), np.abs(leaving)
    if chain.laws is None:
        lean = np.sqrt(1.0 + (np.tan(joint_angle) * np.sin(theta)) ** 2)
        couple = before * lean
        on_driving = before * np.tan(joint_angle) * np.abs(np.sin(theta))
        on_driven = couple * np.sin(joint_angle) * np.abs(np.cos(theta))
    else:
        one, other = across(chain.laws, theta, ratio[..., 1:, :] / ratio[..., :-1, :])
        couple, on_driving, on_driven = before * np.hypot(1.0, one), before * one, before * other
    # K² = T² + M_b² on either shaft, so 4 M_b² + 3 T² = 4 K² - T².
    mises = (np.sqrt(4.0 * couple**2 - one**2) for one in (before, after))
    ends = _at_ends(*(peak(one) for one in mises)) if joint_angle.shape[-2] else math.sqrt(3.0) * np.abs(high)
    found = TurnLoads(
        low=low, high=high, couple=peak(couple), driving=peak(on_driving), driven=peak(on_driven), mises=ends
    )
    return found if chain.laws is None else sprung(found, chain.laws)


def sprung(found: TurnLoads, laws: Laws) -> TurnLoads:
    """Return loads with the couples of joints that hold against their joint angle.

    They stand on the plane of the shafts, those that go with an even torque in it.
    """
    if not np.any(laws.spring):
        return found
    couple = np.asarray(laws.spring * laws.joint_angle)
    whole = {name: np.hypot(getattr(found, name), couple) for name in ("couple", "driving", "driven")}
    return replace(found, **whole, mises=np.hypot(found.mises, 2.0 * _at_ends(couple, couple)))


def across(laws: Laws, theta: Array, ratio: Array) -> tuple[Array, Array]:
    """Return what a joint of any kind bends its shafts with, over the torque of its driving shaft.

    laws (..., n).
    theta, ratio (..., n, p) [rad, 1]: angles of their driving marks, and the speed ratio i of each joint.
    Returns driving, driven (..., n, p): couples across the driving and the driven shaft.
    A joint holds one turn of the driven shaft against the driving one, φ' = f(φ, α). No couple that it carries works on
    a motion it allows: on turning, i e' - e, and on bending, N + f_α e'. So the couple is
    (e, N×e, N): T (1, (1 - i cos α)/(i sin α), -f_α/i), and across the driven shaft ((cos α - i)/(i sin α), f_α/i) T:
    T tan(α/2) across both where i = 1 and f_α = 0, and for a Hooke joint T tan α |sin φ|.
    """
    joint_angle, steep, growth = (
        np.asarray(part)[..., None] for part in (laws.joint_angle, laws.steepness, laws.growth)
    )
    aside, swept = lean(theta, ratio, joint_angle, steep, growth)
    # (cos α - i)/sin α = (1 - i cos α)/sin α cos α - i sin α, without a difference of near numbers
    other = aside * np.cos(joint_angle) - np.sin(joint_angle)
    return np.hypot(aside, swept), np.hypot(other, swept)


def lean(theta: Array, ratio: Array, joint_angle: Array, steepness: Array, growth: Array) -> tuple[Array, Array]:
    """Return the parts of a joint's couple along N×e and against N, over that along e, arrays like ``theta``.

    theta [rad]: angle of the driving mark; ratio: speed ratio of the joint.
    joint_angle, steepness, growth: α, κ and dκ/dα, in the shape of the angles.
    (1 - i cos α)/(i sin α) = tan(α/2) - (i - 1)/(i sin α), and f_α/i with f = arctan(κ tan θ).
    """
    sine, cosine, bent = np.sin(theta), np.cos(theta), np.sin(joint_angle)
    swept = growth * sine * cosine / (cosine**2 + (steepness * sine) ** 2)
    uneven = np.where(bent > STRAIGHT, (ratio - 1.0) / np.where(bent > STRAIGHT, bent, 1.0), 0.0)
    return np.tan(0.5 * joint_angle) - uneven / ratio, swept / ratio


def at_joint_angle(chain: Chain, joint_angle: Array, joints: Sequence[Joint]) -> Chain:
    """Return a chain with other joint angles of its joints, array (..., n) [rad], its planes and yokes as they are.

    chain (..., n): as the joints are given, not as they turn; joint_angle (..., n) [rad].
    """
    wide = np.broadcast_shapes(joint_angle.shape, chain.joint_angle.shape)
    return turning(replace(chain, joint_angle=np.broadcast_to(joint_angle, wide)), joints, near=True)


def case_loads(drive: Drive, case: LoadCase) -> TurnLoads:
    """Return the largest loads of a drive over a turn in one way of running."""
    given = given_chain(drive)
    own = given.joint_angle if case.joint_angle is None else np.full(np.shape(given.joint_angle), case.joint_angle)
    whole = at_joint_angle(given, own, drive.joints)
    return turn_loads(whole, case.torque or 0.0, torque_at=case.torque_at, harmonics=case.harmonics, scale=case.scale)


def turns(harmonics: Sequence[Harmonic]) -> int:
    """Return after how many turns torques with these swings repeat, `LONGEST` at most."""
    steps = [Fraction(one.order).limit_denominator(LONGEST).denominator for one in harmonics]
    return min(lcm(*steps), LONGEST) if steps else 1


def _at_ends(driving: Array, driven: Array) -> Array:
    """Return the larger of what joints put on either end of each shaft, array (..., n+1)."""
    nothing = 0.0 * driving[..., :1]
    found: Array = np.maximum(np.concatenate((nothing, driven), axis=-1), np.concatenate((driving, nothing), axis=-1))
    return found
