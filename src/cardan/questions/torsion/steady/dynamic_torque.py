"""What torques run through the shafts and joints of a drive that vibrates in torsion while it runs steadily?"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peak
from cardan.maths.periodic.harmonics import Status
from cardan.maths.remembered import remembered
from cardan.questions.torsion.model.inputs import Law, Swinging
from cardan.questions.torsion.model.torsional_balance import element_torques, joint_torques
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.model.torsional_modes import straight_waves

from .orbit import Orbit
from .several import told_motions, widened
from .steady_result import read_off
from .torsion_response import loaded_model, parted
from .two_frequencies import grouped, side_bands

LOOK = 120
"""Places in half a turn at which torques are looked at."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DynamicTorque:
    """Torques of steady torsional vibration at some speeds, all masses and the mean torque in them."""

    orbit: Orbit  # (s,): the motions
    found: Array  # (s,) of bool: whether a motion was found
    low: Array  # low, high (s, n+1) [N·m]: least and largest torque of every shaft; nan where no motion was found
    high: Array
    # (s, n) [N·m]: by how much torques and motions of other periods raise or lower those at every joint
    beside: Array

    @property
    def speed(self) -> Array:
        """Input speeds, array (s,) [rad/s]."""
        return self.orbit.speed

    @property
    def angle(self) -> Array:
        """Evenly spaced angles of the input over a period of the torques, array (p,) [rad]."""
        places = round(LOOK * self.orbit.period / np.pi)
        found: Array = np.arange(places) * (self.orbit.period / places)
        return found

    def at_joints(self, angle: ArrayLike) -> tuple[Array, Array]:
        """Return what enters and leaves every joint at input angles (p,), arrays (s, n, p) [N·m]."""
        q, rate, acceleration = self.orbit.at(angle)
        drives = self.orbit.drives(np.arange(self.orbit.count))
        entering, leaving = joint_torques(drives, q, rate, acceleration)
        return np.moveaxis(entering, -1, -2), np.moveaxis(leaving, -1, -2)


def dynamic_torque(drive: Drive, duty: Duty | None = None, *, speed: ArrayLike, closed: bool = False) -> DynamicTorque:
    """Return the torques of shafts and joints while a drive vibrates in torsion.

    speed (s,) [rad/s]: of the input, none of them 0; closed: count backlash as closed.
    Raises InputError: what the torsional model misses, each with the key to add.
    """
    chosen = drive.duty if duty is None else duty
    speeds = np.asarray(speed, dtype=float)
    train, whole = loaded_model(drive, chosen, speeds)
    model, loose = parted(replace(whole, backlash=0.0 * whole.backlash) if closed else whole)
    line = tuple(host is None for host in train.hangs)
    return _torques(model, loose, speeds, line, len(drive.joints) + 1)


@remembered(64)  # drives of many joint sizes share few torsional models, and a model takes a second
def _torques(
    model: TorsionalModel, loose: tuple[Torque, ...], speeds: Array, line: tuple[bool, ...], shafts: int
) -> DynamicTorque:
    """Return the torques of a model at speeds (s,) [rad/s].

    loose: torques that do not repeat within two turns. line: whether each station belongs to the line itself.
    """
    orbit, status, others = told_motions(model, speeds)
    found = (status == Status.CONVERGED) | (status == Status.COARSE)
    nothing = np.zeros((len(speeds), len(model.elements)))
    part = DynamicTorque(orbit=orbit, found=found, low=nothing, high=nothing, beside=nothing)
    q, rate, _acceleration = orbit.at(part.angle)
    drives = orbit.drives(np.arange(orbit.count))
    torque = np.moveaxis(element_torques(drives, q, rate), -1, -2)
    alone = _kinked(orbit) if model.special else (-peak(-torque), peak(torque))
    lowest, highest = widened(*_with_bands(orbit, loose, *alone), others)
    falls, rises = (_at_joints(model, one, shafts) for one in (alone[0] - lowest, highest - alone[1]))
    at_ends: Array = np.max([*falls, *rises], axis=0)
    through = part.at_joints(part.angle)
    ends = [(-peak(-one) - less, peak(one) + more) for one, less, more in zip(through, falls, rises, strict=True)]
    low, high = np.full((len(speeds), shafts), np.inf), np.full((len(speeds), shafts), -np.inf)
    for k in range(shafts):
        own = [e for e, (a, b) in enumerate(model.elements) if model.shaft[a] == k and line[b]]
        lows, highs = [lowest[:, e] for e in own], [highest[:, e] for e in own]
        if k < shafts - 1:
            lows, highs = [*lows, ends[0][0][:, k]], [*highs, ends[0][1][:, k]]
        if k > 0:
            lows, highs = [*lows, ends[1][0][:, k - 1]], [*highs, ends[1][1][:, k - 1]]
        low[:, k], high[:, k] = np.min(lows, axis=0), np.max(highs, axis=0)
    lost = ~found[:, None]
    return replace(part, low=np.where(lost, np.nan, low), high=np.where(lost, np.nan, high), beside=at_ends)


