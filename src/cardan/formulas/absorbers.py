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
