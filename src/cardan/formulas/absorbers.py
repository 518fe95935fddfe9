"""Which absorber or damper calms a vibration, and how is it to be tuned? Closed forms for one mode.

The system is one inertia J on a spring c, or one elastic mode reduced to the station of the absorber, with
ω_0 = √(c/J). An absorber J_a hangs on it by a spring c_a and a damper b: inertia ratio α_J = J_a/J, frequency ratio
f = ω_a/ω_0, damping ξ = b/(2 J_a ω_0), frequency of the torque β = ω/ω_0. A viscous damper has no spring, f = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import NUMBERS, Array, ArrayLike, complex_of, namespace, real
from cardan.maths.kernel.polynomials import added, derivative, polynomial, product, roots
from cardan.texts import _


@dataclass(frozen=True, eq=False, kw_only=True)
class AbsorberResponse:
    """Steady vibration of a system with an absorber or a damper, in units of its static angle M_0/c."""

    beta: Array  # (p,): frequency of the torque over ω_0
    main: Array  # main, absorber (..., p), complex: amplitude and phase of the system and of the absorber
    absorber: Array  # (..., p), complex
    # (..., p): amplitude of the system by Book (249), (252); infinite at a resonance without damping
    amplification: Array
    bare: Array  # (p,): the same without the absorber
    natural: Array  # (..., 2): natural frequencies over ω_0 with the undamped absorber, Book (248)
    residual: Array  # (..., p): what complex and printed form differ by, over the larger of 1 and the amplification

    @property
    def twist(self) -> Array:
        """Angle between absorber and system, which its spring has to bear: complex array (..., p)."""
        return self.absorber - self.main


def natural_frequencies(inertia_ratio: ArrayLike, frequency_ratio: ArrayLike) -> Array:
    """Return the two natural frequencies of a system with an undamped absorber, over that of the system alone.

    inertia_ratio (...): α_J; frequency_ratio (...): f.
    Returns (..., 2).
    Book (248): β² = ½ [s ∓ √(s² - 4f²)], s = 1 + (1 + α_J) f²; the root and the smaller one without differences.
    """
    xp, (alpha, f) = arrays(inertia_ratio, frequency_ratio)
    held = (1.0 + alpha) * f * f
    total = 1.0 + held
    larger = 0.5 * (total + xp.sqrt((1.0 - held) ** 2 + 4.0 * alpha * f * f))
    return xp.sqrt(xp.stack((f * f / larger, larger), axis=-1))


def amplification(
    beta: ArrayLike, inertia_ratio: ArrayLike, frequency_ratio: ArrayLike, damping: ArrayLike = 0.0
) -> Array:
    """Return \\|φ\\| c/M_0 of a system with an absorber, or with a viscous damper where f = 0.

    beta (...): ω/ω_0; inertia_ratio, frequency_ratio, damping (...): α_J, f, ξ.
    Returns (...): infinite at a resonance without damping.
    Book (249): √{[(2ξβ)² + (β²-f²)²]/[(2ξβ)²(β²-1+α_Jβ²)² + (α_J f²β² - (β²-1)(β²-f²))²]}; with f = 0 it is (252),
    β² taken out of both.
    """
    xp, (beta, alpha, f, xi) = arrays(beta, inertia_ratio, frequency_ratio, damping)
    square, tuned = beta * beta, f * f
    drag = xp.where(f > 0.0, 4.0 * xi * xi * square, 4.0 * xi * xi)
    one, other = xp.where(f > 0.0, square - tuned, beta), xp.where(f > 0.0, alpha * tuned * square, 0.0)
    above = drag + one * one
    below = drag * (square - 1.0 + alpha * square) ** 2 + (other - (square - 1.0) * one) ** 2
    still = above == 0.0  # the undamped absorber holds the system, and at rest a loose one takes no part
    below = xp.where(still, 1.0, below)
    found = xp.sqrt(above / xp.where(below == 0.0, 1.0, below))
    found = xp.where(below == 0.0, xp.inf, found)
    return xp.where(still & (f == 0.0), 1.0, found)


def absorber_response(
    beta: ArrayLike, inertia_ratio: ArrayLike, frequency_ratio: ArrayLike, damping: ArrayLike = 0.0
) -> AbsorberResponse:
    """Return the vibration of a system and its absorber over the frequency, with phases.

    Parameters
    ----------
    beta : array (p,)
        ω/ω_0, at least 0.
    inertia_ratio : array (...)
        α_J, positive.
    frequency_ratio : array (...)
        f, positive; 0 for a viscous damper, which has no spring.
    damping : array (...)
        ξ = b/(2 J_a ω_0), at least 0.

    Returns
    -------
    AbsorberResponse

    Raises
    ------
    InputError
        α_J ≤ 0, f < 0, ξ < 0, or a negative frequency.

    Notes
    -----
    At ω = ω_a an undamped absorber holds the system still and swings with M_0/c_a itself, an amplitude of 1/(α_J f²)
    here.

    Examples
    --------
    >>> found = absorber_response([0.9, 1.0], 0.05, 1.0)
    >>> found.amplification, abs(found.absorber)
    (array([43.18181818,  0.        ]), array([227.27272727,  20.        ]))
    """
    _xp, (beta, alpha, f, xi) = arrays(beta, inertia_ratio, frequency_ratio, damping)
    check(ratio_problems(beta=beta, inertia_ratio=alpha, frequency_ratio=f, damping=xi))
    natural = natural_frequencies(alpha, f)
    xp, (beta, alpha, f, xi) = arrays(beta, alpha[..., None], f[..., None], xi[..., None])
    size = amplification(beta, alpha, f, xi)
    loose = f == 0.0
    square, held = beta * beta, xp.where(loose, 0.0, f * f)
    drag = 2j * complex_of(xp.where(loose, xi, xi * beta), xp)
    free = complex_of(held - xp.where(loose, beta, square), xp) + drag
    pull = complex_of(held, xp) + drag
    below = complex_of(1.0 - square, xp) * free - complex_of(alpha * square, xp) * pull
    there = (below != 0.0) & xp.isfinite(size)
    below = xp.where(there, below, 1.0)
    unit = xp.ones_like(size)
    still = complex_of(xp.where(xp.isfinite(size), unit, xp.nan), xp)  # no spring, no damper, at rest
    main = xp.where(there, free / below, still)
    moved = xp.where(there, pull / below, 0.0 * still)
    bare = xp.abs(1.0 - square)
    return AbsorberResponse(
        beta=beta,
        main=main,
        absorber=moved,
        amplification=size,
        bare=xp.where(bare == 0.0, xp.inf, 1.0 / xp.where(bare == 0.0, 1.0, bare)),
        natural=natural,
        residual=xp.where(there, xp.abs(xp.abs(main) - size) / xp.where(there & (size > 1.0), size, 1.0), 0.0),
    )


def absorber_stiffness(omega: ArrayLike, inertia: ArrayLike, stiffness: ArrayLike, damping: ArrayLike = 0.0) -> Array:
    """Return the dynamic stiffness of an absorber or damper where it is fixed, to be added to that of its station.

    Parameters
    ----------
    omega : array (...) [rad/s]
        Frequency.
    inertia, stiffness, damping : arrays (...) [kg·m²], [N·m/rad], [N·m·s/rad]
        Of the absorber; stiffness 0 for a viscous damper.

    Returns
    -------
    complex array (...) [N·m/rad]
        Infinite where the absorber swings freely at its own frequency.

    Notes
    -----
    -ω²J_a (c_a + iωb)/(c_a + iωb - ω²J_a).

    Examples
    --------
    >>> absorber_stiffness([10.0], 0.5, 200.0)
    array([-66.66666667+0.j])
    """
    xp, (w, j, c, b) = arrays(omega, inertia, stiffness, damping)
    held = complex_of(c + 0.0 * w, xp) + 1j * complex_of(w * b, xp)
    pull = complex_of(-w * w * j, xp)
    below = held + pull
    there = below != 0.0
    return xp.where(there, pull * held / xp.where(there, below, 1.0), xp.inf)


def arrays(*values: ArrayLike) -> tuple[Any, tuple[Array, ...]]:
    """Return the library of values and the values as its arrays of floats."""
    xp = namespace(*values)
    xp = np if xp is NUMBERS else xp
    return xp, tuple(real(value, xp) for value in values)


def ratio_problems(**given: Array) -> list[Problem]:
    """Return what is wrong with ratios and frequencies."""
    found = []
    for name, values in given.items():
        whole = np.asarray(values)
        if name == "inertia_ratio" and not np.all((whole > 0.0) & np.isfinite(whole)):
            found.append(Problem(name, _("needs to be positive")))
        elif not np.all((whole >= 0.0) & np.isfinite(whole)):
            found.append(Problem(name, _("needs to be a number that is not negative")))
    return found


# How is an absorber or damper best tuned, and what peak remains? Closed forms for one mode.
#
# The letters are those of `cardan.formulas.absorbers`.


def peak(inertia_ratio: ArrayLike, frequency_ratio: ArrayLike, damping: ArrayLike) -> tuple[Array, Array]:
    """Return where the amplification of a system with an absorber is largest, and how large.

    inertia_ratio, frequency_ratio, damping (...): α_J, f, ξ; f = 0 for a viscous damper.
    Returns beta, amplification (...): infinite without damping, at the lower natural frequency.
    The square of (249) is a quotient of polynomials in u = β² - 1, stationary at the roots of one of fifth degree. The
    real parts of all its roots are tried: the true maximum is among them.
    """
    alpha, f, xi = np.broadcast_arrays(
        *(np.asarray(one, dtype=float) for one in (inertia_ratio, frequency_ratio, damping))
    )
    tuned = f * f
    square, u, off = polynomial(1.0, 1.0), polynomial(0.0, 1.0), polynomial((1.0 - f) * (1.0 + f), 1.0)
    drag = product(polynomial(4.0 * xi * xi), square)
    lag, across = polynomial(alpha, 1.0 + alpha), added(product(polynomial(alpha * tuned), square), -product(u, off))
    above, below = (
        added(product(drag, product(a, a)), product(b, b)) for a, b in ((polynomial(1.0), off), (lag, across))
    )
    slope = added(product(derivative(above), below), -product(above, derivative(below)))
    beta = np.sqrt(np.maximum(1.0 + roots(slope).real, 0.0))
    size = amplification(beta, alpha[..., None], f[..., None], xi[..., None])
    best = np.argmax(size, axis=-1)[..., None]
    at, most = (np.take_along_axis(values, best, axis=-1)[..., 0] for values in (beta, size))
    lower = np.where(f > 0.0, natural_frequencies(alpha, f)[..., 0], 1.0)
    return np.where(xi > 0.0, at, lower), np.where(xi > 0.0, most, np.inf)


@dataclass(frozen=True, eq=False, kw_only=True)
class Tuning:
    """How an absorber or damper is set, and what remains.

    Attributes
    ----------
    inertia_ratio : array (...)
        α_J.
    frequency_ratio : array (...)
        f; 0 for a viscous damper.
    damping : array (...)
        ξ = b/(2 J_a ω_0).
    peak : array (...)
        Largest amplification over all frequencies.
    peak_beta : array (...)
        Where it is, over ω_0.
    fixed_beta : array (..., 2) or None
        Frequencies at which the amplification is the same for any damping.
    fixed_amplification : array (...) or None
        How large it is there.
    """

    inertia_ratio: Array
    frequency_ratio: Array
    damping: Array
    peak: Array
    peak_beta: Array
    fixed_beta: Array | None = None
    fixed_amplification: Array | None = None

    def sized(self, inertia: ArrayLike, omega: ArrayLike) -> tuple[Array, Array, Array]:
        """Return inertia [kg·m²], stiffness [N·m/rad] and damping [N·m·s/rad] of the absorber, arrays (...).

        Parameters
        ----------
        inertia : array (...) [kg·m²]
            J of the system, or of the mode at the station of the absorber.
        omega : array (...) [rad/s]
            ω_0.

        Examples
        --------
        >>> print(*den_hartog(0.05).sized(0.4, 60.0))
        0.02 65.30612 0.30544142
        """
        _xp, (j, w) = arrays(inertia, omega)
        own = self.inertia_ratio * j
        return own, own * (self.frequency_ratio * w) ** 2, 2.0 * own * w * self.damping


def den_hartog(inertia_ratio: ArrayLike) -> Tuning:
    """Return the setting by fixed points: both equally high, the curve level at them on the mean.

    Parameters
    ----------
    inertia_ratio : array (...)
        α_J, positive.

    Returns
    -------
    Tuning
        With the true peak, which is a little above the fixed points.

    Raises
    ------
    InputError
        α_J ≤ 0.

    Notes
    -----
    Book (250), (251): f = 1/(1 + α_J), fixed points β² = (1 ∓ √(α_J/(2 + α_J)))/(1 + α_J) of height √(1 + 2/α_J),
    ξ = √(3α_J/(8(1 + α_J)³)).

    Examples
    --------
    >>> found = den_hartog(0.1)
    >>> print(found.frequency_ratio, found.damping, found.fixed_amplification, found.peak)
    0.90909091 0.16785203 4.58257569 4.59022017
    """
    xp, alpha = _ratio(inertia_ratio)
    f, xi = 1.0 / (1.0 + alpha), xp.sqrt(0.375 * alpha / (1.0 + alpha) ** 3)
    spread = xp.sqrt(alpha / (2.0 + alpha))
    beta, most = peak(alpha, f, xi)
    return Tuning(
        inertia_ratio=alpha,
        frequency_ratio=f,
        damping=xi,
        peak=most,
        peak_beta=beta,
        fixed_beta=xp.sqrt(xp.stack((1.0 - spread, 1.0 + spread), axis=-1) * f[..., None]),
        fixed_amplification=xp.sqrt(1.0 + 2.0 / alpha),
    )


def h_infinity(inertia_ratio: ArrayLike) -> Tuning:
    """Return the setting with the smallest possible peak: both maxima equally high, exactly.

    Parameters
    ----------
    inertia_ratio : array (...)
        α_J, positive.

    Returns
    -------
    Tuning

    Raises
    ------
    InputError
        α_J ≤ 0.

    Notes
    -----
    Closed form (Nishihara, Asami) with μ = α_J, r = √(4 + 3μ); differences of like numbers taken out:
    f = 2/(1 + μ) √(2 [16 + 23μ + 9μ² + 2(2 + μ)r]/(3(64 + 80μ + 27μ²))), ξ = ¼f √(3μ(32 + 27μ)/((1 + μ)(8 + 9μ + 4r))),
    peak = ⅓ √((27r⁵ + 54r⁴ + 72r³ + 16r² - 16r - 32)/(μ(r + 2)(32 + 27μ))).

    Examples
    --------
    >>> found = h_infinity(0.1)
    >>> print(found.frequency_ratio, found.damping, found.peak)
    0.90905829 0.16860289 4.58916557
    """
    xp, mu = _ratio(inertia_ratio)
    r = xp.sqrt(4.0 + 3.0 * mu)
    share = (16.0 + 23.0 * mu + 9.0 * mu * mu + 2.0 * (2.0 + mu) * r) / (64.0 + 80.0 * mu + 27.0 * mu * mu)
    f = 2.0 / (1.0 + mu) * xp.sqrt(2.0 / 3.0 * share)
    xi = 0.25 * f * xp.sqrt(3.0 * mu * (32.0 + 27.0 * mu) / ((1.0 + mu) * (8.0 + 9.0 * mu + 4.0 * r)))
    rest = ((((27.0 * r + 54.0) * r + 72.0) * r + 16.0) * r - 16.0) * r - 32.0
    most = xp.sqrt(rest / (mu * (r + 2.0) * (32.0 + 27.0 * mu))) / 3.0
    return Tuning(inertia_ratio=mu, frequency_ratio=f, damping=xi, peak=most, peak_beta=peak(mu, f, xi)[0])


def viscous_optimum(inertia_ratio: ArrayLike) -> Tuning:
    """Return the best viscous damper (Houdaille): an inertia held by nothing but viscous drag.

    Parameters
    ----------
    inertia_ratio : array (...)
        α_J, positive.

    Returns
    -------
    Tuning
        The peak is at the fixed point.

    Raises
    ------
    InputError
        α_J ≤ 0.

    Notes
    -----
    Of (252): ξ = 1/√(2(1 + α_J)(2 + α_J)), peak 1 + 2/α_J at β = √(2/(2 + α_J)).

    Examples
    --------
    >>> found = viscous_optimum(0.5)
    >>> print(found.damping, found.peak, found.peak_beta)
    0.36514837 5.0 0.89442719
    """
    xp, alpha = _ratio(inertia_ratio)
    return Tuning(
        inertia_ratio=alpha,
        frequency_ratio=0.0 * alpha,
        damping=1.0 / xp.sqrt(2.0 * (1.0 + alpha) * (2.0 + alpha)),
        peak=1.0 + 2.0 / alpha,
        peak_beta=xp.sqrt(2.0 / (2.0 + alpha)),
    )


def _ratio(inertia_ratio: ArrayLike) -> tuple[Any, Array]:
    xp, (alpha,) = arrays(inertia_ratio)
    check(ratio_problems(inertia_ratio=alpha))
    return xp, alpha


KINDS = ("none", "undamped", "viscous", "den_hartog", "h_infinity")
"""What hangs on the system: nothing, an absorber of its own frequency without damping, and the three settings."""

LOWEST = 0.02
"""Smallest frequency ratio of the curves."""

PLACES = 1201
"""Frequencies of the curves."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Variants:
    """What absorbers and dampers of one inertia make of the same vibration."""

    inertia_ratio: float  # α_J
    beta: Array  # (p,): frequency of the torque over ω_0
    kinds: tuple[str, ...]  # names of the variants, of `KINDS`
    amplification: Array  # (v, p): amplitude of each over the static angle; infinite at a resonance without damping
    frequency_ratio: Array  # frequency_ratio, damping (v,): f, ξ of each; nan where nothing hangs on the system
    damping: Array  # (v,)
    peak: Array  # peak, peak_beta (v,): largest amplification over all frequencies, and where
    peak_beta: Array  # (v,)


