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
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Compiled, Method, chosen, share
from cardan.texts import _

from . import places
from .accuracy import (
    WAYS,
    TransmissionError,
    ahead,
    course,
    error_arrays,
    located_shafts,
    one_turn,
    own_kinds,
    sensitivity,
    transmission_error,
    walk,
    walked,
    way_names,
)
from .own_laws import seats

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
    places: Array  # (n, 3) [m, m, rad]: 99.7 % quantiles of the ways of shafts, `places.sizes_of`, by the tolerances


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
    limits = np.concatenate(error_arrays(spreads, drive.joints), axis=-1)
    laws = [law for row in spreads for law in ["normal" if row is None else row.distribution] * limits.shape[-1]]
    drawn_seats = np.flatnonzero(limits)
    known = np.concatenate(error_arrays([joint.error for joint in drive.joints], drive.joints), axis=-1)
    phi = one_turn(method.positions)
    centre = transmission_error(drive, phi)
    sums = (Sums(centre.error), Sums(centre.output_shift))
    exact = Exact(drive, phi, known=known, limits=limits, centre=centre, samples=method.samples, method=method.compute)
    batches = drawn(
        limits.reshape(-1)[drawn_seats],
        [laws[k] for k in drawn_seats],
        method.samples,
        seed=method.seed,
        points=method.points,
    )
    lost, cancelled = 0, False
    for k, errors in enumerate(batches):
        lost += exact.add(errors, sums)
        if progress is not None and progress((k + 1) / BATCHES) == "stop":
            cancelled = k + 1 < BATCHES
            break
    leading = sums[0] if np.any(limits[:, : -len(WAYS)]) else sums[1]
    return Draw(
        samples=(_sample(sums[0]), _sample(sums[1])),
        convergence=_settled(leading, lost),
        cancelled=cancelled,
        places=exact.places(),
    )


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


# What many samples of a drive's errors come to: sums over them, taken piece by piece and never all held.

compiled = later("cardan.maths.compiled.samples")

BATCHES = 8
"""Independent draws whose scatter tells how far a result is to be trusted."""

LANES = 8
"""Samples that a kernel takes at a time."""

KEPT = 65_536
"""Samples whose values at every position are kept for quantiles."""

STANDING = 8192
"""Samples of which it is looked at where the shafts lie."""

LARGE = 10_000_000
"""Positions of samples that are worth loading the kernel: half a second in a new process, two when first compiled."""

REACH = 0.35
"""Largest error [rad] that the kernel's short arctangent takes, with room left for what is not linear."""

TAIL = 2.2
"""Multiple of its tolerance that no normal error exceeds: 6.6 standard deviations."""

_CACHE = 16_000
_THREAD = 100_000


