"""report --client, --logo and the other options of the title block: they win over the drive file."""

from dataclasses import replace

import matplotlib.image
import numpy as np

from cardan.drive.settings import TitleBlock
from cardan.io import dumps, example


def test_options_of_the_command_win_over_the_file(cardan, tmp_path):
    matplotlib.image.imsave(tmp_path / "logo.png", np.zeros((30, 90, 3)))
    report = TitleBlock(client="Muster & Co", author="A. Ivanova", logo="not-there.svg")
    (tmp_path / "drive.toml").write_text(dumps(replace(example("z-arrangement"), report=report)))
    more = ("--author", "C. Meier", "--logo", tmp_path / "logo.png")
    assert cardan("report", tmp_path / "drive.toml", "-o", tmp_path / "report.html", *more).code == 0
    text = (tmp_path / "report.html").read_text()
    assert "<dd>C. Meier</dd>" in text
    assert "<dd>A. Ivanova</dd>" not in text
    assert "Muster &amp; Co" in text
    assert 'src="data:image/png;base64,' in text


def test_a_wrong_logo_ends_the_command_before_any_work(cardan, tmp_path):
    (tmp_path / "drive.toml").write_text(dumps(example("z-arrangement")))
    done = cardan("report", tmp_path / "drive.toml", "-o", tmp_path / "x.html", "--logo", tmp_path / "none.png")
    assert done.code == 2
    assert "none.png cannot be read" in done.err
    assert not (tmp_path / "x.html").exists()
