"""cardan assembly: what misalignment loads, by how much, and what should be released?"""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.questions.forces.assembly import assembly
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

PUMP = EXAMPLES / "overconstrained-pump.toml"
TRUCK = EXAMPLES / "truck-supports.toml"
DRIVES = {path: files.load(path) for path in sorted(EXAMPLES.glob("*.toml"))}
HELD = [
    path
    for path, drive in DRIVES.items()
    if drive.supports and drive.duty.torque and all(joint.kind == "hooke" for joint in drive.joints)
]
"""Examples whose supports hold every shaft, and with joints that are answered for: those that ask for forces."""


@pytest.mark.parametrize("path", HELD, ids=lambda path: path.stem)
def test_every_held_example_is_answered_within_80_columns(cardan, path):
    done = cardan("assembly", path)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert files.load(path).name in plain(done.out)


def test_the_pump_binds_and_is_told_what_to_release(cardan, drive_file):
    out = plain(cardan("assembly", PUMP).out)
    found = assembly(files.load(PUMP))
    assert "statically indeterminate, degree 3; misalignment loads support 1 (motor, far)" in out
    assert found.spare == ("supports[3].axial", "supports[1].radial")
    assert "Statically determinate with supports[1] omitted and supports[3].axial = false." in out
    text = PUMP.read_text().replace("axial = true\nstiffness_N_per_um = 150\naxial_stiffness_N_per_um = 80\n", "")
    start, end = text.index('[[supports]]\nname = "motor, near"'), text.index('[[supports]]\nname = "pump, near"')
    assert len(text) < len(PUMP.read_text())
    done = cardan("assembly", drive_file(text[:start] + text[end:]))
    assert done.code == 0, done.err
    assert "statically determinate: no misalignment can load it." in plain(done.out)


def test_json_is_the_forces_of_assembly(cardan):
    said = cardan("assembly", PUMP, "--json").content
    found = assembly(files.load(PUMP))
    assert said["degree"] == found.degree
    assert said["release"] == list(found.spare)
    assert said["supports"][1]["release"] == "radial"
    assert [row["radial_max_N"] for row in said["supports"]] == [one.value for one in found.radial_peak]
    curves = said["forces"]
    for k in range(4):
        np.testing.assert_allclose(curves[f"support_{k + 1}_radial_N"], found.radial[k], rtol=1e-12)
        np.testing.assert_allclose(curves[f"support_{k + 1}_y_N"], found.reaction[k, :, 1], rtol=1e-12)
    np.testing.assert_allclose(curves["joint_1_gap_x_um"], found.gap[0, :, 0] * 1e6, rtol=1e-12)
    np.testing.assert_allclose(curves["torque_Nm"], found.torque, rtol=1e-12)


def test_csv_and_json_agree_at_angles_asked_for(cardan):
    options = ("--angle", 10, "--angle", -30)
    table = list(csv.DictReader(io.StringIO(cardan("assembly", PUMP, *options, "--csv").out)))
    said = cardan("assembly", PUMP, *options, "--json").content["forces"]
    assert said["angle_deg"] == pytest.approx([10.0, -30.0], rel=1e-12)
    assert {key: [float(row[key]) for row in table] for key in said} == said


def test_the_peaks_are_those_of_the_turn_whatever_angles_are_asked_for(cardan):
    few = cardan("assembly", PUMP, "--angle", 0, "--json").content
    assert few["supports"] == cardan("assembly", PUMP, "--json").content["supports"]


def test_parts_that_fit_do_not_strain(cardan, drive_file):
    text = "\n".join(line for line in PUMP.read_text().splitlines() if not line.startswith(("offset", "error")))
    out = plain(cardan("assembly", drive_file(text)).out)
    assert "as drawn all parts fit, and nothing is loaded" in out
    assert "Give offset_mm" in out


def test_a_rigid_shaft_is_told(cardan, drive_file):
    text = PUMP.read_text().replace("outer_mm = 35\n", "")
    assert text != PUMP.read_text()
    assert "Shaft 2 counts as rigid, as outer_mm is not given" in plain(cardan("assembly", drive_file(text)).out)


def test_missing_supports_are_named(cardan):
    done = cardan("assembly", EXAMPLES / "six-joints.toml")
    assert (done.code, done.out) == (2, "")
    assert "six-joints.toml: supports: missing" in done.err


def test_missing_stiffness_names_its_keys(cardan, drive_file):
    text = "\n".join(line for line in PUMP.read_text().splitlines() if "stiffness" not in line)
    done = cardan("assembly", drive_file(text), "--json")
    assert (done.code, done.out) == (2, "")
    fields = [problem["field"] for problem in done.complaint["problems"]]
    assert "supports[0].stiffness_N_per_um" in fields
    assert "supports[3].axial_stiffness_N_per_um" in fields


def test_a_figure_is_drawn(cardan, tmp_path):
    assert cardan("assembly", PUMP, "--plot", "misalignment.svg").code == 0
    assert (tmp_path / "misalignment.svg").stat().st_size > 1000


def without(text, *names):
    """Return a drive file without some supports."""
    first, *blocks = text.split("[[supports]]")
    last = blocks[-1].partition("[duty]")
    blocks[-1] = last[0]
    kept = [block for block in blocks if not any(f'name = "{name}"' in block for name in names)]
    return first + "".join(f"[[supports]]{block}" for block in kept) + last[1] + last[2]


def test_nothing_is_promised_that_a_release_does_not_hold(cardan, drive_file):
    # Both axial holds gone, one force stays too many and no bearing can go without freeing a shaft.
    text = PUMP.read_text().replace("axial = true\n", "").replace("axial_stiffness_N_per_um = 100\n", "")
    text = text.replace("axial_stiffness_N_per_um = 80\n", "")
    path = drive_file(text)
    out = " ".join(plain(cardan("assembly", path).out).split())
    assert "statically indeterminate, degree 1" in out
    assert "No support can be released without freeing a shaft" in out
    assert "Statically determinate with" not in out
    said = cardan("assembly", path, "--json").content
    assert (said["release"], said["degree_left"]) == ([], 1)
    assert cardan("assembly", PUMP, "--json").content["degree_left"] == 0
