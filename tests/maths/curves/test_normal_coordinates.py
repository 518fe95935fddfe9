"""Functions of normal coordinates, against closed forms: moments, Rice's rates, Mehler's spectra."""

import math

import numpy as np
import pytest

from cardan.maths.curves.normal_coordinates import chance, grid_of, spectrum

FLAT = ([1.0, 2.0], [1.0, 1.0])


def rise(level, deviation, rate):
    """Return how often a normal process rises through a level, S. O. Rice (1945)."""
    return rate / deviation / (2.0 * math.pi) * math.exp(-0.5 * (level / deviation) ** 2)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_moments_of_squares_are_those_of_chi_square(count):
    found = chance(lambda z: np.sum(z**2, axis=-1)[None], [1.0] * count, grid_of(count))
    assert found.mean[0] == pytest.approx(count, rel=1e-6)
    assert found.deviation[0] == pytest.approx(math.sqrt(2.0 * count), rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("slopes", "rates"), [([3.0], [2.0]), ([3.0, 4.0], [1.0, 2.0]), ([1.0, 2.0, 2.0], [1.0] * 3)])
def test_a_sum_rises_through_rare_levels_as_rice_says(slopes, rates):
    deviation, rate = math.hypot(*slopes), math.hypot(*(a * w for a, w in zip(slopes, rates, strict=True)))
    found = chance(lambda z: (z @ slopes)[None], rates, grid_of(len(slopes)))
    assert (found.mean[0], found.deviation[0]) == pytest.approx((0.0, deviation), abs=1e-6)
    # Rays that are drawn tell a rare rate to some per cent, its logarithm and so the level far better.
    for level in (2.0 * deviation, 3.5 * deviation):
        assert found.rate(0, level)[0] == pytest.approx(
            rise(level, deviation, rate), rel=1e-3 if len(slopes) < 3 else 0.1
        )
    often = 1e-3
    exact = deviation * math.sqrt(2.0 * math.log(rate / deviation / (2.0 * math.pi * often)))
    assert found.level(0, often) == pytest.approx(exact, rel=1e-3)
    assert found.level(0, often, least=True) == pytest.approx(-exact, rel=1e-3)


def test_the_envelope_of_two_coordinates_rises_as_rice_says():
    """R² = z_1² + z_2² of the same rate ω: R rises through r at ω r exp(-r²/2)/√(2π)."""
    found = chance(lambda z: np.sum(z**2, axis=-1)[None], [2.0, 2.0], grid_of(2))
    for r in (1.0, 2.5, 4.0):
        exact = 2.0 / math.sqrt(2.0 * math.pi) * r * math.exp(-0.5 * r * r)
        # Straight between radii 0.05 apart: (0.05)²/8 of r, which the exponential magnifies by r².
        assert found.rate(0, r * r)[0] == pytest.approx(exact, rel=2e-3)


def test_a_size_has_the_moments_of_the_folded_law_despite_its_kink():
    found = chance(lambda z: np.abs(z[:, 0])[None], [1.0], grid_of(1))
    assert found.mean[0] == pytest.approx(math.sqrt(2.0 / math.pi), rel=1e-7)
    assert found.rate(0, 3.0)[0] == pytest.approx(2.0 * rise(3.0, 1.0, 1.0), rel=1e-3)


def test_a_level_that_is_never_reached_is_none():
    found = chance(lambda z: np.tanh(z[:, 0])[None] * 0.0, [1.0], grid_of(1))
    assert math.isnan(found.level(0, 1.0))


def test_the_spectrum_of_a_square_is_that_of_the_coordinate_folded_on_itself():
    """Of z² with a flat spectrum on [1, 2]: twice the self-convolution, a triangle at 0…1 and one at 2…4."""
    found = chance(lambda z: np.stack((z[:, 0], z[:, 0] ** 2)), [1.5], grid_of(1))
    omega, density, held = spectrum(found, [FLAT])
    assert held == pytest.approx([1.0, 1.0], rel=1e-6)
    assert np.trapezoid(density, omega, axis=-1) == pytest.approx([1.0, 2.0], rel=2e-3)
    for at, exact in ((0.5, 1.0), (3.0, 1.0), (2.5, 0.5), (1.5, 0.0)):
        assert np.interp(at, omega, density[1]) == pytest.approx(exact, abs=0.03), at


def test_powers_of_two_coordinates_share_their_spectra():
    """z_1 z_2 has the convolution of both spectra, on 0…1 and 2…4, and the variance 1."""
    found = chance(lambda z: np.prod(z, axis=-1)[None], [1.5, 1.5], grid_of(2))
    omega, density, held = spectrum(found, [FLAT, FLAT])
    assert (found.deviation[0], held[0]) == pytest.approx((1.0, 1.0), rel=1e-5)
    assert np.trapezoid(density[0], omega) == pytest.approx(1.0, rel=2e-3)
    assert np.interp(3.0, omega, density[0]) == pytest.approx(0.5, abs=0.02)
