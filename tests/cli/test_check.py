"""cardan check: the table of verdicts, what is missing, the remedies, and the exit code."""

import csv
import io

import pytest

from cardan import load
from cardan.checks import CHECKS, check
from cardan.io.edit import edit
from tests.cli.test_forces import plain, widest

CAR = """format = 1
name = "car"
input.point_mm = [-250, 0, 0]
output.point_mm = [1500, 0, -60]

[[joints]]
centre_mm = [0, 0, 0]
size = "example-75"

[[joints]]
centre_mm = [1200, 0, -60]
size = "example-75"

[[shafts]]
number = 2
outer_mm = 70
wall_mm = 2
material = "C22"

[duty]
speed_rpm = 3000
torque_Nm = 400
life_h = 3000
shock_factor = 1.2
"""


@pytest.fixture
def car(drive_file):
    return drive_file(CAR, "car.toml")


@pytest.mark.slow
def test_a_drive_that_fails_says_so_with_a_sign_a_word_and_code_1(cardan, car):
    done = cardan("check", car)
    assert done.code == 1
    assert done.out.startswith("✖ car: ")
    assert "✖ failed" in done.out
    assert "● passed" in done.out
    assert "cardan check" in done.out
    assert widest(done.out) <= 80


@pytest.mark.slow
def test_keys_that_checks_need_are_told_when_asked_for(cardan, car):
    brief, done = cardan("check", car), cardan("check", car, "--missing")
    assert "limits.speed_fluctuation_percent" not in brief.out
    assert "checks not run" in brief.out
    assert "limits.speed_fluctuation_percent" in done.out
    assert widest(done.out) <= 80


@pytest.mark.slow
def test_json_holds_what_the_library_found(cardan, car):
    done = cardan("check", car, "--json")
    said, every = done.content, check(load(car))
    found = [one for one in every if one.check != "answers_agree"]
    assert said["answers_agree"] is True
    assert len(found) == len(every) - 1
    assert [row["title"] for row in said["verdicts"]] == [one.title for one in found]
    for row, one in zip(said["verdicts"], found, strict=True):
        assert row["state"] == one.state
        if one.run:
            assert row["utilisation"] == one.utilisation
            assert row["source"]
            assert row["unit"] == one.unit
            assert row["limit"] is not None
        else:
            assert row["missing"]
    assert said["exit_code"] == done.code == 1
    assert not said["passed"]
    assert {one["path"] for one in said["most_helpful"]} <= {one["path"] for one in said["remedies"]}


@pytest.mark.slow
def test_a_remedy_written_into_the_file_makes_its_check_pass(cardan, car, drive_file):
    remedies = cardan("check", car, "--json").content["remedies"]
    assert len({remedy["title"] for remedy in remedies}) > 2
    for remedy in remedies[::3]:
        better = drive_file(edit(CAR, {remedy["path"]: remedy["value"]}), "better.toml")
        rows = cardan("check", better, "--only", remedy["check"], "--json").content["verdicts"]
        assert next(row["state"] for row in rows if row["title"] == remedy["title"]) in (
            "passed",
            "close",
            "unconfirmed",
        )


def test_a_drive_that_passes_ends_with_code_0(cardan, drive_file):
    path = drive_file(CAR.replace("life_h = 3000", "life_h = 1000"))
    done = cardan("check", path)
    assert done.code == 0
    assert "checks met, 18 by unconfirmed ratings" in done.out
    assert "Corrective changes" not in done.out


@pytest.mark.parametrize(("joint_angle", "said"), [(20, "the only check failed"), (2, "the only check passed")])
def test_a_single_check_is_not_counted(cardan, drive_file, joint_angle, said):
    path = drive_file(f"format = 1\n[[joints]]\njoint_angle_deg = {joint_angle}\n[duty]\nspeed_rpm = 1500\n")
    assert said in plain(cardan("check", path).out)


@pytest.mark.slow
def test_csv_is_one_row_a_verdict(cardan, car):
    rows = list(csv.DictReader(io.StringIO(cardan("check", car, "--csv").out)))
    said = cardan("check", car, "--json").content["verdicts"]
    assert [row["title"] for row in rows] == [row["title"] for row in said]
    assert [float(row["value"]) for row in rows if row["value"]] == [
        row["value"] for row in said if row["value"] is not None
    ]


def test_only_some_checks(cardan, car):
    said = cardan("check", car, "--only", "twist", "--only", "joint_angle", "--json").content
    assert {row["check"] for row in said["verdicts"]} == {"twist", "joint_angle"}
    done = cardan("check", car, "--only", "twits")
    assert done.code == 2
    assert "the nearest is twist" in done.err


def test_the_command_line_changes_the_duty(cardan, car):
    light = cardan("check", car, "--torque-Nm", "100", "--speed-rpm", "500", "--json")
    assert light.code == 0


def test_a_torque_on_the_command_line_is_steady(cardan, drive_file):
    """It stands in place of a duty cycle, as in the other commands."""
    cycle = "blocks = [{ torque_Nm = 900, speed_rpm = 600, share_percent = 100 }]\n"
    steady = cardan("check", drive_file(CAR), "--torque-Nm", 300, "--only", "tube_strength", "--json")
    blocks = cardan("check", drive_file(CAR + cycle), "--torque-Nm", 300, "--only", "tube_strength", "--json")
    assert blocks.content["verdicts"] == steady.content["verdicts"]


def test_the_list_names_every_check(cardan):
    said = cardan("check", "--list", "--json").content
    assert [row["name"] for row in said["checks"]] == list(CHECKS)
    assert cardan("check").code == 2


@pytest.mark.slow
def test_a_catalogue_adds_sizes_to_take_and_to_try(cardan, drive_file):
    own = """[[joint_sizes]]
id = "own-80"
type = "medium"
cross = { span_mm = 60, journal_mm = 20, journal_length_mm = 18, material = "20Kh" }
needles = { count = 28, diameter_mm = 2.5, length_mm = 14, capacity_N = 24000, static_capacity_N = 40000 }
rating = { torque_Nm = 1400, max_torque_Nm = 2400, max_joint_angle_deg = 30, max_speed_rpm = 5000 }
source = "a test"
"""
    rows = drive_file(own, "own.toml")
    remedies = cardan("check", drive_file(CAR), "--catalogue", rows, "--json").content["remedies"]
    assert "own-80" in {remedy["value"] for remedy in remedies}
    taken = drive_file(CAR.replace("example-75", "own-80"))
    assert cardan("check", taken).code == 2
    assert cardan("check", taken, "--catalogue", rows, "--only", "rated_torque").code == 0


@pytest.mark.slow
def test_sources_are_told_when_asked_for(cardan, car):
    assert "ISO 281" not in cardan("check", car).out
    assert "ISO 281" in cardan("check", car, "--sources").out


@pytest.mark.slow
def test_the_figure_is_drawn(cardan, car, tmp_path):
    done = cardan("check", car, "--plot", tmp_path / "bars.svg")
    assert done.code == 1
    assert "</svg>" in (tmp_path / "bars.svg").read_text("utf-8")
