"""Every problem of a file at once, each where the user wrote it."""

from __future__ import annotations

import pytest

from cardan import InputError
from cardan.io import loads
from cardan.reading.limits import limits_hold

HEAD = "format = 1\n"
TWO = HEAD + "[[joints]]\njoint_angle_deg = 10\n[[joints]]\njoint_angle_deg = 12\n"


def problems(text: str, **how: str) -> dict[str, str]:
    with pytest.raises(InputError) as caught:
        loads(text, **how)
    return {problem.field: problem.message for problem in caught.value.problems}


@pytest.mark.parametrize(
    ("text", "field", "words"),
    [
        ("[[joints]]\njoint_angle_deg = 10", "format", "missing"),
        ("format = 2\n[[joints]]\njoint_angle_deg = 10", "format", "this version reads format = 1"),
        ("format = true\n[[joints]]\njoint_angle_deg = 10", "format", "not known"),
        (HEAD, "joints", "missing"),
        (HEAD + "joints = []", "joints", "at least one joint"),
        (HEAD + "joints = 3", "joints", "must be tables, each under [[joints]], not 3"),
        (TWO + "[duty]\nspeed = 3", "duty.speed", "needs a unit: write speed_rpm or speed_rad_s"),
        (TWO + "[duty]\nspeed_mm = 3", "duty.speed_mm", "mm is not a unit of this field"),
        (TWO + '[duty]\nspeed_rpm = "fast"', "duty.speed_rpm", "must be a number, not 'fast'"),
        (TWO + "[duty]\nspeed_rpm = true", "duty.speed_rpm", "must be a number, not true"),
        (TWO + "[duty]\nspeed_rpm = inf", "duty.speed_rpm", "a finite number"),
        (TWO + "[duty]\nspeed_rpm = 1\nspeed_rad_s = 2", "duty.speed_rad_s", "speed_rpm gives the same already"),
        (TWO + "[duty]\nspeeed_rpm = 3", "duty.speeed_rpm", "the nearest known one is speed_rpm"),
        (TWO + "[duty]\nyoke_fixed = true", "duty.yoke_fixed", "it belongs to [[shafts]]"),
        (TWO + "[duty]\nteeth = 3", "duty.teeth", "it belongs to [[shafts]] spline"),
        (TWO + "duty = 3", "joints[1].duty", "unknown here; it belongs to the head of the file, above its first table"),
        (HEAD + "[[joints]]\njoint_angle_deg = 90", "joints[0].joint_angle_deg", "less than 90°"),
        (HEAD + "[[joints]]\njoint_angle_deg = -1", "joints[0].joint_angle_deg", "at least 0°"),
        (HEAD + "[[joints]]\njoint_angle_deg = nan", "joints[0].joint_angle_deg", "nan is not allowed"),
        (HEAD + '[[joints]]\nkind = "hook"\njoint_angle_deg = 1', "joints[0].kind", "none of hooke"),
        (TWO + "[[shafts]]\nyoke_angle_deg = 3", "shafts[0].number", "missing"),
        (TWO + "[[shafts]]\nnumber = 2.5", "shafts[0].number", "must be a whole number"),
        (TWO + "[[shafts]]\nnumber = 4", "shafts[3].number", "2 joints make shafts 1 to 3"),
        (TWO + "[[shafts]]\nnumber = 2\n[[shafts]]\nnumber = 2", "shafts[1].number", "described twice"),
        (TWO + "[[shafts]]\nnumber = 1\nyoke_angle_deg = 3", "shafts[0].yoke_angle_deg", "is an end shaft"),
        (
            TWO + "[[shafts]]\nnumber = 2\nyoke_angle_deg = 1\nyoke_lead_deg = 1",
            "shafts[1].yoke_lead_deg",
            "yoke_angle_deg gives the same already",
        ),
        (TWO + "[[shafts]]\nnumber = 2\nspline.teeth = 0", "shafts[1].spline.teeth", "at least 1"),
        (TWO + "[[shafts]]\nnumber = 2\nyoke_fixed_deg = 1", "shafts[1].yoke_fixed_deg", "takes no unit"),
        (TWO + "input.point_mm = [0, 0, 0]", "joints[1].input", "belongs to the head"),
        (
            HEAD + "input.point_mm = [0, 0, 0]\n[[joints]]\njoint_angle_deg = 3",
            "input.point_mm",
            "given by angles; this field belongs to another form",
        ),
        (HEAD + "[[joints]]\nplane_twist_deg = 3", "joints", "no geometry"),
        (TWO + '[[movements]]\nmoves = ["output"]', "movements[0].kind", "missing; one of hitch"),
        (
            TWO + '[[movements]]\nkind = "harmonic"\nmoves = ["joints[2]"]\nfrequency_Hz = 1\namplitude_mm = [0, 0, 1]',
            "movements[0].moves",
            "'joints[2]' is not a point of this drive",
        ),
        (
            TWO + '[[poses]]\nname = "a"\nset = { "joints[0].joint_angle_dek" = 3 }',
            "poses[0].set: joints[0].joint_angle_dek",
            "nearest",
        ),
        (
            TWO + '[[poses]]\nname = "a"\nset = { "joints[0].joint_angle_deg" = 90 }',
            "poses[0].set: joints[0].joint_angle_deg",
            "90°",
        ),
    ],
)
def test_names_field_value_and_what_is_allowed(text: str, field: str, words: str) -> None:
    found = problems(text)
    assert field in found
    assert words in found[field]