def absorber_variants(inertia_ratio: float, beta: ArrayLike | None = None) -> Variants:
    """Return what absorbers and dampers of one inertia make of the same vibration.

    inertia_ratio: α_J, positive.
    beta (p,): frequencies over ω_0, none negative; about the resonance by default.
    """
    alpha = float(inertia_ratio)
    check(ratio_problems(inertia_ratio=np.asarray(alpha)))
    wide = float(np.clip(3.0 * np.sqrt(alpha), 0.25, 1.0))
    places = np.linspace(max(LOWEST, 1.0 - wide), 1.0 + wide, PLACES) if beta is None else np.asarray(beta, dtype=float)
    settings = [viscous_optimum(alpha), den_hartog(alpha), h_infinity(alpha)]
    tuned = np.asarray([1.0, *(float(one.frequency_ratio) for one in settings)])
    xi = np.asarray([0.0, *(float(one.damping) for one in settings)])
    found = absorber_response(places, alpha, tuned, xi)
    return Variants(
        inertia_ratio=alpha,
        beta=places,
        kinds=KINDS,
        amplification=np.concatenate((found.bare[None], found.amplification)),
        frequency_ratio=np.append(np.nan, tuned),
        damping=np.append(np.nan, xi),
        peak=np.asarray([np.inf, np.inf, *(float(one.peak) for one in settings)]),
        peak_beta=np.asarray([1.0, float(peak(alpha, 1.0, 0.0)[0]), *(float(one.peak_beta) for one in settings)]),
    )
