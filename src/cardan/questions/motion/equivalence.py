"""Which single joint does the drive amount to, and how uneven is it?"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain, nearly_turning_chain, unlike_hooke
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.texts import _

SYNCHRONOUS = 1e-13
"""Below this speed fluctuation a drive is synchronous to rounding and its equivalent joint has no phase."""

SPECK = 1e-6
"""Speed fluctuation that coordinates rounded to a micrometre leave: nobody notices it; no drive is uneven for it."""

FLOOR = 1e-9
"""Amplitude of an order [°] below which there is only rounding."""

WARN_JOINT_ANGLE = 45.0
"""Bend [deg] above which no real cross joint works."""


@dataclass(frozen=True, eq=False, kw_only=True)
class EquivalentJoint:
    """The single Hooke joint with the same law of motion; leading axes are those of the drives.

    Attributes
    ----------
    pair : Pair (...)
        Möbius pair of the whole drive.
    shaft_speed_fluctuation : array (..., n)
        δ of shafts 2 … n+1.
    vertex : complex array (..., n+1)
        Corners of the phase polygon in the unit disk, from the origin on; the last one is the origin when synchronous.
    """

    pair: mobius.Pair
    shaft_speed_fluctuation: Array
    vertex: Array

    @property
    def tau(self) -> Array:
        """τ = tan²(α/2), array (...)."""
        return mobius.tau(self.pair)

    @property
    def joint_angle(self) -> Array:
        """Equivalent angle α_eq, array (...) [rad]."""
        return mobius.joint_angle(self.pair)

    @property
    def phase(self) -> Array:
        """Phase ψ_eq in [0, π), array (...) [rad]; nan where the drive is synchronous to rounding."""
        xp = namespace(self.shaft_speed_fluctuation)
        angle = mobius.phase(self.pair)
        return xp.where(self.speed_fluctuation < SYNCHRONOUS, xp.nan + angle, xp.remainder(angle, xp.pi + 0.0 * angle))

    @property
    def speed_fluctuation(self) -> Array:
        """δ = i_max - i_min = (ω_max - ω_min)/ω_1, array (...); Book (79)."""
        return self.shaft_speed_fluctuation[..., -1]

    @property
    def ratio_max(self) -> Array:
        """Largest speed ratio 1/cos α_eq, array (...)."""
        a, b = self.pair
        xp = namespace(a)
        return (xp.abs(a) + xp.abs(b)) ** 2

    @property
    def ratio_min(self) -> Array:
        """Smallest speed ratio cos α_eq, array (...)."""
        return 1.0 / self.ratio_max

    @property
    def max_angle_error(self) -> Array:
        """Largest |φ_out - φ_in| about its mean, arcsin τ, array (...) [rad]."""
        xp = namespace(self.shaft_speed_fluctuation)
        return xp.asin(self.tau)

    @property
    def max_acceleration(self) -> Array:
        """Largest |ε_out|/ω_1² at uniform input, array (...)."""
        return largest_acceleration(self.joint_angle)

    def harmonics(self, count: int) -> Array:
        """Return the amplitudes τ^k/k of orders 2, 4 … 2·count of the angle error, array (..., count) [rad].

        The ratio has 2 τ^k there. Exact: a chain has no other harmonics than those of one joint.
        """
        xp = namespace(self.shaft_speed_fluctuation)
        k = xp.arange(1, count + 1, dtype=xp.float64)
        return self.tau[..., None] ** k / k


def equivalent_joint(drive: Drive | Drives | Chain) -> EquivalentJoint:
    """Return the single joint that moves like the whole drive.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.

    Returns
    -------
    EquivalentJoint
        joint_angle, phase, speed_fluctuation, ratio_max … : arrays (...).

    See Also
    --------
    motion, extremes

    Notes
    -----
    cos α_eq = (\\|a\\| - \\|b\\|)², δ = 4 \\|a\\| \\|b\\|, τ_eq = \\|b\\|/\\|a\\|; no positions are needed.
    α_eq is a square root of δ: rounding of 1e-16 in δ shows as 1e-6 degrees in α_eq, so judge synchronism by δ.

    Examples
    --------
    >>> from cardan import Drive, equivalent_joint
    >>> from cardan.units import deg
    >>> round(float(equivalent_joint(Drive.from_angles([12 * deg, 20 * deg])).joint_angle / deg), 4)
    16.1193
    """
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle)
    products = chain.products()
    corners = [mobius.vertex(pair) for pair in products]
    return EquivalentJoint(
        pair=products[-1],
        shaft_speed_fluctuation=xp.stack([mobius.speed_fluctuation(pair) for pair in products], axis=-1),
        vertex=xp.stack([0.0 * corners[0], *corners], axis=-1),
    )


def largest_acceleration(joint_angle: Array) -> Array:
    """Return the largest |ε_2|/ω_1² of a joint at uniform input, array (...).

    Notes
    -----
    4 c s² √(1-x²)/((1+c²)² (1-k x)²), k = s²/(1+c²), x = 4k/(1+√(1+8k²)); Book Table 4, recomputed. Evaluated with
    1-k = 2c²/(1+c²) and 1-x = 2(1-k)/(1+2k+√(1+8k²)), which keep all digits near 90°.
    """
    xp = namespace(joint_angle)
    c, square = xp.cos(joint_angle), xp.sin(joint_angle) ** 2
    k, x, short = _extreme(joint_angle)
    below = (1.0 + c * c) * (2.0 * c * c / (1.0 + c * c) + k * short)
    return 4.0 * c * square * xp.sqrt(short * (1.0 + x)) / below**2


def angle_of_largest_acceleration(joint_angle: Array) -> Array:
    """Return the first joint angle θ at which ε_2 has its (negative) extreme, array (...) [rad]; cos 2θ = x."""
    xp = namespace(joint_angle)
    _k, x, short = _extreme(joint_angle)
    return xp.atan2(xp.sqrt(short), xp.sqrt(1.0 + x))


def angle_of_largest_error(joint_angle: Array) -> Array:
    """Return the joint angle θ at which the driven shaft leads most, tan θ = √cos α, array (...) [rad]."""
    xp = namespace(joint_angle)
    return xp.atan(xp.sqrt(xp.cos(joint_angle)))


def _extreme(joint_angle: Array) -> tuple[Array, Array, Array]:
    """Return k, x and 1-x of `largest_acceleration`."""
    xp = namespace(joint_angle)
    c = xp.cos(joint_angle) ** 2
    k = xp.sin(joint_angle) ** 2 / (1.0 + c)
    root = xp.sqrt(1.0 + 8.0 * k * k)
    return k, 4.0 * k / (1.0 + root), 4.0 * c / ((1.0 + c) * (1.0 + 2.0 * k + root))


def after_each_joint(drive: Drive | Drives | Chain) -> EquivalentJoint:
    """Return the equivalent joints of the first 1 … n joints: what each shaft from 2 on does.

    drive (...): one drive, or many as arrays.
    Returns EquivalentJoint: bend, speed fluctuation, max_angle_error, max_acceleration … : arrays (..., n), for shafts
    2 … n+1.
    """
    whole = equivalent_joint(drive)
    products = kinematics(drive).products()
    xp = namespace(whole.vertex)
    pair = (xp.stack([a for a, _b in products], axis=-1), xp.stack([b for _a, b in products], axis=-1))
    return EquivalentJoint(
        pair=pair, shaft_speed_fluctuation=whole.shaft_speed_fluctuation[..., None], vertex=whole.vertex[..., 1:, None]
    )


# Which bend would let the joints of a drive cancel out?


@dataclass(frozen=True, eq=False, kw_only=True)
class Closure:
    """Whether the sides of the phase polygon can close, in numbers."""

    length: Array  # (n,): L_i = -ln cos α_i, hyperbolic length of each joint's side
    longest: int  # number of the joint with the longest side
    others: float  # sum of the other sides
    joint_angle_allowed: float  # [rad]: largest joint angle of that joint that the others can cancel

    @property
    def closes(self) -> bool:
        """Whether free yokes can make the drive synchronous."""
        return float(self.length[self.longest - 1]) <= self.others * (1.0 + 1e-14)


def closure(drive: Drive) -> Closure:
    """Return whether free yokes can close the phase polygon of a drive, and what the longest side may be.

    drive: the drive; held yokes are not looked at.
    Synchronous, exactly, if and only if L_max ≤ Σ of the others, cos α_max ≥ Π cos α of the others. Book (86) is its
    limit for small angles.
    """
    length = -np.log(np.cos(np.asarray(nearly_turning_chain(drive, _("yoke angles")).joint_angle)))
    longest = int(np.argmax(length))
    others = float(np.sum(length) - length[longest])
    # cos x = e^-S, as 2 asin √((1 - e^-S)/2): accurate for small bends.
    allowed = 2.0 * math.asin(math.sqrt(-0.5 * math.expm1(-others)))
    return Closure(length=length, longest=longest + 1, others=others, joint_angle_allowed=allowed)


# Is a small speed fluctuation one of the design, or only what the rounding of its figures leaves?

UNDONE = 0.01
"""Share of what all joints together could make of it, below which joints cancel each other but for rounding."""


def is_rounding(drive: Drive, share: float, length: Array | None = None) -> bool:
    """Tell whether a speed fluctuation is no more than the rounding of the figures that describe a drive leaves.

    Joint angles that coordinates give are never quite those meant, nor are those of joints that cancel each other; a
    joint angle that a file gives by itself is meant. What breaks a limit of the file is never put down to rounding.
    share: its speed fluctuation δ at some setting of its yokes.
    length (n,): sides of its phase polygon, where they are known.

    >>> is_rounding(Drive.from_angles([0.2, 0.2 + 1e-6]), 1e-7), is_rounding(Drive.from_angles([1e-3]), 1e-7)
    (True, False)
    """
    if unlike_hooke(drive):
        return share < SYNCHRONOUS
    limit = drive.limits.speed_fluctuation
    sides = closure(drive).length if length is None else length
    together = 2.0 * math.sinh(float(np.sum(sides)))
    undone = len(drive.joints) > 1 and share < UNDONE * together
    left = drive.form == "points" or undone or share < SYNCHRONOUS
    return share < SPECK and left and (limit is None or share <= limit)


def each_uniform(drive: Drive) -> bool:
    """Tell whether every joint of a drive turns uniformly by itself, straight or of constant velocity.

    >>> each_uniform(Drive.from_angles([0.0])), each_uniform(Drive.from_angles([0.2, 0.2]))
    (True, False)
    """
    return not unlike_hooke(drive) and float(np.sum(closure(drive).length)) < SYNCHRONOUS
