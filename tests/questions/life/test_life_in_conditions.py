"""Life over poses, movements and load cases: against closed forms of one joint and an integration of its own."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from cardan.answers.quantity import told
from cardan.answers.reader import Reader
from cardan.checks.checks import check
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty, History
from cardan.drive.joint_parts import Needles
from cardan.drive.movement import Harmonic, Hitch
from cardan.drive.settings import Pose
from cardan.errors import InputError
from cardan.questions.life.answer import answer
from cardan.questions.life.bearing_life import bearing_life
from cardan.questions.life.life import life
from cardan.units import deg, rpm

C, SPAN, SPEED = 20e3, 0.08, 1000 * rpm


def joints(drive):
    """Return a drive with crosses and needles in all joints."""
    return replace(
        drive,
        joints=tuple(replace(one, cross=Cross(span=SPAN), needles=Needles(capacity=C)) for one in drive.joints),
    )


def closed(joint_angle, torque, speed=SPEED):
    """Return the life of one joint by ISO 281 with a constant torque at its output [s]."""
    return float(bearing_life(C, SPAN / 2, torque, speed=speed, joint_angle=joint_angle, torque_at="output").worst)


def single(joint_angle_deg=10.0, **fields):
    return replace(joints(Drive.from_angles([joint_angle_deg * deg])), **fields)


def test_poses_add_their_damage_by_their_shares():
    poses = (
        Pose(name="turned", share=0.2, set=(("joints[0].joint_angle_deg", 30.0),)),
        Pose(name="half", share=0.3, set=(("joints[0].joint_angle_deg", 20.0),)),
    )
    found = life(single(poses=poses, duty=Duty(speed=SPEED, torque=800.0)))
    rate = sum(share / closed(joint_angle * deg, 800.0) for share, joint_angle in ((0.5, 10), (0.2, 30), (0.3, 20)))
    assert found.drive == pytest.approx(1.0 / rate, rel=1e-9)
    assert [part.name for part in found.parts] == ["", "pose turned", "pose half"]


def test_poses_without_shares_leave_the_worst():
    poses = (Pose(name="turned", set=(("joints[0].joint_angle_deg", 30.0),)),)
    drive = single(poses=poses, duty=Duty(speed=SPEED, torque=800.0))
    found = life(drive)
    assert found.drive == pytest.approx(closed(30 * deg, 800.0), rel=1e-9)
    remarks = [one.text.told(Reader()) for one in answer(drive, found).remarks if one.code == "no_share"]
    assert remarks == [
        "Warning: no share_percent tells how long each pose lasts; this is the life in the worst of them, turned."
    ]


def test_a_movement_adds_the_damage_of_its_instants():
    """The output rises and falls as a sine: own integration of the closed form over the swing."""
    drive = joints(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.3)]))
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.2), frequency=2.0)
    found = life(replace(drive, movements=(swing,), duty=Duty(speed=SPEED, torque=800.0)))

    def rate(phase, side):
        joint_angle = np.arctan(0.3 - 0.2 * np.sin(phase))
        one = bearing_life(C, SPAN / 2, 800.0, speed=SPEED, joint_angle=joint_angle, torque_at="output")
        return 1.0 / getattr(one, side)

    sides = [quad(rate, 0.0, 2.0 * np.pi, (side,), epsrel=1e-11)[0] / (2.0 * np.pi) for side in ("driving", "driven")]
    assert found.drive == pytest.approx(1.0 / max(sides), rel=1e-9)


@pytest.mark.slow
def test_a_hitch_lives_longer_than_at_its_lock_and_shorter_than_as_drawn():
    """Two joints, so the torque between them swings; the vector model's moment is that of `forces` at each instant."""
    drive = joints(Drive.from_points([(-0.12, 0, 0), (0, 0, 0), (1, 0, -0.05), (1.15, 0, -0.05)]))
    turn = Hitch(moves=("joints[1]", "output"), pivot=(0.5, 0, -0.24), yaw=40 * deg, frequency=0.6)
    duty = Duty(speed=540 * rpm, torque=300.0)
    drawn = life(replace(drive, duty=duty)).drive
    moving = life(replace(drive, duty=duty, movements=(turn,)))
    turned = [
        life(replace(drive, duty=duty, **at(drive, 40 * deg * np.sin(2.0 * np.pi * (k + 0.5) / 96)))).of("iso")
        for k in range(96)
    ]
    rate = np.mean([1.0 / one for one in turned], axis=0)
    # The governing yoke is the same at all instants here, so the shorter of means is the mean of the shorter.
    np.testing.assert_allclose(moving.of("iso"), 1.0 / rate, rtol=2e-3)
    assert min(np.min(one) for one in turned) < moving.drive < drawn


