"""Files in and out: nothing lost, nothing half-written."""

from __future__ import annotations

import math
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import Drive, InputError, equivalent_joint, load, save
from cardan.drive.fields.keys import written
from cardan.io import dumps, example, example_names, example_text, loads, starter
from cardan.io.edit import edit
from cardan.io.examples import example_file
from cardan.texts import LANGUAGES, speaking
from cardan.units import DIMENSIONS

angles = st.floats(0.0, 1.5, allow_subnormal=False)
lengths = st.floats(-1e4, 1e4, allow_subnormal=False)


@pytest.mark.slow
@given(st.floats(-1e6, 1e6, allow_subnormal=False), st.sampled_from(["length", "angle", "angular_speed", "time"]))
def test_a_number_is_written_so_that_it_reads_back_to_the_last_bit(value: float, dimension: str) -> None:
    unit, number = written(value, dimension)
    assert number * DIMENSIONS[dimension][unit] == value


@given(
    st.lists(angles, min_size=1, max_size=5),
    st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=20),
    st.floats(-4, 4),
)
def test_round_trip_by_angles(joint_angles: list[float], name: str, phase: float) -> None:
    drive = Drive.from_angles(
        joint_angles, yoke_angles=[b - 0.7 for b in joint_angles[1:]], start_phase=phase, name=name
    )
    assert loads(dumps(drive)) == drive
    assert loads(dumps(drive, form="json"), form="json") == drive


@given(st.lists(st.tuples(st.floats(0.3, 3), st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)), min_size=3, max_size=6))
def test_round_trip_by_points(steps: list[tuple[float, float, float]]) -> None:
    points = np.cumsum(steps, axis=0)
    drive = Drive.from_points(points.tolist())
    assert loads(dumps(drive)) == drive


@pytest.mark.parametrize("name", example_names())
@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_round_trip_of_examples(name: str, suffix: str, tmp_path: Path) -> None:
    drive = example(name)
    save(drive, tmp_path / f"a{suffix}")
    assert load(tmp_path / f"a{suffix}") == drive


def test_examples_are_what_they_say() -> None:
    said = (
        "single-20deg",
        "truck-printed-coordinates",
        "truck-printed-angles",
        "truck-wrong-yokes",
        "truck-exact-yokes",
    )
    names = (*said, "w-arrangement", "z-arrangement")
    speed_fluctuation = {name: float(equivalent_joint(example(name)).speed_fluctuation) for name in names}
    # spec figures: Table 4; section 8 (coordinates, printed angles, the book's yoke angles)
    assert speed_fluctuation["single-20deg"] == pytest.approx(0.124485, abs=5e-7)
    assert speed_fluctuation["truck-printed-coordinates"] == pytest.approx(0.09471, abs=5e-6)
    assert speed_fluctuation["truck-printed-angles"] == pytest.approx(0.12512, abs=5e-6)
    assert speed_fluctuation["truck-wrong-yokes"] == pytest.approx(0.1140, abs=5e-5)
    assert speed_fluctuation["truck-exact-yokes"] < 1e-7
    assert speed_fluctuation["w-arrangement"] < 1e-15
    assert speed_fluctuation["z-arrangement"] < 1e-15
    assert all(example_text(name).startswith("# ") for name in example_names())


def test_edit_keeps_comments_and_changes_only_what_was_asked() -> None:
    text = example_text("truck-printed-angles")
    changed = edit(text, {"shafts[1].yoke_angle_deg": 90, "duty.speed_rpm": 900})
    assert loads(changed).shafts[1].yoke_angle == math.pi / 2
    kept = [line for line in text.splitlines() if line != "speed_rpm = 855"]
    assert [one for one in changed.splitlines() if one != "speed_rpm = 900" and "yoke_angle" not in one] == kept


def test_edit_replaces_a_field_given_otherwise_and_adds_missing_tables() -> None:
    text = "format = 1\n[[joints]]\njoint_angle_deg = 3\n[[joints]]\njoint_angle_rad = 0.1 # here\n"
    changed = edit(text, {"joints[1].joint_angle_deg": 5, "shafts[1].yoke_angle_deg": 7, "duty.speed_rpm": 10})
    drive = loads(changed)
    assert drive.joints[1].joint_angle == pytest.approx(math.radians(5))
    assert drive.shafts[1].yoke_angle == pytest.approx(math.radians(7))
    assert drive.duty.speed == pytest.approx(math.pi / 3)
    angle_error = edit(text + "[[shafts]]\nnumber = 2\nyoke_lead_deg = 3\n", {"shafts[1].yoke_angle_deg": 7})
    assert "yoke_lead" not in angle_error


