"""The classical approximations beside the exact motion, and Mathieu's equation with a drive in it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.answers.palette import shaft
from cardan.answers.quantity import Quantity, say
from cardan.answers.reader import significant
from cardan.figures.axes import across, axis, steps, written
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Rule, Series, Shape
from cardan.maths.arrays import Array
from cardan.maths.periodic.mathieu import LARGEST_Q, boundaries, damped_zone, exponents
from cardan.texts import _
from cardan.units import deg, rpm

from .comparison import BookComparison
from .mathieu_drive import MathieuReduction
from .mathieu_modes import JOINTS, MathieuModes

POINTS = 121
"""Places along q at which boundaries are drawn."""

SEEN = 12
"""Number of the last zone worth a look; the next ones are narrower than anything."""

LEAST_Q = 0.02
"""Smallest height of the panel about a zone."""

WIDE = 0.1
"""A zone of this share of the window has the names of its edges inside."""

NAMED, LOWER = 0.92, 0.7
"""Share of the height of a boundary at which its name stands, and that of a₀, which leaves at the side with b₁."""

ROOM = 1.5
"""How much higher than the point of the drive the panel about its zone is."""


def reduction_figure(found: MathieuReduction) -> Figure:
    """Return the chart of stability about the nearest zone with the drive in it, about the first one far from all."""
    near = max(1, round(math.sqrt(found.a)))
    near = near if near <= SEEN else 1
    centre = float(near * near)
    shown = near * near > 0.25 * found.a
    top = max(LEAST_Q, ROOM * found.q * max(1.0 if shown else 0.0, centre / found.a))
    reach = max(1.2 * abs(found.a - centre) if shown else 0.0, 1.6 * top, 0.05)
    ray, label = np.asarray([0.0, 1e3]), _("the drive at other speeds")
    close = chart_panel(
        (centre - reach, centre + reach),
        top,
        (
            Curve(x=ray * found.a, y=ray * found.q, role="muted", width=1.0, dash="dotted", label=label),
            *(_point(found.a, found.q_book, _("by the book's q, half of it"), "muted") if shown else ()),
            *(_point(found.a, found.q, _("the drive"), "accent") if shown else ()),
        ),
        title=_("Parametric term q, about zone {number}").format(number=near),
        named=True,
    )
    low, high = found.zone_speeds(near)
    stable = bool(exponents(found.a, found.q).stable)
    text = (
        _("Steady running is stable at {speed} rpm; zone {number} lies between {low} and {high} rpm.")
        if stable
        else _("Steady running is unstable at {speed} rpm without damping: zone {number} lies at {low} to {high} rpm.")
    )
    digits = _digits(low, high)
    return Figure(
        name="mathieu",
        title=_("Parametric resonance: where the drive stands"),
        sentence=text.format(
            speed=significant(found.speed / rpm, 4),
            number=near,
            low=significant(low / rpm, digits),
            high=significant(high / rpm, digits),
        ),
        source=_(
            "Kozhevnikov & Perfil'ev (1978), eq. 196 with q put right, Figs. 77, 78; boundaries a_r(q), "
            "b_r(q) exact, without damping"
        ),
        rows=(Row(panels=(close,), height=2.6),),
    )


BROAD = 18.0
"""Largest a of the chart of all modes, as of Fig. 77."""


def modes_chart_figure(found: MathieuModes) -> Figure:
    """Return the chart of stability with the modes of a drive in it, and about the zone that is nearest to one."""
    k = found.nearest
    marks = tuple(
        mark
        for j, number in enumerate(found.number.tolist())
        if found.a[j] <= BROAD
        for mark in _point(
            float(found.a[j]), float(found.q[j]), _("mode {number}").format(number=number), shaft(number)
        )
    )
    label = "a = (ωₑ/ω₁)²" if found.order[k] == JOINTS else "a = (2ωₑ/(νω₁))²"
    top = 1.25 * max([2.0, *(float(q) for a, q in zip(found.a, found.q, strict=True) if a <= BROAD)])
    a, q, zone = float(found.a[k]), float(found.q[k]), found.zone[k][0]
    centre = float(zone * zone)
    high = max(LEAST_Q, ROOM * q * max(1.0, centre / a))
    reach = max(1.2 * abs(a - centre), 1.6 * high, 0.05)
    ray = np.asarray([0.0, 1e3])
    close = chart_panel(
        (centre - reach, centre + reach),
        high,
        (
            Curve(x=ray * a, y=ray * q, role="muted", width=1.0, dash="dotted", label=_("mode at other speeds")),
            *_point(a, 0.5 * q, _("by the book's q, half of it"), "muted"),
            *_point(a, q, _("mode {number}").format(number=int(found.number[k])), shaft(int(found.number[k]))),
        ),
        damping=float(found.damping[k]),
        title=_("Parametric term q, about zone {number}").format(number=zone),
        named=True,
        label=label,
    )
    return Figure(
        name="mathieu-modes",
        title=_("Parametric resonance: where the modes of the drive stand"),
        sentence="",
        source=_(
            "Kozhevnikov & Perfil'ev (1978), eq. 196 with q put right, Figs. 77, 78; boundaries a_r(q), "
            "b_r(q) exact, dashed with damping"
        ),
        rows=(
            Row(panels=(chart_panel((-2.0, BROAD), top, marks, label=label),), height=2.2),
            Row(panels=(close,), height=2.4),
        ),
    )


def chart_panel(
    a: tuple[float, float],
    top: float,
    marks: tuple[Series, ...] = (),
    *,
    damping: float = 0.0,
    title: str = "",
    named: bool = False,
    label: str = "a = (ωₑ/ω₁)²",
) -> Panel:
    """Return the zones of Mathieu's equation in a window, and marks in it.

    a: range of a; top: largest q; marks: drawn over the zones; damping: n; named: list the zones in the legend; label:
    what a is.
    """
    top = min(top, LARGEST_Q)
    low, high = a
    order = 1 + math.ceil(math.sqrt(max(high + 2.0 * top, 1.0)))
    q = top * np.linspace(0.0, 1.0, POINTS) ** 2
    upper, lower = boundaries(q, order)
    zones: list[Series] = []
    lines: list[Series] = []
    edge = np.full(q.shape, low)
    for r in range(order + 1):
        left, right = (np.minimum(edge, upper[:, 0]), upper[:, 0]) if r == 0 else (lower[:, r - 1], upper[:, r])
        if np.min(left) > high or np.max(right) < low:
            continue
        listed = _("unstable") if named and not zones else ""
        x = np.clip(np.concatenate((left, right[::-1])), low, high)
        zones.append(Shape(x=x, y=np.concatenate((q, q[::-1])), role="warning", opacity=0.22, label=listed))
        for side, name in ((left, "b"), (right, "a")) if r else ((right, "a"),):
            inside = np.where((side >= low) & (side <= high), side, np.nan)
            lines.append(Curve(x=inside, y=q, role="ink", width=1.1))
            wide = float(right[-1] - left[-1]) > WIDE * (high - low)
            beside = r > 0 and (name == "b") == wide  # a₀ has its name on its other side, away from that of b₁
            lines += _edge_name(inside, q, name + _low(r), top, to_right=beside, at=NAMED if r else LOWER)
        if damping > 0.0 and r > 0:
            lines += _damped(q, damping, r, low, high, named and r == 1)
    ticks = steps(low, high, 7)
    return Panel(
        series=(*zones, *lines, *(_inside(mark, low, high, top) for mark in marks)),
        x=Axis(label=label, low=low, high=high, ticks=ticks, texts=written(ticks)),
        y=axis(_("Parametric term q"), "", [np.asarray([0.0, top])], margin=0.0, count=5),
        title=title,
    )


def _point(a: float, q: float, label: str, role: str) -> tuple[Series, ...]:
    return (Curve(x=np.asarray([a]), y=np.asarray([q]), role=role, width=0.0, marker=7.0, label=label),)


def _inside(mark: Series, low: float, high: float, top: float) -> Series:
    """Return a ray cut off at the window."""
    if not isinstance(mark, Curve) or len(mark.x) < 2:
        return mark
    (x0, x1), (y0, y1) = (float(v) for v in mark.x), (float(v) for v in mark.y)
    begin = max(0.0, (low - x0) / (x1 - x0))
    ends = [(high - x0) / (x1 - x0), *([(top - y0) / (y1 - y0)] if y1 > y0 else [])]
    share = np.asarray([begin, min(ends)])
    return replace(mark, x=x0 + share * (x1 - x0), y=y0 + share * (y1 - y0))


def _edge_name(x: Array, q: Array, name: str, top: float, *, to_right: bool, at: float) -> list[Series]:
    """Return the name of a boundary beside where it leaves the window, at a share of the height there."""
    seen = np.flatnonzero(np.isfinite(x))
    if not seen.size or q[seen[-1]] < 0.4 * top:
        return []
    last = int(seen[np.searchsorted(q[seen], at * q[seen[-1]])])
    shift = (4.0, 0.0) if to_right else (-4.0, 0.0)
    return [Note(text=name, x=float(x[last]), y=float(q[last]), side="left" if to_right else "right", shift=shift)]


def _damped(q: Array, damping: float, zone: int, low: float, high: float, named: bool) -> list[Series]:
    left, right = damped_zone(q, damping, zone)
    there = np.isfinite(left)
    if not np.any(there):
        return []
    x = np.concatenate((left[there][::-1], right[there]))
    y = np.concatenate((q[there][::-1], q[there]))
    x = np.where((x >= low) & (x <= high), x, np.nan)
    label = _("edges with damping n = {n}").format(n=significant(damping, 2)) if named else ""
    return [Curve(x=x, y=y, role="failed", width=1.1, dash="dashed", label=label)]


def _low(number: int) -> str:
    return str(number).translate(str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"))


def _digits(low: float, high: float) -> int:
    """Return how many digits tell two speeds apart."""
    share = abs(high - low) / max(abs(high), 1e-300)
    return 4 if share <= 0.0 else int(np.clip(2 - math.floor(math.log10(share)), 4, 7))


# Exact motion beside the classical approximations.


def book_figure(found: BookComparison) -> Figure:
    """Return the output's angle error, exact and by the series of first and second order, and what these miss."""
    angle = np.asarray(found.angle) / deg
    exact, first, second = (np.asarray(row) / deg for row in (found.exact, found.first_order, found.second_order))
    upper = Panel(
        series=(
            Rule(value=0.0, dash="solid", role="faint"),
            Curve(x=angle, y=first, role="first order", label=_("first order, c = α²/4"), width=3.0, dash="dashed"),
            Curve(
                x=angle, y=second, role="second order", label=_("second order, c = tan²(α/2)"), width=2.4, dash="dotted"
            ),
            # Thin and on top: mostly all three run in one line, and each is to be seen.
            Curve(x=angle, y=exact, role="exact", label=_("exact"), width=0.9),
        ),
        x=across(angle),
        y=axis(_("Angle error of the output"), "deg", [exact, first, second], dimension="angle", least=0.02),
    )
    off = [first - exact, second - exact]
    lower = Panel(
        series=(
            Rule(value=0.0, dash="solid", role="faint"),
            Curve(x=angle, y=off[0], role="first order", width=1.4, dash="dashed"),
            Curve(x=angle, y=off[1], role="second order", width=1.4, dash="dotted"),
        ),
        x=across(angle, named=True),
        y=axis(_("Error of the approximation"), "deg", off, dimension="angle", mirrored=0.0, least=1e-9, count=4),
    )
    misses = [float(np.max(np.abs(row))) for row in off]
    worst, agree = tuple(Quantity(miss * deg, "angle", 2) for miss in misses), max(misses) < 1e-11
    return Figure(
        name="book",
        title=_("The classical series against the exact motion"),
        sentence=_("Both series agree with the exact motion here.")
        if agree
        else say(
            _("The first order misses the output angle by up to {first}, the second by up to {second}."),
            first=worst[0],
            second=worst[1],
        ),
        source=_(
            "Kozhevnikov & Perfil'ev (1978), eq. 59–62, 69 first order; (63)–(68) second order, restored; "
            "exact: product of Möbius matrices"
        ),
        rows=(Row(panels=(replace(upper, x=lower.x) if agree else upper,), height=1.5),)
        + (() if agree else (Row(panels=(lower,), height=1.1),)),
    )


FIGURES = {BookComparison: book_figure, MathieuReduction: reduction_figure, MathieuModes: modes_chart_figure}
"""Result -> what makes its figure."""
