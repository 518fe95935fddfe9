"""Sheets as they are printed: what belongs together stays on a page, words have room, nothing is lost at an edge."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from cardan.figures.figure import Curve, Figure, Panel, Row
from cardan.report.block import Block, Cell, Column, Page, Picture, Points, Table, Words, number, words
from cardan.report.content import Excerpt
from cardan.report.render.sheet import LINE, PAPER, headed
from cardan.report.render.workbook import excerpt

from .test_workbook import opened

SENTENCE = "Words across the page, a line or two of them so that there is something to be wrapped, and to be kept."


def sheet_of(*blocks: Block) -> Any:
    """Return the sheet of a page."""
    page = Page(name="one", title="one", answer="An answer.", blocks=blocks)
    return opened(excerpt(Excerpt(title="one", page=page))).worksheets[0]


def long_table(rows: int, title: str = "a table") -> Table:
    columns = (Column(heading="what", left=True), Column(heading="value", unit="mm"))
    return Table(
        title=title, columns=columns, rows=[[words(f"row {k}"), number(f"{k}.5", k + 0.5)] for k in range(rows)]
    )


def printed(sheet: Any) -> list[range]:
    """Return the rows of each printed page."""
    ends = [0, *sorted(one.id for one in sheet.row_breaks.brk), sheet.max_row]
    return [range(first + 1, last + 1) for first, last in pairwise(ends)]


def pixels(sheet: Any, rows: Sequence[int]) -> float:
    return sum((sheet.row_dimensions[row].height or 15.0) * 96.0 / 72.0 for row in rows)


def curve() -> Picture:
    panel = Panel(series=(Curve(x=np.arange(3.0), y=np.arange(3.0), label="one"),))
    return Picture(
        figure=Figure(name="f", title="a figure", sentence=SENTENCE, source="", rows=(Row(panels=(panel,)),))
    )


@pytest.mark.parametrize("above", range(0, 40, 3))
def test_no_printed_page_ends_with_a_heading_or_is_too_long(above: int) -> None:
    sheet = sheet_of(
        Points(title="above", items=["x"] * above), long_table(40), curve(), Words(title="last", text=SENTENCE)
    )
    pages = printed(sheet)
    assert len(pages) > 1
    for rows in pages:
        assert pixels(sheet, rows) <= PAPER[1] + LINE
        end = [sheet.cell(row, 1).value for row in rows if sheet.cell(row, 1).value is not None][-1]
        assert end not in ("above", "a table", "what", "a figure", "last")
    (chart,) = sheet._charts
    first, last = chart.anchor._from.row + 1, chart.anchor.to.row + 1
    assert any(first in rows and last in rows for rows in pages)


def test_every_row_tells_its_height() -> None:
    sheet = sheet_of(long_table(3), curve(), Words(text=SENTENCE))
    heights = [sheet.row_dimensions[row].height for row in range(1, sheet.max_row + 1)]
    assert None not in heights
    assert min(heights) >= 15.75


def test_words_at_the_end_of_a_table_lie_across_free_columns() -> None:
    wide = Table(columns=[Column(heading=f"c{k}") for k in range(9)], rows=[[number("1", 1.0)] * 9])
    keys = "joints[0].cross.span_mm, joints[0].cross.journal_mm, joints[0].needles.count, duty.life_h"
    lacking = Table(
        columns=(Column(heading="what", left=True), Column(heading="key", left=True)),
        rows=[[words("life"), words(keys)]],
    )
    passed = Table(
        columns=(Column(heading="what", left=True), Column(heading="verdict", left=True)),
        rows=[[words("life"), Cell(text="passed", tone="good")]],
    )
    sheet = sheet_of(wide, lacking, passed)
    row = next(row for row in range(1, sheet.max_row + 1) if sheet.cell(row, 2).value == keys)
    merged = {(one.min_row, one.min_col) for one in sheet.merged_cells.ranges if one.max_col > 5}
    assert {(row, 2), (row - 1, 2)} <= merged
    assert sheet.row_dimensions[row].height == pytest.approx(15.75)
    assert sheet.column_dimensions["B"].width < 20
    assert not any(sheet.cell(top, left).value in ("✓ passed", "verdict") for top, left in merged)


def test_long_headings_take_three_lines_at_most() -> None:
    column = Column(heading="greatest load of a journal of the joint behind it", unit="N")
    sheet = sheet_of(Table(columns=[column], rows=[[number("1", 1.0)]]))
    row = next(row for row in range(1, sheet.max_row + 1) if sheet.cell(row, 1).value == headed(column))
    assert sheet.row_dimensions[row].height <= 0.75 * (3 * LINE + 2)


def test_the_colour_of_a_shaft_does_not_touch_its_number() -> None:
    table = Table(columns=[Column(heading="shaft", left=True)], rows=[[Cell(text="2 tube", chip="#0072b2")]])
    sheet = sheet_of(table)
    (cell,) = [row[0] for row in sheet.iter_rows() if row[0].value == "2 tube"]
    assert cell.border.left.style == "thick"
    assert cell.alignment.indent == 1


def test_a_tall_figure_stays_on_the_page_of_its_title_with_its_words() -> None:
    panel = Panel(series=(Curve(x=np.arange(3.0), y=np.arange(3.0)),))
    rows = (Row(panels=(panel,), height=20.0),)
    sheet = sheet_of(Picture(figure=Figure(name="f", title="tall", sentence=SENTENCE, source="source", rows=rows)))
    assert [one.id for one in sheet.row_breaks.brk] == []
    assert pixels(sheet, range(1, sheet.max_row + 1)) <= PAPER[1]


def test_rows_are_as_high_as_their_words_and_no_higher() -> None:
    columns = [Column(heading="phase angle ψ", unit="°"), Column(heading="torque", unit="± N·m")]
    sheet = sheet_of(Table(columns=columns, rows=[[number("1", 1.0)] * 2]))
    row = next(row for row in range(1, sheet.max_row + 1) if sheet.cell(row, 1).value == "phase angle ψ [°]")
    assert sheet.row_dimensions[row].height == pytest.approx(0.75 * (2 * LINE + 2))
    assert sheet.cell(row, 2).value == "torque [±\u00a0N·m]"


def test_two_charts_of_a_figure_stand_on_a_page() -> None:
    panel = Panel(series=(Curve(x=np.arange(3.0), y=np.arange(3.0), label="one"),))
    rows = (Row(panels=(panel,), height=1.5),) * 3
    sheet = sheet_of(Picture(figure=Figure(name="f", title="a figure", sentence=SENTENCE, source="", rows=rows)))
    assert [
        len([k for k in page if k - 1 in {one.anchor._from.row for one in sheet._charts}]) for page in printed(sheet)
    ] == [2, 1]
