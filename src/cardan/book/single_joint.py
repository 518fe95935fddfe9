"""What is there to know about one Hooke joint: its extremes and its Fourier series."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.questions.motion.equivalence import (
    angle_of_largest_acceleration,
    angle_of_largest_error,
    largest_acceleration,
)


@dataclass(frozen=True, eq=False, kw_only=True)
class JointExtremes:
    """One row of Book Table 4 for each joint angle, and the angles at which the extremes stand."""

    ratio_max: Array  # ratio_max, ratio_min (...): largest and smallest speed ratio
    ratio_min: Array  # (...)
    speed_fluctuation: Array  # (...): δ = sin α tan α
    # (...) [rad]: largest lead of the driven shaft when the driving yoke starts in the plane of the joint
    angle_error: Array
    angle_of_error: Array  # (...) [rad]: first joint angle θ of that lead
    acceleration: Array  # (...): largest |ε_2|/ω_1² at uniform input
    angle_of_acceleration: Array  # (...) [rad]: first joint angle θ of that acceleration, a negative one


def joint_extremes(joint_angle: Array) -> JointExtremes:
    """Return the extremes of single joints, exactly.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Joint angles α in [0, π/2).

    Returns
    -------
    JointExtremes
        arrays (...).

    Notes
    -----
    i_max = 1/cos α, i_min = cos α, δ = sin α tan α, lead arcsin tan²(α/2) at tan θ = √cos α; Book (20)-(22), Table 4.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.units import deg
    >>> joint_extremes(np.asarray([20 * deg])).acceleration
    array([0.12496558])
    """
    xp = namespace(joint_angle)
    return JointExtremes(
        ratio_max=1.0 / xp.cos(joint_angle),
        ratio_min=xp.cos(joint_angle),
        speed_fluctuation=xp.sin(joint_angle) * xp.tan(joint_angle),
        angle_error=xp.asin(mobius.tau(mobius.hooke(joint_angle))),
        angle_of_error=angle_of_largest_error(joint_angle),
        acceleration=largest_acceleration(joint_angle),
        angle_of_acceleration=angle_of_largest_acceleration(joint_angle),
    )


def fourier(joint_angle: Array, count: int) -> Array:
    """Return the exact Fourier amplitudes of the angle error of single joints.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Joint angles α in [0, π/2).
    count : int
        How many, of orders 2, 4 … 2·count of the input turn.

    Returns
    -------
    array (..., count) [rad]

    Notes
    -----
    φ_2 - φ_1 = Σ_k (τ^k/k) (sin 2kθ - sin 2kψ_1), τ = tan²(α/2). Where the book expands in tan² α, Book (39)-(46),
    this is closed, and converges for every joint angle below 90°.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.units import deg
    >>> fourier(np.asarray(20 * deg), 2)
    array([0.0310912 , 0.00048333])
    """
    xp = namespace(joint_angle)
    k = xp.arange(1, count + 1, dtype=xp.float64)
    return (xp.tan(0.5 * joint_angle) ** 2)[..., None] ** k / k


@dataclass(frozen=True, eq=False, kw_only=True)
class BookCoefficients:
    """Book's series for the Fourier amplitudes of a single joint, as far as the book writes them."""

    c11_quarter: Array  # (...) [rad]: α²/4, the amplitude of order 2 that the book works with
    c11: Array  # c11, c12, c13 (...) [rad]: Book (44) with three, two and one terms
    c12: Array  # (...) [rad]
    c13: Array  # (...) [rad]
    constant: Array  # (...): Book (43) with four terms; its true value is exactly 1


def book_coefficients(joint_angle: Array) -> BookCoefficients:
    """Return book's truncated series for the Fourier amplitudes of single joints.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Joint angles α in [0, π/2); the series themselves converge below 45° only.

    Returns
    -------
    BookCoefficients
        arrays (...).

    Notes
    -----
    Book (43), (44) with T = tan² α: c_11 = (T/4 - T²/4 + 15T³/64)/cos α, c_12 = (T²/32 - 3T³/64)/cos α,
    c_13 = (T³/192)/cos α.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.units import deg
    >>> book_coefficients(np.asarray([20 * deg])).c11
    array([0.03115498])
    """
    xp = namespace(joint_angle)
    t = xp.tan(joint_angle) ** 2
    c = xp.cos(joint_angle)
    return BookCoefficients(
        c11_quarter=0.25 * joint_angle * joint_angle,
        c11=t * (0.25 - t * (0.25 - t * (15.0 / 64.0))) / c,
        c12=t * t * (1.0 / 32.0 - t * (3.0 / 64.0)) / c,
        c13=t * t * t / 192.0 / c,
        constant=(1.0 - t * (0.5 - t * (0.375 - t * 0.3125))) / c,
    )
