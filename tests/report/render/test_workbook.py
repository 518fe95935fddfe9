"""The report as a workbook: every number of its tables, charts that find theirs, and words that stay words."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import openpyxl
import pytest
from openpyxl.utils import range_boundaries

from cardan.cli.main import main
from cardan.drive.drive import Drive
from cardan.figures.figure import Axis, Bars, Curve, Figure, Note, Panel, Row, Rule
from cardan.io import example, example_text
from cardan.io.workbook.book import sheet_name
from cardan.io.workbook.chart_data import BESIDE, HEAD, PRINTED
from cardan.io.workbook.charts import split
from cardan.report.block import Cell, Column, Page, Picture, Table, Words, number, words
from cardan.report.content import Content, content
from cardan.report.render import renderer
from cardan.report.render import sheet as paper
from cardan.report.render.sheet import headed
from cardan.report.render.workbook import written
from cardan.units import deg
from tests.builders.reports import content_of

NAMES = ["car-propshaft", "pto-hitch", "tracta-steered-axle"]
"""Many pages with bars and curves; movements; joints with laws of their own."""

CHART = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"

WRITTEN = re.compile(r"[≤≥<>≈±]?\s*(?P<number>[+−-]?(?:0|[1-9][\d\u202f]*)(?:\.\d+)?)(?:·10(?P<power>[⁻⁰¹²³⁴-⁹]+))?")

POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")

EVIL = (
    '=HYPERLINK("http://x.y","z")',
    "+1",
    "-2+3",
    "@SUM(A1)",
    "{=1}",
    "http://x.y/",
    "mailto:a@b.c",
    "a\x0bb",
    "=A1!B2",
)


@pytest.fixture(autouse=True, scope="module")
def small_pictures() -> Iterator[None]:
    """Draw pictures with few dots: they are not what is looked at here."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paper, "DPI", 15.0)
        yield


def said(name: str) -> Content:
    return content_of(name, full=True)


@cache
def file_of(name: str) -> bytes:
    return written(said(name))


@cache
def opened(data: bytes) -> Any:
    return openpyxl.load_workbook(io.BytesIO(data))


def parts(data: bytes, folder: str) -> dict[str, str]:
    with zipfile.ZipFile(io.BytesIO(data)) as held:
        names = [name for name in held.namelist() if name.startswith(folder) and not name.endswith(".png")]
        return {name: held.read(name).decode() for name in names}


def rows_below(sheet: Any, table: Table) -> Iterator[tuple[Any, ...]]:
    """Yield the rows of a sheet under the headings of a table."""
    heads = [headed(column) or None for column in table.columns]
    rows = list(sheet.iter_rows())
    for start, row in enumerate(rows):
        if [cell.value for cell in row[: len(heads)]] == heads and all(
            cell.value is None for cell in row[len(heads) :]
        ):
            following = rows[start + 1 : start + 1 + len(table.rows)]
            if holds(following, table):
                yield from following
                return
    pytest.fail(f"{sheet.title} lacks the table {table.title or heads}")


def holds(rows: list[Any], table: Table) -> bool:
    """Tell tables with the same headings apart by their first column."""
    return [row[0].value for row in rows] == [first(line[0]) for line in table.rows]


def first(cell: Cell) -> float | str | None:
    return cell.amount if cell.amount is not None else f"{cell.sign} {cell.text}".strip() or None


def read(text: str) -> float | None:
    """Return the number that a cell says as people write it; None where it says none."""
    found = WRITTEN.fullmatch(text)
    if found is None:
        return None
    whole = found["number"].replace("−", "-").replace("\u202f", "")
    return float(f"{whole}e{(found['power'] or '0').translate(POWERS)}")