class Sums:
    """Sums over samples of curves less a centre (p,), batch by batch."""

    def __init__(self, centre: Array) -> None:
        self.centre = centre
        self.batches: list[Array] = []
        self.kept: list[Array] = []
        self.sizes: list[Array] = []
        self.room = 0

    def open(self, expected: int) -> int:
        """Begin a batch; return of how many samples the values are to be kept."""
        self.batches.append(np.zeros((3, len(self.centre))))
        self.room = min(expected, KEPT // BATCHES)
        return self.room

    def add(self, values: Array) -> None:
        """Add samples (m, p)."""
        off = values - self.centre
        parts = course(off)
        sizes = np.stack((np.abs(parts.mean), parts.first, parts.second, parts.peak_to_peak))
        self.add_sums(len(off), np.stack((off.sum(axis=0), (off * off).sum(axis=0))), sizes, off[: self.room].T)

    def add_sums(self, count: int, sums: Array, sizes: Array, kept: Array) -> None:
        """Add sums (2, p) of so many samples less the centre and of their squares, their sizes (4, m), some values."""
        self.batches[-1] += np.concatenate((np.full((1, len(self.centre)), float(count)), sums))
        self.sizes.append(sizes)
        self.kept.append(kept)
        self.room -= kept.shape[-1]

    def levels(self, shares: Sequence[float]) -> Array:
        """Return quantiles at every position, array (len(shares), p)."""
        kept = np.concatenate(self.kept, axis=-1)
        found = np.full((len(shares), len(self.centre)), math.nan)
        if not kept.shape[-1]:  # nothing could be assembled
            return found

        def work(first: int, last: int) -> None:
            found[:, first:last] = np.quantile(kept[first:last], shares, axis=-1)

        share(work, len(kept), least=max(1, _THREAD // kept.shape[-1]))
        return found + self.centre

    def all_sizes(self) -> Array:
        """Return sizes of mean, first and second order, and change, of every sample; array (4, m)."""
        sizes = np.concatenate(self.sizes, axis=-1)
        return sizes if sizes.shape[-1] else np.full((4, 1), math.nan)


def spread(rows: Array) -> Array:
    """Return standard deviations from counts, sums and sums of squares, array (3, ...).

    >>> float(spread(np.asarray([4.0, 0.0, 12.0])))
    2.0
    """
    count, one, two = rows
    count = np.where(count > 0.0, count, math.nan)
    found: Array = np.sqrt(np.maximum(two - one * one / count, 0.0) / np.maximum(count - 1.0, 1.0))
    return found


class Exact:
    """Exact output of a drive with errors, at fixed positions.

    phi (p,) [rad]: input angles.
    known, limits (n, c): known errors, and tolerances, those that turn before those that shift.
    """

    def __init__(
        self,
        drive: Drive,
        phi: Array,
        *,
        known: Array,
        limits: Array,
        centre: TransmissionError,
        samples: int,
        method: Method | None = None,
    ) -> None:
        self.whole, self.own, self.held = walked(drive), own_kinds(drive), located_shafts(drive)
        self.mu = self.whole.turn_before
        self.known, self.seats = known, np.flatnonzero(limits)
        self.shifts = bool(np.any(limits[:, -len(WAYS) :]) or np.any(known[:, -len(WAYS) :]))
        self.drive, self.phi = drive, phi
        self.turning = seats(drive.joints)
        self.names = [(*one, *ways) for one, ways in zip(self.turning, way_names(drive.joints), strict=True)]
        self.moves = bool(places.of_errors(drive, self.names, limits))
        self.standing: list[Array] = []
        self.start = np.cos(self.mu[:1] + phi), np.sin(self.mu[:1] + phi)
        self.ideal = walk(self.whole, None, self.start, own=self.own)[0]
        reach = np.sum(np.abs(sensitivity(drive, phi)) * limits[:, : -len(WAYS)], axis=(-2, -1))
        mild = bool(np.max(np.abs(centre.error) + reach * TAIL) < REACH) and not self.shifts and not any(self.own)
        self.method = chosen(method, np, samples * len(phi) >= LARGE and mild) if mild else None

    def add(self, errors: Array, sums: tuple[Sums, Sums]) -> int:
        """Add a batch of errors (m, d) to the sums; return how many samples could not be assembled."""
        rooms = [one.open(len(errors)) for one in sums]
        if isinstance(self.method, Compiled) and self._compiled(errors, sums, rooms[0], self.method):
            return 0
        piece, lost = max(1, _CACHE // len(self.start[0])), 0
        for first in range(0, len(errors), piece):
            part = errors[first : first + piece]
            table = np.broadcast_to(self.known, (len(part), *self.known.shape)).copy()
            table.reshape(len(part), -1)[:, self.seats] += part
            found = self(table)
            self._stand(table)
            good = np.isfinite(found[0]).all(axis=-1) & np.isfinite(found[1]).all(axis=-1)
            lost += int(len(good) - good.sum())
            for one, values in zip(sums, found, strict=True):
                one.add(values if good.all() else values[good])
        return lost

    def __call__(self, errors: Array) -> tuple[Array, Array]:
        """Return error of the output angle and shift, arrays (m, p), for errors (m, n, c)."""
        turned, shifted = errors[..., : -len(WAYS)], errors[..., -len(WAYS) :]
        carry = ((shifted, self.held),) if self.shifts else ()
        direction, carried = walk(self.whole, turned, self.start, own=self.own, carry=carry)
        error = ahead(direction, self.ideal)
        if off := places.of_errors(self.drive, self.turning, turned):
            error = error + places.moved(self.drive, self.phi, off).angle
        return error, carried[-1][0] if carry else np.zeros_like(error)

    def _stand(self, errors: Array) -> None:
        """Keep how far shafts lie off by errors (m, n, c) beside the known ones, of the first samples."""
        room = STANDING - sum(map(len, self.standing))
        if self.moves and room > 0:
            off = places.of_errors(self.drive, self.names, np.concatenate((self.known[None], errors[:room])))
            ways = places.moved(self.drive, self.phi, off).ways
            self.standing.append(places.sizes_of(ways[1:] - ways[:1]))

    def places(self) -> Array:
        """Return the 99.7 % quantiles of the ways of shafts, array (n, 3)."""
        if not self.standing:
            return np.zeros((self.whole.joints, 3))
        return np.asarray(np.quantile(np.concatenate(self.standing), 0.997, axis=0))

    def _compiled(self, errors: Array, sums: tuple[Sums, Sums], room: int, method: Compiled) -> bool:
        """Add a batch by the kernel; false, and nothing added, where a joint cannot be assembled."""
        count, positions, joints = len(errors), len(self.start[0]), self.whole.joints
        phi = one_turn(positions)
        shared = (*self.start, *self.ideal, sums[0].centre, np.cos(phi), np.sin(phi), np.cos(2 * phi), np.sin(2 * phi))
        table = np.stack(shared, axis=-1).reshape(-1)
        slot = np.full(5 * joints, -1)
        joint, seat = np.divmod(self.seats, 10)
        slot[5 * joint + seat] = np.arange(len(self.seats))
        numbers = (
            np.ascontiguousarray(errors.T).reshape(-1),
            np.ascontiguousarray(self.known[:, :5]).reshape(-1),
            slot,
            np.stack((np.cos(self.whole.joint_angle), np.sin(self.whole.joint_angle)), axis=-1).reshape(-1),
            np.stack((np.cos(self.mu[1:]), np.sin(self.mu[1:])), axis=-1).reshape(-1),
            table,
        )
        kept, sizes = np.empty((positions, room)), np.empty((4, count))
        pieces: list[Array] = []

        def work(first: int, last: int) -> None:
            piece = np.zeros(2 * positions * LANES)
            compiled().kernel(*numbers, count, room, first, last, piece, sizes.reshape(-1), kept.reshape(-1))
            pieces.append(piece)

        share(work, count // LANES, threads=method.threads, least=max(1, _THREAD // (positions * LANES)))
        total = np.sum(pieces, axis=0).reshape(positions, 2, LANES).sum(axis=-1).T
        if not np.all(np.isfinite(total)):
            return False
        sums[0].add_sums(count, total, sizes, kept)
        sums[1].add(np.zeros((1, positions)) + sums[1].centre)
        return True
