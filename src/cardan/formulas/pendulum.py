"""Which order does a pendulum on the shaft absorb? It follows the speed, where a tuned absorber serves one.

A mass m swings on an arm l about a pivot at radius R of the turning shaft. The field of the rotation is its spring, so
its natural frequency is √(R/l) times the speed, at every speed: it is tuned to an order. A joint excites order 2,
R = 4l.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .absorbers import arrays

TUNED = 1e-12
"""Orders nearer to the tuned one than this share of it are the tuned one: beyond, rounding decides."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Pendulum:
    """What pendulums on a shaft do at one order, small swings."""

    tuned_order: Array  # (...): order at which they hold the shaft still
    # (...) [kg·m²]: what they weigh on the shaft at the order asked for; negative above the tuned order, nan at it
    inertia: Array
    antiresonance: Array  # (...) of bool: the order is the tuned one: the inertia is infinite, the shaft does not swing
    # (...) [1/(kg·m²)]: where they absorb a torque at their tuned order, each swings by this times the torque over the
    # square of the speed
    answer: Array
    swing: Array  # (...): angle of a pendulum over that of the shaft; nan where the shaft stands still


def pendulum(
    mass: ArrayLike, radius: ArrayLike, length: ArrayLike, order: ArrayLike, *, count: ArrayLike = 1.0
) -> Pendulum:
    """Return what pendulums weigh on a shaft that swings at an order of its turning.

    Parameters
    ----------
    mass : array (...) [kg]
        m of one pendulum, a point on its arm.
    radius, length : arrays (...) [m]
        R of the pivot, l of the arm.
    order : array (...)
        ν, swings a turn, at least 0.
    count : array (...)
        How many equal ones there are.

    Returns
    -------
    Pendulum

    Raises
    ------
    InputError
        A mass, radius, length or count that is not positive, a negative order.

    Notes
    -----
    m(R + l)²/(1 - ν²l/R), tuned order √(R/l). The pendulum swings ν²(R + l)/(R - ν²l) times as far as the shaft; at the
    tuned order it answers a torque M with the swing M/(m R (R + l) Ω²). A circular path loses its tune where swings
    are wide; a little more than tuned, R > ν²l, keeps it on the safe side.

    Examples
    --------
    >>> found = pendulum(0.5, 0.12, 0.04, [1.0, 2.0])
    >>> print(found.tuned_order, found.inertia)
    [1.73205081 1.73205081] [ 0.0192 -0.0384]
    """
    xp, (m, r, arm, nu, number) = arrays(mass, radius, length, order, count)
    given = {"mass": m, "radius": r, "length": arm, "count": number}
    problems = [
        Problem(name, _("needs to be positive"))
        for name, values in given.items()
        if not np.all((np.asarray(values) > 0.0) & np.isfinite(np.asarray(values)))
    ]
    if not np.all((np.asarray(nu) >= 0.0) & np.isfinite(np.asarray(nu))):
        problems.append(Problem("order", _("needs to be a number that is not negative")))
    check(problems)
    tuned = xp.sqrt(r / arm)
    share = 1.0 - nu * nu * arm / r
    still = xp.abs(nu - tuned) <= TUNED * tuned
    share = xp.where(still, xp.nan, share)
    return Pendulum(
        tuned_order=tuned + 0.0 * nu,
        inertia=number * m * (r + arm) ** 2 / share,
        antiresonance=still,
        answer=1.0 / (number * m * r * (r + arm)) + 0.0 * nu,
        swing=nu * nu * (r + arm) / (r * share),
    )


def tuned_length(radius: ArrayLike, order: ArrayLike) -> Array:
    """Return the length of the arm that tunes a pendulum to an order, array (...) [m].

    radius (...) [m]: R of the pivot; order (...): ν, positive.
    l = R/ν².
    """
    _xp, (r, nu) = arrays(radius, order)
    return r / (nu * nu)
