"""Where torsional vibration is unstable: multipliers at a point, growth over one quantity, a map over two."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Band, Curve, Figure, Note, Panel, Row, Rule, Series, Shape
from cardan.maths.arrays import Array
from cardan.questions.torsion.steady.figure import runs, unstable_bands
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.texts import _
from cardan.units import DIMENSIONS

from .torsion_stability import JOINT_ANGLE, Stability

# The axes of a map of stability: what runs along them, in which unit.

SPEED = "duty.speed"
"""Path of the input speed, without unit."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MapAxis:
    """What varies along an axis of a map."""

    key: str  # its path without unit
    label: str
    dimension: str  # dimension, unit: of the values, empty where they have none
    unit: str
    values: Array  # (s,): in that unit
    here: float | None  # value of the drive itself, in that unit

    @property
    def factor(self) -> float:
        """From the unit to SI."""
        return DIMENSIONS[self.dimension][self.unit] if self.dimension else 1.0

    @property
    def si(self) -> Array:
        """The values in SI."""
        return np.asarray(self.values, dtype=float) * self.factor

    def quantity(self, value: float, digits: int = 4, *, trim: bool = True) -> Quantity:
        """Return a value in the unit of the axis as a quantity."""
        return Quantity(float(value) * self.factor, self.dimension, digits, unit=self.unit, trim=trim)


def map_axes(found: Stability) -> tuple[MapAxis, ...]:
    """Return the axes of a map in the order of its paths; none of a single point."""
    here = dict(found.here)
    return tuple(
        _map_axis(path, values, dimension, unit, here.get(path))
        for (path, values), (dimension, unit) in zip(found.over, found.units, strict=True)
    )


def _map_axis(path: str, values: Array, dimension: str, unit: str, here: float | None) -> MapAxis:
    owner, dot, last = path.rpartition(".")
    bare = owner + dot + (last.replace(f"_{unit}", "", 1) if unit else last)
    key = "joint_angle" if path == JOINT_ANGLE else bare
    label = _("largest joint angle") if path == JOINT_ANGLE else _("input speed") if bare == SPEED else bare
    return MapAxis(key=key, label=label, dimension=dimension, unit=unit, values=values, here=here)


TONGUES = 6
"""Zones with their names in a map, the largest."""

LETTER = 0.0095
"""Width of a letter, a share of that of the map, about."""

CELLS = 160
"""Rows of a map at most; finer ones are thinned."""


def stability_figures(found: Stability) -> tuple[Figure, ...]:
    """Return the figure of stability: multipliers at a point, the growth rate over one quantity, a map over two."""
    if not found.over:
        return (multipliers_figure(found),)
    return (growth_figure(found),) if len(found.over) == 1 else (map_figure(found),)


def multipliers_figure(found: Stability) -> Figure:
    """Return the multipliers in the complex plane, with the circle that they are to stay within."""
    turn = np.linspace(0.0, 2.0 * math.pi, 181)
    values = found.multipliers[np.isfinite(found.multipliers)]
    out = np.abs(values) > 1.0
    reach = 1.1 * max(1.0, float(np.max(np.abs(values), initial=0.0)))
    ticks = steps(-reach, reach, 4)
    plane = Axis(label=_("real part"), low=-reach, high=reach, ticks=ticks, texts=written(ticks))
    series = [
        Curve(x=np.cos(turn), y=np.sin(turn), role="ink", width=0.9),
        Curve(x=values[~out].real, y=values[~out].imag, role="good", width=0.0, marker=6.0),
        Curve(x=values[out].real, y=values[out].imag, role="failed", width=0.0, marker=7.0),
    ]
    panel = Panel(
        series=tuple(series),
        x=plane,
        y=Axis(label=_("imaginary part"), low=-reach, high=reach, ticks=ticks, texts=written(ticks)),
        equal=True,
    )
    text = _("Outside the circle a disturbance grows: the largest multiplier has the modulus {radius}.")
    return Figure(
        name="multipliers",
        title=_("Floquet multipliers"),
        sentence=say(text, radius=Quantity(float(found.spectral_radius), decimals=4)),
        source=_("Floquet multipliers of the exact equations"),
        rows=(Row(panels=(panel,), height=3.0),),
        legend=False,
        width=4.2,
    )


