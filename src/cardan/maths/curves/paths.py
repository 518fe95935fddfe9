"""Motion in time: values with their first and second derivative, and turns that carry points along.

A *jet* is the tuple (value, rate, acceleration) of something that moves, all three with the time axes in front. Jets
are exact: products go by the rule of Leibniz, turns by their own derivatives, never by differences.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.kernel import frames

Jet: TypeAlias = tuple[Array, Array, Array]
"""Value, first and second time derivative."""

Path: TypeAlias = Callable[[Array], Jet]
"""Times (t,) -> jet of points (t, k, 3)."""

ACCURATE = 1e-10
"""Accuracy of `transport` [rad]."""

_interpolate = later("scipy.interpolate")


def swing(amplitude: ArrayLike, frequency: float, phase: ArrayLike, times: Array) -> Jet:
    """Return the jet of amplitude · sin(frequency · t + phase), arrays (t, ...).

    amplitude, phase (...): of each swinging quantity; frequency [rad/s]: angular frequency; times (t,) [s].
    """
    xp = namespace(times, amplitude, phase)
    size = real(amplitude, xp)
    shift = real(phase, xp)
    width = max(size.ndim, shift.ndim)
    argument = frequency * xp.reshape(times, (*times.shape, *([1] * width))) + shift
    sine, cosine = size * xp.sin(argument), size * xp.cos(argument)
    return sine, frequency * cosine, -(frequency**2) * sine


def product(times: Callable[[Array, Array], Array], a: Jet, b: Jet) -> Jet:
    """Return the jet of a bilinear product by the rule of Leibniz.

    >>> product(lambda x, y: x * y, (2.0, 1.0, 0.0), (3.0, 1.0, 0.0))
    (6.0, 5.0, 2.0)
    """
    return (
        times(a[0], b[0]),
        times(a[1], b[0]) + times(a[0], b[1]),
        times(a[2], b[0]) + 2.0 * times(a[1], b[1]) + times(a[0], b[2]),
    )


def plus(a: Jet, b: Jet) -> Jet:
    """Return the jet of a sum."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def resting(value: Array) -> Jet:
    """Return the jet of something that does not move."""
    return value, 0.0 * value, 0.0 * value


