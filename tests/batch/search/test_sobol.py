"""Sobol' indices against Ishigami's closed form, a sum of fields, and scipy's own."""

import math

import numpy as np
import pytest

from cardan.batch.answering.asking import Formula
from cardan.batch.points.distributions import Uniform
from cardan.batch.search.sobol import RESAMPLES, _design, one_at_a_time, sensitivity
from cardan.errors import InputError

A, B = 7.0, 0.1
PI = Uniform(low=-math.pi, high=math.pi)
ISHIGAMI = Formula.of(
    ["x1", "x2", "x3"],
    {
        "y": lambda x, y, z: np.sin(x) + A * np.sin(y) ** 2 + B * z**4 * np.sin(x),
        "still": lambda x, y, z: 2.0 + 0.0 * x,
        "sum": lambda x, y, z: 2.0 * x + y,
    },
)


def closed_form():
    """Return first and total indices of Ishigami and Homma's function, from the integrals of its parts."""
    one = 0.5 * (1.0 + B * math.pi**4 / 5.0) ** 2
    two = A**2 / 8.0
    both = B**2 * math.pi**8 * 8.0 / 225.0
    whole = one + two + both
    return np.asarray([one, two, 0.0]) / whole, np.asarray([one + both, two, both]) / whole, math.sqrt(whole)


FOUND = sensitivity(ISHIGAMI, [PI] * 3, samples=4096, seed=3)


def test_ishigami():
    """4096 points of a Sobol' sequence leave about 0.005; a Monte Carlo sample would leave 0.02."""
    first, total, deviation = closed_form()
    np.testing.assert_allclose(FOUND.first[0], first, atol=0.01)
    np.testing.assert_allclose(FOUND.total[0], total, atol=0.01)
    assert FOUND.mean[0] == pytest.approx(A / 2.0, rel=2e-3)
    assert FOUND.deviation[0] == pytest.approx(deviation, rel=3e-3)
    assert FOUND.evaluations == 4096 * 5
    assert FOUND.ranked(0) == (0, 1, 2)


def test_the_ranges_hold_the_truth_and_narrow_with_the_samples():
    first, total, _ = closed_form()
    few = sensitivity(ISHIGAMI, [PI] * 3, samples=256, seed=3)
    for found in (FOUND, few):
        for exact, (low, high) in (
            (first, np.moveaxis(found.first_range[0], -1, 0)),
            (total, np.moveaxis(found.total_range[0], -1, 0)),
        ):
            assert np.all((low <= exact) & (exact <= high))
    # Sixteen times the samples: a quarter of the width.
    ratio = np.ptp(few.total_range[0], axis=-1) / np.ptp(FOUND.total_range[0], axis=-1)
    assert np.all((ratio > 2.0) & (ratio < 8.0))


def test_a_sum_has_no_shares_together_and_what_is_still_has_none():
    """Var(2x + y) = 4 Var x + Var y."""
    np.testing.assert_allclose(FOUND.first[2], [0.8, 0.2, 0.0], atol=5e-3)
    np.testing.assert_allclose(FOUND.total[2], [0.8, 0.2, 0.0], atol=5e-3)
    assert np.all(np.isnan(FOUND.first[1]))
    assert FOUND.deviation[1] == 0.0


def test_they_are_those_of_scipy():
    from scipy.stats import sobol_indices

    points = _design([PI] * 3, 4096, 3)
    values = ISHIGAMI(points.reshape(-1, 3))["y"].reshape(5, 1, 4096)
    other = sobol_indices(func={"f_A": values[0], "f_B": values[1], "f_AB": values[2:]}, n=4096)
    # The same sums but for what the variance is taken about.
    np.testing.assert_allclose(FOUND.first[0], other.first_order, atol=1e-3)
    np.testing.assert_allclose(FOUND.total[0], other.total_order, atol=1e-3)


def test_the_same_seed_gives_the_same_numbers_and_another_others():
    again, other = (sensitivity(ISHIGAMI, [PI] * 3, samples=64, seed=seed, answers=["y"]) for seed in (5, 6))
    np.testing.assert_array_equal(
        again.total_range, sensitivity(ISHIGAMI, [PI] * 3, samples=64, seed=5, answers=["y"]).total_range
    )
    assert not np.array_equal(again.first, other.first)
    assert RESAMPLES >= 100


def test_samples_without_an_answer_are_left_out_and_counted():
    holes = Formula.of(["x", "y"], {"z": lambda x, y: np.where(x < 0.9, x + y, np.nan)})
    found = sensitivity(holes, [Uniform(low=0.0, high=1.0)] * 2, samples=512)
    # A sample stays if x is below 0.9 at A and at B: 0.81 of them.
    assert found.left_out == pytest.approx(512 * 0.19, abs=12)
    assert found.samples + found.left_out == 512
    assert found.first[0, 1] > found.first[0, 0]
    with pytest.raises(InputError, match="samples have an answer"):
        sensitivity(Formula.of(["x"], {"z": lambda x: x * np.nan}), [PI], samples=16)


def test_work_can_be_stopped():
    found = sensitivity(ISHIGAMI, [PI] * 3, samples=64, progress=lambda share: "stop")
    assert (found.status, found.evaluations) == ("cancelled", 0)
    assert np.all(np.isnan(found.total))


def test_everything_wrong_is_told_at_once():
    with pytest.raises(InputError) as refused:
        sensitivity(ISHIGAMI, [PI], samples=2, confidence=1.0, answers=["zz"])
    assert len(refused.value.problems) == 4


def test_more_samples_than_memory_holds_are_refused():
    with pytest.raises(InputError, match="too many; at most 8947848 can be held"):
        sensitivity(ISHIGAMI, [PI] * 3, samples=10**12)


def test_one_at_a_time():
    found = one_at_a_time(ISHIGAMI, [0.0, 0.0, 0.0], [-1.0, -1.0, -1.0], [1.0, 2.0, 1.0])
    np.testing.assert_allclose(found.at_high[0], [math.sin(1.0), 7.0 * math.sin(2.0) ** 2, 0.0])
    np.testing.assert_allclose(found.at_low[2], [-2.0, -1.0, 0.0])
    np.testing.assert_allclose(found.middle, [0.0, 2.0, 0.0])
