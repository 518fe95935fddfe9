"""How does a drive turn over the input angle, and how uniformly?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import unlike_hooke
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peak

from .equivalence import EquivalentJoint, after_each_joint
from .motion import Motion, motion


@dataclass(frozen=True, eq=False, kw_only=True)
class Turning:
    """What is known of the motion of one drive."""

    motion: Motion  # every shaft at the input angles asked for
    each: Evenness  # extremes of shafts 2 … n+1 over a turn at uniform input
    # the same at the few positions that people read one by one, where somebody asked for them
    listed: Motion | None = None

    @property
    def fluctuation(self) -> float:
        """Speed fluctuation δ of the output."""
        return float(self.each.speed_fluctuation[-1])


def turning(
    drive: Drive, angle: ArrayLike | None = None, *, speed: float | None = None, listed: ArrayLike | None = None
) -> Turning:
    """Return how a drive turns, and how uniformly.

    drive: of joints of any kinds.
    angle (p,) [rad]: input angles from the start position; one turn in steps of a degree by default.
    speed [rad/s]: input speed; that of the duty by default.
    listed (q,) [rad]: input angles that people want to read one by one.
    """
    return Turning(
        motion=motion(drive, angle, speed=speed),
        each=each_shaft(drive),
        listed=None if listed is None else motion(drive, listed, speed=speed),
    )


# How uneven is every shaft of a drive whose joints turn by laws of their own? Seen over one turn.

ROUNDED = 1e-9
"""Orders below this share of the largest are rounding."""

PLACES = 720
"""Places in a turn at which the motion is looked at; between them the largest values are found by a quartic."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Swing:
    """Extremes of shafts 2 … n+1 over a turn, under the names of `EquivalentJoint`, and what they swing in."""

    speed_fluctuation: Array  # (n): δ = i_max - i_min
    ratio_min: Array  # ratio_min, ratio_max (n): least and largest speed ratio
    ratio_max: Array  # (n)
    max_angle_error: Array  # (n) [rad]: half of what the shaft runs ahead and back
    max_acceleration: Array  # (n): largest |ε|/ω_1² at uniform input
    amplitude: Array  # (n, orders) [rad]: amplitudes of the angle error once, twice … a turn
    coast_acceleration: Array  # (n-1): largest |ε|/ω² of shafts 2 … n at uniform output, whose speed is ω

    @property
    def shaft_speed_fluctuation(self) -> Array:
        """δ of shafts 2 … n+1, array (n)."""
        return self.speed_fluctuation

    @property
    def joint_angle(self) -> Array:
        """Joint angle of the Hooke joint with the same speed fluctuation sin α tan α, array (n) [rad]."""
        half = 0.5 * self.speed_fluctuation
        found: Array = np.arccos(np.clip(np.sqrt(1.0 + half * half) - half, 0.0, 1.0))
        return found

    def orders(self, count: int) -> list[tuple[int, float]]:
        """Return the largest orders of the output's angle error with their amplitudes, lowest first [1/turn, rad]."""
        row = self.amplitude[-1]
        largest = sorted(np.argsort(-row)[:count].tolist())
        return [(k + 1, float(row[k])) for k in largest if row[k] > ROUNDED * np.max(row)]


Evenness: TypeAlias = EquivalentJoint | Swing
"""How even shafts 2 … n+1 turn: in closed form, or seen over a turn."""


def swing(drive: Drive) -> Swing:
    """Return how uneven every shaft of a drive is, seen over one turn."""
    angle = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    found = motion(drive, angle)
    ratio, slope, angle_error = (part[1:] for part in (found.shaft_ratio, found.shaft_slope, found.angle_error))
    high, low = peak(ratio, smooth=True), -peak(-ratio, smooth=True)
    inside, output = (part[:-1] for part in (ratio, slope)), (part[-1] for part in (ratio, slope))
    coast = backward(*inside, *output)

    def largest(values: Array) -> Array:
        return np.maximum(peak(values, smooth=True), peak(-values, smooth=True))

    wave = np.abs(np.fft.rfft(angle_error)) * (2.0 / PLACES)
    return Swing(
        speed_fluctuation=high - low,
        ratio_min=low,
        ratio_max=high,
        max_angle_error=0.5 * (peak(angle_error, smooth=True) + peak(-angle_error, smooth=True)),
        max_acceleration=largest(slope),
        amplitude=wave[:, 1 : PLACES // 8],
        coast_acceleration=largest(coast) if coast.size else np.zeros(0),
    )


def backward(ratio: Array, slope: Array, output_ratio: Array, output_slope: Array) -> Array:
    """Return the accelerations over ω² of shafts where the output turns uniformly at ω, arrays (..., p).

    ratio, slope (..., p) [1, 1/rad]: speed ratio of the shafts at uniform input and its derivative by the input angle
    φ_1.
    output_ratio, output_slope (p) [1, 1/rad].
    With u = dφ/dφ_1 of a shaft and v that of the output, d²φ/dφ_out² = (u' v - u v')/v³.

    A shaft that turns as the output does is not accelerated:

    >>> backward(np.asarray([1.2]), np.asarray([0.3]), np.asarray([1.2]), np.asarray([0.3]))
    array([0.])
    """
    found: Array = (slope * output_ratio - ratio * output_slope) / output_ratio**3
    return found


def each_shaft(drive: Drive) -> Evenness:
    """Return how even every shaft of a drive turns: in closed form where the kinds of its joints have one.

    Returns EquivalentJoint or Swing: joint_angle, speed_fluctuation, ratio_min, ratio_max, max_angle_error,
    max_acceleration (n), for shafts 2 … n+1.
    """
    return swing(drive) if unlike_hooke(drive) else after_each_joint(drive)
