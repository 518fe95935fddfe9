"""Closed formulas against their frequency equations, the book's constants, and rules by hand."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from cardan.formulas.critical_speed import (
    ENDS,
    end_roots,
    longest_tube,
    material_constant,
    scaled_speed,
    speed_margin,
    thin_tube_speed,
    tube_speed,
    uniform_speed,
)
from cardan.units import rpm

EQUATIONS = {
    "pinned-pinned": mpmath.sin,
    "fixed-fixed": lambda x: mpmath.cos(x) * mpmath.cosh(x) - 1,
    "free-free": lambda x: mpmath.cos(x) * mpmath.cosh(x) - 1,
    "fixed-pinned": lambda x: mpmath.sin(x) * mpmath.cosh(x) - mpmath.cos(x) * mpmath.sinh(x),
    "fixed-free": lambda x: mpmath.cos(x) * mpmath.cosh(x) + 1,
    "cantilever": lambda x: mpmath.cos(x) * mpmath.cosh(x) + 1,
    "fixed-guided": lambda x: mpmath.sin(x) * mpmath.cosh(x) + mpmath.cos(x) * mpmath.sinh(x),
}


@pytest.mark.parametrize("ends", ENDS)
def test_roots_are_all_those_of_the_frequency_equation(ends):
    equation = EQUATIONS[ends]
    grid = np.linspace(0.5, 20.0, 1951)
    sign = np.sign([float(equation(x)) for x in grid])
    start = grid[np.flatnonzero(np.diff(sign))]
    with mpmath.workdps(30):
        want = [float(mpmath.findroot(equation, (x, x + 0.01), solver="anderson")) for x in start]
    np.testing.assert_allclose(end_roots(ends, len(want)), want, rtol=1e-14)


def test_the_formula_takes_many_shafts():
    found = uniform_speed([1.0, 2.0], 0.05, [[0.0], [0.04]], 2.1e11, 7850.0, modes=2)
    assert found.shape == (2, 2, 2)
    np.testing.assert_allclose(found[:, 0] / found[:, 1], 4.0, rtol=1e-14)
    np.testing.assert_allclose(found[..., 1] / found[..., 0], 4.0, rtol=1e-14)


def test_the_books_constant_belongs_to_metres_and_to_a_heavier_steel():
    """E = 2.1e6 kgf/cm²: 12.19e4 at the book's 7.7 gf/cm³, 12.11e4 at 7.8, 12.07e4 at 7.85."""
    found = [material_constant(2.1e6 * 9.80665e4, density) / rpm for density in (7700.0, 7800.0, 7850.0)]
    np.testing.assert_allclose(found, [12.187e4, 12.109e4, 12.070e4], rtol=3e-4)
    same = uniform_speed(1.5, 0.07, 0.064, 2.06e11, 7850.0, modes=1)[0]
    assert tube_speed(1.5, 0.07, 0.064, constant=material_constant(2.06e11, 7850.0)) == pytest.approx(same, rel=1e-14)
    fixed = uniform_speed(1.5, 0.07, 0.064, 2.06e11, 7850.0, ends="fixed-pinned", modes=1)[0]
    book = tube_speed(1.5, 0.07, 0.064, constant=material_constant(2.06e11, 7850.0), ends="fixed-pinned")
    assert book == pytest.approx(fixed, rel=1e-14)


@pytest.mark.parametrize(("wall", "outer", "mean"), [(0.02, 2.0, -0.02), (0.05, 5.1, -0.14), (0.1, 10.4, -0.6)])
def test_thin_tubes_want_their_mean_diameter(wall, outer, mean):
    exact = tube_speed(1.0, 1.0, 1.0 - 2 * wall)
    assert 100 * (thin_tube_speed(1.0, 1.0) / exact - 1) == pytest.approx(outer, abs=0.06)
    assert 100 * (thin_tube_speed(1.0, 1.0 - wall) / exact - 1) == pytest.approx(mean, abs=0.02)


def test_twice_the_length_is_a_quarter_of_the_speed():
    assert [float(scaled_speed(6000.0, ratio)) for ratio in (2.0, 0.5)] == [1500.0, 24000.0]
    assert tube_speed(3.0, 0.08, 0.07) == pytest.approx(scaled_speed(tube_speed(1.5, 0.08, 0.07), 2.0))
    assert tube_speed(1.5, 0.16, 0.14) == pytest.approx(scaled_speed(tube_speed(1.5, 0.08, 0.07), 1.0, 2.0))


def test_the_longest_tube_just_keeps_the_rule():
    length = longest_tube(400.0, 0.076, 0.072, wear=0.85)
    found = speed_margin(float(tube_speed(length, 0.076, 0.072)), 400.0, wear=0.85)
    assert found.ratio == pytest.approx(1.6, rel=1e-14)


@pytest.mark.parametrize(
    ("critical", "most", "wear", "application", "violated"),
    [
        (1000.0, 600.0, 1.0, "automotive", ()),
        (1000.0, 660.0, 1.0, "industrial", ("article_1.6", "catalogue")),
        (1000.0, 660.0, 1.0, "automotive", ("article_1.6",)),
        (1000.0, 850.0, 0.8, "automotive", ("article_1.6", "catalogue", "supercritical")),
        (1000.0, 600.0, 0.9, "automotive", ("article_1.6",)),
    ],
)
def test_rules(critical, most, wear, application, violated):
    found = speed_margin(critical, most, wear=wear, application=application)
    assert found.violated == violated
    assert found.ratio == pytest.approx(wear * critical / most)
    assert found.rule_60_percent == (critical >= 1.6 * most)


def test_half_the_critical_speed_is_to_be_kept_out_of():
    band = speed_margin(1000.0, 300.0).band
    assert band == pytest.approx((460.0, 540.0))
    assert not speed_margin(1000.0, 600.0, operating=(300.0, 600.0)).half_inside
    assert speed_margin(1000.0, 600.0, operating=(300.0, 500.0)).half_inside
    assert speed_margin(1000.0, 600.0, operating=(300.0, 600.0), through=True).half_inside
    assert not speed_margin(1000.0, 450.0, operating=(300.0, 450.0), through=True).half_inside
