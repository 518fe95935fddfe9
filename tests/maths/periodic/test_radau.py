"""The implicit method against closed forms and another integrator."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from cardan.maths.periodic.radau import Radau, tableau


class Falling:
    """y' = -rate (y - cos t) - sin t, whose solution from 1 is cos t, whatever the rate."""

    def __init__(self, rate: float) -> None:
        self.rate = rate

    def residual(self, time: np.ndarray, y: np.ndarray, slope: np.ndarray) -> np.ndarray:
        return slope + self.rate * (y - np.cos(time)[:, None]) + np.sin(time)[:, None]

    def linearised(
        self, time: np.ndarray, y: np.ndarray, slope: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        one = np.ones((len(time), 1, 1))
        return self.residual(time, y, slope), self.rate * one, one


class Determinacy:
    """x' = -x + z beside z + 0.1 z³ = x cos t, which holds no derivative."""

    def residual(self, time: np.ndarray, y: np.ndarray, slope: np.ndarray) -> np.ndarray:
        x, z = y.T
        return np.stack((slope[:, 0] + x - z, z + 0.1 * z**3 - x * np.cos(time)), axis=-1)

    def linearised(
        self, time: np.ndarray, y: np.ndarray, slope: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        by_y, by_slope = np.zeros((2, len(time), 2, 2))
        by_y[:, 0, 0], by_y[:, 0, 1] = 1.0, -1.0
        by_y[:, 1, 0], by_y[:, 1, 1] = -np.cos(time), 1.0 + 0.3 * y[:, 1] ** 2
        by_slope[:, 0, 0] = 1.0
        return self.residual(time, y, slope), by_y, by_slope


def ended(radau: Radau, end: float) -> int:
    """Go to the end; return the number of steps."""
    count = 0
    while radau.time < end:
        assert radau.step() is not None
        count += 1
    return count


def test_the_nodes_integrate_polynomials_of_twice_their_number_less_two() -> None:
    form = tableau()
    for power in range(9):
        assert form.matrix[-1] @ form.nodes**power == pytest.approx(1.0 / (power + 1), rel=1e-12)
    assert abs(form.matrix[-1] @ form.nodes**9 - 0.1) > 1e-8
    assert form.filter == pytest.approx(0.1590659, abs=1e-6)  # the real eigenvalue of Hairer and Wanner's five stages


@pytest.mark.parametrize("rate", [0.0, 1.0, 1e3, 1e9])
def test_steps_do_not_depend_on_how_stiff_the_equation_is(rate: float) -> None:
    radau = Radau(Falling(rate), 0.0, np.ones(1), 10.0, scale=lambda y: 1e-9 + 0.0 * y, first=1e-3)
    assert ended(radau, 10.0) < 60
    assert radau.y[0] == pytest.approx(np.cos(10.0), abs=1e-9)


def test_unknowns_without_a_derivative_of_their_own() -> None:
    from scipy.integrate import solve_ivp

    def other(time: float, x: float) -> float:
        return brentq(lambda z: z + 0.1 * z**3 - x * np.cos(time), -9.0, 9.0, xtol=1e-15)

    wanted = solve_ivp(
        lambda t, y: [-y[0] + other(t, y[0])], (0.0, 3.0), [2.0], method="DOP853", rtol=1e-12, atol=1e-13
    )
    radau = Radau(Determinacy(), 0.0, [2.0, other(0.0, 2.0)], 3.0, scale=lambda y: 1e-8 * (1.0 + np.abs(y)), first=1e-2)
    ended(radau, 3.0)
    assert radau.y[0] == pytest.approx(wanted.y[0, -1], abs=1e-11)
    assert radau.y[1] == pytest.approx(other(3.0, radau.y[0]), abs=1e-11)


def test_between_its_ends_a_step_is_a_polynomial_and_so_are_integrals() -> None:
    radau = Radau(Falling(1e3), 0.0, np.ones(1), 0.5, scale=lambda y: 1e-4 + 0.0 * y, first=0.5)
    step = radau.step()
    assert step is not None
    times = np.linspace(step.start, step.end, 7)
    np.testing.assert_allclose(step.at(times)[:, 0], np.cos(times), atol=2e-5)
    np.testing.assert_allclose(step.slope(times)[:, 0], -np.sin(times), atol=2e-3)
    values = np.cos(step.stages[0])
    np.testing.assert_allclose(step.at(times, values), np.sin(times), atol=1e-5)
    assert step.integral(values) == pytest.approx(np.sin(step.end), abs=1e-9)


def test_where_no_step_is_short_enough_there_is_none() -> None:
    class Bursting(Falling):
        """y' = y², infinite at 1."""

        def residual(self, time: np.ndarray, y: np.ndarray, slope: np.ndarray) -> np.ndarray:
            return slope - y**2

        def linearised(
            self, time: np.ndarray, y: np.ndarray, slope: np.ndarray
        ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
            return self.residual(time, y, slope), -2.0 * y[..., None], np.ones((len(time), 1, 1))

    radau = Radau(Bursting(0.0), 0.0, np.ones(1), 2.0, scale=lambda y: 1e-9 * (1.0 + np.abs(y)), first=0.1)
    with np.errstate(all="ignore"):
        while radau.step() is not None:
            assert radau.time < 2.0
    assert radau.time == pytest.approx(1.0, abs=1e-6)
