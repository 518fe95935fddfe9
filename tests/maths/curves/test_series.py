import numpy as np
import pytest

from cardan.maths.curves.extremes import crossings, turning_points, values_at

POLYNOMIAL = np.polynomial.Polynomial([0.3, -1.0, 0.7, 0.9, -0.4, -0.2])


def of(times, p=POLYNOMIAL):
    return times, p(times), p.deriv(1)(times), p.deriv(2)(times)


def test_fifth_degree_polynomials_are_exact_between_the_instants():
    series = of(np.asarray([-1.0, 0.4, 2.0]))
    at = np.linspace(-1.0, 2.0, 31)
    # Degree five is reproduced; rounding is left.
    np.testing.assert_allclose(values_at(series, at), POLYNOMIAL(at), atol=1e-13)
    np.testing.assert_allclose(values_at(series, at, order=1), POLYNOMIAL.deriv()(at), atol=1e-13)


def test_crossings_and_turning_points_are_the_roots():
    times = np.linspace(-2.0, 2.5, 10)
    roots = [r.real for r in POLYNOMIAL.roots() if abs(r.imag) < 1e-12 and -2.0 < r.real < 2.5]
    np.testing.assert_allclose(crossings(of(times)), sorted(roots), atol=1e-13)
    turns = [r.real for r in POLYNOMIAL.deriv().roots() if abs(r.imag) < 1e-12 and -2.0 < r.real < 2.5]
    at, values = turning_points(of(times))
    np.testing.assert_allclose(at[1:-1], sorted(turns), atol=1e-13)
    np.testing.assert_allclose(values, POLYNOMIAL(at), atol=1e-13)


def test_level_met_exactly_at_an_instant_is_found_once():
    times = np.asarray([0.0, 1.0, 2.0])
    line = np.polynomial.Polynomial([-1.0, 1.0])
    assert list(crossings(of(times, line))) == [1.0]


def test_single_instant():
    at, values = turning_points(of(np.asarray([0.5])))
    assert list(at) == [0.5]
    assert values[0] == pytest.approx(POLYNOMIAL(0.5))