def growth_figure(found: Stability) -> Figure:
    """Return the growth rate over one quantity, unstable ranges shaded."""
    (over,) = map_axes(found)
    values = over.values
    rate = np.where(np.isfinite(found.growth_rate), found.growth_rate, np.nan)
    panel = Panel(
        series=(
            *_bands(found, over),
            Rule(value=0.0, role="ink", dash="solid"),
            Curve(x=values, y=rate, role="accent"),
        ),
        x=_axis(over, count=8),
        y=axis(
            _("Growth rate of the least stable disturbance"),
            "per_s",
            [rate],
            dimension="rate",
            include=(0.0,),
            count=5,
        ),
    )
    k = int(np.nanargmax(rate)) if np.any(np.isfinite(rate)) else 0
    text = _("Above 0 vibration grows; it grows fastest, or decays slowest, at {value}.")
    return Figure(
        name="growth",
        title=_("Growth rate of torsional vibration"),
        sentence=say(text, value=over.quantity(float(values[k]), 3)),
        source=_("Floquet multipliers of the exact equations"),
        rows=(Row(panels=(panel,), height=2.0),),
        legend=False,
    )


def _bands(found: Stability, over: MapAxis) -> Iterator[Band]:
    """Yield the unstable ranges: to their edges where these were followed, else as far as the points tell."""
    if found.proof is None or not found.proof.looked_at or np.any(found.together):
        yield from unstable_bands(over.values, found.verdict)
        return
    for low, high in zip(found.proof.lowest, found.proof.highest, strict=True):
        ends = sorted(math.copysign(float(one), over.si[0]) / over.factor for one in (low, high))
        yield Band(low=ends[0], high=ends[1], upright=True, role="failed", opacity=0.18)
    sampled = np.where(found.proof.shown(over.si), Verdict.STABLE, found.verdict)
    yield from unstable_bands(over.values, sampled)


def map_figure(found: Stability) -> Figure:
    """Return the unstable part of a map over two quantities, with where the drive stands."""
    axes = map_axes(found)
    turned = axes[1].key == SPEED
    wide, high = axes[::-1] if turned else axes
    x, y = wide.values, high.values
    verdict = found.verdict.T if not turned else found.verdict
    rows = np.unique(np.linspace(0, len(y) - 1, min(len(y), CELLS)).round().astype(int))
    series: list[Series] = []
    for state, role, opacity, word in (
        (Verdict.UNSTABLE, "failed", 0.55, _("unstable")),
        (Verdict.NEUTRAL, "warning", 0.5, _("neutral")),
        (Verdict.UNKNOWN, "faint", 0.8, _("not known")),
    ):
        series += _cells(x, y[rows], verdict[rows] == state, role, opacity, word)
    here = wide.here, high.here
    series += _tongues(found, x, y, verdict == Verdict.UNSTABLE, here, turned=turned)
    if here[0] is not None and here[1] is not None:
        series.append(
            Curve(
                x=np.asarray([here[0]]),
                y=np.asarray([here[1]]),
                role="ink",
                width=0.0,
                marker=7.0,
                label=_("operating point"),
            )
        )
    for value, upright in ((here[0], True), (here[1], False)):
        if value is not None:
            series.append(Rule(value=value, upright=upright, role="ink"))
    panel = Panel(
        series=tuple(series),
        x=_axis(wide, count=8),
        y=_axis(high, count=6),
    )
    crossed = all(one.here is not None and one.values[0] <= one.here <= one.values[-1] for one in (wide, high))
    source = _("Floquet multipliers of the exact equations at every point")
    return Figure(
        name="stability-map",
        title=_("Stability map of torsional vibration"),
        sentence=_("The lines cross at the operating point.") if crossed else "",
        source=Joined([source, *_cautions(found, wide)], between=""),
        rows=(Row(panels=(panel,), height=3.0),),
    )