def tables(told: Content) -> Iterator[tuple[int, Table]]:
    """Yield the tables of a report with the number of their sheet."""
    for table in (told.lights, told.remedies, told.figures, told.changes):
        if isinstance(table, Table):
            yield 0, table
    for k, page in enumerate((*told.pages, *told.appendix), start=1):
        yield from ((k, block) for block in page.blocks if isinstance(block, Table))


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_table_stands_there_with_its_numbers_in_full(name: str) -> None:
    book, seen = opened(file_of(name)), 0
    for k, table in tables(said(name)):
        for row, line in zip(rows_below(book.worksheets[k], table), table.rows, strict=True):
            for cell, wanted in zip(row, line, strict=False):
                if wanted.full:
                    seen += 1
                    assert cell.data_type == "n"
                    # Sixteen digits, as spreadsheets write them.
                    assert cell.value == pytest.approx(float(wanted.full), rel=1e-15, abs=0.0)
                elif wanted.amount is None:
                    assert (cell.value or "") == f"{wanted.sign} {wanted.text}".strip()
                if wanted.tone != "plain":
                    assert cell.fill.fill_type == "solid"
                    assert wanted.sign in f"{cell.value} {cell.number_format}"
    assert seen > 20


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_number_behind_a_cell_is_the_one_it_says(name: str) -> None:
    seen = 0
    for _k, table in tables(said(name)):
        for row in table.rows:
            for cell in row:
                text = read(cell.text)
                if text is not None and cell.full:
                    seen += 1  # a cell shows two digits at the least, or two behind the point
                    assert float(cell.full) == pytest.approx(text, rel=0.06, abs=0.0051), (table.title, row[0].text)
    assert seen > 10


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_words_of_every_page_stand_there(name: str) -> None:
    book, told = opened(file_of(name)), said(name)
    for k, page in enumerate((*told.pages, *told.appendix), start=1):
        sheet = book.worksheets[k]
        text = "\n".join(str(cell) for row in sheet.iter_rows(values_only=True) for cell in row if cell is not None)
        assert (page.title, page.answer) == (sheet.cell(1, 1).value, sheet.cell(2, 1).value or "")
        for block in page.blocks:
            assert not isinstance(block, Words) or block.text in text
            assert not isinstance(block, Picture) or block.figure.sentence in text
        pictures = [block.figure for block in page.blocks if isinstance(block, Picture)]
        assert len(sheet._charts) == sum(len(row.panels) for one in pictures for row in split(one)[0])
        assert len(sheet._images) == sum(split(one)[1] is not None for one in pictures)
    source = book[next(title for title in book.sheetnames if title == "Input file")]
    assert [row[0] or "" for row in source.iter_rows(min_row=2, values_only=True)] == example_text(name).splitlines()


def ranges(book: Any, chart: ElementTree.Element, kind: str) -> Iterator[tuple[list[Any], list[str | None]]]:
    """Yield the cells that the series of a chart refer to, and what the chart itself keeps of them."""
    for found in chart.iter(f"{CHART}{kind}"):
        place = next(found.iter(f"{CHART}f")).text or ""
        title, _mark, cells = place.rpartition("!")
        left, top, right, bottom = range_boundaries(cells.replace("$", ""))
        sheet = book[title.strip("'").replace("''", "'")]
        assert left == right
        assert bottom <= sheet.max_row
        yield (
            [sheet.cell(row, left).value for row in range(top, bottom + 1)],
            [one.text for one in found.iter(f"{CHART}v")],
        )


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_first_page_leads_to_every_other_with_its_answer(name: str) -> None:
    book, told = opened(file_of(name)), said(name)
    sheet = book["Summary"]
    assert "Key figures" in {cell.value for cell in sheet["A"]}
    rows = {cell.hyperlink.location: cell.row for cell in sheet["A"] if cell.hyperlink}
    for page, other in zip(told.pages, book.worksheets[1:], strict=False):
        row = rows[f"'{other.title}'!A1"]
        assert (sheet.cell(row, 1).value, sheet.cell(row, 2).value) == (page.title, page.answer)
        back = {cell.hyperlink.location for cell in other[3] if cell.hyperlink}  # above what scrolls
        data = [f"'{title}'!A1" for title in book.sheetnames if title == f"{other.title} data"]
        assert (back, other.freeze_panes) == ({"'Summary'!A1", *data}, "A4")


@pytest.mark.parametrize("name", NAMES)
def test_charts_find_their_numbers(name: str) -> None:
    data = file_of(name)
    book = opened(data)
    charts = parts(data, "xl/charts/chart")
    assert len(charts) > 2
    for text in charts.values():
        chart = ElementTree.fromstring(text)
        series = list(chart.iter(f"{CHART}ser"))
        across = [*ranges(book, chart, "xVal"), *ranges(book, chart, "cat")]
        upright = [*ranges(book, chart, "yVal"), *ranges(book, chart, "val")]
        assert len(series) == len(across) == len(upright) > 0
        for (at, _kept), (size, kept) in zip(across, upright, strict=True):
            assert len(at) == len(size)
            assert at[-1] is not None
            assert [float(one) for one in kept if one] == [value for value in size if value is not None]
        for one in series:
            ((name_cell,), _kept) = next(ranges(book, one, "tx"))
            assert name_cell


