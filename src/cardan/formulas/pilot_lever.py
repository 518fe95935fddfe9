"""Choice of the pilot lever of a Rzeppa joint: the cage misses the bisecting plane least over a range of bends."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.drive.joints.laws.pilot_lever import even_length, plane_error
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.peaks import peaks
from cardan.texts import _

PLACES = 241
"""Bends looked at; the largest errors between them are then found closely."""

REACH = 1e-9
"""Share by which the lever must be longer than just reaching."""


@dataclass(frozen=True, kw_only=True)
class LeverChoice:
    """The pilot lever with the smallest largest error over a range of bends."""

    b: float  # b, c: b/a and c/a
    c: float
    # [rad]: largest error of the cage, reached with one sign between the ends of the range and with the other at its
    # end
    error: float
    below: float  # below, above [rad]: bends at which the error is most negative and most positive
    above: float  # [rad]
    even: float  # [rad]: bend at which the cage bisects exactly, besides the straight joint


def lever_choice(b: float, largest: float, *, smallest: float = 0.0) -> LeverChoice:
    """Return the length OB of a pilot lever with which its cage errs least over a range of bends.

    Parameters
    ----------
    b : float
        b/a > 0, division of the lever by the cage's ball.
    largest, smallest : float [rad]
        Ends of the range, 0 ≤ smallest ≤ largest < π/2.

    Returns
    -------
    LeverChoice

    Raises
    ------
    InputError
        Naming ``b`` where no lever so divided comes near the bisecting plane in the range.

    Notes
    -----
    The error grows with c at every joint angle; it is negative below the joint angle at which it vanishes, and positive
    above. It is least where both extremes are of one size, a root in c between the exact values for the ends of the
    range.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = lever_choice(0.35, 35 * deg)
    >>> print(f"c/a {found.c:.5f}, at most {found.error / deg:.3f}°, exact at {found.even / deg:.1f}°")
    c/a 0.65619, at most 0.199°, exact at 30.4°
    """
    low, high = _bracket(b, smallest, largest)
    if low == high:
        return LeverChoice(b=b, c=low, error=0.0, below=largest, above=largest, even=largest)

    def unlike(c: float) -> float:
        (_at, most), (_place, least) = _extremes(b, c, smallest, largest)
        return most + least

    if unlike(high) < 0.0:
        raise refuse("b", _no_lever(b, largest))
    c = float(scipy.optimize.brentq(unlike, low, high, xtol=1e-16 * low, rtol=1e-15))
    (above, most), (below, least) = _extremes(b, c, smallest, largest)
    exact = b * (1.0 + b) / c
    half = math.sqrt(max((exact - (1.0 - b)) * (exact + (1.0 - b)), 0.0) / (4.0 * b))
    return LeverChoice(b=b, c=c, error=max(most, -least), below=below, above=above, even=2.0 * math.asin(half))


def _bracket(b: float, smallest: float, largest: float) -> tuple[float, float]:
    """Return the exact lengths for the largest and the smallest joint angle, the latter no longer than reaches."""
    low, high = float(even_length(largest, b)), float(even_length(smallest, b))
    if math.isnan(low):
        raise refuse("b", _no_lever(b, largest))
    reach = (1.0 + b) / math.sin(largest) * (1.0 - REACH) if largest > 0.0 else math.inf
    return low, min(math.inf if math.isnan(high) else high, reach)


def _extremes(b: float, c: float, smallest: float, largest: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return where the error is most positive, and how much; where most negative, and how much."""

    def both(joint_angle: Array) -> Array:
        error = plane_error(np.clip(joint_angle, smallest, largest), b, c)
        return np.stack((error, -error))

    places = np.linspace(smallest, largest, PLACES)
    at, value = peaks(both, places, both(places))
    at = np.clip(at, smallest, largest)
    return (float(at[0]), float(value[0])), (float(at[1]), -float(value[1]))


def _no_lever(b: float, largest: float) -> str:
    text = _(
        "no lever divided at b/a = {b:.6g} halves bends up to {joint_angle:.6g}°; b must be clearly shorter than a"
    )
    return text.format(b=b, joint_angle=math.degrees(largest))
