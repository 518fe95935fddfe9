"""How every shaft turns over the input angle, the equivalent joint, and variants over one another."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, Say, Text, say
from cardan.answers.reader import USUAL
from cardan.errors import refuse
from cardan.figures.axes import across, axis, powers_of_ten, shaft_name, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.motion.equivalence import FLOOR, SPECK, SYNCHRONOUS, EquivalentJoint
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
    """Return speed ratio, angle error and acceleration of every shaft over the input angle."""
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
        aside=even,
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


# The equivalent joint: its orders, and what each shaft does.

ORDERS = 4
"""Orders 2, 4 … drawn."""


def equivalence_figures(found: EquivalentJoint) -> tuple[Figure, ...]:
    """Return the figures of an equivalent joint."""
    return (speed_fluctuation_figure(found), orders_figure(found))


def speed_fluctuation_figure(found: EquivalentJoint) -> Figure:
    """Return how uneven every shaft turns."""
    share = 100.0 * np.ravel(np.asarray(found.shaft_speed_fluctuation))
    at = np.arange(2, len(share) + 2)
    texts = tuple(Quantity(value / 100.0, "share", 3) for value in share.tolist())
    upright = axis(
        _("Speed fluctuation δ of each shaft"),
        "percent",
        [share],
        dimension="share",
        include=(0.0,),
        least=1.0,
        count=4,
    )
    ticks = tuple(float(k) for k in at)
    across = Axis(label=_("shaft"), low=1.4, high=float(at[-1]) + 0.6, ticks=ticks, texts=written(ticks), grid=False)
    bars = Bars(at=at, size=share, texts=texts, roles=tuple(shaft(int(k)) for k in at), thick=0.5)
    even = share[-1] < 100.0 * SYNCHRONOUS
    return Figure(
        name="speed_fluctuation",
        title=_("Speed fluctuation of every shaft"),
        sentence=_("The output is uniform; what the shafts between do cancels out.")
        if even
        else say(_("The output speed varies by {share} of its mean, peak to peak."), share=texts[-1]),
        source=_(
            "δ = i_max − i_min = 4|a||b| of the product of the first joints' matrices, Kozhevnikov & "
            "Perfil'ev (1978), eq. 79; exact"
        ),
        rows=(Row(panels=(Panel(series=(bars,), x=across, y=_from_zero(upright)),), height=1.5),),
        legend=False,
        aside=True,
    )


def orders_figure(found: EquivalentJoint) -> Figure:
    """Return the exact harmonics of the output's angle error."""
    amplitude = np.asarray(found.harmonics(ORDERS)).reshape(-1, ORDERS)[-1] / deg
    orders = 2.0 * np.arange(1, ORDERS + 1)
    even = bool(np.ravel(np.asarray(found.shaft_speed_fluctuation))[-1] < SYNCHRONOUS)
    top = 1.0 if even else float(amplitude[0])
    high = 10.0 ** (math.floor(math.log10(top)) + 1)
    low = min(max(FLOOR, 10.0 ** (math.floor(math.log10(max(float(amplitude[-1]), 1e-300))))), 1e-2 * high)
    if even:
        low, high = 1e-6, 1.0
    powers = range(round(math.log10(low)), round(math.log10(high)) + 1)
    every = max(1, math.ceil(len(powers) / 5))
    ticks = tuple(10.0**p for p in powers if (p - powers[0]) % every == 0)
    upright = Axis(
        label=_("Amplitude of the output's angle error"),
        unit="deg",
        dimension="angle",
        low=low,
        high=high * 3.0,
        ticks=ticks,
        texts=powers_of_ten(ticks),
        log=True,
    )
    across = Axis(
        label=_("order, times a turn of the input"),
        low=1.0,
        high=2.0 * ORDERS + 1.0,
        ticks=tuple(orders),
        texts=written(tuple(orders)),
        grid=False,
    )
    little = say(_("< {least}"), least=Quantity(low * deg, "angle", 1, trim=True))
    series: list[Series] = [
        Bars(
            at=orders,
            size=amplitude,
            texts=tuple(Quantity(value * deg, "angle", 3) if value >= low else little for value in amplitude.tolist()),
            base=low,
            least=low,
            roles=("accent",),
            thick=0.7,
        )
    ]
    if even:
        series = [Rule(value=low, text=_("no orders: the output turns exactly uniformly"), role="muted")]
    return Figure(
        name="orders",
        title=_("Orders of the output's angle error"),
        sentence=_("There are none: the output turns exactly uniformly.")
        if even
        else say(
            _("Order 2, twice a turn, is the largest: order 4 is {times} times smaller, and odd orders do not occur."),
            times=Quantity(float(amplitude[0] / max(float(amplitude[1]), 1e-300)), digits=2),
        ),
        source=_(
            "amplitude τᵏ/k at order 2k, τ = |b|/|a|; exact, a chain has no other harmonics than those of one joint"
        ),
        rows=(Row(panels=(Panel(series=tuple(series), x=across, y=upright),), height=1.6),),
        legend=False,
        aside=True,
    )


def _from_zero(one: Axis) -> Axis:
    return replace(
        one,
        low=0.0,
        high=one.high * 1.08,
        ticks=tuple(t for t in one.ticks if t >= 0.0),
        texts=tuple(s for t, s in zip(one.ticks, one.texts, strict=True) if t >= 0.0),
    )


# Variants of a drive over one another: how their outputs turn.

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
        sentence=_variants_sentence(angle_errors, names),
        source=_("every variant by the exact law of its joints, at uniform input"),
        rows=tuple(
            Row(
                panels=(
                    _variants_panel(
                        angles, rows, names if named else (), label, unit, middle, least, longest, last=not named
                    ),
                ),
                height=1.7,
            )
            for rows, label, unit, middle, least, named in (
                (ratios, _("Speed ratio ω/ω₁ of the output"), "–", 1.0, 0.002, True),
                (angle_errors, _("Angle error φ − φ₁ of the output"), "deg", 0.0, 0.02, False),
            )
        ),
    )


def _variants_panel(
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


def _variants_sentence(angle_errors: Sequence[Array], names: Sequence[str]) -> Say:
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


FIGURES = {Motion: motion_figures, EquivalentJoint: equivalence_figures}
"""Result -> what makes its figures."""
