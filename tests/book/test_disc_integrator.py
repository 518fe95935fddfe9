import array_api_strict as strict
import numpy as np
import pytest
from scipy.integrate import quad

from cardan.book.instruments import roller_speed, roller_turn


def test_the_roller_adds_up_its_way():
    phi = np.linspace(0.0, 9.0, 4001)
    place = 0.01 * np.sin(phi) + 0.002 * phi
    want, _error = quad(lambda x: (0.01 * np.sin(x) + 0.002 * x) / 0.02, 0.0, 9.0)
    assert roller_turn(phi, place, 0.02)[-1] == pytest.approx(want, abs=1e-5)  # trapezoids: h² f'/12
    slopes = np.gradient(roller_turn(phi, place, 0.02), phi)
    assert np.allclose(slopes[1:-1], roller_speed(1.0, place, 0.02)[1:-1], rtol=0, atol=1e-5)


def test_linear_movements_are_exact_whatever_the_steps():
    coarse = roller_turn([0.0, 20.0], [0.005, -0.010], 0.02)
    fine = roller_turn(np.linspace(0, 20, 1001), np.linspace(0.005, -0.010, 1001), 0.02)
    assert fine[-1] == pytest.approx(coarse[-1], rel=1e-12)
    assert list(coarse) == [0.0, -2.5]


def test_batches_and_single_instants():
    turn = roller_turn([0.0, 1.0, 2.0], np.ones((3, 3)) * [[1.0], [2.0], [3.0]], [1.0, 2.0, 4.0])
    assert turn.shape == (3, 3)
    assert np.allclose(turn[:, -1], [2.0, 2.0, 1.5])
    assert list(roller_turn([5.0], [0.1], 0.02)) == [0.0]
    assert np.isnan(roller_turn([0.0, 1.0], [0.1, np.nan], 0.02)[-1])


def test_any_array_library_computes_them():
    found = roller_turn(strict.asarray([0.0, 20.0]), strict.asarray([0.005, 0.010]), strict.asarray(0.02))
    assert np.array_equal(np.asarray(found), roller_turn([0.0, 20.0], [0.005, 0.010], 0.02))
