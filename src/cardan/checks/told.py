"""What a verdict tells of the way it was reached: at which speed, and by which limit where a rule goes too far."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import rpm, thousands

from .design import Design


def turning(speed: float) -> str:
    """Return a speed [rad/s] in whole turns a minute, as people read it.

    Examples
    --------
    >>> turning(1800 * rpm)
    '1\u202f800'
    """
    return thousands(speed / rpm)


def at_top_speed(design: Design) -> str:
    """Return at which speed one drive is judged where that is not the speed of its duty; else nothing.

    Examples
    --------
    >>> from cardan.drive.drive import Drive
    >>> from cardan.drive.duty import Duty
    >>> duty = Duty(speed=1500 * rpm, speed_range=(500 * rpm, 1800 * rpm))
    >>> at_top_speed(Design(drive=Drive.from_angles([0.1]), duty=duty))
    'at 1\u202f800 rpm'
    """
    top, own = design.top_speed, design.duty.speed
    if top is None or np.ndim(top) or (own is not None and float(top) <= abs(own) * (1.0 + 1e-9)):
        return ""
    return _("at {speed} rpm").format(speed=turning(float(top)))


def bendable(design: Design, allowed: Array) -> tuple[Array, str]:
    """Return the bend that a rule allows, no more than joints of such kinds can bend, and a word on it.

    Parameters
    ----------
    design : Design
    allowed : array (...) [rad]
    """
    most = min(joint.steepest for joint in design.drive.joints)
    note = _("joints of this kind reach no larger angle") if np.all(allowed > most) else ""
    return np.minimum(allowed, most), note


def joined(parts: Iterable[str]) -> str:
    """Return the parts of a note that say something.

    Examples
    --------
    >>> joined(["at 1 rpm", "", "while the drive moves"])
    'at 1 rpm; while the drive moves'
    """
    return "; ".join(part for part in parts if part)
