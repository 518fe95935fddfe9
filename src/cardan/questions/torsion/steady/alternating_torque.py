"""How far do torques swing? The quick answer for searches, over very many drives and speeds at once."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import extremes, sampled_series, tops
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, harmonic_balance
from cardan.questions.torsion.model.inputs import Swinging
from cardan.questions.torsion.model.side_bands import side_waves
from cardan.questions.torsion.model.torsional_balance import element_torques
from cardan.questions.torsion.model.torsional_layouts import Turning, leading, period_of
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.model.torsional_modes import straight_waves
from cardan.texts import _

from .orbit import Orbit, at_rest
from .steady import Progress, periodic_response
from .torsion_response import parted
from .two_frequencies import envelope, grouped, of_drives, side_bands

FEW, MOST = 4, 24
"""Harmonics of half a turn to begin with, and at most."""

TAIL = 1e-6
"""Size of the last harmonics at which a motion counts as found: torques then hold five digits."""

STEPS = 25
"""Newton steps at most; a motion that takes more is not worth the wait in a search."""

BANDS = 6
"""Side bands of torques of other orders, either way, for half a turn."""

CHUNK = 512
"""Motions found at once."""

HIGH, ROUNDS = 0.7, 4
"""Share of the largest torque of a drive from which others are told exactly, and how often those are sought."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TorqueSwings:
    """How far the torques of drives swing; leading axes (...) are those of the drives and speeds."""

    orbit: Orbit  # (...): the motions; nan where none was found
    swing: Array  # (..., E) [N·m]: half of highest less lowest torque of every element; nan where no motion was found
    loose: tuple[Torque, ...] = ()  # torques of orders that no two turns hold: in the swings, not in the motions

    @property
    def found(self) -> Array:
        """Whether a motion was found, array of bool (...)."""
        return np.isfinite(self.swing).all(axis=-1)


def torque_swings(model: TorsionalModel, speed: ArrayLike, *, progress: Progress | None = None) -> TorqueSwings:
    """Return how far the torques of drives swing in steady running, to about five digits.

    model (...): its axes and those of the speed spread over each other.
    speed (...) [rad/s]: of the input, or mean speed of free drives; not 0.
    progress: told the share done; when it answers "stop" the remaining motions are left out.
    Harmonic balance of the exact equations, as `periodic_response` but with fewer harmonics and without what a search
    does not ask for. With backlash it is `periodic_response`. Torques of orders that no two turns hold are answered by
    the drive as it turns, to first order in them, side bands and all; with backlash by the straight line.
    """
    omega = np.asarray(speed, dtype=float)
    if not np.all(np.isfinite(omega) & (omega != 0.0)):
        raise refuse("speed", _("steady running needs speeds other than 0"))
    steady, loose = parted(model)
    outer = np.broadcast_shapes(leading(replace(steady, input_speed=None)), omega.shape)
    omega = np.broadcast_to(omega, outer)
    if not steady.free:
        steady = replace(steady, input_speed=omega)
    if np.any(steady.backlash > 0.0):
        found = periodic_response(steady, speed=omega, progress=progress)
        swing = 0.5 * found.peak_to_peak + _beside(steady, loose, omega)
        return TorqueSwings(orbit=found.orbit, swing=swing, loose=loose)
    orbit, swing = _quick(steady, loose, outer, omega, progress)
    return TorqueSwings(orbit=orbit, swing=swing, loose=loose)


def exactly(found: TorqueSwings, rows: Array | None = None, *, follow: bool = True) -> tuple[TorqueSwings, Array]:
    """Return the same with torques of other orders exact, and at which motions they are, array of bool (b,).

    rows (b,) of int: which motions, counted through the leading axes; all by default. Where no motion with them is
    known, as with open backlash, they stay to first order. Orders of which none is a multiple of another add up.
    follow: see `cardan.questions.torsion.steady.two_frequencies.motions`.
    """
    orbit = found.orbit
    wanted = np.arange(orbit.count) if rows is None else rows
    groups = list(grouped(found.loose))
    if not groups or not wanted.size:
        return found, np.full(len(wanted), not groups)
    low, high, known = np.zeros(()), np.zeros(()), np.ones(len(wanted), dtype=bool)
    for base, group in groups:
        bands = side_bands(orbit, base, group, wanted, follow=follow)
        low, high, known = low + bands.lowest, high + bands.highest, known & bands.found
    if len(groups) > 1:  # each of them with the joints
        coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[wanted]
        lowest, highest = _extremes(orbit.turning.part(wanted), coefficient, ())
        low, high = low - (len(groups) - 1) * lowest, high - (len(groups) - 1) * highest
    swing = found.swing.reshape(orbit.count, -1).copy()
    swing[wanted[known]] = 0.5 * (high - low)[known]
    return replace(found, swing=swing.reshape(found.swing.shape)), known


