"""Critical speeds by closed formulas, and how far a drive has to stay below one: the rules of book and makers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.linear.rotor_beams import round_section
from cardan.units import rpm

Ends: TypeAlias = Literal[
    "pinned-pinned", "fixed-fixed", "free-free", "fixed-pinned", "fixed-free", "cantilever", "fixed-guided"
]

ENDS: tuple[Ends, ...] = get_args(Ends)
"""How the ends of a uniform shaft may be held; a cantilever is fixed and free."""

BOOK_CONSTANT = 12.1e4 * rpm
"""Critical speed times L²/√(D²+d²) of a steel shaft between joints, Book (258)-(260) [rad·m/s]."""

ARTICLE = 1.6
"""A critical speed should be this much above the greatest speed: a rule of practice of unknown source, so advice."""

PRACTICE = "article_1.6"
"""What that rule is called among those broken."""

CATALOGUE = {"automotive": 0.70, "industrial": 0.65}
"""Share of the computed critical speed that makers allow."""

HALF_BAND = 0.08
"""Half the width of the band about half the critical speed to keep out of, over its middle."""

SEPARATION = 0.2
"""Share of a critical speed to either side of it in which no speed is held: beyond it the mode amplifies an unbalance,
r²/|1 - r²|, 3.3 times at most whatever its damping."""

EDGE = 1e-12
"""Speeds that differ by less than this share are the same: turning units into each other rounds them."""


def end_roots(ends: Ends, modes: int) -> Array:
    """Return λ_1 … of a uniform beam, with ω = (λ/L)² √(EI/(ρA)).

    Parameters
    ----------
    ends : str
        One of `ENDS`.
    modes : int
        How many; motions without bending do not count.

    Returns
    -------
    array (modes,)
        Roots of the frequency equation: sin λ = 0 pinned-pinned, cos λ cosh λ = 1 fixed-fixed and free-free,
        tan λ = tanh λ fixed-pinned, cos λ cosh λ = -1 fixed-free, tan λ + tanh λ = 0 fixed-guided.

    Examples
    --------
    >>> end_roots("fixed-free", 3).round(5)
    array([1.8751 , 4.69409, 7.85476])
    """
    order = np.arange(1, modes + 1)
    if ends == "pinned-pinned":
        return np.pi * order
    # Divided by cosh, the equations are bounded: c cos λ + s sin λ + r, with what is left small from the start.
    shift = {"fixed-pinned": 0.25, "fixed-guided": -0.25, "fixed-free": -0.5, "cantilever": -0.5}.get(ends, 0.5)
    root = np.pi * (order + shift)
    for _step in range(30):
        sech, tanh = 1.0 / np.cosh(root), np.tanh(root)
        if ends in ("fixed-pinned", "fixed-guided"):
            sign = -1.0 if ends == "fixed-pinned" else 1.0
            height = np.sin(root) + sign * np.cos(root) * tanh
            rise = np.cos(root) - sign * np.sin(root) * tanh + sign * np.cos(root) * sech**2
        else:
            sign = 1.0 if ends in ("fixed-free", "cantilever") else -1.0
            height = np.cos(root) + sign * sech
            rise = -np.sin(root) - sign * sech * tanh
        root = root - height / rise
    return root


def uniform_speed(
    length: ArrayLike,
    outer: ArrayLike,
    inner: ArrayLike,
    youngs: ArrayLike,
    density: ArrayLike,
    *,
    ends: Ends = "pinned-pinned",
    modes: int = 3,
) -> Array:
    """Return the critical speeds of a uniform shaft in bending.

    Parameters
    ----------
    length, outer, inner : arrays (...) [m]
        L, and the diameters D and d.
    youngs : array (...) [Pa]
        E.
    density : array (...) [kg/m³]
        ρ.
    ends : str
        One of `ENDS`; between two joints the shaft is pinned.
    modes : int
        How many.

    Returns
    -------
    array (..., modes) [rad/s]

    Notes
    -----
    Euler's and Bernoulli's beam, Book (253)-(256): ω = (λ/L)² √(EI/(ρA)).

    Examples
    --------
    >>> float(uniform_speed(1.5, 0.076, 0.072, 2.1e11, 7850.0, modes=1)[0] / rpm)
    5670.334954745
    """
    section = round_section(outer, inner, youngs, density)
    size = np.sqrt(section.bending / section.mass) / np.asarray(length, dtype=float) ** 2
    return np.asarray(size)[..., None] * end_roots(ends, modes) ** 2


def material_constant(youngs: ArrayLike, density: ArrayLike) -> Array:
    """Return the constant of the formula n = K √(D²+d²)/L², π²/4 √(E/ρ) [rad·m/s].

    Parameters
    ----------
    youngs : array (...) [Pa]
        E.
    density : array (...) [kg/m³]
        ρ.

    Notes
    -----
    Book (257)-(259), where K = (30π/4)√(E/ρ) rpm·m. The book's own E and specific weight make it 12.19·10⁴ rpm·m; what
    it prints, 12.1·10⁴, belongs to 7.8 gf/cm³ and is in metres, not in centimetres.

    Examples
    --------
    >>> print(f"{material_constant(2.1e6 * 9.80665e4, 7800.0) / rpm:.0f}")
    121069
    """
    return 0.25 * np.pi**2 * np.sqrt(np.asarray(youngs, dtype=float) / density)


def tube_speed(
    length: ArrayLike,
    outer: ArrayLike,
    inner: ArrayLike,
    *,
    constant: ArrayLike = BOOK_CONSTANT,
    ends: Ends = "pinned-pinned",
) -> Array:
    """Return the first critical speed of a uniform shaft by its sizes, K √(D²+d²)/L², array (...) [rad/s].

    Parameters
    ----------
    length, outer, inner : arrays (...) [m]
        L, and the diameters D and d.
    constant : array (...) [rad·m/s]
        K: the book's for steel, or that of `material_constant`.
    ends : str
        One of `ENDS`; other ends than pinned ones multiply by (λ_1/π)².

    Notes
    -----
    Book (258), (259).

    Examples
    --------
    >>> float(tube_speed(1.0, 0.04, 0.0) / rpm)
    4840.0
    """
    held = (end_roots(ends, 1)[0] / np.pi) ** 2
    return held * constant * np.hypot(outer, inner) / np.asarray(length, dtype=float) ** 2


def thin_tube_speed(length: ArrayLike, mean_diameter: ArrayLike, *, constant: ArrayLike = BOOK_CONSTANT) -> Array:
    """Return the first critical speed of a thin tube between joints, √2 K d/L², array (...) [rad/s].

    Parameters
    ----------
    length, mean_diameter : arrays (...) [m]
        L, and the diameter of the middle of the wall. The outer diameter makes it 2 to 10 % too high.
    constant : array (...) [rad·m/s]
        K, as for `tube_speed`.

    Notes
    -----
    Book (260), whose factor √2 is not legible and follows from (259).

    Examples
    --------
    >>> float(thin_tube_speed(1.5, 0.074) / tube_speed(1.5, 0.076, 0.072) - 1)
    -0.000365
    """
    return np.sqrt(2.0) * constant * np.asarray(mean_diameter, dtype=float) / np.asarray(length, dtype=float) ** 2


def scaled_speed(speed: ArrayLike, length_ratio: ArrayLike, diameter_ratio: ArrayLike = 1.0) -> Array:
    """Return the critical speed of a shaft that is another one made longer and thicker, array (...) [rad/s].

    Parameters
    ----------
    speed : array (...) [rad/s]
        Of the other shaft.
    length_ratio, diameter_ratio : arrays (...)
        Sizes over those of the other shaft.

    Examples
    --------
    >>> float(scaled_speed(6000.0, 2.0))
    1500.0
    """
    return np.asarray(speed, dtype=float) * diameter_ratio / np.asarray(length_ratio, dtype=float) ** 2


def longest_tube(speed: ArrayLike, outer: ArrayLike, inner: ArrayLike, *, wear: ArrayLike = 1.0) -> Array:
    """Return how long a shaft between joints may be for a greatest speed, array (...) [m].

    Parameters
    ----------
    speed : array (...) [rad/s]
        n_max.
    outer, inner : arrays (...) [m]
        D and d.
    wear : array (...)
        k_n, real over computed critical speed.

    Notes
    -----
    The real critical speed is 1.6 times the greatest speed: L² = k_n K √(D²+d²)/(1.6 n_max), K as for `tube_speed`.

    Examples
    --------
    >>> round(float(longest_tube(3000 * rpm, 0.076, 0.072, wear=0.9)), 4)
    1.5411
    """
    return np.sqrt(wear * BOOK_CONSTANT * np.hypot(outer, inner) / (ARTICLE * np.asarray(speed, dtype=float)))


@dataclass(frozen=True, kw_only=True, slots=True)
class Margin:
    """How far a drive stays below a critical speed."""

    critical: float  # [rad/s]: critical speed as computed
    actual: float  # [rad/s]: that of the real shaft, k_n times it
    most: float  # [rad/s]: greatest speed of the drive
    # rules that it breaks: ``article_1.6`` or, where a limit is set, ``limit``; ``catalogue``, ``supercritical``
    violated: tuple[str, ...]
    # [rad/s]: about half the critical speed, where the secondary couples of the joints, twice a turn, excite it
    band: tuple[float, float]
    half_inside: bool  # whether the drive runs in that band
    least: float = ARTICLE  # smallest ratio of the real critical speed to the greatest speed
    share: float = CATALOGUE["automotive"]  # share of the computed critical speed that makers allow

    @property
    def failed(self) -> tuple[str, ...]:
        """Those of the rules broken that are no advice."""
        return tuple(rule for rule in self.violated if rule != PRACTICE)

    @property
    def needed(self) -> float:
        """Ratio at which all rules are kept."""
        return max(self.least, self.actual / (self.share * self.critical))

    @property
    def ratio(self) -> float:
        """Real critical speed over the greatest speed."""
        return self.actual / self.most

    @property
    def computed_ratio(self) -> float:
        """Computed critical speed over the greatest speed."""
        return self.critical / self.most

    @property
    def rule_60_percent(self) -> bool:
        """Whether the computed critical speed is 60 percent above the greatest speed."""
        return self.computed_ratio >= ARTICLE * (1.0 - EDGE)


def speed_margin(
    critical: float,
    most: float,
    *,
    wear: float = 1.0,
    application: str = "automotive",
    operating: tuple[float, ...] | None = None,
    through: bool = False,
    least: float | None = None,
) -> Margin:
    """Return how far a drive stays below a critical speed.

    Parameters
    ----------
    critical : float [rad/s]
        Critical speed as computed.
    most : float [rad/s]
        Greatest speed of the drive.
    wear : float
        k_n, real over computed critical speed: 0.9 to 0.95 with a new slip spline, 0.7 to 0.8 with a worn one.
    application : str
        ``automotive`` or ``industrial``: how much makers allow.
    operating : tuple of float [rad/s], optional
        Speeds of running; the greatest one when not given.
    through : bool
        Whether the drive also runs at all speeds between the lowest and the highest of them.
    least : float, optional
        Smallest ratio of the real critical speed to the greatest speed, in place of the 60 percent of practice.

    Returns
    -------
    Margin

    Notes
    -----
    The 60 percent of the articles are asked of the real critical speed, the shares of the makers of the computed one.

    Examples
    --------
    >>> speed_margin(5000.0, 4000.0, wear=0.9).violated
    ('article_1.6', 'catalogue')
    """
    actual = wear * critical
    more, less = 1.0 + EDGE, 1.0 - EDGE
    asked = ARTICLE if least is None else least
    rules = (
        (PRACTICE if least is None else "limit", actual < asked * most * less),
        ("catalogue", most > CATALOGUE[application] * critical * more),
        ("supercritical", most >= actual * less),
    )
    band = 0.5 * actual * (1.0 - HALF_BAND), 0.5 * actual * (1.0 + HALF_BAND)
    speeds = operating or (most,)
    if through:
        inside = min(speeds) <= band[1] * more and max(speeds) >= band[0] * less
    else:
        inside = any(band[0] * less <= speed <= band[1] * more for speed in speeds)
    return Margin(
        critical=critical,
        actual=actual,
        most=most,
        violated=tuple(name for name, broken in rules if broken),
        band=band,
        half_inside=inside,
        least=asked,
        share=CATALOGUE[application],
    )
