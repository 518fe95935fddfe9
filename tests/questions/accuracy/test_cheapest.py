import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from cardan.questions.accuracy.allocation import cheapest, single


@given(st.integers(0, 10**6), st.integers(1, 2), st.integers(1, 20))
def test_a_single_place_has_a_closed_form(seed, power, count):
    rng = np.random.default_rng(seed)
    weight, use = 10 ** rng.uniform(-3, 3, count), 10 ** rng.uniform(-3, 3, count)
    exact = single(weight, use, power)
    assert np.sum(use * exact**power) == pytest.approx(1.0)
    # w/t² = λ q u t^(q-1) with one λ for all.
    price = weight / exact ** (power + 1) / (power * use)
    assert price == pytest.approx(np.full(count, price[0]), rel=1e-10)
    found = cheapest(weight, use[None], power)
    # The square root of the gap.
    assert found.value == pytest.approx(exact, rel=1e-6)
    assert found.gap < 1e-12


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 2), st.integers(1, 30), st.integers(1, 120), st.floats(0.0, 5.0))
def test_the_conditions_of_an_optimum_hold(seed, power, count, places, spread):
    rng = np.random.default_rng(seed)
    weight = 10 ** rng.uniform(-spread, spread, count)
    use = rng.uniform(0.0, 1.0, (places, count)) ** 3 * 10 ** rng.uniform(-spread, spread, count)
    use[rng.integers(places), :] += 1e-3  # no column is empty
    found = cheapest(weight, use, power)
    load = use @ found.value**power
    assert np.max(load) == pytest.approx(1.0, abs=1e-12)
    assert np.all(found.price >= 0.0)
    # Slope of cost and of bounds balance; a price is paid only where the bound is reached. The cost is flat there, so
    # a gap of 1e-13 leaves the square root of it in the prices.
    slope = power * (found.price @ use) * found.value ** (power - 1)
    assert slope == pytest.approx(weight / found.value**2, rel=1e-5)
    assert np.sum(found.price * (1.0 - load)) < 1e-9 * np.sum(weight / found.value)
    assert found.gap < 1e-12


@pytest.mark.parametrize("power", [1, 2])
@pytest.mark.parametrize("seed", range(4))
def test_a_general_minimiser_finds_no_less(power, seed):
    rng = np.random.default_rng(seed)
    weight, use = rng.uniform(0.5, 2.0, 6), rng.uniform(0.0, 1.0, (12, 6))
    found = cheapest(weight, use, power)
    other = minimize(
        lambda t: np.sum(weight / t),
        0.5 * found.value,
        jac=lambda t: -weight / t**2,
        bounds=[(1e-6, None)] * 6,
        constraints={
            "type": "ineq",
            "fun": lambda t: 1.0 - use @ t**power,
            "jac": lambda t: -power * use * t ** (power - 1),
        },
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 500},
    )
    assert np.sum(weight / found.value) == pytest.approx(other.fun, rel=1e-8)
    assert found.value == pytest.approx(other.x, rel=1e-4)  # SLSQP is that near where the cost is flat


def test_random_changes_within_the_bounds_cost_more():
    rng = np.random.default_rng(3)
    weight, use = rng.uniform(0.5, 2.0, 8), rng.uniform(0.0, 1.0, (30, 8))
    found = cheapest(weight, use, 2)
    least = np.sum(weight / found.value)
    for _ in range(300):
        other = found.value * np.exp(0.1 * rng.standard_normal(8))
        other = other / np.sqrt(np.max(use @ other**2))
        assert np.sum(weight / other) >= least * (1 - 1e-12)
