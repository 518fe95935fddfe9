"""report --client, --logo and the other options of the title block: they win over the drive file."""

from dataclasses import replace

import matplotlib.image
import numpy as np
import pytest

from cardan.drive.settings import TitleBlock
from cardan.io import dumps, example
from tests.cli.conftest import EXAMPLES


def test_options_of_the_command_win_over_the_file(cardan, tmp_path):
    matplotlib.image.imsave(tmp_path / "logo.png", np.zeros((30, 90, 3)))
    report = TitleBlock(client="Axle & Co", author="design office", logo="not-there.svg")
    (tmp_path / "drive.toml").write_text(dumps(replace(example("z-arrangement"), report=report)))
    more = ("--author", "C. Meier", "--logo", tmp_path / "logo.png")
    assert cardan("report", tmp_path / "drive.toml", "-o", tmp_path / "report.html", *more).code == 0
    text = (tmp_path / "report.html").read_text()
    assert "<dd>C. Meier</dd>" in text
    assert "<dd>design office</dd>" not in text
    assert "Axle &amp; Co" in text
    assert 'src="data:image/png;base64,' in text


def test_a_wrong_logo_ends_the_command_before_any_work(cardan, tmp_path):
    (tmp_path / "drive.toml").write_text(dumps(example("z-arrangement")))
    done = cardan("report", tmp_path / "drive.toml", "-o", tmp_path / "x.html", "--logo", tmp_path / "none.png")
    assert done.code == 2
    assert "none.png cannot be read" in done.err
    assert not (tmp_path / "x.html").exists()


@pytest.mark.slow
def test_several_drives_stand_side_by_side(cardan, tmp_path):
    files, place = [EXAMPLES / f"{name}.toml" for name in ("unstable-drive", "cured-drive")], tmp_path / "two.html"
    ran = cardan("report", *files, "-o", place)
    assert ran.code == 0
    assert "cured-drive: fewest limits are not kept, 1. The others: unstable-drive 2." in " ".join(ran.out.split())
    page = place.read_text("utf8")
    for words in ("unstable-drive", "cured-drive", "limits not kept", "What differs in the files"):
        assert words in page, words


def test_what_is_said_of_one_drive_is_refused_for_several(cardan, tmp_path):
    file = EXAMPLES / "cured-drive.toml"
    refused = cardan(
        "report", file, EXAMPLES / "unstable-drive.toml", "--full", "--client", "Mill", "-o", tmp_path / "a.html"
    )
    assert refused.code == 2
    assert "--full: is for the report of one drive" in refused.err
    assert "--client: is for the report of one drive" in refused.err
    assert "is given twice" in cardan("report", file, file, "-o", tmp_path / "a.html").err
    assert not (tmp_path / "a.html").exists()
