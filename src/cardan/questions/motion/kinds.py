"""Kinds of joints in words."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from operator import itemgetter

from cardan.answers.answer import FILE, Remark
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.joint import Inside
from cardan.drive.models.floating import Way
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.models.wobble import Wobble, binding, wobbles
from cardan.drive.torsional_layout import has_torsion
from cardan.texts import _, plural

TINY = 1e-9  # way of a joint centre [m] that is rounding


def kind_name(joint: Joint) -> str:
    """Return the kind of a joint in words."""
    return joint.in_words()


def steep(joint: Joint, number: int, joint_angle: float) -> Say | None:
    """Return what to say of a joint at a greater joint angle than one of its kind reaches, None where it is not.

    joint_angle [rad].
    """
    if joint_angle <= joint.steepest * (1.0 + 1e-12):
        return None
    text = _("joint {number} has a joint angle of {angle}; above {limit} no real joint of its kind, {kind}, works.")
    if joint.single_cross:
        text = _("joint {number} has a joint angle of {angle}; above {limit} no real cross joint works.")
    return say(
        text,
        number=number,
        angle=Quantity(joint_angle, "angle", decimals=1),
        limit=Quantity(joint.steepest, "angle", 6, trim=True),
        kind=kind_name(joint),
    )


def steep_joints(drive: Drive) -> Iterator[Remark]:
    """Yield a warning for every joint at a greater joint angle than one of its kind reaches."""
    for number, (joint, joint_angle) in enumerate(
        zip(drive.joints, given_chain(drive).joint_angle, strict=True), start=1
    ):
        found = steep(joint, number, float(joint_angle))
        if found is not None:
            yield Remark(text=say(_("Warning: {what}"), what=found), tone="warning")


def without_vibration(drive: Drive) -> Iterator[Remark]:
    """Yield that torques are those of rigid shafts, of a drive whose torsional vibration could be told."""
    if has_torsion(drive) and drive.duty.speed:
        text = _("Torques are those of rigid shafts; what torsional vibration adds to them is told by:")
        yield Remark(text=text, command=("cardan", "torsion", "response", FILE), code="rigid_shafts")


def inside(drive: Drive) -> Iterator[tuple[int, Inside]]:
    """Yield what else moves inside the joints of a drive, with the number of the joint."""
    joint_angles = given_chain(drive).joint_angle.tolist()
    for number, (joint, joint_angle) in enumerate(zip(drive.joints, joint_angles, strict=True), start=1):
        for one in joint_inside(joint, joint_angle):
            yield number, one


def quantity_of(one: Inside, digits: int = 4) -> Quantity:
    """Return a measure of the inside of a joint as a quantity."""
    return Quantity(one.value, one.dimension or "", digits)


def beside_turning(drive: Drive) -> Iterator[Say]:
    """Yield in a sentence each what else moves inside the joints of a drive."""
    for number, one in inside(drive):
        text = _("Joint {number}: {title}, {value}.")
        yield say(text, number=number, title=one.meaning, value=quantity_of(one, 3))


def made_true(drive: Drive) -> Iterator[Remark]:
    """Yield which joints count as made true, since errors of length are those of cross joints."""
    which = [str(i) for i, joint in enumerate(drive.joints, start=1) if not joint.single_cross]
    if which:
        text = plural(
            "Joint {which} counts as made true: errors of length are those of cross joints.",
            "Joints {which} count as made true: errors of length are those of cross joints.",
            len(which),
        )
        yield Remark(text=say(text, which=Joined(which, last=_(" and "))), code="made_true")


def carried_on(drive: Drive) -> Iterator[Remark]:
    """Yield what shafts that wobble do to the joints behind them."""
    last = len(drive.joints) - 1
    for i, held in groupby(binding(drive), key=itemgetter(0)):
        text = _(
            "Shaft {shaft} would wobble behind joint {joint} as told here, but {supports} on it keep it from that: the "
            "drive binds; take them away or put them where it swivels."
        )
        named = Joined([f"supports[{k}]" for _i, k in held], last=_(" and "))
        yield Remark(text=say(text, shaft=i + 2, joint=i + 1, supports=named), tone="warning", code="binding")
    for one in wobbles(drive):
        text = _("Shaft {shaft} wobbles behind joint {joint}, by ±{angle}.")
        if one.joint < last:
            text = _(
                "Shaft {shaft} wobbles behind joint {joint}, by ±{angle}; joint {next} feels it, and it is counted."
            )
        yield Remark(
            text=say(
                text,
                shaft=one.joint + 2,
                joint=one.joint + 1,
                next=one.joint + 2,
                angle=Quantity(one.nutation, "angle", 3),
            )
        )
        if one.gives is not None and one.slide > TINY:
            yield from _along(one)
        elif one.way > TINY:
            text = _(
                "Joint {joint} is carried around, ±{way}: the bearings of shaft {shaft} must let it follow; a ball or "
                "bearing at the joint itself would keep it in place."
            )
            said = say(text, joint=one.joint + 2, way=Quantity(one.way, "length", 3), shaft=one.joint + 3)
            yield Remark(text=said, tone="warning")


def _along(one: Wobble) -> Iterator[Remark]:
    """Yield what gives way along the shafts as the pin that runs around draws a shaft nearer and lets it go."""
    before, shaft, behind = one.joint + 1, one.joint + 2, one.joint + 3
    values = {"way": Quantity(one.slide, "length", 3), "shaft": shaft}
    if one.gives in (Way.AHEAD, Way.BACK):
        ahead = one.gives is Way.AHEAD
        text = _("Joint {joint} moves ±{way} along shaft {shaft}, which no support holds along.")
        values["shaft"] = behind if ahead else before
        yield Remark(text=say(text, joint=shaft if ahead else before, **values), code="slides")
    elif one.gives is Way.BOUND:
        text = _(
            "Warning: shaft {shaft} has no spline to change its length by ±{way}, and shafts {before} and {behind} are "
            "both held along: the drive binds; it is told as if shaft {shaft} slid."
        )
        said = say(text, before=before, behind=behind, **values)
        yield Remark(text=said, tone="warning", code="binds")
    elif one.gives is Way.OPEN:
        text = _(
            "As shaft {shaft} wobbles, its length between its joints would change by ±{way}; nothing says what slides, "
            "so it counts as if shaft {shaft} did, by a spline."
        )
        yield Remark(text=say(text, **values), code="slides")


# What else moves inside a joint while it turns at a bend: wobble, orbits, strokes, play, planes that are missed.


def joint_inside(joint: Joint, joint_angle: float) -> tuple[Inside, ...]:
    """Return what else moves inside a joint at a joint angle, as far as its sizes are given.

    joint: a joint of any kind; joint_angle [rad]: α in [0, π/2).
    Returns: empty where nothing else moves, or where no size says how much.
    """
    return tuple(joint.inside(joint_angle))
