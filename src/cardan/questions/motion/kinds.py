"""Kinds of joints in words."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.answer import Remark
from cardan.answers.quantity import Quantity, Say, say
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.models.chain import given_chain
from cardan.texts import _

from .joint_inside import Inside, joint_inside


def kind_name(joint: Joint) -> str:
    """Return the kind of a joint in words.

    Examples
    --------
    >>> from cardan.drive.joints import Hooke
    >>> kind_name(Hooke())
    'Hooke'
    """
    names = {
        "hooke": _("Hooke"),
        "offset_cross": _("offset cross"),
        "double_cardan": _("double cardan"),
        "constant_velocity": _("constant velocity"),
        "tracta": _("Tracta"),
        "rzeppa": _("Rzeppa"),
        "weiss": _("Weiss"),
        "tripod": _("tripod"),
        "half_cardan": _("half-cardan"),
        "elastic_half_cardan": _("elastic half-cardan"),
        "pin_coupling": _("pin coupling"),
        "clemens": _("Clemens"),
    }
    return names[joint.kind]


def steep(joint: Joint, number: int, bend: float) -> Say | None:
    """Return what to say of a joint at a greater joint angle than one of its kind reaches, None where it is not.

    Parameters
    ----------
    joint : Joint
    number : int
        Its number.
    bend : float [rad]
        Its joint angle.
    """
    if bend <= joint.steepest * (1.0 + 1e-12):
        return None
    text = _("joint {number} has a joint angle of {angle}; above {limit} no real joint of its kind, {kind}, works.")
    if joint.kind == "hooke":
        text = _("joint {number} has a joint angle of {angle}; above {limit} no real cross joint works.")
    return say(
        text,
        number=number,
        angle=Quantity(bend, "angle", decimals=1),
        limit=Quantity(joint.steepest, "angle", 6, trim=True),
        kind=kind_name(joint),
    )


def too_steep(joint: Joint, number: int, bend: float) -> str:
    """Return the same in words, in the usual units; "" where there is nothing to say.

    Examples
    --------
    >>> from cardan.drive.joints import Hooke, Tripod
    >>> too_steep(Hooke(), 1, 0.5), too_steep(Tripod(), 2, 0.5)
    ('', 'Joint 2 has a joint angle of 28.6°; above 26° no real joint of its kind, tripod, works.')
    """
    found = steep(joint, number, bend)
    said = "" if found is None else found.told(USUAL)
    return said[:1].upper() + said[1:]


def steep_joints(drive: Drive) -> Iterator[Remark]:
    """Yield a warning for every joint at a greater joint angle than one of its kind reaches."""
    for number, (joint, bend) in enumerate(zip(drive.joints, given_chain(drive).bend, strict=True), start=1):
        found = steep(joint, number, float(bend))
        if found is not None:
            yield Remark(text=say(_("Warning: {what}"), what=found), tone="warning")


def inside(drive: Drive) -> Iterator[tuple[int, Inside]]:
    """Yield what else moves inside the joints of a drive, with the number of the joint."""
    bends = given_chain(drive).bend.tolist()
    for number, (joint, bend) in enumerate(zip(drive.joints, bends, strict=True), start=1):
        for one in joint_inside(joint, bend):
            yield number, one


def beside_turning(drive: Drive) -> Iterator[Say]:
    """Yield in a sentence each what else moves inside the joints of a drive."""
    for number, one in inside(drive):
        text = _("Joint {number}: {title}, {value}.")
        yield say(text, number=number, title=one.meaning, value=one.quantity(3))
