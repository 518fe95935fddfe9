"""cardan losses: where power is lost, what was left out, and the map over speed and torque."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.questions.losses.losses import loss_map, losses
from cardan.units import rpm
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

TRUCK = EXAMPLES / "truck-supports.toml"
PTO = EXAMPLES / "pto-spline-thrust.toml"


@pytest.mark.slow
@pytest.mark.parametrize("path", [TRUCK, PTO], ids=lambda path: path.stem)
@pytest.mark.parametrize("options", [(), ("--map",)], ids=["parts", "map"])
def test_the_answer_stands_within_80_columns(cardan, path, options):
    done = cardan("losses", path, *options)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert done.out.startswith(files.load(path).name)


def test_json_is_the_losses(cardan):
    said = cardan("losses", TRUCK, "--json").content
    found = losses(files.load(TRUCK))
    assert said["efficiency"] == found.efficiency
    assert [row["power_loss_W"] for row in said["joints"]] == found.joints.tolist()
    assert [row["power_loss_W"] for row in said["supports"]] == found.supports.tolist()
    np.testing.assert_allclose(said["losses"]["joint_2_power_loss_W"], found.joint_power[1], rtol=1e-12)
    assert said["not_counted"][0]["field"] == "movements"


def test_the_parts_are_all_of_the_loss(cardan):
    """What enters and does not leave is the loss of the parts: the balance of a drive at steady running."""
    said = cardan("losses", TRUCK, "--json").content
    parts = [row["power_loss_W"] for key in ("joints", "supports") for row in said[key]]
    assert sum(parts) == pytest.approx(said["power_loss_W"], rel=1e-12)
    assert said["input_power_W"] - said["output_power_W"] == pytest.approx(said["power_loss_W"], rel=1e-9)
    assert said["efficiency"] == pytest.approx(said["output_power_W"] / said["input_power_W"], rel=1e-12)


def test_csv_and_json_agree(cardan):
    table = list(csv.DictReader(io.StringIO(cardan("losses", PTO, "--csv").out)))
    said = cardan("losses", PTO, "--json").content["losses"]
    assert {key: [float(row[key]) for row in table] for key in said} == said


@pytest.mark.slow
def test_the_map_is_that_of_the_library(cardan):
    table = list(csv.DictReader(io.StringIO(cardan("losses", TRUCK, "--map", "--csv").out)))
    found = loss_map(files.load(TRUCK))
    assert len(table) == found.heat.size
    np.testing.assert_allclose([float(row["power_loss_W"]) for row in table], found.heat.ravel(), rtol=1e-12)
    assert float(table[-1]["speed_rpm"]) == pytest.approx(2700.0)
    assert float(table[-1]["torque_Nm"]) == pytest.approx(2400.0)
    said = cardan("losses", TRUCK, "--map", "--json").content["map"]
    assert [float(row["efficiency"]) for row in table] == said["efficiency"]


def test_speed_and_torque_of_the_command_line_count(cardan):
    """Twice the speed is twice the loss where nothing has inertia; coasting rubs as much."""
    slow = cardan("losses", PTO, "--json").content
    fast = cardan("losses", PTO, "--speed-rpm", 1080, "--json").content
    assert fast["power_loss_W"] == pytest.approx(2 * slow["power_loss_W"], rel=1e-9)
    back = cardan("losses", PTO, "--torque-Nm", -400, "--json").content
    assert back["torque_Nm"] == -400
    assert 0.9 < back["efficiency"] < 1.0
    assert losses(files.load(PTO)).speed == pytest.approx(slow["speed_rpm"] * rpm)


def test_what_is_not_counted_is_told_in_one_line(cardan):
    out = plain(cardan("losses", PTO).out)
    assert "some power loss is not counted; the file lacks friction of supports 1 to 4." in out
    assert "the power loss of splines is not counted: they slide while the drive moves, as [[movements]] say" in out


def test_a_joint_that_locks_fails(cardan, drive_file):
    text = TRUCK.read_text().replace("friction = 0.02", "friction = 80")
    for options in ((), ("--map",)):
        done = cardan("losses", drive_file(text), *options)
        assert done.code == 1
        assert "✖" in done.out
        assert "friction locks joint" in plain(done.out)
    assert cardan("losses", drive_file(text), "--json").content["locked_joints"]


def test_a_drive_without_friction_is_told_every_key(cardan):
    done = cardan("losses", EXAMPLES / "six-joints.toml", "--json")
    assert (done.code, done.out) == (2, "")
    fields = [problem["field"] for problem in done.complaint["problems"]]
    assert "duty.torque_Nm" in fields
    assert "joints[0].friction" in fields


def test_a_span_is_asked_for_with_its_unit(cardan, drive_file):
    text = "format = 1\n[[joints]]\njoint_angle_deg = 20\nfriction = 0.1\n[duty]\ntorque_Nm = 1\n"
    done = cardan("losses", drive_file(text), "--json")
    fields = [problem["field"] for problem in done.complaint["problems"]]
    assert {"duty.speed_rpm", "joints[0].cross.span_mm"} <= set(fields)


def test_a_map_around_no_torque_is_refused(cardan):
    done = cardan("losses", TRUCK, "--map", "--torque-Nm", 0)
    assert (done.code, done.out) == (2, "")
    assert "--map: spans a tenth to one and a half of the torque, and that is 0" in done.err


@pytest.mark.slow
@pytest.mark.parametrize("options", [(), ("--map",)], ids=["parts", "map"])
def test_a_figure_is_drawn(cardan, tmp_path, options):
    assert cardan("losses", TRUCK, *options, "--plot", "losses.svg").code == 0
    assert (tmp_path / "losses.svg").stat().st_size > 1000
