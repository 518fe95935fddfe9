"""How a moving drive bends, slides and turns, over time."""

from __future__ import annotations

import numpy as np

from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Band, Curve, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import dash_of, shaft
from cardan.figures.wording import fixed, percent, significant
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.equivalence import SYNCHRONOUS, WARN_BEND
from cardan.texts import _
from cardan.units import deg, mm


def articulation_figures(found: Articulation) -> tuple[Figure, ...]:
    """Return the figures of a moving drive."""
    sliding = (sliding_figure(found),) if any(one.slides for one in found.splines) else ()
    return (bends_figure(found), *sliding)


def bends_figure(found: Articulation) -> Figure:
    """Return bends and unevenness over time.

    Parameters
    ----------
    found : Articulation
        A drive over the instants of a movement.
    """
    times = np.asarray(found.times)
    bend = np.asarray(found.bend) / deg
    share = 100.0 * np.asarray(found.irregularity)
    moving = 100.0 * np.asarray(found.moving_irregularity)
    known = bool(np.any(np.isfinite(moving)))
    curves: list[Series] = [
        Curve(
            x=times,
            y=bend[:, k],
            role=shaft(k + 2),
            dash=dash_of(k + 2),
            label=_("joint {number}").format(number=k + 1),
        )
        for k in range(bend.shape[1])
    ]
    if np.nanmax(bend) > 0.9 * WARN_BEND:
        curves.append(
            Rule(
                value=WARN_BEND,
                text=_("no real cross joint works above {limit:g}°").format(limit=WARN_BEND),
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
                label=_("the same, the movement counted"),
            )
        )
    widest = foremost_of((one for one in found.worst if one.what == "bend"), lambda one: one.value)
    uneasy = next(one for one in found.worst if one.what == "irregularity")
    if uneasy.value < SYNCHRONOUS:
        sentence = _("Joint {joint} bends most, up to {bend}°; the output stays even throughout.")
    else:
        sentence = _("Joint {joint} bends most, up to {bend}°; the output is most uneven at {time} s: {share}.")
    return Figure(
        name="bends",
        title=_("Bends and irregularity while the drive moves"),
        sentence=sentence.format(
            joint=widest.number,
            bend=fixed(widest.value / deg, 2),
            time=significant(uneasy.time, 3),
            share=percent(uneasy.value),
        ),
        source=_("Axes and spins follow from the moving joint centres at every instant, exactly; no small angles"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(curves), x=_time(times), y=axis(_("Bend"), "°", [bend], include=(0.0,), least=0.1)
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
                            _("Irregularity of the output"),
                            "%",
                            [share, moving] if known else [share],
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
    """Return how far the shafts slide, over time.

    Parameters
    ----------
    found : Articulation
        A drive over the instants of a movement.
    """
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
        sentence=_("Shaft {number} slides over a stroke of {stroke} mm, at up to {rate} mm/s.").format(
            number=longest.shaft, stroke=significant(longest.stroke / mm, 3), rate=significant(longest.max_rate / mm, 3)
        ),
        source=_("L = |B(i) − B(i−1)| and its exact derivatives along the movement"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=(*bands, *curves),
                        x=_time(times, named=True),
                        y=axis(_("Length over the drawn one"), "mm", ways, include=(0.0,), least=0.1),
                    ),
                ),
                height=1.5,
            ),
        ),
    )


def _time(times: Array, *, named: bool = False) -> Axis:
    made = axis(_("time") if named else "", "s" if named else "", [times], margin=0.0, count=8)
    return made
