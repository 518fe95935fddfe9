"""Layouts of bearings as small pictures: shafts, joints, splines and what holds them, from input to output."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import say
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Series
from cardan.texts import _

from .bearing_layouts import BearingLayouts, HeldDrive

LOW, HIGH = 0.5, 0.4
"""How far a picture reaches below and above its line, over the length of a shaft."""

WIDE = 3.5
"""Width of a picture [inch]."""

ABREAST = 2
"""Pictures side by side."""

RISE = 0.14
"""How far joints stand above and below the line in turn, over the length of a shaft."""

GROUND = 0.2
"""How far below its shaft a bearing stands on the frame."""


def layouts_figure(result: BearingLayouts) -> Figure:
    """Return a picture of each layout that is told."""
    panels = [_panel(one, number, result.freedoms) for number, one in enumerate(result.best, 1)]
    if len(panels) % ABREAST:
        panels += [Panel(series=(), bare=True)] * (ABREAST - len(panels) % ABREAST)
    height = min(WIDE * (LOW + HIGH) / (len(result.freedoms) + 1.2), 1.2)
    rows = [Row(panels=tuple(panels[k : k + ABREAST]), height=height) for k in range(0, len(panels), ABREAST)]
    return Figure(
        name="layouts",
        title=_("Statically determinate layouts"),
        sentence=_("Triangles locate along the axis, circles let it slide; two side by side do not let it tilt."),
        source=_(
            "Graph of links and pairs, Kozhevnikov and Perfil'ev (1978), p. 74-79; rank of the constraints; turned "
            "all round"
        ),
        rows=tuple(rows),
        legend=False,
    )


def _panel(one: HeldDrive, number: int, own: tuple[int, ...]) -> Panel:
    count = len(one.layout.shafts)
    return Panel(
        series=tuple(_drawn(one, own)),
        x=Axis(low=-0.1, high=count + 0.1),
        y=Axis(low=-LOW, high=HIGH),
        title=say(_("layout {number}"), number=number),
        bare=True,
        equal=True,
    )


def _drawn(one: HeldDrive, own: tuple[int, ...]) -> Iterator[Series]:
    count = len(one.layout.shafts)
    height = [0.0, *(RISE * (-1) ** k for k in range(count - 1)), 0.0]
    for k, parts in enumerate(one.layout.shafts):
        start, end = np.asarray([float(k), height[k]]), np.asarray([k + 1.0, height[k + 1]])
        yield Curve(x=np.stack((start, end))[:, 0], y=np.stack((start, end))[:, 1], width=2.0)
        if len(parts) == 2:
            yield from _spline(0.5 * (start + end), end - start)
        for place, bearing in enumerate(parts):
            if bearing:
                share = 0.5 if len(parts) == 1 else (0.25, 0.75)[place]
                yield from _bearing(bearing, start + share * (end - start))
    for k in range(1, count):
        joint, free = one.drive.joints[k - 1], one.layout.joints[k - 1]
        yield Curve(x=np.asarray([float(k)]), y=np.asarray([height[k]]), role="accent", width=0.0, marker=6.0)
        if free != own[k - 1]:
            yield Note(text=joint.in_words(), x=float(k), y=height[k], shift=(0.0, 6.0), level="bottom", size=6.5)


def _spline(middle: np.ndarray, way: np.ndarray) -> Iterator[Series]:
    """Yield a sleeve: a line to both sides of the shaft."""
    along = way / np.hypot(*way)
    across = np.asarray([-along[1], along[0]])
    for side in (-0.07, 0.07):
        ends = np.stack((middle - 0.12 * along, middle + 0.12 * along)) + side * across
        yield Curve(x=ends[:, 0], y=ends[:, 1], width=1.6, role="accent")


def _bearing(bearing: str, at: np.ndarray) -> Iterator[Series]:
    """Yield the bearings that hold a part of a shaft, on the frame."""
    apart = (0.0,) if bearing in ("SG", "S") else (-0.1, 0.1)
    floor = float(at[1]) - GROUND
    for k, shift in enumerate(apart):
        x, y = float(at[0]) + shift, float(at[1])
        if k == 0 and bearing in ("S", "R"):
            yield Curve(
                x=np.asarray([x, x - 0.08, x + 0.08, x]), y=np.asarray([y, floor, floor, y]), width=1.2, role="warning"
            )
        else:
            turn = np.linspace(0.0, 2.0 * np.pi, 25)
            half = 0.5 * GROUND
            yield Curve(x=x + half * np.cos(turn), y=y - half + half * np.sin(turn), width=1.2, role="warning")
    yield Curve(x=np.asarray([at[0] - 0.2, at[0] + 0.2]), y=np.asarray([floor, floor]), width=1.0, role="muted")
