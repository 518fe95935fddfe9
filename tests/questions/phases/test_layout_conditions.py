"""Layouts over poses, movements and teeth: against grids of all joint positions and yoke angles, in plain matrices."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.movement import Harmonic, Hitch
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft, Spline
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.standing import still
from cardan.questions.phases import layout_answer
from cardan.questions.phases.layout import Status, layout
from cardan.questions.phases.layout_conditions import placed
from tests.builders.vector_model import VectorModel

POINTS = np.asarray([(-0.5, 0, 0), (0, 0, 0), (1.0, 0.05, -0.15), (1.9, 0.0, -0.25), (2.4, 0, -0.45)])
LOW = Pose(name="low", share=0.4, set=(("output.point_m", (2.4, 0.0, -0.6)), ("joints[2].centre_m", (1.9, 0.0, -0.35))))
BOX = ((1.0, 1.0), (-0.1, 0.1), (-0.25, -0.05))


def boxed(*, teeth=0, **more):
    made = Drive.from_points(POINTS, yoke_angles=[0.2, 0.4])
    joints = list(made.joints)
    joints[1] = replace(joints[1], move_within=BOX)
    if teeth:
        spline = Spline(teeth=teeth)
        more["shafts"] = tuple(Shaft(number=k, yoke_angle=0.2 * (k - 1), spline=spline) for k in (2, 3))
    return replace(made, joints=tuple(joints), **more)


def posed(centre):
    """Return the points of both conditions with joint 2 at a centre (..., 3), array (..., 2, 5, 3)."""
    rows = np.broadcast_to(POINTS, (*centre.shape[:-1], 2, 5, 3)).copy()
    rows[..., 1, 3, 2], rows[..., 1, 4, 2] = -0.35, -0.6
    rows[..., :, 2, :] = centre[..., None, :]
    return rows


def angles(points):
    """Return joint angles (..., n) and plane twists (..., n-1) of polylines, by plain vectors."""
    axis = np.diff(points, axis=-2)
    axis = axis / np.linalg.norm(axis, axis=-1, keepdims=True)
    normal = np.cross(axis[..., :-1, :], axis[..., 1:, :])
    joint_angle = np.arctan2(np.linalg.norm(normal, axis=-1), np.sum(axis[..., :-1, :] * axis[..., 1:, :], axis=-1))
    across = np.cross(normal[..., :-1, :], normal[..., 1:, :])
    along = np.sum(across * axis[..., 1:-1, :], axis=-1)
    size = np.linalg.norm(axis[..., 1:-1, :], axis=-1)
    return joint_angle, np.arctan2(along / size, np.sum(normal[..., :-1, :] * normal[..., 1:, :], axis=-1))


def fluctuation(joint_angle, twist, yokes):
    """Return δ: the law of a joint turns (cos θ, sin θ) by diag(√c, 1/√c); δ² = |M|⁴ - 4 of the product M."""
    shape = np.broadcast_shapes(joint_angle.shape[:-1], yokes.shape[:-1])
    whole = np.broadcast_to(np.eye(2), (*shape, 2, 2))
    for k in range(joint_angle.shape[-1]):
        if k:
            turn = 0.5 * np.pi - yokes[..., k - 1] - twist[..., k - 1]
            c, s = np.cos(turn), np.sin(turn)
            whole = np.stack((np.stack((c, -s), -1), np.stack((s, c), -1)), -2) @ whole
        root = np.sqrt(np.cos(joint_angle[..., k]))
        whole = np.stack((root, 1 / root), -1)[..., None] * whole
    norm = np.sum(whole**2, axis=(-2, -1))
    return np.sqrt(np.maximum(norm**2 - 4.0, 0.0))


def judged(centres, yokes, over, shares=(0.6, 0.4)):
    """Return what is to be least for centres (p, 3) and yoke angles (s, 2), array (p, s)."""
    joint_angle, twist = angles(posed(centres))
    each = fluctuation(joint_angle[:, None], twist[:, None], yokes[None, :, None])
    return each.max(axis=-1) if over == "worst" else each @ np.asarray(shares)


def grid(count):
    y, z = (np.linspace(low, high, count) for low, high in BOX[1:])
    return np.asarray([(1.0, one, other) for one, other in product(y, z)])


def in_vectors(found, conditions):
    """Return δ of a layout in every condition by the plain vector model."""
    yokes = [shaft.yoke_angle for shaft in found.drive.shafts[1:-1]]
    return [VectorModel.from_points(points.tolist(), yokes).speed_fluctuation() for points in conditions]


@pytest.mark.slow
@pytest.mark.parametrize("over", ["worst", "mean"])
def test_the_grid_over_joints_and_yokes_knows_no_calmer_layout(over):
    found = layout(boxed(poses=(LOW,)), over=over)
    step = np.linspace(0.0, np.pi, 37)[:-1]
    yokes = np.asarray(list(product(step, step)))
    best = judged(grid(17), yokes, over).min()
    each = in_vectors(found, posed(found.points[2]))
    got = max(each) if over == "worst" else float(np.dot((0.6, 0.4), each))
    assert [one.speed_fluctuation for one in found.conditions] == pytest.approx(each, abs=1e-8)
    assert got <= best
    near = np.stack(np.meshgrid(*(np.linspace(-0.02, 0.02, 9),) * 2), -1).reshape(-1, 2)
    mine = np.asarray([shaft.yoke_angle for shaft in found.drive.shafts[1:-1]])
    around = np.clip(found.points[2] + np.insert(near, 0, 0.0, axis=1), np.asarray(BOX)[:, 0], np.asarray(BOX)[:, 1])
    # Of layouts alike to a thousandth the one with smaller joint angles is taken.
    assert got <= judged(around, mine + near, over).min() * 1.002
    assert [one.share for one in found.conditions] == pytest.approx([0.6, 0.4])


@pytest.mark.slow
def test_on_teeth_the_grid_over_all_places_knows_no_calmer_layout():
    found = layout(boxed(teeth=12, poses=(LOW,)))
    places = np.asarray([(0.2 + j * np.pi / 6, 0.4 + k * np.pi / 6) for j, k in product(range(6), range(6))])
    best = judged(grid(61), places, "worst").min()
    mine = np.asarray([shaft.yoke_angle for shaft in found.drive.shafts[1:-1]])
    off = (mine - (0.2, 0.4)) / (np.pi / 6)
    assert off == pytest.approx(np.round(off), abs=1e-9)
    assert max(in_vectors(found, posed(found.points[2]))) <= best
    assert found.status is Status.INFEASIBLE


@pytest.mark.slow
def test_on_teeth_alone_the_joints_make_the_drive_exactly_uniform():
    found = layout(boxed(teeth=16))
    assert found.status is Status.CONVERGED
    assert VectorModel.from_points(found.points.tolist(), _yokes(found)).speed_fluctuation() < 1e-9
    assert np.all(found.points[2] >= np.asarray(BOX)[:, 0])
    assert np.all(found.points[2] <= np.asarray(BOX)[:, 1])


def _yokes(found):
    return [shaft.yoke_angle for shaft in found.drive.shafts[1:-1]]


@pytest.mark.parametrize(
    "movement",
    [
        Harmonic(moves=("joints[2]", "output"), amplitude=(0.0, 0.0, 0.06), frequency=2.0),
        Hitch(moves=("joints[1]", "joints[2]", "output"), pivot=(0.5, 0.0, -0.1), yaw=0.2, pitch=0.1, frequency=0.1),
    ],
)
def test_the_points_of_every_instant_are_those_of_the_drive_that_stands_there(movement):
    moving = boxed(movements=(movement,), poses=(LOW,))
    every = placed(moving)
    centres = np.asarray([joint.centre for joint in moving.joints])
    centres[1] += 0.0, 0.03, -0.02
    joints = tuple(replace(one, centre=tuple(at)) for one, at in zip(moving.joints, centres.tolist(), strict=True))
    moved = replace(moving, joints=joints, poses=())
    for one in every[: len(every) // 2 : 9]:
        time = one.name.parts[1].values["time"].value
        there = still(moved, float(time))
        wanted = [there.input.point, *(joint.centre for joint in there.joints), there.output.point]
        assert one.at(centres) == pytest.approx(np.asarray(wanted), abs=1e-12)
    assert sum(one.share for one in every) == pytest.approx(1.0)
    assert not every[-1].follows[2].any()
    assert every[-1].follows[1].all()


@pytest.mark.slow
def test_a_movement_counts_in_the_layout():
    swing = Harmonic(moves=("joints[2]", "output"), amplitude=(0.0, 0.0, 0.06), frequency=2.0)
    moving = boxed(movements=(swing,))
    found, still_best = layout(moving), layout(boxed())

    def worst(one):
        alone = replace(one.drive, movements=(swing,))
        times = np.linspace(0.0, np.pi, 73)
        return max(float(equivalent_joint(still(alone, time)).speed_fluctuation) for time in times)

    assert worst(found) < 0.8 * worst(still_best)
    assert worst(found) == pytest.approx(max(one.speed_fluctuation for one in found.conditions), rel=0.01)


@pytest.mark.slow
def test_a_joint_that_a_pose_places_is_told_and_weights_are_refused():
    held = Pose(name="held", share=0.5, set=(("joints[1].centre_mm", (1000.0, 0.0, -150.0)),))
    made = boxed(poses=(held,))
    found = layout(made)
    assert found.kept == (2,)
    said = layout_answer.answer(made, found, nearest=True)
    texts = [str(remark.text) for remark in said.remarks]
    assert any("A pose places" in text for text in texts)
    assert any("goal does not count" in text for text in texts)
    with pytest.raises(InputError, match="weights"):
        layout(made, weights=[1, 1, 1])
