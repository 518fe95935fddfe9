"""Which inner geometry of a joint is best: levers, offsets of grooves, centring balls, pins."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.drive.joints import pin_coupling
from cardan.drive.joints.double_cardan import even_share, split, unevenness
from cardan.drive.joints.rzeppa import even_length, plane_error
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.maths.curves.extremes import peaks
from cardan.texts import _
from cardan.units import deg

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
    text = _("no lever divided at b/a = {b:.6g} bisects joint angles up to {joint_angle:.6g}°; b must be well below a")
    return text.format(b=b, joint_angle=math.degrees(largest))


# Choice of the offset of ball grooves: how far off the joint their centres must stand for an axial play.


def groove_offset(joint_angle: ArrayLike, tilt: ArrayLike, play: ArrayLike) -> Array:
    """Return the smallest offset of both groove centres with which the plane of the balls tilts no more than allowed.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Largest α in [0, π/2).
    tilt : array (...) [rad]
        Largest η allowed, in size, above 0.
    play : array (...) [m]
        How far one shaft may shift along its axis from the middle, to either side.

    Returns
    -------
    array (...) [m]
        c of both centres, the shafts in the middle.

    Notes
    -----
    One centre comes as near as c - s: tan η = s tan(α/2)/(2c - s), so c = (s/2) [1 + tan(α/2)/tan η]. The tilt is the
    larger the smaller c: the reason why a Weiss joint has a ball that centres it.

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> print(groove_offset(40 * deg, 0.5 * deg, 0.1 * mm) / mm)
    2.13534289
    """
    alpha, eta, shift = floats(joint_angle, tilt, play)
    xp = namespace(alpha, eta, shift)
    return 0.5 * shift * (1.0 + xp.tan(0.5 * alpha) / xp.tan(eta))


# The centring ratio with which a ball on one shaft keeps a double joint most even over a range of bends.

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
        Largest and smallest joint angle of the whole, 0 ≤ joint_angle_min < joint_angle_max < π/2.

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
    >>> from cardan.joints import best_centring
    >>> from cardan.units import deg
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
    return _lowest(lambda joint_angle: -_signed(joint_angle, share), low, high, NARROWINGS)


# Slant and place of the pins of a pin coupling that carry most within a given room.

PIN_NARROWINGS = 40
"""Steps of the golden section: a slant to 1e-8 of its range, the force, level there, to rounding."""

TURN = np.linspace(0.0, math.pi, 181)
"""Angles [rad] over which the force is looked at; it is the same on both sides of the plane of the shafts."""

MARGIN = 3.0 * deg
"""How far slants stay from the ends of their range [rad] unless told otherwise."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PinGeometry:
    """Pins alike, of one slant or of many, that fill a given room at the largest joint angle.

    Attributes
    ----------
    slant : float or array (k,) [rad]
        Angle θ of the pins with their axes.
    distance : float or array (k,) [m]
        Distance a of their start from the crossing of the axes.
    slant_range : tuple of float [rad]
        Between which slants they turn all the way round at the largest joint angle.
    stroke : float or array (k,) [m]
        How far the contact runs along a pin at the largest joint angle.
    length : float or array (k,) [m]
        How long a pin has to be from its start on the axis.
    force : float or array (k,) [1/m]
        Largest contact force without friction for each unit of torque.
    angle_error : float or array (k,) [rad/m]
        Largest lead or lag of the output for each unit by which the distances of both pins differ, to first order.
    """

    slant: ArrayLike
    distance: ArrayLike
    slant_range: tuple[float, float]
    stroke: ArrayLike
    length: ArrayLike
    force: ArrayLike
    angle_error: ArrayLike


def pin_choices(joint_angle_max: float, radius: float, slants: ArrayLike) -> PinGeometry:
    """Return what pins of several slants come to in the same room.

    Parameters
    ----------
    joint_angle_max : float [rad]
        Largest joint angle, in (0, π/2).
    radius : float [m]
        Largest distance of the contact from the axes, at the largest joint angle.
    slants : array (k,) [rad]
        Slants θ within their range.

    Returns
    -------
    PinGeometry
        arrays (k,).

    Raises
    ------
    InputError
        A joint angle, radius or slant with which pins do not turn.

    See Also
    --------
    best_pins

    Notes
    -----
    a = R cos(θ + α/2)/(sin θ cos(α/2)); the stroke is 2 R sin(α/2)/cos(θ - α/2); see `laws.pin_coupling` for
    force and lead.

    Examples
    --------
    >>> from cardan.joints import pin_choices
    >>> from cardan.units import deg
    >>> found = pin_choices(30 * deg, 0.06, [30 * deg, 45 * deg])
    >>> print(1e3 * found.distance, 1e3 * found.stroke)
    [87.84609691 43.92304845] [32.15390309 35.86301889]
    """
    theta = np.asarray(slants, dtype=float)
    check(_pin_problems(joint_angle_max, radius, theta))
    half = 0.5 * joint_angle_max
    distance = radius * np.cos(theta + half) / (np.sin(theta) * math.cos(half))
    least, most = pin_coupling.stroke(joint_angle_max, distance, theta)
    columns = distance[..., None], theta[..., None]
    force = pin_coupling.force_alike(TURN, joint_angle_max, *columns)
    off = pin_coupling.missed_by_pins(TURN, joint_angle_max, 0.5, columns[1])
    along = pin_coupling.along_alike(TURN, joint_angle_max, *columns)
    angle_error = pin_coupling.missed_plane(TURN, joint_angle_max, off, along * np.sin(columns[1]))
    low, high = pin_coupling.slant_range(joint_angle_max)
    return PinGeometry(
        slant=theta,
        distance=distance,
        slant_range=(float(low), float(high)),
        stroke=most - least,
        length=most,
        force=np.max(force, axis=-1),
        angle_error=np.max(np.abs(angle_error), axis=-1),
    )


