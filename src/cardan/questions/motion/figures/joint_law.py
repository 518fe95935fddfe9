"""Joints of any kind by themselves: over a turn at one joint angle, and over bends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, Say, say
from cardan.figures.axes import angle_axis, axis
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule
from cardan.maths.arrays import Array
from cardan.questions.motion.joint_law import JointAngles, JointTurn
from cardan.texts import _
from cardan.units import deg

WIDTHS = (2.2, 1.5)
"""Of the first curve and of the others."""


def joint_figures(
    turns: Sequence[JointTurn], joint_angles: Sequence[JointAngles], labels: Sequence[str] = ()
) -> tuple[Figure, ...]:
    """Return the figures of joints by themselves."""
    return (joint_figure(turns, joint_angles, labels),)


def joint_figure(turns: Sequence[JointTurn], joint_angles: Sequence[JointAngles], labels: Sequence[str] = ()) -> Figure:
    """Return error and ratio of joints over a turn, and their errors over the bend.

    turns: at least one; all at one bend.
    labels: what they are called; their kinds when not given.
    """
    names = tuple(labels) or tuple(one.joint.kind for one in turns)
    angle_errors = [np.asarray(one.angle_error) / deg for one in turns]
    ratios = [np.asarray(one.ratio) for one in turns]
    angle = np.asarray(turns[0].angle) / deg
    whole = angle_axis(_("Input angle from the plane of the shafts"))
    bare = Axis(low=whole.low, high=whole.high, ticks=whole.ticks, texts=("",) * len(whole.ticks))
    errors = [np.asarray(one.error) / deg for one in joint_angles]
    widest = max(float(np.max(one.joint_angle)) for one in joint_angles) / deg
    curves = [
        Curve(x=np.asarray(one.joint_angle) / deg, y=error, role=shaft(k), dash=dash_of(k), width=_width(k))
        for k, (one, error) in enumerate(zip(joint_angles, errors, strict=True), start=1)
    ]
    return Figure(
        name="joint",
        title=say(
            _("How joints turn at {angle} and over their joint angles"),
            angle=Quantity(turns[0].joint_angle, "angle", 3),
        ),
        sentence=_sentence(turns, names),
        source=_("exact law of each kind; error: half of what lies between the greatest lead and the greatest lag"),
        rows=(
            Row(
                panels=(_panel(angle, angle_errors, bare, _("Output ahead of input"), "deg", 0.0, 0.02, names),),
                height=1.5,
            ),
            Row(panels=(_panel(angle, ratios, whole, _("Speed ratio"), "–", 1.0, 0.002),), height=1.5),
            Row(
                panels=(
                    Panel(
                        series=(
                            *curves,
                            Rule(value=turns[0].joint_angle / deg, upright=True, text=_("angle of the turn")),
                        ),
                        x=axis(_("Joint angle"), "deg", dimension="angle", include=(0.0, widest), count=8, margin=0.0),
                        y=axis(
                            _("Angle error of the output"),
                            "deg",
                            errors,
                            dimension="angle",
                            include=(0.0,),
                            least=0.02,
                            count=4,
                        ),
                    ),
                ),
                height=1.5,
            ),
        ),
    )


def _width(k: int) -> float:
    return WIDTHS[0] if k == 1 else WIDTHS[1]


def _panel(
    angle: Array,
    rows: Sequence[Array],
    along: Axis,
    label: str,
    unit: str,
    middle: float,
    least: float,
    names: Sequence[str] = (),
) -> Panel:
    curves = tuple(
        Curve(
            x=angle,
            y=row,
            label=names[k - 1] if names else "",
            role=shaft(k),
            dash=dash_of(k),
            width=_width(k),
        )
        for k, row in enumerate(rows, start=1)
    )
    upright = axis(
        label, unit, list(rows), dimension="angle" if unit == "deg" else "", include=(middle,), least=least, count=4
    )
    return Panel(series=(Rule(value=middle, dash="solid", role="faint"), *curves), x=along, y=upright)


def _sentence(turns: Sequence[JointTurn], names: Sequence[str]) -> Say:
    """Return which joint has the least angle error, where several do not turn alike; what it is of one alone."""
    order = sorted(range(len(turns)), key=lambda k: turns[k].error)
    best, worst, at = order[0], order[-1], Quantity(turns[0].joint_angle, "angle", 3)
    if len(turns) == 1:
        text = _("At {angle} the {name} joint turns exactly uniformly.")
        if turns[0].error:
            text = _("At {angle} the output of the {name} joint has an angle error of ±{error}.")
        return say(text, angle=at, name=names[0], error=Quantity(turns[0].error, "angle", 3))
    if not turns[worst].error:
        return say(_("At {angle} all of them turn exactly uniformly."), angle=at)
    return say(
        _("At {angle} {worst} has the largest angle error, ±{most}, and {best} the least, ±{least}."),
        angle=at,
        worst=names[worst],
        best=names[best],
        most=Quantity(turns[worst].error, "angle", 3),
        least=Quantity(turns[best].error, "angle", 3),
    )
