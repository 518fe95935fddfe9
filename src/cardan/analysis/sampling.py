"""Errors drawn at random from their tolerances, and the exact loops they make."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.accuracy import Tolerance
from cardan.drive.chain import Chain, chain
from cardan.drive.drive import Drive
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .accuracy import ahead, error_arrays, links, located_shafts, one_turn, transmission_error, walk

SIGMA = {"normal": 1.0 / 3.0, "uniform": 1.0 / math.sqrt(3.0), "triangular": 1.0 / math.sqrt(6.0)}
"""Standard deviation of each distribution, as a share of the tolerance."""

BATCHES = 8
"""Independent draws whose scatter tells how far a result is to be trusted."""

KEPT = 65_536
"""Samples whose values at every position are kept for quantiles."""

_CACHE = 16_000
"""Values for which the expressions stay in the caches."""


@dataclass(frozen=True, kw_only=True, slots=True)
class MonteCarlo:
    """Exact loops with errors drawn from their distributions.

    Parameters
    ----------
    samples : int
        Drives to draw; for Sobol' points rounded up to eight times a power of two.
    seed : int
        The same seed draws the same drives.
    points : str
        "sobol" (scrambled, evenly spread) or "random".
    positions : int
        Positions of a turn.
    """

    samples: int = 65_536
    seed: int = 1
    points: str = "sobol"
    positions: int = 72

    def __post_init__(self) -> None:
        problems = []
        if self.samples < 16 * BATCHES:
            text = _("{given} given; at least {least} are needed")
            problems.append(Problem("samples", text.format(given=self.samples, least=16 * BATCHES)))
        if self.seed < 0:
            problems.append(Problem("seed", _("{given} given; it may not be negative").format(given=self.seed)))
        if self.positions < 8:
            text = _("{given} given; at least {least} are needed")
            problems.append(Problem("positions", text.format(given=self.positions, least=8)))
        if self.points not in ("sobol", "random"):
            text = _("{value} is none of {choices}")
            problems.append(Problem("points", text.format(value=repr(self.points), choices="sobol, random")))
        check(problems)


@dataclass(frozen=True, eq=False, kw_only=True)
class Sample:
    """What the draws came to, over one turn; [rad] for angles, [m] for shifts.

    Attributes
    ----------
    average, deviation : array (p,)
        Mean and standard deviation at each position.
    lower, upper : array (p,)
        0.15 % and 99.85 % quantiles.
    lower_95, upper_95 : array (p,)
        2.5 % and 97.5 % quantiles.
    mean, first, second, peak_to_peak : float
        99.7 % quantiles of the sizes of mean and first two orders over a turn, and of the change over it, each less
        what the known errors make.
    """

    average: Array
    deviation: Array
    lower: Array
    upper: Array
    lower_95: Array
    upper_95: Array
    mean: float
    first: float
    second: float
    peak_to_peak: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Convergence:
    """How a result settles as samples are added.

    Attributes
    ----------
    samples : array of int (b,)
        Samples after each batch.
    deviation : array (b,) [rad]
        Standard deviation of the output angle at its worst position, from the samples so far; of the shift [m] where
        no tolerance of an angle is given.
    standard_error : float
        Standard error of the last of them, as a share, from the scatter of the batches.
    lost : int
        Samples that could not be assembled at some position; they are left out.
    """

    samples: Array
    deviation: Array
    standard_error: float
    lost: int


@dataclass(frozen=True, eq=False, kw_only=True)
class Draw:
    """Samples of output angle and shift, and how far they are to be trusted."""

    samples: tuple[Sample, Sample]
    convergence: Convergence
    cancelled: bool


def drawn(limits: Array, distributions: Sequence[str], count: int, *, seed: int, points: str) -> Iterator[Array]:
    """Yield independent batches of errors.

    Parameters
    ----------
    limits : array (d,)
        Tolerances.
    distributions : sequence of d str
        "normal" with σ a third of the tolerance, "uniform" or "triangular" within it.
    count : int
        Samples in all batches together.
    seed : int
        Seed.
    points : str
        "sobol" or "random".

    Yields
    ------
    array (m, d)

    Examples
    --------
    >>> first = next(drawn(np.asarray([1.0]), ["uniform"], 1024, seed=1, points="sobol"))
    >>> first.shape, bool(abs(first.mean()) < 0.01)
    ((128, 1), True)
    """
    each = -(-count // BATCHES)
    for child in np.random.SeedSequence(seed).spawn(BATCHES):
        rng = np.random.default_rng(child)
        if points == "sobol":
            from scipy.stats import qmc

            share = qmc.Sobol(len(limits), rng=rng).random_base2(max(0, math.ceil(math.log2(each))))
        else:
            share = rng.random((each, len(limits)))
        yield np.stack([_from_share(share[:, k], kind) for k, kind in enumerate(distributions)], axis=-1) * limits


def _from_share(share: Array, kind: str) -> Array:
    """Return the quantiles at given shares of a distribution on (-1, 1); the normal one has three σ there."""
    if kind == "uniform":
        return 2.0 * share - 1.0
    if kind == "triangular":
        return np.where(share < 0.5, np.sqrt(2.0 * share) - 1.0, 1.0 - np.sqrt(2.0 * (1.0 - share)))
    from scipy.special import ndtri

    least = 2.0**-54  # scrambled points can touch zero
    found: Array = SIGMA["normal"] * ndtri(np.clip(share, least, 1.0 - least))
    return found


def sampled(
    drive: Drive,
    spreads: Sequence[Tolerance | None],
    method: MonteCarlo,
    *,
    progress: Callable[[float], object] | None = None,
) -> Draw:
    """Return what random errors do to the output of a drive, by exact loops.

    Parameters
    ----------
    drive : Drive
        The drive; its known errors are added to those drawn.
    spreads : sequence of n Tolerance or None
        Tolerances of each joint.
    method : MonteCarlo
        How many, which seed.
    progress : function, optional
        Called with the share done; answering "stop" ends the sampling.

    Returns
    -------
    Draw
    """
    whole = chain(drive)
    limits = np.concatenate(error_arrays(spreads), axis=-1)
    laws = [["normal" if row is None else row.distribution] * 10 for row in spreads]
    seats = np.flatnonzero(limits)
    known = np.concatenate(error_arrays([joint.error for joint in drive.joints]), axis=-1)
    exact = _Exact(whole, one_turn(method.positions), located_shafts(drive), shifts=bool(np.any(limits[:, 5:])))
    centre = transmission_error(drive, exact.phi)
    sums = [_Sums(method.positions, curve) for curve in (centre.error, centre.output_shift)]
    kinds = [law for row in laws for law in row]
    batches = drawn(
        limits.reshape(-1)[seats], [kinds[k] for k in seats], method.samples, seed=method.seed, points=method.points
    )
    lost, cancelled = 0, False
    for k, errors in enumerate(batches):
        lost += _batch(exact, known, seats, errors, sums)
        if progress is not None and progress((k + 1) / BATCHES) == "stop":
            cancelled = k + 1 < BATCHES
            break
    leading = sums[0] if np.any(limits[:, :5]) else sums[1]
    return Draw(
        samples=(sums[0].sample(), sums[1].sample()), convergence=leading.convergence(lost), cancelled=cancelled
    )


class _Exact:
    """Exact output of a chain with errors, at fixed positions."""

    def __init__(self, whole: Chain, phi: Array, held: Sequence[int], *, shifts: bool) -> None:
        self.bend, self.mu, self.phi, self.held, self.shifts = whole.bend, whole.turn_before, phi, held, shifts
        self.start = np.cos(self.mu[:1] + phi), np.sin(self.mu[:1] + phi)
        self.ideal = walk(links(whole.bend, None), self.mu, None, self.start)[0]

    def __call__(self, errors: Array) -> tuple[Array, Array]:
        """Return error of the output angle and shift, arrays (m, p), for errors (m, n, 10)."""
        turned = errors[..., :5]
        carry = ((errors[..., 5:], self.held),) if self.shifts else ()
        direction, carried = walk(links(self.bend, turned), self.mu, turned[..., 0], self.start, carry=carry)
        error = ahead(direction, self.ideal)
        return error, carried[-1][0] if carry else np.zeros_like(error)


def _batch(exact: _Exact, known: Array, seats: Array, errors: Array, sums: Sequence[_Sums]) -> int:
    """Add a batch of errors to the sums, piece by piece; return how many could not be assembled."""
    piece, lost = max(1, _CACHE // len(exact.phi)), 0
    for one in sums:
        one.open(len(errors))
    for first in range(0, len(errors), piece):
        part = errors[first : first + piece]
        table = np.broadcast_to(known, (len(part), *known.shape)).copy()
        table.reshape(len(part), -1)[:, seats] += part
        found = exact(table)
        good = np.isfinite(found[0]).all(axis=-1) & np.isfinite(found[1]).all(axis=-1)
        lost += int(len(good) - good.sum())
        for one, values in zip(sums, found, strict=True):
            one.add(values if good.all() else values[good])
    return lost


class _Sums:
    """Sums over samples of curves (m, p) less a centre (p,), batch by batch."""

    def __init__(self, positions: int, centre: Array) -> None:
        self.centre = centre
        phi = one_turn(positions)
        self.basis = np.stack([np.ones_like(phi), *(2 * f(k * phi) for k in (1, 2) for f in (np.cos, np.sin))], axis=-1)
        self.batches: list[Array] = []
        self.kept: list[Array] = []
        self.curves: list[Array] = []
        self.room = KEPT

    def open(self, expected: int) -> None:
        self.batches.append(np.zeros((3, len(self.centre))))
        self.share = max(1, KEPT // BATCHES)
        self.room = min(expected, self.share)

    def add(self, values: Array) -> None:
        off = values - self.centre
        self.batches[-1] += np.stack((np.full(len(self.centre), len(off)), off.sum(axis=0), (off * off).sum(axis=0)))
        parts = off @ self.basis / len(self.centre)
        change = off.max(axis=-1) - off.min(axis=-1)
        sizes = (np.abs(parts[:, 0]), np.hypot(parts[:, 1], parts[:, 2]), np.hypot(parts[:, 3], parts[:, 4]), change)
        self.curves.append(np.stack(sizes, axis=-1))
        if self.room > 0:
            self.kept.append(values[: self.room])
            self.room -= len(self.kept[-1])

    def _spread(self, rows: Array) -> Array:
        count, one, two = rows
        count = np.where(count > 0.0, count, math.nan)
        return np.sqrt(np.maximum(two - one * one / count, 0.0) / np.maximum(count - 1.0, 1.0))

    def sample(self) -> Sample:
        total = np.sum(self.batches, axis=0)
        kept, curves = np.concatenate(self.kept), np.concatenate(self.curves)
        if not len(kept):  # nothing could be assembled
            kept, curves = np.full((1, kept.shape[-1]), math.nan), np.full((1, 4), math.nan)
        levels = np.quantile(kept, [0.0015, 0.025, 0.975, 0.9985], axis=0)
        sizes = np.quantile(curves, 0.997, axis=0)
        return Sample(
            average=self.centre + total[1] / np.where(total[0] > 0.0, total[0], math.nan),
            deviation=self._spread(total),
            lower=levels[0],
            lower_95=levels[1],
            upper_95=levels[2],
            upper=levels[3],
            **dict(zip(("mean", "first", "second", "peak_to_peak"), map(float, sizes), strict=True)),
        )

    def convergence(self, lost: int) -> Convergence:
        rows = np.asarray(self.batches)
        worst = int(np.argmax(self._spread(rows.sum(axis=0))))
        running = np.cumsum(rows[..., worst], axis=0)
        deviation = self._spread(running.T)
        each = self._spread(rows[..., worst].T)
        scatter = float(np.std(each, ddof=1)) / math.sqrt(len(each)) if len(each) > 1 else math.inf
        error = scatter / float(deviation[-1]) if deviation[-1] != 0.0 else 0.0
        return Convergence(samples=running[:, 0].astype(int), deviation=deviation, standard_error=error, lost=lost)
