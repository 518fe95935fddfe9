"""Lanes: the operations a kernel may use, and what is done where nothing can be kept on disk."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit

from cardan.maths.arrays import namespace
from cardan.maths.compiled import lanes
from cardan.maths.compiled.lanes import LANES, address, fence, step

X = np.asarray([-3.0, -1.0, -0.25, 0.0, 0.5, 1.0, 2.0, 9.0])
Y = np.asarray([2.0, -1.0, 4.0, 0.0, 0.5, 7.0, -2.0, 3.0])


def arithmetic(x, y):
    return (x + y, 2.0 + x - y, 1.0 - x, x * y * 3.0, 3.0 * (x / 4.0), 2.0 / (y * y + 1.0), -x)


def choices(x, y):
    xp = namespace(x)
    return (xp.abs(x), xp.sqrt(xp.abs(x)), xp.where(x < y, x, y), xp.where(x > 0.0, 1.0, y))


@pytest.mark.parametrize("formula", [arithmetic, choices])
@pytest.mark.parametrize("past_caches", [False, True])
def test_a_formula_gives_the_same_on_lanes_and_on_numpy(formula, past_caches):
    """To the last place: sums of products may be fused, and none here rounds differently for it."""
    wanted = formula(X, Y)
    run = step(formula, past_caches=past_caches)
    results = len(wanted)

    block = np.zeros((results + 1) * LANES)
    skew = -(block.ctypes.data // 8) % LANES
    out = block[skew : skew + results * LANES]
    places = tuple(out.ctypes.data + 64 * k for k in range(results))

    @njit
    def kernel(x, y, places):
        run((address(x), address(y)), (), places)
        fence()

    kernel(X, Y, places)
    np.testing.assert_allclose(out.reshape(results, LANES), wanted, rtol=3e-16)


def test_pairs_of_lanes_are_written_as_complex_numbers():
    run = step(lambda x, y: (y, (x, x * y)))
    out, pairs = np.zeros(LANES), np.zeros(LANES, dtype=complex)

    @njit
    def kernel(x, y, out, pairs):
        run((address(x), address(y)), (), (address(out), address(pairs)))

    kernel(X, Y, out, pairs.view(float))
    assert out.tolist() == Y.tolist()
    assert pairs.tolist() == (X + 1j * (X * Y)).tolist()


def test_kernels_need_no_disk(monkeypatch):
    asked = []

    def without_a_folder(kind, *, cache=False, **options):
        asked.append(cache)
        if cache:
            raise RuntimeError("no locator available for file")
        return lambda function: function

    monkeypatch.setattr(lanes, "njit", without_a_folder)
    assert lanes.compiled()(len) is len
    assert asked == [True, False]
