"""How a shaft whirls with its unbalance and its crack: orders over the speed, the way of its centre, a run-up."""

from __future__ import annotations

import math

import numpy as np

from cardan.answers.numbers import significant
from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Band, Curve, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import DASHES, shaft
from cardan.maths.arrays import Array
from cardan.questions.bending.cracked_run import CrackedRun
from cardan.questions.bending.cracked_shafts import CrackedShafts
from cardan.questions.bending.rotor_response import RotorResponse
from cardan.texts import _
from cardan.units import rpm

ORDERS = (1, 2, 3, -1)
"""Orders drawn, forward and backward."""

LOWEST = 1e-5
"""Share of the largest amplitude at which the axis ends."""

POINTS = 721
"""Points of an orbit."""

MICRO = 1e-6
"""Metres in a micrometre."""


def rotor_figures(found: RotorResponse) -> tuple[Figure, ...]:
    """Return the figures of a steady response."""
    return (response_figure(found), orbits_figure(found))


def order_name(order: float) -> str:
    """Return the name of an order of whirling.

    >>> order_name(2), order_name(-1)
    ('order 2', 'order 1 backward')
    """
    text = _("order {order}") if order >= 0 else _("order {order} backward")
    return text.format(order=f"{abs(order):g}")


def response_figure(found: RotorResponse) -> Figure:
    """Return the amplitudes of the orders over the speed, with the speeds of running and where whirling grows.

    found: of one shaft.
    """
    speed = found.steady.speed / rpm
    rows = {order: found.steady.order_amplitude(order) / MICRO for order in ORDERS}
    top = max(float(np.nanmax(row)) for row in rows.values()) or 1.0
    shown = {order: row for order, row in rows.items() if float(np.nanmax(row)) > LOWEST * top}
    series: list[Series] = []
    if found.used is not None:
        low, high = (one / rpm for one in found.used)
        if high > low:
            series.append(Band(low=low, high=high, upright=True, text=_("in use"), role="accent", opacity=0.08))
    series += [
        Band(low=low / rpm, high=high / rpm, upright=True, text=_("unstable"), role="failed", opacity=0.15)
        for low, high in found.unstable
        if high > low
    ]
    critical = found.rotor.critical / rpm
    names = ((1, _("critical")), (2, _("half")), (3, _("third")))
    series += [
        Rule(value=critical / n, upright=True, text=name, dash="dotted")
        for n, name in names
        if speed[0] < critical / n < speed[-1]
    ]
    series += [
        Curve(x=speed, y=np.maximum(row, LOWEST * top), role=shaft(k + 2), dash=DASHES[k], label=order_name(order))
        for k, (order, row) in enumerate(shown.items())
    ]
    panel = Panel(
        series=tuple(series),
        x=axis(_("speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=_decades(_("Amplitude amid the shaft"), list(shown.values()), LOWEST * top),
    )
    return Figure(
        name="rotor",
        title=_("Whirling of shaft {number} over the speed").format(number=found.rotor.shaft),
        sentence="",
        source=_("lowest mode of bending as one mass; orders of the cracked rotor, exact"),
        rows=(Row(panels=(panel,), height=2.6),),
    )


def _decades(label: str, rows: list[Array], least: float) -> Axis:
    """Return a logarithmic axis over whole decades."""
    low = max(min(float(np.nanmin(row)) for row in rows), least) / 1.2
    high = max(float(np.nanmax(row)) for row in rows) * 1.3
    ticks = tuple(10.0**k for k in range(math.ceil(math.log10(low)), math.floor(math.log10(high)) + 1))
    return Axis(
        label=label,
        unit="um",
        dimension="displacement",
        low=low,
        high=high,
        ticks=ticks,
        texts=tuple(significant(one, 1) for one in ticks),
        log=True,
    )


def _way(z: Array, title: str, reach: float, *, role: str = "accent") -> Panel:
    """Return the way of a shaft's centre as one sees it against the power flow: sideways to the right, up upwards."""
    ticks = steps(-reach, reach, 4)

    def along(name: str) -> Axis:
        return Axis(
            label=name, unit="um", dimension="displacement", low=-reach, high=reach, ticks=ticks, texts=written(ticks)
        )

    curve = Curve(x=z.imag / MICRO, y=-z.real / MICRO, role=role, width=1.1)
    start = Curve(x=z.imag[:1] / MICRO, y=-z.real[:1] / MICRO, role="ink", width=0.0, marker=5.0)
    return Panel(series=(curve, start), x=along(_("sideways")), y=along(_("upwards")), title=title, equal=True)


def orbits_figure(found: RotorResponse) -> Figure:
    """Return the ways of the shaft's centre about its middle at a third, at half and near the critical speed.

    found: of one shaft.
    """
    critical = found.rotor.critical
    wanted = [(1.0 / 3.0, _("a third of the critical speed")), (0.5, _("half")), (0.9, _("nine tenths"))]
    turn = np.linspace(0.0, 2.0 * np.pi, POINTS)
    panels = []
    for share, name in wanted:
        k = int(np.argmin(np.abs(found.steady.speed - share * critical)))
        path = found.steady.at(turn)[k]
        path = path - np.mean(path[:-1])
        reach = 1.15 * float(np.nanmax(np.abs(path))) / MICRO or 1.0
        panels.append(_way(path, name, reach if math.isfinite(reach) else 1.0))
    return Figure(
        name="rotor-orbits",
        title=_("Way of the centre of shaft {number} in a turn").format(number=found.rotor.shaft),
        sentence=say(
            _("The shaft sags by {sag} and whirls about that; an inner loop is the mark of a crack."),
            sag=Quantity(found.rotor.sag, "displacement", 3),
        ),
        source=_("seen against the power flow; the dot is where the crack, or the driving yoke, looks down"),
        rows=(Row(panels=tuple(panels), height=2.4),),
        legend=False,
    )


def run_figure(number: int, found: CrackedRun) -> Figure:
    """Return the distance of the centre from its place over a change of speed, and its orders."""
    away = np.abs(found.deflection - found.static) / MICRO
    speed, order, size = found.orders()
    course = Panel(
        series=(Curve(x=found.speed / rpm, y=away, role="accent", width=0.7),),
        x=axis(_("speed"), "rpm", [found.speed / rpm], dimension="angular_speed", margin=0.0, count=8),
        y=axis(_("Distance from its place at rest"), "um", [away], dimension="displacement", include=(0.0,)),
    )
    curves = tuple(
        Curve(
            x=speed / rpm,
            y=np.abs(size[:, order == one])[:, 0] / MICRO,
            role=shaft(k + 2),
            dash=DASHES[k],
            label=order_name(one),
        )
        for k, one in enumerate(ORDERS)
    )
    orders = Panel(
        series=curves,
        x=axis(_("speed"), "rpm", [found.speed / rpm], dimension="angular_speed", margin=0.0, count=8),
        y=axis(
            _("Amplitudes of its orders"), "um", [one.y for one in curves], dimension="displacement", include=(0.0,)
        ),
    )
    return Figure(
        name="rotor-run",
        title=_("Shaft {number} while the speed changes").format(number=number),
        sentence="",
        source=_("motion in time of the lowest mode; orders fitted over four turns"),
        rows=(Row(panels=(course,), height=1.7), Row(panels=(orders,), height=1.7)),
    )


def joined_figure(numbers: tuple[int, int], found: CrackedShafts, *, turns: float = 4.0) -> Figure:
    """Return the ways of two shafts beside a joint over the last turns."""
    panels = []
    for k, number in enumerate(numbers):
        last = found.angle[:, k] > found.angle[-1, k] - 2.0 * math.pi * turns
        path = found.deflection[last, k]
        path = path - np.mean(path)
        reach = 1.15 * float(np.max(np.abs(path))) / MICRO or 1.0
        panels.append(_way(path, _("shaft {number}").format(number=number), reach, role=shaft(number)))
    text = _("The last {turns} turns.")
    return Figure(
        name="rotor-joined",
        title=_("Ways of the centres of shafts {one} and {two}").format(one=numbers[0], two=numbers[1]),
        sentence=text.format(turns=f"{turns:g}"),
        source=_("motion in time of both lowest modes, joined by the exact joint"),
        rows=(Row(panels=tuple(panels), height=3.0),),
        legend=False,
    )
