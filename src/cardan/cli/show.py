"""Prints an answer: for the eye, as JSON, as CSV, as a figure."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.errors import refuse
from cardan.texts import _
from cardan.units import spoken

from .answer import Answer, Cell, Column, Remark, Table, Tone, printed

if TYPE_CHECKING:
    from rich.console import Console

GAP = 2
"""Blanks between columns."""

NARROWEST = 14
"""Prose in a table is not set narrower than this."""

WIDEST = 100
"""Sentences are not set wider than this, however wide the terminal."""

UNITS = "|".join(
    (
        "mm",
        "m",
        "°",
        "deg",
        "rpm",
        "rad/s",
        "1/s",
        "s",
        "ms",
        "h",
        "Hz",
        "k?N·m",
        "k?N",
        "MPa",
        "GPa",
        "kg",
        "g",
        "k?W",
        "J",
        "%",
    )
)
"""What stays with the number before it at the end of a line, as a pattern."""

SIGNS: dict[Tone, tuple[str, str]] = {
    "plain": ("", ""),
    "good": ("●", "green"),
    "warning": ("▲", "yellow"),
    "failed": ("✖", "red"),
    "next": ("→", "cyan"),
}
"""Tone -> sign and colour; the sentence itself says it in words."""


def show(answer: Answer, *, json: bool = False, csv: bool = False, plot: Path | None = None) -> int:
    """Print an answer the way the user asked for and return its exit code.

    Parameters
    ----------
    answer : Answer
        What to say.
    json, csv : bool
        ``--json`` and ``--csv``.
    plot : path, optional
        ``--plot``; drawn first, so that nothing is printed when it cannot be.
    """
    if answer.figure is None:
        plot = None  # what there is to say says why there is nothing to draw
    if plot is not None and answer.figure is not None:
        from cardan.figures import save

        save(answer.figure(), plot)
    if json:
        drawn = {} if plot is None else {"plot": str(plot)}
        content = {"answer": answer.sentence, **answer.content(), **drawn, "exit_code": answer.code}
        print_text(as_json(content) + "\n")
    elif csv and answer.csv is not None:
        print_lines(as_csv(answer.csv()))
    else:
        _write_text(answer, plot)
    return answer.code


def check_common(*, json: bool, csv: bool, plot: Path | None = None) -> None:
    """Refuse common options that contradict each other or that cannot be met, before any work is done."""
    if json and csv:
        raise refuse("--csv", _("choose --json or --csv, not both"))
    if plot is not None:
        from .output import check_figure_target

        check_figure_target(plot)


def as_json(content: Any) -> str:
    """Return JSON in full precision, lists of numbers on one line; what is not a finite number is null."""
    return _indented(simple(content), "")


def _indented(value: Any, margin: str) -> str:
    import json

    inner = margin + "  "
    if isinstance(value, dict) and value:
        ends, parts = (
            "{}",
            [f"{json.dumps(key, ensure_ascii=False)}: {_indented(v, inner)}" for key, v in value.items()],
        )
    elif isinstance(value, list) and any(isinstance(item, dict | list) for item in value):
        ends, parts = "[]", [_indented(item, inner) for item in value]
    else:
        return json.dumps(value, ensure_ascii=False, allow_nan=False)
    return ends[0] + "\n" + ",\n".join(inner + part for part in parts) + "\n" + margin + ends[1]


def simple(value: Any) -> Any:
    """Return arrays, tuples and numbers as what JSON knows.

    Examples
    --------
    >>> simple({"a": (1.0, float("nan"))})
    {'a': [1.0, None]}
    """
    if isinstance(value, dict):
        return {str(key): simple(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return [simple(item) for item in value]
    if isinstance(value, complex):
        return [simple(value.real), simple(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if value is None or isinstance(value, str | bool | int | float):
        return value
    return str(value)


def records(table: Table, names: Sequence[tuple[int, str]]) -> list[dict[str, Cell]]:
    """Return the rows of a table by the keys of its columns, number and name instead of the first one."""
    keys = [column.key for column in table.columns[1:]]
    return [
        {"number": number, "name": name, **dict(zip(keys, row[1:], strict=True))}
        for (number, name), row in zip(names, table.rows, strict=True)
    ]


def as_csv(table: Table) -> Iterator[str]:
    """Yield the lines of a table as CSV in full precision."""
    import csv
    import io

    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow([column.key for column in table.columns])
    for row in table.rows:
        writer.writerow(["" if value is None or value != value else value for value in row])
        if buffer.tell() > 1 << 16:
            yield buffer.getvalue()
            buffer.seek(0)
            buffer.truncate()
    yield buffer.getvalue()


def print_text(text: str) -> None:
    """Write to standard output."""
    print_lines((text,))


def print_lines(texts: Iterable[str]) -> None:
    """Write piece by piece to standard output."""
    for text in texts:
        sys.stdout.write(text)
    sys.stdout.flush()


def _write_text(answer: Answer, plot: Path | None) -> None:
    from shlex import join

    from rich.console import Console
    from rich.text import Text

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=False)
    sign, colour = SIGNS[answer.tone]
    wide = min(console.width, WIDEST)
    first = _filled(f"{sign} {answer.sentence}".strip(), wide)
    console.print(Text(first, style=f"bold {colour}".strip()), soft_wrap=True)
    for table in answer.tables():
        console.print()
        _print_table(console, table)
    remarks = list(answer.remarks)
    if plot is not None:
        remarks.append(Remark(text=_("Figure drawn: {path}").format(path=plot)))
    if remarks:
        console.print()
    for remark in remarks:
        mark, tint = SIGNS[remark.tone]
        said = _filled(f"{mark} {remark.text}".strip(), wide)
        line = Text(said, style=tint if remark.tone in ("failed", "warning") else "")
        line.stylize(tint, 0, len(mark))
        console.print(line, soft_wrap=True)
        if remark.command:
            console.print(Text(f"    {join(remark.command)}", style=tint), soft_wrap=True)
    sys.stdout.flush()


def _filled(text: str, width: int) -> str:
    """Return a text in lines; a number, thin blanks within it, and its unit stay together.

    Examples
    --------
    >>> _filled("shaft 2 carries 60.0 ± 173 N·m", 26).splitlines()
    ['shaft 2 carries 60.0', '± 173 N·m']
    """
    import re
    from textwrap import fill

    held = re.sub(rf"(?<=[\d±]) (?=\d|(?:{UNITS})(?![\w/]))", "\u00a0", text)
    return fill(held, width, break_on_hyphens=False, break_long_words=False).replace("\u00a0", " ")


def _print_table(console: Console, table: Table) -> None:
    from textwrap import wrap

    from rich.text import Text

    if table.title:
        console.print(Text(table.title, style="bold"))
    columns = table.columns
    cells = [[printed(value, column.form) for value, column in zip(row, columns, strict=True)] for row in table.rows]
    headings = [[column.heading for column in columns], [spoken(column.unit) for column in columns]]
    widths = [max(len(row[k]) for row in headings + cells) for k in range(len(columns))]
    if columns[-1].wrap:
        widths[-1] = min(widths[-1], max(NARROWEST, console.width - GAP - sum(GAP + width for width in widths[:-1])))
    for place, block in enumerate(_blocks(widths, table.fixed, console.width)):
        if place:
            console.print()
        for row in headings:
            if any(row):
                console.print(Text(_line(row, widths, columns, block), style="dim"), soft_wrap=True)
        for number, row in enumerate(cells):
            tint = SIGNS[table.tones[number]][1] if table.tones else ""
            parts = wrap(row[-1], widths[-1]) if columns[-1].wrap and len(columns) - 1 in block else []
            for k, part in enumerate(parts or row[-1:]):
                line = [*row[:-1], part] if k == 0 else [*[""] * (len(row) - 1), part]
                printed_line = Text(_line(line, widths, columns, block))
                printed_line.stylize(tint, 0, GAP + widths[0])
                console.print(printed_line, soft_wrap=True)


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


def _line(cells: Sequence[str], widths: Sequence[int], columns: Sequence[Column], block: Sequence[int]) -> str:
    parts = [cells[k].ljust(widths[k]) if columns[k].left else cells[k].rjust(widths[k]) for k in block]
    return (" " * GAP + (" " * GAP).join(parts)).rstrip()


__all__ = ["Cell", "as_csv", "as_json", "check_common", "show", "simple"]
