"""Every shipped example loads, moves and shows what its comment says."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from cardan import apply_remedy, articulation, assembly, check, equivalent_joint, example, motion, phases, remedies
from cardan.drive.fields.paths import pose_drives
from cardan.drive.models.geometry import geometry
from cardan.io import example_names, example_text, loads, starter
from cardan.questions.motion.turning import each_shaft

NAMES = example_names()
SPINDLES = ("rolling-mill-lower-spindle", "rolling-mill-upper-spindle")


def test_all_of_them_are_there() -> None:
    assert set(NAMES) >= {
        "car-propshaft",
        "composite-propshaft",
        "instrument-joint",
        "mill-spindle",
        "overconstrained-pump",
        "pickup-two-piece",
        "pto-baler",
        "pto-drive",
        "pto-hitch",
        "pto-spline-thrust",
        *SPINDLES,
        "cured-drive",
        "front-halfshaft",
        "pto-flywheel",
        "pto-flywheel-absorber",
        "single-20deg",
        "six-joints",
        "thompson-drive",
        "three-joints-unequal",
        "tracta-steered-axle",
        "truck-duty-cycle",
        "truck-exact-yokes",
        "truck-power-unit",
        "truck-printed-angles",
        "truck-printed-coordinates",
        "truck-rear-axle",
        "truck-supports",
        "truck-wrong-yokes",
        "two-piece-rear-drive",
        "two-piece-rubber-bearing",
        "unstable-drive",
        "w-arrangement",
        "z-arrangement",
    }


@pytest.mark.parametrize("name", NAMES)
def test_moves_and_says_what_it_is(name: str) -> None:
    drive = example(name)
    found = motion(drive)
    assert drive.name
    assert drive.duty.speed
    assert np.all(np.isfinite(found.shaft_acceleration))
    # A turn of the input is a turn of the output; sums of some 1e-16 over a handful of joints.
    assert found.output_angle[-1] == pytest.approx(2 * math.pi, abs=1e-13)
    assert np.all(geometry(drive).joint_angle < math.radians(45))
    assert len(pose_drives(drive)) == len(drive.poses)
    if drive.movements:
        assert np.all(np.isfinite(articulation(drive).joint_angle))


def speed_fluctuation(name: str) -> float:
    return float(equivalent_joint(example(name)).speed_fluctuation)


def test_joints_of_constant_velocity_are_even_as_far_as_they_are_made_so() -> None:
    wobbling = each_shaft(example("front-halfshaft"))  # its tripod makes the shaft nutate, three times a turn
    assert 2e-4 < wobbling.speed_fluctuation[-1] < 2.2e-4
    assert [order for order, _wave in wobbling.orders(1)] == [3]
    assert speed_fluctuation("tracta-steered-axle") == pytest.approx(0.0070045843794651706, rel=1e-12)
    same = equivalent_joint(example("tracta-steered-axle")).joint_angle
    assert math.degrees(same) == pytest.approx(4.8, abs=0.05)


def test_a_double_cardan_joint_centred_by_its_ball_is_nearly_even() -> None:
    """Δ = arcsin(λ sin α) - α/2, δ ≈ 4 |Δ| tan(α/2); the approximation leaves the square of a small angle."""
    joint_angle = math.radians(16.0)
    miss = math.asin(0.5 * math.sin(joint_angle)) - 0.5 * joint_angle
    share = equivalent_joint(example("double-cardan-propshaft")).shaft_speed_fluctuation[0]
    assert share == pytest.approx(4.0 * abs(miss) * math.tan(0.5 * joint_angle), rel=1e-2)


def test_crosses_undo_each_other_across_a_rzeppa_joint() -> None:
    from cardan import forces

    drive = example("propshaft-with-rzeppa")
    assert equivalent_joint(drive).speed_fluctuation < 1e-7  # the points are rounded to a tenth of a micrometre
    found = forces(drive)
    torque = found.shaft_torque[1] / found.joint_torque[1]
    joint_angle = geometry(drive).joint_angle[1]
    assert torque == pytest.approx(
        np.full(torque.shape, math.cos(0.5 * joint_angle)), rel=1e-2
    )  # inertia of the shaft beside


def test_single_joint_is_that_of_table_4() -> None:
    found = equivalent_joint(example("single-20deg"))
    assert found.speed_fluctuation == pytest.approx(math.sin(math.radians(20)) * math.tan(math.radians(20)), rel=1e-13)
    assert math.degrees(found.max_angle_error) == pytest.approx(1 + 46.9 / 60, abs=0.05 / 60)  # printed to 0.1'


def test_truck_power_unit_is_the_one_of_the_book() -> None:
    joint_angles = np.degrees(geometry(example("truck-printed-coordinates")).joint_angle)
    printed = [10 + 13.9 / 60, 15 + 27.2 / 60, 15 + 50.0 / 60, 14 + 11.0 / 60]
    np.testing.assert_allclose(joint_angles, printed, atol=0.06 / 60)  # worked out to 0.1'
    assert speed_fluctuation("truck-printed-coordinates") == pytest.approx(0.09471, abs=5e-6)
    assert speed_fluctuation("truck-printed-angles") == pytest.approx(0.12512, abs=5e-6)
    assert speed_fluctuation("truck-wrong-yokes") == pytest.approx(0.1140, abs=5e-5)
    for name in ("truck-printed-angles", "truck-wrong-yokes", "truck-exact-yokes"):
        drive = example(name)
        np.testing.assert_allclose(np.degrees([j.joint_angle for j in drive.joints]), [11.5, 15 + 1 / 3, 15.0, 16.5])


def test_exact_yokes_leave_rounding_only() -> None:
    # Yoke angles with all digits: 16 roundings of 1e-16 at most in a product of four matrices.
    assert speed_fluctuation("truck-exact-yokes") < 1e-15
    assert example("truck-exact-yokes").shafts[2].yoke_angle == pytest.approx(math.radians(-1.69992), abs=1e-7)
    assert example("truck-exact-yokes").shafts[3].yoke_angle == pytest.approx(math.radians(82.84475), abs=1e-7)


def test_splines_of_the_truck_leave_half_a_percent() -> None:
    found = phases(example("truck-printed-angles"), fixed={2: math.pi / 2})
    assert found.spline_settings[0].speed_fluctuation == pytest.approx(0.005227, abs=5e-7)
    assert {round(math.degrees(a)) for a in found.spline_settings[0].yoke_angle} == {90, 45, 0}


@pytest.mark.parametrize("name", ["z-arrangement", "w-arrangement", "pto-hitch", *SPINDLES])
def test_equal_bends_with_yokes_in_line_are_even(name: str) -> None:
    assert speed_fluctuation(name) < 1e-14  # bends from coordinates agree to rounding
    for posed in pose_drives(example(name)):
        assert equivalent_joint(posed).speed_fluctuation < 1e-14


def test_arrangements_are_what_they_are_called() -> None:
    assert abs(geometry(example("z-arrangement")).plane_twist[0]) == pytest.approx(math.pi, abs=1e-12)
    assert geometry(example("w-arrangement")).plane_twist[0] == pytest.approx(0.0, abs=1e-12)


def test_a_bend_too_steep_cannot_be_made_even() -> None:
    found = phases(example("three-joints-unequal"))
    least = math.cos(math.radians(10)) ** 2 / math.cos(math.radians(25))
    assert not found.feasible
    assert found.speed_fluctuation_min == pytest.approx(least - 1 / least, rel=1e-12)


@pytest.mark.parametrize("name", ["two-piece-rear-drive", "truck-printed-coordinates", "six-joints"])
def test_the_others_can_be_made_even(name: str) -> None:
    found = phases(example(name))
    assert found.feasible
    assert found.settings[0].speed_fluctuation < 1e-14


@pytest.mark.parametrize("name", ["truck-supports", "pto-spline-thrust", "instrument-joint"])
def test_what_is_held_just_enough_is_not_strained(name: str) -> None:
    assert assembly(example(name)).degree == 0


def test_the_pump_in_four_bearings_binds() -> None:
    found = assembly(example("overconstrained-pump"))
    assert found.degree == 3
    assert found.spare == ("supports[3].axial", "supports[1].radial")
    assert found.joint_peak[0].value > 2000.0
    assert found.residual < 1e-12  # sums of a handful of forces


@pytest.mark.parametrize("name", ["car-propshaft", "pto-drive", "mill-spindle", "composite-propshaft"])
def test_drives_that_are_fit_keep_all_their_limits(name: str) -> None:
    found = [one for one in check(example(name)) if one.run and not one.advice]
    assert len(found) > 20
    assert {one.state for one in found} <= {"passed", "unconfirmed"}


@pytest.mark.slow
def test_the_axle_joint_of_the_truck_is_too_small_and_the_next_size_is_not() -> None:
    drive = example("truck-duty-cycle")
    found = check(drive)
    failed = {(one.check, one.subject) for one in found if one.state == "failed" and not one.advice}
    assert failed == {("bearing_life", "joints[2]"), ("rated_torque", "joints[2]"), ("acceleration", "shafts[3]")}
    best = next(one for one in remedies(drive, found) if one.check == "bearing_life")
    assert (best.path, best.value, best.breaks) == ("joints[2].size", "example-180", ())
    left = {one.check for one in check(apply_remedy(drive, best)) if one.state == "failed" and not one.advice}
    assert left == {"acceleration"}  # of the yokes, whatever the joint


@pytest.mark.parametrize("name", NAMES)
def test_comes_with_a_header_that_explains(name: str) -> None:
    lines = example_text(name).splitlines()
    header = [line for line in lines[: lines.index("")] if line.startswith("#")]
    assert len(" ".join(header)) > 100
    assert all(len(line) <= 120 for line in lines)


def test_every_form_of_the_starter_loads() -> None:
    head, *blocks = re.split(r"(?m)^# --- (?=.)", starter())
    points, extras, joint_angles, slopes, moving = blocks

    def open_up(block: str) -> str:
        return re.sub(r"(?m)^# ?", "", block.split("\n", 1)[1])

    assert loads(head + open_up(points) + extras.split("\n", 1)[1]).form == "points"
    assert loads(starter() + open_up(moving)).movements
    assert loads(head + open_up(joint_angles)).form == "angles"
    assert loads(head + open_up(slopes)).form == "slopes"