def test_a_chart_shows_the_curves_of_its_figure_in_their_colours() -> None:
    motion = next(
        block.figure
        for page in said("car-propshaft").pages
        for block in page.blocks
        if isinstance(block, Picture) and block.figure.name == "motion"
    )
    sheet = opened(file_of("car-propshaft"))["Motion data"]
    columns = [[cell.value for cell in column] for column in sheet.iter_cols()]
    panel = motion.panels[0]
    curves = [one for one in panel.series if isinstance(one, Curve)]
    for curve in curves:
        (found,) = [one for one in columns if one[4] == curve.label and one[6] == pytest.approx(float(curve.y[0]))][:1]
        np.testing.assert_allclose([one for one in found[6:] if one is not None], curve.y, rtol=1e-15)
    assert columns[0][2:6] == [motion.title, panel.y.label, motion.panels[-1].x.label, "[°]"]
    chart = parts(file_of("car-propshaft"), "xl/charts/chart1.xml")["xl/charts/chart1.xml"]
    assert panel.y.title in chart
    assert {"3B4252", "0072B2"} <= set(re.findall(r'srgbClr val="(\w+)"', chart))


def awkward() -> Content:
    """Return a report in which everything that a user may write would be a formula."""
    told = said("tracta-steered-axle")
    axis = Axis(label=EVIL[8], unit=EVIL[0], ticks=(0.0, 1.0), texts=("0", "1"))
    kinds = Axis(low=-0.5, high=len(EVIL) - 0.5, ticks=tuple(map(float, range(len(EVIL)))), texts=EVIL)
    rising = np.asarray([0.0, 1.0])
    curves = [Curve(x=rising, y=rising + k, label=text, text=text) for k, text in enumerate(EVIL)]
    marks = [Note(text=text, x=0.5, y=0.5) for text in EVIL] + [Rule(value=0.5, text=text) for text in EVIL]
    bars = Bars(at=np.arange(len(EVIL)), size=np.arange(1.0, len(EVIL) + 1.0), texts=EVIL, label=EVIL[0])
    panels = (
        Panel(series=(*curves, *marks), x=axis, y=axis, title=EVIL[0]),
        Panel(series=(bars,), x=kinds, y=axis, title=EVIL[8]),
    )
    figure = Figure(name="evil", title=EVIL[0], sentence=EVIL[1], source=EVIL[2], rows=(Row(panels=panels),))
    rows = [[words(text), Cell(text=text, tone="failed"), number("1.5", 1.5)] for text in EVIL]
    table = Table(
        columns=[Column(heading=text, left=True) for text in EVIL[:3]], rows=rows, title=EVIL[3], note=EVIL[4]
    )
    blocks = [Words(text=EVIL[0]), Words(text=EVIL[5], title=EVIL[6]), table, Picture(figure=figure)]
    page = Page(name="evil", title=EVIL[0], answer=EVIL[1], blocks=blocks)
    pages = (page, replace(page, title=EVIL[0].lower()))
    return replace(told, title=EVIL[0], note=EVIL[3], pages=pages, appendix=())


@pytest.mark.slow
def test_nothing_that_a_user_writes_becomes_a_formula_or_a_link() -> None:
    data = written(awkward())
    for text in parts(data, "xl/worksheets/sheet").values():
        assert "<f" not in text.replace("<fo", "")
    assert not any("External" in text for text in parts(data, "xl/worksheets/_rels").values())
    book = opened(data)
    held = {cell for sheet in book for row in sheet.iter_rows(values_only=True) for cell in row}
    assert {text.replace("\x0b", "\ufffd") for text in EVIL} <= held
    for text in parts(data, "").values():
        ElementTree.fromstring(text)
    charts = parts(data, "xl/charts/chart")
    assert len(charts) == 4
    for text in charts.values():
        for place in re.findall(r"<c:f>(.*?)</c:f>", text):
            title = place.rpartition("!")[0].strip("'")
            assert ElementTree.fromstring(f"<t>{title}</t>").text in book.sheetnames


@pytest.mark.slow
def test_a_drive_with_such_names_has_a_workbook() -> None:
    drive = example("front-halfshaft")
    shafts = tuple(replace(one, name=EVIL[0]) for one in drive.shafts)
    joints = tuple(replace(one, name=EVIL[5]) for one in drive.joints)
    named = replace(drive, name="=1+1 & [x]/*:?", note="@note", shafts=shafts, joints=joints)
    data = written(content(named))
    assert not any("<f>" in text for text in parts(data, "xl/worksheets/sheet").values())
    assert opened(data).worksheets[0]["A1"].value == named.name


@pytest.mark.slow
def test_sheets_are_named_in_any_language() -> None:
    told = said("car-propshaft")
    title = "Передаточное отношение: неравномерность / фазы [γ]"
    pages = tuple(replace(page, title=title) for page in told.pages[1:4])
    data = written(replace(told, pages=pages))
    book = opened(data)
    assert len(set(map(str.lower, book.sheetnames))) == len(book.sheetnames)
    assert all(0 < len(one) <= 31 and not set("[]:*?/\\") & set(one) for one in book.sheetnames)
    assert book.sheetnames[1] == "Передаточное отношение неравном"
    assert any(one.endswith(" data") for one in book.sheetnames)
    for text in parts(data, "xl/charts/chart").values():
        assert list(ranges(book, ElementTree.fromstring(text), "yVal")) or "barChart" in text


