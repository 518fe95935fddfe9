"""What other sizes bring: tubes by mass, utilisation and critical speed; sizes of a catalogue; a part at its limit."""

from __future__ import annotations

import numpy as np

from cardan.checks.strength.figure import AMBER, bars_of
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.figures.palette import DASHES
from cardan.figures.wording import significant
from cardan.texts import _
from cardan.units import mm, rpm

from .sized import Sizing
from .trade_off import TradeOff

MOST_USED = 2.0
"""Utilisations are drawn up to here: beyond they tell nothing more."""


def trade_off_figures(found: TradeOff) -> tuple[Figure, ...]:
    """Return the figures of tubes weighed against each other."""
    return (trade_off_figure(found),)


def trade_off_figure(found: TradeOff) -> Figure:
    """Return utilisation and critical speed over mass, a curve for each wall, the best tubes marked.

    Parameters
    ----------
    found : TradeOff
    """
    used = np.where(found.utilisation <= MOST_USED, found.utilisation, np.nan)
    shown = np.isfinite(used)
    critical = np.where(shown, found.critical / rpm, np.nan)
    mass = np.where(shown, found.mass, np.nan)
    below = axis(_("mass of the tube"), "kg", [mass], include=(found.now[2],), count=8)
    bare = axis("", "", [mass], include=(found.now[2],), count=8)

    def panel(rows: np.ndarray, label: str, unit: str, now: float, rules: tuple[Rule, ...], *, named: bool) -> Panel:
        curves = [
            Curve(
                x=mass[:, j],
                y=rows[:, j],
                role=("ink", "accent")[j // len(DASHES) % 2],
                dash=DASHES[j % len(DASHES)],
                width=0.9,
                label="" if named else _("wall {wall} mm").format(wall=significant(float(wall) / mm, 2)),
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
            y=axis(label, unit, [rows], include=include, count=5),
        )

    limit = Rule(value=100.0, role="failed", dash="solid", text=_("limit"))
    needed = (
        ()
        if not np.isfinite(found.needed)
        else (Rule(value=found.needed / rpm, role="failed", dash="solid", text=_("needed")),)
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
                        100.0 * used, _("Largest share of a limit"), "%", 100.0 * found.now[3], (limit,), named=False
                    ),
                ),
                height=2.0,
            ),
            Row(
                panels=(panel(critical, _("Critical speed"), "rpm", found.now[4] / rpm, needed, named=True),),
                height=2.0,
            ),
        ),
    )


def _sentence(found: TradeOff) -> str:
    light = found.lightest
    if light is None:
        return _("No tube looked at passes.")
    text = _("The lightest tube that passes weighs {mass} kg: {outer} mm by {wall} mm; now it is {now} kg.")
    return text.format(
        mass=significant(light[2], 3),
        outer=significant(light[0] / mm, 3),
        wall=significant(light[1] / mm, 2),
        now=significant(found.now[2], 3),
    )


def sizing_figures(found: Sizing) -> tuple[Figure, ...]:
    """Return the figures of a sized part."""
    return (sizing_figure(found),)


def sizing_figure(found: Sizing) -> Figure:
    """Return what a sized part uses of its limits; for a joint, what every size of the catalogue uses.

    Parameters
    ----------
    found : Sizing
    """
    rows = _rows(found)
    if found.tried:
        chosen = next((one.id for one in found.tried if one.passed), "")
        text = _("{size} is the smallest that passes.") if chosen else _("No size of the catalogue passes.")
        sentence, title = text.format(size=chosen), _("What each size of the catalogue uses of its limits")
    else:
        first = found.governing
        title = _("What the part uses of its limits as it is made")
        sentence = _("The size is decided by {title}.").format(title="" if first is None else first.title)
    return Figure(
        name="sizing",
        title=title,
        sentence=sentence,
        source=_("the checks of the part, inverted"),
        rows=(Row(panels=(bars_of(rows),), height=0.26 * max(len(rows), 1) + 0.4),),
    )


def _rows(found: Sizing) -> list[tuple[str, float, str]]:
    def role(used: float) -> str:
        return "failed" if used > 1.0 else "warning" if used >= AMBER else "good"

    if found.tried:
        return [(one.id, one.utilisation, role(one.utilisation)) for one in found.tried if one.worst is not None]
    made = sorted(found.made, key=lambda one: -float(one.utilisation))
    return [(one.title, float(one.utilisation), role(float(one.utilisation))) for one in made]
