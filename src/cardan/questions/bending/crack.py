"""What does a crack take from a shaft? Its section, and how it opens and closes as the shaft turns under its weight."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel.cut_circle import CutCircle, cut_circle
from cardan.maths.periodic.cosine_power import hump, hump_coefficients
from cardan.texts import _

MOST_POWER = 1000
"""Highest power of the law of breathing."""


def _bad_power(power: int, name: str = "breathing") -> list[Problem]:
    if power == int(power) and 0 <= power <= MOST_POWER:
        return []
    text = _("needs to be a whole number from 0 to {most}").format(most=MOST_POWER)
    return [Problem(name, text, "out_of_range")]


@dataclass(frozen=True, kw_only=True, slots=True)
class Crack:
    """A crack that opens and closes once a turn.

    Attributes
    ----------
    loss_xi : float
        Δ_ξ: share of its stiffness that the shaft loses along the crack's direction when the crack is open, in [0, 1).
    loss_eta : float
        Δ_η: the same across it.
    breathing : int
        m of the law f(θ) = cos^(2m)(θ/2), 1 where it is open (θ = 0: the crack on the side in tension). 1 is the law of
        Mayes, more a crack that opens for a shorter part of the turn, 0 one that is always open.
    """

    loss_xi: float
    loss_eta: float
    breathing: int = 1

    def __post_init__(self) -> None:
        """Refuse values out of range."""
        problems = [
            Problem(name, _("needs to be at least 0 and below 1"), "out_of_range")
            for name, loss in (("loss_xi", self.loss_xi), ("loss_eta", self.loss_eta))
            if not 0.0 <= loss < 1.0
        ]
        check(problems + _bad_power(self.breathing))

    @property
    def losses(self) -> tuple[float, float]:
        """Both losses, along the crack and across it."""
        return self.loss_xi, self.loss_eta

    @property
    def coefficients(self) -> Array:
        """Return a_0 … a_m of the law as a sum of cosines, array (m+1,)."""
        return hump_coefficients(self.breathing)

    def opening(self, unit: Array) -> tuple[Array, Array]:
        """Return how far the crack is open at e^(iθ) and the slope of that by θ [1/rad], arrays (...)."""
        return hump(unit, self.breathing)


UNCRACKED = Crack(loss_xi=0.0, loss_eta=0.0)
"""A sound shaft."""


def crack_section(radius: ArrayLike, depth_ratio: ArrayLike) -> CutCircle:
    """Return the section that a straight-fronted crack leaves of a round solid shaft.

    Parameters
    ----------
    radius : array (...) [m]
        R.
    depth_ratio : array (...)
        δ = h/R, depth of the crack over the radius, in [0, 2).

    Returns
    -------
    CutCircle
        Its ``loss_x`` is that of bending in the crack's direction (Δ_ξ), ``loss_y`` of bending across it (Δ_η).

    Raises
    ------
    InputError
        A radius that is not positive, a depth out of range.

    Notes
    -----
    Article on the cracked Cardan shaft (17)-(19). The losses are those of this one section; the article takes them for
    the whole shaft, which far overstates one crack. A single crack adds a local compliance only.

    Examples
    --------
    >>> found = crack_section(5e-3, 0.45)
    >>> print(f"{found.loss_x:.4f} along the crack, {found.loss_y:.4f} across it")
    0.4459 along the crack, 0.1004 across it
    """
    r, high = np.asarray(radius, dtype=float), np.asarray(depth_ratio, dtype=float)
    problems = []
    if not np.all(np.isfinite(r) & (r > 0.0)):
        problems.append(Problem("radius", _("needs to be positive and finite"), "not_positive"))
    if not np.all((high >= 0.0) & (high < 2.0)):
        problems.append(Problem("depth_ratio", _("needs to be at least 0 and below 2"), "out_of_range"))
    check(problems)
    return cut_circle(r, high)


def breathing_law(power: int) -> Array:
    """Return the law of breathing cos^(2m)(θ/2) as a sum of cosines.

    Parameters
    ----------
    power : int
        m, at least 0.

    Returns
    -------
    array (m+1,)
        a_0 … a_m of a_0 + Σ a_j cos jθ.

    Raises
    ------
    InputError
        m out of range.

    Notes
    -----
    Article (21): a_0 = C(2m, m)/4^m, a_j = 2 C(2m, m-j)/4^m.

    Examples
    --------
    >>> breathing_law(1)
    array([0.5, 0.5])
    """
    check(_bad_power(power, "power"))
    return hump_coefficients(power)