@lru_cache(maxsize=256)
def steady_torque(drive: Drive) -> DynamicTorque | None:
    """Return the torques of a drive at the speed of its duty; None where its file does not tell them."""
    if not has_torsion(drive) or not drive.duty.speed:
        return None
    try:
        found = dynamic_torque(drive, speed=[drive.duty.speed])
    except InputError:
        return None
    return found if bool(found.found[0]) else None


def _kinked(orbit: Orbit) -> tuple[Array, Array]:
    """Return lowest and highest torques (s, E) of curves with kinks, which are not to be had from samples."""
    found = read_off(orbit, 1)
    return found.lowest, found.highest


def _with_bands(orbit: Orbit, loose: tuple[Torque, ...], lowest: Array, highest: Array) -> tuple[Array, Array]:
    """Return extremes (s, E) [N·m] with torques that do not repeat; by the straight line where no motion holds both."""
    more, less = highest.copy(), lowest.copy()
    for base, group in grouped(loose):
        band = side_bands(orbit, base, group)
        waves = [_amplitudes(orbit.model, one.station, one.law, orbit.speed) for one in group]
        straight = np.sum(waves, axis=0)
        there = band.found[:, None]
        more += np.where(there, band.highest - highest, straight)
        less += np.where(there, band.lowest - lowest, -straight)
    return less, more


def _amplitudes(model: TorsionalModel, station: int, law: Law, speeds: Array) -> Array:
    """Return how far a torque that does not repeat swings every element, array (s, E) [N·m]."""
    assert isinstance(law, Swinging)
    return np.abs(straight_waves(model, station, law.amplitude, law.frequency * np.abs(speeds)).torque)


def _at_joints(model: TorsionalModel, values: Array, shafts: int) -> tuple[Array, Array]:
    """Return by how much what enters and leaves every joint (s, n) moves where elements move by values (s, E).

    A yoke without mass passes on what its shaft carries; beside one with mass the larger of both shafts counts.
    """
    every = np.stack([_of_shafts(model, values, k, shafts) for k in range(shafts)], axis=-1)
    larger = np.maximum(every[:, :-1], every[:, 1:])
    pushed = {one.station for one in model.torques}
    heavy = [bool(np.any(model.inertia[..., k] != 0.0)) or k in pushed for k in range(model.inertia.shape[-1])]
    yokes = sorted((one[1], one[0], k) for k, one in enumerate(model.driven) if one is not None)
    driving, driven = np.asarray([[heavy[a], heavy[b]] for _joint, a, b in yokes]).T
    return np.where(driving, larger, every[:, :-1]), np.where(driven, larger, every[:, 1:])


def _of_shafts(model: TorsionalModel, values: Array, k: int, shafts: int) -> Array:
    """Return the largest value (s, E) of the elements of a shaft, or of the shaft next to it where it is rigid."""
    for near in sorted(range(shafts), key=lambda other: abs(other - k)):
        own = [e for e, (a, _b) in enumerate(model.elements) if model.shaft[a] == near]
        if own:
            found: Array = np.max(values[:, own], axis=-1)
            return found
    return np.zeros(len(values))
