"""Before and after over a band of speeds: what an absorber does, and what a design for calm running does and why."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Rule, Series
from cardan.figures.palette import shaft
from cardan.figures.wording import percent, significant
from cardan.maths.arrays import Array
from cardan.questions.torsion.absorber.absorber import Absorber
from cardan.texts import _
from cardan.units import deg, rpm, thousands

from .calm import Calm
from .node_rule import NodeRule

DECADES = 3.0
"""Most decades of a logarithmic axis; what is smaller is cut off."""

LEAST = 1e-12
"""Torques below this share of the largest are nought."""


def absorber_figures(found: Absorber) -> tuple[Figure, ...]:
    """Return the figures of an absorber on a drive."""
    return (absorber_figure(found),)


def calm_figures(found: Calm) -> tuple[Figure, ...]:
    """Return the figures of a design for calm running."""
    return (calm_figure(found),)


def absorber_figure(found: Absorber) -> Figure:
    """Return the largest swing of a torque over the speed without an absorber, by its closed form and at its best.

    Parameters
    ----------
    found : Absorber
        Of one drive.
    """
    speed = found.speed / rpm
    judged = list(found.judged)
    curves = [np.max(one[:, judged], axis=-1) for one in (found.before, found.closed, found.after)]
    marks: list[Series] = []
    if found.tuned_speed is not None:
        marks.append(Rule(value=found.tuned_speed / rpm, upright=True, text=_("tuned to this speed"), role="accent"))
    meeting = found.omega / found.order / rpm
    if speed[0] < meeting < speed[-1] and found.tuned_speed is None:
        text = _("order {order:g} meets mode {mode}").format(order=found.order, mode=found.mode)
        marks.append(Rule(value=meeting, upright=True, text=text))
    upper = Panel(
        series=(
            *marks,
            Curve(x=speed, y=curves[0], label=_("without"), role="muted", dash="dashed", width=1.4),
            Curve(
                x=speed, y=curves[1], label=_("closed form of one mode"), role="second order", dash="dashdot", width=1.2
            ),
            Curve(x=speed, y=curves[2], label=_("best setting"), role="accent", width=2.2),
            *_unstable(speed, curves[2], found.unstable_after / rpm),
        ),
        x=axis("", "", [speed], margin=0.0, count=8),
        y=logarithmic(_("Largest swing of a torque"), "N·m", curves),
    )
    twist = found.twist / deg
    name = _("Swing of the pendulums") if found.kind == "pendulum" else _("Twist of the absorber against its station")
    lower = Panel(
        series=(Curve(x=speed, y=twist, role="accent", width=1.4),),
        x=axis(_("input speed"), "rpm", [speed], margin=0.0, count=8),
        y=axis(name, "°", [twist[np.isfinite(twist)]], include=(0.0,), count=4),
    )
    return Figure(
        name="absorber-on-drive",
        title=_("Before and after: {what} on {station}").format(what=_kinds()[found.kind], station=found.host.name),
        sentence=_absorber_sentence(found),
        source=_("periodic solution of the exact equations of motion with the absorber as a station"),
        rows=(Row(panels=(upper,), height=2.4), Row(panels=(lower,), height=1.2)),
    )


def _kinds() -> dict[str, str]:
    return {
        "h_infinity": _("an absorber"),
        "den_hartog": _("an absorber"),
        "viscous": _("a viscous damper"),
        "tuned": _("an absorber without damping"),
        "pendulum": _("pendulums"),
    }


def _absorber_sentence(found: Absorber) -> str:
    text = _(
        "The largest swing falls from {before} N·m to {after} N·m; the closed form of one mode leaves {closed} N·m."
    )
    if found.tuned_speed is not None:
        text = _("At {speed} rpm the swing falls from {before} N·m to {after} N·m; beside it the absorber resonates.")
    return text.format(
        before=significant(found.bare.peak, 3),
        after=significant(found.best.peak, 3),
        closed=significant(found.closed_form.peak, 3),
        speed=significant((found.tuned_speed or 0.0) / rpm),
    )


def calm_figure(found: Calm) -> Figure:
    """Return the largest swing over the speed as built and with the best values, and the pushes of the joints.

    Parameters
    ----------
    found : Calm
        Of one drive.
    """
    speed, judged = found.speed / rpm, list(found.judged)
    curves = [np.max(one[:, judged], axis=-1) for one in (found.before, found.after)]
    dot = 5.0 if len(speed) == 1 else 0.0
    upper = Panel(
        series=(
            Curve(x=speed, y=curves[0], label=_("as built"), role="muted", dash="dashed", width=1.4, marker=dot),
            Curve(x=speed, y=curves[1], label=_("best values"), role="accent", width=2.2, marker=dot),
            *_unstable(speed, curves[0], found.unstable_before / rpm),
            *_unstable(speed, curves[1], found.unstable_after / rpm),
        ),
        x=axis(_("input speed"), "rpm", [speed], margin=0.0 if len(speed) > 1 else 0.06, count=8),
        y=logarithmic(_("Largest swing of a torque"), "N·m", curves),
    )
    below = [_search(found)] if max(len(one) for one in found.history) > 2 else []
    if found.rules_after and found.rules_before:
        new = found.rules_after[0]
        old = next((one for one in found.rules_before if one.mode == new.mode), found.rules_before[0])
        reach = max(0.5 * max(np.ptp(one.real), np.ptp(one.imag)) for one in (_chain(old), _chain(new)))
        if reach > 0.0:
            titles = (_("Pushes on mode {mode} as built"), _("Pushes on mode {mode}, best values"))
            below = [
                *(
                    _pushes(one, reach, text.format(mode=one.mode))
                    for one, text in zip((old, new), titles, strict=True)
                ),
                *below,
            ]
    return Figure(
        name="calm-running",
        title=_("Design for calm running"),
        sentence=_(
            "The largest swing falls from {before} N·m at {at} rpm to {after} N·m, {share} of it. Below: how each "
            "joint pushes the mode twice a turn, head to tail; dashed is what their phases leave."
        ).format(
            before=significant(found.peak_before.torque, 3),
            at=significant(found.peak_before.speed / rpm, 3),
            after=significant(found.peak_after.torque, 3),
            share=percent(found.reduction, 2),
        ),
        source=_("periodic solution of the exact equations of motion; pushes of order 2 on the straight line's mode"),
        rows=(Row(panels=(upper,), height=2.4), *([Row(panels=tuple(below), height=1.9)] if below else [])),
    )


def _chain(rule: NodeRule) -> Array:
    """Return the ends of the pushes of the joints, head to tail, as complex numbers."""
    return np.concatenate([[0.0], np.cumsum(rule.forced)])


def _pushes(rule: NodeRule, reach: float, title: str) -> Panel:
    """Return the pushes of the joints head to tail, and their sum."""
    ends = _chain(rule)
    middle = 0.5 * (np.min(ends.real) + np.max(ends.real) + 1j * (np.min(ends.imag) + np.max(ends.imag)))
    ends = (ends - middle) / reach
    arrows: list[Series] = []
    words: list[Series] = []
    for k, (one, two) in enumerate(pairwise(ends)):
        if abs(two - one) < 0.01:
            continue
        name, at = _("joint {number}").format(number=k + 1), 0.5 * (one + two)
        arrows.append(_line(one, two, role=shaft(k + 2), width=1.8, arrow=True, text=name))
        aside = 6.0 if k % 2 else -6.0
        words.append(
            Note(text=str(k + 1), x=float(at.real), y=float(at.imag), role=shaft(k + 2), shift=(0.0, aside), bold=True)
        )
    arrows.append(_line(ends[0], ends[-1], role="ink", dash="dashed", width=1.4, text=_("sum")))
    wide = Axis(low=-1.25, high=1.25, grid=False)
    return Panel(series=(*arrows, *words), x=wide, y=wide, title=title, equal=True, bare=True)


def _line(one: complex, two: complex, **looks: Any) -> Curve:
    return Curve(x=np.asarray([one.real, two.real]), y=np.asarray([one.imag, two.imag]), **looks)


def _search(found: Calm) -> Panel:
    """Return the smallest peak after every generation of the search."""
    runs = [np.where(np.isfinite(one), one, np.nan) for one in found.history]
    longest = max(len(one) for one in runs)
    series = tuple(
        Curve(
            x=np.arange(len(one), dtype=float),
            y=one,
            role="accent" if k == 0 else "second order",
            width=1.2,
            dash="solid" if k == 0 else "dashed",
        )
        for k, one in enumerate(runs)
    )
    return Panel(
        series=series,
        x=axis(_("round of the search"), "", [np.asarray([0.0, max(longest - 1.0, 1.0)])], margin=0.0, count=4),
        y=logarithmic(_("Smallest peak so far"), "N·m", runs),
    )


def _unstable(speed: Array, curve: Array, at: Array) -> Iterator[Curve]:
    """Yield marks where the motion of a curve is unstable."""
    if len(at):
        rows = [int(np.argmin(np.abs(speed - one))) for one in at]
        yield Curve(x=speed[rows], y=curve[rows], label=_("unstable"), role="failed", width=0.0, marker=4.0)


def logarithmic(label: str, unit: str, curves: Sequence[Array]) -> Axis:
    """Return the logarithmic axis of torques.

    Parameters
    ----------
    label, unit : str
    curves : sequence of arrays
        What it is to hold; what is more than three decades below the largest is cut off.

    Examples
    --------
    >>> found = logarithmic("torque", "N·m", [np.asarray([3.0, 400.0])])
    >>> found.ticks
    (5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)
    """
    every = np.concatenate([np.asarray(one, dtype=float).ravel() for one in curves])
    every = every[np.isfinite(every)]
    high = float(np.max(every, initial=0.0)) or 1.0
    every = every[every > LEAST * high]
    low = max(float(np.min(every, initial=high)), high * 10.0**-DECADES)
    low, high = low / 1.25, high * 1.35
    ticks = [
        m * 10.0**power
        for power in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        for m in (1.0, 2.0, 5.0)
    ]
    kept = tuple(one for one in ticks if low <= one <= high)
    return Axis(
        label=label,
        unit=unit,
        low=low,
        high=high,
        ticks=kept,
        texts=tuple(significant_tick(one) for one in kept),
        log=True,
    )


def significant_tick(value: float) -> str:
    """Return a tick as short as it can be.

    Examples
    --------
    >>> significant_tick(0.05), significant_tick(2000.0)
    ('0.05', '2\u202f000')
    """
    return f"{value:g}" if value < 1000.0 else thousands(value)
