"""The equivalent joint: its orders, and what each shaft does."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import axis, written
from cardan.figures.figure import Axis, Bars, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import shaft
from cardan.figures.wording import powers_of_ten
from cardan.questions.motion.equivalence import SYNCHRONOUS, EquivalentJoint
from cardan.texts import _
from cardan.units import deg

FLOOR = 1e-9
"""Amplitude [°] below which there is only rounding."""

ORDERS = 4
"""Orders 2, 4 … drawn."""


def equivalence_figures(found: EquivalentJoint) -> tuple[Figure, ...]:
    """Return the figures of an equivalent joint."""
    return (speed_fluctuation_figure(found), orders_figure(found))


def speed_fluctuation_figure(found: EquivalentJoint) -> Figure:
    """Return how uneven every shaft turns.

    found: of one drive.
    """
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
    )


def orders_figure(found: EquivalentJoint) -> Figure:
    """Return the exact harmonics of the output's angle error.

    found: of one drive, or of every shaft of one drive: then the last is drawn.
    """
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
    )


def _from_zero(one: Axis) -> Axis:
    return replace(
        one,
        low=0.0,
        high=one.high * 1.08,
        ticks=tuple(t for t in one.ticks if t >= 0.0),
        texts=tuple(s for t, s in zip(one.ticks, one.texts, strict=True) if t >= 0.0),
    )
