"""What a recording tells of a drive: causes by likelihood, and how the shaft moved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from math import isfinite

import numpy as np

from cardan.answers.palette import shaft
from cardan.answers.quantity import Quantity, Text, say
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row
from cardan.maths.ties import foremost, foremost_of
from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.findings import Finding
from cardan.questions.diagnosis.signals.orbit import Orbit
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.torsional import TorsionalVibration
from cardan.texts import _
from cardan.units import deg, rpm

from .orders import (
    amplitude_of,
    map_figure,
    order_text,
    quantity_word,
    spectrum_figure,
    tracks_figure,
    trusted,
    unit_of,
)

SHOWN = 6  # causes with a bar
LONG = 44  # letters of the name of a cause
LIKELY = 0.5  # probability from which on a cause is called likely


def examination_figures(found: Examination) -> tuple[Figure, ...]:
    """Return the figures of an examination: causes, orders over speed, spectrum, orders followed, motion."""
    figures = [causes_figure(found.findings), examined_map(found), spectrum_figure(found.spectrum)]
    figures += [tracks_figure(found.tracks), rotation_figure(found.rotation)]
    if found.orbit is not None:
        figures.append(orbit_figure(found.orbit))
    if found.swing is not None:
        figures.append(torsional_figure(found.swing))
    return tuple(figures)


def examined_map(found: Examination) -> Figure:
    """Return the order map with the critical speed of the drive, and the orders of the likeliest cause."""
    critical = [found.critical] if isfinite(found.critical) else []
    lines = found.expected.orders if found.expected is not None else ()
    orders = sorted({line.order for line in lines} | {1.0, 2.0})
    return map_figure(found.map, critical_speeds=critical, orders=orders)


def causes_figure(findings: Sequence[Finding]) -> Figure:
    """Return the probability of the likeliest causes."""
    shown = findings[:SHOWN]
    size = np.asarray([100.0 * one.score for one in shown])
    at = np.arange(len(shown), 0, -1, dtype=float)
    first = "good" if shown[0].cause == "healthy" else "accent"
    texts = tuple(Quantity(one.score, "share", decimals=0) for one in shown)
    bars = Bars(at=at, size=size, texts=texts, roles=(first, *("muted",) * (len(shown) - 1)), thick=0.62, lying=True)
    ticks = steps(0.0, 100.0, 5)
    names = tuple(_short(one.fault) for one in shown)
    x = Axis(low=0.0, high=112.0, ticks=ticks, texts=written(ticks))
    y = Axis(low=0.4, high=len(shown) + 0.6, ticks=tuple(at), texts=names, grid=False)
    panel = Panel(series=(bars,), x=x, y=y, title=_("Probability"), dimension="share", unit="percent")
    text = _("weights of a multinomial logistic model, calibrated on simulated recordings")
    rows = (Row(panels=(panel,), height=0.27 * len(shown) + 0.3),)
    return Figure(name="causes", title=_("What is likely wrong"), sentence="", source=text, rows=rows, legend=False)


def verdict(findings: Sequence[Finding]) -> Text:
    """Return in one sentence what a recording comes to, never surer than it is."""
    first, second = findings[0], findings[1]
    share, other = (Quantity(one.score, "share", decimals=0) for one in (first, second))
    if first.score < LIKELY:
        text = _("No cause stands out: {first} ({share}), or {second} ({next_share}).")
    elif first.cause == "healthy":
        text = _("No fault shows ({share}).")
    else:
        text = _("Likely: {first} ({share}).")
    said = say(text, first=first.fault, share=share, second=second.fault, next_share=other)
    return trusted(said, first.confidence)


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"


# A recording as motion: how the shaft turned, where its centre went, how it swung about its turning.

POINTS = 800  # points of a curve at most
TURNS = 2.0  # turns of the twist that are drawn
ORDERS = 12.0  # highest order of the twist drawn


def rotation_figure(found: Rotation) -> Figure:
    """Return the speed over time, each value the mean of a turn."""
    count = int(min(max(found.turns, 2.0), POINTS))
    angle = np.linspace(float(found.angle[0]), float(found.angle[-1]), count + 1)
    time = found.time_at(angle)
    speed = np.diff(angle) / np.diff(time) / rpm
    panel = Panel(
        series=(Curve(x=0.5 * (time[1:] + time[:-1]), y=speed, role="accent"),),
        x=axis(_("time"), "s", [time], dimension="time", margin=0.0, count=8),
        y=axis(_("Speed"), "rpm", [speed], dimension="angular_speed", least=0.02 * float(np.mean(speed)), count=5),
    )
    sources = {
        "pulses": _("from the pulses of the tacho"),
        "speed": _("from a channel of the speed"),
        "angle": _("from a channel of the angle"),
        "ridge": _("found in what shakes, without a tacho"),
    }
    low, high = (Quantity(one, "angular_speed", 3) for one in found.speeds)
    text = _("{turns} turns, from {low:bare} to {high}.")
    sentence = say(text, turns=Quantity(found.turns, decimals=0), low=low, high=high)
    return Figure(
        name="rotation",
        title=_("How the shaft turned"),
        sentence=trusted(sentence, found.confidence),
        source=sources[found.source],
        rows=(Row(panels=(panel,), height=1.8),),
        legend=False,
    )


def orbit_figure(found: Orbit) -> Figure:
    """Return the orbit as measured, and the ellipse of each order."""
    dimension, unit, size = unit_of(found.quantity)
    wide = max(float(np.max(np.abs(found.x))), float(np.max(np.abs(found.y))), 1e-300) / size
    reach = 1.1 * wide
    own = 1.15 * max([one.major for one in found.ellipses], default=wide * size) / size or reach

    def frame(end: float, name: str) -> Axis:
        ticks = steps(-end, end, 4)
        return Axis(label=name, unit=unit, dimension=dimension, low=-end, high=end, ticks=ticks, texts=written(ticks))

    step = max(1, found.x.size // (4 * POINTS))
    raw = Panel(
        series=(
            Curve(x=found.x[::step] / size, y=found.y[::step] / size, role="muted", width=0.5, label=_("as measured")),
            Curve(x=found.x[:1] / size, y=found.y[:1] / size, role="ink", width=0.0, marker=6.0, label=_("the mark")),
        ),
        x=frame(reach, found.names[0]),
        y=frame(reach, found.names[1]),
        title=_("As measured"),
        equal=True,
    )
    curves = []
    for k, one in enumerate(found.ellipses):
        x, y = one.points()
        label = _("order {order}").format(order=f"{one.order:g}")
        curves.append(Curve(x=x / size, y=y / size, role=shaft(k + 2), label=label))
        curves.append(Curve(x=x[:1] / size, y=y[:1] / size, role=shaft(k + 2), width=0.0, marker=6.0))
    text = _("Each order alone")
    filtered = Panel(
        series=tuple(curves), x=frame(own, found.names[0]), y=frame(own, found.names[1]), title=text, equal=True
    )
    return Figure(
        name="orbit",
        title=_("Orbit of {x} and {y}").format(x=found.names[0], y=found.names[1]),
        sentence=trusted(_orbit_sentence(found), found.confidence),
        source=_("two sensors across the shaft; ellipses fitted over {turns} turns").format(
            turns=f"{(found.angle[-1] - found.angle[0]) / (2 * math.pi):.0f}"
        ),
        rows=(Row(panels=(raw, filtered), height=3.0),),
    )


def _orbit_sentence(found: Orbit) -> Text:
    speed = Quantity(found.speed, "angular_speed", 3)
    if not found.ellipses:
        return say(_("The {quantity} at {speed}."), quantity=quantity_word(found.quantity), speed=speed)
    first = foremost_of(found.ellipses, lambda one: one.major)
    way = _("with the shaft") if first.minor >= 0.0 else _("against the shaft")
    return say(
        _("At {speed} order {order} is the largest: {major:bare} by {minor}, run through {way}."),
        speed=speed,
        order=f"{first.order:g}",
        major=amplitude_of(found.quantity, first.major),
        minor=amplitude_of(found.quantity, abs(first.minor)),
        way=way,
    )


def torsional_figure(found: TorsionalVibration) -> Figure:
    """Return the twist over some turns, and its orders."""
    shown = int(TURNS * found.teeth)
    angle = (found.angle[:shown] - found.angle[0]) / (2.0 * math.pi)
    twist = found.twist[:shown] / deg
    course = Panel(
        series=(Curve(x=angle, y=twist, role="accent"),),
        x=axis(_("turns"), "", [angle], margin=0.0, count=8),
        y=axis(_("Angle error against uniform rotation"), "deg", [twist], dimension="angle", mirrored=0.0),
    )
    near = found.order <= min(ORDERS, 0.25 * found.teeth)
    lines = found.twist_amplitude[near] / deg
    orders = Panel(
        series=(Curve(x=found.order[near], y=lines, role="accent", width=1.1),),
        x=axis(_("order: times a turn"), "", [found.order[near]], margin=0.0, count=10),
        y=axis(_("Peak amplitude of the twist"), "deg", [lines], dimension="angle", include=(0.0,)),
    )
    inner = np.flatnonzero(near & (found.order > 0.2))
    best = int(inner[foremost(found.twist_amplitude[inner])]) if inner.size else 0
    sentence = say(
        _("The shaft oscillates by ±{twist} in order {order}, at a mean speed of {speed}."),
        twist=Quantity(float(found.twist_amplitude[best]), "angle", 3),
        order=order_text(float(found.order[best])),
        speed=Quantity(float(np.mean(found.speed)), "angular_speed", 3),
    )
    return Figure(
        name="torsional-vibration",
        title=_("Torsional vibration by {name}").format(name=found.name),
        sentence=trusted(sentence, found.confidence),
        source=_("times of {teeth} teeth a turn; errors of teeth averaged over the turns and left out").format(
            teeth=found.teeth
        ),
        rows=(Row(panels=(course,), height=1.6), Row(panels=(orders,), height=1.6)),
        legend=False,
    )
