"""Conditions: as drawn, in poses, in the parts of a duty cycle, each with its share; and how answers are gathered."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.drive.conditions import conditions, gathered, load_cases
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty, Harmonic
from cardan.drive.settings import Pose
from cardan.errors import InputError
from cardan.io import example
from cardan.units import deg, rpm

DRIVE = Drive.from_angles([10 * deg, 10 * deg])


def test_a_drive_that_runs_one_way_has_one_condition():
    (only,) = conditions(replace(DRIVE, duty=Duty(speed=50.0, torque=300.0)))
    assert (only.name, only.speed, only.torque, only.share, only.moving) == ("", 50.0, 300.0, 1.0, False)


def test_poses_take_their_shares_and_leave_the_rest():
    pose = Pose(name="full load", share=0.3, set=(("joints[1].joint_angle_deg", 20.0),))
    drawn, loaded = conditions(replace(DRIVE, poses=(pose,)))
    assert (drawn.pose, drawn.share) == ("", pytest.approx(0.7))
    assert (loaded.name, loaded.share) == ("pose full load", 0.3)
    assert loaded.drive.joints[1].joint_angle == pytest.approx(20 * deg)


def test_a_pose_without_share_leaves_shares_open():
    pose = Pose(name="turned", set=(("joints[1].joint_angle_deg", 20.0),))
    assert [one.share for one in conditions(replace(DRIVE, poses=(pose,)))] == [None, None]
    with pytest.raises(InputError, match="share"):
        gathered("mean", [1.0, 2.0], [None, None])


def test_every_pose_runs_every_part():
    parts = (Block(torque=900.0, speed=300 * rpm, share=0.25), Block(torque=300.0, speed=900 * rpm, share=0.75))
    pose = Pose(name="empty", share=0.4, set=(("joints[0].joint_angle_deg", 5.0),))
    found = conditions(replace(DRIVE, poses=(pose,), duty=Duty(blocks=parts)))
    assert [one.pose for one in found] == ["", "", "empty", "empty"]
    assert [one.case for one in found] == 2 * [f"part {k} of the duty cycle" for k in (1, 2)]
    assert sum(one.share for one in found) == pytest.approx(1.0)
    assert all(not one.drive.duty.blocks and not one.drive.poses for one in found)


def test_a_drive_that_moves_says_so():
    assert [one.moving for one in conditions(example("pto-hitch"))] == [True]


def test_gathering():
    values = np.asarray([[1.0, 5.0], [3.0, 1.0]])
    assert gathered("worst", values, [0.5, 0.5]).tolist() == [3.0, 5.0]
    assert gathered("mean", values, [0.25, 0.25]).tolist() == [2.0, 3.0]
    assert gathered("sum", values, [0.25, 0.75]).tolist() == [2.5, 2.0]
    assert gathered("each", values, [None, None]).tolist() == values.tolist()


def test_load_cases_bring_their_own_torque_speed_shocks_and_sense():
    cases = (
        Case(name="first gear", torque=900.0, speed=100.0, share=0.2, shock_factor=2.0),
        Case(name="downhill", torque=200.0, speed_range=(200.0, 300.0), share=0.3, flow="coast"),
        Case(name="jerk", torque=2000.0),
    )
    found = conditions(replace(DRIVE, duty=Duty(torque=400.0, speed=150.0, shock_factor=1.2, cases=cases)))
    assert [one.case for one in found] == ["the torque of the duty", "first gear", "downhill", "jerk"]
    assert [one.torque for one in found] == [400.0, 900.0, -200.0, 2000.0]
    assert [one.speed for one in found] == [150.0, 100.0, 250.0, 150.0]
    assert [one.share for one in found] == pytest.approx([0.5, 0.2, 0.3, 0.0])
    assert [one.drive.duty.shock_factor for one in found] == [1.2, 2.0, 1.2, 1.2]
    assert found[2].drive.duty.speed_range == (200.0, 300.0)


def test_turns_in_the_life_asked_for_are_a_share_of_it():
    case = Case(name="starts", torque=900.0, speed=50.0, cycles=1e5)
    steady, starts = load_cases(Duty(torque=100.0, speed=50.0, life=3.6e6, cases=(case,)))
    assert starts.share == pytest.approx(1e5 * 2.0 * np.pi / 50.0 / 3.6e6)
    assert steady.share == pytest.approx(1.0 - starts.share)


def test_alternating_torque_grows_with_the_torque_of_its_case():
    swing = Harmonic(order=2.0, torque=50.0)
    duty = Duty(torque=400.0, speed=150.0, harmonics=(swing,), cases=(Case(name="jerk", torque=2000.0),))
    steady, jerk = conditions(replace(DRIVE, duty=duty))
    assert [one.drive.duty.harmonics[0].torque for one in (steady, jerk)] == [50.0, 250.0]


def test_a_load_case_may_be_bound_to_a_pose():
    pose = Pose(name="turned", share=0.1, set=(("joints[1].joint_angle_deg", 20.0),))
    cases = (Case(name="road", torque=300.0, share=0.9), Case(name="kerb", torque=900.0, share=0.1, pose="turned"))
    found = conditions(replace(DRIVE, poses=(pose,), duty=Duty(speed=100.0, cases=cases)))
    assert [(one.pose, one.case, round(one.share, 9)) for one in found] == [
        ("", "road", 0.81),
        ("turned", "road", 0.09),
        ("turned", "kerb", 0.1),
    ]


def test_a_load_case_may_be_bound_to_a_movement():
    drive = example("pto-hitch")
    other = replace(drive.movements[0], name="standing", yaw=0.0)
    cases = (Case(name="lock", torque=300.0, share=0.5, movement="standing"), Case(name="all", torque=300.0, share=0.5))
    whole = replace(drive, movements=(drive.movements[0], other), duty=Duty(speed=50.0, cases=cases))
    assert [len(one.drive.movements) for one in conditions(whole)] == [1, 2]


def test_a_part_with_a_joint_angle_of_its_own_has_it_in_every_joint():
    parts = (Block(torque=9.0, speed=3.0, share=0.25), Block(torque=9.0, speed=3.0, share=0.75, joint_angle=0.3))
    for drive in (DRIVE, example("truck-rear-axle")):
        found = conditions(replace(drive, poses=(), duty=Duty(blocks=parts)))[1]
        assert [one.joint_angle for one in found.drive.joints] == [0.3] * len(drive.joints)


def test_peaks_alone_have_no_share():
    found = conditions(replace(DRIVE, duty=Duty(speed=10.0, cases=(Case(name="a", torque=1.0),))))
    with pytest.raises(InputError, match="share"):
        gathered("mean", [1.0], [one.share for one in found])


def test_a_case_that_holds_a_speed_of_its_own_does_not_run_over_the_range_of_the_duty():
    hill = Case(name="hill", torque=600.0, speed=20.0)
    crawl = Case(name="crawl", torque=900.0, speed_range=(5.0, 9.0))
    gust = Case(name="gust", torque=700.0)
    duty = Duty(torque=300.0, speed=50.0, speed_range=(10.0, 80.0), cases=(hill, crawl, gust))
    ranges = {one.case: one.drive.duty.speed_range for one in conditions(replace(DRIVE, duty=duty))}
    assert ranges == {
        "the torque of the duty": (10.0, 80.0),
        "hill": None,
        "crawl": (5.0, 9.0),
        "gust": (10.0, 80.0),
    }


def test_the_range_of_the_duty_is_left_out_by_no_drive():
    """Without a torque of the duty no condition but the load cases runs over it."""
    hill = Case(name="hill", torque=600.0, speed=20.0, share=1.0)
    (only,) = conditions(replace(DRIVE, duty=Duty(speed_range=(10.0, 80.0), cases=(hill,))))
    assert only.drive.duty.speed_range == (10.0, 80.0)
