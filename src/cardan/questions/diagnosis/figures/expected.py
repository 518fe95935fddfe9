"""What a fault should show: its orders over the speed where they are largest."""

from __future__ import annotations

from math import isfinite

import numpy as np

from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import DASHES, shaft
from cardan.figures.wording import significant
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.questions.diagnosis.expected import Expected
from cardan.questions.diagnosis.fault_orders import ExpectedOrder
from cardan.texts import _
from cardan.units import rpm

POINTS = 201
"""Speeds along a curve."""


def expected_figures(found: Expected) -> tuple[Figure, ...]:
    """Return the figure of what a fault should show."""
    return (expected_figure(found),)


def expected_figure(found: Expected) -> Figure:
    """Return the orders of a fault over the speed at the torque of the duty, at the sensor where they are largest.

    Parameters
    ----------
    found : Expected
        Of a drive and a fault.
    """
    speed = np.linspace(*found.speed, POINTS)
    rows = []
    loudest = ""
    for direction, unit, factor in (("radial", "m/s²", 1.0), ("axial", "m/s²", 1.0), ("torsion", "rpm", rpm)):
        lines = [one for one in found.orders if one.direction == direction]
        if not lines:
            continue
        place = foremost_of(lines, lambda one: one.size).place
        loudest = loudest or place
        curves = _curves(found, [one for one in lines if one.place == place], speed, factor)
        marks: list[Series] = []
        if isfinite(found.critical) and found.speed[0] < found.critical < found.speed[1]:
            marks.append(Rule(value=found.critical / rpm, upright=True, text=_("critical speed"), role="failed"))
        title = {
            "radial": _("Across the shaft at {place}"),
            "axial": _("Along the shaft at {place}"),
            "torsion": _("Swing of the speed at {place}"),
        }[direction]
        panel = Panel(
            series=(*marks, *curves),
            x=axis(_("speed"), "rpm", [speed / rpm], count=8),
            y=axis(title.format(place=place), unit, [one.y for one in curves], include=(0.0,), count=4),
        )
        rows.append(Row(panels=(panel,), height=1.5))
    text = _("At {speed} rpm order {order} is the largest at {place}: about {size} m/s².")
    radial = [one for one in found.orders if one.direction == "radial" and one.place == loudest]
    orders = sorted({one.order for one in radial})
    levels = {order: _level(found, radial, order, np.asarray(found.speed[1:])) for order in orders}
    most = foremost_of(levels, lambda order: float(levels[order][0])) if levels else 1.0
    return Figure(
        name="expected-orders",
        title=_("What the fault should show"),
        sentence=text.format(
            speed=significant(found.speed[1] / rpm),
            order=f"{most:g}",
            place=loudest,
            size=significant(float(levels[most][0]), 2) if levels else "0",
        ),
        source=_("amplitudes at the torque of the duty; sizes are good to a factor, shapes to more"),
        rows=tuple(rows),
    )


def _curves(found: Expected, lines: list[ExpectedOrder], speed: Array, factor: float) -> tuple[Curve, ...]:
    every = sorted({one.order for one in found.orders})
    own = {one.order for one in lines}
    return tuple(
        Curve(
            x=speed / rpm,
            y=_level(found, lines, order, speed) / factor,
            role=shaft(k + 2),
            dash=DASHES[k % len(DASHES)],
            label=_("order {order}").format(order=f"{order:g}"),
        )
        for k, order in enumerate(every)
        if order in own
    )


def _level(found: Expected, lines: list[ExpectedOrder], order: float, speed: Array) -> Array:
    """Return the amplitude of an order, its parts as if by chance of phase."""
    parts = [np.abs(found.value(one, speed, found.reference)) ** 2 for one in lines if one.order == order]
    return np.asarray(np.sqrt(np.sum(parts, axis=0)))
