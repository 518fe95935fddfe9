"""motion, phases, articulation: the same answer for the eye, as JSON, as CSV and as a figure."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.drive.fields.paths import pose_drives
from cardan.drive.models.wobble import wobbling
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import motion
from cardan.units import deg, mm, rpm
from tests.cli.conftest import EXAMPLES

ALL = sorted(EXAMPLES.glob("*.toml"))
MOVING = [path for path in ALL if files.load(path).movements]
TRUCK = EXAMPLES / "truck-printed-angles.toml"
ROUND = {"rtol": 1e-12, "atol": 1e-12}
"""Printed in full precision, so what is read back differs by the conversion of units alone."""


def widest(text):
    """Return the width of the longest line; a command to be copied is never broken and does not count."""
    return max(len(line) for line in text.splitlines() if not line.startswith("    cardan"))


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


@pytest.mark.slow
@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
@pytest.mark.parametrize("question", ["motion", "phasing"])
def test_every_example_is_answered_within_80_columns(cardan, question, path):
    done = cardan(question, path)
    assert done.code == 0
    assert done.err == ""
    assert widest(done.out) <= 80
    assert files.load(path).name in " ".join(done.out.split())


@pytest.mark.parametrize("path", ALL, ids=lambda path: path.stem)
def test_motion_as_json_is_the_motion(cardan, path):
    drive = files.load(path)
    said = cardan("motion", path, "--json").content
    found = motion(drive)
    share = 0.01 * said["speed_fluctuation_percent"]
    if wobbling(drive):
        ratio = motion(drive, np.linspace(0.0, 2.0 * np.pi, 2881)).shaft_ratio[-1]
        assert share == pytest.approx(np.ptp(ratio), rel=1e-4)  # tops between places of the turn
    else:
        assert share == pytest.approx(float(equivalent_joint(drive).speed_fluctuation), rel=1e-12, abs=1e-15)
    np.testing.assert_allclose(np.asarray(said["motion"]["angle_deg"]) * deg, found.angle, **ROUND)
    for k in range(2, len(drive.shafts) + 1):
        np.testing.assert_allclose(said["motion"][f"shaft_{k}_ratio"], found.shaft_ratio[k - 1], **ROUND)
        turned = np.asarray(said["motion"][f"shaft_{k}_angle_deg"]) * deg
        np.testing.assert_allclose(turned, found.shaft_angle[k - 1], **ROUND)


def test_motion_as_csv_and_json_agree(cardan):
    table = rows(cardan("motion", TRUCK, "--csv").out)
    said = cardan("motion", TRUCK, "--json").content["motion"]
    assert len(table) == 361
    assert {key: [float(row[key]) for row in table] for key in said} == said


def test_angles_and_speed_of_the_command_line_count(cardan):
    said = cardan("motion", TRUCK, "--angle", 10, "--angle-deg", -400, "--speed-rpm", -3000, "--json").content
    found = motion(files.load(TRUCK), np.asarray([10.0, -400.0]) * deg, speed=-3000 * rpm)
    np.testing.assert_allclose(said["motion"]["shaft_5_acceleration_rad_s2"], found.shaft_acceleration[-1], rtol=1e-10)
    assert said["speed_rpm"] == pytest.approx(-3000)


def test_without_a_speed_acceleration_is_over_its_square(cardan, drive_file):
    path = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 20\n")
    done = cardan("motion", path)
    assert "ω₁²" in done.out
    assert "rad/s²" not in done.out.replace("accelerations in rad/s²", "")
    said = cardan("motion", path, "--json").content
    assert said["speed_rpm"] is None
    assert max(said["motion"]["shaft_2_acceleration_per_speed_squared"]) == pytest.approx(0.1249656, abs=1e-4)


def test_the_table_has_the_step_asked_for(cardan):
    out = cardan("motion", TRUCK, "--angle-step", 45).out
    table = out.split("Over the input angle")[1].split("Ratio of the output")[0]
    assert [line.split()[0] for line in table.splitlines()[3:]] == [str(45 * k) for k in range(9)]


def test_the_table_over_the_input_angle_is_asked_for(cardan):
    assert "Over the input angle" not in cardan("motion", TRUCK).out
    table = cardan("motion", TRUCK, "--table").out.split("Over the input angle")[1]
    assert [line.split()[0] for line in table.splitlines()[3:16]] == [str(30 * k) for k in range(13)]


@pytest.mark.parametrize("name", ["w-arrangement", "single-20deg"])
def test_accelerations_that_are_rounding_are_shown_as_zero(cardan, name):
    """The output of an even drive, and a single joint at its dead points; JSON keeps what was calculated."""
    path = EXAMPLES / f"{name}.toml"
    tables = cardan("motion", path, "--angle-deg", "0", "--angle-deg", "90").out.split("\n\n")
    turn = next(part for part in tables if part.strip().startswith("Over the input")).splitlines()[3:5]
    assert [line.split()[3] for line in turn] == ["0", "0"]
    shaft = next(part for part in tables if "acceleration ±" in part).splitlines()
    assert (shaft[-2].split()[-1] == "0") == (name == "w-arrangement")
    assert cardan("motion", path, "--json").content["max_acceleration_per_speed_squared"] > 0.0


def test_an_even_moving_drive_stays_even(cardan, drive_file):
    """A hitch that never turns keeps both joints straight."""
    text = (EXAMPLES / "pto-hitch.toml").read_text()
    path = drive_file(text.replace("pitch_deg = 8", "pitch_deg = 0").replace("yaw_deg = 40", "yaw_deg = 0"))
    done = cardan("articulation", path)
    said = " ".join(done.out.split())
    assert "Including the articulation rate, the output stays uniform." in said, done.err


def test_orders_are_those_of_one_joint(cardan):
    """τ^k/k, spec of the equivalent joint: order 2k of the angle error."""
    orders = cardan("motion", EXAMPLES / "single-20deg.toml", "--json").content["orders"]
    tau = np.tan(10 * deg) ** 2
    assert [row["order"] for row in orders] == [2, 4, 6]
    np.testing.assert_allclose(
        [row["angle_error_deg"] * deg for row in orders], [tau, tau**2 / 2, tau**3 / 3], rtol=1e-12
    )
    np.testing.assert_allclose([row["ratio"] for row in orders], [2 * tau, 2 * tau**2, 2 * tau**3], rtol=1e-12)


def test_phases_finds_both_sets_of_the_truck(cardan):
    """The worked example: shaft 2 held at 90°, solutions A and B, 16-tooth splines 0.5227 %."""
    done = cardan("phasing", TRUCK, "--fix", "2=90")
    assert "δ = 12.51 % as specified, exactly uniform with other yoke angles" in " ".join(done.out.split())
    for line in ("A 90.00 −1.70 82.84 ● 0", "B 90.00 46.20 −2.81 ● 0"):
        assert line in [" ".join(row.split()) for row in done.out.splitlines()]
    said = cardan("phasing", TRUCK, "--fix", "2=90", "--json").content
    by_label = {row["label"]: row for row in said["settings"]}
    assert by_label["A"]["speed_fluctuation_percent"] < 1e-12
    assert by_label["16-tooth splines"]["speed_fluctuation_percent"] == pytest.approx(0.5227, abs=5e-5)
    assert said["synchronous_possible"] is True
    assert said["held_shafts"] == [2]


def test_the_older_name_of_the_command_still_answers(cardan):
    assert cardan("phases", TRUCK, "--json").content == cardan("phasing", TRUCK, "--json").content
    assert " phases " not in cardan("--help").out


def test_an_infeasible_drive_is_told_its_bound_and_its_joint(cardan, drive_file):
    path = drive_file("format = 1\n" + "".join(f"[[joints]]\njoint_angle_deg = {angle}\n" for angle in (10, 25, 12)))
    done = cardan("phasing", path)
    assert done.code == 0
    said = cardan("phasing", path, "--json").content
    assert said["synchronous_possible"] is False
    assert said["limiting_joint"] == 2
    excess = np.log(np.cos(10 * deg) * np.cos(12 * deg) / np.cos(25 * deg))
    assert said["speed_fluctuation_min_percent"] == pytest.approx(200 * np.sinh(excess), rel=1e-12)
    assert f"no yoke angles leave less than {said['speed_fluctuation_min_percent']:.2f} %" in " ".join(done.out.split())
    # cos x = cos 10° cos 12°, by hand: x = 15.57°.
    assert "at 15.57° instead of 25.00° the drive could be uniform" in " ".join(done.out.split())


def test_a_joint_that_bends_a_little_too_much_is_told_so(cardan, drive_file):
    """Two joints: the joint angle that closes is that of the other one."""
    path = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 20.1\n[[joints]]\njoint_angle_deg = 20\n")
    said = " ".join(cardan("phasing", path).out.split())
    assert "The angle of joint 1 is a little too large for the other one: at 20.00° instead of 20.10°" in said
    assert "▲" not in said


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ((), "A leaves the intermediate shafts the least fluctuation, B is its mirror image; C is nearest"),
        (("--goal", "nearest"), "A is nearest to the present yokes, B its mirror image; C leaves"),
        (("--fix", "2=90"), "A and B are mirror images"),
    ],
)
def test_letters_are_explained_and_mean_what_is_said(cardan, more, words):
    assert words in " ".join(cardan("phasing", TRUCK, *more).out.split())
    by_label = {row["label"]: row for row in cardan("phasing", TRUCK, *more, "--json").content["settings"]}
    # The shafts between the joints of a mirror image turn alike, except where a held yoke stands between two joints.
    if not more or more[0] == "--goal":
        a, b = (by_label[label]["shaft_speed_fluctuation_percent"][:-1] for label in "AB")
        np.testing.assert_allclose(a, b, rtol=1e-6)
        near = {label: np.linalg.norm(by_label[label]["change_deg"]) for label in "ABC"}
        calm = {label: sum(by_label[label]["shaft_speed_fluctuation_percent"][:-1]) for label in "ABC"}
        assert min(near, key=near.get) == ("A" if more else "C")
        assert min(calm.values()) == pytest.approx(calm["C" if more else "A"], rel=1e-9)


def test_a_goal_changes_the_choice(cardan):
    calm = cardan("phasing", TRUCK, "--json").content["settings"][1]
    near = cardan("phasing", TRUCK, "--goal", "nearest", "--json").content["settings"][1]
    assert np.linalg.norm(near["change_deg"]) < np.linalg.norm(calm["change_deg"])


def test_the_suggested_command_asks_the_same(cardan):
    out = cardan("phasing", TRUCK, "--fix", "2=90", "--goal", "nearest").out
    assert f"cardan phasing {TRUCK} --fix 2=90 --goal nearest --apply A -o better.toml" in out


def test_applying_a_setting_keeps_the_comments_and_makes_it_even(cardan, tmp_path):
    done = cardan("phasing", TRUCK, "--fix", "2=90", "--apply", "b", "-o", "better.toml")
    assert done.code == 0
    text = (tmp_path / "better.toml").read_text()
    for line in TRUCK.read_text().splitlines():
        if "#" in line:
            assert line in text
    even = files.load(tmp_path / "better.toml")
    assert float(equivalent_joint(even).speed_fluctuation) < 1e-13
    assert [round(shaft.yoke_angle / deg, 2) for shaft in even.shafts[1:-1]] == [90.0, 46.2, -2.81]
    assert "exactly uniformly" in " ".join(cardan("motion", "better.toml").out.split())


def test_applying_to_json_and_from_standard_input(cardan, tmp_path, monkeypatch):
    assert cardan("phasing", TRUCK, "-o", "better.json").code == 0
    assert float(equivalent_joint(files.load(tmp_path / "better.json")).speed_fluctuation) < 1e-13
    monkeypatch.setattr("sys.stdin", io.StringIO((tmp_path / "better.json").read_text()))
    assert cardan("phasing", "-", "--json").content["speed_fluctuation_as_specified_percent"] < 1e-11


def test_applying_over_the_file_itself(cardan, drive_file):
    path = drive_file(TRUCK.read_text())
    assert cardan("phasing", path, "-o", path).code == 0
    assert float(equivalent_joint(files.load(path)).speed_fluctuation) < 1e-13


def test_applying_over_another_file_needs_force(cardan, tmp_path):
    other = tmp_path / "other.toml"
    other.write_text("kept")
    done = cardan("phasing", TRUCK, "-o", "other.toml", "--json")
    assert done.code == 2
    assert done.complaint["problems"] == [{"field": "--out", "message": "other.toml exists; --force overwrites it"}]
    assert other.read_text() == "kept"
    assert cardan("phasing", TRUCK, "-o", "other.toml", "--force").code == 0
    assert float(equivalent_joint(files.load(other)).speed_fluctuation) < 1e-13


@pytest.mark.slow
def test_layout_moves_a_joint_within_its_box(cardan, drive_file, tmp_path):
    text = (EXAMPLES / "truck-printed-coordinates.toml").read_text()
    box = "centre_mm = [707, -57, 27]\nmove_within_mm = [[650, 760], [-100, 50], [0, 60]]  # free to move"
    path = drive_file(text.replace("centre_mm = [707, -57, 27]", box))
    assert path.read_text() != text
    said = cardan("phasing", path, "--layout", "-o", "moved.toml", "--json").content
    assert max(said["joint_angle_deg"]) < max(said["joint_angle_before_deg"])
    moved = files.load(tmp_path / "moved.toml")
    assert float(equivalent_joint(moved).speed_fluctuation) < 1e-12
    np.testing.assert_allclose(moved.joints[2].centre, np.asarray(said["points_mm"][3]) * mm, rtol=1e-12)
    assert "# free to move" in (tmp_path / "moved.toml").read_text()
    done = cardan("phasing", path, "--layout", "--fix", "2=90")
    assert done.code == 0
    assert "90.00" in done.out


BOXED = """
format = 1
input.point_mm = [-500, 0, 0]
output.point_mm = [2000, 0, -450]
[[joints]]
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [1000, 0, -150]
move_within_mm = [[1000, 1000], [0, 0], [-300, -50]]
[[poses]]
name = "low"
share_percent = 40
set = { "output.point_mm" = [2000, 0, -700] }
"""


@pytest.mark.slow
def test_layout_over_poses_writes_its_own_yokes(cardan, drive_file, tmp_path):
    path = drive_file(BOXED)
    said = cardan("phasing", path, "--layout", "--over", "mean", "-o", "moved.toml", "--json").content
    assert said["over"] == "mean"
    assert [one["condition"] for one in said["conditions"]] == ["as drawn", "pose low"]
    moved = files.load(tmp_path / "moved.toml")
    each = [float(equivalent_joint(one).speed_fluctuation) for one in (moved, pose_drives(moved)[0])]
    told = [one["speed_fluctuation_percent"] for one in said["conditions"]]
    assert told == pytest.approx(np.multiply(each, 100.0), abs=1e-6)  # angles are written with 12 decimals
    assert "belongs to --layout" in cardan("phasing", path, "--over", "mean").err


def test_settings_of_many_shafts_run_downwards(cardan, drive_file):
    path = drive_file("format = 1\n" + "[[joints]]\njoint_angle_deg = 9\n" * 13)
    out = cardan("phasing", path).out
    assert widest(out) <= 80
    assert "yoke of shaft" in out
    assert "A yoke 1° off adds at most" in out


@pytest.mark.slow
@pytest.mark.parametrize("path", MOVING, ids=lambda path: path.stem)
def test_a_moving_example_is_answered(cardan, path):
    done = cardan("articulation", path)
    assert done.code == 0
    assert widest(done.out) <= 80
    said = cardan("articulation", path, "--json").content
    table = rows(cardan("articulation", path, "--csv").out)
    assert [float(row["time_s"]) for row in table] == said["history"]["time_s"]
    worst = {(row["what"], row["number"]): row["value"] for row in said["worst"]}
    for row in said["joints"]:
        assert worst["joint_angle", row["number"]] >= row["joint_angle_max_deg"] - 1e-9


def test_a_spline_that_runs_out_fails(cardan, drive_file):
    path = drive_file((EXAMPLES / "pto-hitch.toml").read_text().replace("engaged_mm = 220", "engaged_mm = 101"))
    assert path.read_text() != (EXAMPLES / "pto-hitch.toml").read_text()
    path.write_text(path.read_text().replace("gap_mm = 130", "gap_mm = 3"))
    done = cardan("articulation", path)
    assert done.code == 1
    assert "✖" in done.out
    assert "failed" in done.out
    said = cardan("articulation", path, "--json")
    assert said.code == 1
    assert said.content["passed"] is False
    assert said.content["exit_code"] == 1


def test_a_time_span_may_be_given(cardan):
    times = cardan("articulation", MOVING[0], "--until", 1, "--step-s", 0.25, "--json").content["history"]["time_s"]
    assert times == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_a_drive_that_stands_still_has_no_articulation(cardan):
    done = cardan("articulation", TRUCK)
    assert done.code == 2
    assert "[[movements]]" in done.err


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".svg", ".png", ".pdf", ".html"])
@pytest.mark.parametrize(
    "question", [("motion", TRUCK), ("phasing", TRUCK), ("articulation", MOVING[0])], ids=lambda question: question[0]
)
def test_figures_are_drawn(cardan, tmp_path, question, suffix):
    done = cardan(*question, "--plot", f"figure{suffix}", "--json")
    assert done.code == 0
    assert done.content["plot"] == f"figure{suffix}"
    assert (tmp_path / f"figure{suffix}").stat().st_size > 5000


def test_a_steep_joint_is_warned_of(cardan, drive_file):
    done = cardan("motion", drive_file("format = 1\n[[joints]]\njoint_angle_deg = 50\n"))
    assert done.code == 0
    assert "Warning: joint 1 has a joint angle of 50.0°" in " ".join(done.out.split())


def test_a_name_of_any_length_fits(cardan, drive_file):
    path = drive_file(f'format = 1\nname = "{"long " * 60}"\n[[joints]]\njoint_angle_deg = 5\nname = "{"x" * 200}"\n')
    for question in ("motion", "phasing"):
        assert widest(cardan(question, path).out) <= 80
