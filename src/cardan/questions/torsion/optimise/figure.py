"""Before and after over a band of speeds: what the best values of a drive do to its alternating torque, and why."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from cardan.answers.palette import shaft
from cardan.figures.axes import axis
from cardan.figures.figure import Axis, Curve, Figure, Note, Panel, Row, Series
from cardan.maths.arrays import Array
from cardan.questions.torsion.absorber.figure import logarithmic, unstable
from cardan.texts import _
from cardan.units import rpm

from .modal_excitation import NodeRule
from .optimise import OptimisedTorsion


def torsion_design_figures(found: OptimisedTorsion) -> tuple[Figure, ...]:
    """Return the figures of a design for least torsional vibration."""
    return (calm_figure(found),)


def calm_figure(found: OptimisedTorsion) -> Figure:
    """Return the largest alternating torque over the speed as built and at best, and how the joints excite the mode."""
    speed, judged = found.speed / rpm, list(found.judged)
    curves = [np.max(one[:, judged], axis=-1) for one in (found.before, found.after)]
    dot = 5.0 if len(speed) == 1 else 0.0
    upper = Panel(
        series=(
            Curve(x=speed, y=curves[0], label=_("as built"), role="muted", dash="dashed", width=1.4, marker=dot),
            Curve(x=speed, y=curves[1], label=_("best values"), role="accent", width=2.2, marker=dot),
            *unstable(speed, curves[0], found.unstable_before / rpm),
            *unstable(speed, curves[1], found.unstable_after / rpm),
        ),
        x=axis(
            _("input speed"), "rpm", [speed], dimension="angular_speed", margin=0.0 if len(speed) > 1 else 0.06, count=8
        ),
        y=logarithmic(_("Largest alternating torque ±"), curves),
    )
    arrows = False
    below = [_search(found)] if max(len(one) for one in found.history) > 2 else []
    if found.rules_after and found.rules_before:
        new = found.rules_after[0]
        old = next((one for one in found.rules_before if one.mode == new.mode), found.rules_before[0])
        reach = max(0.5 * max(np.ptp(one.real), np.ptp(one.imag)) for one in (_chain(old), _chain(new)))
        arrows = reach > 0.0 and old.order == new.order
        if arrows:
            titles = (
                _("Excitation of order {order}, mode {mode}, as built"),
                _("Excitation of order {order}, mode {mode}, best values"),
            )
            below = [
                *(
                    _excitations(one, reach, text.format(mode=one.mode, order=f"{one.order:g}"))
                    for one, text in zip((old, new), titles, strict=True)
                ),
                *below,
            ]
    return Figure(
        name="calm-running",
        title=_("Least torsional vibration: before and after"),
        sentence=_("Arrows: how each joint excites the mode at that order, head to tail; dashed: their sum.")
        if arrows
        else "",
        source=_(
            "periodic solution of the exact equations of motion; excitation of one order of the straight line's mode"
        ),
        rows=(Row(panels=(upper,), height=2.4), *([Row(panels=tuple(below), height=1.9)] if below else [])),
    )


def _chain(rule: NodeRule) -> Array:
    """Return the ends of the excitations of the joints, head to tail, as complex numbers."""
    return np.concatenate([[0.0], np.cumsum(rule.forced)])


def _excitations(rule: NodeRule, reach: float, title: str) -> Panel:
    """Return the excitations of the joints head to tail, and their sum."""
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


def _search(found: OptimisedTorsion) -> Panel:
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
        y=logarithmic(_("Smallest peak so far ±"), runs),
    )


FIGURES = {OptimisedTorsion: torsion_design_figures}
"""Result -> what makes its figures."""
