from itertools import pairwise

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from cardan import Drive, InputError
from cardan.drive.joints import Hooke
from cardan.drive.models.geometry import geometry, geometry_from_points, points_from_angles
from cardan.drive.models.kinematics_model import chain
from cardan.drive.shaft import Shaft
from cardan.errors import JointAngleLimitError
from cardan.units import deg
from tests.builders.drives import plans


@given(plans(straight=False, joint_angle=80 * deg), st.floats(-3, 3), st.data())
def test_points_laid_out_from_angles_give_the_angles_back(plan, first, data):
    lengths = np.asarray([data.draw(st.floats(0.1, 3.0)) for _ in range(len(plan.joint_angles) + 1)])
    points = points_from_angles(
        np.asarray(plan.joint_angles), np.asarray(plan.plane_twists), lengths, first_twist=np.asarray(first)
    )
    place = geometry_from_points(points)
    # Coordinates of some metres carry 1e-15; a plane of a joint angle of 0.5° is known to 1e-15/0.009.
    assert np.allclose(place.joint_angle, plan.joint_angles, rtol=0, atol=1e-13)
    assert np.allclose(place.length, lengths, rtol=0, atol=1e-13)
    off = np.remainder(place.plane_twist - np.asarray(plan.plane_twists) + np.pi, 2 * np.pi) - np.pi
    assert np.all(np.abs(off) < 1e-11)


@pytest.mark.slow
@given(plans(joint_angle=60 * deg))
def test_normals_and_axes_are_what_their_names_say(plan):
    place = geometry(plan.drive)
    before, after = place.axis[:-1], place.axis[1:]
    assert np.allclose(np.linalg.norm(place.axis, axis=-1), 1, rtol=0, atol=1e-15 * 4)
    # A drive given by angles defines its normals even where it is straight; all stand across both axes.
    assert np.allclose(np.sum(place.normal * before, axis=-1), 0, atol=1e-9)
    assert np.allclose(np.cross(before, after), np.sin(place.joint_angle)[:, None] * place.normal, atol=1e-14)


@pytest.mark.slow
@given(plans(most=4, straight=False), st.floats(0.2, 1.5))
def test_angles_from_points_against_forty_digits(plan, length):
    points = points_from_angles(
        np.asarray(plan.joint_angles), np.asarray(plan.plane_twists), np.full(len(plan.joint_angles) + 1, length)
    )
    place = geometry_from_points(points)
    with mpmath.workdps(40):
        p = [[mpmath.mpf(x) for x in row] for row in points]
        steps = [[b - a for a, b in zip(u, v, strict=True)] for u, v in pairwise(p)]

        def dot(u, v):
            return sum(a * b for a, b in zip(u, v, strict=True))

        for i, (u, v) in enumerate(pairwise(steps)):
            want = mpmath.acos(dot(u, v) / mpmath.sqrt(dot(u, u) * dot(v, v)))
            # Differences of coordinates round at 1e-16 of some metres; bends of 0.5° and more.
            assert place.joint_angle[i] == pytest.approx(float(want), abs=1e-14)


def test_the_worked_example_has_its_angles():
    points = [[0, 0, 0], [100, 0, 7], [498, -72, 34], [707, -57, 27], [1064, 31, -68], [1164, 31, -86]]
    place = geometry_from_points(np.asarray(points) / 1000)
    minutes = np.asarray([10 * 60 + 13.9, 15 * 60 + 27.2, 15 * 60 + 50.0, 14 * 60 + 11.0])
    assert np.allclose(place.joint_angle / deg * 60, minutes, rtol=0, atol=0.06)
    twists = np.asarray([-(22 * 60 + 55.1), -(31 * 60 + 19.2), 35 * 60 + 41.8]) / 60
    off = np.remainder(place.plane_twist / deg - twists + 90, 180) - 90
    assert np.all(np.abs(off) < 0.06 / 60 * 2)


def test_planar_arrangements_have_their_twists():
    w = geometry_from_points(np.asarray([[0.0, 0, 0], [1, 0, 0], [2, 0, -0.3], [2.9, 0, -1]]))
    z = geometry_from_points(np.asarray([[0.0, 0, 0], [1, 0, 0], [2, 0, -0.3], [3, 0, -0.3]]))
    assert w.plane_twist[0] == pytest.approx(0.0, abs=1e-15)
    assert z.plane_twist[0] == pytest.approx(np.pi, abs=1e-15)
    assert z.joint_angle[0] == pytest.approx(z.joint_angle[1], abs=1e-15)


