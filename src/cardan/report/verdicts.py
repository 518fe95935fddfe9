"""The checks in the report: a page of them, and what of it stands on the first page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cardan.answers.answer import KeyFigure
from cardan.answers.reader import reader
from cardan.checks.key_figures import key_figures
from cardan.choices.check_answer import answer, ask, remedy_table, urgent
from cardan.errors import InputError
from cardan.questions.gathering import gather
from cardan.register import QUESTIONS
from cardan.texts import _, plural

from .answers import refused
from .block import Page, Table, page, row, table, verdict_columns
from .subject import Subject


@dataclass(frozen=True, eq=False, kw_only=True)
class Judged:
    """Verdicts on a drive and what of them stands where in the report."""

    page: Page | None = None  # all of them; None where nothing was judged
    lights: Table | None = None  # those that matter most, for the first page
    urgent: Sequence[KeyFigure] = ()  # the same as figures with their limits
    changes: Table | None = None  # the changes that help most, for the first page; None where nothing fails
    keys: Sequence[KeyFigure] = ()  # key figures with their limits


def judged(on: Subject) -> Judged:
    """Return the verdicts on a drive."""
    try:
        result = ask(on.drive, known=on.known)
    except InputError as error:
        return Judged(page=refused("check", _("Checks"), error), keys=tuple(key_figures(on.drive, ())))
    if result is None:
        return Judged(keys=tuple(key_figures(on.drive, ())))
    said = gather(QUESTIONS["check"], on.drive, answer(on.drive, result))
    shown, left = urgent(result)
    note = plural("One more check passed.", "{count} more checks passed.", left).format(count=left) if left else ""
    rows = [row(one, reader()) for one in shown]
    lights = Table(columns=verdict_columns(), rows=rows, title=_("Limits"), note=note) if rows else None
    changes = table(remedy_table(on.drive, result, helpful=True)) if result.remedies else None
    return Judged(page=page(said, reader()), keys=said.keys, lights=lights, urgent=shown, changes=changes)
