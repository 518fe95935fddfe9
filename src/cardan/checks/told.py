"""What a verdict tells of the way it was reached: at which speed, and by which limit where a rule goes too far."""

from __future__ import annotations

import numpy as np

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.maths.arrays import Array
from cardan.texts import _

from .design import Design


def turning(speed: float) -> Quantity:
    """Return a speed [rad/s] as people read it, in whole turns a minute.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.units import rpm
    >>> turning(1800 * rpm).told(USUAL)
    '1\u202f800 rpm'
    """
    return Quantity(speed, "angular_speed", decimals=0)


def at_top_speed(design: Design) -> Text:
    """Return at which speed one drive is judged where that is not the speed of its duty; else nothing.

    >>> from cardan.answers.quantity import told
    >>> from cardan.answers.reader import USUAL
    >>> from cardan.drive.drive import Drive
    >>> from cardan.drive.duty import Duty
    >>> from cardan.units import rpm
    >>> duty = Duty(speed=1500 * rpm, speed_range=(500 * rpm, 1800 * rpm))
    >>> told(at_top_speed(Design(drive=Drive.from_angles([0.1]), duty=duty)), USUAL)
    'at 1\u202f800 rpm'
    """
    top, own = design.top_speed, design.duty.speed
    if top is None or np.ndim(top) or (own is not None and float(top) <= abs(own) * (1.0 + 1e-9)):
        return ""
    return say(_("at {speed}"), speed=turning(float(top)))


def as_drawn(design: Design) -> str:
    """Return that a drive that moves is judged as drawn, where its joints turn by laws of their own; else nothing."""
    return _("as drawn, not while the drive moves") if design.swing is not None and design.drive.movements else ""


def bendable(design: Design, allowed: Array) -> tuple[Array, str]:
    """Return the joint angle that a rule allows, no more than joints of such kinds can reach, and a word on it.

    allowed (...) [rad].
    """
    most = min(joint.steepest for joint in design.drive.joints)
    note = _("joints of this kind reach no larger angle") if np.all(allowed > most) else ""
    return np.minimum(allowed, most), note


def joined(*parts: Text) -> Text:
    """Return the parts of a note that say something.

    >>> joined("at speed", "", "while the drive moves").parts
    ['at speed', 'while the drive moves']
    >>> joined("", "while the drive moves")
    'while the drive moves'
    """
    said = [part for part in parts if part]
    return Joined(said, between="; ") if len(said) > 1 else said[0] if said else ""
