"""An edited file means the changed drive, and nothing else in it changes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from cardan import InputError
from cardan.drive.fields.paths import with_values
from cardan.io import example_names, example_text, loads
from cardan.io.edit import edit

FORMS = """format = 1
# above
[[joints]]
joint_angle_deg = 20 # first
[[joints]]
joint_angle_rad = 0.3 # second
plane_twist_deg = 3
"""

INLINE = """format = 1
joints = [{joint_angle_deg = 3}, {joint_angle_deg = 4}] # in one line
shafts = [{number = 2, yoke_angle_deg = 3}]
"""

SPREAD = """format = 1
input.point_mm = [-400, 0, 0]
output.point_mm = [1700, 0, -320]
[[joints]]
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [
  1300, # along
  0, # aside
  -320, # up
]
move_within_mm = [[1200, 1400], [0, 0], [-350, -300]]
"""


@pytest.mark.parametrize(
    ("text", "values"),
    [
        (FORMS, {"name": "new", "joints[1].joint_angle_deg": 11, "duty.speed_rpm": 10.5, "input.start_phase_deg": 3}),
        (FORMS, {"shafts[1].spline.teeth": 16, "shafts[1].yoke_lead_deg": 3, "shafts[0].length_mm": 70}),
        (FORMS, {"shafts[1].yoke_fixed": True, "shafts[1].name": "tube", "shafts[1].weight": 2}),
        (INLINE, {"joints[0].joint_angle_deg": 5, "shafts[1].spline.teeth": 7, "shafts[2].name": "x"}),
        (INLINE, {"shafts[1].yoke_lead_arcmin": 5}),
        (SPREAD, {"joints[1].centre_mm[0]": 1310, "joints[1].centre_mm[2]": -330}),
        (SPREAD, {"joints[1].centre_m[1]": 0.01, "joints[1].move_within_in[2][1]": -12, "output.point_mm[0]": 1800}),
        (SPREAD, {"joints[1].centre_in": [50, 0, -12], "input.point_m": [-0.5, 0, 0]}),
    ],
)
def test_means_the_changed_drive(text: str, values: dict[str, Any]) -> None:
    assert loads(edit(text, values)) == with_values(loads(text), values)


@pytest.mark.parametrize("name", example_names())
def test_changes_a_single_line_of_an_example(name: str) -> None:
    text = example_text(name)
    old = text.splitlines()
    new = edit(text, {"duty.speed_rpm": 1234}).splitlines()
    changed = [line for line in new if line not in old]
    assert changed in (["speed_rpm = 1234"], ["[duty]", "speed_rpm = 1234"])
    assert [line for line in old if line.startswith("#")] == [line for line in new if line.startswith("#")]


def test_keeps_the_comment_of_a_value_given_in_another_unit() -> None:
    changed = edit(FORMS, {"joints[1].joint_angle_deg": 11, "joints[0].joint_angle_deg": 12})
    assert "joint_angle_deg = 11 # second" in changed
    assert "joint_angle_deg = 12 # first" in changed


def test_keeps_comments_inside_a_list_of_which_one_number_changes() -> None:
    changed = edit(SPREAD, {"joints[1].centre_mm[2]": -330})
    assert "  0, # aside\n  -330, # up\n" in changed


def test_reads_files_beside_the_drive_file(tmp_path: Path) -> None:
    rows = "".join(f"{k},0,0,{k}\n" for k in range(5))
    (tmp_path / "way.csv").write_text("time_s,x_mm,y_mm,z_mm\n" + rows)
    text = SPREAD + '[[movements]]\nkind = "table"\nmoves = ["joints[1]"]\nfile = "way.csv"\n'
    assert "-330" in edit(text, {"joints[1].centre_mm[2]": -330}, folder=tmp_path)
    with pytest.raises(InputError, match="cannot be read"):
        edit(text, {"joints[1].centre_mm[2]": -330}, folder=tmp_path / "none")


@pytest.mark.parametrize(
    "values",
    [
        {"joints[0].joint_angle_deg": 90},
        {"joints[5].joint_angle_deg": 3},
        {"colour": 3},
        {"shafts[0].yoke_angle_deg": 3},
    ],
)
def test_refuses_what_makes_no_drive(values: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        edit(FORMS, values)


def test_takes_a_key_out() -> None:
    text = FORMS + '[[shafts]]\nnumber = 2\nouter_m = 0.05 # wide\nwall_in = 0.1 # thin\nmaterial = "C45"\n'
    changed = edit(text, {"shafts[1].wall_mm": None, "shafts[1].outer_mm": 40})
    assert "wall" not in changed
    assert "outer_mm = 40 # wide" in changed
    with pytest.raises(InputError, match="must be a whole number"):
        edit(text, {"shafts[1].number": None})