@pytest.mark.parametrize(
    ("wanted", "name"), [("", "-"), ("''", "-"), ("History", "History 2"), ("a" * 40, "a" * 31), ("😀" * 20, "😀" * 15)]
)
def test_names_of_sheets(wanted: str, name: str) -> None:
    assert sheet_name(wanted, set()) == name


@pytest.mark.slow
def test_what_is_not_a_number_is_a_word() -> None:
    cells = [number("∞", np.inf), number("–", np.nan), *(Cell(text=one) for one in ("1 … 2", "001.20", "12"))]
    table = Table(columns=[Column(heading="x")], rows=[[one] for one in cells])
    rising = np.asarray([0.0, np.nan, np.inf, 3.0])
    panel = Panel(series=(Curve(x=np.arange(4.0), y=rising),))
    figure = Figure(name="gap", title="gap", sentence="", source="", rows=(Row(panels=(panel,)),))
    page = Page(name="gap", title="gap", answer="", blocks=[table, Picture(figure=figure)])
    data = written(replace(said("tracta-steered-axle"), pages=(page,)))
    assert [row[0].value for row in rows_below(opened(data)["gap"], table)] == ["∞", "–", "1 … 2", "001.20", "12"]
    values = [row[1] for row in opened(data)["gap data"].iter_rows(min_row=7, values_only=True)]
    assert values == [0, None, None, 3]


@pytest.mark.slow
def test_the_same_report_gives_the_same_file_and_tells_nobody_who_made_it() -> None:
    told = said("tracta-steered-axle")
    first = written(told)
    assert first == written(told)
    core = parts(first, "docProps/core.xml")["docProps/core.xml"]
    assert "<dc:creator></dc:creator>" in core
    assert f"{told.date}T00:00:00Z" in core


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_sheets_are_ready_to_be_read_and_printed(name: str) -> None:
    for sheet in opened(file_of(name)):
        assert sheet.page_setup.orientation == "landscape"
        assert sheet.sheet_properties.pageSetUpPr.fitToPage
        assert sheet.freeze_panes
        data = sheet.title.endswith(" data")  # what is too much to be printed says so
        few = data and sheet.max_row <= HEAD + PRINTED and sheet.max_column <= BESIDE
        assert (sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight) in (
            (1, None if few else 0),
            (None, 1 if few else 0),
            (None, None),
        )
        assert bool(sheet.print_area) == (data and not few)
        assert not data or sheet["A2"].hyperlink.location == f"'{sheet.title.removesuffix(' data')}'!A1"
        assert said(name).title in sheet.oddHeader.left.text
        assert sheet.max_row > 1


@pytest.mark.slow
def test_pictures_have_a_size_of_their_own_and_the_shape_they_were_drawn_in() -> None:
    data = file_of("car-propshaft")
    drawing = "{http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing}"
    seen = 0
    for text in parts(data, "xl/drawings/drawing").values():
        for anchor in ElementTree.fromstring(text):
            assert (anchor.find(f"{drawing}pic") is not None) == (anchor.tag == f"{drawing}oneCellAnchor")
    for sheet in opened(data):
        for one in sheet._images:
            seen += 1
            assert one.anchor.ext.width / one.anchor.ext.height == pytest.approx(one.width / one.height, rel=0.01)
    assert seen > 3


@pytest.mark.slow
def test_a_drive_without_limits_or_curves_has_a_workbook() -> None:
    book = opened(written(content(Drive.from_angles([0.0, 20 * deg]))))
    assert book.sheetnames[0] == "Summary"


@pytest.mark.slow
def test_the_command_writes_a_workbook(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "drive.toml"
    file.write_text(example_text("single-20deg"), encoding="utf-8")
    assert main(["report", str(file), "-o", str(tmp_path / "x.xlsx")]) == 0
    assert openpyxl.load_workbook(tmp_path / "x.xlsx").sheetnames[0] == "Summary"
    assert main(["report", str(file), "-o", str(tmp_path / "x.xlsx"), "--interactive"]) == 2
    assert "cannot have figures to point at" in " ".join(capsys.readouterr().err.split())


def test_without_the_library_the_command_names_the_extra(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "drive.toml"
    file.write_text(example_text("single-20deg"), encoding="utf-8")
    monkeypatch.setattr(renderer, "find_spec", lambda name: None)
    assert main(["report", str(file), "-o", str(tmp_path / "x.xlsx")]) == 2
    assert "pip install 'cardan[xlsx]'" in " ".join(capsys.readouterr().err.split())
    assert [path.name for path in tmp_path.iterdir()] == ["drive.toml"]
