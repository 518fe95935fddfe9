"""Page 3: how every shaft turns."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cardan.book.figures.comparison import book_figure
from cardan.figures.wording import fixed, percent, significant
from cardan.maths.arrays import Array
from cardan.questions.motion.figures.equivalence import orders_figure
from cardan.questions.motion.figures.motion import motion_figure
from cardan.texts import _
from cardan.units import deg

from .block import Block, Cell, Column, Page, Picture, Table, number, of_shaft, words
from .subject import Subject


def turning(on: Subject) -> Page:
    """Return the page of the motion."""
    figure = motion_figure(on.found)
    blocks: list[Block] = [Picture(figure=figure), _extremes(on)]
    if not on.even and not on.rounded:
        blocks.append(Picture(figure=orders_figure(on.whole)))
    if not on.alone_even:
        blocks += [Picture(figure=book_figure(on.compared)), _compared(on)]
    return Page(name="motion", title=_("Motion"), answer=_equivalent(on), blocks=blocks)


def _extremes(on: Subject) -> Table:
    each = on.each
    parts = (each.ratio_min, each.ratio_max, on.whole.shaft_irregularity, each.max_lead, each.max_acceleration)
    return extremes_table(np.stack([np.ravel(one) for one in parts], axis=-1), on.drive.duty.speed, even=1e-13)


def extremes_table(found: Array, speed: float | None, *, even: float) -> Table:
    """Return the table of what every shaft behind the first does over a turn.

    Parameters
    ----------
    found : array (n, 5)
        Of each shaft its least and greatest ratio, irregularity, lead [rad], and acceleration over the square of ω_1.
    speed : float or None [rad/s]
        ω_1.
    even : float
        Irregularity below which a shaft turns evenly.
    """
    scale = 1.0 if speed is None else speed**2
    rows: list[list[Cell]] = []
    for k, (low, high, share, ahead, pull) in enumerate(found.tolist()):
        lead, steep, still = ahead / deg, pull * scale, share < even
        places = 4 if still else min(max(4, 1 - math.floor(math.log10(share))), 9)  # so that the ratios are not alike
        rows.append(
            [
                of_shaft(k + 2, end=_("output") if k + 1 == len(found) else ""),
                number(fixed(low, places), low),
                number(fixed(high, places), high),
                number(percent(share).removesuffix(" %"), 100.0 * share),
                number("0" if still else significant(lead, 3), lead),
                number("0" if still else significant(steep), steep),
            ]
        )
    return Table(
        title=_("Extremes over a turn at uniform input"),
        columns=(
            Column(heading=_("shaft"), left=True),
            Column(heading=_("least ratio")),
            Column(heading=_("greatest ratio")),
            Column(heading=_("irregularity δ"), unit="%"),
            Column(heading=_("ahead and back of the mean by"), unit="°"),
            Column(heading=_("greatest acceleration"), unit="–" if speed is None else "rad/s²"),
        ),
        rows=rows,
        note=_("Acceleration over ω₁², the square of the input speed in rad/s.") if speed is None else "",
    )


def _equivalent(on: Subject) -> str:
    if on.alone_even:
        said = _("Every joint turns evenly by itself, and so does the output.")
        drawn = _("This concerns the drive as drawn, standing still.") if on.drive.movements else ""
        return f"{said} {drawn}".strip()
    if on.even:
        return _("What one joint does the others undo: the output turns as evenly as the input.")
    if on.rounded:
        return _("The output turns as evenly as the input but for the rounding of the figures that describe the drive.")
    return _(
        "The drive moves exactly like one universal joint bent by {bend}°, its driving yoke {phase}° from the plane of "
        "that joint at the start."
    ).format(bend=fixed(float(on.whole.bend) / deg, 3), phase=fixed(float(on.whole.phase) / deg))


def _compared(on: Subject) -> Table:
    seen = on.compared
    exact = float(seen.irregularity)
    bend = float(seen.bend) / deg
    rule = float(seen.rule_of_practice) / deg

    def row(name: str, source: str, share: float) -> list[Cell]:
        return [
            words(name),
            words(source),
            number(percent(share, 4).removesuffix(" %"), 100.0 * share),
            number(_off(share - exact, 100.0), 100.0 * (share - exact)),
        ]

    rows: Sequence[list[Cell]] = (
        [
            words(_("exact")),
            words(_("matrix product")),
            number(percent(exact, 4).removesuffix(" %"), 100.0 * exact),
            words("–"),
        ],
        row(_("series, first order"), _("Book (80), exact phase angles"), float(seen.irregularity_80)),
        row(_("series, mean phases"), _("first order, start position left out"), float(seen.irregularity_mean_phases)),
        row(_("series without Θ"), _("as calculated in Book (90)"), float(seen.irregularity_without_theta)),
    )
    return Table(
        title=_("Irregularity by the classical approximations"),
        columns=(
            Column(heading=_("way"), left=True),
            Column(heading=_("source"), left=True),
            Column(heading="δ", unit="%"),
            Column(heading=_("error"), unit="%"),
        ),
        rows=rows,
        note=_("The rule of practice √|Σ ±α²| gives an equivalent angle of {rule}°, exact is {bend}°.").format(
            rule=fixed(rule, 3), bend=fixed(0.0 if on.even else bend, 3)
        ),
    )


def _off(difference: float, scale: float) -> str:
    if abs(difference) < 1e-13:
        return "0"
    return ("+" if difference > 0.0 else "") + significant(scale * difference, 3)
