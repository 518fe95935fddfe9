"""Surfaces: closed, turned outwards, as large as their closed forms; turns that join from one frame to the next."""

from collections import Counter

import numpy as np
import pytest

from cardan.maths.kernel import meshes

SURFACES = {
    "bar": (meshes.revolved([(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)], 12), 12.0 * np.sin(np.pi / 6.0)),
    "ring": (
        meshes.revolved([(0.0, 1.0), (0.0, 2.0), (3.0, 2.0), (3.0, 1.0), (0.0, 1.0)], 12),
        54.0 * np.sin(np.pi / 6.0),
    ),
    "box": (meshes.box((1.0, 2.0, 3.0), (5.0, 0.0, 0.0)), 6.0),
    "pierced": (meshes.plate(meshes.circle(2.0, 24), -1.0, 1.0, meshes.circle(1.0, 24)), 72.0 * np.sin(np.pi / 12.0)),
    "prism": (
        meshes.swept(np.asarray([[(x, 1, -1), (x, 1, 1), (x, -1, 1), (x, -1, -1)] for x in (0.0, 1.0, 4.0)]), range(4)),
        16.0,
    ),
}


def closed(surface):
    """Tell whether every edge of a surface is run through as often one way as the other."""
    size = float(np.max(np.ptp(surface.positions, axis=0)))
    corners = np.round(surface.positions / (1e-7 * size)).astype(np.int64)
    _own, same = np.unique(corners, axis=0, return_inverse=True)
    edges = Counter()
    for a, b, c in same.ravel()[surface.indices].tolist():
        for edge in ((a, b), (b, c), (c, a)):
            if edge[0] != edge[1]:
                edges[edge] += 1
    return all(edges[edge[::-1]] == count for edge, count in edges.items())


@pytest.mark.parametrize("name", SURFACES)
def test_surfaces_are_closed_and_enclose_what_their_closed_form_says(name):
    surface, expected = SURFACES[name]
    assert closed(surface)
    # Sums of some hundred products of order one.
    assert meshes.volume(surface) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    "surface", [meshes.ball(1.0, 24), meshes.ball(1.0, 24, -0.5, 0.7), meshes.box((1, 1, 1), 0, 0.1)]
)
def test_rounded_surfaces_are_closed_and_less_than_what_they_round(surface):
    assert closed(surface)
    assert 0.0 < meshes.volume(surface) < 4.0 / 3.0 * np.pi


def test_sharp_edges_have_corners_of_their_own_and_round_ones_do_not():
    sharp = meshes.revolved([(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)], 12)
    assert len(sharp.positions) == 6 * 12
    smooth = meshes.revolved([(0.0, 1.0), (0.1, 1.01), (0.2, 1.0), (0.2, 0.9), (0.0, 0.9), (0.0, 1.0)], 12)
    assert len(smooth.positions) == 9 * 12


def test_a_turned_and_shifted_surface_keeps_its_volume_and_stands_where_it_is_put():
    turn = np.asarray([(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)])
    moved = meshes.placed(SURFACES["box"][0], turn, (0.0, 0.0, 1.0))
    assert meshes.volume(moved) == pytest.approx(6.0, rel=1e-12)
    np.testing.assert_allclose(moved.positions.min(axis=0), (-1.5, 4.5, 0.0), atol=1e-14)


def test_quaternions_carry_the_axes_into_their_frames_and_join_up():
    angle = np.linspace(0.0, 4.0 * np.pi, 97)
    axis = np.asarray([1.0, -2.0, 0.5]) / np.sqrt(5.25)
    first = np.linalg.qr(np.asarray([[1.0, 2.0, 0.3], [0.0, 1.0, 4.0], [1.0, 0.0, 1.0]]))[0]
    first = first * np.sign(np.linalg.det(first))
    skew = np.cross(np.eye(3), axis)
    turns = [np.eye(3) - np.sin(a) * skew + (1.0 - np.cos(a)) * skew @ skew for a in angle]
    frame = np.stack([(turn @ first).T for turn in turns])
    q = meshes.quaternions(frame)
    x, w = q[:, :3], q[:, 3:]
    for k, direction in enumerate(np.eye(3)):
        turned = direction + 2.0 * w * np.cross(x, direction) + 2.0 * np.cross(x, np.cross(x, direction))
        # Roundings of products of unit vectors; the sense of `skew` is that of rows.
        np.testing.assert_allclose(turned, frame[:, k], atol=1e-14)
    assert np.all(np.sum(q[1:] * q[:-1], axis=-1) > 0.99)
