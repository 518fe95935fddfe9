"""Ties and residuals: what rounding decides is not told."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cardan.maths.ties import ROUNDING, alike, foremost, foremost_of, foremost_on, largest, power_of

LAST = np.spacing(1.0)
"""One unit in the last place of a number near 1."""


@pytest.mark.parametrize("by", [-4, -1, 0, 1, 4])
def test_the_last_digits_do_not_decide(by):
    near = 2374.0 * (1.0 + by * LAST)
    assert largest([547.8, 2374.0, near, 547.8]) == largest([547.8, near, 2374.0, 547.8]) == (1, 2)
    assert int(foremost([547.8, 2374.0, near])) == int(foremost([547.8, near, 2374.0])) == 1
    assert int(foremost([7.0, near, 2374.0], least=True)) == 0
    assert int(foremost([9000.0, near, 2374.0], least=True)) == 1


def test_what_differs_is_told_apart():
    assert largest([1.0, 1.0 + 1e-8]) == (1,)
    assert int(foremost([-1.0, -1.0 + 1e-8])) == 1


def test_nothing_and_the_endless_are_no_ties():
    assert largest([]) == ()
    assert largest([np.nan, np.nan]) == ()
    assert largest([1.0, np.inf, np.nan, np.inf]) == (1, 3)
    assert int(foremost([np.nan, 1.0])) == 1
    assert int(foremost([np.inf, 3.0, 3.0], least=True)) == 1
    assert int(foremost([np.nan, np.nan])) == 0


def test_zeros_are_alike():
    assert largest([0.0, -0.0, 0.0]) == (0, 1, 2)
    # Beside nought everything is large: a share of it says nothing of rounding.
    assert largest([0.0, 1e-300]) == (1,)


def test_batches_are_judged_row_by_row():
    table = np.asarray([[1.0, 2.0, 2.0 * (1 + LAST)], [3.0 * (1 + LAST), 3.0, 1.0]])
    assert foremost(table).tolist() == [1, 0]
    assert alike(table).tolist() == [[False, True, True], [True, True, False]]


def test_a_curve_is_rounded_by_its_largest_size():
    angle = np.radians(np.arange(720))
    rng = np.random.default_rng(1)
    for _draw in range(20):
        noisy = np.cos(2.0 * angle) + 1e-15 * rng.standard_normal(angle.size)
        assert int(foremost_on(noisy)) == 0
        assert int(foremost_on(noisy, least=True)) == 90
        # Its largest value is all but nought there; what it is a share of is the curve.
        assert int(foremost_on(noisy - 1.0)) == 0


def test_items_go_by_the_same_rule():
    names = {"a": 1.0, "b": 2.0, "c": 2.0 * (1 + LAST)}
    assert foremost_of(names, names.__getitem__) == "b"
    assert foremost_of(names, names.__getitem__, least=True) == "a"
    with pytest.raises(ValueError, match="no items"):
        foremost_of((), len)


@pytest.mark.parametrize(("rest", "power"), [(0.0, None), (ROUNDING, None), (1.01e-12, -11), (1e-9, -9), (2e-9, -8)])
def test_a_residual_is_a_power_of_ten(rest, power):
    assert power_of(rest) == power


def test_two_processors_tell_the_same():
    assert power_of(5e-14) == power_of(6e-14)
    assert power_of(3.2e-10) == power_of(3.3e-10) == math.ceil(math.log10(3.2e-10))
