"""How exactly the output follows: what errors do to it, what tolerances leave open, and which of them matter."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule, Series, Shape
from cardan.figures.palette import shaft
from cardan.figures.turning import across
from cardan.figures.wording import percent, significant
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import arcmin, deg, mm

from .accuracy import TransmissionError
from .sampling import MonteCarlo
from .tolerance import Band, Contribution, ToleranceBand, WorstCase

MICRON = 1e-3 * mm

SHOWN = 10
"""Tolerances with a bar of their own."""

GREEK = {"alpha1": "α₁", "alpha2": "α₂", "alpha3": "α₃", "alpha4": "α₄"}
LATIN = {"s1": "s₁", "a1": "a₁", "a2": "a₂", "a3": "a₃", "a4": "a₄"}


def tolerance_figures(found: ToleranceBand) -> tuple[Figure, ...]:
    """Return the figures of what tolerances leave open."""
    return (band_figure(found), pareto_figure(found))


def tolerance_name(field: str) -> tuple[str, int, bool]:
    """Return what a tolerance is called, the number of its joint, and whether it is one of length.

    Parameters
    ----------
    field : str
        Its path in the drive.

    Examples
    --------
    >>> tolerance_name("joints[0].tolerance.alpha2")
    ('α₂ of joint 1', 1, False)
    """
    match = re.fullmatch(r"joints\[(\d+)\]\.tolerance\.(\w+)", field)
    assert match is not None, field
    number, key = int(match[1]) + 1, match[2]
    name = GREEK.get(key) or LATIN.get(key) or _("yoke phase")
    return _("{name} of joint {number}").format(number=number, name=name), number, key in LATIN


def band_figure(found: ToleranceBand, *, shifts: bool = True) -> Figure:
    """Return the bounds of the output's angle over a turn, and of its shift where it shifts.

    Parameters
    ----------
    found : ToleranceBand
        Of one drive.
    shifts : bool
        Show the shift of the output too; leave it out where a bearing holds it.
    """
    angle = _round(np.asarray(found.angle), 2.0 * np.pi) / deg
    both = [(_("Error of the output angle"), "′", found.output, arcmin)]
    if shifts and found.shift.largest > 0.0:
        both.append((_("Shift of the output shaft"), "µm", found.shift, MICRON))
    rows = [
        Row(
            panels=(_band(angle, label, unit, one, size, found, named=k + 1 == len(both), first=k == 0),),
            height=1.6 if k == 0 else 1.3,
        )
        for k, (label, unit, one, size) in enumerate(both)
    ]
    return Figure(
        name="band",
        title=_("What the tolerances leave open at the output"),
        sentence=_(
            "At the same input angle the output errs by up to {most}′, and by up to {swing}′ over a turn."
        ).format(
            most=significant(found.output.largest / arcmin, 3),
            swing=significant(found.output.peak_to_peak / arcmin, 3),
        ),
        source=_(
            "Loops of four axes chained, Book (171), (180); influence of every error exactly about the ideal joint"
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


def _band(
    angle: Array, label: str, unit: str, one: Band, size: float, found: ToleranceBand, *, named: bool, first: bool
) -> Panel:
    count = len(found.angle)

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
        y=axis(label, unit, ends, include=(0.0,), least=1e-6, count=4),
    )


def pareto_figure(found: ToleranceBand, *, shifts: bool = True) -> Figure:
    """Return the share of every tolerance, the largest first.

    Parameters
    ----------
    found : ToleranceBand
        Of one drive.
    shifts : bool
        Show the shift of the output too; leave it out where a bearing holds it.
    """
    both = [(_("Share of the variance of the output angle [%]"), found.output.contributions, arcmin, "′")]
    if shifts and found.shift.contributions:
        both.append((_("Share of the variance of the output shift [%]"), found.shift.contributions, MICRON, " µm"))
    both = [one for one in both if one[1]]
    rows = tuple(
        Row(panels=(_pareto(title, rows, size, unit),), height=0.24 * min(len(rows), SHOWN) + 0.2)
        for title, rows, size, unit in both
    )
    top = found.output.contributions or found.shift.contributions
    return Figure(
        name="pareto",
        title=_("Which tolerances matter"),
        sentence=_("{share} of the variance is due to {name}.").format(
            name=tolerance_name(top[0].field)[0], share=percent(top[0].share)
        ),
        source=_(
            "Mean square of the influence times the standard deviation over the turn; ± the largest error by itself"
        ),
        rows=rows,
        legend=False,
    )


def _pareto(title: str, given: Sequence[Contribution], size: float, unit: str) -> Panel:
    rows = given[:SHOWN]
    share = np.asarray([100.0 * row.share for row in rows])
    at = np.arange(len(rows), 0, -1, dtype=float)
    names = [tolerance_name(row.field) for row in rows]
    top = float(np.max(share))
    ticks = steps(0.0, top, 5)
    bars = Bars(
        at=at,
        size=share,
        texts=tuple(f"{percent(row.share)}, ±{significant(row.largest / size, 3)}{unit}" for row in rows),
        roles=tuple(shaft(number + 1) for _name, number, _long in names),
        thick=0.62,
        lying=True,
    )
    upright = Axis(
        low=0.4, high=len(rows) + 0.6, ticks=tuple(at), texts=tuple(name for name, _number, _long in names), grid=False
    )
    along = Axis(low=0.0, high=1.28 * top, ticks=ticks, texts=written(ticks))
    return Panel(series=(bars,), x=along, y=upright, title=title)


def error_figures(found: TransmissionError) -> tuple[Figure, ...]:
    """Return the figures of what known errors do."""
    return (error_figure(found),)


def error_figure(found: TransmissionError, *, shifts: bool = True) -> Figure:
    """Return the error of the output over a turn, exact and to first order, and its shift where it shifts.

    Parameters
    ----------
    found : TransmissionError
        Of one drive.
    shifts : bool
        Show the shift of the output too; leave it out where a bearing holds it.
    """
    angle = _round(np.asarray(found.angle), 2.0 * np.pi) / deg
    both = [(_("Error of the output angle"), "′", np.asarray(found.error), np.asarray(found.error_linear), arcmin)]
    shift, linear = np.asarray(found.output_shift), np.asarray(found.shift_linear)[..., -1, :]
    if shifts and float(np.max(np.abs(linear))) > 0.0:
        both.append((_("Shift of the output shaft"), "µm", shift, linear, MICRON))
    rows = []
    for k, (label, unit, given, tangent, size) in enumerate(both):
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
        upright = axis(label, unit, [exact / size, first / size], include=(0.0,), least=1e-6, count=4)
        named = k + 1 == len(both)
        rule = Rule(value=0.0, dash="solid", role="faint")
        rows.append(Row(panels=(Panel(series=(rule, *curves), x=across(angle, named=named), y=upright),), height=1.5))
    error = np.asarray(found.error)
    if not bool(np.all(found.closes)):
        sentence = _("With these errors a joint cannot be assembled at every position.")
    else:
        sentence = _("The known errors put the output up to {most}′ off, and change by {swing}′ over a turn.").format(
            most=significant(float(np.max(np.abs(error))) / arcmin, 3),
            swing=significant(float(np.ptp(error)) / arcmin, 3),
        )
    return Figure(
        name="errors",
        title=_("What the known errors do to the output"),
        sentence=sentence,
        source=_("Every joint a closed loop of four axes, exactly; first order Book (171), (180), chained"),
        rows=tuple(rows),
    )
