"""Layouts against a fine grid of joint positions, and against plain vectors."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import fsolve

from cardan import Drive, InputError
from cardan.questions.phases.layout import Status, layout
from cardan.units import deg
from tests.builders.vector_model import VectorModel

POINTS = [(-0.3, 0, 0), (0, 0, 0), (1.2, 0.02, -0.16), (1.9, 0.04, -0.2), (2.4, 0.04, -0.6)]


def boxed(points, boxes, held=()):
    """Return a drive through points; ``boxes`` maps joint number to half widths about where it is."""
    drive = Drive.from_points(points)
    joints = list(drive.joints)
    for number, half in boxes.items():
        centre = joints[number - 1].centre
        box = tuple((c - h, c + h) for c, h in zip(centre, half, strict=True))
        joints[number - 1] = replace(joints[number - 1], move_within=box)
    shafts = tuple(replace(s, yoke_fixed=s.number in held) for s in drive.shafts)
    return replace(drive, joints=tuple(joints), shafts=shafts)


def joint_angles(points):
    axes = np.diff(points, axis=-2)
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    return np.arccos(np.clip(np.sum(axes[..., 1:, :] * axes[..., :-1, :], axis=-1), -1, 1))


def in_vectors(found):
    """Return δ of the drive that the search returns, by the plain vector model."""
    yokes = [shaft.yoke_angle for shaft in found.drive.shafts[1:-1]]
    return VectorModel.from_points(found.points.tolist(), yokes).speed_fluctuation()


@pytest.mark.slow
def test_the_grid_knows_no_smaller_largest_bend():
    drive = boxed(POINTS, {2: (0.0, 0.1, 0.1), 3: (0.0, 0.0, 0.1)})
    found = layout(drive)
    assert found.status is Status.CONVERGED
    assert found.feasible
    assert found.speed_fluctuation < 1e-13
    # 1440 samples find the extremes to 1e-9
    assert in_vectors(found) < 1e-9
    step = np.linspace(-0.1, 0.1, 81)
    y2, z2, z3 = np.meshgrid(step, step, step, indexing="ij")
    grid = np.broadcast_to(np.asarray(POINTS), (*y2.shape, 5, 3)).copy()
    grid[..., 2, 1] += y2
    grid[..., 2, 2] += z2
    grid[..., 3, 2] += z3
    angle = joint_angles(grid)
    length = -np.log(np.cos(angle))
    closes = 2 * length.max(axis=-1) <= length.sum(axis=-1)
    best = angle.max(axis=-1)[closes].min()
    assert found.joint_angle.max() <= best + 1e-9
    # 2.5 mm on 0.5 m of shaft, both ends
    assert found.joint_angle.max() == pytest.approx(best, abs=1 * deg)
    # among layouts with this largest joint angle, the one with the smallest sum
    near = closes & (angle.max(axis=-1) <= found.joint_angle.max() + 0.1 * deg)
    if near.any():
        assert (1 - np.cos(found.joint_angle)).sum() <= (1 - np.cos(angle))[near].sum(axis=-1).min() + 1e-3


@pytest.mark.slow
def test_two_joints_get_equal_bends():
    drive = boxed([(-1, 0, 0), (0, 0, 0), (1, 0, 0.1), (2, 0.2, 0.4)], {2: (0.0, 0.0, 0.2)})
    found = layout(drive)
    assert found.joint_angle[0] == pytest.approx(found.joint_angle[1], abs=1e-13)
    assert found.speed_fluctuation < 1e-13
    assert in_vectors(found) < 1e-9
    # the only height at which the joint angles are equal
    z = np.linspace(-0.1, 0.3, 400001)
    points = np.broadcast_to(np.asarray([(-1, 0, 0), (0, 0, 0), (1, 0, 0.1), (2, 0.2, 0.4)]), (len(z), 4, 3)).copy()
    points[:, 2, 2] = z
    angle = joint_angles(points)
    assert found.points[2, 2] == pytest.approx(z[np.argmin(np.abs(angle[:, 0] - angle[:, 1]))], abs=2e-6)


@pytest.mark.slow
def test_boxes_and_lengths_are_kept():
    drive = boxed(POINTS, {1: (0.1, 0.1, 0.1), 2: (0.2, 0.1, 0.1), 3: (0.1, 0.1, 0.1)})
    found = layout(drive, shortest=0.25)
    assert found.feasible
    for joint, before in zip(found.drive.joints, drive.joints, strict=True):
        for x, (low, high) in zip(joint.centre, before.move_within, strict=True):
            assert low <= x <= high
    assert found.length.min() >= 0.25 * (1 - 1e-6)
    np.testing.assert_allclose(found.moved, np.linalg.norm(found.points - np.asarray(POINTS), axis=-1)[1:-1])
    assert found.joint_angle.max() < found.joint_angle_before.max()
    np.testing.assert_allclose(found.joint_angle, joint_angles(found.points), atol=1e-7)


@pytest.mark.slow
def test_held_yokes_stay_and_the_layout_suits_them():
    drive = boxed(POINTS, {2: (0.2, 0.1, 0.1), 3: (0.1, 0.1, 0.1)}, held=(2,))
    found = layout(drive)
    assert found.feasible
    assert found.drive.shafts[1].yoke_angle == 0.0
    assert in_vectors(found) < 1e-9
    assert (
        found.joint_angle.max()
        >= layout(boxed(POINTS, {2: (0.2, 0.1, 0.1), 3: (0.1, 0.1, 0.1)})).joint_angle.max() - 1e-6
    )


@pytest.mark.slow
@pytest.mark.parametrize("gamma", [0.0, 0.4, 0.5 * np.pi])
def test_two_joints_with_held_yokes_are_brought_to_the_twist_that_suits_them(gamma):
    free = boxed([(-1, 0, 0), (0, 0, 0), (1, 0.1, 0.1), (2, 0, 0.4)], {2: (0.5, 0.3, 0.3)}, held=(2,))
    shafts = (free.shafts[0], replace(free.shafts[1], yoke_angle=gamma), free.shafts[2])
    found = layout(replace(free, shafts=shafts))
    assert found.status is Status.CONVERGED
    assert in_vectors(found) < 1e-9
    # Synchronous exactly when both joint angles are equal and β + γ = 0 modulo 180°: a curve, here walked along by its
    # x.
    start, here, _moved, end = found.points

    def misalignment(side, x):
        line = np.stack((start, here, (x, *side), end))
        (one, two), axes = joint_angles(line), np.diff(line, axis=0)
        normals = np.cross(axes[:-1], axes[1:])
        across = axes[1] @ np.cross(normals[0], normals[1]) / np.linalg.norm(axes[1])
        return one - two, np.sin(np.arctan2(across, normals[0] @ normals[1]) + gamma)

    for x in found.points[2, 0] + np.linspace(-0.02, 0.02, 9):
        side, _info, solved, _text = fsolve(misalignment, found.points[2, 1:], (x,), full_output=True, xtol=1e-12)
        inside = abs(x - 1.0) <= 0.5 and abs(side[0] - 0.1) <= 0.3 and abs(side[1] - 0.1) <= 0.3
        if solved == 1 and inside:
            line = np.stack((start, here, (x, *side), end))
            assert joint_angles(line).max() >= found.joint_angle.max() - 1e-7


@pytest.mark.slow
def test_boxes_that_hold_no_drive_are_refused():
    behind = boxed([(-1, 0, 0), (0, 0, 0), (1, 0, 0.1), (2, 0, 0.4)], {2: (0.1, 0.1, 0.1)})
    away = replace(behind.joints[1], move_within=((3.0, 3.1), (0.0, 0.1), (0.0, 0.1)))
    with pytest.raises(InputError, match="nowhere within the boxes"):
        layout(replace(behind, joints=(behind.joints[0], away)))


def test_boxes_too_small_give_the_most_even_layout():
    drive = boxed(POINTS, {2: (0.0, 0.0, 0.01)})
    found = layout(drive)
    assert found.status is Status.INFEASIBLE
    assert not found.feasible
    points = np.broadcast_to(np.asarray(POINTS), (2001, 5, 3)).copy()
    points[:, 2, 2] += np.linspace(-0.01, 0.01, 2001)
    length = -np.log(np.cos(joint_angles(points)))
    bound = 2 * np.sinh((2 * length.max(axis=-1) - length.sum(axis=-1)).min())
    assert found.speed_fluctuation == pytest.approx(bound, abs=1e-6)


@pytest.mark.slow
def test_weights_trade_bends():
    boxes = {1: (0.1, 0.1, 0.1), 2: (0.2, 0.1, 0.1), 3: (0.1, 0.1, 0.1)}
    first = layout(boxed(POINTS, boxes), weights=[10, 1, 1])
    last = layout(boxed(POINTS, boxes), weights=[1, 1, 10])
    assert first.feasible
    assert last.feasible
    assert first.joint_angle[0] < last.joint_angle[0]
    assert last.joint_angle[2] < first.joint_angle[2]


def test_the_same_question_has_the_same_answer():
    drive = boxed(POINTS, {2: (0.0, 0.1, 0.1), 3: (0.0, 0.0, 0.1)})
    np.testing.assert_array_equal(layout(drive).points, layout(drive).points)


def test_stopping_keeps_the_best_so_far():
    shares = []

    def stop(share):
        shares.append(share)
        return "stop" if len(shares) > 1 else None

    found = layout(boxed(POINTS, {2: (0.0, 0.1, 0.1), 3: (0.0, 0.0, 0.1)}), progress=stop)
    assert found.status is Status.CANCELLED
    assert shares == sorted(shares)
    assert found.feasible


def test_all_that_is_wrong_is_told():
    with pytest.raises(InputError) as caught:
        layout(Drive.from_angles([0.1, 0.2]), weights=[1.0], shortest=-1.0)
    assert [p.field for p in caught.value.problems] == ["joints", "joints", "weights", "shortest"]
    with pytest.raises(InputError) as caught:
        layout(Drive.from_points(POINTS))
    assert "move_within" in str(caught.value)
