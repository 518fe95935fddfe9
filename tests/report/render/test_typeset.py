"""The report as PDF: complete, with the words and numbers of the HTML report, and no user's words taken for code."""

import dataclasses
import io
import re
from functools import cache
from html.parser import HTMLParser

import pypdf
import pytest

from cardan.drive.drive import Drive
from cardan.errors import InputError, MissingExtraError
from cardan.figures.figure import Figure
from cardan.io import example
from cardan.report.block import Cell, Column, Listing, Page, Picture, Points, Table, Words
from cardan.report.content import Content, content
from cardan.report.render import html, renderer, typeset
from cardan.report.report import report
from cardan.texts import speaking
from tests.builders.reports import content_of

NAMES = ("pto-hitch", "tracta-steered-axle")

BLANK = Figure(name="blank", title="Nothing", sentence="Nothing is seen.", source="", rows=())

NASTY = (
    '#panic("x")',
    "$",
    "*a*",
    "\\",
    "]",
    "#{sys.inputs}",
    "<summary>",
    "@a",
    "/* b",
    "`c`",
    "= d",
    "$ x",
    "_e_ ~ -- '",
)


class Cells(HTMLParser):
    """The text of every cell of a page's tables, without the signs before it."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.cells: list[str] = []
        self.within = self.sign = False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        if tag == "td":
            self.cells.append("")
            self.within = True
        self.sign = tag == "span"

    def handle_endtag(self, tag):
        self.within = self.within and tag != "td"
        self.sign = False

    def handle_data(self, data):
        if self.within and not self.sign:
            self.cells[-1] += data


def without_pictures(said: Content) -> Content:
    """Return the same without what takes a reader of PDF files long and says nothing in words."""
    pages, appendix = (
        tuple(
            dataclasses.replace(page, blocks=[one for one in page.blocks if not isinstance(one, Picture)])
            for page in pages
        )
        for pages in (said.pages, said.appendix)
    )
    return dataclasses.replace(said, sketch=BLANK, pages=pages, appendix=appendix)


@cache
def of_example(name: str) -> Content:
    return without_pictures(content_of(name, full=True))


@cache
def opened(name: str) -> pypdf.PdfReader:
    return pypdf.PdfReader(io.BytesIO(typeset.written(of_example(name))))


@cache
def words_of(name: str) -> str:
    return words(opened(name))


def words(pdf: pypdf.PdfReader) -> str:
    """Return everything a PDF says, without spaces: where lines end is no matter here."""
    return close("".join(page.extract_text() for page in pdf.pages))


def close(text: str) -> str:
    return re.sub(r"\s", "", text).replace("\u00ad", "")


def set_with(said: Content, **other) -> pypdf.PdfReader:
    return pypdf.PdfReader(io.BytesIO(typeset.written(dataclasses.replace(said, **other))))


def page_of(*blocks) -> Page:
    return Page(name="blocks", title="Blocks", answer="All kinds.", blocks=blocks)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_pdf_says_what_the_html_report_says(name):
    said, seen = of_example(name), words_of(name)
    assert len(opened(name).pages) > 3
    assert close(said.judgement.text) in seen
    assert all(close(warning.text) in seen for warning in said.warnings)
    for page in (*said.pages, *said.appendix):
        assert close(page.title) in seen
        assert close(page.answer) in seen
        for block in page.blocks:
            if isinstance(block, Points):
                assert all(close(one) in seen for one in block.items)
    formulas = {
        cell.text for page in (*said.pages, *said.appendix) for block in page.blocks if isinstance(block, Table)
        for row in block.rows for cell in row if cell.formula
    }  # fmt: skip
    cells = [cell for cell in Cells(html.text(said)).cells if cell not in formulas]
    assert len(cells) > 60
    assert [cell for cell in cells if close(cell) not in seen] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_page_is_found_by_its_bookmark_and_in_the_contents(name):
    pdf, said = opened(name), of_example(name)
    marks = [mark for mark in pdf.outline if not isinstance(mark, list)]
    numbered = [re.fullmatch(r"(?:(\d+|[A-F])\s+)?(.*)", mark.title).groups("") for mark in marks]
    titles = [title for _number, title in numbered]
    assert titles == ["Summary", *(one.title for one in said.pages), "Appendix", *(one.title for one in said.appendix)]
    first = close(pdf.pages[0].extract_text())
    count = 1 + len(said.pages)
    assert [number for number, _title in numbered] == [
        *map(str, range(1, count + 1)),
        "",
        *"ABCDEF"[: len(said.appendix)],
    ]
    for mark, (number, title) in zip(marks, numbered, strict=True):
        page = pdf.get_destination_page_number(mark) + 1
        assert close(f"{number}{title}{page}") in first


@pytest.mark.slow
def test_the_file_tells_what_it_is_and_can_be_read_aloud():
    pdf = opened("pto-hitch")
    root = pdf.trailer["/Root"]
    assert pdf.metadata.title == of_example("pto-hitch").title
    assert pdf.metadata.subject == of_example("pto-hitch").judgement.text
    assert pdf.metadata.creation_date_raw[2:10] == of_example("pto-hitch").date.replace("-", "")
    assert root["/Lang"].startswith("en")
    assert root["/MarkInfo"]["/Marked"]
    assert "/StructTreeRoot" in root
    assert b"pdfuaid" in root["/Metadata"].get_data()


@pytest.mark.slow
def test_running_heads_and_heads_of_tables_stand_on_every_page():
    said, pdf = of_example("pto-hitch"), opened("pto-hitch")
    for k, page in enumerate(pdf.pages[1:], start=2):
        seen = close(page.extract_text())
        assert seen.startswith(close(said.title) + f"{k}/{len(pdf.pages)}")
    rows = [[Cell(text=f"row {k} here"), Cell(text=str(k))] for k in range(170)]
    table = Table(
        title="Long", columns=[Column(heading="what", left=True), Column(heading="much", unit="N·m")], rows=rows
    )
    long = set_with(said, pages=(page_of(table),))
    heads = [page for page in long.pages if re.search(r"row\d+here", close(page.extract_text()))]
    assert len(heads) > 2
    assert all(close(page.extract_text()).count("much[N·m]") == 1 for page in heads)


@pytest.mark.slow
def test_a_table_that_is_too_wide_lies_down_and_one_wider_still_is_parted():
    def wide(count):
        columns = [Column(heading="setting", left=True), *(Column(heading=f"shaft {k}") for k in range(count))]
        row = [Cell(text="A"), *(Cell(text=f"{1000 + k}.25") for k in range(count))]
        return Table(title="Wide", columns=columns, rows=[row] * 3, note="so much")

    shapes = {}
    for count in (8, 20, 60):
        pdf = set_with(of_example("pto-hitch"), pages=(page_of(wide(count)),))
        shapes[count] = sum(page.mediabox.width > page.mediabox.height for page in pdf.pages)
        seen = words(pdf)
        assert all(f"{1000 + k}.25" in seen for k in range(count))
        assert ("Wide,1/" in seen) == (count == 60)
        assert seen.count("somuch") == 1
    assert shapes[8] == 0
    assert min(shapes[20], shapes[60]) > 0


@pytest.mark.slow
def test_words_of_the_user_are_never_code():
    joints = example("two-piece-rear-drive").joints
    named = tuple(dataclasses.replace(one, name=name) for one, name in zip(joints, NASTY, strict=False))
    drive = dataclasses.replace(
        example("two-piece-rear-drive"), name=" ".join(NASTY), note="\n".join(NASTY), joints=named
    )
    said = content(drive, source_text="\n".join(NASTY) + "\n```#panic()", full=True)
    cells = [[Cell(text=one), Cell(text=one, tone="failed")] for one in NASTY]
    table = Table(
        title=NASTY[0], columns=[Column(heading=NASTY[0], left=True), Column(heading="$", unit="*")], rows=cells
    )
    blocks = (
        table,
        Words(text=" ".join(NASTY), title=NASTY[0]),
        Points(title=NASTY[0], items=NASTY),
        Listing(title=NASTY[0], text=NASTY[0]),
    )
    said = without_pictures(said)
    pdf = set_with(said, pages=(*said.pages, page_of(*blocks)))
    seen = words(pdf)
    assert pdf.metadata.title == " ".join(NASTY)
    assert seen.count(close(" ".join(NASTY))) >= 4
    assert all(seen.count(close(one)) >= 5 for one in NASTY)
    assert "```#panic()" in seen


@pytest.mark.slow
@pytest.mark.parametrize("name", ["小车 🚗", "\x00\x07a\ufeff\ud800", "x" * 2000, "   ", "שלום", "a\nb\tc"])
def test_no_name_keeps_a_report_from_being_written(name):
    pdf = set_with(of_example("pto-hitch"), title=name, note=name, pages=(page_of(Words(text=name, tone="failed")),))
    assert pdf.metadata.title.strip()


@pytest.mark.slow
def test_nothing_stands_beyond_the_paper():
    blocks = (
        Words(text="x" * 300),
        Listing(title="file", text="key = " + "y" * 300),
        Table(columns=[Column(heading="k", left=True)] * 2, rows=[[Cell(text="a_b[1]." * 30), Cell(text="w" * 300)]]),
    )
    pdf = set_with(of_example("pto-hitch"), pages=(page_of(*blocks),))
    places: list[tuple[float, float]] = []

    def placed(text, _matrix, at, _font, _size):
        if text.strip():
            places.append((at[4], at[5]))

    for page in pdf.pages:
        page.extract_text(visitor_text=placed)
    seen = words(pdf)
    assert all(one in seen for one in ("x" * 300, "y" * 300, "w" * 300, "a_b[1]." * 30))
    assert all(0.0 <= x <= 596.0 and 0.0 <= y <= 842.0 for x, y in places)


@pytest.mark.slow
def test_a_russian_report_is_russian():
    with speaking("ru"):
        said = content(example("single-20deg"))
        said = dataclasses.replace(said, pages=said.pages[:1])
        pdf = pypdf.PdfReader(io.BytesIO(typeset.written(said)))
    assert pdf.trailer["/Root"]["/Lang"].startswith("ru")
    seen = words(pdf)
    assert len(re.findall("[а-яё]", seen)) > 100
    assert "Рис.1" in seen
    assert "Таблица1" in seen


@pytest.mark.slow
def test_it_is_written_whole_or_not_at_all(tmp_path):
    drive = Drive.from_angles([0.2])
    told: list[float] = []
    assert report(drive, None, tmp_path / "one.PDF", progress=told.append).read_bytes().startswith(b"%PDF")
    assert told == sorted(told)
    assert told[-1] == 1.0
    with pytest.raises(InputError, match="cannot be written"):
        report(drive, None, tmp_path / "no" / "r.pdf")
    with pytest.raises(InputError, match=r"figures to point at; only reports in \.html, \.htm can"):
        report(drive, None, tmp_path / "r.pdf", interactive=True)
    assert [path.name for path in tmp_path.iterdir()] == ["one.PDF"]


def test_without_its_extra_one_message_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr(renderer, "find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install 'cardan\[pdf\]'"):
        report(Drive.from_angles([0.2]), None, tmp_path / "r.pdf")
    assert list(tmp_path.iterdir()) == []
