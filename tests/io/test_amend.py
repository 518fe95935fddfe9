"""Changing a drive file that need not be right."""

from __future__ import annotations

import tomllib

import pytest

from cardan.errors import InputError
from cardan.io import example_names, example_text, loads
from cardan.io.amend import amend, insert, joint_moved, with_joint, without_joint
from cardan.io.examples import example_file

DRIVE = """# my drive
format = 1
input.point_mm = [-300, 0, 0]  # the gearbox

[[joints]]
centre_mm = [0, 0, 0]

[[joints]]
centre_mm = [1200, 0, -160]  # measured

[[shafts]]
number = 2
material = "C22"

[[supports]]
shaft = 3
position_mm = 100

[[poses]]
name = "low"
set = { "joints[1].centre_mm" = [1200, 0, -100], "shafts[1].yoke_angle_deg" = 3 }
"""


@pytest.mark.parametrize("name", example_names())
def test_a_joint_added_and_taken_away_leaves_the_drive(name: str) -> None:
    text, folder = example_text(name), example_file(name).parent
    drive = loads(text, folder=folder)
    for at in (0, len(drive.joints) // 2):
        wider = with_joint(text, at)
        assert len(tomllib.loads(wider)["joints"]) == len(drive.joints) + 1
        assert loads(without_joint(wider, at), folder=folder) == drive


@pytest.mark.parametrize("name", example_names())
def test_writing_what_stands_there_changes_nothing(name: str) -> None:
    text, folder = example_text(name), example_file(name).parent
    tree = tomllib.loads(text)
    values = {
        f"joints[{k}].{key}": value
        for k, joint in enumerate(tree["joints"])
        for key, value in joint.items()
        if not isinstance(value, dict)
    }
    assert loads(amend(text, values), folder=folder) == loads(text, folder=folder)


def test_other_spellings_go_and_the_comment_stays() -> None:
    text = amend(DRIVE, {"joints[1].centre_m": [1.2, 0.0, -0.16]})
    assert "centre_m = [1.2, 0, -0.16] # measured" in text
    assert "centre_mm = [1200, 0, -160]" not in text
    assert "# my drive" in text


def test_broken_values_are_written_as_they_are() -> None:
    text = amend(DRIVE, {"joints[0].centre_mm": "far", "duty.speed_rpm": -1, "shafts[2].outer_mm": 5})
    tree = tomllib.loads(text)
    assert tree["joints"][0]["centre_mm"] == "far"
    assert tree["duty"] == {"speed_rpm": -1}
    assert {"number": 3, "outer_mm": 5} in tree["shafts"]


def test_a_material_by_name_becomes_a_table_that_keeps_its_name() -> None:
    tree = tomllib.loads(amend(DRIVE, {"shafts[1].material.yield_strength_MPa": 240}))
    assert tree["shafts"][0]["material"] == {"grade": "C22", "yield_strength_MPa": 240}


def test_kinds_decide_which_keys_there_are() -> None:
    with pytest.raises(InputError, match="not a key"):
        amend(DRIVE, {"joints[0].cage_mm": 4})
    moved = insert(DRIVE, "movements[0]", {"kind": "hitch", "moves": ["output"]})
    assert tomllib.loads(amend(moved, {"movements[0].yaw_deg": 5}))["movements"][0]["yaw_deg"] == 5


def test_tables_are_taken_out_whole() -> None:
    tree = tomllib.loads(amend(DRIVE, {"supports[0]": None, "shafts[1]": None, "input": None, "duty": None}))
    assert {"supports", "shafts", "input"}.isdisjoint(tree)


@pytest.mark.parametrize("path", ["joints[0", "nothing.here", "joints[0].span_mm", "duty.speed"])
def test_paths_that_lead_nowhere_are_refused(path: str) -> None:
    with pytest.raises(InputError):
        amend(DRIVE, {path: 1})


def test_no_toml_is_refused() -> None:
    with pytest.raises(InputError, match="not TOML"):
        amend("[[", {"name": "x"})


def test_a_new_joint_renumbers_what_follows() -> None:
    tree = tomllib.loads(with_joint(DRIVE, 1))
    assert tree["joints"][1] == {"centre_mm": [600, 0, -80]}
    assert tree["shafts"][0]["number"] == 2
    assert tree["supports"][0]["shaft"] == 4
    assert set(tree["poses"][0]["set"]) == {"joints[2].centre_mm", "shafts[1].yoke_angle_deg"}


def test_a_joint_that_goes_takes_the_shaft_behind_it_along() -> None:
    tree = tomllib.loads(without_joint(DRIVE, 0))
    assert len(tree["joints"]) == 1
    assert "shafts" not in tree or not tree["shafts"]
    assert tree["supports"][0]["shaft"] == 2
    assert set(tree["poses"][0]["set"]) == {"joints[0].centre_mm"}
    with pytest.raises(InputError, match="at least one joint"):
        without_joint(without_joint(DRIVE, 0), 0)


def test_joints_change_places_but_the_line_stays() -> None:
    text = amend(DRIVE, {"joints[0].name": "first", "joints[0].cross.span_mm": 80})
    tree = tomllib.loads(joint_moved(text, 0, 1))
    assert tree["joints"][1] == {"name": "first", "cross": {"span_mm": 80}, "centre_mm": [1200, 0, -160]}
    assert tree["joints"][0] == {"centre_mm": [0, 0, 0]}


@pytest.mark.parametrize(
    "text",
    ["", "joints = 5", "joints = [1]", "joints = 'x'", "[joints]\na = 1", "x = " + "9" * 5000, "x = " + "[" * 3000],
)
def test_a_file_with_something_else_for_its_joints_is_refused_in_words(text: str) -> None:
    for change in (
        lambda: amend(text, {"joints[0].joint_angle_deg": 5}),
        lambda: amend(text, {"joints[0].cross.span_mm": 5}),
        lambda: with_joint(text, 0),
        lambda: without_joint(text, 0),
        lambda: joint_moved(text, 0, 1),
    ):
        with pytest.raises(InputError):
            change()


def test_a_file_with_something_else_for_other_tables_is_refused_in_words() -> None:
    joints = "\n[[joints]]\njoint_angle_deg = 10\n[[joints]]\njoint_angle_deg = 10\n"
    for line in ("supports = 5", "shafts = [1]", "poses = [1]", "movements = [[1]]"):
        with pytest.raises(InputError):
            with_joint(line + joints, 1)
    with pytest.raises(InputError):
        insert("supports = 5" + joints, "supports[0]", {"shaft": 1})


def test_poses_follow_the_joint_but_places_stay() -> None:
    text = DRIVE.replace('"shafts[1].yoke_angle_deg" = 3', '"joints[0].friction" = 0.1, "shafts[1].yoke_angle_deg" = 3')
    tree = tomllib.loads(joint_moved(text, 0, 1))
    assert tree["poses"][0]["set"] == {
        "joints[1].centre_mm": [1200, 0, -100],
        "joints[1].friction": 0.1,
        "shafts[1].yoke_angle_deg": 3,
    }
