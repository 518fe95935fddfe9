"""Torques over time come from a CSV file beside the drive file and go back to one."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from cardan import InputError, load, save
from cardan.drive.duty import History
from cardan.drive.machine import TorqueHistory

TEXT = """format = 1
[[joints]]
joint_angle_deg = 10
[duty]
speed_rpm = 600
load = { kind = "time_history", file = "load.csv" }
"""


def written(folder: Path, rows: str) -> Path:
    (folder / "drive.toml").write_text(TEXT)
    (folder / "load.csv").write_text(rows)
    return folder / "drive.toml"


def test_the_rows_are_read_in_the_units_of_their_titles(tmp_path: Path) -> None:
    load_law = load(written(tmp_path, "torque_kNm,time_ms\n0.1,0\n0.3,500\n")).duty.load
    assert load_law == TorqueHistory(file="load.csv", times=(0.0, 0.5), torques=(100.0, 300.0))


def test_the_rows_go_to_a_file_where_there_is_none(tmp_path: Path) -> None:
    drive = load(written(tmp_path, "time_s,torque_Nm\n0,1\n2,3\n"))
    (tmp_path / "other").mkdir()
    save(drive, tmp_path / "other" / "drive.toml")
    assert load(tmp_path / "other" / "drive.toml") == drive
    (tmp_path / "other" / "load.csv").write_text("time_s,torque_Nm\n0,1\n2,4\n")
    with pytest.raises(InputError, match=r"duty\.load\.file: .* holds something else"):
        save(drive, tmp_path / "other" / "drive.toml")


def test_a_column_of_speeds_is_read_and_written(tmp_path: Path) -> None:
    drive = load(written(tmp_path, "time_s,torque_Nm,speed_rpm\n0,1,60\n2,3,120\n"))
    assert drive.duty.load.speeds == pytest.approx((2.0 * math.pi, 4.0 * math.pi))
    (tmp_path / "other").mkdir()
    save(drive, tmp_path / "other" / "drive.toml")
    assert load(tmp_path / "other" / "drive.toml").duty.load.speeds == pytest.approx(drive.duty.load.speeds)


@pytest.mark.parametrize(
    ("rows", "text"),
    [
        ("", "is empty"),
        ("time_s,moment_Nm\n0,1\n", "has no column torque_Nm"),
        ("time_s,torque_Nm\n0,1\n", "has 1 rows; at least 2"),
        ("time_s,torque_Nm\n0,1\n0,2\n", "line 3: the times do not rise"),
        ("time_s,torque_Nm\n0,1\n1,x\n", "line 3 is not two numbers"),
    ],
)
def test_a_file_that_is_no_history_is_refused_at_its_key(tmp_path: Path, rows: str, text: str) -> None:
    with pytest.raises(InputError, match=text) as caught:
        load(written(tmp_path, rows))
    assert {problem.field for problem in caught.value.problems} == {"duty.load.file"}


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    (tmp_path / "drive.toml").write_text(TEXT)
    with pytest.raises(InputError, match=r"duty\.load\.file: load.csv cannot be read"):
        load(tmp_path / "drive.toml")


CYCLE = TEXT.replace('load = { kind = "time_history", file = "load.csv" }', 'torque_history = "load.csv"')


def test_a_duty_cycle_is_a_file_by_its_name_alone(tmp_path: Path) -> None:
    path = written(tmp_path, "time_min,torque_Nm\n0,-5\n1,10\n3,40\n")
    path.write_text(CYCLE)
    drive = load(path)
    assert drive.duty.torque_history == History(file="load.csv", times=(0.0, 60.0, 180.0), torques=(-5.0, 10.0, 40.0))
    path.write_text(CYCLE.replace('"load.csv"', '{ file = "load.csv" }'))
    assert load(path) == drive
    (tmp_path / "other").mkdir()
    save(drive, tmp_path / "other" / "drive.toml")
    assert 'torque_history = "load.csv"' in (tmp_path / "other" / "drive.toml").read_text()
    assert load(tmp_path / "other" / "drive.toml") == drive


def test_a_duty_cycle_that_is_none_is_refused_at_its_key(tmp_path: Path) -> None:
    path = written(tmp_path, "time_s,torque_Nm\n0,1\n")
    path.write_text(CYCLE)
    with pytest.raises(InputError, match=r"duty\.torque_history: load.csv has 1 rows"):
        load(path)
    path.write_text(CYCLE + "blocks = [{ torque_Nm = 1, speed_rpm = 1, share_percent = 100 }]\n")
    (tmp_path / "load.csv").write_text("time_s,torque_Nm\n0,1\n1,2\n")
    with pytest.raises(InputError, match=r"duty\.torque_history: blocks give the duty cycle already"):
        load(path)
