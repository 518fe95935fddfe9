"""SU(1,1) pairs: a universal joint is a Möbius map of the unit circle.

A shaft angle θ is the point w = e^(2iθ). A Hooke joint maps w to (w - τ)/(1 - τ w) with τ = tan²(α/2); shifting the
angle's origin turns w. Both are matrices [[a, b], [b̄, ā]] with |a|² - |b|² = 1, kept as the *pair* (a, b). A chain of
joints is the product of its matrices, hence again such a pair, hence kinematically one joint. In the hyperbolic plane
(Poincaré disk) a pair moves the origin by the length L = -ln cos α, and a chain walks along a polygon.
"""

from __future__ import annotations

from typing import TypeAlias

from cardan.maths.arrays import Array, argument, complex_of, namespace, unit_complex

Pair: TypeAlias = tuple[Array, Array]
"""The first row (a, b) of a matrix in SU(1,1)."""


def hooke(joint_angle: Array) -> Pair:
    """Return the pair of a Hooke joint, its angle counted from the plane of its shafts.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Joint angle α in [0, π/2).

    Notes
    -----
    (1, -τ)/√(1-τ²) with τ = tan²(α/2), written without a difference of near numbers:
    (cos²(α/2), -sin²(α/2))/√cos α.

    Examples
    --------
    >>> import numpy as np
    >>> a, b = hooke(np.asarray(0.0))
    >>> print(a, abs(b))
    (1+0j) 0.0
    """
    xp = namespace(joint_angle)
    root = xp.sqrt(xp.cos(joint_angle))
    half = 0.5 * joint_angle
    return complex_of(xp.cos(half) ** 2 / root, xp), complex_of(-(xp.sin(half) ** 2) / root, xp)


def turn(angle: Array) -> Pair:
    """Return the pair that adds ``angle`` to the shaft angle: w → e^(2i angle) w."""
    a = unit_complex(angle)
    return a, 0.0 * a


def compose(later: Pair, earlier: Pair) -> Pair:
    """Return the pair of two maps in series."""
    c, d = later
    a, b = earlier
    xp = namespace(a, b, c, d)
    return c * a + d * xp.conj(b), c * b + d * xp.conj(a)


def inverse(pair: Pair) -> Pair:
    """Return the pair that undoes ``pair``."""
    a, b = pair
    xp = namespace(a, b)
    return xp.conj(a), -b


def apply(pair: Pair, w: Array) -> Array:
    """Return the image of points of the closed unit disk."""
    a, b = pair
    xp = namespace(a, b, w)
    return (a * w + b) / (xp.conj(b) * w + xp.conj(a))


def _kernel(pair: Pair, w: Array) -> Array:
    a, b = pair
    xp = namespace(a, b, w)
    return xp.conj(b) * w + xp.conj(a)


def _square(z: Array) -> Array:
    xp = namespace(z)
    return xp.real(z) ** 2 + xp.imag(z) ** 2


def ratio(pair: Pair, w: Array) -> Array:
    """Return the derivative dθ_out/dθ_in = 1/|b̄ w + ā|² (a Poisson kernel)."""
    return 1.0 / _square(_kernel(pair, w))


def ratio_slope(pair: Pair, w: Array) -> Array:
    """Return the derivative of `ratio` by the input angle [1/rad]. -2 Re(k̄ · 2i b̄ w)/|k|⁴ with k = b̄ w + ā."""
    k = _kernel(pair, w)
    xp = namespace(k)
    return 4.0 * xp.imag(xp.conj(k) * xp.conj(pair[1]) * w) / _square(k) ** 2


def angle_error(pair: Pair, w: Array) -> Array:
    """Return how far the output runs ahead of the input, apart from a constant; continuous over any number of turns.

    Notes
    -----
    g = -arg((b̄ w + ā)/ā) = -arg(1 - z), |z| = tanh(L/2) < 1, so the argument never jumps; |g| ≤ arcsin |z|. Exact.
    """
    a, b = pair
    xp = namespace(a, b, w)
    return -argument(1.0 + xp.conj(b) / xp.conj(a) * w)


def course(pair: Pair, w: Array) -> tuple[Array, Array, Array]:
    """Return `angle_error`, `ratio` and `ratio_slope` at once, for half the work.

    With x + iy = (b̄ w + ā)/ā: -arg(x + iy), 1/(|a|² (x² + y²)), 4 |a|² y ratio².
    """
    a, b = pair
    xp = namespace(a, b, w)
    z = xp.conj(b) / xp.conj(a) * w
    x, y = 1.0 + xp.real(z), xp.imag(z)
    size = _square(a)
    speed = 1.0 / (size * (x * x + y * y))
    return -xp.atan2(y, x), speed, 4.0 * size * (y * speed * speed)


def tau(pair: Pair) -> Array:
    """Return τ = |b|/|a| = tan²(α/2) of the equivalent joint."""
    a, b = pair
    xp = namespace(a, b)
    return xp.abs(b) / xp.abs(a)


def joint_angle(pair: Pair) -> Array:
    """Return the joint angle α of the equivalent joint [rad], accurate for small ones."""
    xp = namespace(*pair)
    return 2.0 * xp.atan(xp.sqrt(tau(pair)))


def length(pair: Pair) -> Array:
    """Return the hyperbolic length L = -ln cos α = 2 arsinh |b| of the equivalent joint, short or long."""
    xp = namespace(*pair)
    return 2.0 * xp.asinh(xp.abs(pair[1]))


def phase(pair: Pair) -> Array:
    """Return the phase angle ψ of the equivalent joint [rad], modulo π; meaningless where b = 0."""
    a, b = pair
    return -0.5 * argument(-b / a)


def speed_fluctuation(pair: Pair) -> Array:
    """Return δ = i_max - i_min = 4 |a| |b|."""
    a, b = pair
    xp = namespace(a, b)
    return 4.0 * xp.abs(a) * xp.abs(b)


def vertex(pair: Pair) -> Array:
    """Return the corner of the phase polygon in the unit disk: the point that ``pair`` moves to the origin, -b/a.

    The corner after joint k lies τ_k from the origin at the angle -2 ψ_k of the equivalent joint of the first k
    joints; two neighbouring corners are the hyperbolic length of a joint apart; the chain is synchronous exactly when
    the last corner is the origin.
    """
    a, b = pair
    return -b / a


def partial_products(joint_angle: Array, turn_before: Array) -> list[Pair]:
    """Return the pairs of the first 1, 2, … n joints of a chain of Hooke joints.

    joint_angle (..., n) [rad]: joint angles; turn_before (..., n) [rad]: angle μ_i added before joint i.
    Returns list of n Pair, each (...).
    """
    xp = namespace(joint_angle, turn_before)
    products: list[Pair] = []
    for i in range(joint_angle.shape[-1]):
        (c, d), e = hooke(joint_angle[..., i]), unit_complex(turn_before[..., i])
        step = c * e, d * xp.conj(e)
        products.append(compose(step, products[-1]) if products else step)
    return products