def exactly_where_high(found: TorqueSwings, drives: int, elements: Array) -> TorqueSwings:
    """Return swings of drives at speeds, (drives·S,), with torques of other orders exact near the largest of each.

    elements: those that count. Motions that Newton's steps miss stay to first order: in a search it is not worth more.
    """
    done = np.zeros((drives, found.orbit.count // drives), dtype=bool)
    for _round in range(ROUNDS if found.loose else 0):
        swing = np.max(np.nan_to_num(found.swing[:, elements], nan=-1.0), axis=-1).reshape(done.shape)
        high = ~done & (swing >= HIGH * np.max(swing, axis=-1, keepdims=True))
        if not np.any(high):
            break
        found = exactly(found, np.flatnonzero(high), follow=False)[0]
        done |= high
    return found


def _quick(
    model: TorsionalModel,
    loose: tuple[Torque, ...],
    outer: tuple[int, ...],
    omega: Array,
    progress: Progress | None,
) -> tuple[Orbit, Array]:
    turning = Turning(model, outer, omega.reshape(-1), period_of(model))
    half_turns = round(turning.period / np.pi)
    how = HarmonicBalance(harmonics=FEW * half_turns, most=MOST * half_turns, tail=TAIL, steps=STEPS)
    count = len(turning.speed)
    whole = np.full((count, model.coordinates, how.harmonics + 1), np.nan + 0j)
    force, swing = np.full(count, np.nan), np.full((count, len(model.elements)), np.nan)
    for first in range(0, count, CHUNK):
        rows = np.arange(first, min(first + CHUNK, count))
        part = turning.part(rows)
        waves = harmonic_balance(
            part, part.frequency, part.coordinates, free=model.free, start=at_rest(part), method=how
        )
        lost = waves.status == Status.NO_CONVERGENCE
        found = np.pad(waves.coefficient, ((0, 0), (turning.first, 0), (0, 0)))
        found[lost] = np.nan
        if found.shape[-1] > whole.shape[-1]:
            whole = np.pad(whole, ((0, 0), (0, 0), (0, found.shape[-1] - whole.shape[-1])))
        whole[rows] = 0.0
        whole[rows, :, : found.shape[-1]] = found
        force[rows] = np.where(lost, np.nan, waves.force)
        low, high = _extremes(part, found, of_drives(model, outer, rows, loose))
        swing[rows] = np.where(lost[:, None], np.nan, 0.5 * (high - low))
        if progress is not None and progress((int(rows[-1]) + 1) / count) == "stop":
            break
    orbit = Orbit(
        model=model,
        speed=omega,
        period=turning.period,
        coefficient=whole.reshape(*outer, *whole.shape[1:]),
        force=force.reshape(outer),
    )
    return orbit, swing.reshape(*outer, -1)


def _extremes(part: Turning, coefficient: Array, loose: tuple[Torque, ...]) -> tuple[Array, Array]:
    """Return the lowest and the highest torque of every element in motions, arrays (b, E).

    loose: torques of other orders, ready for moments in a second axis.
    """
    rows = np.arange(len(part.speed))
    harmonics = coefficient.shape[-1]
    alone = Orbit(
        model=part.model,
        speed=part.speed,
        period=part.period,
        coefficient=np.nan_to_num(coefficient),
        force=np.zeros(len(rows)),
    )
    own = BANDS * round(part.period / np.pi)
    samples = 4 * (max(harmonics, own if loose else 0) + 2)
    drives, motion = part.drives(rows), alone.of(rows, part.period * np.arange(samples) / samples)
    curves = element_torques(drives, *motion[:2]).swapaxes(1, 2)
    if loose:
        fall, rise = envelope(side_waves(drives, motion, part.speed, part.period, loose, own), loose)
        return -_top(fall - curves), _top(curves + rise)
    torque = sampled_series(curves)
    return extremes(torque[..., : harmonics + 4])


def _top(values: Array) -> Array:
    """Return the largest of values (..., S) that repeat."""
    return np.max(tops(np.concatenate([values[..., -1:], values, values[..., :1]], axis=-1))[..., 1:-1], axis=-1)


def _beside(model: TorsionalModel, loose: tuple[Torque, ...], omega: Array) -> Array:
    """Return the amplitudes of torques that do not repeat within two turns, of every element."""
    found = np.zeros(())
    for torque in loose:
        law = torque.law
        assert isinstance(law, Swinging)
        waves = straight_waves(model, torque.station, law.amplitude, law.frequency * np.abs(omega))
        found = found + np.abs(waves.torque)
    return found
