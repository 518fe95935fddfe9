"""Page 2: the drive as it was understood, with all that its file gives."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers import answer
from cardan.answers.answer import Cell, Column
from cardan.answers.palette import colour, shaft
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.reader import half_turn
from cardan.catalogue.given import inputs, sources
from cardan.drive.body import body_length
from cardan.drive.conditions import held_speeds, used_speeds
from cardan.drive.joints.joint import Inside
from cardan.figures.drive import views_figure, yoke_figure
from cardan.maths.arrays import Array
from cardan.questions.motion.kinds import inside, kind_name, steep
from cardan.texts import _, plural
from cardan.units import deg

from .block import Block, Page, Picture, Points, Table, Words, table
from .subject import Subject


def description(on: Subject) -> Page:
    """Return the page that lets the reader check that this is the drive meant."""
    count = plural("{n} joint", "{n} joints", on.joints).format(n=on.joints)
    form = {
        "points": _("the joint centres"),
        "angles": _("joint angles and plane twists"),
        "slopes": _("slopes in side and plan view"),
    }[on.drive.form]
    blocks: list[Block] = [Picture(figure=views_figure(on.drive, on.seen)), _joints(on), _shafts(on)]
    within = list(inside(on.drive))
    if within:
        blocks.append(_inside(within))
    blocks += [table(one) for one in inputs(on.drive, on.known)]
    where = list(sources(on.drive, on.known))
    if where:
        blocks.append(Points(title=_("Sources of what the catalogue fills in"), items=where))
    if on.joints > 1:
        blocks.append(Picture(figure=yoke_figure(on.drive, on.seen)))
    assumed = list(_assumed(on))
    if assumed:
        blocks.append(Points(title=_("Assumed where the file does not say otherwise"), items=assumed))
    return Page(
        name="drive",
        title=_("The drive as understood"),
        answer=_("{count}, {shafts} shafts, described by {form}.").format(
            count=count[:1].upper() + count[1:], shafts=on.joints + 1, form=form
        ),
        blocks=blocks,
    )


def signs() -> Words:
    """Return by which signs angles are told."""
    return Words(
        title=_("Signs"),
        text=_(
            "z points up, shafts run along the power flow. All turns about a shaft are positive clockwise for an "
            "observer who looks along the power flow. The yoke angle γ of a shaft runs from its driving yoke "
            "(output end) to its driven yoke (input end); yokes are lines, so angles that differ by 180° are the "
            "same. The initial yoke position ψ of a joint is that of its driving yoke from the plane of the joint."
        ),
    )


def _joints(on: Subject) -> Table:
    centre, joint_angle, joints = np.asarray(on.place.points[1:-1]), on.joint_angle, on.drive.joints
    twist: list[float | None] = [None, *np.asarray(on.place.plane_twist, dtype=float).tolist()]
    angles = [
        Cell(value=float(angle), tone="failed" if steep(joint, k, float(angle)) else "plain")
        for k, (joint, angle) in enumerate(zip(joints, joint_angle, strict=True), start=1)
    ]
    start = [half_turn(float(phase) / deg) * deg for phase in on.phase]
    columns = [Column(key="joint", heading=_("joint"), values=list(range(1, on.joints + 1)))]
    if any(joint.name for joint in joints):
        columns.append(Column(key="name", heading=_("name"), values=[joint.name for joint in joints]))
    if on.mixed:
        columns.append(Column(key="kind", heading=_("kind"), values=[kind_name(joint) for joint in joints]))
    columns += [
        Column(key=axis, heading=axis, values=centre[:, k], dimension="length", decimals=1)
        for k, axis in enumerate("xyz")
    ]
    columns += [
        Column(key="joint_angle", heading=_("joint angle α"), values=angles, dimension="angle", decimals=2),
        Column(key="plane_twist", heading=_("plane twist β"), values=twist, dimension="angle", decimals=2),
        Column(key="initial_phase", heading=_("initial yoke position ψ"), values=start, dimension="angle", decimals=2),
    ]
    return table(answer.Table(title=_("Joints"), columns=columns, note=_straight(joint_angle)))


def _straight(joint_angle: Array) -> str:
    """Return a sentence on where straight joints have their planes; nothing where there are none."""
    if not np.any(joint_angle == 0.0):
        return ""
    if len(joint_angle) == 1:
        return _("A straight joint has no plane of its own.")
    if not np.any(joint_angle > 0.0):
        return _("Straight joints have no plane of their own; all are given the same one.")
    if joint_angle[0] == 0.0:
        return _(
            "A straight joint has no plane of its own; it takes that of the joint before, or at the input that of the "
            "first joint that is not straight."
        )
    return _("A straight joint has no plane of its own; it takes that of the joint before.")


def _inside(within: Sequence[tuple[int, Inside]]) -> Table:
    values = [Quantity(one.value, one.dimension or "") for _joint, one in within]
    columns = (
        Column(key="joint", heading=_("joint"), values=[joint for joint, _one in within]),
        Column(key="what", heading=_("what"), values=[one.meaning for _joint, one in within]),
        Column(key="value", heading=_("value"), values=values),
    )
    return table(answer.Table(title=_("Inside the joints"), columns=columns))


def _shafts(on: Subject) -> Table:
    shafts, count = on.drive.shafts, on.joints + 1
    fluctuation: list[float | None] = [None, *np.asarray(on.evenness.shaft_speed_fluctuation, dtype=float).tolist()]
    ends = {1: _("input"), count: _("output")}
    heads = [
        Cell(value=" ".join(part for part in (str(k), ends.get(k, ""), one.name) if part), chip=colour(shaft(k)))
        for k, one in enumerate(shafts, start=1)
    ]
    between = [1 < k < count for k in range(1, count + 1)]
    yokes = [
        _("fixed") if one.yoke_fixed else _("free") if inner else "–"
        for one, inner in zip(shafts, between, strict=True)
    ]
    gamma = [
        half_turn(one.yoke_angle / deg) * deg if inner else None for one, inner in zip(shafts, between, strict=True)
    ]
    columns = [
        Column(key="shaft", heading=_("shaft"), values=heads, left=True),
        Column(key="length", heading=_("length"), values=_lengths(on), dimension="length", decimals=1),
        Column(key="yoke_angle", heading=_("yoke angle γ"), values=gamma, dimension="angle", decimals=2),
        Column(key="yokes", heading=_("yokes"), values=yokes),
    ]
    if any(one.spline is not None for one in shafts):
        teeth = [one.spline.teeth if one.spline else None for one in shafts]
        columns.append(Column(key="spline_teeth", heading=_("spline teeth"), values=teeth))
    text = _("speed fluctuation δ")
    columns.append(Column(key="speed_fluctuation", heading=text, values=fluctuation, dimension="share", digits=3))
    return table(answer.Table(title=_("Shafts"), columns=columns))


def _lengths(on: Subject) -> list[float | Cell | None]:
    """Return the lengths of the shafts, those that are assumed in brackets."""
    found: list[float | Cell | None] = []
    for k, one in enumerate(on.drive.shafts):
        length = float(on.place.length[k])
        if k in (0, on.joints):
            found.append(body_length(one, None))
        elif f"shafts[{k}].length" in on.place.assumed:
            found.append(Cell(value=length, before="(", after=")"))
        else:
            found.append(length)
    return found


def _assumed(on: Subject) -> Iterator[Text]:
    between = {f"shafts[{k}].length" for k in range(1, on.joints)} & set(on.place.assumed)
    if between:
        yield plural(
            "Length of {count} shaft, for the drawing only: motion does not depend on it (in brackets).",
            "Lengths of {count} shafts, for the drawing only: motion does not depend on them (in brackets).",
            len(between),
        ).format(count=len(between))
    still = [k for k, one in enumerate(on.drive.shafts[1:-1], start=2) if one.yoke_angle == 0.0]
    if still:
        yield plural(
            "Yoke angle 0° (the default) of shaft {numbers}.",
            "Yoke angle 0° (the default) of shafts {numbers}.",
            len(still),
        ).format(numbers=", ".join(map(str, still)))
    if on.drive.input.start_phase == 0.0:
        yield _(
            "Start phase 0° (the default): at the start the driving yoke of joint 1 lies in the plane of the joint."
        )
    speed = on.drive.duty.speed
    if used_speeds(on.drive.duty) is None:
        yield _("No input speed: accelerations are given over its square.")
    elif speed is not None and on.drive.duty.acceleration == 0.0 and len(held_speeds(on.drive.duty)) < 2:
        yield say(_("The input turns at a constant {speed}."), speed=Quantity(speed, "angular_speed"))
    if on.drive.input.point is None and any(body_length(on.drive.shafts[k], None) is None for k in (0, -1)):
        yield _("Sizes of yokes, crosses and tubes, and lengths of the end shafts, in the drawings.")
    else:
        yield _("Sizes of yokes, crosses and tubes in the drawings.")
