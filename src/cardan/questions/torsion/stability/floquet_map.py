"""Where is steady running stable? Maps of Floquet multipliers over any two quantities of a drive."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.compiled.method import Compiled, Method, chosen, share
from cardan.maths.periodic.harmonics import HarmonicBalance, Status
from cardan.maths.periodic.switching_orbit import Shooting
from cardan.questions.torsion.model.inputs import Law
from cardan.questions.torsion.model.torsional_layouts import ARRAYS, SHARED, Turning, leading, period_of
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.steady.orbit import Orbit, straight_frequencies
from cardan.questions.torsion.steady.run_stability import (
    Floquet,
    Verdict,
    Zone,
    as_wide,
    drift_of_sums,
    drifting,
    floquet,
    judged,
    rising_first,
    shaped,
    straight_damping,
    unmoved,
    values_of,
    without_last,
)
from cardan.questions.torsion.steady.steady import (
    closed,
    periodic_response,
    speeds_of,
    started,
    stays_closed,
    steady_orbits,
)
from cardan.questions.torsion.steady.steady_result import SteadyResponse
from cardan.texts import _

from .stability_kernel import SURE, fits, harmonics_for, heavy_of, mapped

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

CHUNK, FEW = 2048, 64
"""Points computed between two looks at progress, compiled and as array expressions."""

WORTH = 64
"""Points from which the kernel is worth loading."""

MOST = 4_000_000
"""Points of a map at most."""

PACE, WEIGHT = 1e-4, 1000
"""Seconds and bytes that a point takes, about."""

ROUGH = 5e-7
"""Error of the kernel's multipliers, about: so close to modulus 1 they count as neutral."""

LONG = Shooting(reach=0.8, work=30_000)
"""How motions with open play are found: at the ends of such steps, where multipliers come from, right to 1e-10."""

NO_SEARCH = Shooting(work=0)
"""Where there is no smooth motion, none is searched for."""

SMALL = 1e-4
"""Largest of the upper harmonics, over the largest of all, of a motion that is not called coarse."""

