"""Orders of a recording over the speed, and those that a fault should show."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from math import isfinite

import numpy as np
import scipy

from cardan.answers.palette import DASHES, shaft
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.reader import significant
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Rule, Series, Shape
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.questions.diagnosis.expected import Expected, ExpectedOrder
from cardan.questions.diagnosis.signals.orders import OrderMap, OrderSpectrum, TrackedOrders
from cardan.texts import _
from cardan.units import deg, rpm
from cardan.units import factor as unit_factor

LINES = 36  # lines of a map at most: one for each range of speed
NAMED = 5  # peaks of a spectrum with their order beside them
WHOLE = 0.02  # how far from a whole number an order may be to be called whole

RUN, LASTING = 0.7, 0.2
"""Shares of the range of speed and of the recording that one run has to cover to be drawn over the speed."""

BELIEVED = 0.6  # confidence below which the sentence says so

DIMENSIONS = {
    "acceleration": ("acceleration", "m_s2"), "velocity": ("speed", "mm_s"), "displacement": ("displacement", "um"),
    "angle": ("angle", "deg"), "angular_speed": ("angular_speed", "rpm"), "torque": ("torque", "Nm"),
    "pulses": ("", ""), "other": ("", ""),
}  # fmt: skip
"""Quantity -> dimension and usual unit on an axis."""


def unit_of(quantity: str) -> tuple[str, str, float]:
    """Return dimension, usual unit and its size in SI of what a channel measures."""
    dimension, unit = DIMENSIONS[quantity]
    return dimension, unit, unit_factor(dimension, unit) if dimension else 1.0


def quantity_word(quantity: str) -> str:
    """Return the name of a quantity in the language spoken here."""
    words = {
        "acceleration": _("acceleration"),
        "velocity": _("velocity"),
        "displacement": _("displacement"),
        "angle": _("angle"),
        "angular_speed": _("speed"),
        "torque": _("torque"),
        "pulses": _("pulses"),
    }
    return words.get(quantity, _("values as read"))


def trusted(sentence: Text, confidence: float) -> Text:
    """Return a sentence with how little the picture can be relied on, as it is where it can."""
    if confidence >= BELIEVED:
        return sentence
    text = _("{sentence} The confidence is only {share}.")
    return say(text, sentence=sentence, share=Quantity(confidence, "share", decimals=0))


def order_text(order: float) -> str:
    """Return an order as people say it: whole where it is whole but for what a spectrum blurs."""
    return f"{round(order)}" if round(order) and abs(order - round(order)) < WHOLE else f"{order:.2f}"


def spectrum_figure(found: OrderSpectrum) -> Figure:
    """Return the amplitudes over the orders, the highest named, with the level of the noise."""
    dimension, unit, size = unit_of(found.quantity)
    level, floor = found.amplitude / size, found.floor / size
    peaks = found.peaks(count=NAMED)
    notes = [
        Note(text=f"{order_text(order)}×", x=order, y=high / size, level="bottom", shift=(0.0, 3.0), role="accent")
        for order, high in peaks
    ]
    panel = Panel(
        series=(
            Curve(x=found.order, y=floor, role="muted", dash="dashed", width=0.9, label=_("level of the noise")),
            Curve(x=found.order, y=level, role="accent", width=1.1, label=found.name),
            *notes,
        ),
        x=axis(_("order: times a turn"), "", [found.order], margin=0.0, count=10),
        y=axis(
            _("Peak amplitude of {quantity}").format(quantity=quantity_word(found.quantity)),
            unit,
            [level],
            dimension=dimension,
            include=(0.0,),
            margin=0.14,
        ),
    )
    return Figure(
        name="order-spectrum",
        title=_("Orders of {name}").format(name=found.name),
        sentence=trusted(_peak_sentence(found, peaks), found.confidence),
        source=_(
            "read at even angles of the shaft; {windows} windows of {turns} turns; orders nearer than {width} are one"
        ).format(windows=found.windows, turns=found.turns, width=significant(found.resolution, 2)),
        rows=(Row(panels=(panel,), height=2.2),),
    )


def _peak_sentence(found: OrderSpectrum, peaks: Sequence[tuple[float, float]]) -> Text:
    low, high = (Quantity(one, "angular_speed", 3) for one in found.speeds)
    if not peaks:
        return say(_("No order stands out of the noise between {low:bare} and {high}."), low=low, high=high)
    text = _("From {low:bare} to {high} the highest order is {order} with {amplitude}.")
    order, amplitude = peaks[0]
    return say(text, low=low, high=high, order=order_text(order), amplitude=amplitude_of(found.quantity, amplitude))


def amplitude_of(quantity: str, value: float) -> Quantity:
    """Return an amplitude of what a channel measures [SI]."""
    dimension, unit, _size = unit_of(quantity)
    return Quantity(float(value), dimension, 3, unit=unit)


def map_figure(
    found: OrderMap,
    *,
    critical_speeds: Sequence[float] = (),
    orders: Mapping[float, str] | Sequence[float] = (1.0, 2.0),
) -> Figure:
    """Return a map over order and speed as a waterfall, a line for each speed, with what crosses it.

    found: of one channel; critical_speeds [rad/s]: natural frequencies: order times speed reaches them along a curve.
    orders: orders marked, with their names.
    """
    size = unit_of(found.quantity)[2]
    speed, rows = _by_speed(found)
    level, at = rows / size, speed / rpm
    top = float(np.max(level, initial=0.0)) or 1.0
    room = max(float(at[-1] - at[0]), 0.05 * float(at[-1]))
    high = 5.0 * room / max(at.size, 8)
    low_end, high_end = float(at[0]), float(at[-1]) + 1.15 * high
    names = dict(orders) if isinstance(orders, Mapping) else {one: f"{one:g}×" for one in orders}
    last = float(found.order[-1])
    series: list[Series] = [
        Rule(value=order, upright=True, text=text, role="muted", dash="dotted") for order, text in names.items()
    ]
    for k in range(at.size - 1, -1, -1):  # the fastest lies farthest back
        line = at[k] + high * level[k] / top
        x = np.concatenate([found.order[:1], found.order, found.order[-1:]])
        y = np.concatenate([at[k : k + 1], line, at[k : k + 1]])
        series.append(Shape(x=x, y=y, role="paper", opacity=0.85))
        series.append(Curve(x=found.order, y=line, role="accent", width=0.8))
    for critical in critical_speeds:
        series += _crossing(critical / rpm, low_end, high_end, last)
    panel = Panel(
        series=tuple(series),
        x=axis(_("order: times a turn"), "", [found.order], margin=0.0, count=10),
        y=_speeds(low_end, high_end),
    )
    text = _("A full line is {amplitude} high; orders stand upright, and grow where they pass a resonance.")
    return Figure(
        name="order-map",
        title=_("Orders of {name} over the speed").format(name=found.name),
        sentence=trusted(say(text, amplitude=amplitude_of(found.quantity, top * size)), found.confidence),
        source=_("read at even angles of the shaft; windows of {turns} turns").format(turns=found.turns),
        rows=(Row(panels=(panel,), height=4.2),),
        legend=bool(len(critical_speeds)),
    )


def _by_speed(found: OrderMap) -> tuple[Array, Array]:
    """Return speeds rising and a line for each: the highest of what was measured near it."""
    count = min(LINES, found.speed.size)
    edges = np.linspace(float(np.min(found.speed)), float(np.max(found.speed)), count + 1)
    place = np.clip(np.searchsorted(edges, found.speed, side="right") - 1, 0, count - 1)
    used = np.unique(place)
    speed = np.asarray([np.mean(found.speed[place == k]) for k in used])
    return speed, np.asarray([np.max(found.amplitude[place == k], axis=0) for k in used])


def _speeds(low: float, high: float) -> Axis:
    ticks = steps(low, high, 6)
    return Axis(
        label=_("Speed"), unit="rpm", dimension="angular_speed", low=low, high=high, ticks=ticks, texts=written(ticks)
    )


def _crossing(critical: float, low: float, high: float, last: float) -> list[Series]:
    """Return the curve along which an order meets a natural frequency [rpm], inside of the map."""
    first = max(critical / high, 1e-3)
    end = min(critical / max(low, 1e-9), last)
    if not first < end:
        return []
    order = np.linspace(first, end, 60)
    name = say(_("natural frequency {value}"), value=Quantity(critical * rpm, "frequency", 3))
    return [Curve(x=order, y=critical / order, role="failed", dash="dashed", width=1.0, label=name)]


def tracks_figure(found: TrackedOrders) -> Figure:
    """Return amplitude and phase of some orders over the speed."""
    dimension, unit, size = unit_of(found.quantity)
    run = _longest_run(found.speed)
    if run is None:
        pick = np.arange(found.time.size)
        across = found.time
        bottom = axis(_("time"), "s", [across], dimension="time", margin=0.0, count=8)
    else:
        pick = run[0] + np.argsort(found.speed[slice(*run)], kind="stable")
        across = found.speed[pick] / rpm
        bottom = axis(_("speed"), "rpm", [across], dimension="angular_speed", margin=0.0, count=8)
    level = found.amplitude[:, pick] / size
    looks = [(shaft(k + 1), DASHES[k // 8 % len(DASHES)]) for k in range(len(found.orders))]
    upper = Panel(
        series=tuple(
            Curve(x=across, y=row, role=role, dash=dash, label=_("order {order}").format(order=f"{one:g}"))
            for one, row, (role, dash) in zip(found.orders, level, looks, strict=True)
        ),
        x=bottom,
        y=axis(
            _("Peak amplitude of {quantity}").format(quantity=quantity_word(found.quantity)),
            unit,
            [level],
            dimension=dimension,
            include=(0.0,),
        ),
    )
    rows = [Row(panels=(upper,), height=1.9)]
    if found.phased:
        phase = found.phase[:, pick] / deg
        ticks = (-180.0, -90.0, 0.0, 90.0, 180.0)
        lower = Panel(
            series=tuple(
                Curve(x=across, y=_broken(row), role=role, dash=dash)
                for row, (role, dash) in zip(phase, looks, strict=True)
            ),
            x=bottom,
            y=Axis(
                label=_("Phase against the mark"),
                unit="deg",
                dimension="angle",
                low=-180.0,
                high=180.0,
                ticks=ticks,
                texts=written(ticks),
            ),
        )
        rows.append(Row(panels=(lower,), height=1.3))
    at = np.unravel_index(int(np.argmax(level)), level.shape)
    text = _("Order {order} is the highest: {amplitude} at {speed}.")
    return Figure(
        name="tracked-orders",
        title=_("Orders of {name} followed over the speed").format(name=found.name),
        sentence=trusted(
            say(
                text,
                order=f"{found.orders[at[0]]:g}",
                amplitude=amplitude_of(found.quantity, float(level[at]) * size),
                speed=Quantity(float(found.speed[pick[at[1]]]), "angular_speed", 3),
            ),
            found.confidence,
        ),
        source=_("all orders fitted together in windows of {turns} turns").format(turns=found.turns),
        rows=tuple(rows),
    )


def _longest_run(speed: Array) -> tuple[int, int] | None:
    """Return begin and end of the windows over which the speed rises, or falls, through most of its range.

    None where no run goes through most of it, as where the speed is held: torque and speed then change in turn, and a
    speed has more than one value.
    """
    if speed.size < 3 or float(np.ptp(speed)) < 0.02 * float(np.mean(speed)):
        return None
    way = np.sign(np.diff(scipy.ndimage.median_filter(speed, size=5, mode="nearest")))  # a stray window turns no run
    ends = np.concatenate([[0], np.flatnonzero(np.diff(way)) + 1, [way.size]])
    runs = [(int(first), int(last) + 1) for first, last in pairwise(ends)]
    best = max(runs, key=lambda run: abs(float(speed[run[1] - 1] - speed[run[0]])))
    swept = abs(float(speed[best[1] - 1] - speed[best[0]]))
    return best if swept > RUN * float(np.ptp(speed)) and best[1] - best[0] > LASTING * speed.size else None


def _broken(phase: Array) -> Array:
    """Return phases [°] with a gap where they jump from one end of the axis to the other."""
    found = np.array(phase, dtype=float)
    found[1:][np.abs(np.diff(phase)) > 180.0] = math.nan
    return found


# What a fault should show: its orders over the speed where they are largest.

POINTS = 201  # speeds along a curve


def expected_figure(found: Expected) -> Figure:
    """Return the orders of a fault over the speed at the torque of the duty, at the sensor where they are largest."""
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
                title.format(place=place), unit, [one.y for one in curves], dimension=dimension, include=(0.0,), count=4
            ),
        )
        rows.append(Row(panels=(panel,), height=1.5))
    text = _("amplitudes at the torque of the duty; order-of-magnitude, trends are more reliable")
    return Figure(
        name="expected-orders", title=_("What the fault should show"), sentence="", source=text, rows=tuple(rows)
    )


def largest_order(found: Expected) -> tuple[float, str, float] | None:
    """Return the order across the shaft that is largest at top speed, its sensor and its amplitude [m/s²].

    None where there is none across it.
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
