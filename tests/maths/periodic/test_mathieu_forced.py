import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.errors import InputError
from cardan.maths.periodic.mathieu import forced

FORCING = {"order": [0.0, 2.0, 0.5, 6.8], "amplitude": [-0.4, 0.7, 0.2, -0.3], "phase": [1.1, 0.3, -2.0, 0.4]}


def force(z):
    rows = zip(FORCING["order"], FORCING["amplitude"], FORCING["phase"], strict=True)
    return sum(size * np.sin(nu * z + phase) for nu, size, phase in rows)


@pytest.mark.parametrize(
    ("a", "q", "n"), [(0.774, 0.1, 0.0), (2.3, -0.9, 0.0), (7.0, 3.0, 0.2), (-0.2, 0.8, 0.0), (1.0, 0.3, 0.0)]
)
def test_the_solution_fulfils_the_equation(a, q, n):
    """Put in, with derivatives taken order by order; (1, 0.3) is unstable and has a steady solution too."""
    found = forced(a, q, n, **FORCING)
    z = np.linspace(0.0, 20.0, 57)
    wave = found.coefficient[:, None] * np.exp(1j * found.order[:, None] * z)
    y, slope, joint_angle = (np.sum((1j * found.order[:, None]) ** k * wave, axis=0).imag for k in (0, 1, 2))
    rest = joint_angle + 2 * n * slope + (a - 2 * q * np.cos(2 * z)) * y - force(z)
    assert np.max(np.abs(rest)) < 1e-12
    assert found.at(z) == pytest.approx(y, abs=1e-14)
    assert np.sum(found.amplitude * np.sin(found.phase)) == pytest.approx(found.at([0.0])[0], abs=1e-12)


def test_damped_motion_settles_to_the_solution():
    a, q, n = 2.0, 0.5, 0.3

    def rate(z, y):
        return [y[1], force(z) - 2 * n * y[1] - (a - 2 * q * np.cos(2 * z)) * y[0]]

    z = np.linspace(100.0, 110.0, 21)
    moved = solve_ivp(rate, (0.0, 110.0), [0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-12, t_eval=z).y[0]
    # What is left of the start after 100 radians is e^(-0.3 · 100).
    assert forced(a, q, n, **FORCING).at(z) == pytest.approx(moved, abs=1e-9)


def test_without_a_wave_each_order_answers_alone():
    found = forced([0.774, 5.0], 0.0, order=[0.0, 2.0, 6.8], amplitude=[1.0, 2.0, 3.0], phase=[np.pi / 2, 0.0, 1.0])
    a = np.asarray([0.774, 5.0])
    for nu, size in ((0.0, 1.0), (2.0, 2.0), (6.8, 3.0)):
        at = int(np.argmin(np.abs(found.order - nu)))
        assert found.amplitude[:, at] == pytest.approx(size / np.abs(a - nu**2), rel=1e-14)
    assert found.mean == pytest.approx(1.0 / a, rel=1e-14)


def test_equal_orders_are_told_once():
    found = forced(2.0, 0.3, order=[6.8, 4.8, 0.0, 2.0], amplitude=1.0)
    assert np.all(np.diff(found.order) > 0.1)


def test_a_high_order_reaches_down_to_the_mean():
    """Order 60 falls by steps of two to the mean; half a turn's mean of the equation gives it as well."""
    a, q = 3000.0, 900.0
    found = forced(a, q, order=[60.0], amplitude=[1.0], phase=[0.5])
    z = np.linspace(0.0, 2 * np.pi, 4096, endpoint=False)
    y = found.at(z)
    assert found.mean == pytest.approx(np.mean(y), rel=1e-9)
    assert a * np.mean(y) == pytest.approx(np.mean(2 * q * np.cos(2 * z) * y), rel=1e-7)


@pytest.mark.parametrize("q", [0.0, 0.3])
def test_a_side_band_without_stiffness_is_no_resonance(q):
    """At a = 16 the fourth order stands still in the sweeps; the answer goes on smoothly all the same."""
    left, middle, right = (
        forced(16.0 + shift, q, order=[0.0, 6.0], amplitude=1.0, phase=1.0).coefficient[:8]
        for shift in (-1e-6, 0, 1e-6)
    )
    # With q = 0.3 the response is steep there: the mean of two neighbours misses by the square of their distance.
    assert middle == pytest.approx(0.5 * (left + right), rel=1e-6, abs=1e-12)


def test_a_resonance_is_named():
    with pytest.raises(InputError) as caught:
        forced(4.0, 0.0, order=[1.0, 2.0], amplitude=1.0)
    assert caught.value.field == "order[1]"
    assert np.isfinite(forced(4.0, 0.0, 0.1, order=[2.0], amplitude=1.0).amplitude).all()
    with pytest.raises(InputError) as caught:
        forced(4.1, 0.0, order=[-1.0, np.inf], amplitude=1.0)
    assert [problem.field for problem in caught.value.problems] == ["order[0]", "order[1]"]
