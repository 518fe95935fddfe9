"""Errors drawn at random from their tolerances, and the exact loops they make."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.drive.accuracy import Tolerance
from cardan.drive.drive import Drive
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Method
from cardan.maths.compiled.threads import share
from cardan.texts import _

from .accuracy import error_arrays, one_turn, transmission_error
from .sample_sums import BATCHES, LANES, Exact, Sums, spread

SIGMA = {"normal": 1.0 / 3.0, "uniform": 1.0 / math.sqrt(3.0), "triangular": 1.0 / math.sqrt(6.0)}
"""Standard deviation of each distribution, as a share of the tolerance."""

_PIECE = 16_384
"""Errors of one kind that are worth a thread."""


@dataclass(frozen=True, kw_only=True, slots=True)
class MonteCarlo:
    """Exact loops with errors drawn from their distributions.

    Parameters
    ----------
    samples : int
        Drives to draw, rounded up to eights in each of eight batches, for Sobol' points to powers of two.
    seed : int
        The same seed draws the same drives.
    points : str
        "sobol" (scrambled, evenly spread) or "random".
    positions : int
        Positions of a turn.
    compute : Plain or Compiled, optional
        Compiled by default for large jobs without tolerances of lengths, where numba is installed.
    """

    samples: int = 65_536
    seed: int = 1
    points: str = "sobol"
    positions: int = 72
    compute: Method | None = None

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
    """What the draws came to, over one turn; [rad] for angles, [m] for shifts."""

    average: Array  # average, deviation (p,): mean and standard deviation at each position
    deviation: Array  # (p,)
    lower: Array  # lower, upper (p,): 0.15 % and 99.85 % quantiles
    upper: Array  # (p,)
    lower_95: Array  # lower_95, upper_95 (p,): 2.5 % and 97.5 % quantiles
    upper_95: Array  # (p,)
    # mean, first, second, peak_to_peak: 99.7 % quantiles of the sizes of mean and first two orders over a turn, and of
    # the change over it, each less what the known errors make
    mean: float
    first: float
    second: float
    peak_to_peak: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Convergence:
    """How a result settles as samples are added."""

    samples: Array  # (b,) of int: samples after each batch
    # (b,) [rad]: standard deviation of the output angle at its worst position, from the samples so far; of the shift
    # [m] where no tolerance of an angle is given
    deviation: Array
    standard_error: float  # standard error of the last of them, as a share, from the scatter of the batches
    lost: int  # samples that could not be assembled at some position; they are left out


@dataclass(frozen=True, eq=False, kw_only=True)
class Draw:
    """Samples of output angle and shift, and how far they are to be trusted."""

    samples: tuple[Sample, Sample]
    convergence: Convergence
    cancelled: bool


def drawn(limits: Array, distributions: Sequence[str], count: int, *, seed: int, points: str) -> Iterator[Array]:
    """Yield independent batches of errors.

    limits (d,); distributions: "normal" with σ a third of the tolerance, "uniform" or "triangular" within it.
    count: samples in all batches together; points: "sobol" or "random".
    Yields (m, d).

    >>> first = next(drawn(np.asarray([1.0]), ["uniform"], 1024, seed=1, points="sobol"))
    >>> first.shape, bool(abs(first.mean()) < 0.01)
    ((128, 1), True)
    """
    each = LANES * -(-count // (BATCHES * LANES))
    for child in np.random.SeedSequence(seed).spawn(BATCHES):
        rng = np.random.default_rng(child)
        if points == "sobol":
            shares = scipy.stats.qmc.Sobol(len(limits), rng=rng).random_base2(math.ceil(math.log2(each)))
        else:
            shares = rng.random((each, len(limits)))
        yield _errors(shares, limits, distributions)


def _errors(shares: Array, limits: Array, distributions: Sequence[str]) -> Array:
    """Return errors (m, d) at given shares of their distributions, each error beside itself in memory."""
    found = np.empty(shares.shape[::-1])

    def work(first: int, last: int) -> None:
        part = slice(first, last)
        for row, column, limit, kind in zip(found, shares.T, limits, distributions, strict=True):
            row[part] = limit * _from_share(column[part], kind)

    share(work, len(shares), least=_PIECE)
    return found.T


def _from_share(share: Array, kind: str) -> Array:
    """Return the quantiles at given shares of a distribution on (-1, 1); the normal one has three σ there."""
    if kind == "uniform":
        return 2.0 * share - 1.0
    if kind == "triangular":
        return np.where(share < 0.5, np.sqrt(2.0 * share) - 1.0, 1.0 - np.sqrt(2.0 * (1.0 - share)))
    least = 2.0**-54  # scrambled points can touch zero
    found: Array = SIGMA["normal"] * scipy.special.ndtri(np.clip(share, least, 1.0 - least))
    return found


def sampled(
    drive: Drive,
    spreads: Sequence[Tolerance | None],
    method: MonteCarlo,
    *,
    progress: Callable[[float], object] | None = None,
) -> Draw:
    """Return what random errors do to the output of a drive, by exact loops.

    drive: the drive; its known errors are added to those drawn.
    spreads: tolerances of each joint; method: how many, which seed.
    """
    limits = np.concatenate(error_arrays(spreads), axis=-1)
    laws = [law for row in spreads for law in ["normal" if row is None else row.distribution] * 10]
    seats = np.flatnonzero(limits)
    known = np.concatenate(error_arrays([joint.error for joint in drive.joints]), axis=-1)
    phi = one_turn(method.positions)
    centre = transmission_error(drive, phi)
    sums = (Sums(centre.error), Sums(centre.output_shift))
    exact = Exact(drive, phi, known=known, limits=limits, centre=centre, samples=method.samples, method=method.compute)
    batches = drawn(
        limits.reshape(-1)[seats], [laws[k] for k in seats], method.samples, seed=method.seed, points=method.points
    )
    lost, cancelled = 0, False
    for k, errors in enumerate(batches):
        lost += exact.add(errors, sums)
        if progress is not None and progress((k + 1) / BATCHES) == "stop":
            cancelled = k + 1 < BATCHES
            break
    leading = sums[0] if np.any(limits[:, :5]) else sums[1]
    return Draw(samples=(_sample(sums[0]), _sample(sums[1])), convergence=_settled(leading, lost), cancelled=cancelled)


def _sample(sums: Sums) -> Sample:
    total = np.sum(sums.batches, axis=0)
    levels, sizes = sums.levels([0.0015, 0.025, 0.975, 0.9985]), np.quantile(sums.all_sizes(), 0.997, axis=-1)
    return Sample(
        average=sums.centre + total[1] / np.where(total[0] > 0.0, total[0], math.nan),
        deviation=spread(total),
        lower=levels[0],
        lower_95=levels[1],
        upper_95=levels[2],
        upper=levels[3],
        **dict(zip(("mean", "first", "second", "peak_to_peak"), map(float, sizes), strict=True)),
    )


def _settled(sums: Sums, lost: int) -> Convergence:
    rows = np.asarray(sums.batches)
    worst = int(np.argmax(spread(rows.sum(axis=0))))
    running = np.cumsum(rows[..., worst], axis=0)
    deviation = spread(running.T)
    scatter = math.inf
    if len(rows) > 1:
        scatter = float(np.std(spread(rows[..., worst].T), ddof=1)) / math.sqrt(len(rows))
    error = scatter / float(deviation[-1]) if deviation[-1] != 0.0 else 0.0
    return Convergence(samples=running[:, 0].astype(int), deviation=deviation, standard_error=error, lost=lost)
