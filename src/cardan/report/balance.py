"""Checks of one part of the report: what a balance leaves over."""

from __future__ import annotations

from collections.abc import Iterable

from cardan.answers.checks import leftover
from cardan.errors import InputError
from cardan.figures.wording import significant
from cardan.texts import _

from .block import Cell, Column, Page, Table, Words, number, words

ROUNDING = 1e-9
"""Share of the largest term that rounding may leave of a balance: some thousand roundings and the condition of it."""


def checks(rows: Iterable[tuple[str, str, float, float]]) -> Table:
    """Return the table of checks.

    Parameters
    ----------
    rows : iterable of (str, str, float, float)
        What is checked, how, what is left, and what may be left.
    """
    return Table(
        title=_("Self-checks"),
        columns=(
            Column(heading=_("what"), left=True),
            Column(heading=_("how"), left=True),
            Column(heading=_("residual")),
            Column(heading=_("allowed")),
            Column(heading=_("verdict"), left=True),
        ),
        rows=[_row(*row) for row in rows],
    )


def _row(what: str, how: str, left: float, allowed: float) -> list[Cell]:
    passed = left <= allowed
    return [
        words(what),
        words(how),
        number(leftover(left) if allowed else _small(left), left),
        number(_small(allowed), allowed),
        words(_("passed") if passed else _("failed"), "good" if passed else "failed"),
    ]


def _small(value: float) -> str:
    return "0" if value == 0.0 else significant(value, 2)


def refused(name: str, title: str, error: InputError) -> Page:
    """Return the page of a question that the drive file does not answer, with what is missing."""
    left = [f"{one.field}: {one.message}" for one in error.problems]
    alarm = _("{part} not calculated: {first}").format(part=title, first=left[0])
    answer = _("Not calculated; the drive file leaves open:")
    if all(one.code == "unknown_kind" for one in error.problems):
        answer = _("Not calculated for joints of these kinds:")
    return Page(
        name=name,
        title=title,
        answer=answer,
        blocks=[Words(text=text, tone="warning") for text in left],
        alarms=[Words(text=alarm, tone="warning")],
    )
