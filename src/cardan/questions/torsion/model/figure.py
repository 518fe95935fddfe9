"""Torsional modes: the Campbell diagram, and the mode shapes along the line."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.answers.palette import DASHES, shaft
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Band, Curve, Figure, Note, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import mm, rpm

from .torsion import TorsionModes
from .torsional_train import TorsionalTrain

MODES = 4
"""Modes with a curve of their own."""

RAYS = 8
"""Orders with a ray of their own."""

PLACES = (0.72, 0.5, 0.35, 0.25)
"""Where along its ray order 1 may have its word, the first that is clear."""

LETTER = 0.0085
"""Width of a letter, a share of that of the panel, about."""

LOW = 0.1
"""Share of the height that the ray of order 1 leaves free below it for a word."""

SAID = 3
"""Crossings in the sentence below the diagram."""

POINTS = 61
"""Speeds at which natural frequencies are drawn that change with the speed."""


def modes_figures(found: TorsionModes) -> tuple[Figure, ...]:
    """Return the figures of torsional modes."""
    return campbell_figure(found), shapes_figure(found)


def campbell_figure(found: TorsionModes) -> Figure:
    """Return natural frequencies and orders over the input speed, with their meetings and zones of growth."""
    low, top = _window(found)
    high = _height(found, top)
    ticks_x, ticks_y = steps(low, top, 8), steps(0.0, high, 6)
    panel = Panel(
        series=tuple(_campbell(found, top, high)),
        x=Axis(
            label=_("input speed"),
            unit="rpm",
            dimension="angular_speed",
            low=low,
            high=top,
            ticks=ticks_x,
            texts=written(ticks_x),
        ),
        y=Axis(
            label=_("frequency"),
            unit="Hz",
            dimension="frequency",
            low=0.0,
            high=high,
            ticks=ticks_y,
            texts=written(ticks_y),
        ),
    )
    return Figure(
        name="campbell",
        title=_("Campbell diagram of the torsional modes"),
        sentence=_campbell_sentence(found),
        source=_(
            "natural frequencies with straight joints; zones to first order, Kozhevnikov & Perfil'ev "
            "(1978), eq. 221 with the corrected q"
        ),
        rows=(Row(panels=(panel,), height=3.0),),
        legend=True,
    )


def _window(found: TorsionModes) -> tuple[float, float]:
    """Return the speeds drawn [rpm]."""
    wanted = [float(one.speed) for one in found.crossings if one.mode == 1] + [float(found.omega[0])]
    if found.speed_range is not None:
        wanted = [*found.speed_range, *(one for one in wanted if one < 1.5 * found.speed_range[1])]
    wanted.append(found.speed)
    return 0.0, 1.1 * max(wanted) / rpm


def _height(found: TorsionModes, top: float) -> float:
    seen = [float(one) / (2.0 * math.pi) for one in found.omega[:MODES]]
    reach = 4.0 * top / 60.0
    return 1.15 * max([seen[0], *(one for one in seen if one < reach)])


def _campbell(found: TorsionModes, top: float, high: float) -> Iterator[Series]:
    if found.speed_range is not None:
        one, two = (end / rpm for end in found.speed_range)
        yield Band(low=one, high=two, upright=True, role="accent", opacity=0.08)
        low = one / 60.0 > LOW * high  # else the rays of the orders run there
        yield Note(
            text=_("operating range"),
            x=one,
            y=(0.03 if low else 0.96) * high,
            role="accent",
            side="left",
            shift=(4.0, 0.0),
        )
    for k, zone in enumerate(found.zone[:MODES] / rpm):
        if np.all(np.isfinite(zone)) and zone[0] < top:
            yield Band(low=float(zone[0]), high=float(zone[1]), upright=True, role="failed", opacity=0.25)
            text = _("mode {number} unstable").format(number=k + 1)
            yield Note(
                text=text, x=float(zone[0]), y=(0.1 + 0.06 * k) * high, role="failed", side="right", shift=(-4.0, 0.0)
            )
    if found.speed:
        yield Rule(value=found.speed / rpm, upright=True, role="accent")
        yield Note(text=_("duty"), x=found.speed / rpm, y=0.1 * high, role="accent", side="left", shift=(4.0, 0.0))
    orders = sorted({one.order: one.cause for one in found.crossings if one.torque is None}.items())[:RAYS]
    for order, _cause in [(1.0, ""), *orders]:
        end = min(top, 60.0 * high / order)
        ends = np.asarray([0.0, end])
        plain = order == 1.0 and not any(one == 1.0 for one, _why in orders)
        word = _("order 1: parametric") if plain else _("order {order}").format(order=f"{order:g}")
        dash = "dotted" if plain else "dashed"
        yield Curve(x=ends, y=order * ends / 60.0, role="muted", width=0.9, dash=dash, text=word)
        share = _clear(found, end, top, len(word)) if plain else 0.94
        yield Note(text=word, x=share * end, y=share * order * end / 60.0, role="muted", side="left", shift=(5.0, -5.0))
    yield from _side_rays(found, top, high)
    speeds = np.linspace(0.0, top, POINTS if found.train.pendulums else 2)[1 if found.train.pendulums else 0 :]
    curves = found.at(speeds * rpm) / (2.0 * math.pi)
    for k in range(min(MODES, curves.shape[-1])):
        if np.nanmin(curves[:, k]) <= high:
            label = _("mode {number}").format(number=k + 1)
            yield Curve(x=speeds, y=curves[:, k], role=shaft(k + 2), width=1.8, label=label)
    for met in found.crossings:
        place = met.order * met.speed / (2.0 * math.pi)
        if met.speed / rpm <= top and met.mode <= MODES and place <= high:
            role = "failed" if met.inside else "ink"
            text = _("order {order:g} meets mode {mode}").format(order=met.order, mode=met.mode)
            yield Curve(x=_at(met.speed / rpm), y=_at(place), role=role, width=0.0, marker=5.0, text=text)


def _side_rays(found: TorsionModes, top: float, high: float) -> Iterator[Series]:
    """Yield the orders of side bands with the largest torque that each makes where it meets a mode."""
    sides = [one for one in found.crossings if one.torque is not None and one.speed / rpm <= top]
    for k, order in enumerate(sorted({one.order for one in sides})[:RAYS]):
        end = min(top, 60.0 * high / order)
        torque = max(float(one.torque or 0.0) for one in sides if one.order == order)
        text = _("order {order}, side band: ±{torque}")
        word = say(text, order=Quantity(order, digits=4, trim=True), torque=Quantity(torque, "torque", 2))
        ends = np.asarray([0.0, end])
        yield Curve(x=ends, y=order * ends / 60.0, role="muted", width=0.7, dash="dotted", text=word)
        share = 0.82 - 0.09 * k  # below each other: their rays stand close
        yield Note(text=word, x=share * end, y=share * order * end / 60.0, role="muted", side="left", shift=(5.0, -5.0))


def _clear(found: TorsionModes, end: float, top: float, letters: int) -> float:
    """Return where along a ray a word of so many letters crosses neither the running speed nor a zone of growth."""
    zones = found.zone[:MODES]
    upright = np.append(zones[np.isfinite(zones)], [found.speed] if found.speed else []) / rpm

    def crossed(share: float) -> int:
        begin = share * end
        return int(np.sum((upright > begin - 0.01 * top) & (upright < begin + (LETTER * letters + 0.02) * top)))

    return min(PLACES, key=crossed)


def _at(value: float) -> Array:
    return np.asarray([value])


def _campbell_sentence(found: TorsionModes) -> Text:
    """Return the first crossings in the operating range; nothing where there are none."""
    text = _("order {order} at {speed}")
    said = [
        say(text, order=Quantity(one.order, trim=True), speed=Quantity(one.speed, "angular_speed", 3))
        for one in found.crossings
        if one.inside
    ]
    if not said:
        return ""
    return say(_("Crossings in the operating range: {said}."), said=Joined(said[:SAID], between="; "))


def shapes_figure(found: TorsionModes) -> Figure:
    """Return the shapes of the lowest modes along the line, with the joints and the nodes."""
    train = found.train
    line = list(train.line)
    positions = _along(train, train.position)
    place = positions[line]
    series: list[Series] = [Rule(value=0.0, role="muted", dash="solid")]
    for number, (_driving, driven) in enumerate(train.joints, start=1):
        series.append(Rule(value=float(positions[driven]), upright=True, text=str(number)))
    for k in range(min(MODES, len(found.omega))):
        own = Quantity(float(found.omega[k]), "frequency", 3)
        series.append(
            Curve(
                x=place,
                y=found.shape[k, line],
                role=shaft(k + 2),
                dash=DASHES[k % len(DASHES)],
                marker=4.0,
                label=say(_("mode {number}, {frequency}"), number=k + 1, frequency=own),
            )
        )
        for node in found.nodes[k]:
            series.append(
                Curve(x=_along(train, _at(node.position)), y=_at(0.0), role=shaft(k + 2), width=0.0, marker=7.0)
            )
    for k, host in enumerate(train.hangs):
        if host is not None:
            shown = found.shape[0, k]
            dot = Curve(x=_at(positions[k]), y=_at(shown), role="accent", width=0.0, marker=4.0)
            series.append(replace(dot, text=_("attached")))
            far = float(positions[k]) > 0.5 * float(place[0] + place[-1])
            word = Note(text=_("attached"), x=float(positions[k]), y=float(shown))
            series.append(replace(word, side="right" if far else "left", shift=(-5.0 if far else 5.0, 0.0)))
    ticks = (-1.0, -0.5, 0.0, 0.5, 1.0)
    along, unit, dimension = _("along the shafts from the input end; joints by their numbers"), "mm", "length"
    if not train.to_scale:
        along, unit, dimension = _("shafts from the input end, not to scale; joints by their numbers"), "", ""
    panel = Panel(
        series=tuple(series),
        x=axis(along, unit, [place], dimension=dimension, margin=0.04, count=8),
        y=Axis(label=_("amplitude, largest 1"), low=-1.1, high=1.1, ticks=ticks, texts=written(ticks)),
    )
    return Figure(
        name="torsion-shapes",
        title=_("Torsional mode shapes"),
        sentence="" if found.nodes[0] else _("Mode 1 has no node; the input is held."),
        source=_("(K − ω²M) u = 0 with straight joints"),
        rows=(Row(panels=(panel,), height=2.2),),
    )


def _along(train: TorsionalTrain, position: Array) -> Array:
    """Return places along the line [mm]; where the drive does not give its lengths, by shafts of length 1."""
    if train.to_scale:
        return np.asarray(position) / mm
    ends = [0.0, *(float(train.position[driven]) for _driving, driven in train.joints)]
    last = float(np.max(train.position))
    ends.append(last if last > ends[-1] else 2.0 * ends[-1])
    return np.interp(position, ends, np.arange(len(ends), dtype=float))


FIGURES = {TorsionModes: modes_figures}
"""Result -> what makes its figures."""
