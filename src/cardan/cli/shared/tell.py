"""Tells an answer: for the eye, as JSON, as CSV, as a figure; in the units of the reader."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from shlex import join
from textwrap import fill, wrap
from typing import Any

from rich.console import Console
from rich.text import Text

from cardan.answers.answer import FILE, Answer, Remark, Tone
from cardan.answers.data import as_csv, as_json, data
from cardan.answers.printed import SHOWN, Column, Table, printed
from cardan.answers.quantity import told
from cardan.answers.question import Question
from cardan.answers.reader import Reader, reader
from cardan.drive.drive import Drive
from cardan.drive.fields.plausibility import doubts
from cardan.later import later
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.gathering import gather
from cardan.register import QUESTIONS
from cardan.texts import _

from .output import print_lines, print_text

drawing = later("cardan.figures")
"""What draws into a file: most commands draw nothing."""

GAP = 2  # blanks between columns
NARROWEST = 14  # prose in a table is not set narrower than this
WIDEST = 100  # sentences are not set wider than this, however wide the terminal

UNITS = "mm|m|°|deg|rpm|rad/s|1/s|s|ms|h|Hz|k?N·m|k?N|MPa|GPa|kg|g|k?W|J|%"
"""What stays with the number before it at the end of a line, as a pattern."""

SIGNS: dict[Tone, tuple[str, str]] = {
    "plain": ("", ""),
    "good": ("●", "green"),
    "warning": ("▲", "yellow"),
    "failed": ("✖", "red"),
    "next": ("→", "cyan"),
}
"""Tone -> sign and colour; the sentence itself says it in words."""

LONGEST = 34  # letters of a name at the head of a row


def tell(
    answer: Answer,
    file: Path | None = None,
    drive: Drive | Mechanism | None = None,
    *,
    whole: Drive | None = None,
    asks: Question | None = None,
    alone: bool = False,
    name: str = "",
    json: bool = False,
    csv: bool = False,
    plot: Path | None = None,
) -> int:
    """Tell an answer the way the user asked for and return its exit code.

    drive: what it describes; a drive that has other conditions is asked in these too.
    whole: the same with all its load cases, where the answer is of one of them.
    asks: what is asked in the other conditions; the question of the register that the answer is of by default.
    name: what to call what was asked about, instead of the drive or its file; json, csv: ``--json`` and ``--csv``.
    plot: ``--plot``; drawn first, so that nothing is printed when it cannot be.
    """
    who = reader()
    if isinstance(drive, Drive):
        asked = asks or QUESTIONS.get(answer.name)
        if asked is not None and not alone:
            answer = gather(asked, whole or drive, answer)
        odd = tuple(Remark(text=one.text, tone="warning", code="implausible") for one in doubts(drive))
        answer = replace(answer, remarks=(*odd, *answer.remarks))
    figures = answer.figures() if plot is not None else ()
    if plot is not None and figures:
        drawing().save(figures, plot)
    drawn = plot if figures else None
    if json:
        about = {} if file is None else {"drive": drive.name if drive else "", "file": str(file)}
        content = data(answer, who)
        first = {"answer": content.pop("answer"), "question": content.pop("question"), **about}
        last = {**({} if drawn is None else {"plot": str(drawn)}), "exit_code": answer.code}
        print_text(as_json({**first, **content, **last}) + "\n")
    elif csv and (answer.full is not None or answer.tables):
        print_lines(as_csv(answer.full() if answer.full is not None else answer.tables[-1], who))
    else:
        called = name or ("" if drive is None and file is None else _name(drive, file))
        _write(answer, who, called, file, drawn)
    return answer.code


def _name(drive: Drive | Mechanism | None, file: Path | None) -> str:
    """Return what to call a drive in a sentence: its name, else that of its file."""
    if drive is not None and drive.name:
        return drive.name
    return "" if file is None or str(file) == "-" else file.name


def _write(answer: Answer, who: Reader, name: str, file: Path | None, plot: Path | None) -> None:
    """Print an answer for the eye."""
    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=False)
    wide = min(console.width, WIDEST)
    sign, colour = SIGNS[answer.tone]
    said = told(answer.sentence, who)
    first = _filled(f"{sign} {name + ': ' if name else ''}{said}".strip(), wide)
    console.print(Text(first, style=f"bold {colour}".strip()), soft_wrap=True)
    for table in answer.tables:
        if table.depth in SHOWN["brief"]:
            console.print()
            _print_table(console, printed(table, who, "brief"))
    for listing in answer.listings:
        if listing.depth in SHOWN["brief"]:
            console.print()
            console.print(Text(listing.title, style="bold"))
            console.print(Text(listing.text), soft_wrap=True)
    remarks = [one for one in answer.remarks if one.depth in SHOWN["brief"]]
    if plot is not None:
        remarks.append(Remark(text=_("Figure drawn: {path}").format(path=plot)))
    if remarks:
        console.print()
    for remark in remarks:
        _print_remark(console, remark, who, wide, file)
    sys.stdout.flush()


def _print_remark(console: Console, remark: Remark, who: Reader, wide: int, file: Path | None) -> None:
    """Print a remark, with what to type next on a line of its own."""
    mark, tint = SIGNS[remark.tone]
    line = Text(
        _filled(f"{mark} {told(remark.text, who)}".strip(), wide),
        style=tint if remark.tone in ("failed", "warning") else "",
    )
    line.stylize(tint, 0, len(mark))
    console.print(line, soft_wrap=True)
    if remark.command:
        words = [str(file) if word == FILE else word for word in remark.command]
        console.print(Text(f"    {join(words)}", style=tint), soft_wrap=True)


def _print_table(console: Console, table: Table) -> None:
    """Print a table, parted where it is wider than the terminal."""
    if table.title:
        console.print(Text(table.title, style="bold"))
    columns = table.columns
    cells = [
        [
            _signed(cell.tone, _short(cell.text) if k < table.fixed < len(row) else cell.text)
            for k, cell in enumerate(row)
        ]
        for row in table.rows
    ]
    headings = [[column.heading for column in columns], [column.unit for column in columns]]
    widths = [max(len(row[k]) for row in headings + cells) for k in range(len(columns))]
    if columns and columns[-1].wrap:
        room, alone = (console.width - GAP - sum(GAP + one for one in widths[:k]) for k in (-1, table.fixed))
        widths[-1] = min(widths[-1], room if room >= NARROWEST else max(NARROWEST, alone))
    for place, block in enumerate(_blocks(widths, table.fixed, console.width)):
        if place:
            console.print()
        for row in headings:
            if any(row[k] for k in block):
                console.print(Text(_line(row, widths, columns, block), style="dim"), soft_wrap=True)
        for row, shown in zip(cells, table.rows, strict=True):
            for line in _lines(row, widths, columns, block):
                text = Text(line)
                text.stylize(SIGNS[shown[0].tone][1], 0, GAP + widths[0])
                console.print(text, soft_wrap=True)
    if table.note:
        console.print(Text(_filled(table.note, min(console.width, WIDEST)), style="dim"), soft_wrap=True)


def _signed(tone: Tone, text: str) -> str:
    """Return the words of a cell behind the sign of its tone."""
    return f"{SIGNS[tone][0]} {text}".strip()


def _short(name: str) -> str:
    """Return a name that leaves room for what is said of it."""
    return name if len(name) <= LONGEST else name[: LONGEST - 1] + "…"


def _lines(row: list[str], widths: Sequence[int], columns: Sequence[Column], block: list[int]) -> list[str]:
    """Return the lines of a row: one, or several where its last cell is prose."""
    last = len(columns) - 1
    parts = wrap(row[-1], max(1, widths[-1])) if columns[-1].wrap and last in block else []
    every: list[list[str]] = [
        [*row[:-1], part] if k == 0 else [*[""] * last, part] for k, part in enumerate(parts or row[-1:])
    ]
    return [_line(one, widths, columns, block) for one in every]


def _line(cells: Sequence[str], widths: Sequence[int], columns: Sequence[Any], block: list[int]) -> str:
    """Return one line of a table."""
    parts = [cells[k].ljust(widths[k]) if columns[k].left else cells[k].rjust(widths[k]) for k in block]
    return (" " * GAP + (" " * GAP).join(parts)).rstrip()


def _blocks(widths: Sequence[int], fixed: int, room: int) -> Iterator[list[int]]:
    """Yield the columns of each part of a table, so that no part is wider than the terminal."""
    head = list(range(fixed))
    start = sum(GAP + widths[k] for k in head)
    block, used = list(head), start
    for k in range(fixed, len(widths)):
        if used + widths[k] + GAP > room and len(block) > fixed:
            yield block
            block, used = list(head), start
        block.append(k)
        used += widths[k] + GAP
    yield block


def _filled(text: str, width: int) -> str:
    """Return a text in lines; a number, thin blanks within it, and its unit stay together.

    >>> _filled("shaft 2 carries 60.0 ± 173 N·m", 26).splitlines()
    ['shaft 2 carries 60.0', '± 173 N·m']
    """
    held = re.sub(rf"(?<=[\d±]) (?=\d|(?:{UNITS})(?![\w/]))", "\u00a0", text)
    return fill(held, width, break_on_hyphens=False, break_long_words=False).replace("\u00a0", " ")
