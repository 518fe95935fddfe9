"""Motions of two frequencies against integration and closed forms."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from cardan.maths.periodic.harmonics import Linearised
from cardan.maths.periodic.torus import samples_of, torus_balance, torus_phases

RATIO, OMEGA = np.sqrt(3.0), 1.7


def equation(harmonics, cubic, wave, first=1.0, second=0.7):
    """Return the balance of x'' + 0.2 x' + (1 + wave cos z) x + cubic x³ = first cos z + second sin θ.

    z = ωt, θ = √3 z.
    """
    theta = torus_phases(samples_of(harmonics))[1]

    def at(rows, z, x, v, a):
        spring = 1.0 + wave * np.cos(z)[:, None]
        forced = (first * np.cos(z) + second * np.sin(theta))[:, None]
        one = np.ones_like(x)
        return Linearised(
            balance=a + 0.2 * v + spring * x + cubic * x**3 - forced,
            mass=one,
            damping=0.2 * one[..., None],
            stiffness=(spring + 3.0 * cubic * x**2)[..., None],
        )

    return at


def test_a_linear_motion_is_the_sum_of_two() -> None:
    found = torus_balance(equation((2, 1), 0.0, 0.0), [OMEGA], 1, ratio=RATIO, harmonics=(2, 1))
    assert found.found.all()
    for place, rate, force in (((1, 0), OMEGA, 0.5), ((0, 1), RATIO * OMEGA, -0.35j)):
        wanted = force / (1.0 - rate**2 + 0.2j * rate)
        np.testing.assert_allclose(found.coefficient[0, 0][place], wanted, rtol=1e-12)


def test_what_is_nonlinear_and_swings_is_what_time_steps_find() -> None:
    harmonics = (8, 6)
    found = torus_balance(equation(harmonics, 0.1, 0.4), [OMEGA], 1, ratio=RATIO, harmonics=harmonics)

    def right(t, y):
        forced = np.cos(OMEGA * t) + 0.7 * np.sin(RATIO * OMEGA * t)
        return [y[1], forced - 0.2 * y[1] - (1.0 + 0.4 * np.cos(OMEGA * t)) * y[0] - 0.1 * y[0] ** 3]

    times = np.linspace(250.0, 300.0, 400)
    wanted = solve_ivp(right, (0.0, 300.0), [0.0, 0.0], "DOP853", times, rtol=1e-10, atol=1e-12).y[0]
    m, n = (np.fft.fftfreq(count, 1.0 / count) for count in found.coefficient.shape[-2:])
    turn = np.exp(1j * OMEGA * times[:, None, None] * (m[:, None] + RATIO * n))
    np.testing.assert_allclose(np.sum(turn * found.coefficient[0, 0], axis=(1, 2)).real, wanted, atol=1e-6)
    assert found.found.all()


def test_motions_are_followed_round_a_resonance_that_bends_over() -> None:
    """The second frequency goes from 1.1 to 2.4 times that of the small oscillation, and the spring hardens."""
    harmonics, omega = (5, 7), np.linspace(1.1, 2.4, 40) / RATIO
    whole, alone = (equation(harmonics, 0.15, 0.2, 0.2, second) for second in (1.0, 0.0))
    plain, found = (
        torus_balance(whole, omega, 1, ratio=RATIO, harmonics=harmonics, alone=one) for one in (None, alone)
    )
    assert found.found.all()
    assert not plain.found.all()
    at = np.linspace(0.0, 60.0, 50)
    x, v, a = (one[:, 0, :, 0] for one in found.along(at, np.zeros(1)))
    rate = omega[:, None]
    forced = 0.2 * np.cos(at) + np.sin(RATIO * at)
    left = rate**2 * a + 0.2 * rate * v + (1.0 + 0.2 * np.cos(at)) * x + 0.15 * x**3 - forced
    assert np.max(np.abs(left)) < 0.02 * np.max(np.abs(rate**2 * a))
