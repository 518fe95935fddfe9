import array_api_strict as strict
import numpy as np
import pytest
from scipy.special import mathieu_a, mathieu_b

from cardan.backends import Compiled, Plain
from cardan.errors import InputError
from cardan.maths.compiled.splitting import DRIFTS, NUMBERS, course, plan, turned
from cardan.maths.periodic.mathieu import exponents
from cardan.maths.periodic.stability_map import STEP, plans, stability_map

BOTH = [Plain(), Compiled(), Compiled(threads=1)]


def by_splitting(a, q, steps):
    numbers, state = plan(steps), (1.0 + 0 * a, 0 * a, 0 * a, 1.0 + 0 * a)
    for k in range(steps):
        kicks = numbers[DRIFTS + NUMBERS * k :][:NUMBERS]
        state = course(a, q, state, numbers[:DRIFTS], kicks)
    return course(a, q, state, (), numbers[-2:])


def test_the_splitting_is_of_sixth_order_and_keeps_areas():
    a, q = np.asarray([5.0, 20.0, 2.0]), np.asarray([2.0, 10.0, 3.0])
    exact = exponents(a, q).half_trace
    errors = []
    for steps in (8, 16, 32):
        u1, v1, u2, v2 = by_splitting(a, q, steps)
        assert u1 * v2 - v1 * u2 == pytest.approx(1.0, abs=2e-14)
        errors.append(np.abs(turned(u1, v1, u2, v2) - exact))
    # Twice the steps: 64 times less, near enough.
    assert np.all(errors[0] / errors[1] > 50.0)
    assert np.all(errors[1] / errors[2] > 50.0)


@pytest.mark.slow
def test_the_kernel_does_what_the_same_lines_do_on_arrays():
    rng = np.random.default_rng(1)
    a, q = rng.uniform(-2.0, 8.0, 64), rng.uniform(-3.0, 3.0, 64)
    found = stability_map(a, q, method=Compiled()).half_trace
    reach = STEP / (0.5 * np.pi)
    needed = np.sqrt(np.max(np.abs(a) + 2 * np.abs(q))) / reach
    steps = int(plans()[1][plans()[1] >= needed][0])
    # Both round some hundred operations in their own order.
    assert found == pytest.approx(turned(*by_splitting(a, q, steps)), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("n", [0.0, 0.07])
def test_the_kernel_is_as_good_as_it_says(n):
    a, q = np.linspace(-5.0, 25.0, 301)[None, :], np.linspace(-12.0, 12.0, 96)[:, None]  # at q = 0 squares are edges
    exact = stability_map(a, q, n, method=Plain())
    size = np.maximum(1.0, np.abs(exact.half_trace))
    for accuracy in (2e-6, 1e-9):
        found = stability_map(a, q, n, accuracy=accuracy, method=Compiled())
        assert np.max(np.abs(found.half_trace - exact.half_trace) / size) < 2 * accuracy
    assert np.mean(found.stable != exact.stable) < 1e-4
    assert found.growth == pytest.approx(exponents(a, q, n).growth, abs=1e-4)


def test_the_edges_of_the_map_are_mathieus_boundaries():
    """Within 1e-5: so far inside each zone that is wider than 1e-3 the map says unstable, so far outside stable."""
    seen = 0
    for q in (0.05, 0.5, 3.0, 9.0):
        for r in range(7):
            lower, upper = (mathieu_b(r, q) if r else -np.inf), mathieu_a(r, q)
            if upper - lower < 1e-3:
                continue
            edges = np.asarray([upper - 1e-5, upper + 1e-5, lower + 1e-5, lower - 1e-5])
            found = stability_map(edges[np.isfinite(edges)], q, method=Compiled())
            assert found.stable.tolist() == [False, True, False, True][: 4 if r else 2]
            seen += 1
    assert seen > 18


@pytest.mark.parametrize("method", BOTH)
@pytest.mark.parametrize("shape", [(), (1,), (7,), (3, 65), (2, 3, 9), (0, 5)])
def test_any_shape(method, shape):
    rng = np.random.default_rng(2)
    a, q, n = rng.uniform(-1.0, 9.0, shape), rng.uniform(0.0, 3.0, shape), rng.uniform(0.0, 0.1, shape)
    found = stability_map(a, q, n, method=method)
    assert found.half_trace.shape == shape
    assert found.half_trace == pytest.approx(exponents(a, q, n).half_trace, rel=4e-6, abs=4e-6)


@pytest.mark.parametrize("method", BOTH)
def test_results_can_be_written_over(method):
    a, q = np.linspace(0.0, 9.0, 100)[None, :], np.linspace(0.0, 3.0, 20)[:, None]
    out = stability_map(a, q, method=method)
    again = stability_map(a, 2 * q, out=out, method=method)
    assert again.half_trace is out.half_trace
    assert again.half_trace == pytest.approx(exponents(a, 2 * q).half_trace, rel=4e-6, abs=4e-6)
    with pytest.raises(InputError, match=r"out\.half_trace"):
        stability_map(a, q[:3], out=out, method=method)


def test_far_out_the_exact_form_answers():
    a = np.asarray([5e4, 1e5])
    assert np.array_equal(stability_map(a, 0.3, method=Compiled()).half_trace, exponents(a, 0.3).half_trace)


def test_a_stable_map_is_as_deep_as_its_damping():
    found = stability_map(1.0, 0.1, [0.049, 0.0505])
    assert found.stable.tolist() == [False, True]
    assert found.growth == pytest.approx([0.0009720851, -0.0005269671], abs=1e-9)


def test_other_libraries_take_the_exact_form():
    a = strict.asarray([0.774, 1.0], dtype=strict.float64)
    found = stability_map(a, strict.asarray(0.1, dtype=strict.float64))
    assert np.asarray(found.half_trace) == pytest.approx(exponents([0.774, 1.0], 0.1).half_trace, abs=1e-15)


def test_what_is_out_of_range_is_named():
    with pytest.raises(InputError, match="q"):
        stability_map(1.0, [0.1, np.nan])
