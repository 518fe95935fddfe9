"""Polylines coordinate by coordinate are those drive by drive."""

import numpy as np
import pytest

from cardan.drive.models.geometry import columns, polyline, table


def lines(joints, count, varied, straight=False):
    """Return points as columns and as one array; of these coordinates alone vary."""
    rng = np.random.default_rng(7)
    own = np.cumsum(rng.uniform(0.2, 1.0, (joints + 2, 3)) * [1.0, 0.3, 0.3], axis=0)
    if straight:
        own = np.arange(joints + 2)[:, None] * np.asarray([1.0, 0.0, 0.0])
    whole = np.broadcast_to(own, (count, *own.shape)).copy()
    given = [[float(x) for x in point] for point in own]
    for k, axis in varied:
        values = own[k, axis] + np.where(np.arange(count) % 3 == 0, 0.0, rng.normal(0.0, 0.1, count))
        whole[:, k, axis] = values
        given[k][axis] = values
    return [tuple(point) for point in given], whole


@pytest.mark.parametrize("varied", [[], [(2, 2)], [(0, 0), (1, 1), (2, 2), (5, 1)]])
@pytest.mark.parametrize("straight", [False, True])
def test_columns_are_polylines(varied, straight):
    points, whole = lines(4, 60, varied, straight)
    found, same = columns(points, 60), polyline(whole)
    for name in ("joint_angle", "plane_twist", "length"):  # the same formulas; reciprocals round once more
        assert np.allclose(table(getattr(found, name), 60), getattr(same, name), rtol=0, atol=1e-13)


def test_a_drive_does_not_depend_on_those_beside_it():
    points, _whole = lines(4, 60, [(2, 2), (3, 1)], straight=True)
    together = table(columns(points, 60).plane_twist, 60)
    for rows in (slice(0, 1), slice(5, 7), slice(31, 60)):
        part = [tuple(x[rows] if np.ndim(x) else x for x in point) for point in points]
        count = len(range(60)[rows])
        assert np.array_equal(table(columns(part, count).plane_twist, count), together[rows])


def test_nothing_varied_is_a_number():
    points, _whole = lines(4, 1000, [(5, 1)])
    found = columns(points, 1000)
    assert [np.ndim(one) for one in found.joint_angle] == [0, 0, 0, 1]
