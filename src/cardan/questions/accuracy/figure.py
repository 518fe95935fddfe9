"""How exactly the output follows: what errors do to it, what tolerances leave open, and which of them matter."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.answers.palette import shaft
from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import across, axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule, Series, Shape
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import arcmin, deg, mm

from .accuracy import TransmissionError
from .cross_play import CrossPlay
from .sampling import MonteCarlo
from .tolerance import Band, Contribution, ToleranceBand, WorstCase

MICRON = 1e-3 * mm

SHOWN = 10
"""Tolerances with a bar of their own."""

SIGNS = {"alpha1": "α₁", "alpha2": "α₂", "alpha3": "α₃", "alpha4": "α₄"} | {
    "s1": "s₁",
    "a1": "a₁",
    "a2": "a₂",
    "a3": "a₃",
    "a4": "a₄",
}
"""Key of a tolerance -> its sign."""


@dataclass(frozen=True, kw_only=True)
class Side:
    """What errors do to the output: its angle, or its place along its axis."""

    key: str  # ``"angle"`` or ``"shift"``, for programs
    dimension: str  # dimension, unit: in which it is told, see `Quantity`
    unit: str
    size: float  # that unit in SI

    @property
    def title(self) -> str:
        """What it is, in the language spoken."""
        return _("Shift of the output shaft") if self.key == "shift" else _("Angle error of the output")

    def quantity(self, value: float, digits: int = 3) -> Quantity:
        """Return an error of this side as a quantity."""
        return Quantity(value, self.dimension, digits, unit=self.unit)


ANGLE = Side(key="angle", dimension="angle", unit="arcmin", size=arcmin)
SHIFT = Side(key="shift", dimension="displacement", unit="um", size=MICRON)


RATIO = Side(key="ratio", dimension="", unit="", size=1.0)


def measure(dimension: str) -> Side:
    """Return in what an error of a dimension is told: angles, lengths, and ratios of sizes inside a joint."""
    return {"angle": ANGLE, "length": SHIFT}.get(dimension, RATIO)


def sides(found: ToleranceBand, *, shifts: bool = True) -> list[tuple[Side, Band]]:
    """Return the sides of the output that tolerances leave open; its shift only where nothing holds it.

    found: of one drive.
    shifts: whether the output shaft may shift; where it may not, its shift still stands in for an angle without
    tolerances.
    """
    turned = [(ANGLE, found.output)] if found.output.contributions else []
    shifted = [(SHIFT, found.shift)] if found.shift.contributions and (shifts or not turned) else []
    return turned + shifted


def tolerance_figures(found: ToleranceBand) -> tuple[Figure, ...]:
    """Return the figures of what tolerances leave open."""
    return (band_figure(found), pareto_figure(found))


def tolerance_name(joint: int, key: str, pair: str = "", dimension: str = "") -> str:
    """Return what a tolerance is called.

    joint: number of its joint, from 1; key: its key in the file; pair: name of a pair inside, off by a vector of a
    dimension.

    >>> tolerance_name(1, "alpha2")
    'α₂ of joint 1'
    >>> tolerance_name(2, "driving_distance")
    'driving_distance of joint 2'
    >>> tolerance_name(1, "drawing.joints[3].tolerance", "driven pin", "length")
    'shift of “driven pin” in joint 1'
    """
    if pair:
        text = (
            _("turn of “{pair}” in joint {number}")
            if dimension == "angle"
            else _("shift of “{pair}” in joint {number}")
        )
        return text.format(pair=pair, number=joint)
    return _("{name} of joint {number}").format(
        number=joint, name=_("yoke phase") if key == "phase" else SIGNS.get(key, key)
    )


def band_figure(found: ToleranceBand, *, shifts: bool = True) -> Figure:
    """Return the bounds of the output's angle over a turn, and of its shift where it shifts.

    found: of one drive.
    shifts: show the shift of the output too; leave it out where a bearing holds it.
    """
    angle = _round(np.asarray(found.angle), 2.0 * np.pi) / deg
    both = sides(found, shifts=shifts)
    rows = [
        Row(
            panels=(_band(angle, side, one, found, named=k + 1 == len(both), first=k == 0),),
            height=1.6 if k == 0 else 1.3,
        )
        for k, (side, one) in enumerate(both)
    ]
    return Figure(
        name="band",
        title=_("What the tolerances leave open at the output"),
        sentence="",
        source=_(
            "Loops of four axes chained, Kozhevnikov & Perfil'ev (1978), eq. 171, 180; influence of every "
            "error exactly about the ideal joint"
        ),
        rows=tuple(rows),
    )


def _round(values: Array, last: float) -> Array:
    """Return values of a turn with its end, which repeats the beginning."""
    return np.append(values, last) if len(values) > 2 else values


def _bounds(found: ToleranceBand) -> str:
    if isinstance(found.method, WorstCase):
        return _("worst case")
    if isinstance(found.method, MonteCarlo):
        return _("99.7 % of the drives, sampled")
    return _("root of the sum of squares")


def _band(angle: Array, side: Side, one: Band, found: ToleranceBand, *, named: bool, first: bool) -> Panel:
    count, size = len(found.angle), side.size

    def closed(values: Array) -> Array:
        return _round(values, float(values[0])) if len(angle) > count else values

    centre = closed(np.asarray(one.centre)) / size

    def area(low: Array, high: Array, opacity: float, name: str) -> Shape:
        return Shape(
            x=np.concatenate((angle, angle[::-1])),
            y=np.concatenate((closed(np.asarray(low)), closed(np.asarray(high))[::-1])) / size,
            opacity=opacity,
            label=name if first else "",
        )

    inner = np.asarray(one.upper_95 - one.lower_95) < np.asarray(one.upper - one.lower) * (1.0 - 1e-9)
    series: list[Series] = [area(one.lower, one.upper, 0.18, _bounds(found))]
    if bool(np.any(inner)):
        series.append(area(one.lower_95, one.upper_95, 0.3, _("95 % of the drives")))
    series.append(Rule(value=0.0, dash="solid", role="faint"))
    if float(np.max(np.abs(centre))) > 0.0:
        series.append(Curve(x=angle, y=centre, role="ink", width=1.2, label=_("known errors alone") if first else ""))
    ends = [np.asarray(one.lower) / size, np.asarray(one.upper) / size]
    return Panel(
        series=tuple(series),
        x=across(angle, named=named),
        y=axis(side.title, side.unit, ends, dimension=side.dimension, include=(0.0,), least=1e-6, count=4),
    )


def pareto_figure(found: ToleranceBand, *, shifts: bool = True) -> Figure:
    """Return the share of every tolerance, the largest first.

    found: of one drive.
    shifts: show the shift of the output too; leave it out where a bearing holds it.
    """
    return Figure(
        name="pareto",
        title=_("Which tolerances matter"),
        sentence="",
        source=_(
            "Mean square of the influence times the standard deviation over the turn; ± the largest error by itself"
        ),
        rows=tuple(
            Row(panels=(_pareto(side, one.contributions),), height=0.24 * min(len(one.contributions), SHOWN) + 0.2)
            for side, one in sides(found, shifts=shifts)
        ),
        legend=False,
    )


def _pareto(side: Side, given: Sequence[Contribution]) -> Panel:
    turned, shifted = _("Share of the variance of the angle error"), _("Share of the variance of the shift")
    rows = given[:SHOWN]
    share = np.asarray([100.0 * row.share for row in rows])
    at = np.arange(len(rows), 0, -1, dtype=float)
    top = float(np.max(share))
    ticks = steps(0.0, top, 5)
    bars = Bars(
        at=at,
        size=share,
        texts=tuple(
            say("{share}, ±{size}", share=Quantity(row.share, "share", 3), size=side.quantity(row.largest))
            for row in rows
        ),
        roles=tuple(shaft(row.joint + 1) for row in rows),
        thick=0.62,
        lying=True,
    )
    names = tuple(tolerance_name(row.joint, row.key, row.pair, row.dimension) for row in rows)
    return Panel(
        series=(bars,),
        x=Axis(low=0.0, high=1.28 * top, ticks=ticks, texts=written(ticks)),
        y=Axis(low=0.4, high=len(rows) + 0.6, ticks=tuple(at), texts=names, grid=False),
        title=shifted if side is SHIFT else turned,
        dimension="share",
        unit="percent",
    )


def error_figures(found: TransmissionError) -> tuple[Figure, ...]:
    """Return the figures of what known errors do."""
    return (error_figure(found),)


def error_figure(found: TransmissionError, *, shifts: bool = True) -> Figure:
    """Return the error of the output over a turn, exact and to first order, and its shift where it shifts.

    found: of one drive.
    shifts: show the shift of the output too; leave it out where a bearing holds it.
    """
    angle = _round(np.asarray(found.angle), 2.0 * np.pi) / deg
    both = [(ANGLE, np.asarray(found.error), np.asarray(found.error_linear))]
    shift, linear = np.asarray(found.output_shift), np.asarray(found.shift_linear)[..., -1, :]
    if shifts and float(np.max(np.abs(linear))) > 0.0:
        both.append((SHIFT, shift, linear))
    rows = []
    for k, (side, given, tangent) in enumerate(both):
        size = side.size
        exact, first = (_round(one, float(one[0])) if len(angle) > len(one) else one for one in (given, tangent))
        curves = (
            Curve(x=angle, y=exact / size, role="exact", width=2.0, label=_("exact") if not k else ""),
            Curve(
                x=angle,
                y=first / size,
                role="first order",
                dash="dashed",
                width=1.2,
                label=_("first order") if not k else "",
            ),
        )
        both_curves = [exact / size, first / size]
        upright = axis(
            side.title, side.unit, both_curves, dimension=side.dimension, include=(0.0,), least=1e-6, count=4
        )
        named = k + 1 == len(both)
        rule = Rule(value=0.0, dash="solid", role="faint")
        rows.append(Row(panels=(Panel(series=(rule, *curves), x=across(angle, named=named), y=upright),), height=1.5))
    return Figure(
        name="errors",
        title=_("What the known errors do to the output"),
        sentence="",
        source=_(
            "Every joint a closed loop of four axes, exactly; first order Kozhevnikov & Perfil'ev (1978), "
            "eq. 171, 180, chained"
        ),
        rows=tuple(rows),
    )


def cross_figure(angle: Array, found: Sequence[CrossPlay]) -> Figure:
    """Return how the crosses move along their journals over a turn, in each yoke.

    angle (p,) [rad]: input angles; found: the crosses in both their yokes.
    """
    turn = _round(angle, 2.0 * np.pi) / deg
    titles = {"driving": _("Cross along its driving journals"), "driven": _("Cross along its driven journals")}

    def closed(values: Array) -> Array:
        return np.append(values, values[0]) / SHIFT.size

    rows: list[Row] = []
    for name, title in titles.items():
        some = [one for one in found if one.yoke == name]
        series: list[Series] = [Rule(value=0.0, dash="solid", role="faint")]
        ends: list[Array] = []
        for one in some:
            role, label = shaft(one.joint + 1), _("joint {number}").format(number=one.joint) if not rows else ""
            low, high = closed(one.known - one.reach), closed(one.known + one.reach)
            ends += [low, high]
            if float(np.max(one.reach)) > 0.0:
                x, y = np.concatenate((turn, turn[::-1])), np.concatenate((low, high[::-1]))
                series.append(Shape(x=x, y=y, role=role, opacity=0.2, label=label))
                label = ""
            if float(np.max(np.abs(one.known))) > 0.0:
                series.append(Curve(x=turn, y=closed(one.known), role=role, width=1.6, label=label))
        upright = axis(title, SHIFT.unit, ends, dimension=SHIFT.dimension, include=(0.0,), least=1e-6, count=4)
        panel = Panel(series=tuple(series), x=across(turn, named=len(rows) == 1), y=upright)
        rows.append(Row(panels=(panel,), height=1.4))
    return Figure(
        name="cross",
        title=_("How the crosses move along their journals"),
        sentence="",
        source=_("Slides s₂ and s₃ of the loop of every joint, Kozhevnikov & Perfil'ev (1978), Fig. 74, eq. 171"),
        rows=tuple(rows),
    )


FIGURES: dict[type, Callable[..., tuple[Figure, ...]]] = {
    ToleranceBand: tolerance_figures,
    TransmissionError: error_figures,
}
"""Result -> what makes its figures."""
