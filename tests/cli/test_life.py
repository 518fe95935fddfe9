"""cardan life: lives side by side, blocks, a measured torque, and what is asked for."""

import csv
import io
import re

import numpy as np
import pytest

from cardan import io as files
from cardan.questions.life.life import life
from tests.cli.test_forces import plain, widest

TEXT = """format = 1
name = "truck"
[[joints]]
name = "gearbox"
joint_angle_deg = 7
size = "example-90"
[[joints]]
joint_angle_deg = 4
size = "example-90"
[duty]
"""
BLOCKS = """life_h = 1000
blocks = [
  { torque_Nm = 900, speed_rpm = 300, share_percent = 10 },
  { torque_Nm = 300, speed_rpm = 2000, share_percent = 90 },
]
"""
STEADY = "speed_rpm = 900\ntorque_Nm = 700\n"


def hours(seconds):
    return seconds / 3600.0


@pytest.fixture
def cycle(drive_file):
    return drive_file(TEXT + BLOCKS)


@pytest.fixture
def measured(drive_file, tmp_path):
    times = np.linspace(0.0, 60.0, 601)
    rows = [f"{t:.1f},{600 + 300 * np.sin(t):.3f}" for t in times]
    (tmp_path / "run.csv").write_text("time_s,torque_Nm\n" + "\n".join(rows) + "\n")
    return drive_file(TEXT + 'speed_rpm = 900\ntorque_history = "run.csv"\n')


def test_the_answer_stands_within_80_columns(cardan, cycle, measured):
    for path in (cycle, measured):
        done = cardan("life", path)
        assert (done.code, done.err) == (0, "")
        assert widest(done.out) <= 80


def test_json_is_the_life(cardan, cycle):
    said, found = cardan("life", cycle, "--json").content, life(files.load(cycle))
    assert said["life_h"] == hours(found.drive)
    assert said["enough"] is found.enough
    for name in ("iso", "simple", "maker", "book"):
        assert [row[f"{name}_h"] for row in said["joints"]] == hours(found.of(name)).tolist()
    assert {one["code"] for one in said["warnings"]} == {one.code for one in found.cautions}
    assert said["parts"]["damage_percent"][0] == 100.0 * found.damage[0, 0]
    assert said["governing_joint"] == 1


def test_csv_has_every_part_and_joint(cardan, cycle):
    rows = list(csv.DictReader(io.StringIO(cardan("life", cycle, "--csv").out)))
    said = cardan("life", cycle, "--json").content["parts"]
    assert [(row["part"], row["joint"]) for row in rows] == [("1", "1"), ("1", "2"), ("2", "1"), ("2", "2")]
    assert [row["condition"] for row in rows] == said.pop("condition")
    assert {key: [float(row[key]) for row in rows] for key in said} == said


def test_too_short_a_life_fails_and_says_what_would_do(cardan, drive_file):
    path = drive_file(TEXT + BLOCKS.replace("1000", "1e6"))
    done = cardan("life", path)
    assert done.code == 1
    assert "too short; joint 1 (gearbox) fails" in plain(done.out)
    found = life(files.load(path))
    assert f"it would last with {100 * found.torque_margin:.2f} % of its loads" in plain(done.out)


def test_a_measured_torque_is_told_in_one_sentence(cardan, measured):
    done, found = cardan("life", measured), life(files.load(measured))
    assert f"equivalent to a constant {found.history.equivalent:.1f} N·m" in plain(done.out)
    said = cardan("life", measured, "--json").content["history"]
    assert sum(said["share_percent"]) == pytest.approx(100.0)
    assert sum(said["cycles"]["count"]) == found.cycles.total


def test_the_command_line_goes_before_the_file(cardan, cycle, measured, drive_file):
    steady = drive_file(TEXT + STEADY, "steady.toml")
    wanted = cardan("life", steady, "--json").content
    for path in (cycle, measured):
        asked = cardan("life", path, "--torque-Nm", 700, "--speed-rpm", 900, "--json").content
        assert asked["life_h"] == wanted["life_h"]
    sure = cardan("life", steady, "--reliability-percent", 99, "--json").content
    assert sure["life_h"] == pytest.approx(0.25 * wanted["life_h"])
    book = cardan("life", steady, "--method", "book", "--json").content
    assert book["life_h"] == min(row["book_h"] for row in wanted["joints"])
    slow = cardan("life", measured, "--speed-rpm", 450, "--json").content
    assert slow["life_h"] == pytest.approx(2.0 * cardan("life", measured, "--json").content["life_h"])


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (("--method", "best"), "--method: best is none of"),
        (("--reliability-percent", 40), "--reliability-percent: 40"),
        (("--speed-rpm", 900), "every load case has its own speed"),
        (("--torque-Nm", 100), "duty.speed_rpm: missing.*say --speed-rpm"),
    ],
)
def test_what_cannot_be_asked_is_refused(cardan, cycle, options, text):
    done = cardan("life", cycle, *options)
    assert done.code == 2
    assert re.search(text, plain(done.err))


def test_what_misses_is_named_by_its_key(cardan, drive_file):
    path = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 5\n[duty]\n" + STEADY)
    said = cardan("life", path, "--json").complaint
    named = [(one["field"], one["code"]) for one in said["problems"]]
    assert named == [("joints[0].cross.span_mm", "missing"), ("joints[0].needles.capacity_N", "missing")]


def test_joints_without_figures_are_left_out_in_words(cardan, drive_file):
    bare = TEXT.replace('joint_angle_deg = 4\nsize = "example-90"\n', "joint_angle_deg = 4\n")
    done = cardan("life", drive_file(bare + STEADY))
    assert done.code == 0
    assert "the file lacks joints[1].cross.span_mm, joints[1].needles.capacity_N" in plain(done.out)


def test_a_straight_or_idle_drive_wears_nothing(cardan, drive_file):
    path = drive_file(re.sub(r"joint_angle_deg = \d+", "joint_angle_deg = 0", TEXT) + STEADY)
    done = cardan("life", path)
    assert "nothing wears" in done.out
    assert cardan("life", path, "--json").content["life_h"] == "∞"


@pytest.mark.parametrize("suffix", [".svg", ".html"])
def test_figures_are_drawn(cardan, cycle, measured, tmp_path, suffix):
    for path in (cycle, measured):
        target = tmp_path / f"life{suffix}"
        assert cardan("life", path, "--plot", target).code == 0
        assert target.stat().st_size > 10_000
