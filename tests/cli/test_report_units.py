"""report --unit and --decimal: the same report in a reader's units."""

import html
import re

from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-printed-coordinates.toml"


def told(path):
    """Return what a page says, but for the drive file at its end and for the drawings."""
    text = re.sub(r"<(pre|svg|style|script).*?</\1>", "", path.read_text(), flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]+>", " ", text))


def test_lengths_are_told_in_the_unit_asked_for(cardan, tmp_path):
    assert cardan("report", TRUCK, "-o", "mm.html").code == 0
    assert cardan("report", TRUCK, "-o", "in.html", "--unit", "length=in", "--decimal", ",").code == 0
    usual, asked = told(tmp_path / "mm.html"), told(tmp_path / "in.html")
    assert re.search(r"\bmm\b", usual)
    assert not re.search(r"\bmm\b", asked)
    assert re.search(r"\bin\b", asked)
    assert re.search(r"\d,\d+ ", asked)
    assert "centre_mm" in (tmp_path / "in.html").read_text()  # the drive file as it stands


def test_what_is_no_unit_is_refused_before_any_work(cardan, tmp_path):
    done = cardan("report", TRUCK, "-o", "x.html", "--unit", "length=inn", "--unit", "colour=red", "--decimal", ";")
    assert done.code == 2
    assert "did you mean in?" in done.err
    assert "colour=red is not dimension=unit" in done.err
    assert "neither a point nor a comma" in done.err
    assert not (tmp_path / "x.html").exists()
