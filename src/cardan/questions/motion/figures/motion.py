"""How every shaft turns, over the input angle."""

from __future__ import annotations

import math

import numpy as np

from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule
from cardan.figures.palette import dash_of, shaft
from cardan.figures.turning import across, shaft_name
from cardan.figures.wording import angular
from cardan.maths.arrays import Array
from cardan.questions.motion.equivalence import SPECK
from cardan.questions.motion.motion import Motion
from cardan.texts import _
from cardan.units import deg

NOISE = 1e-12
"""Below this a ratio's swing is rounding."""

UNDONE = 0.01
"""Share of the largest swing of a shaft below which what the output keeps of it is undone but for rounding."""


def motion_figures(found: Motion) -> tuple[Figure, ...]:
    """Return the figures of a motion."""
    return (motion_figure(found),)


def motion_figure(found: Motion) -> Figure:
    """Return speed ratio, angle error and acceleration of every shaft over the input angle.

    Parameters
    ----------
    found : Motion
        Motion of one drive.
    """
    angle = np.asarray(found.angle) / deg
    lead = np.asarray(found.lead) / deg
    known = found.speed is not None
    steep = np.asarray(found.shaft_acceleration) if known else np.asarray(found.shaft_slope)
    along = across(angle)
    ratio = np.asarray(found.shaft_ratio)
    even = len(angle) > 1 and float(np.max(np.ptp(ratio, axis=-1), initial=0.0)) < NOISE  # nothing else to be seen
    panels = (
        _panel(angle, ratio, across(angle, named=even), _("Speed ratio ω/ω₁"), "–", 1.0, 0.02, named=True),
        _panel(angle, lead, along, _("Angle error φ − φ₁"), "°", 0.0, 0.2),
        _panel(
            angle,
            steep,
            across(angle, named=True),
            _("Angular acceleration ε") if known else _("Angular acceleration per input speed squared, ε/ω₁²"),
            "rad/s²" if known else "–",
            0.0,
            1.0 if known else 0.02,
        ),
    )
    return Figure(
        name="motion",
        title=_("Motion of every shaft over the input angle"),
        sentence=_sentence(found, lead),
        source=_("every joint by its own law, one after another")
        if found.followed
        else _(
            "i = 1/|b̄w + ā|², w = e^(2iφ₁), from the product of the joints' Möbius matrices; exact, equal to Book "
            "(32), (33), (38)"
        ),
        rows=tuple(Row(panels=(panel,), height=1.5) for panel in panels[: 1 if even else None]),
    )


def _panel(
    angle: Array,
    rows: Array,
    along: Axis,
    label: str,
    unit: str,
    middle: float,
    least: float,
    *,
    named: bool = False,
) -> Panel:
    swing = float(np.max(np.abs(rows - middle), initial=0.0))
    curves = [
        Curve(
            x=angle,
            y=row,
            label=shaft_name(k, len(rows)) if named else "",
            role=shaft(k),
            dash=dash_of(k),
            width=2.2 if k == len(rows) else 1.3,
            marker=4.0 if len(angle) == 1 else 0.0,
        )
        for k, row in enumerate(rows, start=1)
    ]
    flat = swing < NOISE
    above, below = float(np.max(rows, initial=middle)) - middle, middle - float(np.min(rows, initial=middle))
    lopsided = max(above, below) / max(min(above, below), 1e-300)
    upright = axis(
        label,
        unit,
        [rows],
        include=(middle,),
        mirrored=middle if flat or lopsided < 2.0 else None,
        least=least if flat else 0.0,
    )
    return Panel(series=(Rule(value=middle, dash="solid", role="faint"), *curves), x=along, y=upright)


def _sentence(found: Motion, lead: Array) -> str:
    ratio = np.asarray(found.ratio)
    low, high = float(np.min(ratio)), float(np.max(ratio))
    if high - low < NOISE:
        between = float(np.max(np.ptp(lead, axis=-1))) / 2.0
        if between < NOISE / deg:
            return _("Every shaft turns exactly evenly.")
        return _("The output turns exactly evenly; between the ends a shaft runs ahead and back by {lead}°.").format(
            lead=angular(between, 3)
        )
    swing = np.ptp(lead, axis=-1)
    if high - low < SPECK and float(swing[-1]) < UNDONE * float(np.max(swing)):
        return _("But for rounding the output turns evenly: it runs ahead and back of its mean by {lead}°.").format(
            lead=angular(float(np.ptp(lead[-1])) / 2.0, 2)
        )
    text = _(
        "The output runs ahead and back of its mean by {lead}° twice a turn, its speed between {low} and {high} of the "
        "input's."
    )
    if found.followed:
        text = _(
            "The output runs ahead and back of its mean by {lead}°, its speed between {low} and {high} of the input's."
        )
    places = min(max(1 - math.floor(math.log10(100.0 * (high - low))), 1), 9)  # so that the two differ in two figures
    least, most = (f"{100.0 * ratio:.{places}f} %" for ratio in (low, high))
    return text.format(lead=angular(float(np.ptp(lead[-1])) / 2.0, 3), low=least, high=most)