def best_pins(joint_angle_max: float, radius: float, *, margin: float = MARGIN) -> PinGeometry:
    """Return the pins that touch with the smallest force in a given room.

    Parameters
    ----------
    joint_angle_max : float [rad]
        Largest joint angle, in (0, π/2).
    radius : float [m]
        Largest distance of the contact from the axes, at the largest joint angle.
    margin : float [rad]
        How far the slant stays from both ends of its range.

    Returns
    -------
    PinGeometry
        floats.

    Raises
    ------
    InputError
        As `pin_choices`, or the margin leaves no slant.

    See Also
    --------
    pin_choices

    Notes
    -----
    Flat pins, of small slant, touch at a flat angle and magnify errors; steep ones reach inward on the inner side of
    the joint angle, where their lever is short, and their contact runs far. Between the two the largest force over the
    turn has one lowest value. Its largest joint angle is the worst.

    Examples
    --------
    >>> from cardan.joints import best_pins
    >>> from cardan.units import deg
    >>> found = best_pins(30 * deg, 0.06)
    >>> print(f"{found.slant / deg:.2f}° {1e3 * found.distance:.2f} mm, {0.06 * found.force:.4f} times T/R")
    30.50° 85.80 mm, 1.5073 times T/R
    """
    check(_pin_problems(joint_angle_max, radius, np.asarray([])))
    low, high = (float(one) for one in pin_coupling.slant_range(joint_angle_max))
    if not 0.0 <= margin < 0.5 * (high - low):
        text = _("{value}° leaves no slant between {low}° and {high}°")
        text = text.format(value=f"{margin / deg:.6g}", low=f"{low / deg:.6g}", high=f"{high / deg:.6g}")
        check([Problem("margin", text, "out_of_range")])
    edge = max(margin, 1e-9)
    slant = _lowest(lambda one: _largest_force(one, joint_angle_max, radius), low + edge, high - edge, PIN_NARROWINGS)
    found = pin_choices(joint_angle_max, radius, [slant])
    each = ("slant", "distance", "stroke", "length", "force", "angle_error")
    return PinGeometry(slant_range=found.slant_range, **{name: float(getattr(found, name)[0]) for name in each})


def _largest_force(slant: float, joint_angle_max: float, radius: float) -> float:
    distance = radius * math.cos(slant + 0.5 * joint_angle_max) / (math.sin(slant) * math.cos(0.5 * joint_angle_max))
    return float(np.max(pin_coupling.force_alike(TURN, joint_angle_max, distance, slant)))


def _lowest(function: Callable[[float], float], low: float, high: float, narrowings: int) -> float:
    """Return where a function that falls and then rises is lowest, by the golden section."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = function(inner), function(outer)
    for _narrowing in range(narrowings):
        if at_inner < at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = function(inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = function(outer)
    return 0.5 * (low + high)


def _pin_problems(joint_angle_max: float, radius: float, slants: Array) -> list[Problem]:
    found = []
    if not 0.0 < joint_angle_max < 0.5 * math.pi:
        text = _("{value}° is not above 0° and below 90°")
        found.append(Problem("joint_angle_max", text.format(value=f"{joint_angle_max / deg:.6g}"), "out_of_range"))
    if not (math.isfinite(radius) and radius > 0.0):
        found.append(Problem("radius", _("{value} is not above 0").format(value=radius), "not_positive"))
    if not found:
        low, high = pin_coupling.slant_range(joint_angle_max)
        text = _("{value}° is not between {low}° and {high}°, where pins turn all the way round at this joint angle")
        for k, slant in enumerate(slants.ravel()):
            if not low < slant < high:
                shown = {"value": slant / deg, "low": low / deg, "high": high / deg}
                message = text.format(**{name: f"{one:.6g}" for name, one in shown.items()})
                found.append(Problem(f"slants[{k}]", message, "out_of_range"))
    return found
