"""Page 2: the drive as it was understood."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.drive.body import body_length
from cardan.drive.joints.common.inside import Inside
from cardan.figures.drive import space_figure, views_figure, yoke_figure
from cardan.figures.wording import fixed, half_turn, percent, significant
from cardan.maths.arrays import Array
from cardan.questions.motion.kinds import figure_of, inside, kind_name, too_steep
from cardan.texts import _, plural
from cardan.units import deg, mm, rpm

from .block import Block, Cell, Column, Page, Picture, Points, Table, Words, number, of_shaft, words
from .subject import Subject


def understood(on: Subject) -> Page:
    """Return the page that lets the reader check that this is the drive meant."""
    count = plural("{n} joint", "{n} joints", on.joints).format(n=on.joints)
    form = {
        "points": _("the joint centres"),
        "angles": _("bends and plane twists"),
        "slopes": _("slopes in side and plan view"),
    }[on.drive.form]
    blocks: list[Block] = [
        Picture(figure=views_figure(on.drive, on.seen)),
        Picture(figure=space_figure(on.drive, on.seen)),
        _joints(on),
        _shafts(on),
    ]
    told = list(inside(on.drive))
    if told:
        blocks.append(_inside(told))
    if on.joints > 1:
        blocks.append(Picture(figure=yoke_figure(on.drive, on.seen)))
    blocks.append(
        Words(
            title=_("Signs"),
            text=_(
                "z points up, shafts run along the power flow. All turns about a shaft are positive clockwise for an "
                "observer who looks along the power flow. The yoke angle γ of a shaft runs from its driving yoke "
                "(output end) to its driven yoke (input end); yokes are lines, so angles that differ by 180° are the "
                "same. A joint's phase angle ψ is that of its driving yoke from the plane of the joint at the start."
            ),
        )
    )
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


def _joints(on: Subject) -> Table:
    centre = np.asarray(on.place.points[1:-1]) / mm
    bend = on.bend / deg
    twist = np.asarray(on.place.plane_twist) / deg
    phase = np.asarray(on.phase) / deg
    named = any(joint.name for joint in on.drive.joints)
    rows: list[list[Cell]] = []
    for k, joint in enumerate(on.drive.joints):
        steep = bool(too_steep(joint, k + 1, float(on.bend[k])))
        rows.append(
            [
                words(str(k + 1)),
                *([words(joint.name)] if named else []),
                *([words(kind_name(joint))] if on.mixed else []),
                *(number(fixed(float(x), 1), float(x)) for x in centre[k]),
                number(fixed(float(bend[k])), float(bend[k]), "failed" if steep else "plain"),
                number(fixed(float(twist[k - 1])), float(twist[k - 1])) if k else words("–"),
                number(fixed(half_turn(float(phase[k]))), half_turn(float(phase[k]))),
            ]
        )
    return Table(
        title=_("Joints"),
        columns=(
            Column(heading=_("joint")),
            *([Column(heading=_("name"), left=True)] if named else []),
            *([Column(heading=_("kind"), left=True)] if on.mixed else []),
            Column(heading="x", unit="mm"),
            Column(heading="y", unit="mm"),
            Column(heading="z", unit="mm"),
            Column(heading=_("bend α"), unit="°"),
            Column(heading=_("plane twist β"), unit="°"),
            Column(heading=_("phase angle ψ"), unit="°"),
        ),
        rows=rows,
        note=_straight(bend),
    )


def _straight(bend: Array) -> str:
    """Return a sentence on where straight joints have their planes; nothing where there are none."""
    if not np.any(bend == 0.0):
        return ""
    if len(bend) == 1:
        return _("A joint of bend 0 has no plane of its own.")
    if not np.any(bend > 0.0):
        return _("Joints of bend 0 have no plane of their own; all are given the same one.")
    if bend[0] == 0.0:
        return _(
            "A joint of bend 0 has no plane of its own; it takes that of the joint before, or at the input that of the "
            "first bent joint."
        )
    return _("A joint of bend 0 has no plane of its own; it takes that of the joint before.")


def _inside(told: Sequence[tuple[int, Inside]]) -> Table:
    rows: list[list[Cell]] = []
    for joint, one in told:
        value, unit = figure_of(one)
        rows.append([words(str(joint)), words(one.meaning), number(significant(value), value), words(unit)])
    return Table(
        title=_("Inside the joints"),
        columns=(
            Column(heading=_("joint")),
            Column(heading=_("what"), left=True),
            Column(heading=_("value")),
            Column(heading="", left=True),
        ),
        rows=rows,
    )


def _shafts(on: Subject) -> Table:
    length = np.asarray(on.place.length) / mm
    uneven = np.asarray(on.whole.shaft_irregularity)
    rows: list[list[Cell]] = []
    splined = any(shaft.spline is not None for shaft in on.drive.shafts)
    for k, shaft in enumerate(on.drive.shafts, start=1):
        between = 1 < k <= on.joints
        gamma = half_turn(shaft.yoke_angle / deg)
        teeth = shaft.spline.teeth if shaft.spline else None
        rows.append(
            [
                of_shaft(k, shaft.name, end=_("input") if k == 1 else _("output") if k == on.joints + 1 else ""),
                _length(float(length[k - 1]), f"shafts[{k - 1}].length" in on.place.assumed)
                if between
                else _end_length(body_length(shaft, None)),
                number(fixed(gamma), shaft.yoke_angle / deg) if between else words("–"),
                words(_("held") if shaft.yoke_fixed else _("free") if between else "–"),
                *([words(str(teeth) if teeth else "–")] if splined else []),
                number(percent(float(uneven[k - 2])).removesuffix(" %"), 100.0 * float(uneven[k - 2]))
                if k > 1
                else words("–"),
            ]
        )
    return Table(
        title=_("Shafts"),
        columns=(
            Column(heading=_("shaft"), left=True),
            Column(heading=_("length"), unit="mm"),
            Column(heading=_("yoke angle γ"), unit="°"),
            Column(heading=_("yokes")),
            *([Column(heading=_("spline teeth"))] if splined else []),
            Column(heading=_("irregularity δ"), unit="%"),
        ),
        rows=rows,
    )


def _length(value: float, assumed: bool) -> Cell:
    text = fixed(value, 1)
    return number(f"({text})" if assumed else text, value)


def _end_length(given: float | None) -> Cell:
    return words("–") if given is None else _length(given / mm, assumed=False)


def _assumed(on: Subject) -> Iterator[str]:
    between = {f"shafts[{k}].length" for k in range(1, on.joints)} & set(on.place.assumed)
    if between:
        yield plural(
            "Length of {count} shaft, for the drawing only: motion does not depend on it (in brackets).",
            "Lengths of {count} shafts, for the drawing only: motion does not depend on them (in brackets).",
            len(between),
        ).format(count=len(between))
    still = [k for k, shaft in enumerate(on.drive.shafts[1:-1], start=2) if shaft.yoke_angle == 0.0]
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
    if speed is None:
        yield _("No input speed: accelerations are given over its square.")
    elif on.drive.duty.acceleration == 0.0:
        yield _("The input turns at a constant {speed} rpm.").format(speed=significant(speed / rpm))
    if on.drive.input.point is None and any(body_length(on.drive.shafts[k], None) is None for k in (0, -1)):
        yield _("Sizes of yokes, crosses and tubes, and lengths of the end shafts, in the drawings.")
    else:
        yield _("Sizes of yokes, crosses and tubes in the drawings.")
