"""Every surface that an answer is shown on, and what it says there."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from openpyxl import load_workbook

from cardan.answers.answer import Answer
from cardan.answers.data import as_csv, as_json, data
from cardan.answers.question import Question
from cardan.answers.reader import Reader
from cardan.app.parts.blocks import block_html
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.report.answers import page_of, subject
from cardan.report.block import Block, Cell, Listing, Page, Picture
from cardan.report.content import Excerpt
from cardan.report.render import html
from cardan.report.render.exports import exported
from cardan.texts import language

SILENT = (
    "name",
    "role",
    "roles",
    "dash",
    "side",
    "level",
    "tone",
    "source",
    "title",
    "full",
    "form",
    "amount",
    "keys",
    "lacking",
)
"""Fields of a page that nobody reads as a sentence."""

IN_WORDS = ("check", "strength")
"""Questions whose results hold sentences in the language in which they were asked."""


@dataclass(frozen=True)
class Once(Question):
    """A question that is asked of a drive once, however often it is told."""

    results: dict[tuple[int, str], Any] = field(default_factory=dict, compare=False)

    def ask(self, drive: Drive, **given: Any) -> Any:
        """Return the result of the first time, or raise what it raised."""
        key = (id(drive), language() if self.name in IN_WORDS else "")
        if key not in self.results:
            try:
                self.results[key] = drive, super().ask(drive, **given)
            except InputError as error:
                self.results[key] = drive, error
        found = self.results[key][1]  # the drive is kept too: another one would get its place in memory
        if isinstance(found, InputError):
            raise found
        return found


def once(question: Question) -> Once:
    """Return a question of the register that remembers its results."""
    return Once(**{one.name: getattr(question, one.name) for one in fields(Question)})


SENTENCE_ENDS = re.compile(r"(?<!\bno)(?<!\beq)(?<!\bp)[.!?](?=\s+[A-ZΑ-Ω\[])")
"""Where one sentence ends and another begins."""


def sentences(text: str) -> int:
    """Return how many sentences an English text has."""
    return 1 + len(SENTENCE_ENDS.findall(text))


def page(question: Question, drive: Drive) -> Page:
    """Return the page of report and app."""
    return page_of(question, subject(drive), None, {})


def terminal(answer: Answer, drive: Drive) -> str:
    """Return what a command prints."""
    with redirect_stdout(io.StringIO()) as printed:
        tell(answer, Path("drive.toml"), drive)
    return printed.getvalue()


def as_data(answer: Answer, who: Reader) -> dict[str, Any]:
    """Return what a command prints as JSON; it can be written down."""
    found = data(answer, who)
    assert as_json(found)
    return found


def csv(answer: Answer, who: Reader) -> str:
    """Return what a command prints as CSV; nothing where there is no table."""
    if answer.full is None and not answer.tables:
        return ""
    return "".join(as_csv(answer.full() if answer.full is not None else answer.tables[-1], who))


def report(shown: Page) -> str:
    """Return the page as the HTML file of a report."""
    return html.excerpt(Excerpt(title="drive", page=shown)).decode()


def workbook(shown: Page) -> list[str]:
    """Return the words in the cells of the page as a workbook."""
    book = load_workbook(io.BytesIO(exported(shown, "xlsx", title="drive").content), read_only=True)
    return [
        cell for sheet in book for row in sheet.iter_rows(values_only=True) for cell in row if isinstance(cell, str)
    ]


def app(shown: Page) -> str:
    """Return the blocks of the page as the app shows them; figures are charts there, drawn by the browser."""
    return "".join(block_html(block) for block in shown.blocks if not isinstance(block, Picture))


def texts(one: Page | Block | Any) -> Iterator[str]:
    """Yield everything that a page says, but for files as they stand."""
    if isinstance(one, str):
        yield one
    elif isinstance(one, tuple | list):
        for part in one:
            yield from texts(part)
    elif isinstance(one, Cell):
        yield one.text
    elif not isinstance(one, Listing):
        for name in getattr(one, "__dataclass_fields__", ()):
            if name not in SILENT:
                yield from texts(getattr(one, name))


def leaves(one: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every value of a tree with its own key."""
    if isinstance(one, dict):
        for name, value in one.items():
            yield from leaves(value, name)
    elif isinstance(one, list | tuple) and any(isinstance(value, dict | list | tuple) for value in one):
        for value in one:
            yield from leaves(value, key)
    else:
        yield key, one
