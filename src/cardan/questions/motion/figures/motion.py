"""How every shaft turns, over the input angle."""

from __future__ import annotations

import math

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule
from cardan.figures.palette import dash_of, shaft
from cardan.figures.turning import across, shaft_name
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

    found: motion of one drive.
    """
    angle = np.asarray(found.angle) / deg
    angle_error = np.asarray(found.angle_error) / deg
    known = found.speed is not None
    steep = np.asarray(found.shaft_acceleration) if known else np.asarray(found.shaft_slope)
    along = across(angle)
    ratio = np.asarray(found.shaft_ratio)
    even = len(angle) > 1 and float(np.max(np.ptp(ratio, axis=-1), initial=0.0)) < NOISE  # nothing else to be seen
    panels = (
        _panel(angle, ratio, across(angle, named=even), _("Speed ratio ω/ω₁"), "–", 1.0, 0.02, named=True),
        _panel(angle, angle_error, along, _("Angle error φ − φ₁"), "deg", 0.0, 0.2, dimension="angle"),
        _panel(
            angle,
            steep,
            across(angle, named=True),
            _("Angular acceleration ε") if known else _("Angular acceleration per input speed squared, ε/ω₁²"),
            "rad_s2" if known else "–",
            0.0,
            1.0 if known else 0.02,
            dimension="angular_acceleration" if known else "",
        ),
    )
    return Figure(
        name="motion",
        title=_("Motion of every shaft over the input angle"),
        sentence=_sentence(found, angle_error),
        source=_("every joint by its own law, one after another")
        if found.followed
        else _(
            "i = 1/|b̄w + ā|², w = e^(2iφ₁), from the product of the joints' Möbius matrices; exact, equal "
            "to Kozhevnikov & Perfil'ev (1978), eq. 32, 33, 38"
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
    dimension: str = "",
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
        dimension=dimension,
        include=(middle,),
        mirrored=middle if flat or lopsided < 2.0 else None,
        least=least if flat else 0.0,
    )
    return Panel(series=(Rule(value=middle, dash="solid", role="faint"), *curves), x=along, y=upright)


def _sentence(found: Motion, angle_error: Array) -> Text:
    """Return between which speeds the output runs; at a uniform output, what the shafts between do."""
    ratio = np.asarray(found.ratio)
    low, high = float(np.min(ratio)), float(np.max(ratio))
    if high - low < NOISE:
        between = float(np.max(np.ptp(angle_error, axis=-1))) / 2.0 * deg
        if between < NOISE:
            return _("Every shaft turns exactly uniformly.")
        text = _("Between input and output a shaft has an angle error of ±{error}.")
        return say(text, error=Quantity(between, "angle", 3))
    swing = np.ptp(angle_error, axis=-1)
    if high - low < SPECK and float(swing[-1]) < UNDONE * float(np.max(swing)):
        text = _("But for rounding the output turns uniformly: its angle error is ±{error}.")
        return say(text, error=Quantity(float(swing[-1]) / 2.0 * deg, "angle", 2))
    places = min(max(1 - math.floor(math.log10(100.0 * (high - low))), 1), 9)  # so that the two differ in two figures
    return say(
        _("The output speed runs between {low} and {high} of the input speed."),
        low=Quantity(low, "share", decimals=places),
        high=Quantity(high, "share", decimals=places),
    )