def _axis(along: MapAxis, *, count: int) -> Axis:
    return axis(along.label, along.unit, [along.values], dimension=along.dimension, margin=0.0, count=count)


def _cautions(found: Stability, wide: MapAxis) -> Iterator[Text]:
    """Yield what a reader of a map has to know to read it rightly."""
    step = wide.quantity(float(np.max(np.diff(wide.values), initial=0.0)), 2)
    yield say(_("; points {step} apart, narrower zones may be missed"), step=step)
    if np.any(found.verdict == Verdict.UNKNOWN):
        yield _("; not known: no steady motion was found")
    if plays(found) and np.any(found.verdict == Verdict.UNSTABLE):
        yield _(
            "; with backlash, steady running also ends where the torque changes its sign and the backlash opens: red "
            "there is rattling, whatever zone is nearest"
        )


def plays(found: Stability) -> bool:
    """Tell whether anything has backlash that may open."""
    return bool(np.any(found.train.model.backlash > 0.0))


def _tongues(
    found: Stability, x: Array, y: Array, mask: Array, here: tuple[float | None, float | None], *, turned: bool
) -> Iterator[Note]:
    """Yield the names of the zones, each at the largest of its tongue, off the lines where the drive stands."""
    places: dict[str, list[tuple[int, int]]] = {}
    for i, j in np.argwhere(mask).tolist():
        index = (i, j) if turned else (j, i)
        if int(found.zone.modes[index][0]):
            places.setdefault(found.zone.name(index), []).append((i, j))
    largest = sorted(places.items(), key=lambda one: -len(one[1]))[:TONGUES]
    room = float(y[-1] - y[0])
    for n, (name, cells) in enumerate(sorted(largest, key=lambda one: min(one[1], key=lambda cell: cell[1])[1])):
        first, last = min(j for _i, j in cells), max(j for _i, j in cells)
        wide = (LETTER * len(name) + 0.03) * float(x[-1] - x[0])
        behind = min(
            (True, False),
            key=lambda side: _meets(x, float(x[last] if side else x[first]), wide if side else -wide, here[0]),
        )
        place = float(x[last] if behind else x[first])
        height = max(float(y[max(i for i, _j in cells)]) - (0.04 + 0.05 * n) * room, float(y[0]) + 0.03 * room)
        if here[1] is not None and abs(height - here[1]) < 0.03 * room:
            height = here[1] + math.copysign(0.04, height - here[1]) * room
        yield Note(
            text=_("nearest: {zone}").format(zone=name) if plays(found) else name,
            x=place,
            y=height,
            role="failed",
            side="left" if behind else "right",
            shift=(14.0 if behind else -14.0, 0.0),
        )


def _meets(x: Array, begin: float, width: float, line: float | None) -> int:
    """Return how badly a word from a place on is set: 2 where it leaves the map, 1 where it crosses a line."""
    low, high = sorted((begin, begin + width))
    return 2 * int(low < x[0] or high > x[-1]) + int(line is not None and low < line < high)


def _cells(x: Array, y: Array, mask: Array, role: str, opacity: float, word: str) -> list[Series]:
    """Return the cells of a map in which something holds, those of a row side by side as one."""
    if not np.any(mask):
        return []
    edge_x, edge_y = _edges(x), _edges(y)
    found: list[Series] = []
    for i, row in enumerate(mask):
        for one, two in runs(row):
            left, right, low, high = edge_x[one], edge_x[two + 1], edge_y[i], edge_y[i + 1]
            corners = np.asarray([left, right, right, left]), np.asarray([low, low, high, high])
            found.append(Shape(x=corners[0], y=corners[1], role=role, opacity=opacity, label=word))
    return found


def _edges(values: Array) -> Array:
    middle = 0.5 * (values[1:] + values[:-1])
    return np.concatenate([values[:1], middle, values[-1:]])


FIGURES = {Stability: stability_figures}
"""Result -> what makes its figures."""
