"""Slant and place of the pins of a pin coupling that carry most within a given room."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.drive.joints.laws import pin_coupling
from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _
from cardan.units import deg

GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)

NARROWINGS = 40
"""Steps of the golden section: a slant to 1e-8 of its range, the force, level there, to rounding."""

TURN = np.linspace(0.0, math.pi, 181)
"""Angles [rad] over which the force is looked at; it is the same on both sides of the plane of the shafts."""

MARGIN = 3.0 * deg
"""How far slants stay from the ends of their range [rad] unless told otherwise."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PinGeometry:
    """Pins alike, of one slant or of many, that fill a given room at the largest bend.

    Attributes
    ----------
    slant : float or array (k,) [rad]
        Angle θ of the pins with their axes.
    distance : float or array (k,) [m]
        Distance a of their start from the crossing of the axes.
    slant_range : tuple of float [rad]
        Between which slants they turn all the way round at the largest bend.
    stroke : float or array (k,) [m]
        How far the contact runs along a pin at the largest bend.
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
        Largest distance of the contact from the axes, at the largest bend.
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
    >>> found = pin_choices(30 * deg, 0.06, [30 * deg, 45 * deg])
    >>> print(1e3 * found.distance, 1e3 * found.stroke)
    [87.84609691 43.92304845] [32.15390309 35.86301889]
    """
    theta = np.asarray(slants, dtype=float)
    check(_problems(joint_angle_max, radius, theta))
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
        Largest distance of the contact from the axes, at the largest bend.
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
    >>> found = best_pins(30 * deg, 0.06)
    >>> print(f"{found.slant / deg:.2f}° {1e3 * found.distance:.2f} mm, {0.06 * found.force:.4f} times T/R")
    30.50° 85.80 mm, 1.5073 times T/R
    """
    check(_problems(joint_angle_max, radius, np.asarray([])))
    low, high = (float(one) for one in pin_coupling.slant_range(joint_angle_max))
    if not 0.0 <= margin < 0.5 * (high - low):
        text = _("{value}° leaves no slant between {low}° and {high}°")
        text = text.format(value=f"{margin / deg:.6g}", low=f"{low / deg:.6g}", high=f"{high / deg:.6g}")
        check([Problem("margin", text, "out_of_range")])
    edge = max(margin, 1e-9)
    slant = _lowest(lambda one: _largest_force(one, joint_angle_max, radius), low + edge, high - edge)
    found = pin_choices(joint_angle_max, radius, [slant])
    each = ("slant", "distance", "stroke", "length", "force", "angle_error")
    return PinGeometry(slant_range=found.slant_range, **{name: float(getattr(found, name)[0]) for name in each})


def _largest_force(slant: float, joint_angle_max: float, radius: float) -> float:
    distance = radius * math.cos(slant + 0.5 * joint_angle_max) / (math.sin(slant) * math.cos(0.5 * joint_angle_max))
    return float(np.max(pin_coupling.force_alike(TURN, joint_angle_max, distance, slant)))


def _lowest(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function that falls and then rises is lowest."""
    inner, outer = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_inner, at_outer = function(inner), function(outer)
    for _narrowing in range(NARROWINGS):
        if at_inner < at_outer:
            high, outer, at_outer = outer, inner, at_inner
            inner = high - GOLDEN * (high - low)
            at_inner = function(inner)
        else:
            low, inner, at_inner = inner, outer, at_outer
            outer = low + GOLDEN * (high - low)
            at_outer = function(outer)
    return 0.5 * (low + high)


def _problems(joint_angle_max: float, radius: float, slants: Array) -> list[Problem]:
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
