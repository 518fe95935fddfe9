"""Powers of the cosine: their Fourier sums by the transform, and slopes by differences."""

import numpy as np
import pytest

from cardan.maths.periodic.turning_spring import hump, hump_coefficients


@pytest.mark.parametrize("power", [0, 1, 2, 4, 17, 1000])
def test_the_sum_is_the_power(power):
    count = 4096
    angle = 2.0 * np.pi * np.arange(count) / count
    spectrum = np.fft.rfft(np.cos(0.5 * angle) ** (2 * power)).real / count
    spectrum[1:] *= 2.0
    found = hump_coefficients(power)
    assert found.shape == (power + 1,)
    np.testing.assert_allclose(found, spectrum[: power + 1], atol=1e-14)
    assert np.sum(found) == pytest.approx(1.0, rel=1e-12)
    share, slope = hump(np.exp(1j * angle), power)
    np.testing.assert_allclose(share, np.cos(0.5 * angle) ** (2 * power), atol=1e-12)
    order = np.arange(power + 1)
    np.testing.assert_allclose(slope, -(order * found) @ np.sin(np.outer(order, angle)), atol=1e-10)


def test_a_number_gives_numbers():
    assert hump(-1.0 + 0.0j, 0) == (1.0, 0.0)
    assert hump(-1.0 + 0.0j, 1) == (0.0, 0.0)
