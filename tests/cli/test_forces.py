"""cardan forces: the same answer for the eye, as JSON, as CSV and as a figure."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.drive.duty import Duty
from cardan.questions.forces.forces import forces
from cardan.units import deg, rpm
from tests.cli.conftest import EXAMPLES

TRUCK = EXAMPLES / "truck-supports.toml"
PTO = EXAMPLES / "pto-spline-thrust.toml"
PUMP = EXAMPLES / "overconstrained-pump.toml"
LOADED = [path for path in sorted(EXAMPLES.glob("*.toml")) if files.load(path).duty.torque]
EQUAL = {"rtol": 1e-12, "atol": 1e-9}
"""Printed in full precision: what is read back differs by the conversion of units alone."""


def widest(text):
    """Return the width of the longest line; a command to be copied is never broken and does not count."""
    return max(len(line) for line in text.splitlines() if not line.startswith("    cardan"))


def plain(text):
    """Return a text in one line with plain blanks."""
    return " ".join(text.split())


@pytest.mark.slow
@pytest.mark.parametrize("path", LOADED, ids=lambda path: path.stem)
def test_every_loaded_example_is_answered_within_80_columns(cardan, path):
    done = cardan("forces", path)
    assert done.code == 0, done.err
    assert done.err == ""
    assert widest(done.out) <= 80
    assert done.out.startswith(files.load(path).name)


def test_json_is_the_forces(cardan):
    said = cardan("forces", TRUCK, "--json").content
    found = forces(files.load(TRUCK))
    curves = said["forces"]
    np.testing.assert_allclose(np.asarray(curves["angle_deg"]) * deg, found.angle, rtol=1e-12, atol=1e-12)
    for k in range(4):
        np.testing.assert_allclose(curves[f"shaft_{k + 1}_torque_Nm"], found.shaft_torque[k], **EQUAL)
        np.testing.assert_allclose(
            curves[f"shaft_{k + 1}_secondary_couple_y_Nm"], found.secondary_couple[k, :, 1], **EQUAL
        )
    for k in range(5):
        np.testing.assert_allclose(curves[f"support_{k + 1}_z_N"], found.reaction[k, :, 2], **EQUAL)
        np.testing.assert_allclose(curves[f"support_{k + 1}_axial_N"], found.axial[k], **EQUAL)
    np.testing.assert_allclose(curves["joint_2_driven_a_journal_N"], found.journals.size[1, :, 2], **EQUAL)
    back = said["forces_sliding_back"]
    np.testing.assert_allclose(back["support_1_axial_N"], found.reverse.axial[0], **EQUAL)
    assert said["power_left"] < 1e-10
    assert said["status"] == "determinate"


def test_the_order_of_calculating_by_hand_is_told(cardan):
    assert "the reactions follow from shaft 3, then 4, then 2, then 1." in plain(cardan("forces", TRUCK).out)
    assert cardan("forces", TRUCK, "--json").content["solving_order"] == [[3], [4], [2], [1]]
    pump = EXAMPLES / "overconstrained-pump.toml"
    assert "By hand" not in cardan("forces", pump).out
    assert cardan("forces", pump, "--json").content["solving_order"] == []


def test_extremes_of_the_supports_hold_both_ways_of_sliding(cardan):
    """The table bounds every curve, of both senses of friction in the spline."""
    said = cardan("forces", TRUCK, "--json").content
    for row in said["supports"]:
        k = row["number"]
        for curves in (said["forces"], said["forces_sliding_back"]):
            assert row["radial_max_N"] >= max(curves[f"support_{k}_radial_N"]) - 1e-6
            assert row["radial_min_N"] <= min(curves[f"support_{k}_radial_N"]) + 1e-6
            if row["axial_max_N"] is not None:
                assert row["axial_max_N"] >= max(curves[f"support_{k}_axial_N"]) - 1e-6
                assert row["axial_min_N"] <= min(curves[f"support_{k}_axial_N"]) + 1e-6


def test_csv_and_json_agree(cardan):
    table = list(csv.DictReader(io.StringIO(cardan("forces", PTO, "--csv").out)))
    said = cardan("forces", PTO, "--json").content["forces"]
    assert len(table) == 361
    assert {key: [float(row[key]) for row in table] for key in said} == said


def test_torque_speed_and_angles_of_the_command_line_count(cardan):
    options = ("--torque-Nm", -250, "--speed-rpm", 900, "--angle", 10, "--angle", 75)
    said = cardan("forces", TRUCK, *options, "--json").content
    found = forces(files.load(TRUCK), Duty(torque=-250.0, speed=900 * rpm), np.asarray([10.0, 75.0]) * deg)
    np.testing.assert_allclose(said["forces"]["support_4_axial_N"], found.axial[3], **EQUAL)
    assert (said["torque_Nm"], said["speed_rpm"]) == (-250.0, pytest.approx(900.0))


def test_one_joint_against_its_closed_form(cardan, drive_file):
    """Torque T/i with i from cos α to 1/cos α; couples T tan α on the input and T sin α on the output at most."""
    path = drive_file("format = 1\n[[joints]]\njoint_angle_deg = 20\n[duty]\ntorque_Nm = 100\n")
    first, second = cardan("forces", path, "--json").content["shafts"]
    assert first["torque_min_Nm"] == pytest.approx(100 * np.cos(20 * deg), rel=1e-9)
    assert first["torque_max_Nm"] == pytest.approx(100 / np.cos(20 * deg), rel=1e-9)
    assert second["secondary_couple_max_Nm"] == pytest.approx(100 * np.tan(20 * deg), rel=1e-9)
    assert second["secondary_couple_max_at_deg"] % 180 == pytest.approx(0.0, abs=1e-3)
    assert first["secondary_couple_max_Nm"] == pytest.approx(100 * np.sin(20 * deg), rel=1e-9)
    out = cardan("forces", path).out
    assert "need 93.97 to 106.4 N·m at the input" in plain(out)
    assert "Add [[supports]]" in plain(out)
    assert "joint" not in out.split("\n\n")[1]


def test_torque_at_the_input_tells_that_of_the_output(cardan, drive_file):
    text = "format = 1\n[[joints]]\njoint_angle_deg = 20\n[duty]\ntorque_Nm = 100\ntorque_at = 'input'\n"
    out = plain(cardan("forces", drive_file(text)).out)
    assert "100.0 N·m at the input meet 93.97 to 106.4 N·m at the output" in out


def test_held_too_much_is_shared_by_stiffness_and_says_so(cardan):
    done = cardan("forces", PUMP)
    assert done.code == 0
    assert "▲ Warning: statically indeterminate, degree 3" in plain(done.out)
    assert f"cardan assembly {PUMP}" in done.out
    assert cardan("forces", PUMP, "--json").content["status"] == "indeterminate"


def test_missing_torque_names_its_key(cardan):
    done = cardan("forces", EXAMPLES / "single-20deg.toml")
    assert (done.code, done.out) == (2, "")
    assert "single-20deg.toml: duty.torque_Nm: missing" in done.err
    assert "--torque-Nm" in done.err


def test_missing_stiffness_names_its_keys(cardan, drive_file):
    text = "\n".join(line for line in PUMP.read_text().splitlines() if "stiffness" not in line)
    done = cardan("forces", drive_file(text), "--json")
    assert (done.code, done.out) == (2, "")
    (problem,) = done.complaint["problems"]
    assert "3 forces or couples more than statics can tell" in problem["message"]
    for key in ("supports[0].stiffness_N_per_um", "supports[3].axial_stiffness_N_per_um"):
        assert key in problem["message"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--torque-Nm", "nan"), "--torque-Nm: nan is not a finite number"),
        (("--torque-Nm", "1e300"), "--torque-Nm: 1e+300 is not allowed"),
        (("--speed-rpm", "inf"), "--speed-rpm: inf is not a finite number"),
        (("--angle", "3", "--angle-step", "4"), "choose --angle-deg or --angle-step-deg"),
        (("--json", "--csv"), "choose --json or --csv"),
    ],
)
def test_bad_options_are_refused(cardan, options, said):
    done = cardan("forces", TRUCK, *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err


def test_a_figure_is_drawn(cardan, tmp_path):
    assert cardan("forces", TRUCK, "--plot", "forces.svg").code == 0
    assert (tmp_path / "forces.svg").read_text().lstrip().startswith("<?xml")


def test_locked_joints_are_refused_by_name(cardan, drive_file):
    # κ tan α with κ = 40 · 24/98: 0.67 in joint 1, which bends half as much as the others.
    done = cardan("forces", drive_file(TRUCK.read_text().replace("friction = 0.02\n", "friction = 40\n")), "--json")
    assert (done.code, done.out) == (2, "")
    assert [one["field"] for one in done.complaint["problems"]] == ["joints[1].friction", "joints[2].friction"]


def test_friction_without_a_journal_is_told_not_to_count(cardan, drive_file):
    text = TRUCK.read_text().replace(", journal_mm = 24", "", 1)
    done = cardan("forces", drive_file(text))
    assert "Warning: friction of joint 1 (gearbox) does not count: cross.span_mm or cross.journal_mm" in plain(done.out)
    assert "does not count" not in cardan("forces", TRUCK).out
    rows = cardan("forces", drive_file(text), "--json").content["joints"]
    assert rows[0]["power_loss_mean_W"] is None
    assert rows[1]["power_loss_mean_W"] > 0.0
