"""Conditions: as drawn, in poses, in the parts of a duty cycle, each with its share; and how answers are gathered."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.drive.conditions import conditions, gathered
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty
from cardan.drive.pose import Pose
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
    assert [(one.pose, one.part) for one in found] == [("", 1), ("", 2), ("empty", 1), ("empty", 2)]
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
