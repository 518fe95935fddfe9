"""The head of the report: client, drawing, author, logo, units, the same in every form."""

import base64
import io
from dataclasses import replace

import matplotlib.image
import numpy as np
import openpyxl
import pytest

from cardan.answers.reader import Reader, reading
from cardan.drive.settings import TitleBlock
from cardan.errors import InputError
from cardan.files import Enclosed
from cardan.io import dumps, example, loads
from cardan.report.content import content
from cardan.report.render import html, typeset, workbook
from cardan.report.title_block import LOGO_BYTES, LOGO_SIZE, logo_of, rows

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 60"><rect width="200" height="60" fill="#00f"/></svg>'
GIVEN = TitleBlock(client="Axle & Co", drawing_number="DS-4711", checked_by="calculation", logo="logo.svg")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("logos")
    (place / "logo.svg").write_text(SVG)
    matplotlib.image.imsave(place / "logo.png", np.zeros((900, 2400, 3)))
    return place


@pytest.fixture(scope="module")
def said(folder):
    return content(replace(example("z-arrangement"), report=GIVEN), folder=folder)


def test_the_table_is_read_and_written_as_every_other():
    drive = loads('format = 1\n[report]\nclient = "A"\nchecked_by = "B"\n[[joints]]\njoint_angle_deg = 20\n')
    assert drive.report == TitleBlock(client="A", checked_by="B")
    assert loads(dumps(drive)) == drive
    with pytest.raises(InputError, match=r"report\.date: must be a text, not 2026-11-22"):
        loads("format = 1\n[report]\ndate = 2026-11-22\n[[joints]]\njoint_angle_deg = 20\n")


def test_only_what_is_given_is_told_in_the_order_of_a_title_block():
    assert list(rows(GIVEN)) == [("Client", "Axle & Co"), ("Drawing number", "DS-4711"), ("Checked by", "calculation")]


@pytest.mark.slow
def test_html_shows_the_head_and_holds_the_logo_itself(said):
    text = html.text(said)
    assert "<dt>Client</dt><dd>Axle &amp; Co</dd>" in text
    assert f"data:image/svg+xml;base64,{base64.b64encode(SVG.encode()).decode()}" in text
    assert '<p class="units">Units: ' in text


@pytest.mark.slow
def test_pdf_shows_the_head(said):
    told = typeset.as_data(said)["head"]
    assert told["rows"][1] == ["Drawing number", "DS-4711"]
    assert bytes(told["logo"]["bytes"]).decode() == SVG
    assert len(typeset.written(said)) > len(typeset.written(replace(said, head=replace(said.head, logo=None))))


@pytest.mark.slow
def test_workbook_shows_the_head_and_a_drawing_as_pixels(said):
    sheet = openpyxl.load_workbook(io.BytesIO(workbook.written(said))).worksheets[0]
    words = [row[0].value for row in sheet.iter_rows(max_row=12)]
    assert "Checked by: calculation" in words
    assert said.head.units in words
    logo = matplotlib.image.imread(io.BytesIO(typeset.pixels_of(said.head.logo)))
    assert logo.shape[1] / logo.shape[0] == pytest.approx(200 / 60, rel=0.02)  # as drawn, to a pixel
    np.testing.assert_allclose(logo[10, 10, :3], (0, 0, 1), atol=0.01)


def test_units_are_those_of_the_reader_and_only_those_used():
    drive = example("z-arrangement")
    usual = content(drive).head.units
    assert "mm" in usual
    assert "N·m" not in usual
    with reading(Reader(units={"length": "in"})):
        told = content(drive).head.units.removeprefix("Units: ").split(", ")
    assert "in" in told
    assert "mm" not in told


@pytest.mark.slow
def test_a_large_logo_is_made_smaller(folder):
    logo = logo_of(TitleBlock(logo="logo.png"), folder)
    shape = matplotlib.image.imread(io.BytesIO(logo.content)).shape
    assert shape[:2] == (LOGO_SIZE[0] * 900 // 2400, LOGO_SIZE[0])


@pytest.mark.parametrize(
    ("name", "bytes_", "why"),
    [
        ("none.png", None, "none.png cannot be read: No such file"),
        ("words.png", b"no picture", "words.png is not a picture in PNG or SVG"),
        ("half.png", b"\x89PNG\r\n\x1a\n" + bytes(40), "half.png is not a picture"),
        ("wide.png", b"\x89PNG\r\n\x1a\n" + bytes(8) + b"\x00\x01\x00\x00" * 2, "has more than 40 million pixels"),
        ("flat.svg", SVG.replace("200 60", "200 0").encode(), "flat.svg is not a picture"),
        ("page.svg", b"<html></html>", "page.svg is not a picture"),
        ("long.png", bytes(LOGO_BYTES + 1), "long.png is larger than 5 MB"),
    ],
)
def test_a_wrong_logo_has_one_clear_message(tmp_path, name, bytes_, why):
    if bytes_ is not None:
        (tmp_path / name).write_bytes(bytes_)
    with pytest.raises(InputError, match=why) as caught:
        content(replace(example("z-arrangement"), report=TitleBlock(logo=name)), folder=tmp_path)
    assert [one.field for one in caught.value.problems] == ["report.logo"]


def test_a_logo_out_of_an_enclosed_folder_is_refused(folder, tmp_path):
    drive = replace(example("z-arrangement"), report=TitleBlock(logo=str(folder / "logo.svg")))
    with pytest.raises(InputError, match="leads out of the folder"):
        logo_of(drive.report, Enclosed(tmp_path))
