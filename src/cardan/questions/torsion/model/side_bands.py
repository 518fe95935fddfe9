"""How does a turning drive answer torques of other orders, to first order in them? With the side bands of its joints.

About its motion it is a linear oscillator whose mass, damping and stiffness repeat with the shaft. A torque e^(iνφ)
makes of it e^(iνφ) Σ c_m e^(imz), z the phase of the period: Hill's equations, whose parts of all m are coupled.
"""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import solve_blocks

from .inputs import Swinging
from .torsional_balance import Places, places, slopes
from .torsional_model import Torque, TorsionalModel


def side_waves(
    drives: TorsionalModel,
    motion: tuple[Array, Array, Array],
    speed: Array,
    period: float,
    loose: tuple[Torque, ...],
    harmonics: int,
) -> Array:
    """Return what torques of other orders add to those of the elements, complex array (n, b, E, S) [N·m].

    drives (b,): with torques ready for moments in a second axis, backlash closed; speed (b,) [rad/s].
    motion: q, q̇ and q̈ (b, S, R) at evenly spaced shaft angles φ of a period, at least 4 `harmonics` + 1 of them.
    loose: n torques that swing, ready for moments as well; harmonics: of the period, up to which parts count.
    The torque of an element is that without them plus Re of this times e^(iνφ).
    """
    q, rate, _acceleration = motion
    samples, first = q.shape[1], 0 if drives.free else 1
    angle = period * np.arange(samples) / samples
    part = np.fft.fftfreq(2 * harmonics + 1, 1.0 / (2 * harmonics + 1)).astype(int)
    by, place = slopes(drives, *motion), places(drives, q)
    stiffness, damping, mass = by.stiffness[..., first:, first:], by.damping[..., first:, first:], by.mass[..., first:]
    coupled = np.any((damping != 0.0) | (stiffness != 0.0), axis=(0, 1)) | np.eye(mass.shape[-1], dtype=bool)

    def parts(values: Array) -> Array:
        found: Array = np.fft.fft(values, axis=1) / samples
        return found

    spread = {
        (r, s): [parts(one[:, :, r, s])[:, part[:, None] - part] for one in (stiffness, damping)]
        for r, s in np.argwhere(coupled).tolist()
    }
    heavy = [parts(mass[:, :, r])[:, part[:, None] - part] for r in range(mass.shape[-1])]
    found = np.zeros((len(loose), len(speed), len(drives.elements), samples), dtype=complex)
    for k, torque in enumerate(loose):
        law, at = torque.law, drives.coordinate[torque.station] - first
        assert isinstance(law, Swinging)
        if at < 0:  # on a station whose turning is forced it does nothing
            continue
        swing = law.frequency * (place.angle[..., torque.station] - angle) + law.phase - 0.5 * np.pi
        right = np.zeros((len(speed), mass.shape[-1], len(part)), dtype=complex)
        right[:, at] = parts(law.amplitude * place.first[..., torque.station] * np.exp(1j * swing))[:, part]
        turning = speed[:, None] * (law.frequency + 2.0 * np.pi / period * part)
        blocks = {
            (r, s): c + b * (1j * turning[:, None]) - (heavy[r] * turning[:, None] ** 2 if r == s else 0.0)
            for (r, s), (c, b) in spread.items()
        }
        moved = solve_blocks(blocks, right)
        found[k] = _torques(drives, place, rate, _over(moved, part, samples, first), moved, turning, part, first)
    return found


def _over(moved: Array, part: Array, samples: int, first: int) -> Array:
    """Return parts (b, R, K) as samples over the period of all coordinates, the forced one at rest: (b, S, R')."""
    wide = np.zeros((moved.shape[0], moved.shape[1] + first, samples), dtype=complex)
    wide[:, first:, part] = moved
    return np.fft.ifft(wide, axis=-1).swapaxes(1, 2) * samples


def _torques(
    drives: TorsionalModel,
    place: Places,
    rate: Array,
    moved: Array,
    waves: Array,
    turning: Array,
    part: Array,
    first: int,
) -> Array:
    """Return the torques of the elements over the period, array (b, E, S)."""
    wide = list(drives.coordinate)
    speed = _over(1j * turning[:, None] * waves, part, moved.shape[1], first)[..., wide]
    angle = place.first * moved[..., wide]
    faster = place.first * speed + place.second * rate[..., wide] * moved[..., wide]
    heads, tails = ([one[k] for one in drives.elements] for k in (0, 1))
    torque = drives.stiffness[:, None] * (angle[..., heads] - angle[..., tails])
    torque = torque + drives.damping[:, None] * (faster[..., heads] - faster[..., tails])
    return np.moveaxis(torque, -1, 1)
