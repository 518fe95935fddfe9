"""Exact motion beside the classical approximations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.book.comparison import BookComparison
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.figures.turning import across
from cardan.texts import _
from cardan.units import deg


def book_figures(found: BookComparison) -> tuple[Figure, ...]:
    """Return the figures of a comparison with the book's series."""
    return (book_figure(found),)


def book_figure(found: BookComparison) -> Figure:
    """Return the output's angle error, exact and by the series of first and second order, and what these miss.

    found: of one drive.
    """
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
    lower = Panel(
        series=(
            Rule(value=0.0, dash="solid", role="faint"),
            Curve(x=angle, y=first - exact, role="first order", width=1.4, dash="dashed"),
            Curve(x=angle, y=second - exact, role="second order", width=1.4, dash="dotted"),
        ),
        x=across(angle, named=True),
        y=axis(
            _("Error of the approximation"),
            "deg",
            [first - exact, second - exact],
            dimension="angle",
            mirrored=0.0,
            least=1e-9,
            count=4,
        ),
    )
    misses = [float(np.max(np.abs(row - exact))) for row in (first, second)]
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
