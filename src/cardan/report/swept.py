"""A sweep over keys of a drive that is open: its page, its figures, its table and the plan file that runs it again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeAlias

from cardan.answers.data import as_csv
from cardan.answers.reader import reader
from cardan.batch.answer import answer, drawn
from cardan.batch.answering.questions import questions
from cardan.batch.engine.running import run
from cardan.batch.figures.sweep import title_of
from cardan.batch.points.axes import GridAxis
from cardan.batch.points.fields import present
from cardan.batch.sweep import work_of
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, check
from cardan.figures.figure import Figure
from cardan.io.plan_file import plan_text
from cardan.texts import _

from .block import Page, capital
from .block import page as page_of

KEYS = 2  # keys that vary at most: so many a chart can show
MOST = 10_000  # points at most
ROWS = 100  # rows of the table that the page shows
STEPS = 21  # values of a key where nothing else is said
AROUND = (0.8, 1.2)  # shares of a value between which it varies where nothing else is said


Varied: TypeAlias = "tuple[str, float | None, float | None, int | None]"  # key, from, to, how many values


@dataclass(frozen=True, kw_only=True)
class Wanted:
    """What a user wants of a sweep; values in the units of their keys."""

    vary: tuple[Varied, ...] = ()
    ask: tuple[str, ...] = ("speed_fluctuation",)  # names of questions

    def axes(self) -> tuple[GridAxis, ...]:
        """Return what varies. Raises InputError: all that is missing or wrong, a sweep of too many points."""
        problems, axes = [], []
        if not self.vary:
            problems.append(Problem("vary", _("missing; a sweep varies at least one key")))
        for key, start, stop, count in self.vary:
            given = {"key": key, "from": start, "to": stop, "count": count}
            lacking = [name for name, value in given.items() if value in (None, "")]
            problems += [Problem(f"{key}: {name}" if key else name, _("missing"), "missing") for name in lacking]
            if key and start is not None and stop is not None and count is not None:
                try:
                    axes.append(GridAxis(field=key, start=start, stop=stop, count=count))
                except InputError as error:
                    problems += error.problems
        points = 1
        for axis in axes:
            points *= axis.size
        if points > MOST:
            text = _("{count} points; here are at most {most}, and cardan sweep runs more from a plan file")
            problems.append(Problem("vary", text.format(count=points, most=MOST), "out_of_range"))
        check(problems)
        return tuple(axes)

    def plan(self, drive: str) -> str:
        """Return the plan file of the sweep; drive: name of the drive file beside it."""
        return plan_text(drive, self.axes(), self.ask)


@dataclass(frozen=True, eq=False, kw_only=True)
class Swept:
    """What came out of a sweep."""

    page: Page  # what there is to say of it, without figures
    figures: Mapping[str, Figure]  # column of an answer -> it over the keys that vary
    titles: Mapping[str, str]  # the same columns -> what they are called
    table: str  # all rows as CSV


def choices() -> dict[str, str]:
    """Return what a sweep may ask: name -> what it answers, in the language spoken."""
    return {name: capital(_(one.doc)) for name, one in questions().items()}


def usual(drive: Drive, key: str) -> tuple[float, float] | None:
    """Return between which values a key varies where nothing else is said; None where the drive has no value there."""
    try:
        here = present(drive, key)
    except InputError:
        return None
    if not here:
        return None
    low, high = (float(f"{share * here:.4g}") for share in AROUND)
    return low, high


def swept(
    drive: Drive, wanted: Wanted, *, known: Catalogue | None = None, progress: Callable[[float], object] | None = None
) -> Swept:
    """Return what comes out of a sweep over keys of a drive; the rows are those of ``cardan sweep``.

    wanted: what varies and what is asked; progress: told the share done, may answer "stop".
    """
    work = work_of(drive, wanted.axes(), wanted.ask, known=known)
    found = run(work, progress=progress)
    told = answer(work, found, Path("sweep.toml"), keeps=True, rows=ROWS)
    names = [one.name for one in work.ask.answers]
    assert told.full is not None
    return Swept(
        page=page_of(replace(told, figures=tuple), reader()),
        figures=dict(zip(names, drawn(work, found, names), strict=False)),
        titles={one.name: title_of(one) for one in work.ask.answers},
        table="".join(as_csv(told.full(), reader())),
    )
