"""Growth of disturbances under two frequencies: products of matrices of a phase that goes on by a ratio.

Over a period of the first frequency a disturbance is multiplied by M(θ), θ the second phase at its beginning; then it
has gone on by 2πr. Nothing repeats, so there are no eigenvalues of one period; what there is are exponents, the mean
growth over ever more periods.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array

FEWEST, MOST = 2048, 32768
"""Periods that are multiplied, doubled until the exponents are known."""

AT_ONCE = 4
"""Periods multiplied between two orthogonalisations."""

BLOCK = 2_000_000
"""Numbers in the phases of periods that are held at once."""

BEGIN = 256
"""Periods left out, until the directions of growth are found."""

CLOSE, SURE = 1e-6, 1e-3
"""Error of the largest exponent, per period and over itself, with which it is known."""

TINY = 1e-300

WAVES = 6
"""Harmonics of the second phase in which disturbances are sought that keep their shape."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Exponents:
    """Mean growth per period."""

    growth: Array  # (B, m): ln of what disturbances are multiplied by in a period, falling
    error: Array  # (B, m): how far the halves of the periods are apart


def parts_of(matrices: Array) -> Array:
    """Return the harmonics of matrices (B, S, m, m) at even samples of a phase, in the order of `numpy.fft`."""
    found: Array = np.fft.fft(matrices, axis=1) / matrices.shape[1]
    return found


def tail(parts: Array) -> Array:
    """Return the largest of the upper quarter of the harmonics over the largest of all, array (B,)."""
    count = parts.shape[1]
    number = np.abs(np.fft.fftfreq(count, 1.0 / count))
    size = np.max(np.abs(parts), axis=(2, 3))
    high: Array = np.max(size[:, number >= 0.375 * count], axis=-1)
    return high / np.maximum(np.max(size, axis=-1), TINY)


def exponents(matrices: Array, ratio: float) -> Exponents:
    """Return the exponents of products M(θ0 + 2πr(N-1)) … M(θ0 + 2πr) M(θ0) from θ0 = 0 on.

    matrices (B, S, m, m): M at S even samples of θ, so many that sums of S harmonics hold it between them; ratio: r.
    By orthogonalisation (QR) of a frame, until the exponents of each are known; the logarithms are averaged with
    weights that rise and fall smoothly, with which means of what two frequencies make converge faster than any power of
    the number of periods.
    """
    parts = parts_of(matrices)
    count, rank = len(parts), parts.shape[-1]
    growth, error = np.full((count, rank), np.nan), np.full((count, rank), np.nan)
    frame = np.broadcast_to(np.eye(rank), (count, rank, rank))
    logs = np.zeros((0, count, rank))
    going = np.arange(count)
    done, periods = 0, BEGIN + FEWEST
    while going.size:
        steps = np.arange(done, periods)
        more: list[Array] = []
        for block in _blocks(parts[going], ratio, steps):
            frame, upper = np.linalg.qr(block @ frame)
            more.append(np.diagonal(upper, axis1=-2, axis2=-1))
        logs = np.concatenate([logs, np.log(np.maximum(np.abs(more), TINY)) / AT_ONCE])
        found = _averaged(logs[BEGIN // AT_ONCE :])
        growth[going], error[going] = found.growth, found.error
        known = found.error[:, 0] <= np.maximum(CLOSE, SURE * np.abs(found.growth[:, 0]))
        if periods >= BEGIN + MOST:
            break
        going, frame, logs = going[~known], frame[~known], logs[:, ~known]
        done, periods = periods, 2 * periods - BEGIN
    return Exponents(growth=growth, error=error)


def _blocks(parts: Array, ratio: float, steps: Array) -> Iterator[Array]:
    """Yield products of matrices of successive periods, arrays (B, m, m)."""
    outer, count, rank = parts.shape[0], parts.shape[1], parts.shape[-1]
    number = np.fft.fftfreq(count, 1.0 / count)
    at_once = AT_ONCE * max(1, BLOCK // (AT_ONCE * max(count, outer * rank**2)))
    for some in np.split(steps, range(at_once, len(steps), at_once)):
        turn = np.exp(2j * np.pi * np.multiply.outer((ratio * some) % 1.0, number))
        every = (turn @ parts.swapaxes(0, 1).reshape(count, -1)).real.reshape(-1, AT_ONCE, outer, rank, rank)
        found = every[:, 0]
        for k in range(1, AT_ONCE):
            found = every[:, k] @ found
        yield from found


def _averaged(logs: Array) -> Exponents:
    """Return weighted means of logarithms (n, B, m), the largest first, and how far those of both halves are off."""
    half = len(logs) // 2

    def mean(values: Array) -> Array:
        share = (np.arange(len(values)) + 0.5) / len(values)
        weight = np.exp(-1.0 / (share * (1.0 - share)))
        found: Array = np.tensordot(weight / np.sum(weight), values, axes=1)
        return found

    whole, first, second = mean(logs), mean(logs[:half]), mean(logs[half:])
    error = np.maximum(np.abs(first - whole), np.abs(second - whole))
    order = np.argsort(-whole, axis=-1, kind="stable")
    return Exponents(growth=np.take_along_axis(whole, order, -1), error=np.take_along_axis(error, order, -1))


def turning(matrices: Array, ratio: float) -> tuple[Array, Array]:
    """Return multipliers μ of disturbances f(θ) e^(…) that keep their shape, and how far off harmonic 0 their shape is.

    M(θ) f(θ) = μ f(θ + 2πr): with f also f e^(ilθ) is one, of the multiplier μ e^(-2πilr), so only moduli are of one
    piece; the angle told is that of the shape nearest to harmonic 0. matrices (S, m, m) of one drive.
    Returns (k,), complex, and (k,).
    """
    parts = parts_of(matrices[None])[0]
    count, rank = parts.shape[0], parts.shape[-1]
    high = min(WAVES, (count - 1) // 4)
    n = np.arange(-high, high + 1)
    whole = parts[(n[:, None] - n) % count] * np.exp(-2j * np.pi * ratio * n)[:, None, None, None]
    size = len(n) * rank
    values, shapes = np.linalg.eig(whole.swapaxes(1, 2).reshape(size, size))
    weight = np.sum(np.abs(shapes.reshape(len(n), rank, size)) ** 2, axis=1)
    centre = (n @ weight) / np.sum(weight, axis=0)
    return values, np.abs(centre)
