"""What gives way along the shafts where the end of a wobbling shaft swivels in its next joint.

A pin that runs around draws its shaft nearer and lets it go, twice a turn. The next joint then keeps its distance from
the pin, or a spline or a joint that plunges keeps the distance of both joints. Which shafts move along themselves is
said by splines, by joints that plunge and by the supports that hold along.
"""

from __future__ import annotations

from enum import Enum

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths

from .machine_held import SAME, cuts_before, machine_held, segment_of

__all__ = ["Way", "gives_way", "swivels_at_next"]


class Way(Enum):
    """What gives way along the shafts while a shaft wobbles."""

    BETWEEN = "between"  # a spline on the shaft, or a joint at its ends that plunges: both joints stay where they are
    AHEAD = "ahead"  # the shaft behind its next joint slides along itself
    BACK = "back"  # the driving shaft does
    BOUND = "bound"  # nothing: both neighbours are held along
    OPEN = "open"  # nobody says


def swivels_at_next(drive: Drive, i: int) -> bool:
    """Tell whether the shaft behind joint i, from 0, wobbles about its next joint, that no ball of its own carries."""
    length = known_lengths(drive).get(i + 2)
    joint = drive.joints[i]
    if i + 1 >= len(drive.joints) or not joint.wobbles or length is None:
        return False
    held = joint.held(length)
    return held is not None and abs(float(held) / length - 1.0) <= SAME


def gives_way(drive: Drive, i: int) -> Way:
    """Return what gives way along the shafts where the shaft behind joint i, from 0, swivels in its next joint."""
    if drive.shafts[i + 1].spline is not None or _plunges(drive, i) or _plunges(drive, i + 1):
        return Way.BETWEEN
    if not drive.supports or len(known_lengths(drive)) < len(drive.joints) - 1:
        return Way.OPEN
    part = cuts_before(drive, i + 2)
    along = [one.shaft for one in machine_held(drive).supports if one.axial and segment_of(drive, one) == part]
    back, ahead = (any((number >= i + 2) is behind for number in along) for behind in (False, True))
    if back and ahead:
        return Way.BOUND
    if back and _free_ahead(drive, i + 3):
        return Way.AHEAD
    if ahead and _free_back(drive, i + 1):
        return Way.BACK
    return Way.OPEN


def _free_ahead(drive: Drive, number: int) -> bool:
    """Tell whether a shaft can slide along itself without moving what is behind it; it must not wobble itself."""
    if drive.joints[number - 2].wobbles:
        return False
    last = number == len(drive.shafts)
    return last or drive.shafts[number - 1].spline is not None or _plunges(drive, number - 1)


def _free_back(drive: Drive, number: int) -> bool:
    """Tell whether a shaft can slide along itself without moving what is before it; it must not wobble itself."""
    if number == 1:
        return True
    if drive.joints[number - 2].wobbles:
        return False
    return drive.shafts[number - 1].spline is not None or _plunges(drive, number - 2)


def _plunges(drive: Drive, i: int) -> bool:
    return drive.joints[i].slides or drive.joints[i].loose
