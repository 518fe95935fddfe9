"""At which speeds is steady running stable? Followed to the edges and proved between them, not sampled."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import Compiled, Method
from cardan.maths.compiled.method import chosen as chosen_method
from cardan.maths.periodic.floquet import monodromy
from cardan.maths.periodic.harmonics import HarmonicBalance, Status
from cardan.maths.periodic.inside_circle import DEGREE, MATRICES, Proof, inside_circle
from cardan.questions.torsion.model.torsional_layouts import Turning, leading, period_of
from cardan.questions.torsion.model.torsional_layouts import chosen as some_of
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import base_order
from cardan.questions.torsion.steady.orbit import straight_frequencies, straight_stiffness
from cardan.questions.torsion.steady.run_stability import (
    Floquet,
    Verdict,
    Zone,
    drifting,
    linear_motion,
    nearest_zone,
    straight_damping,
    vibrating,
)
from cardan.questions.torsion.steady.several import LOOKED, middle_ones, settled_judgement
from cardan.questions.torsion.steady.steady import closed, stays_closed, steady_orbits
from cardan.texts import _

from .floquet_map import NO_SEARCH, floquet_map
from .stability_kernel import SURE, Mapped, fits, harmonics_for, heavy_of, mapped

Build: TypeAlias = Callable[[Array], TorsionalModel]
"""From speeds (n,) [rad/s] to a drive at each of them, with one leading axis or none."""

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

SMALL, MORE = 1e-6, 2.2
"""Largest of the upper harmonics, over the largest of all, of a motion that is fine enough, and times the harmonics
with which others are sought again."""

WIDTH = 5e-8
"""Share of the speed to which edges are found."""

PHASE, FADED = 5.0, 12.0
"""Phase of the fastest oscillation that a polynomial in the speed is to hold, to begin with; what has died out by e to
the second power within a period does not count."""

WORK, PLAIN, LEAST, BALANCE = 1e8, 20.0, 500.0, 6e-3
"""Steps of all samples times the cube of their unknowns that are taken on: a minute, about; by what factor each takes
longer without the kernel, what each takes at least, and what its harmonic balance takes over the cube of its sums."""

SLACK = 1e-4
"""Growth within a period that counts as none where nothing damps: in zone m that of one of the width 2 Ω/(πm) times it.
"""

INNER = 9
"""Places within an unstable range at which growth is looked at."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ProvedSpeeds:
    """Ranges of speed in which steady running is unstable; in the rest of what was looked at it is proved not to be.

    Speeds count as positive, also those of a drive that turns backwards.
    """

    # lowest, highest (k,) [rad/s]: ends of each range; those at an end of what was looked at are no edges
    lowest: Array
    highest: Array  # (k,) [rad/s]
    worst: Array  # (k,) [rad/s]: speed of the fastest growth in each
    growth_rate: Array  # (k,) [1/s]
    kind: Array  # (k,) of int: `cardan.questions.torsion.steady.run_stability.Kind` there
    zone: Zone  # (k,)
    unproved: Array  # (j, 2) [rad/s]: stretches of which nothing was shown
    open: Array  # (i, 2) [rad/s]: those among them without a smooth steady motion: open backlash, jumps
    unsettled: Array  # (i, 2) [rad/s]: those among them that would take more work than is taken on
    looked: tuple[float, float]  # [rad/s]: from where to where
    samples: int  # monodromy matrices taken
    # whether nothing damps the drive, so that nothing decays: zones are then found down to a width, see `SLACK`
    neutral: bool = False
    cancelled: bool = False  # whether the work was stopped

    @property
    def proved(self) -> bool:
        """Whether every speed is shown to be stable or unstable, but for the edges between."""
        return not len(self.unproved) and not self.neutral

    @property
    def hidden(self) -> float:
        """Width of the widest zone that could hide outside the ranges told [rad/s]; 0 where all is proved."""
        least = 2.0 * SLACK / np.pi * self.looked[1] if self.neutral else 0.0
        return float(np.max(self.unproved[:, 1] - self.unproved[:, 0], initial=least))

    @property
    def looked_at(self) -> bool:
        """Whether a proof was tried; not where it takes too long."""
        return self.samples > 0

    @property
    def stable(self) -> bool:
        """Whether steady running is proved to be stable throughout."""
        return self.proved and not len(self.lowest)

    def shown(self, speed: Array) -> Array:
        """Tell of speeds (n,) [rad/s] whether it is proved what they are."""
        inside = (self.unproved[:, 0] <= np.abs(speed)[:, None]) & (np.abs(speed)[:, None] <= self.unproved[:, 1])
        found: Array = ~np.any(inside, axis=-1)
        return found

    def overlapping(self, low: float, high: float) -> Array:
        """Return the unstable ranges that overlap some speeds [rad/s], those that grow fastest first, array of int."""
        found = np.flatnonzero((self.lowest <= high) & (low <= self.highest))
        return found[np.argsort(-self.growth_rate[found], kind="stable")]

    def judged_at(self, found: Floquet, speed: Array) -> ProvedSpeeds:
        """Return the same with some speeds (n,) [rad/s] judged by themselves, found (n,): rising.

        What is unstable at one or at several in a row is a range from the first of them to the last.
        """
        known = found.verdict != Verdict.UNKNOWN
        inside = np.any((self.lowest <= speed[:, None]) & (speed[:, None] <= self.highest), axis=-1)
        grows = (found.verdict == Verdict.UNSTABLE) & ~inside
        runs = [one for one in np.split(np.arange(len(speed)), np.flatnonzero(np.diff(grows)) + 1) if grows[one[0]]]
        first, last = (np.asarray([one[end] for one in runs], dtype=int) for end in (0, -1))
        most = np.asarray([one[np.argmax(found.growth_rate[one])] for one in runs], dtype=int)
        order = np.argsort(np.concatenate([self.lowest, speed[first]]), kind="stable")

        def joined(own: Array, others: Array) -> Array:
            whole: Array = np.concatenate([own, others])[order]
            return whole

        unproved = np.asarray([pair for one in self.unproved for pair in _cut(one, speed[known])]).reshape(-1, 2)
        names = [one.name for one in fields(Zone)]
        zones = {name: joined(getattr(self.zone, name), getattr(found.zone, name)[most]) for name in names}
        return replace(
            self,
            lowest=joined(self.lowest, speed[first]),
            highest=joined(self.highest, speed[last]),
            worst=joined(self.worst, speed[most]),
            growth_rate=joined(self.growth_rate, found.growth_rate[most]),
            kind=joined(self.kind, found.kind[most]),
            zone=Zone(**zones),
            unproved=unproved,
            samples=self.samples + int(known.sum()),
        )

    def margin(self, speed: float) -> float:
        """Return how far a speed is from the nearest unstable range [rad/s]: negative inside, nan where none is."""
        if not len(self.lowest):
            return float("nan")
        return float(np.min(np.maximum(self.lowest - abs(speed), abs(speed) - self.highest)))