FINER = (1.6, 2.4)
"""Times the harmonics with which coarse motions are sought again."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FloquetMap:
    """Stability of steady running over a map; axes (...) are those of the model and the speeds."""

    floquet: Floquet  # (...): multipliers, growth rate, verdict, kind and nearest zone at every point
    orbit: Orbit  # (...): the motions judged, by their lower harmonics
    status: Array  # (...) of int: `cardan.maths.periodic.harmonics.Status` of the motions
    cancelled: bool = False  # whether the work was stopped; what was not done is unknown

    @property
    def unstable_share(self) -> float:
        """Share of the points known that are unstable; nan where none is."""
        known = self.floquet.verdict != Verdict.UNKNOWN
        return float(np.mean(self.floquet.verdict[known] == Verdict.UNSTABLE)) if np.any(known) else float("nan")


def floquet_map(
    model: TorsionalModel,
    *,
    speed: ArrayLike | None = None,
    method: Method | None = None,
    harmonics: int | None = None,
    opened: Shooting = LONG,
    progress: Progress | None = None,
) -> FloquetMap:
    """Return whether steady running is stable at every point of a map.

    model (...): any of its numbers may vary along its leading axes.
    speed (...) [rad/s]: of the input, or mean speed of free drives; by default the input speed of the model.
    method: Compiled for more than a few points by default. The kernel does not know open play and tables of
    torques: they go the plain way, as do points whose motion it does not find.
    harmonics: harmonics of the motion in the kernel, for half a turn each; as many as the joint angles ask for by
    default.
    opened: how motions are found that are no Fourier sums.
    progress: told the share done; when it answers "stop" the points not yet done stay unknown.
    The same equations as `run_stability.floquet`, eight drives at a time: motion by harmonic balance,
    monodromy matrix by collocation of order 10.
    """
    omega = speeds_of(model, speed)
    outer = np.broadcast_shapes(leading(replace(model, input_speed=None)), omega.shape)
    count = int(np.prod(outer, dtype=float))
    if count > MOST:
        text = _("{count:,} points would take about {hours:,.1f} h and {memory:,.0f} GB; at most {most:,} are done")
        shown = text.format(count=count, hours=count * PACE / 3600.0, memory=count * WEIGHT / 1e9, most=MOST)
        raise refuse("speed", shown)
    if not model.free:
        model = replace(model, input_speed=omega)
    turning = Turning(model, outer, np.broadcast_to(omega, outer).reshape(-1), period_of(model))
    way = chosen(method, np, count >= WORTH)
    compiled = isinstance(way, Compiled) and fits(replace(model, backlash=np.zeros_like(model.backlash)), omega)
    waves = (harmonics * round(turning.period / np.pi)) if harmonics else harmonics_for(model, turning.period)
    table = _Table(turning, waves, opened)
    done, stopped = 0, False
    while done < count and not stopped:
        rows = np.arange(done, min(done + (CHUNK if compiled else FEW), count))
        left = table.by_kernel(rows, way.threads) if compiled and isinstance(way, Compiled) else rows
        stopped = table.plain(left, within(progress, done / count, (int(rows[-1]) + 1) / count))
        done = int(rows[-1]) + 1
        if not stopped and progress is not None:
            stopped = progress(done / count) == "stop" and done < count
    return table.found(outer, stopped)


class _Table:
    """What is known of the points, in one axis; the rest is blank."""

    def __init__(self, turning: Turning, harmonics: int, opened: Shooting) -> None:
        self.turning, self.harmonics, self.opened = turning, harmonics, opened
        self.count = len(turning.speed)
        self.columns: dict[str, Array] = {}

    def put(self, rows: Array, judgement: Floquet, coefficient: Array, force: Array, status: Array) -> None:
        """Fill in some points."""
        parts = {f.name: getattr(judgement, f.name) for f in fields(Floquet) if f.name not in ("zone", "period")}
        parts |= {f"zone {f.name}": getattr(judgement.zone, f.name) for f in fields(Zone)}
        wide = np.zeros((*coefficient.shape[:-1], self.harmonics + 1), dtype=complex)
        kept = min(wide.shape[-1], coefficient.shape[-1])
        wide[..., :kept] = coefficient[..., :kept]
        for name, values in (parts | {"coefficient": wide, "force": force, "status": status}).items():
            if name == "multipliers" and name in self.columns:
                self.columns[name], values = as_wide(self.columns[name], values)
            if name not in self.columns:
                blank = {"verdict": Verdict.UNKNOWN, "status": Status.CANCELLED}.get(name, 0)
                fill = np.nan if values.dtype.kind in "fc" else int(blank)
                self.columns[name] = np.full((self.count, *values.shape[1:]), fill, dtype=values.dtype)
            self.columns[name][rows] = values

    def plain(self, rows: Array, progress: Progress | None) -> bool:
        """Find points by array expressions and tell whether the work was stopped."""
        for first in range(0, len(rows), FEW):
            some = rows[first : first + FEW]
            part, last = self.turning.part(some), first + len(some)
            told = within(progress, first / len(rows), last / len(rows))
            orbit, status = steady_orbits(part.model, speed=part.speed, opened=self.opened, progress=told)
            self.put(some, floquet(orbit), orbit.coefficient, orbit.force, status)
            if np.any(status == Status.CANCELLED):
                return True
        return False

    def by_kernel(self, rows: Array, threads: int | None) -> Array:
        """Find points by the kernel, coarse ones again with more harmonics; return those it found no motion for."""
        lost = self.compiled(rows, self.harmonics, threads)
        coarse = rows[self.columns["status"][rows] == Status.COARSE] if "status" in self.columns else rows[:0]
        for more in FINER if len(coarse) else ():
            self.compiled(coarse, round(more * self.harmonics), threads)
            coarse = coarse[self.columns["status"][coarse] == Status.COARSE]
        return lost

    def compiled(self, rows: Array, harmonics: int, threads: int | None) -> Array:
        """Find points by the kernel; return those it found no motion for."""
        if not len(rows):
            return rows
        whole = self.turning.part(rows)
        part = closed(whole)
        found = mapped(part, harmonics, threads=threads)
        sure = (found.moved <= SURE) & np.isfinite(found.matrix).all(axis=(1, 2))
        sure &= stays_closed(whole, found.coefficient)
        if not np.any(sure):
            return rows
        part, coefficient = part.part(np.flatnonzero(sure)), found.coefficient[sure]
        tangent, drifts, sums, drives = None, None, coefficient, part.drives(np.arange(len(part.speed)))
        frequencies = straight_frequencies(drives)
        size = np.max(np.abs(coefficient), axis=1)
        tail = np.max(size[:, -max(2, harmonics // 4) :], axis=-1)
        if part.model.free:
            order = np.arange(coefficient.shape[-1]) * part.frequency[:, None, None]
            rate = part.speed[:, None] + np.sum((1j * order * coefficient).real, axis=-1)
            acceleration = -np.sum((order**2 * coefficient).real, axis=-1)
            tangent = np.concatenate([rate, acceleration[:, heavy_of(part.model)]], axis=-1)
            drifts = drifting(drives, part.speed)
            frequencies = frequencies[:, 1:]
            coefficient = started(coefficient, part.period)
        values, removed = rising_first(
            _values(found.matrix[sure], tangent, threads),
            drifts,
            lambda rows: drift_of_sums(part.part(rows), sums[rows]),
        )
        values = without_last(values, unmoved(straight_damping(drives, part.speed), heavy_of(part.model)))
        nothing = np.full(len(values), np.nan)
        self.put(
            rows[sure],
            judged(values, removed, nothing, frequencies, part.speed, part.period, np.isfinite(part.speed), ROUGH),
            np.pad(coefficient, ((0, 0), (part.first, 0), (0, 0))),
            found.force[sure],
            np.where(tail <= SMALL * np.max(size, axis=-1), int(Status.CONVERGED), int(Status.COARSE)),
        )
        return rows[~sure]

    def found(self, outer: tuple[int, ...], stopped: bool) -> FloquetMap:
        """Return the map."""
        columns, period = self.columns, self.turning.period
        rest = {f.name: columns[f.name] for f in fields(Floquet) if f.name not in ("zone", "period")}
        zone = Zone(**{f.name: columns[f"zone {f.name}"] for f in fields(Zone)})
        orbit = Orbit(
            model=self.turning.model,
            speed=self.turning.speed.reshape(outer),
            period=period,
            coefficient=columns["coefficient"].reshape(*outer, *columns["coefficient"].shape[1:]),
            force=columns["force"].reshape(outer),
        )
        return FloquetMap(
            floquet=shaped(Floquet(zone=zone, period=period, **rest), outer),
            orbit=orbit,
            status=columns["status"].reshape(outer),
            cancelled=stopped,
        )


def within(progress: Progress | None, low: float, high: float) -> Progress | None:
    """Return what tells the share of a part of the work as that of the whole, but for the end of the part."""
    if progress is None:
        return None
    return lambda share: progress(low + (high - low) * share) if share < 1.0 else None


def _values(matrix: Array, tangent: Array | None, threads: int | None) -> Array:
    """Return `cardan.questions.torsion.steady.run_stability.values_of` matrices, found by several threads."""
    values = np.empty((len(matrix), matrix.shape[-1] - (tangent is not None)), dtype=complex)

    def work(first: int, last: int) -> None:
        some = slice(first, last)
        values[some] = values_of(matrix[some], None if tangent is None else tangent[some])

    share(work, len(matrix), threads=threads, least=64)
    return values


# How does a drive run over a range of speeds? Order maps of steady running.


def speed_sweep(
    model: TorsionalModel,
    speeds: ArrayLike,
    *,
    method: HarmonicBalance | Shooting | None = None,
    orders: float = 10.0,
    progress: Progress | None = None,
) -> SteadyResponse:
    """Return the steady running of drives at many speeds: what an order map shows.

    model (...): its own input speed does not count; speeds (k,) [rad/s]: of the input, or mean speeds of free drives.
    method, orders, progress: as `cardan.questions.torsion.steady.steady.periodic_response` takes them.
    Returns (..., k).
    """
    where = np.asarray(speeds, dtype=float)
    if where.ndim != 1 or not where.size:
        raise refuse("speeds", _("a list of speeds is needed"))
    arrays = {name: getattr(model, name)[..., None, :] for name in ARRAYS if getattr(model, name) is not None}
    torques = tuple(Torque(station=torque.station, law=_widened(torque.law)) for torque in model.torques)
    wide = replace(model, torques=torques, input_speed=None if model.free else where, **arrays)
    return periodic_response(wide, speed=where, method=method, orders=orders, progress=progress)


def _widened(law: Law) -> Law:
    own = {one.name: np.asarray(getattr(law, one.name)) for one in fields(law) if one.name not in SHARED}  # type: ignore[arg-type]
    return replace(law, **{name: value[..., None] for name, value in own.items() if value.ndim})  # type: ignore[type-var]
