"""A folder that no name leads out of."""

from __future__ import annotations

from pathlib import Path

import pytest

from cardan.errors import InputError
from cardan.files import Enclosed
from cardan.io import loads

MOVED = """format = 1
input.point_mm = [-300, 0, 0]
output.point_mm = [1900, 40, -260]
[[joints]]
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [1200, 0, -160]
[[movements]]
kind = "table"
moves = ["joints[1]"]
file = "{name}"
"""


@pytest.mark.parametrize("name", ["../secret.csv", "/etc/passwd", "inner/../../secret.csv", "link.csv"])
def test_no_name_leads_out_of_an_enclosed_folder(tmp_path: Path, name: str) -> None:
    (tmp_path / "secret.csv").write_text("the secret")
    inner = tmp_path / "drives"
    inner.mkdir()
    (inner / "link.csv").symlink_to(tmp_path / "secret.csv")
    with pytest.raises(InputError, match="leads out of the folder") as caught:
        loads(MOVED.format(name=name), folder=Enclosed(inner))
    assert "the secret" not in str(caught.value)


def test_catalogues_are_enclosed_too(tmp_path: Path) -> None:
    text = 'format = 1\nsettings.catalogues = ["../own.toml"]\n[[joints]]\njoint_angle_deg = 20\n'
    with pytest.raises(InputError, match="leads out of the folder"):
        loads(text, folder=Enclosed(tmp_path))


def test_files_inside_are_read(tmp_path: Path) -> None:
    rows = ["time_s,x_mm,y_mm,z_mm", *(f"{k / 10},0,{k},0" for k in range(8))]
    (tmp_path / "moves.csv").write_text("\n".join(rows))
    assert loads(MOVED.format(name="moves.csv"), folder=Enclosed(tmp_path)).movements