def _cut(stretch: Array, speed: Array) -> Array:
    """Return a stretch (2,) in parts that end at the speeds (n,) within it, array (k, 2)."""
    inside = speed[(stretch[0] < speed) & (speed < stretch[1])]
    cuts = np.unique([stretch[0], *inside, stretch[1]])
    return np.stack([cuts[:-1], cuts[1:]], axis=-1)


def proved_speeds(
    build: Build | TorsionalModel,
    lowest: float,
    highest: float,
    *,
    breaks: Array | tuple[float, ...] = (),
    work: float = WORK,
    method: Method | None = None,
    progress: Progress | None = None,
) -> ProvedSpeeds:
    """Return the ranges of speed in which steady running of a drive is unstable, proved to be all of them.

    build: the drive at speeds, or one that is alike at all; its own input speed does not count.
    lowest, highest [rad/s]: where to look; both negative for a drive that turns backwards.
    breaks (k,) [rad/s]: speeds at which the drive jumps.
    work: how much is taken on, see `WORK`. What takes more from the beginning is not looked at and unproved as a whole;
    where motions change so wildly with the speed that more is needed on the way, the rest is left unsettled.
    The monodromy matrix about the steady motion as a polynomial of the speed, and a norm in which it is below 1: see
    `cardan.maths.periodic.inside_circle`. Its coordinates are those of the energy of the straight drive, in which
    vibration turns without growing. Of a drive that no torque governs the drift of the mean speed is left out.
    """
    check(_problems(build, lowest, highest))
    drive = _Drive(build, 0.5 * (lowest + highest), method)
    first = max(4, round(abs(1.0 / lowest - 1.0 / highest) * drive.period * drive.fastest / PHASE))
    sense = 1.0 if lowest > 0.0 else -1.0
    near, far = sorted((abs(lowest), abs(highest)))
    most = int(work / drive.work(near, far))
    if (DEGREE + 1) * first > most:
        whole, nothing = np.asarray([[near, far]]), np.zeros((0, 2))
        proof = Proof(outside=nothing, unproved=whole, unsampled=nothing, unfinished=nothing, samples=0)
        return _described(drive, proof, (near, far), sense)
    proof = inside_circle(
        lambda speeds: drive.at(sense * speeds),
        near,
        far,
        largest=drive.largest,
        one_apart=drive.drifts,
        breaks=np.abs(np.asarray(breaks, dtype=float)),
        first=first,
        width=WIDTH,
        slack=SLACK if drive.neutral else 0.0,
        most=min(most, MATRICES),
        progress=None if progress is None else (lambda share: progress(0.9 * share)),
    )
    return _described(drive, proof, (near, far), sense)


