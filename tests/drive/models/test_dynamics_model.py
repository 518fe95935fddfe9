"""What a drive's parts weigh, and where, by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.cross import Cross
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.models.dynamics_model import train, train_of_points
from cardan.drive.shaft import PointMass, Shaft, Spline
from cardan.drive.support import Support

DRIVE = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.0, 0, 0), (1.5, 0, -0.1)])


def with_tube(**keys: object) -> Drive:
    return replace(DRIVE, shafts=(Shaft(number=2, outer=0.08, **keys),))  # type: ignore[arg-type]


def test_a_tube_has_the_mass_of_its_wall() -> None:
    found = train(with_tube(wall=0.01))
    area = np.pi * 0.25 * (0.08**2 - 0.06**2)
    mass = 7850 * area
    assert found.mass[1] == pytest.approx(mass)
    assert found.inertia[1] == pytest.approx(mass * (0.04**2 + 0.03**2) / 2)
    assert found.transverse_inertia[1] == pytest.approx(mass * ((0.04**2 + 0.03**2) / 4 + 1 / 12))
    assert found.centre_of_mass[1] == pytest.approx(0.5)
    same = train(with_tube(inner=0.06))
    assert same.mass[1] == pytest.approx(mass)
    solid = train(with_tube(material=Material(density=1000.0)))
    assert solid.mass[1] == pytest.approx(1000 * np.pi * 0.04**2)


def test_given_values_stand_over_those_of_the_body() -> None:
    found = train(with_tube(mass=3.0, centre_of_mass=0.2, inertia=0.7))
    assert (found.mass[1], found.centre_of_mass[1], found.inertia[1]) == (3.0, 0.2, 0.7)
    assert found.assumed == ("shafts[0].inertia", "shafts[2].inertia")


def test_positions_on_the_input_shaft_count_from_joint_1() -> None:
    held = replace(DRIVE, supports=(Support(shaft=1, position=-0.1), Support(shaft=3, position=0.2)))
    held = replace(held, shafts=(Shaft(number=1, mass=2.0, centre_of_mass=-0.05),))
    found = train(held)
    np.testing.assert_allclose(found.position, [0.2, 0.2])
    assert found.centre_of_mass[0] == pytest.approx(0.25)


def test_friction_of_journals_needs_their_sizes() -> None:
    sized = Cross(span=0.08, journal=0.02)
    joints = (
        Hooke(joint_angle=0.1, friction=0.02, cross=sized),
        Hooke(joint_angle=0.1, material_friction=0.1, cross=sized),
    )
    np.testing.assert_allclose(train(Drive(joints=joints)).drag, [0.005, 0.1 * np.pi / 2 / 4])
    run_in = replace(joints[1], fit="run_in")
    assert train(Drive(joints=(joints[0], run_in))).drag[1] == pytest.approx(0.1 / np.pi)
    assert train(Drive(joints=(Hooke(joint_angle=0.1, friction=0.02),))).drag is None


def test_supports_need_the_lengths_between_joints() -> None:
    joint_angles = Drive.from_angles([0.1, 0.2, 0.1])
    assert train(joint_angles).position.size == 0
    with pytest.raises(InputError) as caught:
        train(replace(joint_angles, supports=(Support(shaft=1, position=-0.1),)))
    assert [problem.field for problem in caught.value.problems] == ["shafts[1].length", "shafts[2].length"]


def test_drives_through_points_take_any_parts() -> None:
    points = np.zeros((2, 4, 3))
    points[..., 0] = np.arange(4)
    points[1, 2, 1] = 0.2
    many = train_of_points(points, start_phase=0.3, inertia=np.ones((2, 3)))
    assert many.joints == 2
    assert many.chain.start_phase.tolist() == [0.3, 0.3]


def test_an_end_shaft_is_parted_by_its_spline_too():
    """A uniform tube of 0.6 m: behind a spline 0.2 m before the joint lies its last third and what it carries there."""
    lumps = PointMass(position=-0.05, mass=0.5), PointMass(position=-0.4, mass=0.7)
    shaft = Shaft(number=1, length=0.6, outer=0.05, wall=0.002, spline=Spline(position=-0.2), masses=lumps)
    made = train(replace(Drive.from_angles([0.2]), shafts=(shaft,)))
    tube = 0.25 * np.pi * (0.05**2 - 0.046**2) * 7850.0 * 0.2
    assert made.cut[0] == pytest.approx(0.4)
    assert made.behind[0, 0] == pytest.approx(tube + 0.5)
    assert made.behind[0, 1] == pytest.approx((tube * 0.5 + 0.5 * 0.55) / (tube + 0.5))
