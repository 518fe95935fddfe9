"""Do the clearances of a drive stay closed over the turn, or does inertia make its joints rattle?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.models.train import Train, place_of
from cardan.maths.arrays import Array
from cardan.maths.curves.peaks import peaks

from .kinetostatics import couples, standing

COARSE = 361
"""Positions of a turn from which the least couples are sharpened."""


@dataclass(frozen=True, eq=False, kw_only=True)
class GapClosure:
    """Whether the load keeps every joint pressed one way.

    Attributes
    ----------
    closed : bool
        Whether every joint keeps the sign of its couple over the turn, whichever it is.
    least_couple : array (n,) [N·m]
        Smallest T_i over the turn.
    least_angle : array (n,) [rad]
        Input angle where it occurs.
    load_needed : float [N·m]
        Least constant torque at the output that keeps all joints closed.
    open_share : array (n,)
        Share of the turn in which T_i is against the load: negative, or positive where the load is negative.
    openings : tuple of array [rad]
        Per joint, the input angles in [0, 2π) at which T_i changes its sign, rising.
    """

    closed: bool
    least_couple: Array
    least_angle: Array
    load_needed: float
    open_share: Array
    openings: tuple[Array, ...]


def gap_closure(train: Train, *, load: float, speed: float, acceleration: float = 0.0) -> GapClosure:
    """Return whether the clearances stay closed at a constant load.

    Parameters
    ----------
    train : Train
        One drive with the inertias of its shafts; the inertia of its crosses and friction are left out.
    load : float [N·m]
        Torque that resists the output; negative where it resists turning the other way.
    speed, acceleration : float [rad/s, rad/s²]
        ω_1, ε_1.

    Notes
    -----
    Every T_i is linear in the load: T_i = T_i(inertia alone) + load · T_i(load 1 without inertia), so the load needed
    is the largest of -T_i(inertia)/T_i(1) over joints and angles. Book (122), M_2 > J_2 ε_max, is the case of a single
    joint. The inertia of shaft 1 never matters.

    Examples
    --------
    >>> from cardan.drive.models.train import train_of_points
    >>> points = np.asarray([[-0.5, 0, 0], [0, 0, 0], [np.cos(0.4), np.sin(0.4), 0]])
    >>> single = train_of_points(points, inertia=np.asarray([0.0, 0.05]))
    >>> found = gap_closure(single, load=100.0, speed=150.0)
    >>> found.closed, round(found.load_needed, 3)
    (False, 186.471)
    """
    bare = replace(train, cross_inertia=None, drag=None)
    light = replace(bare, inertia=None, resisting_torque=None)
    place = place_of(train)

    def torques(angle: Array) -> tuple[Array, Array]:
        moved = standing(train.chain, place.axis, place.normal, angle, speed=speed, acceleration=acceleration)
        zero = np.zeros(angle.shape)
        heavy, unit = couples(bare, moved, zero), couples(light, moved, zero + 1.0)
        return heavy.driving_torque.T, unit.driving_torque.T

    def least(angle: Array) -> Array:
        heavy, unit = torques(angle)
        return -(heavy + load * unit)

    def against(angle: Array) -> Array:
        return -least(angle) if load < 0.0 else least(angle)

    def need(angle: Array) -> Array:
        heavy, unit = torques(angle)
        return -heavy / unit

    places = np.linspace(0.0, 2.0 * np.pi, COARSE)
    at, most = peaks(least, places, least(places))
    other, lowest = peaks(lambda angle: -least(angle), places, -least(places))
    _where, needs = peaks(need, places, need(places))
    extremes = np.stack((at, other), axis=-1)
    openings = tuple(_crossings(least, np.union1d(places, extremes[k]), k) for k in range(train.joints))
    return GapClosure(
        closed=bool(np.all((most < 0.0) | (lowest < 0.0))),
        least_couple=-most,
        least_angle=at,
        load_needed=float(np.max(needs)),
        open_share=np.asarray([_share(against, angles, k) for k, angles in enumerate(openings)]),
        openings=openings,
    )


def _crossings(function: Callable[[Array], Array], places: Array, k: int) -> Array:
    """Return where curve k changes its sign, by bisection to rounding."""
    values = function(places)[k]
    changes = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0.0)
    low, high = places[changes], places[changes + 1]
    rising = values[changes] < 0.0
    for _round in range(50 if changes.size else 0):
        middle = 0.5 * (low + high)
        before = (function(middle)[k] < 0.0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return 0.5 * (low + high)


def _share(function: Callable[[Array], Array], angles: Array, k: int) -> float:
    """Return the share of the turn in which curve k is positive."""
    edges = np.concatenate(([0.0], angles, [2.0 * np.pi]))
    middle = 0.5 * (edges[:-1] + edges[1:])
    above = function(middle)[k] > 0.0
    return float(np.sum(np.diff(edges)[above]) / (2.0 * np.pi))