def _described(drive: _Drive, proof: Proof, looked: tuple[float, float], sense: float) -> ProvedSpeeds:
    """Return what is unstable with where it grows fastest, and near which zone."""
    inner, found = _inside(drive, proof.outside, sense)
    if found is not None:  # ranges in which only the middle one of three motions grows are left unproved
        grows = np.any(found.verdict.reshape(inner.shape) == Verdict.UNSTABLE, axis=-1)
        jumps = proof.outside[~grows]
        if len(jumps):
            proof = replace(
                proof,
                outside=proof.outside[grows],
                unproved=_joined(proof.unproved, jumps),
                unsampled=_joined(proof.unsampled, jumps),
            )
            inner, found = _inside(drive, proof.outside, sense)
    low, high = proof.outside.T
    growth = np.zeros(inner.shape) if found is None else _growth(found, inner)
    best = np.argmax(growth, axis=-1)[:, None]
    kind = np.zeros(inner.shape, dtype=int) if found is None else found.kind.reshape(inner.shape)
    worst = np.take_along_axis(inner, best, axis=-1)[:, 0]
    kinds = np.take_along_axis(kind, best, axis=-1)[:, 0]
    return ProvedSpeeds(
        lowest=low,
        highest=high,
        worst=worst,
        growth_rate=np.take_along_axis(growth, best, axis=-1)[:, 0],
        kind=kinds,
        zone=nearest_zone(np.repeat(drive.frequencies, len(worst), axis=0), worst, kinds, drive.base),
        unproved=proof.unproved,
        open=proof.unsampled,
        unsettled=proof.unfinished,
        looked=looked,
        samples=proof.samples,
        neutral=drive.neutral,
        cancelled=proof.stopped,
    )


def _inside(drive: _Drive, ranges: Array, sense: float) -> tuple[Array, Floquet | None]:
    """Return places within ranges of speed (k, 2) and how stable running is there, None where there is no range.

    Where a motion that grows may be the middle one of three, a stable one is sought beside it: at the place of a range
    that grows fastest, and at the next one as long as one is found, `LOOKED` in all.
    """
    low, high = ranges.T
    inner = low[:, None] + (high - low)[:, None] * (np.arange(INNER) + 0.5) / INNER
    flat = sense * inner.reshape(-1)
    if not len(flat):
        return inner, None
    mapped = floquet_map(drive.model(flat), speed=flat, opened=NO_SEARCH)
    found, middle = mapped.floquet, middle_ones(mapped.orbit, mapped.floquet)
    looked = 0
    while True:
        rows = np.arange(len(inner)) * INNER + np.argmax(_growth(found, inner), axis=-1)
        asked = rows[middle[rows]]
        looked += asked.size
        if not asked.size or looked > LOOKED:
            return inner, found
        middle[asked] = False
        found = settled_judgement(mapped.orbit, mapped.status, found, asked)


def _growth(found: Floquet, inner: Array) -> Array:
    """Return how fast vibration grows at places within ranges, array (k, m) [1/s]; least where nothing is known."""
    growth: Array = np.nan_to_num(found.growth_rate, nan=-np.inf).reshape(inner.shape)
    return growth


def _joined(stretches: Array, others: Array) -> Array:
    """Return stretches (k, 2) with others, in order, those that meet as one."""
    found: list[list[float]] = []
    for low, high in sorted(np.concatenate([stretches, others]).tolist()):
        if found and low <= found[-1][1]:
            found[-1][1] = max(found[-1][1], high)
        else:
            found.append([low, high])
    return np.asarray(found).reshape(-1, 2)


def _problems(build: Build | TorsionalModel, lowest: float, highest: float) -> list[Problem]:
    found = []
    if lowest == 0.0 or lowest * highest < 0.0:
        found.append(Problem("lowest", _("{value:.6g} given; more than 0 is needed").format(value=lowest)))
    if not highest > lowest:
        found.append(Problem("highest", _("{value:.6g} given; more than the lowest is needed").format(value=highest)))
    if isinstance(build, TorsionalModel) and leading(replace(build, input_speed=None)) != ():
        found.append(Problem("model", _("many drives given; one is needed")))
    return found