def turning(axis: ArrayLike, angle: Jet) -> Jet:
    """Return the jet of the rotation matrices about a fixed axis, arrays (t, 3, 3).

    axis (3,): direction of the axis, of any length but zero; angle (t,) [rad]: angle of turn by the right-hand rule.
    R = 1 + sin q K + (1 - cos q) K² (Rodrigues), K the cross-product matrix of the unit axis.
    """
    xp = namespace(angle[0])
    x, y, z = (float(c) for c in frames.unit(np.asarray(axis, dtype=float)))
    k = xp.asarray([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    kk = k @ k
    q, rate, acceleration = (part[..., None, None] for part in angle)
    sine, cosine = xp.sin(q), xp.cos(q)
    slope = cosine * k + sine * kk
    curve = cosine * kk - sine * k
    return xp.eye(3) + sine * k + (1.0 - cosine) * kk, rate * slope, rate**2 * curve + acceleration * slope


def chained(later: Jet, earlier: Jet) -> Jet:
    """Return the jet of two rotations in series, the right one first, arrays (t, 3, 3)."""
    return product(lambda a, b: a @ b, later, earlier)


def turned(rotation: Jet, points: Jet) -> Jet:
    """Return the jet of points (t, k, 3) turned about the origin by rotations (t, 3, 3)."""
    xp = namespace(points[0])
    return product(lambda r, p: p @ xp.matrix_transpose(r), rotation, points)


def carried(rotation: Jet, pivot: ArrayLike, points: Jet) -> Jet:
    """Return the jet of points (t, k, 3) turned about a pivot (3,) [m]."""
    xp = namespace(points[0])
    centre = xp.asarray(pivot, dtype=xp.float64)
    return plus(turned(rotation, (points[0] - centre, points[1], points[2])), resting(centre))


def interpolated(at: ArrayLike, values: ArrayLike, times: Array) -> Jet:
    """Return the jet of the cubic spline through a table: twice differentiable, its derivatives exact.

    at (m,) [s]: times of the rows, strictly rising, at least two; values (m, ...): rows of the table; times (t,) [s].

    >>> import numpy as np
    >>> value, rate, acceleration = interpolated([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 4.0, 9.0], np.asarray([1.5]))
    >>> value, rate, acceleration
    (array([2.25]), array([3.]), array([2.]))
    """
    spline: Any = _interpolate().CubicSpline(np.asarray(at, dtype=float), np.asarray(values, dtype=float), axis=0)
    return spline(times), spline(times, 1), spline(times, 2)


def transport(direction: Callable[[Array], tuple[Array, Array]], times: Array, start: float = 0.0) -> Array:
    """Return how far the shortest-arc frame of a moving direction has twisted against the non-twisting one.

    The shortest-arc frame at time t is the frame of the start turned by the shortest way that brings the direction
    a(start) to a(t). Turning it back by the angle returned gives the frame carried along without any spin about a.
    direction: times (m,) [s] -> unit vectors a (m, 3) and their rates (m, 3) [1/s].
    times (t,) [s]: instants, in any order; start [s]: instant at which both frames agree.
    Returns (t,) [rad].

    The angular velocity of the shortest-arc frame has the component a_0·(ȧ × a)/(1 + a_0·a) along a; its time integral
    is taken by Gauss-Legendre panels, halved until the answer stands to `ACCURATE`, judged by some of the gaps between
    the instants: evenly spread ones and the longest. Zero when a moves in one plane through
    a_0. Singular only for a direction that has turned by 180°.
    """
    instants, back = np.unique(np.append(np.asarray(times, dtype=float), start), return_inverse=True)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    origin = direction(np.asarray([float(start)]))[0][0]
    gaps = np.diff(instants)

    def swept(which: Array, panels: int) -> Array:
        """Return the integral over some gaps."""
        half = 0.5 * gaps[which][:, None, None] / panels
        edges = instants[which][:, None] + gaps[which][:, None] * np.arange(panels) / panels
        at = edges[..., None] + half * (1.0 + nodes)
        a, rate = direction(at.reshape(-1))
        spin = frames.dot(frames.cross(rate, a), origin) / (1.0 + frames.dot(a, origin))
        return np.sum(half * weights * spin.reshape(at.shape), axis=(1, 2))

    probes = np.unique(np.linspace(0, gaps.size - 1, 64).astype(int)) if gaps.size else np.arange(0)
    probes = np.union1d(probes, np.argsort(gaps)[-16:])
    panels, coarse = 1, swept(probes, 1)
    if not np.any(coarse) and not np.any(direction(instants)[1]):
        return np.zeros(np.shape(times))
    while panels < 65536:
        fine = swept(probes, 2 * panels)
        if gaps.size * np.max(np.abs(fine - coarse), initial=0.0) < ACCURATE:
            break
        panels, coarse = 2 * panels, fine
    twist = np.concatenate(([0.0], np.cumsum(swept(np.arange(gaps.size), panels))))
    twist = twist - twist[back[-1]]
    return twist[back[:-1]]


def shortest_arc(origin: Array, direction: Array, vector: Array) -> Array:
    """Return a vector turned by the shortest way that brings unit vector ``origin`` to unit vectors ``direction``.

    origin (3,): unit vector at the start; direction (..., 3): unit vectors, none opposite to ``origin``; vector (3,).
    """
    xp = namespace(origin, direction, vector)
    pole = frames.cross(xp.broadcast_to(origin, direction.shape), direction)
    cosine = frames.dot(origin, direction)[..., None]
    along = frames.dot(pole, vector)[..., None]
    return cosine * vector + frames.cross(pole, xp.broadcast_to(vector, pole.shape)) + along * pole / (1.0 + cosine)


# Stationary normal processes given by a one-sided power spectral density, drawn as a polygon.
#
# The density S(Ω) is piecewise linear between the frequencies given and zero outside; the variance is ∫S dΩ.

BLOCK = 64
"""Cosines summed at once."""


def variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫S dΩ of a spectrum, exactly."""
    return float(_accumulated(*_polygon(frequency, density))[-1])


def rate_variance(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return ∫Ω² S dΩ, the variance of the rate of the process, exactly (Simpson, the integrand is cubic)."""
    omega, s = _polygon(frequency, density)
    middle = 0.5 * (omega[1:] + omega[:-1])
    half = 0.5 * (s[1:] + s[:-1])
    curve = omega**2 * s
    return float(np.sum(np.diff(omega) * (curve[1:] + 4.0 * middle**2 * half + curve[:-1])) / 6.0)


def two_sided(frequency: ArrayLike, density: ArrayLike, at: ArrayLike) -> Array:
    """Return the two-sided density at frequencies of either sign: half the one-sided one at \\|Ω\\|."""
    omega, s = _polygon(frequency, density)
    return 0.5 * np.interp(np.abs(np.asarray(at, dtype=float)), omega, s, left=0.0, right=0.0)


def enough_components(frequency: ArrayLike, duration: float) -> int:
    """Return how many cosines a sample path of a duration needs so that it does not repeat within twice that time."""
    omega = np.asarray(frequency, dtype=float)
    return max(256, math.ceil(float(omega[-1] - omega[0]) * duration / math.pi))


def sample_path(frequency: ArrayLike, density: ArrayLike, times: ArrayLike, *, seed: int, components: int = 256) -> Jet:
    """Return the jet of one sample path of zero mean, arrays (t,).

    frequency (m,) [rad/s]: corners of the spectrum, strictly rising.
    density (m,) [unit²·s/rad]: one-sided density there; times (t,) [s]; seed: the same seed gives the same path.
    components: number of cosines; the path repeats, up to signs, after 2π · components/(bandwidth).
    x(t) = Σ √(2 S_k ΔΩ) cos(Ω_k t + χ_k), χ_k uniform, Ω_k the middles of equal bands; S_k ΔΩ is the exact variance in
    the band, so the mean square over a long time is exactly the variance. The derivatives are those of the same sum.
    """
    omega, s = _polygon(frequency, density)
    edges = np.linspace(omega[0], omega[-1], components + 1)
    inside = np.clip(np.searchsorted(omega, edges, side="right") - 1, 0, omega.size - 2)
    step = edges - omega[inside]
    slope = np.diff(s) / np.diff(omega)
    below = _accumulated(omega, s)[inside] + s[inside] * step + 0.5 * slope[inside] * step**2
    amplitude = np.sqrt(2.0 * np.maximum(np.diff(below), 0.0))
    phase = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, components)
    at = np.asarray(times, dtype=float)
    width = edges[1] - edges[0]
    waves = amplitude * np.exp(1j * phase)
    slopes = 1j * (edges[:-1] + 0.5 * width)
    parts = np.stack((waves, slopes * waves, slopes**2 * waves))
    sums = [_cosines(parts, edges[0] + 0.5 * width, width, piece) for piece in _pieces(at.ravel())]
    value, rate, acceleration = np.concatenate(sums, axis=-1).reshape(3, *at.shape)
    return value, rate, acceleration


def _cosines(parts: Array, first: float, step: float, times: Array) -> Array:
    """Return Re Σ_k c_k e^{i(first + k step)t} of several rows of coefficients c (m, K); array (m, t).

    Equal steps let k = row · BLOCK + column split the sum into a matrix product, with far fewer sines than terms.
    """
    rows = -(-parts.shape[-1] // BLOCK)
    table = np.zeros((parts.shape[0], rows * BLOCK), dtype=complex)
    table[:, : parts.shape[-1]] = parts
    inner = np.exp(1j * np.outer(times, first + step * np.arange(BLOCK)))
    outer = np.exp(1j * np.outer(times, step * BLOCK * np.arange(rows)))
    blocks = inner @ table.reshape(-1, BLOCK).T
    result: Array = np.einsum("tmr,tr->mt", blocks.reshape(times.size, parts.shape[0], rows), outer).real
    return result


def _pieces(times: Array) -> list[Array]:
    """Return the times in pieces that keep the tables of `_cosines` small."""
    return np.array_split(times, max(1, -(-times.size // 2048)))


def _polygon(frequency: ArrayLike, density: ArrayLike) -> tuple[Array, Array]:
    return np.asarray(frequency, dtype=float), np.asarray(density, dtype=float)


def _accumulated(omega: Array, s: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(0.5 * (s[1:] + s[:-1]) * np.diff(omega))))
