"""The file as a form: every key of every example is in it, and what is typed comes back."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from cardan.app.state.document import read
from cardan.app.state.form import Entry, converted, geometry_form, parts, problems_of, section, shown, tree_of, written
from cardan.errors import Problem
from cardan.files import Enclosed
from cardan.io import example_names, example_text, loads
from cardan.io.amend import amend
from cardan.io.examples import example_file


def walked(tree: dict[str, Any], path: str) -> list[Entry]:
    """Return all keys that stand in a table and in those within it."""
    found: list[Entry] = []
    for one in section(tree, path).entries:
        if not one.given:
            continue
        if one.sort == "tables":
            for k in range(len(one.value)):
                found += walked(tree, f"{one.key()}[{k}]")
        elif one.sort == "table" or (one.sort == "named" and isinstance(one.value, dict)):
            found += walked(tree, one.key())
        else:
            found.append(one)
    return found


def leaves(tree: Any) -> int:
    """Count the values of a file; the changes of a pose are one."""
    if isinstance(tree, dict):
        return sum(1 if key == "set" else leaves(value) for key, value in tree.items())
    if isinstance(tree, list) and tree and isinstance(tree[0], dict):
        return sum(map(leaves, tree))
    return 1


@pytest.mark.parametrize("name", example_names())
def test_every_key_of_a_file_is_in_its_form(name: str) -> None:
    tree = tomllib.loads(example_text(name))
    found = [entry for path, _title in parts(tree) for entry in walked(tree, path)]
    kinds = example_text(name).count("kind =")
    numbers = len(tree.get("shafts", []))
    poses = sum(1 for pose in tree.get("poses", []) if "set" in pose)
    changes = sum(1 for entry in found if entry.sort == "changes")
    assert len(found) - changes + poses == leaves({k: v for k, v in tree.items() if k != "format"}) - kinds - numbers


@pytest.mark.parametrize("name", example_names())
def test_what_is_shown_and_typed_again_is_the_same_drive(name: str) -> None:
    text, folder = example_text(name), example_file(name).parent
    tree = tomllib.loads(text)
    entries = [one for path, _title in parts(tree) for one in walked(tree, path) if one.sort not in ("changes", "flag")]
    values = {one.key(): written(one, shown(one)) for one in entries if one.sort != "choice"}
    assert loads(amend(text, values), folder=folder) == loads(text, folder=folder)


def test_units_turn_and_turn_back() -> None:
    tree = tomllib.loads(example_text("truck-supports"))
    entries = [one for path, _title in parts(tree) for one in walked(tree, path) if len(one.units) > 1]
    assert len(entries) > 30
    for one in entries:
        for unit in one.units:
            there = converted(one, unit)
            back = converted(Entry(**{**vars(one), "value": there, "unit": unit}), one.unit)
            assert back == pytest.approx(one.value, rel=1e-10)


def test_numbers_are_read_as_people_write_them() -> None:
    speed = next(one for one in section({}, "duty").entries if one.name == "speed")
    assert written(speed, " 1 500,25 ") == 1500.25
    assert written(speed, "−3") == -3
    assert written(speed, "") is None
    assert written(speed, "fast") == "fast"
    point = next(one for one in section({"joints": [{}]}, "joints[0]").entries if one.name == "centre")
    assert written(point, "1 2,5 -3") == [1, 2.5, -3]


def test_problems_stand_at_their_keys() -> None:
    problems = (Problem("joints[0].centre_mm[1]", "one"), Problem("joints[0].cross.span_mm", "two"))
    assert problems_of("joints[0].centre", problems, ["mm", "m"]) == ("one",)
    assert problems_of("joints[0]", problems) == ("one", "two")
    assert problems_of("joints[0].cross.span", problems, ["mm"]) == ("two",)
    assert problems_of("joints[1]", problems) == ()


def test_a_text_that_is_no_toml_has_no_form() -> None:
    assert tree_of("[[") is None
    assert [path for path, _title in parts({"joints": "no list"})] == [
        "",
        "input",
        "output",
        "duty",
        "limits",
        "steering",
        "settings",
        "report",
    ]


@pytest.mark.parametrize("spoilt", ["friction = " + "9" * 5000, "friction = " + "[" * 3000 + "]" * 3000])
def test_a_text_beyond_the_parser_has_no_form(spoilt: str) -> None:
    assert tree_of(f"[[joints]]\n{spoilt}\n") is None


@pytest.mark.parametrize(
    "text", ["joints = 5", "joints = [1, 'x']\nshafts = 5\nsupports = [[1]]", "input = 5\nposes = 1"]
)
def test_a_text_with_something_else_for_tables_has_a_form(text: str) -> None:
    tree = tree_of(text)
    assert tree is not None
    for path, _title in parts(tree):
        assert section(tree, path).entries


OTHERS = {
    "points": {"joints[0]": ("joint_angle", "plane_twist"), "shafts[0]": ("side_slope", "plan_slope")},
    "angles": {"joints[0]": ("centre",), "input": ("point",), "shafts[0]": ("side_slope",)},
    "slopes": {"joints[0]": ("centre", "joint_angle"), "output": ("point",)},
}


@pytest.mark.parametrize("name", ["car-propshaft", "truck-power-unit", "w-arrangement"])
def test_keys_that_the_loader_would_refuse_for_the_form_of_the_geometry_are_not_offered(name: str) -> None:
    text = example_text(name)
    tree = tree_of(text)
    assert tree is not None
    for path, names in OTHERS[geometry_form(tree)].items():
        assert not {one.name for one in section(tree, path).entries} & set(names)
        free = {one.name: one for one in section({}, path).entries}  # of a file that gives no geometry yet
        for other in names:
            value = [0, 0, 0] if free[other].size == 3 else 5
            assert not read(amend(text, {free[other].key(): value}), Enclosed(Path())).valid


def test_a_key_of_another_form_that_stands_in_the_file_is_shown_and_common_ones_are_offered_first() -> None:
    tree = tree_of(example_text("car-propshaft").replace("[[joints]]", "[[joints]]\njoint_angle_deg = 5", 1))
    assert tree is not None
    assert "joint_angle" in {one.name for one in section(tree, "joints[0]").given}
    bare = tree_of("format = 1\n[[joints]]\njoint_angle_deg = 5\n[[shafts]]\nnumber = 2\n")
    assert bare is not None
    assert [one.name for one in section(bare, "shafts[1]").possible][:2] == ["yoke_angle", "outer"]


def test_a_key_that_is_missing_is_offered_in_the_unit_in_which_a_data_sheet_has_it() -> None:
    entries = section(tomllib.loads(example_text("front-halfshaft")), "duty").entries
    assert {one.name: one.unit for one in entries if one.name in ("life", "torque")} == {"life": "h", "torque": "Nm"}
