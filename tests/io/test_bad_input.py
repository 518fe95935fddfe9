"""Bad drive files of every sort: an `InputError` with all there is to say, never anything else."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, InputError, load, save
from cardan.io import example_names, example_text, loads
from cardan.reading.limits import limits_hold

POINTS = """format = 1
input.point_mm = [-300, 0, 0]
output.point_mm = [1900, 40, -260]
[[joints]]
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [1200, 0, -160]
"""
JOINT_ANGLES = "format = 1\n[[joints]]\njoint_angle_deg = 20\n[[joints]]\njoint_angle_deg = 25\n"
ARM = POINTS + '[[movements]]\nkind = "arm"\nmoves = ["joints[1]"]\npivot_mm = [0, 0, 0]\naxis = [0, 1, 0]\n'


def problems(text: str, form: str = "toml") -> dict[str, str]:
    with pytest.raises(InputError) as caught:
        loads(text, form=form)
    return {problem.field: problem.message for problem in caught.value.problems}


@pytest.mark.parametrize(
    ("text", "fields"),
    [
        pytest.param(POINTS.replace("centre_mm", "centre"), ["joints[0].centre", "joints[1].centre"], id="no unit"),
        pytest.param(JOINT_ANGLES.replace("[[joints]]", "[[joint]]"), ["joint"], id="table misspelt"),
        pytest.param(
            JOINT_ANGLES.replace("20", "20\njoint_angle_rad = 1"), ["joints[0].joint_angle_rad"], id="given twice"
        ),
        pytest.param(
            POINTS.replace("[1200, 0, -160]", "[0, 0, 0]").replace("[1900, 40, -260]", "[0, 0, 0]"),
            ["joints[1].centre_mm", "output.point_mm"],
            id="two pairs coincide",
        ),
        pytest.param(
            POINTS.replace("[-300, 0, 0]", "[-300, nan, 0]").replace("[1900, 40, -260]", "[700, 0, -160]"),
            ["input.point_mm[1]", "joints[1].centre_mm"],
            id="a fold beside a point that is not a number",
        ),
        pytest.param(
            POINTS.replace("[-300, 0, 0]", "[-300, nan, 0]").replace("[1200, 0, -160]", "[0, 0, 0]"),
            ["input.point_mm[1]", "joints[1].centre_mm"],
            id="coincident beside a point that is not a number",
        ),
        pytest.param(POINTS.replace("[1200, 0, -160]", "[1e300, 0, 0]"), ["joints[1].centre_mm[0]"], id="overflow"),
        pytest.param(
            JOINT_ANGLES + "[duty]\nspeed_rpm = -1e300\n", ["duty.speed_rpm"], id="speed whose square overflows"
        ),
        pytest.param(
            JOINT_ANGLES.replace("20", "1" + "0" * 400),
            ["joints[0].joint_angle_deg"],
            id="a whole number beyond floats",
        ),
        pytest.param(JOINT_ANGLES.replace("20", "2020-01-01"), ["joints[0].joint_angle_deg"], id="a date"),
        pytest.param(
            "format = 1\ninput.point_mm = [0, 0, 0]\noutput.point_mm = [1, 0, 0]\n[[joints]]\n",
            ["joints[0].centre_mm"],
            id="ends without centre",
        ),
        pytest.param(
            "format = 1\n[[joints]]\n[[shafts]]\nnumber = 1\nside_slope_deg = 80\n"
            "[[shafts]]\nnumber = 2\nside_slope_deg = -80\n",
            ["shafts[1].side_slope_deg"],
            id="slopes that fold",
        ),
        pytest.param(
            JOINT_ANGLES + "[[shafts]]\nnumber = 2\nplan_slope_deg = 3\n",
            ["shafts[1].plan_slope_deg"],
            id="slope of joint angles",
        ),
        pytest.param(
            JOINT_ANGLES + "[limits]\nspline_overlap_mm = 3\n", ["limits.spline_overlap_mm"], id="no such spline"
        ),
        pytest.param(
            ARM + "yaw_deg = 3\n", ["movements[0].yaw_deg", "movements[0].frequency_Hz", "movements[0].amplitude_deg"]
        ),
        pytest.param(
            ARM.replace('"arm"', '"arms"') + "colour = 3\n",
            ["movements[0].kind", "movements[0].colour"],
            id="unknown kind, unknown key",
        ),
        pytest.param(
            JOINT_ANGLES
            + '[[movements]]\nkind = "random"\nmoves = ["joints[3]"]\naxis = [0, 0, 0]\ndeviation_mm = -1\n'
            "duration_s = 3\nspectrum = { frequency_Hz = [2, 1], density = [0, 0, 1] }\n",
            [
                "movements[0].moves",
                "movements[0].axis",
                "movements[0].deviation_mm",
                "movements[0].spectrum.frequency_Hz",
                "movements[0].spectrum.density",
            ],
            id="random movement",
        ),
        pytest.param(
            POINTS + '[[poses]]\nname = "x"\nset = { "joints[1].centr_mm" = 1, "joints[9].centre_mm" = 1 }\n'
            '[[poses]]\nname = "x"\nset = { "output.point" = 1, "joints[1].centre_mm" = [1, 2] }\ncolour = 3\n',
            [
                "poses[1].colour",
                "poses[1].name",
                "poses[0].set: joints[1].centr_mm",
                "poses[0].set: joints[9].centre_mm",
                "poses[1].set: output.point",
                "poses[1].set: joints[1].centre_mm",
            ],
            id="poses",
        ),
        pytest.param(
            POINTS + '[[poses]]\nname = "x"\nset = { "joints[1].centre_mm" = [0, 0, 0] }\n',
            ["poses[0].set: joints[1].centre_mm"],
            id="a pose that makes no drive",
        ),
        pytest.param(
            POINTS + "".join(f'[[poses]]\nname = "{k}"\nshare_percent = 60\nset = {{ name = "a" }}\n' for k in "ab"),
            ["poses[1].share_percent"],
            id="shares beyond the whole",
        ),
        pytest.param(
            POINTS + '[[poses]]\nname = "x"\nset.duty.speed_rpm = 3\n', ["poses[0].set"], id="path without quotes"
        ),
        pytest.param(
            JOINT_ANGLES + "[[shafts]]\nnumber = 2\nmaterial = 'C22'\n[duty]\nlife = 3\n",
            ["shafts[1].material", "duty.life"],
            id="keys of later questions",
        ),
    ],
)
def test_finds_exactly_these(text: str, fields: list[str]) -> None:
    assert sorted(problems(text)) == sorted(fields)


@pytest.mark.parametrize(
    ("text", "field", "words"),
    [
        (JOINT_ANGLES + "alpha_deg = 3\n", "joints[1].alpha_deg", "the nearest known one is joint_angle_deg"),
        (JOINT_ANGLES + "gamma_rad = 3\n", "joints[1].gamma_rad", "unknown key"),
        (
            JOINT_ANGLES + "[[shafts]]\nnumber = 2\ngamma_rad = 3\n",
            "shafts[1].gamma_rad",
            "nearest known one is yoke_angle_rad",
        ),
        (JOINT_ANGLES + "[duty]\nspeed_RPM = 3\n", "duty.speed_RPM", "the nearest known one is speed_rpm"),
        (JOINT_ANGLES + "speed_rpm = 3\n", "joints[1].speed_rpm", "it belongs to [duty]"),
        (
            ARM + "yaw_deg = 3\n",
            "movements[0].yaw_deg",
            "belongs to [[movements]] kind = 'hitch' or [[movements]] kind",
        ),
        (ARM.replace('"arm"', '"arms"'), "movements[0].kind", "the nearest is arm"),
        (
            JOINT_ANGLES.replace("joint_angle_deg = 20", "joint_angle_rad = 1.6"),
            "joints[0].joint_angle_rad",
            "less than 1.5708 rad",
        ),
        (JOINT_ANGLES + "[[shafts]]\nnumber = 2\nyoke_lead_deg = nan\n", "shafts[1].yoke_lead_deg", "a finite number"),
        (JOINT_ANGLES + "name_mm = 3\n", "joints[1].name_mm", "takes no unit: write name"),
    ],
)
def test_says_what_was_meant(text: str, field: str, words: str) -> None:
    assert words in problems(text)[field]


@pytest.mark.parametrize(
    ("text", "form", "words"),
    [
        ("a = " + "[" * 5000 + "]" * 5000, "toml", "too deeply nested"),
        ('{"a": ' * 100_000, "json", "too deeply nested"),
        ("a = 1" + "0" * 5000, "toml", "4300 digits"),
        ("format = 1\n\x00", "toml", "is not TOML"),
        ('{"format": 1, "format": 1}', "json", "stands twice"),
    ],
)
def test_texts_that_are_no_tables(text: str, form: str, words: str) -> None:
    with limits_hold(False):
        assert any(words in message for message in problems(text, form).values())


def test_json_has_numbers_that_are_none() -> None:
    text = json.dumps(
        {"format": 1, "joints": [{"joint_angle_deg": float("nan"), "name": "\ud800"}, {"joint_angle_deg": None}]}
    )
    assert set(problems(text, "json")) == {"joints[0].joint_angle_deg", "joints[0].name", "joints[1].joint_angle_deg"}


def test_devices_without_end_are_refused() -> None:
    endless = Path("/dev/zero")
    if not endless.exists():
        pytest.skip("no such device here")
    with pytest.raises(InputError, match="bytes given; the limit is 2000000"):
        load(endless)


def judged(text: str, form: str) -> bool:
    """Tell whether a text loads, or is refused in words; anything else raises."""
    try:
        return isinstance(loads(text, form=form), Drive)
    except InputError as error:
        return bool(error.problems) and all(problem.message for problem in error.problems)


SCRAPS = [
    "=",
    "[",
    "]",
    "{",
    "}",
    '"',
    "nan",
    "-1",
    "0",
    "1e400",
    "true",
    "[[joints]]",
    "_mm",
    "_deg",
    "x",
    "\n",
    ".",
    ",",
]


@pytest.mark.slow
@given(st.sampled_from(example_names()), st.integers(0, 2**32), st.integers(1, 4))
@settings(max_examples=150, deadline=None)
def test_damaged_files_load_or_are_refused(name: str, seed: int, cuts: int) -> None:
    dice = random.Random(seed)
    text = example_text(name)
    text = text[text.index("format") :]
    for _cut in range(cuts):
        at = dice.randrange(len(text))
        text = text[:at] + dice.choice([*SCRAPS, ""]) + text[at + dice.randrange(6) :]
    assert judged(text, "toml")


values = st.recursive(
    st.none() | st.booleans() | st.integers(-3, 3) | st.floats() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=6,
)
KEYS = [
    "joints", "shafts", "input", "output", "duty", "limits", "movements", "poses", "name", "note", "kind", "number",
    "centre_mm", "joint_angle_deg", "point_mm", "spline", "teeth", "moves", "axis", "spectrum", "set", "share_percent",
    "file",
]  # fmt: skip
tables = st.recursive(
    st.dictionaries(st.sampled_from(KEYS), values, max_size=4),
    lambda inner: st.dictionaries(st.sampled_from(KEYS), inner | st.lists(inner, max_size=3) | values, max_size=5),
    max_leaves=10,
)


@pytest.mark.slow
@given(tables)
@settings(max_examples=200, deadline=None)
def test_any_tree_loads_or_is_refused(tree: dict[str, object]) -> None:
    assert judged(json.dumps({"format": 1, **tree}), "json")


def test_a_table_movement_takes_its_rows_along_and_overwrites_none(tmp_path: Path) -> None:
    for folder in ("a", "b", "c"):
        (tmp_path / folder).mkdir()
    rows = "".join(f"{k},0,0,{0.1 * k}\n" for k in range(5))
    (tmp_path / "a" / "way.csv").write_text("time_s,x_mm,y_mm,z_mm\n" + rows)
    text = POINTS + '[[movements]]\nkind = "table"\nmoves = ["joints[1]"]\nfile = "way.csv"\n'
    drive = loads(text, folder=tmp_path / "a")
    save(drive, tmp_path / "b" / "drive.toml")
    assert load(tmp_path / "b" / "drive.toml") == drive
    save(drive, tmp_path / "b" / "again.json")
    (tmp_path / "c" / "way.csv").write_text("something else\n")
    with pytest.raises(InputError, match="holds something else") as caught:
        save(drive, tmp_path / "c" / "drive.toml")
    assert caught.value.field == "movements[0].file"
    assert [path.name for path in (tmp_path / "c").iterdir()] == ["way.csv"]


def test_an_old_key_is_met_by_the_new_one():
    with pytest.raises(InputError, match=r"bend_deg: unknown key; the nearest known one is joint_angle_deg"):
        loads("format = 1\n[[joints]]\nbend_deg = 12")


@pytest.mark.parametrize(
    ("line", "number"),
    [
        ("speed_rpm = 1,500", "1,500"),
        ("speed_rpm = 1 500", "1 500"),
        ("torque_Nm = 12,5 # at the input", "12,5"),
        ("torque_Nm = 1'200.5", "1'200.5"),
        ("vehicle = { gear_ratio = 4,7, axle_ratio = 3 }", "4,7"),
    ],
)
def test_decimal_commas_and_thousands_get_a_hint(line, number):
    with pytest.raises(InputError, match=f"line 2: write {number} with a decimal point"):
        loads(f"[duty]\n{line}\n")


def test_lists_of_numbers_are_no_decimal_commas():
    with pytest.raises(InputError) as caught:
        loads("a = [1,2]\nb = { x = 1, y = 2 }\nc = [3,\n")
    assert "decimal point" not in str(caught.value)


@pytest.mark.parametrize(
    ("table", "field"),
    [
        ('[[stations]]\nshaft = 1\nend = "far"', "stations[0].end"),
        ('[[stations]]\nshaft = 1\nend = ""', "stations[0].end"),
        ("[[stations]]\nshaft = 1\nend = 7\nto_next = { stiffness_Nm_per_rad = 1 }", "stations[0].end"),
        ('[duty]\ntorque_Nm = 9\ntorque_at = "far"', "duty.torque_at"),
        ('[duty]\ntorque_Nm = 9\ninput = "far"', "duty.input"),
        ('[duty]\napplication = "far"', "duty.application"),
        ('[duty]\ncases = [{ name = "one", torque_Nm = 9, flow = "far" }]', "duty.cases[0].flow"),
        (
            '[duty]\nspeed_rpm = 9\nlife_h = 9\nevents = [{ kind = "far", count = 1, torque_Nm = 1 }]',
            "duty.events[0].kind",
        ),
        (
            '[[shafts]]\nnumber = 2\nouter_mm = 9\nprofile = { form = "far", inscribed_mm = 5 }',
            "shafts[1].profile.form",
        ),
        ('[[shafts]]\nnumber = 2\nouter_mm = 9\nfinish = "far"', "shafts[1].finish"),
    ],
)
def test_a_wrong_word_is_named_with_what_is_allowed(table, field):
    elastic = "[[joints]]\njoint_angle_deg = 5\n[[joints]]\njoint_angle_deg = 5\n[[shafts]]\nnumber = 1\n"
    with pytest.raises(InputError, match=rf"{re.escape(field)}: .* (is none of|must be)") as caught:
        loads(f"format = 1\n{elastic}stiffness_Nm_per_rad = 1000\n{table}\n")
    assert [problem.field for problem in caught.value.problems].count(field) == 1
