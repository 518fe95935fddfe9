"""One oscillator under a force that is known: x'' + 2ζω x' + ω²x = F(t), started at rest.

For a force of rising frequency the answer is closed, in complex error functions; for any other one the impulse response
takes the state from step to step, exactly but for the quadrature of the force within a step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache

import numpy as np
import scipy

from cardan.maths.arrays import Array, ArrayLike

CONFLUENT = 1e-8
"""Damping ratios nearer to 1 than this count as so far off it; the answer changes by as much."""

NODES = 8
"""Places within a step where the force is taken, by Gauss's rule."""

CHUNK = 1 << 14
"""Steps taken together."""


def chirp(time: ArrayLike, omega: ArrayLike, zeta: ArrayLike, rate: ArrayLike) -> tuple[Array, Array]:
    """Return the response to the force ω² e^(i a t²/2), whose frequency a t rises from rest, and its rate.

    time (...) [s]: t, at least 0; omega, zeta (...) [rad/s], [-]: ω, and ζ, at least 0.
    rate (...) [rad/s²]: a, positive.
    Returns x, velocity (...), complex: the real part answers ω² cos(a t²/2), the imaginary part ω² sin(a t²/2).
    With s = -ζω ± ω√(ζ² - 1) and p = √(-ia/2), ∫ e^(s(t-u) + iau²/2) du = (√π/2p) e^(st + z_0²) [erf z_1 - erf z_0],
    z_0 = s/2p, z_1 = pt + z_0. Each erf z = ±(1 - e^(-z²) w(±iz)), with the sign of Re z and Faddeeva's w; the powers
    of e that are left have no positive exponent, so nothing overflows however slow the rise.
    """
    t, w, z, a = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in (time, omega, zeta, rate)))
    z = np.where(np.abs(z - 1.0) < CONFLUENT, 1.0 - CONFLUENT, z)
    p = np.sqrt(0.5 * a) * np.exp(-0.25j * np.pi)
    swing = np.exp(0.5j * a * t * t)
    root = w * np.sqrt((z - 1.0) * (z + 1.0) + 0j)
    found, rates = [], []
    for s in (root - z * w, -root - z * w):
        begin = 0.5 * s / p
        end = p * t + begin
        first, last = (np.where(one.real < 0.0, -1.0, 1.0) for one in (begin, end))
        passed = first != last
        free = np.where(passed, np.exp(np.where(passed, s * t + begin * begin, 0.0)), 0.0)
        total = (last - first) * free - last * swing * scipy.special.wofz(1j * last * end)
        total = total + first * np.exp(s * t) * scipy.special.wofz(1j * first * begin)
        found.append(total * np.sqrt(np.pi) / (2.0 * p))
        rates.append(s * found[-1])
    share = w * w / (2.0 * root)
    return share * (found[0] - found[1]), share * (rates[0] - rates[1])


def impulse(time: Array, omega: float, zeta: float) -> tuple[Array, Array]:
    """Return the response to a unit impulse and its rate, arrays (...).

    time (...) [s]: t; not so long that ζωt leaves the range of the exponential.
    omega, zeta [rad/s] [-]: ω, ζ.
    """
    damped = omega * np.sqrt(complex(1.0 - zeta) * (1.0 + zeta))
    decay = np.exp(-zeta * omega * time)
    x = decay * time * np.sinc(damped * time / np.pi).real
    return x, decay * np.cos(damped * time).real - zeta * omega * x


def advanced(
    force: Callable[[Array], Array], begin: Array, span: Array, state: tuple[Array, Array], omega: float, zeta: float
) -> tuple[Array, Array]:
    """Return displacement and velocity a while later.

    force: from times (...) to F.
    begin, span (...) [s]: when, and how much later; the force and ωt must be smooth over a span.
    state, pair of arrays (...): displacement and velocity at the beginning; omega, zeta [rad/s] [-]: ω, ζ.
    Returns x, velocity (...).
    """
    half = 0.5 * span[..., None]
    node, weight = _rule()
    inside = half * (1.0 + node)
    x, v = impulse(span, omega, zeta)
    kept = v + 2.0 * zeta * omega * x
    pushed = half * weight * force(begin[..., None] + inside)
    late = impulse(2.0 * half - inside, omega, zeta)
    return (
        kept * state[0] + x * state[1] + np.sum(late[0] * pushed, axis=-1),
        -omega * omega * x * state[0] + v * state[1] + np.sum(late[1] * pushed, axis=-1),
    )


@cache
def _rule() -> tuple[Array, Array]:
    """Return nodes and weights on (-1, 1)."""
    node, weight = np.polynomial.legendre.leggauss(NODES)
    return node, weight


def stepped(
    force: Callable[[Array], Array], end: float, steps: int, omega: float, zeta: float
) -> Iterator[tuple[Array, Array, Array]]:
    """Yield times, displacements and velocities from rest to an end, in pieces that share their end points.

    force: from times (...) to F; end [s]; omega, zeta [rad/s] [-]: ω, ζ.
    States are u_n+1 = Φu_n + F_n with one Φ. All of a piece are summed by doubling: adding Φ^d u_n-d for d = 1, 2, 4 …
    """
    h = end / steps
    x, v = impulse(np.asarray(h), omega, zeta)
    step = np.asarray([[v + 2.0 * zeta * omega * x, x], [-omega * omega * x, v]])
    state = np.zeros(2)
    for first in range(0, steps, CHUNK):
        time = h * np.arange(first, min(first + CHUNK, steps) + 1)
        rest = np.zeros(time.size - 1)
        sums = np.stack(advanced(force, time[:-1], h + rest, (rest, rest), omega, zeta))
        sums[:, 0] += step @ state
        power, shift = step, 1
        while shift < rest.size:
            sums[:, shift:] = sums[:, shift:] + power @ sums[:, :-shift]
            power, shift = power @ power, 2 * shift
        yield time, np.append(state[0], sums[0]), np.append(state[1], sums[1])
        state = sums[:, -1].copy()