def test_edit_changes_one_coordinate() -> None:
    text = dumps(Drive.from_points([(0, 0, 0), (0.5, 0, 0), (1, 0, 0.1), (2, 0, 0.1)]))
    changed = loads(edit(text, {"joints[1].centre_mm[2]": -250}))
    assert changed.joints[1].centre == (1.0, 0.0, -0.25)


def test_edit_refuses_what_makes_no_drive() -> None:
    with pytest.raises(InputError, match="joints\\[0\\]"):
        edit(example_text("single-20deg"), {"joints[0].joint_angle_deg": 95})


def test_starter_shows_every_form() -> None:
    assert loads(starter()).form == "points"
    assert all(word in starter() for word in ("joint_angle_deg", "side_slope_deg", "[[movements]]", "[[poses]]"))


@pytest.mark.parametrize("code", LANGUAGES)
def test_starter_is_the_same_drive_in_every_language(code: str) -> None:
    def nameless(text: str) -> Drive:
        drive = loads(text)
        return replace(drive, name="", joints=tuple(replace(one, name="") for one in drive.joints))

    def keys(text: str) -> list[str]:
        return [line.partition(" = ")[0] for line in text.splitlines() if " = " in line]

    with speaking(code):
        text = starter()
    assert nameless(text) == nameless(starter())
    assert keys(text) == keys(starter())


@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"name = 1", b""])
def test_unreadable_content(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_bytes(content)
    with pytest.raises(InputError):
        load(tmp_path / "a.toml")


def test_unreadable_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        load(tmp_path / "none.toml")
    with pytest.raises(InputError, match="directory"):
        load(tmp_path)


def test_unwritable_file_leaves_nothing(tmp_path: Path) -> None:
    drive = Drive.from_angles([0.1])
    with pytest.raises(InputError, match="cannot be written"):
        save(drive, tmp_path / "none" / "a.toml")
    with pytest.raises(InputError, match=r"\.toml or \.json"):
        save(drive, tmp_path / "a.yaml")
    assert not list(tmp_path.iterdir())


def test_a_failing_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "a.toml"
    save(Drive.from_angles([0.1]), target)
    before = target.read_bytes()

    def fail(*_args: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(InputError, match="disk full"):
        save(Drive.from_angles([0.2]), target)
    assert target.read_bytes() == before
    assert list(tmp_path.iterdir()) == [target]


def test_table_movement_reads_its_file(tmp_path: Path) -> None:
    text = example_text("z-arrangement") + '[[movements]]\nkind = "table"\nmoves = ["joints[1]"]\nfile = "way.csv"\n'
    (tmp_path / "a.toml").write_text(text, "utf-8")
    rows = "".join(f"{10 * k},0,0,{k}\n" for k in range(5))
    (tmp_path / "way.csv").write_text("time_ms, x_mm, y_mm, z_mm\n" + rows)
    movement = load(tmp_path / "a.toml").movements[0]
    assert movement.times[1] == pytest.approx(0.01)  # type: ignore[attr-defined]
    assert movement.shifts[4] == (0.0, 0.0, 0.004)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, "cannot be read"),
        ("", "is empty"),
        ("t,x,y,z\n", "has no column time_s or time_ms"),
        ("time_s,x_mm,y_mm,z_mm\n0,0,0,0\n", "at least 4"),
        ("time_s,x_mm,y_mm,z_mm\n0,0,0,0\n1,a,0,0\n", "line 3 is not four numbers"),
        ("time_s,x_mm,y_mm,z_mm\n0,0,0,0\n0,1,0,0\n", "line 3: the times do not rise"),
        ("time_s,x_mm,y_mm,z_mm\n0,0,0,0\n1,nan,0,0\n", "line 3 has a number that is not finite"),
    ],
)
def test_bad_table_files(content: str | None, words: str, tmp_path: Path) -> None:
    text = example_text("z-arrangement") + '[[movements]]\nkind = "table"\nmoves = ["joints[1]"]\nfile = "way.csv"\n'
    if content is not None:
        (tmp_path / "way.csv").write_text(content)
    with pytest.raises(InputError, match=words) as caught:
        loads(text, folder=tmp_path)
    assert caught.value.field == "movements[0].file"


def test_every_example_is_a_file() -> None:
    assert all(example_file(name).is_file() for name in example_names())
    with pytest.raises(InputError, match="nearest is single-20deg"):
        example("single-20")