def at(drive, yaw):
    """Return the points of a drive turned about the hitch pin, by hand."""
    c, s = np.cos(yaw), np.sin(yaw)

    def turned(point):
        x, y, z = point
        return (0.5 + c * (x - 0.5) - s * y, s * (x - 0.5) + c * y, z)

    last = replace(drive.joints[1], centre=turned(drive.joints[1].centre))
    return {"joints": (drive.joints[0], last), "output": replace(drive.output, point=turned(drive.output.point))}


def test_load_cases_add_their_damage_with_their_own_shocks():
    cases = (
        Case(name="field", torque=500.0, speed=SPEED, share=0.9),
        Case(name="stones", torque=700.0, speed=SPEED / 2, share=0.1, shock_factor=2.0),
        Case(name="jerk", torque=9000.0),
    )
    found = life(single(duty=Duty(cases=cases, speed=SPEED)))
    rate = 0.9 / closed(10 * deg, 500.0) + 0.1 / closed(10 * deg, 1400.0, SPEED / 2)
    assert found.drive == pytest.approx(1.0 / rate, rel=1e-9)
    assert [part.name for part in found.parts] == ["field", "stones"]


def test_a_load_case_bound_to_a_pose_damages_there_alone():
    pose = Pose(name="turned", share=0.0, set=(("joints[0].joint_angle_deg", 30.0),))
    cases = (
        Case(name="road", torque=500.0, speed=SPEED, share=0.95),
        Case(name="kerb", torque=800.0, speed=SPEED, share=0.05, pose="turned"),
    )
    found = life(single(poses=(pose,), duty=Duty(cases=cases)))
    rate = 0.95 / closed(10 * deg, 500.0) + 0.05 / closed(30 * deg, 800.0)
    assert found.drive == pytest.approx(1.0 / rate, rel=1e-9)
    assert [part.name for part in found.parts] == ["road", "pose turned, kerb"]


@pytest.mark.slow
def test_a_load_case_bound_to_a_movement_moves_alone():
    still = Harmonic(name="rest", moves=("output",), amplitude=(0.0, 0.0, 0.0), frequency=2.0)
    swing = Harmonic(name="swing", moves=("output",), amplitude=(0.0, 0.0, 0.2), frequency=2.0)
    drive = joints(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.3)]))
    duty = Duty(speed=SPEED, torque=800.0)
    alone = life(replace(drive, movements=(swing,), duty=duty)).drive
    cases = tuple(Case(name=name, torque=800.0, share=0.5, movement=name) for name in ("rest", "swing"))
    both = life(replace(drive, movements=(still, swing), duty=Duty(speed=SPEED, cases=cases))).drive
    assert 1.0 / both == pytest.approx(0.5 / alone + 0.5 / closed(np.arctan(0.3), 800.0), rel=1e-9)


def test_measured_torque_and_parts_run_in_every_pose():
    poses = (Pose(name="turned", share=0.4, set=(("joints[0].joint_angle_deg", 30.0),)),)
    parts = (Block(torque=900.0, speed=SPEED, share=0.25), Block(torque=300.0, speed=2 * SPEED, share=0.75))
    found = life(single(poses=poses, duty=Duty(blocks=parts)))
    rate = sum(
        share * part.share / closed(joint_angle * deg, part.torque, part.speed)
        for share, joint_angle in ((0.6, 10), (0.4, 30))
        for part in parts
    )
    assert found.drive == pytest.approx(1.0 / rate, rel=1e-9)
    history = History(file="a.csv", times=(0.0, 1.0, 2.0), torques=(300.0, 300.0, 300.0))
    measured = life(single(poses=poses, duty=Duty(speed=SPEED, torque_history=history))).drive
    assert 1.0 / measured == pytest.approx(0.6 / closed(10 * deg, 300.0) + 0.4 / closed(30 * deg, 300.0), rel=1e-6)


