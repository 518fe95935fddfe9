"""Centres, bends and slopes describe the same drive."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, equivalent_joint, forces, motion
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import geometry, in_form
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support

RNG = np.random.default_rng(7)


def spatial(n: int) -> Drive:
    steps = RNG.uniform([0.2, -0.15, -0.15], [1.0, 0.15, 0.15], (n + 2, 3))
    yokes = RNG.uniform(-1.5, 1.5, n - 1)
    return Drive.from_points(np.cumsum(steps, axis=0).tolist(), yoke_angles=yokes.tolist(), start_phase=0.3)


@pytest.mark.parametrize("n", range(1, 7))
@pytest.mark.parametrize("form", ["points", "angles", "slopes"])
@pytest.mark.parametrize("back", ["points", "angles", "slopes"])
def test_motion_is_the_same_in_every_form(n: int, form: str, back: str) -> None:
    drive = spatial(n)
    other = in_form(in_form(drive, form), back)  # type: ignore[arg-type]
    assert other.form == back
    # The forms go through sines and cosines of the bends: some roundings of 1e-16 each.
    np.testing.assert_allclose(motion(other).shaft_angle, motion(drive).shaft_angle, atol=1e-13)
    np.testing.assert_allclose(geometry(other).length, geometry(drive).length, rtol=1e-13)
    assert equivalent_joint(other).speed_fluctuation == pytest.approx(
        float(equivalent_joint(drive).speed_fluctuation), abs=1e-14
    )


def test_bends_of_a_level_input_shaft_keep_the_drive_in_place() -> None:
    drive = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0.1, -0.2), (2, 0.3, -0.2)])
    again = in_form(in_form(drive, "angles"), "points")
    np.testing.assert_allclose(geometry(again).points, geometry(drive).points, atol=1e-14)


def test_slopes_read_as_a_technician_measures_them() -> None:
    drive = in_form(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 1, -1)]), "slopes")
    assert np.rad2deg(drive.shafts[1].side_slope) == pytest.approx(-45)  # falling along the power flow
    assert np.rad2deg(drive.shafts[1].plan_slope) == pytest.approx(45)  # to the left


def test_a_shaft_that_runs_against_the_others_has_no_slopes() -> None:
    drive = Drive.from_points([(0, 0, 0), (1, 0, 0), (1.5, 0.8, 0), (1, 1.6, 0), (0, 1.6, 0)])
    with pytest.raises(InputError, match="no side and plan slope") as caught:
        in_form(drive, "slopes")
    assert [problem.field for problem in caught.value.problems] == ["shafts[0]", "shafts[3]"]


@pytest.mark.parametrize(
    ("points", "upright"),
    [
        ([(0, 0, 0), (-1, 0.2, 0.1), (-2, 0.5, 0), (-3, 0.6, 0.4)], True),
        ([(0, 0, 0), (0.1, 1, 0), (0, 2, 0.3), (0.4, 3, 0.4)], True),
        ([(0, 0, 0), (0, 0, 1), (0.3, 0, 2), (0.4, 0.1, 3)], False),
        ([(0, 0, 0), (0.1, 0, -1), (0.4, 0.2, -2), (0.3, 0, -3)], False),
    ],
)
def test_drives_backwards_sideways_and_upright_have_slopes(points, upright) -> None:
    heavy = Cross(mass=2.0)
    drive = Drive.from_points(points, yoke_angles=[0.3])
    drive = replace(drive, joints=tuple(replace(one, cross=heavy) for one in drive.joints))
    turned = in_form(drive, "slopes")
    assert np.max(np.abs(motion(turned).ratio - motion(drive).ratio)) < 1e-13
    before, after = geometry(drive), geometry(turned)
    assert np.allclose(after.length, before.length)
    fall, fell = np.asarray(drive.settings.gravity), np.asarray(turned.settings.gravity)
    assert np.allclose(after.axis @ fell, before.axis @ fall, atol=1e-12)
    assert np.allclose(fell, fall) == upright


def test_lengths_not_said_stay_unsaid() -> None:
    drive = in_form(Drive.from_angles([0.1, 0.2]), "slopes")
    assert all(shaft.length is None for shaft in drive.shafts)


def test_what_stands_in_coordinates_is_not_carried_over() -> None:
    from cardan import example

    with pytest.raises(InputError) as caught:
        in_form(example("truck-rear-axle"), "angles")
    fields = {problem.field for problem in caught.value.problems}
    assert fields == {"movements", "poses[0].set", "poses[1].set", "poses[2].set"}


@pytest.mark.parametrize(
    "joint_angles", [[0.0], [0.0, 0.0], [0.0, 0.3, 0.5], [0.0, 0.0, 0.4], [0.4, 0.0, 0.0, 0.2], [0.3, 0.0]]
)
@pytest.mark.parametrize("form", ["points", "slopes"])
@pytest.mark.parametrize("phase", [0.0, 0.4])
def test_straight_joints_keep_the_motion(joint_angles: list[float], form: str, phase: float) -> None:
    between = len(joint_angles) - 1
    twists, yokes = [0.3 + 0.2 * i for i in range(between)], [0.1 - 0.4 * i for i in range(between)]
    drive = Drive.from_angles(joint_angles, plane_twists=twists, yoke_angles=yokes, start_phase=phase)
    other = in_form(drive, form)  # type: ignore[arg-type]
    # Some roundings of 1e-16 each, in angles of up to one turn.
    np.testing.assert_allclose(motion(other).shaft_angle, motion(drive).shaft_angle, atol=1e-13)


def test_movements_are_shifted_with_the_drive_and_refused_where_it_turns() -> None:
    from cardan import articulation, example

    drive = example("pto-hitch")
    moved = replace(
        drive,
        input=replace(drive.input, point=(0.5, 0.2, 0.1)),
        joints=tuple(
            replace(j, centre=(j.centre[0] + 0.62, j.centre[1] + 0.2, j.centre[2] + 0.1))  # type: ignore[index]
            for j in drive.joints
        ),
        output=replace(drive.output, point=(1.77, 0.2, 0.1)),
        movements=(replace(drive.movements[0], pivot=(1.12, 0.2, -0.14)),),  # type: ignore[call-arg]
    )
    times = np.linspace(0.0, 10.0, 7)
    wanted = articulation(moved, times=times)
    for form in ("angles", "slopes"):
        found = articulation(in_form(moved, form), times=times)  # type: ignore[arg-type]
        np.testing.assert_allclose(
            found.joint_angle, wanted.joint_angle, atol=1e-12
        )  # roundings of the shifted coordinates
        np.testing.assert_allclose(found.length[:, 1], wanted.length[:, 1], rtol=1e-13)
    slanted = replace(moved, input=replace(moved.input, point=(0.5, 0.2, 0.2)))
    with pytest.raises(InputError, match="movements"):
        in_form(slanted, "angles")


def test_poses_that_change_no_geometry_are_carried_over() -> None:
    drive = Drive.from_points([(0, 0, 0), (1, 0, 0), (2, 0.1, 0)])
    pose = Pose(name="slow", set=(("duty.speed_rpm", 100.0),))
    assert in_form(replace(drive, poses=(pose,)), "angles").poses == (pose,)


def test_weight_and_misalignment_turn_with_the_drive() -> None:
    bare = Drive.from_points([(0, 0, -0.3), (0, 0, 0), (0.3, 0.1, 0.8), (0.3, 0.2, 1.3)], yoke_angles=[0.3])
    held = tuple(Support(shaft=s, position=x, axial=x == -0.2) for s, x in ((1, -0.2), (1, -0.1), (3, 0.1), (3, 0.4)))
    heavy = (Shaft(number=2, mass=9.0, yoke_angle=0.3),)
    here = replace(bare, supports=held, shafts=heavy, duty=Duty(torque=50.0))
    there = in_form(here, "angles")
    assert there.settings != here.settings
    one, two = forces(here, angle=[0.0, 1.0]), forces(there, angle=[0.0, 1.0])
    np.testing.assert_allclose(two.radial, one.radial, rtol=1e-12)
    np.testing.assert_allclose(two.axial, one.axial, rtol=1e-12, atol=1e-9)
    off = replace(here, supports=(replace(held[0], offset=(1e-4, 0.0, 2e-4)), *held[1:]))
    turned = in_form(off, "angles").supports[0].offset
    assert math.hypot(*turned) == pytest.approx(math.hypot(1e-4, 2e-4))
    assert turned[0] == pytest.approx(2e-4)
    light = in_form(replace(bare, supports=held), "angles")
    assert light.settings == bare.settings
