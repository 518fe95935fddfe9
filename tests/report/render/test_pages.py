"""Paper: so many pages and no more, none of them mostly empty, nothing lost behind ``--full``."""

import io
from functools import cache

import numpy as np
import pytest
from PIL import Image

from cardan.io import example
from cardan.report.answers import answered, subject
from cardan.report.block import Picture, Table
from cardan.report.content import content
from cardan.report.render import typeset
from cardan.texts import speaking
from tests.builders.reports import content_of

TWO_PIECE = ("car-propshaft", "truck-supports", "truck-duty-cycle", "pickup-two-piece")

PPI = 24  # dots per inch: a line of words is three dots high
INK = 200  # what is darker than this is ink
TOP, BOTTOM, HEIGHT = 20.0, 16.0, 297.0  # margins and height of the paper [mm]


CODES = ("en", "ru")


@cache
def sheets(name, code):
    """Return pictures of the pages of a report."""
    with speaking(code):
        made = typeset.compiler(typeset.as_data(content_of(name, language=code)))
    return made.compile(format="png", ppi=PPI)


def empty(sheet):
    """Return which share of a page lies empty below its last line."""
    rows = np.flatnonzero((np.asarray(Image.open(io.BytesIO(sheet)).convert("L")) < INK).any(axis=1))
    used = HEIGHT * (rows[-1] + 1) / Image.open(io.BytesIO(sheet)).height - TOP
    return 1.0 - used / (HEIGHT - TOP - BOTTOM)


def test_how_empty_a_page_is_is_measured_in_ink():
    paper = Image.new("L", (210, 297), 255)
    paper.putpixel((100, 149), 0)
    stream = io.BytesIO()
    paper.save(stream, "png")
    assert empty(stream.getvalue()) == pytest.approx(1.0 - 130.0 / 261.0)


@pytest.mark.slow
@pytest.mark.parametrize("name", TWO_PIECE)
@pytest.mark.parametrize("code", CODES)
def test_a_shaft_in_one_or_two_pieces_takes_eight_pages(name, code):
    assert len(sheets(name, code)) <= 8


@pytest.mark.slow
@pytest.mark.parametrize("name", [*TWO_PIECE, "mill-spindle", "pto-drive"])
@pytest.mark.parametrize("code", CODES)
def test_no_page_is_a_third_empty(name, code):
    assert [k for k, sheet in enumerate(sheets(name, code), start=1) if empty(sheet) > 1 / 3] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", TWO_PIECE)
def test_no_column_of_a_table_holds_nothing(name):
    tables = [one for page in content_of(name).pages for one in page.blocks if isinstance(one, Table) and one.rows]
    empty = [
        (one.title, column.heading)
        for one in tables
        for k, column in enumerate(one.columns)
        if k and all(row[k].text == "–" for row in one.rows)
    ]
    assert empty == []


@pytest.mark.slow
def test_what_a_report_leaves_out_stands_behind_full():
    on = subject(example("truck-supports"))
    pages = {page.name: page for page in content(on.drive, full=True).pages}
    for name in ("motion", "phasing", "forces", "losses", "bending", "line", "balance", "strength", "check"):
        short = next(page for page in content_of("truck-supports").pages if page.name == name)
        figures, every, whole = (
            [one.figure.name for one in page.blocks if isinstance(one, Picture)]
            for page in (short, pages[name], answered(name, on))
        )
        assert set(figures) <= set(every) == set(whole)
        assert len(short.blocks) <= len(pages[name].blocks)