class _Drive:
    """Monodromy matrices of a drive by its speed, in coordinates of its energy, without its shift in time."""

    def __init__(self, build: Build | TorsionalModel, middle: float, method: Method | None) -> None:
        self.build, self.middle = build, middle
        here = np.asarray([middle])
        model = self.model(here)
        one = some_of(replace(model, input_speed=None if model.free else here), (1,), np.zeros(1, dtype=int))
        self.free, self.period = model.free, period_of(model)
        self.harmonics, self.base = harmonics_for(model, self.period), base_order(model)
        self.rough = False  # whether all motions seen last take more harmonics
        self.heavy = heavy_of(one)
        how = chosen_method(method, np, large=True)
        shut = replace(one, backlash=np.zeros_like(one.backlash))
        self.kernel = how if isinstance(how, Compiled) and fits(shut, here) else None
        self.frequencies = straight_frequencies(one)[:, 1 if self.free else 0 :]
        self.fastest, self.steepest = self._fastest(one, middle)
        self.neutral = not np.any(straight_damping(one, here))
        self.inertia = float(np.sum(one.inertia[0]))
        self.drifts = self.free and bool(np.all(drifting(one, here)))
        first = 0 if self.free else 1
        mass = np.zeros(one.coordinates)
        np.add.at(mass, list(one.coordinate), one.inertia[0])
        mass = mass[first:]
        stiff = straight_stiffness(one)[0, first:, first:] + middle**2 * np.diag(mass)
        size = len(mass)
        energy = np.zeros((size + int(self.heavy.sum()),) * 2)
        energy[:size, :size] = np.linalg.cholesky(stiff).T
        energy[size:, size:] = np.diag(np.sqrt(mass[self.heavy]))
        self.energy, self.back = energy, np.linalg.inv(energy)
        even = energy[:, :size].sum(axis=-1)  # the rates in the tangent of even turning
        self.even = even / np.linalg.norm(even)
        self.rest = np.linalg.qr(np.column_stack([self.even, np.eye(len(even))]))[0][:, 1:]

    def model(self, speeds: Array) -> TorsionalModel:
        """Return the drive at speeds, its speed forced where it is not free."""
        model = self.build if isinstance(self.build, TorsionalModel) else self.build(speeds)
        return model if model.free else replace(model, input_speed=speeds)

    def _fastest(self, one: TorsionalModel, middle: float) -> tuple[float, float]:
        """Return the fastest mode that does not die out within a period, and the fastest of all [rad/s]."""
        first = 0 if self.free else 1
        mass = np.zeros(one.coordinates)
        np.add.at(mass, list(one.coordinate), one.inertia[0])
        mass = np.where(mass > 0.0, mass, np.inf)[first:]
        root = 1.0 / np.sqrt(mass)
        stiffness = straight_stiffness(one)[0, first:, first:]
        light = ~self.heavy
        if light.any():
            across = stiffness[:, light]
            stiffness = stiffness - across @ np.linalg.solve(stiffness[light][:, light], across.T)
        square, shape = np.linalg.eigh(root[:, None] * stiffness * root)
        shape = root[:, None] * shape
        decay = 0.5 * np.sum(shape * (straight_damping(one, np.asarray([middle]))[0, 0] @ shape), axis=0)
        omega = np.sqrt(np.maximum(square, 0.0))
        lasting = decay * self.period / abs(middle) < FADED
        return float(np.max(omega[lasting], initial=0.0)), float(np.max(omega, initial=0.0))

    def work(self, near: float, far: float) -> float:
        """Return what a matrix between two speeds takes, about; see `WORK`."""
        samples = np.linspace(near, far, 9)
        steps = np.maximum(self.steepest * self.period / samples / 2.0, 16.0)
        rank, sense = len(self.heavy), np.sign(self.middle)
        each = LEAST + float(np.mean(np.minimum(steps, 2048.0))) * 0.125 * rank**3
        if self.kernel is None:
            return PLAIN * each
        found = mapped(closed(self._turning(sense * samples)), self.harmonics, moves_only=True)
        self.rough = bool(self._coarse(found).all())
        wide = 2.0 * self.harmonics * (MORE if self.rough else 1.0) + 1.0
        return each + BALANCE * wide**3 * (rank + rank**3 / 6.0)

    def at(self, places: Array) -> tuple[Array, Array, Array]:
        """Return the matrices at speeds (n, p), whether there is a smooth motion to have one, and its torque.

        The torque (n, p) is that which keeps the mean speed, counted with the turning.
        """
        speeds = places.reshape(-1)
        whole = self._turning(speeds)
        smooth = closed(whole)
        if self.kernel is not None:
            matrix, coefficient, force, there = self._compiled(smooth, places.shape[-1], self.kernel.threads)
        else:
            how = HarmonicBalance(most=96)
            orbit, status = steady_orbits(smooth.model, speed=speeds, method=how, opened=NO_SEARCH)
            there = status == Status.CONVERGED
            coefficient, force = orbit.coefficient[:, smooth.first :], orbit.force
            rows = np.flatnonzero(there)
            size = len(self.energy)
            matrix = np.full((len(speeds), size, size), np.nan)
            if rows.size:
                matrix[rows] = monodromy(linear_motion(orbit, rows), orbit.time[rows])
        there = there & stays_closed(whole, coefficient)
        matrix = np.where(there[:, None, None], matrix, 0.0)
        found = self._reduced(self.energy @ matrix @ self.back, coefficient, whole)
        if whole.model.rubs and not self.drifts:  # as of `run_stability.floquet`: what grows without friction
            there = there & (np.max(np.abs(np.linalg.eigvals(found)), axis=-1, initial=0.0) <= 1.0)
        force = np.where(there, force * np.sign(speeds), 0.0)
        return found.reshape(*places.shape, *found.shape[1:]), *(one.reshape(places.shape) for one in (there, force))

    def _compiled(self, smooth: Turning, alike: int, threads: int | None) -> tuple[Array, Array, Array, Array]:
        """Return matrices by the kernel, motions, torques, and whether each was found; coarse ones more finely."""
        found = mapped(smooth, self.harmonics, alike=alike, moves_only=self.rough, threads=threads)
        matrix, coefficient, force, moved = found.matrix, found.coefficient, found.force, found.moved
        rough = self._coarse(found).reshape(-1, alike).any(axis=-1)
        coarse = np.flatnonzero(np.repeat(rough | self.rough, alike))
        if coarse.size:
            more = round(MORE * self.harmonics)
            near = Mapped(**{one.name: getattr(found, one.name)[coarse] for one in fields(Mapped)})
            again = mapped(smooth.part(coarse), more, alike=alike, near=near, threads=threads)
            coefficient = np.pad(coefficient, ((0, 0), (0, 0), (0, more - self.harmonics)))
            matrix[coarse], coefficient[coarse], moved[coarse] = again.matrix, again.coefficient, again.moved
            force[coarse] = again.force
            self.rough = bool(rough.all())
        return matrix, coefficient, force, (moved <= SURE) & np.isfinite(matrix).all(axis=(1, 2))

    def _coarse(self, found: Mapped) -> Array:
        """Tell which motions take more harmonics, array of bool (n,)."""
        size = np.max(np.abs(found.coefficient), axis=1)
        tail = np.max(size[:, -max(2, self.harmonics // 4) :], axis=-1)
        return ~np.asarray(tail <= SMALL * np.max(size, axis=-1))

    def _turning(self, speeds: Array) -> Turning:
        """Return the drive at speeds (n,), each in its row."""
        whole = Turning(self.model(speeds), (len(speeds),), speeds, self.period)
        return whole.part(np.arange(len(speeds)))

    def _reduced(self, matrix: Array, coefficient: Array, turning: Turning) -> Array:
        """Return matrices without the shift in time, in a basis that changes as smoothly as they do."""
        if not self.free:
            return matrix
        order = np.arange(coefficient.shape[-1]) * turning.frequency[:, None, None]
        rate = turning.speed[:, None] + np.sum((1j * order * coefficient).real, axis=-1)
        acceleration = -np.sum((order**2 * coefficient).real, axis=-1)[:, self.heavy]
        tangent = np.concatenate([rate, acceleration], axis=-1) @ self.energy.T
        with np.errstate(invalid="ignore", divide="ignore"):
            unit = tangent / np.linalg.norm(tangent, axis=-1, keepdims=True)
        unit = np.where(np.isfinite(unit), unit * np.sign(turning.speed)[:, None], self.even)
        normal = unit + self.even
        normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
        turn = np.eye(matrix.shape[-1]) - 2.0 * normal[:, :, None] * normal[:, None, :]
        found: Array = self.rest.T @ turn @ matrix @ turn @ self.rest
        return found

    def largest(self, matrix: Array, speed: Array, slope: Array) -> Array:
        """Return the largest modulus of the multipliers of vibration; slope: of the torque that keeps the speed."""
        values = np.linalg.eigvals(matrix)
        drift = -slope * self.period / (speed * self.inertia)
        values = vibrating(values, 1, lambda rows: drift[rows]) if self.drifts else values
        found: Array = np.max(np.abs(values), axis=-1, initial=0.0)
        return found
