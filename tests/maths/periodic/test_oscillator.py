"""An oscillator under known forces: direct integration, more digits, closed cases."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.maths.periodic.oscillator import CHUNK, advanced, chirp, impulse, stepped


def integrated(force, omega, zeta, times):
    def rate(t, y):
        return [y[1], force(t) - 2 * zeta * omega * y[1] - omega**2 * y[0]]

    return solve_ivp(rate, (0, times[-1]), [0, 0], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=times).y


@pytest.mark.slow
@pytest.mark.parametrize(
    ("omega", "zeta", "rate"),
    [(20, 0.02, 8.0), (20, 0.0, 30.0), (20, 0.7072, 8.0), (20, 0.95, 40.0), (20, 3.0, 50.0), (5, 0.1, 300.0)],
)
def test_a_rising_frequency_agrees_with_direct_integration(omega, zeta, rate):
    times = np.linspace(0, min(6.0, 3 * omega / rate + 1), 13)
    x, velocity = chirp(times, omega, zeta, rate)
    for part, turn in ((x.real, 0.0), (x.imag, -np.pi / 2)):
        wanted = integrated(lambda t, turn=turn: omega**2 * np.cos(0.5 * rate * t * t + turn), omega, zeta, times)
        # DOP853 leaves 1e-11 of amplitudes up to 10, and ω times that in the velocity.
        np.testing.assert_allclose(part, wanted[0], atol=1e-10)
        other = velocity.real if turn == 0.0 else velocity.imag
        np.testing.assert_allclose(other, wanted[1], atol=3e-9)


@pytest.mark.slow
@pytest.mark.parametrize("time", [3.0, 100.0, 1990.0, 2000.0, 2010.0, 2600.0])
def test_slow_runs_neither_overflow_nor_lose_digits(time):
    """The printed form multiplies e^800 by a difference of error functions; erfc in 60 digits keeps it."""
    omega, zeta, rate = 20.0, 0.02, 0.01
    with mpmath.workdps(60):
        w, z, a, t = (mpmath.mpf(one) for one in (omega, zeta, rate, time))
        s, p = w * mpmath.mpc(-z, mpmath.sqrt(1 - z * z)), mpmath.sqrt(mpmath.mpc(0, -a / 2))

        def part(s):
            q = s / (2 * p)
            size = mpmath.exp(s * t + q * q) * mpmath.sqrt(mpmath.pi) / (2 * p)
            return size * (mpmath.erfc(-q - p * t) - mpmath.erfc(-q))

        exact = w * w * (part(s) - part(mpmath.conj(s))) / (s - mpmath.conj(s))
    found = chirp(time, omega, zeta, rate)[0]
    # The phase ω²/2a of 20000 rad is known to 4e-12 in 64 bits, the largest response is 25.
    assert abs(complex(exact) - found) < 2e-10


@pytest.mark.parametrize("zeta", [0.0, 0.3, 1.0, 1.5])
def test_impulses_solve_the_equation(zeta):
    omega, t, h = 7.0, np.linspace(0.0, 1.0, 9), 1e-6
    x, v = impulse(t, omega, zeta)
    before, after = impulse(t - h, omega, zeta), impulse(t + h, omega, zeta)
    assert (x[0], v[0]) == (0.0, 1.0)
    np.testing.assert_allclose((after[0] - before[0]) / (2 * h), v, atol=1e-9)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * h), -2 * zeta * omega * v - omega**2 * x, atol=1e-8)


@pytest.mark.parametrize("zeta", [0.0, 0.05, 1.0, 2.5])
@pytest.mark.parametrize("steps", [50, 3 * CHUNK + 7])
def test_steps_follow_any_force(zeta, steps):
    omega, end = 6.0, 3.0

    def force(t):
        return 10.0 * np.exp(-t) + np.sin(3 * t)

    pieces = list(stepped(force, end, steps, omega, zeta))
    assert len(pieces) == -(-steps // CHUNK)
    assert all(one[0][-1] == other[0][0] for one, other in pairwise(pieces))
    time, x, v = (np.concatenate([piece[k] for piece in pieces]) for k in range(3))
    wanted = integrated(force, omega, zeta, np.asarray([0.0, 1.0, end]))
    assert time[-1] == pytest.approx(end, rel=1e-14)
    np.testing.assert_allclose([x[-1], v[-1]], wanted[:, -1], atol=1e-10)


def test_any_place_between_steps_is_reached_from_the_one_before():
    omega, zeta = 6.0, 0.2
    *_rest, (time, x, v) = stepped(np.cos, 2.0, 20, omega, zeta)
    rows = np.asarray([3, 11])
    found = advanced(np.cos, time[rows], np.asarray([0.013, 0.08]), (x[rows], v[rows]), omega, zeta)
    wanted = integrated(np.cos, omega, zeta, np.asarray([0.0, 0.3 + 0.013, 1.1 + 0.08]))
    np.testing.assert_allclose(found, wanted[:, 1:], atol=1e-11)
