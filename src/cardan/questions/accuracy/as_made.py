"""How a drive turns with the errors of its joints as made: the motion of the perfect drive and what they add."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.maths.curves.peaks import peak
from cardan.questions.motion.motion import motion

from .accuracy import transmission_error


@dataclass(frozen=True, kw_only=True)
class AsMade:
    """How the output of a drive turns with the errors of its joints.

    Attributes
    ----------
    fluctuation : float
        Speed fluctuation δ of the output, largest less smallest speed over that of the input.
    angle_error : float [rad]
        Angle error of the output, half of its largest less its smallest lead over the input.
    """

    fluctuation: float
    angle_error: float


def as_made(drive: Drive) -> AsMade | None:
    """Return how a drive turns with the errors of its joints as made; None where a joint cannot be assembled.

    Parameters
    ----------
    drive : Drive
        Of Hooke joints, with measured errors.

    Returns
    -------
    AsMade or None

    Raises
    ------
    InputError
        Joints of such a kind that their errors cannot be told.

    Notes
    -----
    φ_out(φ) = that of the perfect drive + e(φ), e as `transmission_error` has it exactly; its slope by Fourier's series
    over the turn.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan.drive.accuracy import Error
    >>> from cardan.units import deg
    >>> drive = Drive.from_angles([10 * deg, 10 * deg])
    >>> skew = replace(drive.joints[0], error=Error(alpha1=0.1 * deg))
    >>> found = as_made(replace(drive, joints=(skew, drive.joints[1])))
    >>> print(f"{100 * found.fluctuation:.4f} %")
    0.0615 %
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
