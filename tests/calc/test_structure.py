import json
from pathlib import Path

import pytest

from cardan import InputError, calc

CASES = json.loads((Path(__file__).parents[1] / "reference" / "structure.json").read_text("utf8"))["cases"]
FIRST = {case["capability"]: case["inputs"] for case in reversed(CASES) if "error_field" not in case["expected"]}
HOOKE = FIRST["instantaneous_mobility"]
HINGE = HOOKE["joints"][0]


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


def with_joint(**changed):
    kept = {key: value for key, value in (HINGE | changed).items() if value is not None}
    return HOOKE | {"joints": [kept, *HOOKE["joints"][1:]]}


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"axis": [0, 0, 0]}, ["joints[0].axis"]),
        ({"axis": [0, 0, 1e-300]}, ["joints[0].axis"]),
        ({"axis": [0, 0, 1e300]}, ["joints[0].axis"]),
        ({"axis": None}, ["joints[0].axis"]),
        ({"axis": [0, 0, float("inf")]}, ["joints[0].axis"]),
        ({"axis": [0, 1]}, ["joints[0].axis"]),
        ({"type": "X"}, ["joints[0].type"]),
        ({"type": "U"}, ["joints[0].axis2"]),
        ({"type": "U", "axis2": [0, 0, -2]}, ["joints[0].axis2"]),
        ({"type": "L4", "axis2": [0, 1, 1]}, ["joints[0].axis2"]),
        ({"type": "H"}, ["joints[0].pitch_m_per_rad"]),
        ({"id": "B"}, ["joints[1].id"]),
        ({"links": ["0", "0"]}, ["joints[0].links"]),
        ({"links": ["0", "1", "2"]}, ["joints[0].links"]),
        ({"point_m": None}, ["joints[0].point_m"]),
    ],
)
def test_bad_joints_are_named(changed, named):
    assert fields("instantaneous_mobility", with_joint(**changed)) == named


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"joints": []}, ["joints"]),
        ({"frame": "9"}, ["joints"]),
        ({"input_link": "9"}, ["input_link"]),
        ({"output_link": "0"}, ["output_link"]),
    ],
)
def test_bad_mechanisms_are_named(changed, named):
    assert fields("instantaneous_mobility", HOOKE | changed) == named


def test_a_key_of_no_use_in_a_kind_is_left_aside_here():
    spare = with_joint(axis2=[0, 1, 0], pitch_m_per_rad=0.1)
    assert calc("instantaneous_mobility", spare) == calc("instantaneous_mobility", HOOKE)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"joint": "X"}, ["release.joint"]),
        ({"kind": "turn"}, ["release.kind"]),
        ({"axis": [0, 0, 0]}, ["release.axis"]),
        ({"axis": [0, 1e-300, 0]}, ["release.axis"]),
    ],
)
def test_bad_releases_are_named(changed, named):
    given = FIRST["release_analysis"]
    assert fields("release_analysis", given | {"release": given["release"] | changed}) == named


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"driven_joint": "X"}, ["driven_joint"]),
        ({"drive_deg": 0}, ["drive_deg"]),
        ({"closure_tolerance": 0}, ["closure_tolerance"]),
        ({"steps": 0}, ["steps"]),
    ],
)
def test_bad_drives_are_named(changed, named):
    assert fields("finite_mobility", FIRST["finite_mobility"] | changed) == named


@pytest.mark.parametrize(
    ("capability", "inputs", "named"),
    [
        ("pair_class", {"type": "x"}, ["type"]),
        ("pair_class", {"type": "R", "axis": [0, 0, 0]}, ["axis"]),
        ("pair_class", {"type": "U", "axis": [0, 0, 1], "axis2": [0, 0, 1]}, ["axis2"]),
        ("mobility_formula", {"moving_links": 0, "p1": 1}, ["moving_links"]),
        ("mobility_formula", {"moving_links": 3, "p2": -1}, ["p2"]),
        ("planar_mobility", {"moving_links": 3, "p1": 1.5}, ["p1"]),
        ("zero_groups", {"links": 0}, ["links"]),
        ("minus_groups", {"constraints": 6}, ["constraints"]),
        ("classify_group", {"pair_constraints": [5, 6]}, ["pair_constraints[1]"]),
        ("classify_group", {"pair_constraints": [5]}, ["pair_constraints"]),
        ("structural_partition", {"frame": "0", "input_link": "1", "pairs": []}, ["pairs"]),
        (
            "structural_partition",
            {"frame": "0", "input_link": "1", "pairs": [{"links": ["0", "1"], "constraints": 6}]},
            ["pairs[0].constraints"],
        ),
    ],
)
def test_bad_inputs_are_named(capability, inputs, named):
    assert fields(capability, inputs) == named


def test_counting_gives_the_difference_alone():
    found = calc("mobility_formula", {"moving_links": 3, "p1": 4, "required_mobility": 2})
    assert found == {"W_formula": -2, "q": 4, "loops": 1}
    assert calc("mobility_formula", {"moving_links": 2, "p1": 1, "p5": 1})["q"] == -5


def test_a_group_of_five_links_is_the_longest():
    assert calc("zero_groups", {"links": 5}) == {"count": 1, "formulas": [[5] * 6]}
    assert calc("zero_groups", {"links": 6})["count"] == 0
    assert calc("minus_groups", {"constraints": 5}) == {"count_by_links": {}, "formulas": {}}
