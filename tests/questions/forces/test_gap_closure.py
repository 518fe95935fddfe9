"""Clearances that open, against dense sampling and the book's case of a single joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.reader import USUAL
from cardan.book.single_joint import joint_extremes
from cardan.checks import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.models.dynamics_model import train_of_points
from cardan.drive.models.geometry import points_from_angles
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.shaft import Shaft
from cardan.questions.forces.answer import answer, ask
from cardan.questions.forces.forces import forces, kinetostatics
from cardan.questions.forces.gap_closure import gap_closure, least_load
from cardan.questions.motion.motion import motion
from cardan.units import deg
from tests.builders.trains import one, trains

DENSE = np.arange(72000) * (np.pi / 36000)


def test_a_single_joint_needs_what_the_largest_acceleration_takes() -> None:
    """Book (122) but for where it is largest: T = (M + J ε)/(n·e) keeps its sign when M exceeds the largest -J ε."""
    joint_angle = 30 * np.pi / 180
    points = points_from_angles(np.asarray([joint_angle]), np.zeros(0), np.ones(2))
    single = train_of_points(points, inertia=np.asarray([3.0, 0.05]))
    found = gap_closure(single, load=1.0, speed=150.0)
    wanted = 0.05 * 150.0**2 * joint_extremes(np.asarray(joint_angle)).acceleration
    assert found.load_needed == pytest.approx(float(wanted), rel=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("n", [2, 4])
def test_least_couples_and_openings_are_those_of_dense_samples(n: int) -> None:
    drive = one(trains(np.random.default_rng(n), n, (1,)), 0)
    drive = replace(drive, cross_inertia=None, resisting_torque=None, bearings=())
    found = gap_closure(drive, load=60.0, speed=120.0)
    couple = kinetostatics(drive, DENSE, torque=60.0, speed=120.0).joint_torque
    swing = np.ptp(couple, axis=-1)
    np.testing.assert_array_less(np.abs(found.least_couple - couple.min(axis=-1)), 1e-7 * swing)
    np.testing.assert_allclose(found.open_share, np.mean(couple < 0.0, axis=-1), atol=1e-4)
    assert found.closed == bool(np.all(couple > 0.0))
    for k, angles in enumerate(found.openings):
        at = kinetostatics(drive, angles, torque=60.0, speed=120.0).joint_torque[k] if angles.size else np.zeros(1)
        assert np.abs(at).max() < 1e-9 * swing[k]


@pytest.mark.slow
@pytest.mark.parametrize(("share", "closed"), [(1.0001, True), (0.9999, False)])
def test_the_load_needed_just_closes_all_joints(share: float, closed: bool) -> None:
    drive = one(trains(np.random.default_rng(7), 3, (1,)), 0)
    drive = replace(drive, resisting_torque=None)
    needed = gap_closure(drive, load=0.0, speed=100.0).load_needed
    found = gap_closure(drive, load=share * needed, speed=100.0)
    assert found.closed is closed
    assert (max(angles.size for angles in found.openings) == 0) == closed


def test_a_load_the_other_way_mirrors_the_drive() -> None:
    """A load that resists turning backwards presses all joints the other way, and as firmly at the mirrored inertia."""
    drive = one(trains(np.random.default_rng(7), 3, (1,)), 0)
    drive = replace(drive, resisting_torque=None)
    needed = gap_closure(replace(drive, inertia=-drive.inertia), load=0.0, speed=100.0).load_needed
    for share, closed in ((1.0001, True), (0.9999, False)):
        found = gap_closure(drive, load=-share * needed, speed=100.0)
        assert found.closed is closed
        assert (float(np.max(found.open_share)) == 0.0) == closed
        assert np.all(found.least_couple < 0.0)


def tube_drive(torque: float, *, end: str = "output", harmonics: tuple[Harmonic, ...] = ()) -> Drive:
    shafts = (
        Shaft(number=2, length=0.8, inertia=0.04, yoke_angle=0.3),
        Shaft(number=3, length=0.6, inertia=0.02),
        Shaft(number=4, inertia=0.03),
    )
    return Drive(
        joints=(
            Hooke(joint_angle=28 * deg),
            Hooke(joint_angle=20 * deg, plane_twist=0.4),
            Hooke(joint_angle=15 * deg, plane_twist=-0.7),
        ),
        shafts=shafts,
        duty=Duty(torque=torque, speed=180.0, torque_at=end, harmonics=harmonics),
    )


@pytest.mark.parametrize("end", ["output", "input"])
@pytest.mark.parametrize("harmonics", [(), (Harmonic(order=3.0, torque=40.0, phase=0.5),)])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_the_least_load_brings_the_least_couple_of_the_vector_model_to_zero(end, harmonics, sense) -> None:
    drive = tube_drive(sense, end=end, harmonics=harmonics)
    chain = given_chain(drive)
    inertia = np.asarray([0.04, 0.02, 0.03])
    each = least_load(chain, inertia, 180.0, torque_at=end, harmonics=harmonics, backwards=sense < 0.0)
    for k, load in enumerate(each):
        whole = np.linspace(0.0, 2.0 * np.pi, 7201)
        couple = sense * forces(drive, replace(drive.duty, torque=sense * load), whole).joint_torque[k]
        if abs(load) > 1.0:
            assert abs(couple.min()) < 1e-5 * abs(load)
        assert couple.min() > -1e-5 * max(1.0, abs(load))


def test_many_drives_are_judged_as_one_by_one() -> None:
    chain = given_chain(tube_drive(1.0))
    joint_angles = np.asarray([[0.1, 0.2, 0.3], [0.5, 0.4, 0.3]])
    many = least_load(
        replace(chain, joint_angle=joint_angles), np.asarray([0.04, 0.02, 0.03]), np.asarray([100.0, 180.0])
    )
    for k, speed in enumerate((100.0, 180.0)):
        one = least_load(replace(chain, joint_angle=joint_angles[k]), np.asarray([0.04, 0.02, 0.03]), speed)
        assert many[k] == pytest.approx(one, rel=1e-5)


def test_a_drive_whose_joint_reverses_is_told() -> None:
    """300 N·m where about 1 000 N·m are needed: as the vector model has it, sampled densely."""
    shafts = (Shaft(number=2, length=0.8, inertia=0.1136), Shaft(number=3, inertia=1e-6))
    drive = Drive(
        joints=(Hooke(joint_angle=30 * deg), Hooke(joint_angle=30 * deg, plane_twist=0.0)),
        shafts=shafts,
        duty=Duty(torque=300.0, speed=169.4),
    )
    dense = forces(drive, angle=DENSE).joint_torque
    needed = 1000.0
    most = forces(drive, replace(drive.duty, torque=needed), DENSE).joint_torque
    assert abs(most.min()) < 0.02 * needed
    (found,) = check(drive, only=["gap_closure"])
    assert found.state == "failed"
    assert found.limit == pytest.approx(needed, rel=0.02)
    told = answer(drive, ask(drive))
    (said,) = (one.text.told(USUAL) for one in told.remarks if one.tone == "warning" and "gaps" in str(one.text))
    share = float(np.mean(dense[0] < 0.0))
    assert 0.3 < share < 0.45
    assert f"over {100 * share:.1f}" in said
    assert told.facts["gap_closure"]["open_share"][0].value == pytest.approx(share, abs=1e-4)
    assert told.facts["gap_closure"]["load_needed"].value == pytest.approx(float(found.limit), rel=1e-6)
    enough = replace(drive, duty=replace(drive.duty, torque=1.1 * float(found.limit)))
    assert check(enough, only=["gap_closure"])[0].state == "close"
    assert not any("gaps" in str(one.text) for one in answer(enough, ask(enough)).remarks if one.tone == "warning")


def test_the_check_asks_for_the_inertia_of_shafts_between_joints() -> None:
    drive = Drive(joints=(Hooke(joint_angle=0.3), Hooke(joint_angle=0.3)), duty=Duty(torque=300.0, speed=100.0))
    assert check(drive, only=["gap_closure"])[0].missing == ("shafts[1].inertia",)


def test_the_check_judges_many_drives_and_parts_of_a_duty_as_one_by_one() -> None:
    base = tube_drive(300.0)
    blocks = (Block(torque=300.0, speed=100.0, share=0.5), Block(torque=200.0, speed=180.0, share=0.5))
    drive = replace(base, duty=Duty(blocks=blocks))
    joint_angles = [5.0, 25.0, 35.0]
    (many,) = check(drive, only=["gap_closure"], vary={"joints[0].joint_angle_deg": joint_angles})
    for k, joint_angle in enumerate(joint_angles):
        joints = (replace(drive.joints[0], joint_angle=joint_angle * deg), *drive.joints[1:])
        (one,) = check(replace(drive, joints=joints), only=["gap_closure"])
        assert (many.value[k], many.limit[k]) == (one.value, pytest.approx(one.limit, rel=1e-5))
        assert one.value == 200.0


def test_the_least_load_counts_both_turns_of_a_torque_that_repeats_in_two():
    """By power at very many places of two turns: behind joint 1 stands T = (M + J ε)·i_3 with the swing in M."""
    drive = Drive.from_angles([20 * deg, 25 * deg])
    wave, inertia, speed = Harmonic(order=0.5, torque=8.0, phase=-0.5 * np.pi), np.asarray([0.02, 0.05]), 120.0
    found = least_load(given_chain(drive), inertia, speed, harmonics=(wave,))
    phi = np.linspace(0.0, 4.0 * np.pi, 200_001)
    turned = motion(drive, phi)
    ratio, slope = turned.shaft_ratio[1:], turned.shaft_slope[1:]
    power = inertia[:, None] * speed**2 * ratio * slope
    swing = wave.torque * np.cos(0.5 * turned.output_angle + wave.phase)
    need = -(np.cumsum(power[::-1], axis=0)[::-1] / ratio[-1] + swing)
    np.testing.assert_allclose(found, np.max(need, axis=-1), rtol=1e-6)
    assert np.all(np.max(need, axis=-1) > np.max(need[:, :100_001], axis=-1) * 1.01)
