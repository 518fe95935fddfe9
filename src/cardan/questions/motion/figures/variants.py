"""Variants of a drive over one another: how their outputs turn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.errors import refuse
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.figures.palette import dash_of, shaft
from cardan.figures.turning import across
from cardan.figures.wording import angular
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

    Parameters
    ----------
    found : sequence of Motion
        The motion of each; the n-th has the colour of the n-th shaft.
    names : sequence of str
        What they are called.

    Raises
    ------
    InputError
        There is none, or not a name for each.

    Examples
    --------
    >>> from cardan import Drive, motion
    >>> from cardan.units import deg
    >>> even, odd = Drive.from_angles([20 * deg, 20 * deg]), Drive.from_angles([20 * deg])
    >>> variants_figure([motion(even), motion(odd)], ["two joints", "one joint"]).sentence
    'two joints: the output turns most evenly, ahead and back by 0°; one joint: by 1.78°.'
    """
    if not found or len(found) != len(names):
        raise refuse("names", _("one name is needed for each drive, and at least one drive"))
    angles = [np.asarray(one.angle) / deg for one in found]
    longest = max(angles, key=lambda angle: float(np.max(angle)))
    ratios = [np.asarray(one.shaft_ratio)[-1] for one in found]
    leads = [np.asarray(one.lead)[-1] / deg for one in found]
    return Figure(
        name="variants",
        title=_("Output of the variants over the input angle"),
        sentence=_sentence(leads, names),
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
                (leads, _("Angle error φ − φ₁ of the output"), "°", 0.0, 0.02, False),
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
        y=axis(label, unit, list(rows), include=(middle,), least=least),
    )


def _sentence(leads: Sequence[Array], names: Sequence[str]) -> str:
    swing = [0.5 * float(np.ptp(lead)) if lead.size else 0.0 for lead in leads]
    told = [angular(one, 3) if one > NOISE else "0" for one in swing]
    if len(told) == 1:
        return _("{name}: the output runs ahead and back by {lead}°.").format(name=names[0], lead=told[0])
    best, worst = int(foremost(swing, least=True)), int(foremost(swing))
    if told[best] == told[worst]:
        return _("All outputs run ahead and back by {lead}°.").format(lead=told[best])
    return _("{best}: the output turns most evenly, ahead and back by {least}°; {worst}: by {most}°.").format(
        best=names[best], least=told[best], worst=names[worst], most=told[worst]
    )


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"
