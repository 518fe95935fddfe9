import array_api_strict as strict
import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.errors import JointAngleLimitError
from cardan.sweeps import Drives, stack


def test_stacking_pads_with_straight_joints_that_turn_nothing():
    whole = stack([Drive.from_angles([0.1]), Drive.from_angles([0.1, 0.2, 0.3], yoke_angles=[0.5, 0.6])])
    assert whole.shape == (2,)
    assert whole.joints.tolist() == [1, 3]
    assert whole.chain.joint_angle.tolist() == [[0.1, 0.0, 0.0], [0.1, 0.2, 0.3]]
    assert whole.chain.turn_before[0].tolist() == [0.0, 0.0, 0.0]


def test_stacking_nothing_is_refused():
    with pytest.raises(InputError, match="empty"):
        stack([])


def test_the_library_of_the_batch_may_be_chosen():
    whole = stack([Drive.from_angles([0.1]), Drive.from_angles([0.1, 0.2])], xp=strict)
    assert type(whole.chain.joint_angle).__module__.startswith("array_api_strict")
    assert whole.shape == (2,)


def test_what_is_given_once_holds_for_all():
    whole = Drives.from_angles(np.full((4, 3), 0.2), yoke_angle=[0.1, 0.2], start_phase=0.3)
    assert whole.chain.yoke_angle.shape == (4, 2)
    assert whole.chain.start_phase.tolist() == [0.3] * 4
    assert whole.chain.turn_before.shape == (4, 3)


def test_drives_through_points_are_those_of_single_points():
    rng = np.random.default_rng(4)
    points = np.cumsum(rng.uniform([0.5, -0.2, -0.2], [1, 0.2, 0.2], (6, 5, 3)), axis=-2)
    whole = Drives.from_points(points, yoke_angle=[0.1, 0.4])
    one = stack([Drive.from_points(place, yoke_angles=[0.1, 0.4]) for place in points])
    for name in ("joint_angle", "plane_twist", "yoke_angle", "start_phase"):
        assert np.allclose(getattr(whole.chain, name), getattr(one.chain, name), rtol=0, atol=4e-16), name


BATCH = np.asarray([[[0.0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0.0, 0, 0], [1, 0, 0], [2, 0.5, 0]]])


def changed(index, value):
    points = BATCH.copy()
    points[index] = value
    return points


@pytest.mark.parametrize(
    ("points", "message", "where"),
    [
        (changed((1, 2, 0), np.nan), "finite", [False, True]),
        (changed((0, 1), 0.0), "coincide", [True, False]),
        (changed((1, 2), [1, 1, 0]), "90°", [[False], [True]]),
    ],
)
def test_bad_points_of_a_batch_are_masked(points, message, where):
    with pytest.raises(InputError, match=message) as caught:
        Drives.from_points(points)
    assert caught.value.where.tolist() == where


@pytest.mark.parametrize("points", [np.zeros(3), np.zeros((2, 3)), np.zeros((4, 2))])
def test_points_of_a_wrong_shape_are_refused(points):
    with pytest.raises(InputError, match="shape"):
        Drives.from_points(points)


@pytest.mark.parametrize("joint_angle", [-1e-9, np.pi / 2, np.nan, np.inf])
def test_bad_bends_of_a_batch_are_masked(joint_angle):
    with pytest.raises(JointAngleLimitError) as caught:
        Drives.from_angles([[0.1, 0.2], [0.3, joint_angle]])
    assert caught.value.where.tolist() == [[False, False], [False, True]]


@pytest.mark.parametrize(
    ("given", "field"),
    [
        ({"joint_angle": 0.3}, "joint_angle"),
        ({"joint_angle": np.zeros((3, 0))}, "joint_angle"),
        ({"joint_angle": [0.1, 0.2], "yoke_angle": [0.1, 0.2]}, "yoke_angle"),
        ({"joint_angle": [0.1, 0.2], "plane_twist": []}, "plane_twist"),
    ],
)
def test_wrong_counts_are_named(given, field):
    with pytest.raises(InputError) as caught:
        Drives.from_angles(given.pop("joint_angle"), **given)
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("field", "value"),
    [("plane_twist", np.zeros((3, 1))), ("yoke_angle", np.zeros((1, 2, 1))), ("start_phase", [0.0] * 3)],
)
def test_arrays_that_do_not_fit_the_batch_are_named(field, value):
    with pytest.raises(InputError, match="does not fit the joint angles") as caught:
        Drives.from_angles(np.full((2, 2), 0.1), **{field: value})
    assert caught.value.field == field


@pytest.mark.parametrize("field", ["plane_twist", "yoke_angle", "start_phase"])
@pytest.mark.parametrize("library", [np, strict])
def test_values_that_are_not_finite_are_masked(field, library):
    value = library.asarray([0.0, np.nan]) if field == "start_phase" else library.asarray([[0.0], [np.inf]])
    with pytest.raises(InputError, match="finite") as caught:
        Drives.from_angles(library.asarray([[0.1, 0.2], [0.1, 0.2]]), **{field: value})
    assert caught.value.field == field
    assert np.asarray(caught.value.where).ravel().tolist() == [False, True]


def test_coordinates_that_no_drive_has_are_refused_as_for_a_single_drive():
    far = [[0, 0, 0], [1e200, 0, 0], [2e200, 1e200, 0]]
    for make in (Drives.from_points, Drive.from_points):
        with pytest.raises(InputError, match="finite"):
            make(far)
