"""Variants of a drive over one another: how their outputs turn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.answers.quantity import Quantity, Say, say
from cardan.answers.reader import USUAL
from cardan.errors import refuse
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.figures.palette import dash_of, shaft
from cardan.figures.turning import across
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.motion.motion import Motion
from cardan.texts import _
from cardan.units import deg

NOISE = 1e-12
"""Below this a swing is rounding."""

LONG = 28
"""Letters of a name in the legend."""


def variants_figure(found: Sequence[Motion], names: Sequence[str]) -> Figure:
    """Return speed ratio and angle error of the output of several drives over the input angle.

    found: the motion of each; the n-th has the colour of the n-th shaft.

    >>> from cardan import Drive, motion
    >>> from cardan.units import deg
    >>> even, odd = Drive.from_angles([20 * deg, 20 * deg]), Drive.from_angles([20 * deg])
    >>> variants_figure([motion(even), motion(odd)], ["two joints", "one joint"]).sentence.told(USUAL)
    'two joints turns most uniformly, output angle error ±0°; one joint: ±1.78°.'
    """
    if not found or len(found) != len(names):
        raise refuse("names", _("one name is needed for each drive, and at least one drive"))
    angles = [np.asarray(one.angle) / deg for one in found]
    longest = max(angles, key=lambda angle: float(np.max(angle)))
    ratios = [np.asarray(one.shaft_ratio)[-1] for one in found]
    angle_errors = [np.asarray(one.angle_error)[-1] / deg for one in found]
    return Figure(
        name="variants",
        title=_("Output of the variants over the input angle"),
        sentence=_sentence(angle_errors, names),
        source=_("every variant by the exact law of its joints, at uniform input"),
        rows=tuple(
            Row(
                panels=(
                    _panel(angles, rows, names if named else (), label, unit, middle, least, longest, last=not named),
                ),
                height=1.7,
            )
            for rows, label, unit, middle, least, named in (
                (ratios, _("Speed ratio ω/ω₁ of the output"), "–", 1.0, 0.002, True),
                (angle_errors, _("Angle error φ − φ₁ of the output"), "deg", 0.0, 0.02, False),
            )
        ),
    )


def _panel(
    angles: Sequence[Array],
    rows: Sequence[Array],
    names: Sequence[str],
    label: str,
    unit: str,
    middle: float,
    least: float,
    longest: Array,
    *,
    last: bool,
) -> Panel:
    curves = [
        Curve(
            x=angle,
            y=row,
            label=_short(names[k - 1]) if names else "",
            role=shaft(k),
            dash=dash_of(k),
            width=1.8,
            marker=4.0 if len(angle) == 1 else 0.0,
        )
        for k, (angle, row) in enumerate(zip(angles, rows, strict=True), start=1)
    ]
    return Panel(
        series=(Rule(value=middle, dash="solid", role="faint"), *curves),
        x=across(longest, named=last),
        y=axis(label, unit, list(rows), dimension="angle" if unit == "deg" else "", include=(middle,), least=least),
    )


def _sentence(angle_errors: Sequence[Array], names: Sequence[str]) -> Say:
    errors = [0.5 * float(np.ptp(angle_error)) if angle_error.size else 0.0 for angle_error in angle_errors]
    told = [Quantity(one * deg if one > NOISE else 0.0, "angle", 3) for one in errors]
    if len(told) == 1:
        return say(_("{name}: output angle error ±{error}."), name=names[0], error=told[0])
    best, worst = int(foremost(errors, least=True)), int(foremost(errors))
    if told[best].told(USUAL) == told[worst].told(USUAL):
        return say(_("All outputs have an angle error of ±{error}."), error=told[best])
    return say(
        _("{best} turns most uniformly, output angle error ±{least}; {worst}: ±{most}."),
        best=names[best],
        least=told[best],
        worst=names[worst],
        most=told[worst],
    )


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"
