"""Kinds of joints in words."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.common.inside import Inside
from cardan.drive.models.chain import given_chain
from cardan.figures.wording import significant
from cardan.texts import _
from cardan.units import deg, factor, label, preferred

from .joint_inside import joint_inside


def kind_name(joint: Joint) -> str:
    """Return the kind of a joint in words.

    Examples
    --------
    >>> from cardan.drive.joints import Hooke
    >>> kind_name(Hooke())
    'Hooke'
    """
    return joint.in_words()


def too_steep(joint: Joint, number: int, bend: float) -> str:
    """Return what to say of a joint that bends more than one of its kind can, "" where it does not.

    Parameters
    ----------
    joint : Joint
    number : int
        Its number.
    bend : float [rad]

    Examples
    --------
    >>> from cardan.drive.joints import Hooke, Tripod
    >>> too_steep(Hooke(), 1, 0.5), too_steep(Tripod(), 2, 0.5)
    ('', 'Joint 2 bends 28.6°; above 26° no real joint of its kind, tripod, works.')
    """
    if bend <= joint.steepest * (1.0 + 1e-12):
        return ""
    text = _("Joint {number} bends {bend:.1f}°; above {limit:g}° no real joint of its kind, {kind}, works.")
    if joint.single_cross:
        text = _("Joint {number} bends {bend:.1f}°; above {limit:g}° no real cross joint works.")
    return text.format(number=number, bend=bend / deg, limit=round(joint.steepest / deg, 6), kind=kind_name(joint))


def figure_of(one: Inside) -> tuple[float, str]:
    """Return a figure of the inside of a joint in the unit people read it in, and that unit."""
    if one.dimension is None:
        return one.value, ""
    unit = preferred(one.dimension)
    return one.value / factor(one.dimension, unit), label(unit) if unit != "deg" else "°"


def inside(drive: Drive) -> Iterator[tuple[int, Inside]]:
    """Yield what else moves inside the joints of a drive, with the number of the joint."""
    bends = given_chain(drive).bend.tolist()
    for number, (joint, bend) in enumerate(zip(drive.joints, bends, strict=True), start=1):
        for one in joint_inside(joint, bend):
            yield number, one


def beside_turning(drive: Drive) -> Iterator[str]:
    """Yield in a sentence each what else moves inside the joints of a drive."""
    for number, one in inside(drive):
        value, unit = figure_of(one)
        space = "" if unit in ("°", "") else " "
        yield _("Joint {number}: {title}, {value}{space}{unit}.").format(
            number=number, title=one.meaning, value=significant(value, 3), space=space, unit=unit
        )
