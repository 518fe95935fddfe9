"""Utilisation of every limit of the parts of a drive, and where its shafts stand under the line of fatigue."""

from __future__ import annotations

import numpy as np

from cardan.answers.palette import shaft
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.checks.verdict import AMBER, Verdict
from cardan.checks.verdict_table import MOST, share
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule
from cardan.maths.ties import foremost_of
from cardan.texts import _

from .strength import Strength

SHOWN = 16
"""Limits with a bar of their own, those used most."""


def strength_figures(found: Strength) -> tuple[Figure, ...]:
    """Return the figures of the strength of a drive."""
    tired = [
        one
        for one in found.shafts
        if one.fatigue is not None and float(one.fatigue.mean + one.fatigue.alternating) > 0.0
    ]
    return (uses_figure(found), fatigue_figure(found)) if tired else (uses_figure(found),)


def role_of(one: Verdict) -> str:
    """Return the colour of a verdict: how near it is to its limit."""
    return "muted" if one.advice or one.state == "unconfirmed" else role(float(one.utilisation))


def role(used: float) -> str:
    """Return the colour of a utilisation.

    >>> role(0.5), role(0.95), role(1.2)
    ('good', 'warning', 'failed')
    """
    return "failed" if used > 1.0 else "warning" if used >= AMBER else "good"


def uses_figure(found: Strength) -> Figure:
    """Return the utilisation of every limit, the largest first."""
    order = sorted(found.judged, key=lambda one: -float(one.utilisation))[:SHOWN]
    source: list[Text] = [
        _("largest loads over the turn; Kozhevnikov & Perfil'ev (1978), eq. 261–266, Goodman, ISO 76, ISO 281, Hertz")
    ]
    if len(order) < len(found.judged):
        text = _("the {shown} most utilised of {all} checks")
        source.append(say(text, shown=len(order), all=len(found.judged)))
    if any(one.state == "unconfirmed" for one in order):
        source.append(_("grey: limits that nothing confirms"))
    if any(one.advice for one in order):
        source.append(_("grey: rules of thumb, which fail no drive"))
    rows = [(one.title, float(one.utilisation), role_of(one)) for one in order]
    return Figure(
        name="strength",
        title=_("Utilisation of every limit"),
        sentence="",
        source=Joined(source, between="; "),
        rows=(Row(panels=(bars_of(rows),), height=0.24 * max(len(order), 1) + 0.4),),
        aside=bool(found.judged),
    )


def bars_of(rows: list[tuple[str, float, str]]) -> Panel:
    """Return bars of utilisations with the limit drawn in. rows: name, utilisation and role, from the top."""
    size = np.asarray([100.0 * min(used, MOST) for _name, used, _role in rows])
    at = np.arange(len(rows), 0, -1, dtype=float)
    top = max(float(np.max(size, initial=0.0)), 100.0)
    ticks = steps(0.0, top, 5)
    bars = Bars(
        at=at,
        size=size,
        texts=tuple(share(used) for _name, used, _role in rows),
        roles=tuple(role for _name, _used, role in rows) or ("muted",),
        thick=0.62,
        lying=True,
    )
    names = tuple(name for name, _used, _role in rows)
    return Panel(
        series=(bars, Rule(value=100.0, upright=True, role="failed", dash="solid")),
        x=Axis(low=0.0, high=1.14 * top, ticks=ticks, texts=written(ticks)),
        y=Axis(low=0.4, high=max(len(rows), 1) + 0.6, ticks=tuple(at), texts=names, grid=False),
        title=_("Utilisation"),
        dimension="share",
        unit="percent",
    )


def fatigue_figure(found: Strength) -> Figure:
    """Return where the shafts stand under Goodman's line: swinging over mean stress, both over what they may be alone.

    found: with the fatigue of a shaft at least.
    """
    places = []
    for one in found.shafts:
        if one.fatigue is not None:
            swing = float(one.fatigue.alternating) / float(one.fatigue.endurance)
            places.append((one.number, 1.0 / float(one.fatigue.safety) - swing, swing, one.safety))
    most = max(1.0, *(1.1 * max(mean, swing) for _number, mean, swing, _safety in places))
    asked = next((one.bound for one in found.judged if one.check == "tube_fatigue"), 1.5)
    line = np.asarray([0.0, 1.0])
    series: list[Curve | Note | Band] = [
        Curve(x=line, y=1.0 - line, role="failed", label=_("breaks in the end")),
        Curve(
            x=line / asked,
            y=(1.0 - line) / asked,
            role="muted",
            dash="dashed",
            label=say(_("safety {safety}"), safety=Quantity(asked, digits=2)),
        ),
    ]
    for number, mean, swing, _safety in places:
        series.append(Curve(x=np.asarray([0.0, mean]), y=np.asarray([0.0, swing]), role=shaft(number), width=0.8))
        series.append(
            Curve(
                x=np.asarray([mean]),
                y=np.asarray([swing]),
                role=shaft(number),
                marker=6.0,
                width=0.0,
                label=_("shaft {number}").format(number=number),
            )
        )
    worst = foremost_of(places, lambda one: one[3], least=True)
    return Figure(
        name="fatigue",
        aside=True,  # the table tells the safety of each shaft
        title=_("Where the shafts stand under the line of fatigue"),
        sentence=say(
            _("Shaft {number} has a safety of {safety} against fatigue; {asked} is asked for."),
            number=worst[0],
            safety=Quantity(worst[3], digits=3),
            asked=Quantity(asked, digits=2),
        ),
        source=_("Goodman's line with Marin's factors, Shigley chapter 6"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(series),
                        x=axis(_("mean stress over tensile strength"), "", [np.asarray([0.0, most])], include=(0.0,)),
                        y=axis(
                            _("Alternating stress over fatigue limit"), "", [np.asarray([0.0, most])], include=(0.0,)
                        ),
                    ),
                ),
                height=2.6,
            ),
        ),
    )


FIGURES = {Strength: strength_figures}
"""Result -> what makes its figures."""
