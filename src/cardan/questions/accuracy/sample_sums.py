"""What many samples of a drive's errors come to: sums over them, taken piece by piece and never all held."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.chain import chain
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Compiled, Method, chosen
from cardan.maths.compiled.threads import share

from .accuracy import TransmissionError, ahead, course, links, located_shafts, one_turn, sensitivity, walk

compiled = later("cardan.maths.compiled.samples")

BATCHES = 8
"""Independent draws whose scatter tells how far a result is to be trusted."""

LANES = 8
"""Samples that a kernel takes at a time."""

KEPT = 65_536
"""Samples whose values at every position are kept for quantiles."""

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
    known, limits (n, 10): known errors, and tolerances, those that turn before those that shift.
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
        whole = chain(drive)
        self.joint_angle, self.mu, self.held = whole.joint_angle, whole.turn_before, located_shafts(drive)
        self.known, self.seats = known, np.flatnonzero(limits)
        self.shifts = bool(np.any(limits[:, 5:]) or np.any(known[:, 5:]))
        self.start = np.cos(self.mu[:1] + phi), np.sin(self.mu[:1] + phi)
        self.ideal = walk(links(whole.joint_angle, None), self.mu, None, self.start)[0]
        most = np.abs(centre.error) + np.sum(np.abs(sensitivity(drive, phi)) * limits[:, :5], axis=(-2, -1)) * TAIL
        mild = bool(np.max(most) < REACH) and not self.shifts
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
            good = np.isfinite(found[0]).all(axis=-1) & np.isfinite(found[1]).all(axis=-1)
            lost += int(len(good) - good.sum())
            for one, values in zip(sums, found, strict=True):
                one.add(values if good.all() else values[good])
        return lost

    def __call__(self, errors: Array) -> tuple[Array, Array]:
        """Return error of the output angle and shift, arrays (m, p), for errors (m, n, 10)."""
        turned = errors[..., :5]
        carry = ((errors[..., 5:], self.held),) if self.shifts else ()
        direction, carried = walk(links(self.joint_angle, turned), self.mu, turned[..., 0], self.start, carry=carry)
        error = ahead(direction, self.ideal)
        return error, carried[-1][0] if carry else np.zeros_like(error)

    def _compiled(self, errors: Array, sums: tuple[Sums, Sums], room: int, method: Compiled) -> bool:
        """Add a batch by the kernel; false, and nothing added, where a joint cannot be assembled."""
        count, positions, joints = len(errors), len(self.start[0]), len(self.joint_angle)
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
            np.stack((np.cos(self.joint_angle), np.sin(self.joint_angle)), axis=-1).reshape(-1),
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
