import numpy as np
import pytest

from cardan.maths.curves import paths

CORNERS, DENSITY = np.asarray([1.0, 4.0, 5.0, 20.0]), np.asarray([0.0, 3.0, 1.0, 0.0])


def test_variances_are_the_integrals():
    omega = np.linspace(1.0, 20.0, 1_900_001)
    s = np.interp(omega, CORNERS, DENSITY)
    # Trapezoids with h = 1e-5: h²/12 of the second derivative.
    assert paths.variance(CORNERS, DENSITY) == pytest.approx(np.trapezoid(s, omega), rel=1e-9)
    assert paths.rate_variance(CORNERS, DENSITY) == pytest.approx(np.trapezoid(omega**2 * s, omega), rel=1e-9)


def test_two_sided_density_holds_the_variance_on_both_sides():
    omega = np.linspace(-25.0, 25.0, 1_000_001)
    both = paths.two_sided(CORNERS, DENSITY, omega)
    assert np.trapezoid(both, omega) == pytest.approx(paths.variance(CORNERS, DENSITY), rel=1e-6)
    np.testing.assert_allclose(both, both[::-1], atol=1e-12)


def test_narrow_peak_between_the_bands_is_not_missed():
    corners, density = [1.0, 10.0, 10.001, 10.002, 100.0], [0.0, 0.0, 1000.0, 0.0, 0.0]
    times = np.linspace(0.0, 50.0, 5001)
    value = paths.sample_path(corners, density, times, seed=1, components=256)[0]
    # All power lies in one band: a cosine of amplitude √2, to the part of a period left over.
    assert np.std(value) == pytest.approx(1.0, rel=0.02)
