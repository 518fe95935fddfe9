"""The checks in the report: a page of them, and what of it stands on the first page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cardan.answers import answer
from cardan.answers.answer import KeyFigure
from cardan.answers.quantity import Text, say
from cardan.answers.reader import reader
from cardan.checks.key_figures import key_figures
from cardan.checks.verdict_table import BY, MISSING
from cardan.choices import check_answer
from cardan.choices.check_answer import ask, remedy_table, urgent
from cardan.errors import InputError
from cardan.questions.gathering import gather
from cardan.register import QUESTIONS
from cardan.texts import _, plural

from .answers import refused
from .block import Block, Page, Points, Table, Words, page, row, shown, table, verdict_columns
from .subject import Subject


@dataclass(frozen=True, eq=False, kw_only=True)
class Judged:
    """Verdicts on a drive and what of them stands where in the report."""

    page: Page | None = None  # all of them; None where nothing was judged
    lights: Table | None = None  # those that matter most, for the first page
    urgent: Sequence[KeyFigure] = ()  # the same as figures with their limits
    changes: Table | None = None  # the changes that help most, for the first page; None where nothing fails
    keys: Sequence[KeyFigure] = ()  # key figures with their limits
    missing: Page | None = None  # the checks not run and the keys they need, for the appendix; None where all were


def judged(on: Subject, *, whole: bool = True) -> Judged:
    """Return the verdicts on a drive, their page whole with what stands aside."""
    try:
        result = ask(on.drive, known=on.known)
    except InputError as error:
        return Judged(page=refused("check", _("Checks"), error), keys=tuple(key_figures(on.drive, ())))
    if result is None:
        return Judged(keys=tuple(key_figures(on.drive, ())))
    said = gather(QUESTIONS["check"], on.drive, check_answer.answer(on.drive, result))
    closest, left = urgent(result)
    note = plural("One more check passed.", "{count} more checks passed.", left).format(count=left) if left else ""
    rows = [row(one, reader()) for one in closest]
    lights = Table(columns=verdict_columns(), rows=rows, title=_("Limits"), note=note) if rows else None
    changes = table(remedy_table(on.drive, result, helpful=True)) if result.remedies else None
    lacking = [table(one) for one in said.tables if one.name == MISSING]
    count = sum(bool(one.missing) for one in result.verdicts)
    text = plural(
        "One check was not run, as the drive file does not say enough for it.",
        "{count} checks were not run, as the drive file does not say enough for them.",
        count,
    ).format(count=count)
    sources: list[Text] = []
    tables = [_cited(one, sources) for one in said.tables if one.name != MISSING]
    shorter = page(replace(said, tables=tables), reader(), whole=whole)
    after: list[Block] = [Words(text=text)] if lacking else []
    if sources:
        numbered = [say("[{k}] {source}", k=str(k), source=one) for k, one in enumerate(sources, start=1)]
        after.append(Points(title=_("Where the limits come from"), items=numbered))
    return Judged(
        page=replace(shorter, blocks=[*shorter.blocks, *after]),
        keys=said.keys,
        lights=lights,
        urgent=closest,
        changes=changes,
        missing=Page(
            name=MISSING,
            title=_("Checks not run"),
            answer=_("Each is run where the drive file has these keys."),
            blocks=lacking,
        )
        if lacking
        else None,
    )


def _cited(given: answer.Table, sources: list[Text]) -> answer.Table:
    """Return a table of verdicts that names where limits come from by numbers in a list of sources, which grows."""
    columns = []
    for one in given.columns:
        if one.key == BY:
            own = [shown(text) for text in one.values]
            sources += [text for text in dict.fromkeys(own) if text and text not in sources]
            numbers = [f"[{sources.index(text) + 1}]" if text else "" for text in own]
            one = replace(one, heading=_("no."), values=numbers)
        columns.append(one)
    return replace(given, columns=columns)
