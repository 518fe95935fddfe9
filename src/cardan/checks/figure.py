"""Utilisation of every limit of a drive: bars like traffic lights."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row
from cardan.texts import _

from . import Verdict
from .verdict_table import MOST

BARS = 16
"""Bars in a figure; the least used limits are left out."""

WIDEST = 10.0
"""Utilisation at which bars are cut; an arrow at the end of what uses more says so."""

ROLES = {"passed": "good", "unconfirmed": "muted", "close": "warning", "failed": "failed"}

SIGNS = {"passed": "●", "unconfirmed": "○", "close": "▲", "failed": "✖"}


def check_figures(verdicts: Sequence[Verdict], *, name: str = "") -> tuple[Figure, ...]:
    """Return the figure of the verdicts of one drive; none where nothing was judged."""
    run = sorted((one for one in verdicts if one.run and not one.advice), key=lambda one: -float(one.utilisation))
    return (_figure(run, name),) if run else ()


def _figure(run: Sequence[Verdict], name: str) -> Figure:
    shown = run[:BARS]
    shares = np.asarray([float(one.utilisation) for one in shown])
    top = min(max(1.15, 1.1 * float(np.max(shares))), WIDEST)
    at = np.arange(len(shown), 0, -1, dtype=float)
    bars = Bars(
        at=at,
        size=shares,
        texts=tuple(
            say(
                f"{'▶ ' if used > WIDEST else ''}{SIGNS[one.state]} {{used}}",
                used=Quantity(used, decimals=2, most=MOST),
            )
            for one, used in zip(shown, shares.tolist(), strict=True)
        ),
        roles=tuple(ROLES[one.state] for one in shown),
        thick=0.62,
        lying=True,
        most=WIDEST,
    )
    limit = Curve(x=np.asarray([1.0, 1.0]), y=np.asarray([0.4, len(shown) + 0.6]), role="ink", dash="dashed")
    ticks = steps(0.0, top, 5)
    titles = tuple(one.title for one in shown)
    upright = Axis(low=0.4, high=len(shown) + 0.6, ticks=tuple(at), texts=titles, grid=False)
    along = Axis(low=0.0, high=1.16 * top, ticks=ticks, texts=written(ticks))
    panel = Panel(series=(bars, limit), x=along, y=upright, title=_("Utilisation"))
    return Figure(
        name="checks",
        title=_("Checks of {name}").format(name=name) if name else _("Checks"),
        sentence=_("The {count} with the highest utilisation are shown.").format(count=BARS) if len(run) > BARS else "",
        source=_(
            "Utilisation: value over limit, or limit over value where it must be at least that; green keeps its limit, "
            "grey keeps one that nothing confirms, amber comes near, red fails"
        ),
        rows=(Row(panels=(panel,), height=0.25 * len(shown) + 0.3),),
        aside=True,  # the table tells the same
    )
