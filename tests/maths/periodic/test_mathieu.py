import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.special import mathieu_a, mathieu_b

from cardan.errors import InputError
from cardan.maths.periodic.mathieu import boundaries, damped_zone, exponents


def monodromy(a, q, n=0.0):
    """Return the matrix over a period, by integrating the equation as it stands."""

    def rate(z, y):
        return [y[1], -2 * n * y[1] - (a - 2 * q * np.cos(2 * z)) * y[0]]

    columns = [
        solve_ivp(rate, (0, np.pi), start, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        for start in ([1.0, 0.0], [0.0, 1.0])
    ]
    return np.asarray(columns).T


@pytest.mark.parametrize(
    ("a", "q"),
    [(0.774, 0.0066), (1.0, 0.1), (4.0, 2.0), (25.0, 10.0), (-0.1, 0.6), (-3.0, 5.0), (9.0, -3.0), (16.0, 0.01)],
)
def test_half_trace_is_that_of_the_integrated_equation(a, q):
    # The integrator is good to about 1e-12 of the solutions, which grow with the half trace.
    found = exponents(a, q)
    wanted = 0.5 * np.trace(monodromy(a, q))
    assert float(found.half_trace) == pytest.approx(wanted, rel=3e-12, abs=3e-12)
    assert found.residual < 1e-14


@pytest.mark.parametrize(("a", "q", "n"), [(1.0, 0.1, 0.049), (1.0, 0.1, 0.0505), (4.1, 2.0, 0.3), (0.5, 0.2, 0.01)])
def test_growth_with_damping_is_that_of_the_integrated_equation(a, q, n):
    found = exponents(a, q, n)
    radius = np.max(np.abs(np.linalg.eigvals(monodromy(a, q, n))))
    assert float(found.growth) == pytest.approx(np.log(radius) / np.pi, abs=1e-11)
    assert bool(found.stable) == (radius <= 1.0)


def test_exponent_turns_as_the_multipliers_do():
    found = exponents(2.0, 0.5)
    angle = np.abs(np.angle(np.linalg.eigvals(monodromy(2.0, 0.5))))[0]
    assert float(found.beta) == pytest.approx(angle / np.pi, abs=1e-11)


@given(st.floats(-200.0, 400.0), st.floats(-150.0, 150.0))
@example(2.2e-311, 0.0)
def test_both_forms_of_the_half_trace_agree(a, q):
    """Hill's determinant of the even and of the odd rows know nothing of one another."""
    assert exponents(a, q).residual < 1e-12


@given(st.floats(-20.0, 60.0), st.floats(0.0, 30.0))
def test_a_shift_by_a_quarter_turn_changes_the_sign_of_q_and_nothing_else(a, q):
    one, other = exponents(a, q), exponents(a, -q)
    assert float(one.half_trace) == pytest.approx(float(other.half_trace), rel=1e-12, abs=1e-12)


def test_without_a_wave_the_half_trace_is_a_cosine_even_where_rows_vanish():
    a = np.asarray([0.0, 0.5, 1.0, 4.0, 4.0 + 1e-12, 9.0, 16.0, 36.0, 400.0])
    found = exponents(a, 0.0)
    assert found.half_trace == pytest.approx(np.cos(np.pi * np.sqrt(a)), abs=2e-15)
    assert np.all(found.growth == 0.0)
    assert np.all(found.stable)
    below = np.asarray([-0.5, -4.0, -100.0])
    assert exponents(below, 0.0).half_trace == pytest.approx(np.cosh(np.pi * np.sqrt(-below)), rel=1e-14)
    assert exponents(below, 0.0).growth == pytest.approx(np.sqrt(-below), rel=1e-14)


@pytest.mark.parametrize("n", [0.0, 0.1])
def test_at_a_square_the_half_trace_goes_on_smoothly(n):
    """Rows of the determinant vanish where a' = 4r² and r odd²; neighbours on both sides must meet there."""
    for square in (0.0, 1.0, 4.0, 9.0, 16.0):
        a = square + n * n + np.asarray([-1e-6, 0.0, 1e-6])
        left, middle, right = exponents(a, 0.7, n).half_trace
        assert middle == pytest.approx(0.5 * (left + right), abs=1e-11)


def test_boundaries_are_those_of_scipy():
    for q in (0.0066, -0.1, 1.0, 5.0, 12.0):
        a, b = boundaries(q, 9)
        assert a == pytest.approx([mathieu_a(r, q) for r in range(10)], rel=1e-13, abs=1e-13)
        assert b == pytest.approx([mathieu_b(r, q) for r in range(1, 10)], rel=1e-13, abs=1e-13)


def test_boundaries_of_high_order_and_large_q_are_where_determinants_vanish():
    """Beyond the range where SciPy's own are right: a_30(100) there is off by 77."""
    a, b = boundaries(100.0, 30)
    for values, first in ((a[20:], 20), (b[20:], 21)):
        for r, value in enumerate(values, start=first):
            assert abs(float(exponents(value, 100.0).half_trace) - (-1.0) ** r) < 1e-10
    assert a[30] == pytest.approx(900 + 100**2 / (2 * (900 - 1)), abs=0.05)


def test_boundaries_bend_as_the_series_say():
    """a_1, b_1 = 1 ± q - q²/8 ∓ q³/64, a_0 = -q²/2 + 7q⁴/128: the terms left out are of order q⁴ and q⁶."""
    q = 0.01
    a, b = boundaries(q, 1)
    assert a[1] == pytest.approx(1 + q - q**2 / 8 - q**3 / 64, abs=q**4)
    assert b[0] == pytest.approx(1 - q - q**2 / 8 + q**3 / 64, abs=q**4)
    assert a[0] == pytest.approx(-(q**2) / 2 + 7 * q**4 / 128, abs=q**6)


def test_many_boundaries_at_once_are_those_one_by_one():
    q = np.asarray([[0.1, 3.0], [-2.0, 40.0]])
    a, b = boundaries(q, 3)
    assert a.shape == (2, 2, 4)
    assert b.shape == (2, 2, 3)
    for place in np.ndindex(2, 2):
        assert a[place] == pytest.approx(boundaries(q[place], 3)[0], abs=1e-11)


@pytest.mark.parametrize("zone", [1, 2, 3])
@pytest.mark.parametrize("q", [0.4, -2.0])
def test_on_the_edges_of_a_damped_zone_nothing_grows_or_dies(q, zone):
    a, b = boundaries(abs(q), zone)
    n = 0.2 * float(exponents(0.5 * (a[-1] + b[-1]), q).growth)
    lower, upper = damped_zone(q, n, zone)
    for edge, inward in ((lower, 1.0), (upper, -1.0)):
        # The growth falls steeply at an edge: 1e-7 aside it shows its sign.
        assert abs(float(exponents(edge, q, n).growth)) < 1e-7
        assert exponents(edge + inward * 1e-3 * (upper - lower), q, n).growth > 0.0
        assert exponents(edge - inward * 1e-3 * (upper - lower), q, n).growth < 0.0


def test_without_damping_a_zone_ends_at_the_boundaries():
    lower, upper = damped_zone([0.1, -0.1, 0.0], 0.0)
    a, b = boundaries(0.1, 1)
    assert lower == pytest.approx([b[0], b[0], 1.0], abs=1e-14)
    assert upper == pytest.approx([a[1], a[1], 1.0], abs=1e-14)


def test_enough_damping_leaves_nothing_of_a_zone():
    """The principal zone needs about q > 2n."""
    lower, upper = damped_zone(0.1, [0.0499, 0.0501, 0.2])
    assert np.isfinite(lower).tolist() == [True, False, False]
    assert np.isfinite(upper).tolist() == [True, False, False]
    assert np.isnan(damped_zone(0.0, 0.1)[0])


def test_any_array_library_computes_exponents():
    a, q = strict.asarray([0.774, -1.0, 4.0], dtype=strict.float64), strict.asarray(0.3, dtype=strict.float64)
    found, plain = exponents(a, q, q), exponents([0.774, -1.0, 4.0], 0.3, 0.3)
    for name in ("half_trace", "beta", "growth", "stable", "residual"):
        assert np.asarray(getattr(found, name)) == pytest.approx(getattr(plain, name), nan_ok=True, abs=1e-15)


def test_what_is_out_of_range_is_named():
    with pytest.raises(InputError) as caught:
        exponents(np.nan, 1e9, [0.0, np.inf])
    assert [problem.field for problem in caught.value.problems] == ["a", "q", "n"]
    with pytest.raises(InputError) as caught:
        damped_zone(0.1, -0.1, 0)
    assert [problem.field for problem in caught.value.problems] == ["zone", "n"]
    with pytest.raises(InputError, match="order"):
        boundaries(0.1, -1)
