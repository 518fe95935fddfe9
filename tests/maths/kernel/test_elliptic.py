import array_api_strict as strict
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipe, ellipkm1

from cardan.maths.kernel.elliptic import complete
from cardan.units import deg


def test_integrals_are_those_of_scipy_up_to_the_steepest_bends():
    angle = np.concatenate((np.linspace(0.0, 89.0, 90), [89.9, 89.99])) * deg
    first, second = complete(angle)
    # scipy's own polynomials are good to 1e-15; K grows by the logarithm only.
    assert np.allclose(first, ellipkm1(np.cos(angle) ** 2), rtol=4e-15, atol=0)
    assert np.allclose(second, ellipe(np.sin(angle) ** 2), rtol=2e-14, atol=0)


@pytest.mark.parametrize("angle", [0.3, 1.0, 1.4])
def test_integrals_are_what_they_are_defined_as(angle):
    k = np.sin(angle)
    first, second = complete(np.asarray(angle))
    assert first == pytest.approx(quad(lambda t: 1 / np.sqrt(1 - (k * np.sin(t)) ** 2), 0, np.pi / 2)[0], rel=1e-12)
    assert second == pytest.approx(quad(lambda t: np.sqrt(1 - (k * np.sin(t)) ** 2), 0, np.pi / 2)[0], rel=1e-12)


def test_any_array_library_computes_them():
    first, _ = complete(strict.asarray([0.5], dtype=strict.float64))
    assert float(first[0]) == complete(np.asarray([0.5]))[0][0]
