"""What a fault should show: its orders over the speed where they are largest."""

from __future__ import annotations

from math import isfinite

import numpy as np

from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule, Series
from cardan.figures.palette import DASHES, shaft
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

    found: of a drive and a fault.
    """
    speed = np.linspace(*found.speed, POINTS)
    rows = []
    ways = (
        ("radial", "acceleration", "m_s2", 1.0),
        ("axial", "acceleration", "m_s2", 1.0),
        ("torsion", "angular_speed", "rpm", rpm),
    )
    for direction, dimension, unit, factor in ways:
        lines = [one for one in found.orders if one.direction == direction]
        if not lines:
            continue
        place = foremost_of(lines, lambda one: one.size).place
        curves = _curves(found, [one for one in lines if one.place == place], speed, factor)
        marks: list[Series] = []
        if isfinite(found.critical) and found.speed[0] < found.critical < found.speed[1]:
            marks.append(Rule(value=found.critical / rpm, upright=True, text=_("critical speed"), role="failed"))
        title = {
            "radial": _("Across the shaft at {place}"),
            "axial": _("Along the shaft at {place}"),
            "torsion": _("Amplitude of the speed at {place}"),
        }[direction]
        panel = Panel(
            series=(*marks, *curves),
            x=axis(_("speed"), "rpm", [speed / rpm], dimension="angular_speed", count=8),
            y=axis(
                title.format(place=place),
                unit,
                [one.y for one in curves],
                dimension=dimension,
                include=(0.0,),
                count=4,
            ),
        )
        rows.append(Row(panels=(panel,), height=1.5))
    return Figure(
        name="expected-orders",
        title=_("What the fault should show"),
        sentence="",
        source=_("amplitudes at the torque of the duty; order-of-magnitude, trends are more reliable"),
        rows=tuple(rows),
    )


def largest_order(found: Expected) -> tuple[float, str, float] | None:
    """Return the order across the shaft that is largest at top speed, its sensor and its amplitude [m/s²].

    None where there is none across it.
    found: of a drive and a fault.
    """
    radial = [one for one in found.orders if one.direction == "radial"]
    if not radial:
        return None
    place = max(radial, key=lambda one: one.size).place
    own = [one for one in radial if one.place == place]
    top = np.asarray(found.speed[1:])
    levels = {order: float(_level(found, own, order, top)[0]) for order in sorted({one.order for one in own})}
    order = max(levels, key=lambda one: levels[one])
    return order, place, levels[order]


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
