"""cardan forces --movement: what a drive carries while it moves."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.questions.forces.moving_forces import moving_forces
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

PTO = (EXAMPLES / "pto-spline-thrust.toml").read_text()
HITCH = """
[[movements]]
name = "headland"
kind = "hitch"
moves = ["joints[1]", "output"]
pivot_mm = [470, 0, -300]
yaw_deg = 20
pitch_deg = 4
frequency_Hz = 0.5

[[movements]]
kind = "harmonic"
moves = ["output"]
amplitude_mm = [0, 0, 5]
frequency_Hz = 1
"""


@pytest.fixture
def tractor(drive_file):
    return drive_file(PTO + HITCH, "tractor.toml")


def test_the_answer_stands_within_80_columns(cardan, tractor):
    done = cardan("forces", tractor, "--movement", "all")
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert "2 movements over 2.00 s, 18 turns of the input" in plain(done.out)
    assert f"cardan forces {tractor}" in done.out


def test_json_csv_and_the_analysis_agree(cardan, tractor):
    said = cardan("forces", tractor, "--movement", "headland", "--json").content
    drive = files.load(tractor)
    found = moving_forces(drive, None, drive.movements[:1])
    assert said["movements"] == ["headland"]
    assert said["complete"] is True
    # Printed in full precision.
    np.testing.assert_allclose(
        [row["radial_max_N"] for row in said["supports"]], np.max(found.forces.radial, axis=-1), rtol=1e-12
    )
    assert said["supports"][1]["axial_max_N"] is None
    table = list(csv.DictReader(io.StringIO(cardan("forces", tractor, "--movement", 1, "--csv").out)))
    assert len(table) == 18
    assert {key: [float(row[key]) for row in table] for key in table[0]} == said["each_turn"]
    low, high = found.each_turn(found.forces.axial[0])
    np.testing.assert_allclose(said["each_turn"]["support_1_axial_min_N"], low, rtol=1e-12)
    np.testing.assert_allclose(said["each_turn"]["support_1_axial_max_N"], high, rtol=1e-12)


def test_a_bend_that_no_joint_stands_is_warned_of(cardan, drive_file):
    path = drive_file(PTO + HITCH.replace("yaw_deg = 20", "yaw_deg = 100"))
    assert "Warning: a joint angle reaches" in plain(cardan("forces", path, "--movement", "all").out)


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        (PTO, ("--movement", "all"), "--movement: the file has no [[movements]]"),
        (PTO + HITCH, ("--movement", "x"), "--movement: there is no movement 'x'; there is 1 headland, 2, or all"),
        (PTO + HITCH, ("--movement", 1, "--angle", 3), "--movement: is followed in time"),
        (PTO.replace("speed_rpm = 540\n", "") + HITCH, ("--movement", 1), "duty.speed_rpm: missing"),
    ],
)
def test_what_cannot_be_followed_is_refused(cardan, drive_file, text, options, said):
    done = cardan("forces", drive_file(text), *options)
    assert (done.code, done.out) == (2, "")
    assert said in done.err


def test_a_figure_is_drawn(cardan, tractor, tmp_path):
    assert cardan("forces", tractor, "--movement", "all", "--plot", "moving.svg").code == 0
    assert (tmp_path / "moving.svg").stat().st_size > 1000
