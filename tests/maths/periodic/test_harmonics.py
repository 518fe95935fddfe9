"""Harmonic balance against integration in time, and its systems of blocks against whole ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from cardan.maths.curves.extremes import extremes, sampled_series, series_at
from cardan.maths.periodic.harmonics import HarmonicBalance, Linearised, Status, harmonic_balance, solve_blocks


def duffing(_rows, phase, x, v, a):
    one = np.ones_like(x)
    return Linearised(
        balance=a + 0.1 * v + x + x**3 - np.cos(phase)[:, None],
        mass=one,
        damping=0.1 * one[..., None],
        stiffness=(one + 3.0 * x**2)[..., None],
    )


def test_a_hardening_swing_moves_as_integrated_in_time() -> None:
    frequency = 0.8
    found = harmonic_balance(duffing, [frequency], 1)

    def right(t, y):
        return [y[1], np.cos(frequency * t) - 0.1 * y[1] - y[0] - y[0] ** 3]

    period = 2.0 * np.pi / frequency

    def missed(y):
        return solve_ivp(right, (0.0, period), y, method="DOP853", rtol=1e-12, atol=1e-12).y[:, -1] - y

    x, rate, _joint_angle = found.at([0.0])
    start = fsolve(missed, [x[0, 0, 0], frequency * rate[0, 0, 0]], xtol=1e-12)
    # The tail of the harmonics is cut at 1e-9 of the motion.
    assert [x[0, 0, 0], frequency * rate[0, 0, 0]] == pytest.approx(start, rel=2e-8)
    assert found.status[0] == Status.CONVERGED


def test_many_frequencies_at_once_equal_each_alone() -> None:
    frequencies = np.asarray([0.3, 0.8, 2.5, 6.0])
    together = harmonic_balance(duffing, frequencies, 1)
    for k, frequency in enumerate(frequencies):
        alone = harmonic_balance(duffing, [frequency], 1)
        size = min(alone.coefficient.shape[-1], together.coefficient.shape[-1])
        np.testing.assert_allclose(together.coefficient[k, :, :size], alone.coefficient[0, :, :size], atol=1e-12)


def test_too_few_harmonics_are_told() -> None:
    found = harmonic_balance(duffing, [0.3], 1, method=HarmonicBalance(harmonics=4, most=4))
    assert found.status[0] == Status.COARSE
    assert found.tail[0] > 1e-6


def test_what_has_no_motion_is_told() -> None:
    def endless(_rows, phase, x, v, a):  # exp x + 1 is nowhere 0
        one = np.ones_like(x)
        slope = np.exp(x)[..., None]
        return Linearised(balance=0.0 * a + np.exp(x) + 1.0, mass=one, damping=0.0 * slope, stiffness=slope)

    with np.errstate(over="ignore", invalid="ignore"):
        assert harmonic_balance(endless, [1.0], 1).status[0] == Status.NO_CONVERGENCE


@pytest.mark.parametrize("chain", [True, False])
def test_blocks_solve_as_the_whole(chain: bool) -> None:
    rng = np.random.default_rng(3)
    count, rank, size = 4, 5, 3
    pairs = [(r, s) for r in range(rank) for s in range(rank) if abs(r - s) <= 1 or (not chain and (r + s) == 4)]
    blocks = {
        pair: rng.normal(size=(count, size, size)) + (4.0 * np.eye(size) if pair[0] == pair[1] else 0.0)
        for pair in pairs
    }
    right = rng.normal(size=(count, rank, size))
    whole = np.zeros((count, rank, size, rank, size))
    for (r, s), block in blocks.items():
        whole[:, r, :, s] = block
    wanted = np.linalg.solve(whole.reshape(count, rank * size, -1), right.reshape(count, -1, 1))
    np.testing.assert_allclose(solve_blocks(blocks, right).reshape(count, -1), wanted[..., 0], atol=1e-10)


def test_a_singular_system_among_others_does_not_spoil_them() -> None:
    blocks = {(0, 0): np.stack([np.zeros((2, 2)), 2.0 * np.eye(2)])}
    found = solve_blocks(blocks, np.ones((2, 1, 2)))
    assert np.isfinite(found).all()
    np.testing.assert_allclose(found[1, 0], [0.5, 0.5])


def test_samples_give_back_the_sum() -> None:
    rng = np.random.default_rng(5)
    wanted = rng.normal(size=(2, 6)) + 1j * rng.normal(size=(2, 6)) * (np.arange(6) > 0)
    phase = 2.0 * np.pi * np.arange(16) / 16
    found = sampled_series(series_at(wanted[None], phase)[0][0].T)
    np.testing.assert_allclose(found[:, :6], wanted, atol=1e-13)
    np.testing.assert_allclose(found[:, 6:], 0.0, atol=1e-13)


def test_extremes_are_those_of_a_million_places() -> None:
    rng = np.random.default_rng(6)
    waves = rng.normal(size=(5, 9)) + 1j * rng.normal(size=(5, 9)) * (np.arange(9) > 0)
    low, high = extremes(waves)
    phase = np.linspace(0.0, 2.0 * np.pi, 200_001)
    values = series_at(waves, phase)[0]
    # Steps of 3e-5 rad miss a peak by half their square times its joint angle, 3e-8 here.
    np.testing.assert_allclose(low, values.min(axis=0), atol=1e-7)
    np.testing.assert_allclose(high, values.max(axis=0), atol=1e-7)
    assert np.all(high >= values.max(axis=0) - 1e-12)