STRAIGHT = [[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]


@pytest.mark.parametrize(
    "points",
    [
        STRAIGHT,
        [*STRAIGHT, [3, 0, 0]],
        [*STRAIGHT, [3, 1, 0]],
        [*STRAIGHT, [3, 1, 0], [4, 2, 0]],
        [[0, 0, 0], [1, 1, 1], [2, 2, 2], [3, 2, 2], [4, 2, 2.2], [5, 2, 2.4]],
        [[0, 0, 0], [0, 0, 1], [0, 0, 2]],
    ],
)
def test_straight_joints_have_a_plane_and_no_bend(points):
    place = geometry_from_points(np.asarray(points, dtype=float))
    assert np.all(np.isfinite(place.normal))
    assert np.all(np.isfinite(place.plane_twist))
    assert np.allclose(np.linalg.norm(place.normal, axis=-1), 1, rtol=0, atol=1e-14)
    assert np.allclose(np.sum(place.normal * place.axis[:-1], axis=-1), 0, atol=1e-9)
    straight = place.joint_angle == 0.0
    assert np.any(straight)
    for i in np.flatnonzero(straight[1:]) + 1:
        assert place.plane_twist[i - 1] == pytest.approx(0.0, abs=1e-15), "a straight joint keeps the plane before it"


def test_straight_joints_at_the_start_take_the_first_plane_there_is():
    points = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 1, 0], [5, 1, 1], [6, 0, 2]]
    place = geometry_from_points(np.asarray(points, dtype=float))
    assert place.joint_angle[:2].tolist() == [0.0, 0.0]
    assert place.plane_twist[:2] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert abs(place.plane_twist[2]) > 0.5


def test_the_free_choice_of_a_straight_joints_plane_does_not_show():
    """A straight joint hardly bent to either side: the output moves alike."""
    from cardan import motion

    yokes, phi = [0.3, -0.5], np.linspace(0, 7, 50)

    def turned(shift):
        points = [[0, 0, 0], [1, 0, 0], [2, 0.3, 0], [3, 0.6 + shift[0], shift[1]], [4, 1.0, 0.5]]
        return motion(Drive.from_points(points, yoke_angles=yokes), phi).output_angle

    middle = turned((0.0, 0.0))
    for shift in ((1e-9, 0.0), (-1e-9, 0.0), (0.0, 1e-9), (0.0, -1e-9)):
        assert np.allclose(turned(shift), middle, rtol=0, atol=1e-8)


def test_a_batch_is_its_members():
    rng = np.random.default_rng(2)
    points = np.cumsum(rng.uniform([0.5, -0.2, -0.2], [1, 0.2, 0.2], (3, 2, 6, 3)), axis=-2)
    whole = geometry_from_points(points)
    assert whole.joint_angle.shape == (3, 2, 4)
    one = geometry_from_points(points[2, 1])
    for name in ("length", "axis", "normal", "joint_angle", "plane_twist"):
        assert np.allclose(getattr(whole, name)[2, 1], getattr(one, name), rtol=0, atol=4e-16), name


def test_the_strict_array_api_suffices():
    points = np.asarray([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0.2, 0.1]])
    mine, plain = geometry_from_points(strict.asarray(points)), geometry_from_points(points)
    for name in ("length", "joint_angle", "plane_twist", "normal"):
        assert np.allclose(np.asarray(getattr(mine, name)), getattr(plain, name), rtol=0, atol=1e-15)
    laid = points_from_angles(*(strict.asarray(x) for x in ([0.1, 0.2], [0.3], [1.0, 1.0, 1.0])))
    assert np.allclose(
        np.asarray(laid), points_from_angles(*(np.asarray(x) for x in ([0.1, 0.2], [0.3], [1.0, 1.0, 1.0])))
    )


def test_right_angles_are_refused_with_their_mask():
    points = np.asarray([[[0.0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0.0, 0, 0], [1, 0, 0], [1, 1, 0]]])
    with pytest.raises(JointAngleLimitError, match="shafts 1 and 2") as caught:
        geometry_from_points(points)
    assert caught.value.where.tolist() == [[False], [True]]


@given(
    st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=2, max_size=5),
    st.lists(st.floats(0.1, 2.0), min_size=5, max_size=5),
)
def test_slopes_are_the_tangents_of_the_views(slopes, lengths):
    shafts = tuple(
        Shaft(number=k + 1, side_slope=side * deg, plan_slope=plan * deg, length=length)
        for k, ((side, plan), length) in enumerate(zip(slopes, lengths, strict=False))
    )
    try:
        drive = Drive(joints=(Hooke(),) * (len(slopes) - 1), shafts=shafts)
        place = geometry(drive)
    except InputError:
        assume(False)
    step = np.diff(place.points, axis=0)
    assert np.allclose(step[:, 2] / step[:, 0], np.tan([side * deg for side, _ in slopes]), rtol=1e-12, atol=1e-13)
    assert np.allclose(step[:, 1] / step[:, 0], np.tan([plan * deg for _, plan in slopes]), rtol=1e-12, atol=1e-13)
    assert np.allclose(place.length, lengths[: len(slopes)], rtol=1e-13)
    assert place.assumed == ()


def test_what_is_assumed_is_listed():
    place = geometry(Drive.from_angles([0.2, 0.3]))
    assert place.assumed == ("shafts[0].length", "shafts[1].length", "shafts[2].length")
    assert np.allclose(place.length, 1.0)


@pytest.mark.slow
@given(plans(straight=False, joint_angle=60 * deg))
def test_the_chain_of_the_points_is_the_chain_of_the_angles(plan):
    place = geometry(plan.drive)
    drawn = chain(Drive.from_points(place.points.tolist(), yoke_angles=plan.yoke_angles, start_phase=plan.start_phase))
    given_ = chain(plan.drive)
    assert np.allclose(drawn.joint_angle, given_.joint_angle, rtol=0, atol=1e-13)
    off = np.remainder(drawn.turn_before - given_.turn_before + np.pi / 2, np.pi) - np.pi / 2
    assert np.all(np.abs(off) < 1e-11)
