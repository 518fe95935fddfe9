"""Torsional vibration along a movement: torques and growth over the time, and the envelope of their spectrum."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.palette import DASHES
from cardan.answers.quantity import Quantity, Text, say
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Band, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.questions.torsion.steady.figure import looks, order_bars, worst_elements
from cardan.texts import _
from cardan.units import deg

from .road import MULTIPLE, RoadTorsion

LEVELS = 60
"""Levels of a torque over whose distribution it is drawn."""


def road_figures(found: RoadTorsion) -> tuple[Figure, ...]:
    """Return the figure of torsional vibration along a movement, or over a distribution."""
    return (road_figure(found),)


def road_figure(found: RoadTorsion) -> Figure:
    """Return torques along the movement with resonance and instability, and the envelope of their spectrum."""
    rows = (Row(panels=(_risk(found),), height=2.0),) if found.places.times is None else tuple(_along(found))
    source = _("exact equations of motion with the joint angles of the movement, integrated in time")
    if found.moving is None:
        source = _("periodic solution of the exact equations of motion, as if the drive stood at every instant")
    return Figure(
        name="torsion-road",
        title=_("Torques along the movement"),
        sentence="",
        source=source,
        rows=(*rows, Row(panels=(_spectrum(found),), height=1.2)),
    )


def _shown(found: RoadTorsion) -> list[int]:
    """Return the elements of the line with the largest torques."""
    most = np.zeros(len(found.train.elements))
    most[found.line] = np.max(found.places.largest[found.likely][:, found.line], axis=0)
    return [e for e in worst_elements(most) if e in found.line][:3]


def _along(found: RoadTorsion) -> Iterator[Row]:
    """Yield the torques and the joint angles over the time."""
    places, shown = found.places, _shown(found)
    times = places.times
    assert times is not None
    names = found.train.elements
    series: list[Series] = list(_grows(found))
    for e, role, dash in looks(found.train, shown):
        series += [
            Curve(x=times, y=places.high[:, e], role=role, dash=dash, width=1.2, label=names[e]),
            Curve(x=times, y=places.low[:, e], role=role, dash=dash, width=1.2),
        ]
    if found.nominal > 0.0:
        series += [_multiple(found, 1.0)] if np.nanmax(places.high[:, shown]) > 0.5 * MULTIPLE * found.nominal else []
    drawn = [places.low[:, shown], places.high[:, shown], np.zeros(1)]
    yield Row(
        panels=(
            Panel(
                series=tuple(series),
                x=axis("", "", [times], margin=0.0, count=8),
                y=axis(_("Lowest and highest torque"), "Nm", drawn, dimension="torque", count=5),
            ),
        ),
        height=2.0,
    )
    yield Row(
        panels=(
            Panel(
                series=tuple(
                    Curve(
                        x=times,
                        y=angle / deg,
                        role="ink",
                        dash=DASHES[i % len(DASHES)],
                        label=_("joint {number}").format(number=i + 1),
                    )
                    for i, angle in enumerate(places.joint_angle.T)
                ),
                x=axis(_("time"), "s", [times], dimension="time", margin=0.0, count=8),
                y=axis(_("Joint angle"), "deg", [places.joint_angle / deg], dimension="angle", count=4),
            ),
        ),
        height=1.0,
    )


def _multiple(found: RoadTorsion, sign: float) -> Rule:
    text = _("{multiple} × mean")
    value = sign * MULTIPLE * found.nominal
    return Rule(value=value, text=say(text, multiple=Quantity(MULTIPLE, trim=True)))


def _grows(found: RoadTorsion) -> Iterator[Band]:
    """Yield the stretches in which vibration grows by itself."""
    times, growth = found.standing.times, found.standing.growth
    if times is None or growth is None:
        return
    edges = np.diff(np.concatenate(([0], (growth > 0.0).astype(int), [0])))
    ends = zip(np.flatnonzero(edges == 1).tolist(), np.flatnonzero(edges == -1).tolist(), strict=True)
    for n, (first, last) in enumerate(ends):
        text: Text = "" if n else _("unstable")
        yield Band(low=float(times[first]), high=float(times[last - 1]), upright=True, role="failed", text=text)


def _risk(found: RoadTorsion) -> Panel:
    """Return how often the torque of the worst elements rises through a level, per hour."""
    risk, shown = found.chance, _shown(found)
    assert risk is not None
    count = len(found.train.elements)
    series, drawn = [], []
    for e, role, dash in looks(found.train, shown):
        low, high = _level_ends(found, e)
        levels = np.linspace(low, high, LEVELS)
        rate = np.maximum(3600.0 * risk.rate(count + e, levels), 1e-300)
        series.append(Curve(x=levels, y=np.log10(rate), role=role, dash=dash, label=found.train.elements[e]))
        drawn.append(levels)
    return Panel(
        series=tuple(series),
        x=axis(_("Highest torque of a turn"), "Nm", drawn, dimension="torque", count=6),
        y=Axis(
            label=_("Rises through it per hour"),
            low=-2.0,
            high=5.0,
            ticks=tuple(float(k) for k in range(-2, 6)),
            texts=tuple(f"{10.0**k:g}" for k in range(-2, 6)),
        ),
    )


def _level_ends(found: RoadTorsion, e: int) -> tuple[float, float]:
    values: Array = found.standing.high[found.standing.found][:, e]
    return float(np.min(values)), max(float(found.peak[0]), float(np.average(values)))


def _spectrum(found: RoadTorsion) -> Panel:
    """Return the envelope of the orders of the element with the largest torque."""
    e = found.peak[1]
    envelope = found.envelope[e]
    kept = [k for k in range(len(found.order)) if envelope[k] > 1e-4 * np.max(envelope)] or [0]
    return order_bars(_("Largest amplitude"), found.train.elements[e], found.order, envelope, kept)


FIGURES = {RoadTorsion: road_figures}
"""Result -> what makes its figures."""
