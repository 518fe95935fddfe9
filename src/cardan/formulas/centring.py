"""The centring ratio with which a ball on one shaft keeps a double joint most even over a range of bends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import scipy

from cardan.drive.joints.laws.double_cardan import even_share, split, unevenness
from cardan.errors import Problem, check
from cardan.texts import _
from cardan.units import deg

GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)

NARROWINGS = 44
"""Steps of the golden section: a peak is then found to 1e-9 of the range, its height to rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Centring:
    """The best centring ratio.

    Attributes
    ----------
    share : float
        Centring ratio λ: distance of the ball from the first centre over that of the two centres.
    speed_fluctuation : float
        Greatest speed fluctuation δ that is left in the range.
    worst : tuple of float [rad]
        The two joint angles at which it stands.
    even_share : float
        Ratio that is exact at the largest joint angle, for comparison.
    middle_speed_fluctuation : float
        Greatest speed fluctuation with the ball in the middle, λ = ½.
    """

    share: float
    speed_fluctuation: float
    worst: tuple[float, float]
    even_share: float
    middle_speed_fluctuation: float


def best_centring(joint_angle_max: float, joint_angle_min: float = 0.0) -> Centring:
    """Return the centring ratio whose greatest speed fluctuation over a range of joint angles is smallest.

    Parameters
    ----------
    joint_angle_max, joint_angle_min : float [rad]
        Largest and smallest whole bend, 0 ≤ joint_angle_min < joint_angle_max < π/2.

    Returns
    -------
    Centring

    Raises
    ------
    InputError
        The joint angles are no range below 90 degrees.

    See Also
    --------
    joint_over_angles

    Notes
    -----
    The signed speed fluctuation, see `double_cardan.unevenness`, rises above zero at small joint angles and falls
    below it at large ones; the best ratio makes its peak and its end equally far from zero. It lies between the ratios
    1/(2 cos(α/2)) that are exact at the two ends of the range.

    Examples
    --------
    >>> found = best_centring(30 * deg)
    >>> print(f"{found.share:.5f} {found.speed_fluctuation:.3e} {found.middle_speed_fluctuation:.3e}")
    0.51459 1.691e-03 9.774e-03
    """
    check(_problems(joint_angle_max, joint_angle_min))

    def unequal(share: float) -> float:
        return _signed(_peak(share, joint_angle_min, joint_angle_max), share) + _signed(joint_angle_max, share)

    low, high = float(even_share(joint_angle_min)), float(even_share(joint_angle_max))
    share = float(scipy.optimize.brentq(unequal, low, high, xtol=1e-15, rtol=1e-14))
    peak = _peak(share, joint_angle_min, joint_angle_max)
    return Centring(
        share=share,
        speed_fluctuation=max(abs(_signed(peak, share)), abs(_signed(joint_angle_max, share))),
        worst=(peak, joint_angle_max),
        even_share=high,
        middle_speed_fluctuation=abs(_signed(joint_angle_max, 0.5)),
    )


def _problems(joint_angle_max: float, joint_angle_min: float) -> list[Problem]:
    found = []
    if not 0.0 < joint_angle_max < 0.5 * math.pi:
        text = _("{value}° is not above 0° and below 90°")
        found.append(Problem("joint_angle_max", text.format(value=f"{joint_angle_max / deg:.6g}"), "out_of_range"))
    elif not 0.0 <= joint_angle_min < joint_angle_max:
        text = _("{value}° is not at least 0° and below the largest joint angle, {most}°")
        value, most = f"{joint_angle_min / deg:.6g}", f"{joint_angle_max / deg:.6g}"
        found.append(Problem("joint_angle_min", text.format(value=value, most=most), "out_of_range"))
    return found


def _signed(joint_angle: float, share: float) -> float:
    """Return the speed fluctuation, positive where the second joint bends more than the first."""
    return -float(unevenness(*split(float(joint_angle), float(share))))


def _peak(share: float, low: float, high: float) -> float:
    """Return the joint angle at which the signed speed fluctuation is largest: it rises, then falls."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = _signed(inner, share), _signed(outer, share)
    for _narrowing in range(NARROWINGS):
        if at_inner > at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = _signed(inner, share)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = _signed(outer, share)
    return 0.5 * (low + high)
