"""report --unit and --decimal: the same report in a reader's units."""

import html
import re

import pytest

from tests.cli.conftest import EXAMPLES

KEY = re.compile(r"\w+\[?\d*\]?\.\w+_(mm|deg|rpm)\b")
"""A key of the drive file: its value stays in the unit that the key names."""

TRUCK = EXAMPLES / "truck-printed-coordinates.toml"


ROW = re.compile(r"<tr\b.*?</tr>", re.DOTALL)


def told(path):
    """Return what a page says, but for the drive file at its end, the drawings, and rows on keys that are typed."""
    text = re.sub(r"<(pre|svg|style|script).*?</\1>", "", path.read_text(), flags=re.DOTALL)
    text = ROW.sub(lambda row: "" if KEY.search(words(row[0])) else row[0], text)
    return words(text)


def words(text):
    return html.unescape(re.sub(r"<[^>]+>", " ", text))


@pytest.mark.slow
def test_lengths_are_told_in_the_unit_asked_for(cardan, tmp_path):
    assert cardan("report", TRUCK, "-o", "mm.html").code == 0
    assert cardan("report", TRUCK, "-o", "in.html", "--full", "--unit", "length=in", "--decimal", ",").code == 0
    usual, asked = told(tmp_path / "mm.html"), told(tmp_path / "in.html")
    assert re.search(r"\bmm\b", usual)
    assert not re.search(r"\bmm\b", asked)
    assert re.search(r"\bin\b", asked)
    assert re.search(r"\d,\d+ ", asked)
    page = (tmp_path / "in.html").read_text()
    assert "centre_mm" in page  # the drive file as it stands
    assert cardan("report", TRUCK, "-o", "rad.html", "--full", "--unit", "angle=rad", "--decimal", ",").code == 0
    page = (tmp_path / "rad.html").read_text()
    turned = [words(row) for row in ROW.findall(page) if "shaft 4: yoke angle" in words(row)]
    assert turned
    assert all(re.search(r"\s0 rad\s+−0,\d+ rad\s", row) for row in turned)