def test_the_check_asks_for_the_life_of_the_whole_and_not_of_its_worst_pose():
    poses = (Pose(name="turned", share=0.01, set=(("joints[0].joint_angle_deg", 30.0),)),)
    drive = single(poses=poses, duty=Duty(speed=SPEED, torque=800.0, life=3.6e6))
    (verdict,) = check(drive, only=["bearing_life"])
    assert verdict.value == pytest.approx(life(drive).drive, rel=1e-12)


def test_a_movement_through_a_right_angle_is_refused():
    drive = joints(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, 0)]))
    swing = Harmonic(moves=("output",), amplitude=(-1.5, 0.0, 0.0), frequency=2.0)
    with pytest.raises(InputError):
        life(replace(drive, movements=(swing,), duty=Duty(speed=SPEED, torque=800.0)))


@pytest.mark.slow
def test_many_drives_sum_damage_over_poses_and_movement_as_one_does():
    """The batch scales the exact life of one drive by closed forms; both know the means over time."""
    drive = joints(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.3)]))
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.2), frequency=2.0)
    pose = Pose(name="low", share=0.3, set=(("output.point_mm", (1000.0, 0.0, -500.0)),))
    drive = replace(drive, movements=(swing,), poses=(pose,), duty=Duty(speed=SPEED, torque=800.0, life=3.6e6))
    heights = [-400.0, -200.0]
    (many,) = check(drive, only=["bearing_life"], vary={"output.point_mm[2]": heights})
    for height, value in zip(heights, many.value, strict=True):
        one = replace(drive, output=replace(drive.output, point=(1.0, 0.0, height / 1000.0)))
        assert value == pytest.approx(life(one).drive, rel=1e-3)


@pytest.mark.slow
def test_poses_movements_and_cases_with_shares_add_to_one_average():
    """One joint: a case in a pose, one during a movement, the rest in both poses; an integration of its own of all."""
    drive = joints(Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.2)]))
    low = Pose(name="low", share=0.25, set=(("output.point_mm", (1000.0, 0.0, -500.0)),))
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=2.0, name="road")
    cases = (
        Case(name="winch", torque=900.0, share=0.1, pose="low"),
        Case(name="field", torque=700.0, share=0.3, movement="road"),
    )
    drive = replace(
        drive, poses=(low,), movements=(swing,), duty=Duty(speed=SPEED, torque=400.0, cases=cases, life=3.6e6)
    )
    found = life(drive)

    def rate(drop, torque):
        """Return the mean rates of damage in both yokes over the swing about a drop."""

        def here(phase, side):
            joint_angle = np.arctan(drop - 0.1 * np.sin(phase))
            one = bearing_life(C, SPAN / 2, torque, speed=SPEED, joint_angle=joint_angle, torque_at="output")
            return 1.0 / getattr(one, side)

        return np.asarray([quad(here, 0.0, 2.0 * np.pi, (side,))[0] / (2.0 * np.pi) for side in ("driving", "driven")])

    # The winch has its share in its pose; field and duty run in both poses by their shares, the duty for the rest.
    parts = {
        "winch": 0.1 * rate(0.5, 900.0),
        "field": 0.3 * (0.75 * rate(0.2, 700.0) + 0.25 * rate(0.5, 700.0)),
        "duty": 0.6 * (0.75 * rate(0.2, 400.0) + 0.25 * rate(0.5, 400.0)),
    }
    assert np.sum(found.share) == pytest.approx(1.0, abs=1e-12)
    assert found.drive == pytest.approx(1.0 / np.max(sum(parts.values())), rel=1e-7)
    (said,) = [one.text for one in answer(drive, found).remarks if one.code == "governing_condition"]
    winch = parts["winch"][0] / sum(parts.values())[0]
    assert winch > 0.4
    assert told(said, Reader()) == (
        f"Most damage to joint 1 arises in this condition: pose low, winch; {100 * winch:.1f} % of it in 10.0 % of the "
        "time."
    )
