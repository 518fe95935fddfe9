"""cardan joint: kinds by themselves and beside each other, read with the keys of the drive file."""

import csv
import io

import numpy as np
import pytest

from cardan.drive.joints import JOINTS
from cardan.joints import Clemens, ClemensProfile, DoubleCardan
from cardan.questions.motion.joint_law import joint_turn
from cardan.units import deg, mm
from tests.cli.test_forces import plain, widest

DOUBLE = ("double_cardan", "centring_ratio=0.5")
SEVERAL = ("hooke", *DOUBLE, "tracta", "driving_distance_mm=20", "driven_distance_mm=21", "--joint-angle-deg", 25)


@pytest.mark.parametrize("words", [(), DOUBLE, (*SEVERAL, "--speed-rpm", 1000), ("weiss", "--speed-rpm", 900)])
def test_the_answer_stands_within_80_columns(cardan, words):
    done = cardan("joint", *words)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80


def test_all_kinds_are_listed_with_their_keys(cardan):
    said = cardan("joint", "--json").content
    assert [one["kind"] for one in said["kinds"]] == list(JOINTS)
    keys = {one["kind"]: [key["key"] for key in one["keys"]] for one in said["kinds"]}
    assert keys["hooke"] == []
    assert keys["pin_coupling"] == [
        "driving_slant_deg",
        "driven_slant_deg",
        "driving_distance_mm",
        "driven_distance_mm",
        "pin_diameter_mm",
    ]
    assert "centre_mm" not in {key for several in keys.values() for key in several}
    table = list(csv.DictReader(io.StringIO(cardan("joint", "--csv").out)))
    assert [row["kind"] for row in table] == list(JOINTS)


@pytest.mark.parametrize("number", [".5", "+0.5", "5e-1"])
def test_numbers_are_read_as_people_write_them(cardan, number):
    usual = cardan("joint", *DOUBLE, "--json").content
    assert cardan("joint", DOUBLE[0], f"centring_ratio={number}", "--json").content == usual


def test_json_is_the_law(cardan):
    said = cardan("joint", *DOUBLE, "--joint-angle-deg", 30, "--speed-rpm", 600, "--json").content
    (one,) = said["joints"]
    found = joint_turn(DoubleCardan(centring_ratio=0.5), 30 * deg)
    np.testing.assert_allclose(one["turn"]["ratio"], found.ratio, rtol=1e-14)
    assert one["angle_error_deg"] == pytest.approx(found.error / deg)
    assert one["acceleration_rad_s2"] == pytest.approx(found.acceleration * (20 * np.pi) ** 2)
    assert one["inside"]["driving_joint_angle_deg"] + one["inside"]["driven_joint_angle_deg"] == pytest.approx(30)
    assert one["types"] == ["double_centred", "double_frame"]
    assert one["sizes"] == {"centring_ratio": 0.5}


def test_csv_holds_the_curves_of_all(cardan):
    rows = list(csv.DictReader(io.StringIO(cardan("joint", *SEVERAL, "--csv").out)))
    assert len(rows) == 721
    assert {"angle_deg", "hooke_ratio", "double_cardan_angle_error_deg", "tracta_slope"} <= set(rows[0])
    assert max(float(row["hooke_ratio"]) for row in rows) == pytest.approx(1 / np.cos(25 * deg))


def test_tables_within_keys_are_read(cardan):
    words = [f"driving.{key}" for key in ("axial_mm=60", "radial_mm=10", "radius_mm=75")]
    words += [f"driven.{key}" for key in ("axial_mm=62", "radial_mm=11", "radius_mm=74")]
    said = cardan("joint", "clemens", *words, "--joint-angle-deg", 30, "--json").content
    arms = [ClemensProfile(axial=h * mm, radial=r * mm, radius=rho * mm) for h, r, rho in ((60, 10, 75), (62, 11, 74))]
    found = joint_turn(Clemens(driving=arms[0], driven=arms[1]), 30 * deg)
    assert said["joints"][0]["angle_error_deg"] == pytest.approx(found.error / deg)


def test_joints_of_one_kind_are_told_apart(cardan):
    said = cardan("joint", "double_cardan", "centring_ratio=0.5", "double_cardan", "--json").content
    assert [one["name"] for one in said["joints"]] == ["double_cardan centring_ratio=0.5", "double_cardan"]


def test_bends_and_speeds_beyond_what_is_built_are_told(cardan):
    out = plain(cardan("joint", "tripod", "track_radius_mm=20", "--joint-angle-deg", 40).out)
    assert "real joints of this kind work to 26.0° only" in out
    assert "✖ joint angle too large" in out
    out = plain(cardan("joint", "weiss", "--joint-angle-deg", 30, "--speed-rpm", 1500).out)
    assert "✖ too fast at this joint angle" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("hoke",), "hoke: there is no such kind of joint; did you mean hooke?"),
        (("x=3",), "x: name a kind of joint first"),
        (("rzeppa", "balls=6", "balls=8"), "rzeppa.balls: given twice"),
        (("clemens", "driving=3", "driving.radius_mm=3"), "clemens.driving.radius_mm: given twice"),
        (("offset_cross",), "offset_cross.reach_mm: missing"),
        (("rzeppa", "lever_b=0.35"), "rzeppa.lever_c: missing"),
        (("tripod", "track_radius=20"), "tripod.track_radius"),
        (("double_cardan", "centring_ratio=2"), "double_cardan.centring_ratio"),
        (("hooke", "joint_angle_deg=20"), "hooke.joint_angle_deg: means nothing for a joint by itself"),
        (("hooke", "--joint-angle-deg", 90), "--joint-angle-deg: 90° is not at least 0° and below 90°"),
        (("hooke", "--joint-angle-deg", "nan"), "--joint-angle-deg: nan is not a finite number"),
        (
            ("pin_coupling", "driving_slant_deg=10", "--joint-angle-deg", 45),
            "--joint-angle-deg: a joint of kind pin_coupling",
        ),
    ],
)
def test_what_is_refused_is_named(cardan, words, said):
    done = cardan("joint", *words)
    assert (done.code, done.out) == (2, "")
    assert said in plain(done.err)


def test_a_figure_is_drawn(cardan, tmp_path):
    assert cardan("joint", *SEVERAL, "--plot", "joints.svg").code == 0
    assert (tmp_path / "joints.svg").stat().st_size > 1000
