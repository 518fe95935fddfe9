"""One set of yokes for several poses, against a fine grid."""

import numpy as np
import pytest

from cardan import Drive, InputError, phases
from cardan.drive.settings import Pose
from cardan.units import deg
from tests.builders import closing

TWISTS = np.asarray([0.3, -0.7])
POSES = {
    "empty": np.asarray([10, 14, 12]) * deg,
    "laden": np.asarray([13, 16, 9]) * deg,
    "turned": np.asarray([8, 15, 16]) * deg,
}


def drive(joint_angles):
    return Drive.from_angles(joint_angles, plane_twists=TWISTS)


@pytest.fixture(scope="module")
def grid():
    axis = np.linspace(0, np.pi, 361)
    one, two = np.meshgrid(axis, axis)
    rows = np.stack((one.ravel(), two.ravel()), axis=-1)
    return np.stack([closing.speed_fluctuation(joint_angles, TWISTS, rows) for joint_angles in POSES.values()], axis=-1)


@pytest.fixture(scope="module")
def found():
    return phases(drive(POSES["empty"]), poses={name: drive(joint_angles) for name, joint_angles in POSES.items()})


def test_every_setting_tells_what_it_leaves_in_each_pose(found):
    assert found.poses == tuple(POSES)
    for setting in (found.as_built, *found.settings, *found.pose_settings):
        truth = [closing.speed_fluctuation(joint_angles, TWISTS, setting.yoke_angle) for joint_angles in POSES.values()]
        np.testing.assert_allclose(setting.pose_speed_fluctuation, truth, atol=2e-14)


@pytest.mark.slow
def test_the_worst_pose_is_as_even_as_a_fine_grid_can_make_it(found, grid):
    worst, _mean = found.pose_settings
    assert worst.pose_speed_fluctuation.max() <= grid.max(axis=-1).min() + 1e-12
    # half a degree of grid, slope below 0.3 per rad
    assert worst.pose_speed_fluctuation.max() == pytest.approx(grid.max(axis=-1).min(), abs=2e-3)


def test_the_mean_is_as_small_as_a_fine_grid_can_make_it(found, grid):
    _worst, mean = found.pose_settings
    assert mean.pose_speed_fluctuation.mean() <= grid.mean(axis=-1).min() + 1e-12
    assert mean.pose_speed_fluctuation.mean() == pytest.approx(grid.mean(axis=-1).min(), abs=2e-3)


@pytest.mark.slow
def test_one_pose_is_the_drive_itself():
    alone = phases(drive(POSES["empty"]), poses={"empty": drive(POSES["empty"])})
    for setting in alone.pose_settings:
        assert setting.speed_fluctuation < 1e-13


def test_stopping_keeps_what_was_found():
    asked = []

    def stop(share):
        asked.append(share)
        return "stop"

    found = phases(drive(POSES["empty"]), poses={k: drive(v) for k, v in POSES.items()}, progress=stop)
    assert not found.complete
    assert len(found.pose_settings) == 2
    assert asked == [0.0]


def test_a_pose_with_another_number_of_joints_is_refused():
    with pytest.raises(InputError) as caught:
        phases(drive(POSES["empty"]), poses={"odd": Drive.from_angles([0.1, 0.2])})
    assert caught.value.field == "poses[0]"


def test_poses_of_the_drive_count_by_their_shares():
    base = drive(POSES["empty"])
    laden = tuple((f"joints[{i}].joint_angle_deg", float(b / deg)) for i, b in enumerate(POSES["laden"]))
    mostly = Drive(
        joints=base.joints,
        shafts=base.shafts,
        poses=(Pose(name="laden", share=0.999, set=laden), Pose(name="empty", set=())),
    )
    found = phases(mostly)
    assert found.poses == ("laden", "empty")
    _worst, mean = found.pose_settings
    # nearly all the time laden: the mean is least where laden is as even as it can be
    assert mean.pose_speed_fluctuation[0] == pytest.approx(
        phases(drive(POSES["laden"])).speed_fluctuation_min, abs=1e-6
    )
    assert mean.pose_speed_fluctuation[1] > 1e-2


@pytest.mark.slow
def test_the_drive_as_drawn_counts_for_the_time_that_its_poses_leave_it(grid):
    """Drawn empty, 60 % of the time: the worst and the mean of both, against the grid; never empty, laden alone."""
    base = drive(POSES["empty"])
    laden = tuple((f"joints[{i}].joint_angle_deg", float(b / deg)) for i, b in enumerate(POSES["laden"]))
    some = phases(Drive(joints=base.joints, shafts=base.shafts, poses=(Pose(name="laden", share=0.4, set=laden),)))
    worst, mean = some.pose_settings
    both = grid[:, :2]
    for setting, wanted in ((worst, both.max(axis=-1).min()), (mean, (both @ [0.6, 0.4]).min())):
        left = np.array([setting.speed_fluctuation, float(setting.pose_speed_fluctuation[0])])
        got = left.max() if setting is worst else left @ [0.6, 0.4]
        assert got <= wanted + 1e-12
        assert got == pytest.approx(wanted, abs=2e-3)
    always = phases(Drive(joints=base.joints, shafts=base.shafts, poses=(Pose(name="laden", share=1.0, set=laden),)))
    least = phases(drive(POSES["laden"])).speed_fluctuation_min
    for setting in always.pose_settings:
        assert float(setting.pose_speed_fluctuation[0]) == pytest.approx(least, rel=1e-9)
