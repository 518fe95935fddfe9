"""Checks of an answer on itself, and how closely they hold: digits beyond the power of ten are the processor's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from cardan.maths.ties import power_of
from cardan.texts import _

from .answer import Cell, Column, Depth, Table, Tone
from .numbers import raised
from .quantity import Quantity, Text

SHORT = -2
"""Powers of ten from this on are written out."""


@dataclass(frozen=True, kw_only=True)
class Checked:
    """One check."""

    what: str  # what, how: what is checked, and how
    how: str
    left: float  # what is left over, relative
    allowed: float  # how much may be

    @property
    def passed(self) -> bool:
        """Whether no more is left than may be."""
        return self.left <= self.allowed


def checks(rows: Sequence[Checked], depth: Depth = "full") -> Table:
    """Return the table of checks; residuals are told to people by their power of ten, to programs in full.

    >>> from .printed import printed
    >>> from .reader import USUAL
    >>> held = Checked(what="power", how="in less out", left=3e-14, allowed=1e-9)
    >>> [cell.text for cell in printed(checks([held]), USUAL).rows[0]]
    ['power', 'in less out', 'rounding', '10⁻⁹', 'passed']
    """
    tones: list[Tone] = ["good" if one.passed else "failed" for one in rows]
    words = [_("passed") if one.passed else _("failed") for one in rows]
    return Table(
        name="checks",
        title=_("Self-checks"),
        records=True,
        columns=(
            Column(key="what", heading=_("what"), values=[one.what for one in rows]),
            Column(key="how", heading=_("how"), values=[one.how for one in rows]),
            Column(key="", heading=_("residual"), values=[leftover(one.left) for one in rows]),
            Column(key="", heading=_("allowed"), values=[_power(one.allowed) for one in rows]),
            Column(
                key="",
                heading=_("verdict"),
                values=[Cell(value=word, tone=tone) for word, tone in zip(words, tones, strict=True)],
            ),
            Column(key="residual", values=[one.left for one in rows], depth="data"),
            Column(key="allowed", values=[one.allowed for one in rows], depth="data"),
        ),
        depth=depth,
    )


def leftover(residual: float) -> str:
    """Return a residual for a cell beside what is allowed: below which power of ten it is, or that it is rounding.

    >>> leftover(7e-16), leftover(3.2e-10), leftover(float("nan"))
    ('rounding', '< 10⁻⁹', '–')
    """
    if not math.isfinite(residual):
        return "–"
    power = power_of(residual)
    return _("rounding") if power is None else f"< {_ten(power)}"


def closely(residual: float) -> str:
    """Return how closely a check holds, for a sentence.

    >>> closely(7e-16), closely(3.2e-10), closely(0.02), closely(float("nan"))
    ('to rounding', 'to 10⁻⁹', 'to 0.1', 'not at all')
    """
    if not math.isfinite(residual):
        return _("not at all")
    power = power_of(residual)
    return _("to rounding") if power is None else _("to {size}").format(size=_ten(power))


def _power(value: float) -> Text:
    power = math.log10(value) if value > 0.0 else 0.0
    round_ten = value and power < SHORT and abs(power - round(power)) < 1e-9
    return _ten(round(power)) if round_ten else Quantity(value, digits=2, trim=True)


def _ten(power: int) -> str:
    return f"{10.0**power:g}" if power >= SHORT else f"10{raised(power)}"
