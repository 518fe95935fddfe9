"""The centring ratio with which a ball on one shaft keeps a double joint most even over a range of bends."""

from __future__ import annotations

import math
from dataclasses import dataclass

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
    irregularity : float
        Greatest irregularity δ that is left in the range.
    worst : tuple of float [rad]
        The two bends at which it stands.
    even_share : float
        Ratio that is exact at the largest bend, for comparison.
    middle_irregularity : float
        Greatest irregularity with the ball in the middle, λ = ½.
    """

    share: float
    irregularity: float
    worst: tuple[float, float]
    even_share: float
    middle_irregularity: float


def best_centring(bend_max: float, bend_min: float = 0.0) -> Centring:
    """Return the centring ratio whose greatest irregularity over a range of bends is smallest.

    Parameters
    ----------
    bend_max, bend_min : float [rad]
        Largest and smallest whole bend, 0 ≤ bend_min < bend_max < π/2.

    Returns
    -------
    Centring

    Raises
    ------
    InputError
        The bends are no range below 90 degrees.

    Notes
    -----
    The signed irregularity, see `double_cardan.unevenness`, rises above zero at small bends and falls
    below it at large ones; the best ratio makes its peak and its end equally far from zero. It lies between the ratios
    1/(2 cos(α/2)) that are exact at the two ends of the range.

    Examples
    --------
    >>> found = best_centring(30 * deg)
    >>> print(f"{found.share:.5f} {found.irregularity:.3e} {found.middle_irregularity:.3e}")
    0.51459 1.691e-03 9.774e-03
    """
    check(_problems(bend_max, bend_min))
    from scipy.optimize import brentq

    def unequal(share: float) -> float:
        return _signed(_peak(share, bend_min, bend_max), share) + _signed(bend_max, share)

    low, high = float(even_share(bend_min)), float(even_share(bend_max))
    share = float(brentq(unequal, low, high, xtol=1e-15, rtol=1e-14))
    peak = _peak(share, bend_min, bend_max)
    return Centring(
        share=share,
        irregularity=max(abs(_signed(peak, share)), abs(_signed(bend_max, share))),
        worst=(peak, bend_max),
        even_share=high,
        middle_irregularity=abs(_signed(bend_max, 0.5)),
    )


def _problems(bend_max: float, bend_min: float) -> list[Problem]:
    found = []
    if not 0.0 < bend_max < 0.5 * math.pi:
        text = _("{value}° is not above 0° and below 90°")
        found.append(Problem("bend_max", text.format(value=f"{bend_max / deg:.6g}"), "out_of_range"))
    elif not 0.0 <= bend_min < bend_max:
        text = _("{value}° is not at least 0° and below the largest bend, {most}°")
        value, most = f"{bend_min / deg:.6g}", f"{bend_max / deg:.6g}"
        found.append(Problem("bend_min", text.format(value=value, most=most), "out_of_range"))
    return found


def _signed(bend: float, share: float) -> float:
    """Return the irregularity, positive where the second joint bends more than the first."""
    return -float(unevenness(*split(float(bend), float(share))))


def _peak(share: float, low: float, high: float) -> float:
    """Return the bend at which the signed irregularity is largest: it rises, then falls."""
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
