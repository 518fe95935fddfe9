"""The rest of a cut circle: strips counted, the closed forms of the article in fifty digits, limits."""

import mpmath as mp
import numpy as np
import pytest

from cardan.questions.bending.cracked_rotor import cut_circle

DEPTHS = [1e-6, 1e-3, 0.1, 0.45, 1.0, 1.3, 1.9]


def closed(depth):
    """Return the article's (17)-(19) for a radius of 1, in fifty digits."""
    with mp.workdps(50):
        d = mp.mpf(depth)
        c, g = 1 - d, mp.sqrt(d * (2 - d))
        area = mp.pi - mp.acos(c) + c * g
        shift = 2 * g**3 / (3 * area)
        segment_x = mp.pi / 8 - (c * (2 * d**2 - 4 * d + 1) * g + mp.asin(c)) / 4
        turn = mp.asin(g) if d <= 1 else mp.pi - mp.asin(g)
        segment_y = (c * (2 * d**2 - 4 * d - 3) * g + 3 * turn) / 12
        whole = mp.pi / 4
        centred = whole - segment_x - area * shift**2
        parts = area, shift, whole - segment_x, whole - segment_y, centred, 1 - centred / whole, segment_y / whole
        return [float(part) for part in parts]


@pytest.mark.parametrize("depth", DEPTHS)
def test_the_rest_is_that_of_the_closed_forms(depth):
    found = cut_circle(2.0, depth)
    area, shift, x, y, centred, loss_x, loss_y = closed(depth)
    wanted = [4 * area, 2 * shift, 16 * x, 16 * y, 16 * centred, loss_x, loss_y]
    got = [found.area, found.shift, found.second_x, found.second_y, found.second_x_centroid, found.loss_x, found.loss_y]
    # Small losses keep their digits; only the thin rest about its own centroid is a difference of near places.
    np.testing.assert_allclose(got, wanted, rtol=1e-13 if depth < 1.5 else 2e-12)


def test_strips_counted_one_by_one_give_the_same():
    depth, edges = 0.45, np.linspace(-1.0, 0.55, 200_001)
    y = 0.5 * (edges[1:] + edges[:-1])
    half, width = np.sqrt(1.0 - y * y), np.diff(edges)
    area = np.sum(2.0 * half * width)
    middle = np.sum(2.0 * half * width * y) / area
    found = cut_circle(1.0, depth)
    # Two hundred thousand strips miss a share of 1e-8 at the round end.
    assert found.area == pytest.approx(area, rel=1e-7)
    assert found.shift == pytest.approx(-middle, rel=1e-7)
    assert found.second_x == pytest.approx(np.sum(2.0 * half * width * y * y), rel=1e-7)
    assert found.second_y == pytest.approx(np.sum(2.0 / 3.0 * half**3 * width), rel=1e-7)
    assert found.second_x_centroid == pytest.approx(np.sum(2.0 * half * width * (y - middle) ** 2), rel=1e-7)


def test_nothing_cut_and_batches():
    found = cut_circle([[1.0], [3.0]], [0.0, 0.7, 1.2])
    assert found.area.shape == (2, 3)
    np.testing.assert_allclose(found.area[:, 0], np.pi * np.asarray([1.0, 9.0]), rtol=1e-14)
    np.testing.assert_array_equal(found.loss_x[:, 0], 0.0)
    np.testing.assert_allclose(found.loss_x[0], found.loss_x[1], rtol=1e-15)
    np.testing.assert_allclose(found.second_x[1] / found.second_x[0], 81.0, rtol=1e-14)
    assert np.all(np.diff(found.loss_x[0]) > 0.0)
    assert np.all(found.loss_x >= found.loss_y)
