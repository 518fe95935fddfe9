"""Paths of vectors seen along their shaft: the tip of a couple or of a force over a turn, all to one scale."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Quantity
from cardan.figures.axes import clear_way, steps
from cardan.figures.figure import Axis, Curve, Note, Panel, Row, Series
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames

DOWN = 0.99
"""A shaft whose axis has this vertical part is upright: then x runs up on paper instead of z."""


WIDEST = 5
"""Panels side by side at most; more stand in rows of four."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tip:
    """A vector over a turn."""

    title: str  # what stands above it
    dimension: str  # what it is, as of `cardan.answers.quantity.Quantity`; in SI
    axis: Array  # (p, 3): direction of its shaft
    paths: Sequence[Array]  # sequence of array (p, 3): the vector; behind the first, thin ones beside it
    role: str  # role, dash: how it is drawn
    dash: str = "solid"


def end_on(tips: Sequence[Tip], reach: float) -> Iterator[Row]:
    """Yield rows of panels, each a vector seen along the power flow, a dot where it starts.

    reach: the largest of the vectors, for the scale of all.
    """
    wide = len(tips) if 3 <= len(tips) <= WIDEST else 3 if len(tips) < 3 else 4
    panels = [_panel(tip, reach) for tip in tips]
    for first in range(0, len(panels), wide):
        some = panels[first : first + wide]
        some += [Panel(series=(), bare=True)] * (wide - len(some))
        yield Row(panels=tuple(some), height={3: 1.9, 4: 1.6}.get(wide, 1.35))


def _panel(tip: Tip, reach: float) -> Panel:
    along = np.asarray(tip.axis)
    up = np.asarray([1.0, 0.0, 0.0]) if abs(float(along[0, 2])) > DOWN else np.asarray([0.0, 0.0, 1.0])
    up = frames.unit(up - frames.dot(up, along)[:, None] * along)
    right = frames.cross(along, up)
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    series: list[Series] = []
    rings = steps(0.0, reach, 3)[1:]
    series += [Curve(x=ring * np.sin(turn), y=ring * np.cos(turn), role="faint", width=0.8) for ring in rings]
    seen = [(frames.dot(path, right), frames.dot(path, up)) for path in tip.paths]
    for ring in rings[-1:]:
        name = Quantity(ring, tip.dimension, trim=True)
        way = clear_way(np.concatenate([x + 1j * y for x, y in seen]), [ring], 0.5**0.5 * (1.0 - 1.0j))
        series.append(Note(text=name, x=ring * way.real, y=ring * way.imag, role="muted", size=6.6))
    series.append(Curve(x=np.asarray([0.0]), y=np.asarray([0.0]), role="muted", width=0.0, marker=2.5))
    for k, (x, y) in reversed(list(enumerate(seen))):
        series.append(Curve(x=x, y=y, role=tip.role, dash=tip.dash, width=0.7 if k else 1.8))
        if not k:
            series.append(Curve(x=x[:1], y=y[:1], role=tip.role, width=0.0, marker=5.5))
    span = Axis(low=-1.15 * reach, high=1.15 * reach)
    return Panel(series=tuple(series), x=span, y=span, title=tip.title, equal=True, bare=True)
