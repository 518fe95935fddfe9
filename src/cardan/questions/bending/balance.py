"""Balance of shafts: the unbalance that a grade allows, and the force it leaves."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.units import rpm

SLOW = 500.0 * rpm
"""Speed below which makers do not balance [rad/s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class AllowedUnbalance:
    """Unbalance that a balance grade allows, arrays (...)."""

    whole: Array  # (...) [kg m]: U of the shaft
    plane: Array  # (...) [kg m]: half of it, for each of the two planes of a symmetrical shaft
    eccentricity: Array  # (...) [m]: e of the centre of mass
    force: Array  # (...) [N]: U Ω², which turns with the shaft


def allowed_unbalance(mass: ArrayLike, speed: ArrayLike, grade: ArrayLike) -> AllowedUnbalance:
    """Return the unbalance that a balance grade allows, ISO 21940-11: e Ω = G.

    mass (...) [kg]; speed (...) [rad/s]: Ω, the highest in use.
    grade (...) [m/s]: G; 0.016 for G16.

    >>> round(float(allowed_unbalance(10.0, 3000 * 3.141592653589793 / 30, 0.016).whole) * 1e6, 1)
    509.3
    """
    mass, speed, grade = floats(mass, speed, grade)
    eccentricity = grade / speed
    whole = mass * eccentricity
    return AllowedUnbalance(whole=whole, plane=0.5 * whole, eccentricity=eccentricity, force=whole * speed**2)
