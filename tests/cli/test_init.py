"""init: a file to start from by what the drive is for, by points or by slopes; refusals write nothing."""

import math

import pytest

from cardan.io import load
from cardan.io.examples import TEMPLATES


@pytest.mark.parametrize("use", TEMPLATES)
def test_a_template_loads_under_the_name_of_its_file(cardan, tmp_path, use):
    place = tmp_path / "my drive.toml"
    assert cardan("init", place, "--for", use).code == 0
    assert load(place).name == "my drive"
    assert place.read_text("utf8").startswith("# Put your own numbers in")


def test_points_become_joint_centres_in_the_units_of_their_columns(cardan, tmp_path):
    (tmp_path / "centres.csv").write_text("x_mm,y_in,z_mm\n0,0,0\n500,0,0\n1500,2,-100\n2000,2,-100\n")
    assert cardan("init", tmp_path / "a.toml", "--from-points", tmp_path / "centres.csv").code == 0
    drive = load(tmp_path / "a.toml")
    assert drive.joints[0].centre == pytest.approx((0.5, 0.0, 0.0))
    assert drive.joints[1].centre == pytest.approx((1.5, 0.0508, -0.1))
    assert drive.output.point == pytest.approx((2.0, 0.0508, -0.1))


def test_slopes_become_shafts(cardan, tmp_path):
    (tmp_path / "s.csv").write_text("length_mm,side_slope_deg,plan_slope_deg\n300,0,0\n1200,-5,2\n300,0,0\n")
    told = cardan("init", tmp_path / "a.toml", "--from-slopes", tmp_path / "s.csv")
    assert told.code == 0
    assert "Add speed and torque, then" in told.out
    assert "cardan keys duty" in (tmp_path / "a.toml").read_text("utf8").splitlines()[0]
    shaft = load(tmp_path / "a.toml").shafts[1]
    assert (shaft.length, shaft.side_slope, shaft.plan_slope) == pytest.approx((1.2, *map(math.radians, (-5, 2))))


def test_refusals_name_what_is_wrong_and_write_nothing(cardan, tmp_path):
    (tmp_path / "c.csv").write_text("x_mm,y_mm\n0,0\n")
    place = tmp_path / "a.toml"
    assert "excludes --for" in cardan("init", place, "--for", "pto", "--from-points", tmp_path / "c.csv").err
    assert "'ptoo' is none of" in cardan("init", place, "--for", "ptoo").err
    assert "no column z_mm" in cardan("init", place, "--from-points", tmp_path / "c.csv").err
    assert "cannot be read" in cardan("init", place, "--from-slopes", tmp_path / "none.csv").err
    assert not place.exists()
