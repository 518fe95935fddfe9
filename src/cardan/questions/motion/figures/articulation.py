"""How a moving drive bends, slides and turns, over time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Band, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.equivalence import WARN_JOINT_ANGLE
from cardan.texts import _
from cardan.units import deg, mm


def articulation_figures(found: Articulation) -> tuple[Figure, ...]:
    """Return the figures of a moving drive."""
    sliding = (sliding_figure(found),) if any(one.slides for one in found.splines) else ()
    return (joint_angles_figure(found), *sliding)


def joint_angles_figure(found: Articulation) -> Figure:
    """Return bends and unevenness over time."""
    times = np.asarray(found.times)
    joint_angle = np.asarray(found.joint_angle) / deg
    share = 100.0 * np.asarray(found.speed_fluctuation)
    moving = 100.0 * np.asarray(found.moving_speed_fluctuation)
    known = bool(np.any(np.isfinite(moving)))
    curves: list[Series] = [
        Curve(
            x=times,
            y=joint_angle[:, k],
            role=shaft(k + 2),
            dash=dash_of(k + 2),
            label=_("joint {number}").format(number=k + 1),
        )
        for k in range(joint_angle.shape[1])
    ]
    if np.nanmax(joint_angle) > 0.9 * WARN_JOINT_ANGLE:
        curves.append(
            Rule(
                value=WARN_JOINT_ANGLE,
                text=say(
                    _("no real cross joint works above {limit}"),
                    limit=Quantity(WARN_JOINT_ANGLE * deg, "angle", trim=True),
                ),
                role="warning",
            )
        )
    uneven: list[Series] = [
        Curve(x=times, y=share, role="accent", width=2.0, label=_("δ of the output, each instant standing still"))
    ]
    if known:
        uneven.append(
            Curve(
                x=times,
                y=moving,
                role="first order",
                width=1.3,
                dash="dashed",
                label=_("the same, articulation rate included"),
            )
        )
    widest = foremost_of((one for one in found.worst if one.what == "joint_angle"), lambda one: one.value)
    return Figure(
        name="joint_angles",
        title=_("Joint angles and speed fluctuation while the drive moves"),
        sentence=say(
            _("Joint {joint} has the largest joint angle, up to {angle}."),
            joint=widest.number,
            angle=Quantity(widest.value, "angle", decimals=2),
        ),
        source=_("Axes and spins follow from the moving joint centres at every instant, exactly; no small angles"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(curves),
                        x=_time(times),
                        y=axis(_("Joint angle"), "deg", [joint_angle], dimension="angle", include=(0.0,), least=0.1),
                    ),
                ),
                height=1.6,
            ),
            Row(
                panels=(
                    Panel(
                        series=tuple(uneven),
                        x=_time(times, named=True),
                        y=axis(
                            _("Speed fluctuation of the output"),
                            "percent",
                            [share, moving] if known else [share],
                            dimension="share",
                            include=(0.0,),
                            least=0.01,
                            count=4,
                        ),
                    ),
                ),
                height=1.3,
            ),
        ),
    )


def sliding_figure(found: Articulation) -> Figure:
    """Return how far the shafts slide, over time."""
    times = np.asarray(found.times)
    ones = [one for one in found.splines if one.slides]
    curves: list[Series] = [Rule(value=0.0, dash="solid", role="faint")]
    ways: list[Array] = []
    for one in ones:
        way = (np.asarray(found.length)[:, one.shaft - 1] - one.drawn) / mm
        ways.append(way)
        curves.append(
            Curve(
                x=times,
                y=way,
                role=shaft(one.shaft),
                dash=dash_of(one.shaft),
                width=1.8,
                label=_("shaft {number}").format(number=one.shaft),
            )
        )
    bands: list[Series] = [
        Band(low=start, high=end, upright=True, role="failed", opacity=0.12)
        for one in ones
        for flag in one.flags
        for start, end in flag.spans
    ]
    longest = foremost_of(ones, lambda one: one.stroke)
    return Figure(
        name="sliding",
        title=_("Length compensation"),
        sentence=say(
            _("Shaft {number} slides over a stroke of {stroke}, at up to {rate}."),
            number=longest.shaft,
            stroke=Quantity(longest.stroke, "length", 3),
            rate=Quantity(longest.max_rate, "speed", 3, unit="mm_s"),
        ),
        source=_("L = |B(i) − B(i−1)| and its exact derivatives along the movement"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=(*bands, *curves),
                        x=_time(times, named=True),
                        y=axis(
                            _("Length over the drawn one"), "mm", ways, dimension="length", include=(0.0,), least=0.1
                        ),
                    ),
                ),
                height=1.5,
            ),
        ),
    )


def _time(times: Array, *, named: bool = False) -> Axis:
    made = axis(
        _("time") if named else "",
        "s" if named else "",
        [times],
        dimension="time" if named else "",
        margin=0.0,
        count=8,
    )
    return replace(made, timed=True)
