"""What other sizes bring: tubes by mass, utilisation and critical speed; sizes of a catalogue; a part at its limit."""

from __future__ import annotations

import numpy as np

from cardan.answers.palette import DASHES
from cardan.answers.quantity import Quantity, Text, say
from cardan.checks.strength.figure import bars_of, role
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.texts import _
from cardan.units import rpm

from .size_search import Sizing
from .trade_off import TradeOff

MOST_USED = 2.0
"""Utilisations are drawn up to here: beyond they tell nothing more."""


def trade_off_figures(found: TradeOff) -> tuple[Figure, ...]:
    """Return the figures of tubes weighed against each other."""
    return (trade_off_figure(found),)


def trade_off_figure(found: TradeOff) -> Figure:
    """Return utilisation and critical speed over mass, a curve for each wall, the best tubes marked."""
    used = np.where(found.utilisation <= MOST_USED, found.utilisation, np.nan)
    shown = np.isfinite(used)
    critical = np.where(shown, found.critical / rpm, np.nan)
    mass = np.where(shown, found.mass, np.nan)
    below = axis(_("mass of the tube"), "kg", [mass], dimension="mass", include=(found.now[2],), count=8)
    bare = axis("", "", [mass], include=(found.now[2],), count=8)

    def panel(
        rows: np.ndarray, label: str, unit: str, dimension: str, now: float, rules: tuple[Rule, ...], *, named: bool
    ) -> Panel:
        curves = [
            Curve(
                x=mass[:, j],
                y=rows[:, j],
                role=("ink", "accent")[j // len(DASHES) % 2],
                dash=DASHES[j % len(DASHES)],
                width=0.9,
                label="" if named else say(_("wall {wall}"), wall=Quantity(float(wall), "length", 2)),
            )
            for j, wall in enumerate(found.wall)
            if np.any(shown[:, j])
        ]
        best = found.best & shown
        marks = Curve(
            x=mass[best],
            y=rows[best],
            width=0.0,
            marker=4.5,
            role="good",
            label="" if named else _("not beaten by another"),
        )
        here = Curve(
            x=np.asarray([found.now[2]]),
            y=np.asarray([now]),
            width=0.0,
            marker=8.0,
            role="warning",
            label="" if named else _("as it is"),
        )
        include = [now, *(rule.value for rule in rules)]
        return Panel(
            series=(*curves, marks, here, *rules),
            x=below if named else bare,
            y=axis(label, unit, [rows], dimension=dimension, include=include, count=5),
        )

    limit = Rule(value=100.0, role="failed", dash="solid", text=_("limit"))
    needed = (
        ()
        if not np.isfinite(found.needed)
        else (Rule(value=found.needed / rpm, role="warning", dash="solid", text=_("advised")),)
    )
    return Figure(
        name="trade-off",
        title=_("Other tubes for shaft {number}: mass, strength and critical speed").format(number=found.shaft),
        sentence=_sentence(found),
        source=_("checks of strength, fatigue and twist; critical speed as real"),
        rows=(
            Row(
                panels=(
                    panel(
                        100.0 * used,
                        _("Largest utilisation"),
                        "percent",
                        "share",
                        100.0 * found.now[3],
                        (limit,),
                        named=False,
                    ),
                ),
                height=2.0,
            ),
            Row(
                panels=(
                    panel(
                        critical, _("Critical speed"), "rpm", "angular_speed", found.now[4] / rpm, needed, named=True
                    ),
                ),
                height=2.0,
            ),
        ),
    )


def _sentence(found: TradeOff) -> Text:
    light = found.lightest
    if light is None:
        return _("No tube looked at passes.")
    return say(
        _("The lightest tube that passes weighs {mass}: {outer} by {wall}; now it is {now}."),
        mass=Quantity(light[2], "mass", 3),
        outer=Quantity(light[0], "length", 3),
        wall=Quantity(light[1], "length", 2),
        now=Quantity(found.now[2], "mass", 3),
    )


def sizing_figures(found: Sizing) -> tuple[Figure, ...]:
    """Return the figures of a sized part."""
    return (sizing_figure(found),)


def sizing_figure(found: Sizing) -> Figure:
    """Return what a sized part uses of its limits; for a joint, what every size of the catalogue uses."""
    rows = _rows(found)
    if found.tried:
        chosen = next((one.id for one in found.tried if one.passed), "")
        text = _("{size} is the smallest that passes.") if chosen else _("No size of the catalogue passes.")
        sentence, title = text.format(size=chosen), _("Utilisation of each size of the catalogue")
    else:
        first = found.governing
        title = _("Utilisation of the part as it is made")
        sentence = _("The size is decided by {title}.").format(title="" if first is None else first.title)
    return Figure(
        name="sizing",
        title=title,
        sentence=sentence,
        source=_("the checks of the part, inverted"),
        rows=(Row(panels=(bars_of(rows),), height=0.26 * max(len(rows), 1) + 0.4),),
    )


def _rows(found: Sizing) -> list[tuple[str, float, str]]:
    if found.tried:
        return [(one.id, one.utilisation, role(one.utilisation)) for one in found.tried if one.worst is not None]
    made = sorted(found.made, key=lambda one: -float(one.utilisation))
    return [(one.title, float(one.utilisation), role(float(one.utilisation))) for one in made]


FIGURES = {Sizing: sizing_figures, TradeOff: trade_off_figures}
"""Result -> what makes its figures."""
