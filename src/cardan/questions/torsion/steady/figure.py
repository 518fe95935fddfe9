"""Torsional vibration of a running drive: torques over a turn, over speeds and in time, and where it is stable."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from cardan.answers.palette import DASHES, shaft
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.figures.axes import across, axis, steps, written
from cardan.figures.figure import Axis, Band, Bars, Curve, Dash, Figure, Panel, Row
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.texts import _
from cardan.units import deg, rpm

from .run_stability import Verdict
from .torsion_response import TorsionResponse

CURVES = 6
"""Elements with a curve of their own, those of the largest alternating torques."""

ORDERS = 4
"""Orders with a curve of their own, the strongest."""

BARS = 12
"""Orders with a bar of their own."""

SEEN = 5e-3
"""Share of the strongest order below which another one is a line on the axis."""

FALLS = 24
"""Speeds of a waterfall."""


def response_figures(found: TorsionResponse) -> tuple[Figure, ...]:
    """Return the figures of steady torsional vibration, at one speed or over many."""
    if found.speed.ndim:
        return sweep_figure(found), waterfall_figure(found)
    return (response_figure(found),) if bool(found.steady.found) else ()


def worst_elements(swing: Array) -> list[int]:
    """Return the elements with the largest alternating torques, the worst first."""
    return [int(e) for e in np.argsort(-np.nan_to_num(swing), kind="stable")[:CURVES]]


def looks(train: TorsionalTrain, elements: Sequence[int]) -> Iterator[tuple[int, str, Dash]]:
    """Yield some elements along the line, each in the colour of its shaft; more of one shaft differ by their dashes."""
    drawn: dict[int, int] = {}
    for n, e in enumerate(sorted(elements)):
        number = train.model.shaft[train.model.elements[e][0]] + 1
        drawn[number] = drawn.get(number, n - 1) + 1
        yield e, shaft(number), DASHES[drawn[number] % len(DASHES)]


def response_figure(found: TorsionResponse) -> Figure:
    """Return the torques over a turn and the orders of the one that alternates most."""
    turn = max(2.0 * math.pi, found.steady.period)
    angle = np.linspace(0.0, turn, 721)
    traces = found.steady.at(angle)
    names, worst = found.train.elements, worst_elements(found.swing)
    torque = np.asarray(traces.torque)
    over = Panel(
        series=tuple(
            Curve(x=angle / deg, y=torque[:, e], role=role, dash=dash, label=names[e])
            for e, role, dash in looks(found.train, worst)
        ),
        x=across(angle / deg, named=True),
        y=axis(_("Torque"), "Nm", [torque[:, worst]], dimension="torque", count=5),
    )
    e = worst[0]
    order, amplitude = orders_of(found, e)
    kept = [k for k in np.argsort(-amplitude, kind="stable")[:BARS] if amplitude[k] > 1e-4 * np.max(amplitude)]
    bars = order_bars(_("Amplitude"), names[e], order, amplitude, sorted(int(k) for k in kept))
    source = _("periodic solution of the exact equations of motion")
    return Figure(
        name="torsion-response",
        title=say(_("Torques in steady running at {speed}"), speed=_speed(abs(float(found.speed)))),
        sentence="",
        source=Joined([source, _left_out(found, worst), _beside(found)], between=""),
        rows=(Row(panels=(over,), height=2.0), Row(panels=(bars,), height=1.2)),
    )


def order_bars(label: str, name: Text, order: Array, amplitude: Array, kept: Sequence[int]) -> Panel:
    """Return amplitudes (K,) [N·m] of orders (K,) in an element as bars: those that are kept, in their order."""
    top = float(np.max(amplitude[list(kept)], initial=0.0)) or 1.0
    ticks = steps(0.0, top, 4)
    return Panel(
        series=(
            Bars(
                at=np.arange(len(kept), dtype=float),
                size=amplitude[list(kept)],
                roles=("accent",),
                texts=tuple(say("{torque:bare}", torque=_torque(amplitude[k])) for k in kept),
            ),
        ),
        x=Axis(
            label=say(_("order of the input shaft, in {name}"), name=name),
            low=-0.6,
            high=max(len(kept), 1) - 0.4,
            ticks=tuple(float(k) for k in range(len(kept))),
            texts=tuple(f"{order[k]:g}" for k in kept),
            grid=False,
        ),
        y=Axis(
            label=label,
            unit="Nm",
            dimension="torque",
            low=0.0,
            high=1.2 * top,
            ticks=ticks,
            texts=written(ticks),
        ),
    )


def orders_of(found: TorsionResponse, e: int) -> tuple[Array, Array]:
    """Return the orders of the torque in an element with their amplitudes (..., K) [N·m].

    Those of torques that no two turns hold a whole number of times are among them, by their size.
    """
    more = [one for one in found.apart if not np.any(np.isclose(found.steady.order, one.order))]
    order = np.append(found.steady.order, [one.order for one in more])
    own = [np.abs(one.torque)[..., e, None] for one in more]
    for band in found.bands:
        beside = ~np.isclose(band.order[:, None], [abs(one.order) for one in found.apart]).any(axis=-1)
        order = np.append(order, band.order[beside])
        own.append(np.abs(band.amplitude[:, e][..., beside]).reshape(*found.speed.shape, -1))
    amplitude = np.concatenate([found.steady.torque.amplitude[..., e, :], *own], axis=-1)
    sorting = np.argsort(order, kind="stable")
    return order[sorting], amplitude[..., sorting]


def _left_out(found: TorsionResponse, shown: Sequence[int]) -> str:
    """Return how many torques are drawn, where not all of them are."""
    every = len(found.train.element_names)
    if len(shown) == every:
        return ""
    return _("; the {shown} largest alternating torques of {all}").format(all=every, shown=len(shown))


def _beside(found: TorsionResponse) -> Text:
    """Return what the curves over the turn leave out: torques that do not repeat with it."""
    if not found.apart:
        return ""
    text = _("order {order}, at most ±{torque}")
    parts = [
        say(text, order=Quantity(one.order, trim=True), torque=_torque(float(np.max(np.abs(one.torque)))))
        for one in found.apart
    ]
    text = _("; the curves leave out what does not repeat within two turns: {orders}")
    return say(text, orders=Joined(parts, between="; "))


def _torque(value: float) -> Quantity:
    return Quantity(float(value), "torque", 3)


def _speed(value: float, digits: int = 4) -> Quantity:
    return Quantity(float(value), "angular_speed", digits)


def sweep_figure(found: TorsionResponse) -> Figure:
    """Return highest and lowest torques and their orders over the input speed, unstable speeds shaded."""
    speed = np.abs(found.speed) / rpm
    names = found.train.elements
    peak = np.nanmax(np.where(np.isfinite(found.swing), found.swing, np.nan), axis=0, initial=0.0)
    worst = worst_elements(peak)
    shaded = tuple(unstable_bands(speed, found.floquet.verdict))
    swings = Panel(
        series=(
            *shaded,
            *(
                Curve(x=speed, y=found.swing[:, e], role=role, dash=dash, label=names[e])
                for e, role, dash in looks(found.train, worst)
            ),
        ),
        x=axis("", "", [speed], margin=0.0, count=8),
        y=axis(_("Alternating torque, ±"), "Nm", [found.swing[:, worst]], dimension="torque", include=(0.0,), count=5),
    )
    e = worst[0]
    order, amplitude = orders_of(found, e)
    height = np.nan_to_num(np.max(np.nan_to_num(amplitude), axis=0))
    strongest = sorted(int(k) for k in np.argsort(-height)[:ORDERS] if height[k] >= SEEN * np.max(height))
    orders = Panel(
        series=(
            *shaded,
            *(
                Curve(
                    x=speed,
                    y=amplitude[:, k],
                    role="accent",
                    dash=DASHES[n % 4],
                    label=_("order {order}").format(order=f"{order[k]:g}"),
                )
                for n, k in enumerate(strongest)
            ),
        ),
        x=axis(_("input speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=replace(
            axis("", "Nm", [amplitude[:, strongest]], dimension="torque", include=(0.0,), count=4),
            label=say(_("Orders of {name}, ±"), name=names[e]),
        ),
    )
    return Figure(
        name="torsion-sweep",
        title=_("Torsional vibration over the speed"),
        sentence=_("Shaded speeds are unstable.") if shaded else "",
        source=Joined(
            [
                _("periodic solutions of the exact equations of motion, judged by their Floquet multipliers"),
                _left_out(found, worst),
            ],
            between="",
        ),
        rows=(Row(panels=(swings,), height=2.0), Row(panels=(orders,), height=1.6)),
    )


def unstable_bands(place: Array, verdict: Array) -> Iterator[Band]:
    """Yield the ranges in which a motion is unstable."""
    mask = np.asarray(verdict) == Verdict.UNSTABLE
    half = 0.5 * np.gradient(place) if len(place) > 1 else np.ones(1)
    for one, two in runs(mask):
        yield Band(
            low=float(place[one] - half[one]),
            high=float(place[two] + half[two]),
            upright=True,
            role="failed",
            opacity=0.18,
        )


def runs(mask: Array) -> Iterator[tuple[int, int]]:
    """Yield first and last place of every run of True."""
    ends = np.flatnonzero(np.diff(np.concatenate([[False], mask, [False]]).astype(int)))
    for first, behind in zip(ends[::2], ends[1::2], strict=True):
        yield int(first), int(behind) - 1


def waterfall_figure(found: TorsionResponse) -> Figure:
    """Return the orders of the largest alternating torque at some speeds, one behind the other."""
    speed = np.abs(found.speed) / rpm
    peak = np.nanmax(np.where(np.isfinite(found.swing), found.swing, np.nan), axis=0, initial=0.0)
    e = worst_elements(peak)[0]
    order, amplitude = orders_of(found, e)
    amplitude = np.nan_to_num(amplitude)
    last = int(np.max(np.flatnonzero(np.max(amplitude, axis=0) > 2e-3 * np.max(amplitude)), initial=1))
    order, amplitude = order[: last + 1], amplitude[:, : last + 1]
    stretches = np.array_split(np.arange(len(speed)), min(FALLS, len(speed)))
    chosen = np.asarray([k[int(np.argmax(np.max(amplitude[k], axis=1)))] for k in stretches])
    gap = (speed[-1] - speed[0]) / max(len(chosen) - 1, 1) or 1.0
    scale = 4.0 * abs(gap) / (float(np.max(amplitude)) or 1.0)
    narrow = 0.1 * float(order[0])
    curves = []
    for k in chosen[::-1]:
        x = np.concatenate([[0.0], *([v - narrow, v, v + narrow] for v in order), [order[-1] + 2 * narrow]])
        y = np.zeros(len(x))
        y[2::3][: len(order)] = scale * amplitude[k]
        curves.append(Curve(x=x, y=speed[k] + y, role="accent", width=0.9))
    ticks = tuple(float(v) for v in order if float(v).is_integer())
    panel = Panel(
        series=tuple(curves),
        x=Axis(
            label=_("order of the input shaft"),
            low=0.0,
            high=float(order[-1]) + 2 * narrow,
            ticks=ticks,
            texts=tuple(f"{v:g}" for v in ticks),
        ),
        y=axis(
            _("input speed"),
            "rpm",
            [speed],
            dimension="angular_speed",
            include=(max(float(np.max(one.y)) for one in curves),),
            count=8,
        ),
    )
    tallest = np.unravel_index(int(foremost(amplitude.ravel())), amplitude.shape)
    text = _("The tallest peak is order {order} at {speed}, ±{torque}.")
    return Figure(
        name="torsion-waterfall",
        title=say(_("Orders of the torque in {name}"), name=found.train.elements[e]),
        sentence=say(
            text,
            order=Quantity(float(order[tallest[1]]), trim=True),
            speed=_speed(abs(float(found.speed[tallest[0]])), 3),
            torque=_torque(float(amplitude[tallest])),
        ),
        source=_("harmonics of the periodic solutions; heights to one scale"),
        rows=(Row(panels=(panel,), height=3.0),),
        legend=False,
    )


FIGURES = {TorsionResponse: response_figures}
"""Result -> what makes its figures."""
