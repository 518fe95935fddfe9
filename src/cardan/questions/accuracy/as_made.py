"""How a drive turns with the errors of its joints as made: the motion of the perfect drive and what they add."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.maths.curves.extremes import peak
from cardan.questions.motion.motion import motion
from cardan.texts import _

from .accuracy import transmission_error


@dataclass(frozen=True, kw_only=True)
class AsMade:
    """How the output of a drive turns with the errors of its joints."""

    fluctuation: float  # speed fluctuation δ of the output, largest less smallest speed over that of the input
    angle_error: float  # [rad]: angle error of the output, half of its largest less its smallest lead over the input


def as_made(drive: Drive) -> AsMade | None:
    """Return how a drive turns with the errors of its joints as made; None where a joint cannot be assembled.

    drive: of Hooke joints, with measured errors.
    Raises InputError: joints of such a kind that their errors cannot be told.
    φ_out(φ) = that of the perfect drive + e(φ), e as `transmission_error` has it exactly; its slope by Fourier's series
    over the turn.
    """
    found = transmission_error(drive)
    if not bool(found.closes):
        return None
    angle = np.asarray(found.angle)
    perfect = motion(drive, angle)
    wave = np.fft.rfft(np.asarray(found.error))
    slope = np.fft.irfft(1j * np.arange(wave.size) * wave, angle.size)
    ratio = np.asarray(perfect.shaft_ratio)[-1] + slope
    angle_error = np.asarray(perfect.shaft_angle)[-1] - angle + np.asarray(found.error)
    return AsMade(
        fluctuation=float(peak(ratio) + peak(-ratio)),
        angle_error=0.5 * float(peak(angle_error) + peak(-angle_error)),
    )


def made(drive: Drive) -> AsMade | str:
    """Return how a drive turns with the errors of its joints as made, or why that is not told.

    drive: with measured errors.
    """
    try:
        found = as_made(drive)
    except InputError as error:
        return error.problems[0].message
    return _("with them a joint cannot be assembled at every position") if found is None else found