def test_tells_everything_at_once() -> None:
    text = """
format = 3
colour = "red"
[[joints]]
centre = [0, 0, 0]
[[joints]]
centre_mm = [1, 2]
[[joints]]
centre_mm = [1, 2, nan]
[[shafts]]
number = 1
yoke_angle_deg = 4
[[shafts]]
number = 7
"""
    found = problems(text)
    assert set(found) == {
        "format",
        "colour",
        "joints[0].centre",
        "joints[1].centre_mm",
        "joints[2].centre_mm[2]",
        "input.point_mm",
        "output.point_mm",
        "shafts[0].yoke_angle_deg",
        "shafts[6].number",
    }


def test_reports_nothing_that_only_follows_from_another_problem() -> None:
    assert list(problems(HEAD + "[[joints]]\njoint_angle_deg = 91\n[[joints]]\njoint_angle_deg = 3")) == [
        "joints[0].joint_angle_deg"
    ]


@pytest.mark.parametrize("points", ["[0, 0, 0]", "[100, 0, 0]"])
def test_points_that_make_no_drive(points: str) -> None:
    text = HEAD + f"input.point_mm = [0, 0, 0]\noutput.point_mm = [50, 0, 0]\n[[joints]]\ncentre_mm = {points}"
    found = problems(text)
    assert list(found) == ["joints[0].centre_mm"]
    assert ("coincides" in found["joints[0].centre_mm"]) == (points == "[0, 0, 0]")


def test_one_shaft_only() -> None:
    assert problems(HEAD + "input.point_mm = [0, 0, 0]\noutput.point_mm = [1, 0, 0]") == {
        "joints": "missing: the joints in the order of the power flow"
    }


def test_ten_thousand_joints_are_refused_with_the_limit() -> None:
    with limits_hold(False):
        found = problems(HEAD + "[[joints]]\njoint_angle_deg = 1\n" * 10_000)
    assert found == {"joints": "10000 joints given; the limit is 1000"}


def test_a_thousand_joints_load() -> None:
    with limits_hold(False):
        assert len(loads(HEAD + "[[joints]]\njoint_angle_deg = 0.1\n" * 1000).joints) == 1000


def test_not_toml_says_where() -> None:
    assert "line 2" in problems("format = 1\nname = oops\n")["file"]


def test_not_json() -> None:
    assert "not JSON" in problems("{", form="json")["file"]
    assert "no table" in problems("[]", form="json")["file"]
    with limits_hold(False):
        assert "not JSON" in problems("[" * 100_000, form="json")["file"]


@pytest.mark.parametrize(
    ("key", "value"),
    [("joint_angle_deg = 20", 20), ("joint_angle_rad = 0.3490658503988659", 20), ("joint_angle_arcmin = 1200", 20)],
)
def test_any_unit_of_the_dimension(key: str, value: float) -> None:
    assert loads(HEAD + f"[[joints]]\n{key}").joints[0].joint_angle == pytest.approx(
        value * 0.017453292519943295, rel=1e-15
    )


def test_yoke_lead_is_the_yoke_angle_with_the_opposite_sign() -> None:
    angle_error = loads(TWO + "[[shafts]]\nnumber = 2\nyoke_lead_deg = 30")
    angle = loads(TWO + "[[shafts]]\nnumber = 2\nyoke_angle_deg = -30")
    assert angle_error == angle
