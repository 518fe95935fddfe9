"""The turning spring: plain matrices, energy by differences, and its periodic motion put back into its equation."""

import numpy as np
import pytest

from cardan.maths.periodic.turning_spring import energy_slope, hump, hump_coefficients, matrices, orbit, pull

LOSSES = (0.4, 0.1)


def plain(angle, power):
    """Return R diag(1 - fΔ) Rᵀ."""
    share = np.cos(0.5 * angle) ** (2 * power)
    turn = np.asarray([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return turn @ np.diag([1.0 - share * LOSSES[0], 1.0 - share * LOSSES[1]]) @ turn.T


@pytest.mark.parametrize("power", [0, 1, 3])
def test_force_matrix_and_moment_are_those_of_the_plain_matrix(power):
    for angle, z in ((0.3, 1.0 - 0.4j), (2.0, -0.2 + 0.9j), (5.5, 0.7 + 0.1j)):
        place, unit = np.asarray([z.real, z.imag]), np.exp(1j * angle)
        share, slope = hump(unit, power)
        matrix = plain(angle, power)
        np.testing.assert_allclose(matrices(np.asarray(angle), share, LOSSES), matrix, atol=1e-15)
        force = pull(z, unit, share, LOSSES)
        np.testing.assert_allclose([force.real, force.imag], matrix @ place, atol=1e-15)
        h = 1e-5
        rise = 0.5 * place @ (plain(angle + h, power) - plain(angle - h, power)) @ place / (2.0 * h)
        assert energy_slope(z, unit, share, slope, LOSSES) == pytest.approx(rise, abs=1e-9)  # h² of the difference


@pytest.mark.parametrize(("ratio", "power"), [(0.02, 1), (0.31, 2), (0.9, 1), (2.4, 9)])
def test_the_orbit_fulfils_the_equation_everywhere(ratio, power):
    z = orbit(ratio, 0.01, hump_coefficients(power), LOSSES, 1.0, 0.2 * np.exp(0.4j))
    order = np.arange(len(z)) - (len(z) // 2 - 1)
    angle = np.linspace(0.0, 2.0 * np.pi, 57)
    wave = np.exp(1j * np.outer(angle, order))
    place, speed, rise = wave @ z, wave @ (1j * order * z), wave @ (-(order**2) * z)
    unit = np.exp(1j * angle)
    left = ratio**2 * rise + 0.02 * ratio * speed + pull(place, unit, hump(unit, power)[0], LOSSES)
    scale = np.max(np.abs(place)) + np.max(np.abs(ratio**2 * rise))
    np.testing.assert_allclose(left - 1.0 - 0.2 * np.exp(0.4j) * unit, 0.0, atol=1e-12 * scale)


def test_without_damping_at_the_critical_speed_there_is_no_orbit():
    assert np.isnan(orbit(1.0, 0.0, np.asarray([1.0]), (0.0, 0.0), 0.0, 1.0)).all()
