import numpy as np
import pytest

from cardan.book.varying_joint_angle import (
    driven_motion,
    random_joint_angle,
    rate_deviation,
)
from cardan.errors import InputError
from cardan.maths.curves import paths
from cardan.units import deg

FREQUENCY = np.asarray([2.0, 8.0, 20.0, 40.0])
SHAPE = np.asarray([0.0, 1.0, 0.4, 0.0])


def bend(times, *, mean, density, seed):
    """Return a sample path of a random bend with its rates."""
    count = paths.enough_components(FREQUENCY, times[-1])
    value, rate, acceleration = paths.sample_path(FREQUENCY, density, times, seed=seed, components=count)
    return mean + value, rate, acceleration


def scaled(deviation):
    return SHAPE * deviation**2 / paths.variance(FREQUENCY, SHAPE)


@pytest.mark.parametrize(
    ("given", "angle", "expected"),
    [
        ((10.0, 1.5, 0.5, 100.0), 30.0, (100.77630005872993, 0.23162092629609835)),
        ((20.0, 3.0, 5.0, 60.0), 60.0, (58.026524076308206, 0.9850129269373716)),
    ],
)
def test_mean_and_deviation_by_quadrature(given, angle, expected):
    mean, deviation, rate, speed = given
    found = random_joint_angle(
        angle * deg, mean=mean * deg, deviation=deviation * deg, rate_deviation=rate, speed=speed
    )
    # Expected from another quadrature with 40 digits.
    assert (found.mean, found.deviation) == pytest.approx(expected, rel=1e-7)


def test_small_deviations_approach_the_first_order():
    theta = np.linspace(0.1, 3.0, 7)
    found = random_joint_angle(theta, mean=0.3, deviation=1e-4, rate_deviation=2e-3, speed=100.0)
    # The next order is a share of about (σ/α)² = 1e-7 … times curvature terms.
    np.testing.assert_allclose(found.small, found.deviation, rtol=1e-4)


def test_refuses_bends_that_may_reach_a_right_angle():
    with pytest.raises(InputError, match="six standard deviations"):
        random_joint_angle(0.0, mean=30 * deg, deviation=10 * deg, rate_deviation=0.0, speed=1.0)
    with pytest.raises(InputError, match="at least 0"):
        random_joint_angle(0.0, mean=0.1, deviation=-0.01, rate_deviation=0.0, speed=1.0)


def test_rate_deviation_is_that_of_the_paths():
    density = scaled(0.02)
    times = np.linspace(0.0, 100.0, 10_001)
    value, rate, acceleration = bend(times, mean=0.2, density=density, seed=3)
    # A path of 100 s holds about 100·40/π independent values: the deviation scatters by 2 %.
    assert np.std(value) == pytest.approx(0.02, rel=0.05)
    assert np.mean(value) == pytest.approx(0.2, abs=1e-3)
    assert np.std(rate) == pytest.approx(rate_deviation(FREQUENCY, density), rel=0.05)
    step = times[1]
    # Central differences: h²/6 of the third derivative, 1e-4/6 · 40³ · 0.02.
    np.testing.assert_allclose(np.gradient(value, step)[1:-1], rate[1:-1], atol=0.02)
    np.testing.assert_allclose(np.gradient(rate, step)[1:-1], acceleration[1:-1], atol=1.0)


@pytest.mark.slow
def test_simulation_has_the_variance_of_the_speed():
    mean, deviation, speed = 12 * deg, 0.8 * deg, 90.0
    density = scaled(deviation)
    theta = 0.6
    draws = []
    for seed in range(200):
        joint_angle = bend(np.linspace(0.0, 20.0, 250), mean=mean, density=density, seed=seed)
        draws.append(driven_motion(joint_angle, theta, speed=speed)[0])
    rate = rate_deviation(FREQUENCY, density)
    found = random_joint_angle(theta, mean=mean, deviation=deviation, rate_deviation=rate, speed=speed)
    # 200 paths of 20 s: some 5e4 independent values, 0.3 % in the deviation, 1 % allowed.
    assert np.std(draws) == pytest.approx(float(found.deviation), rel=0.01)
    assert np.mean(draws) == pytest.approx(float(found.mean), abs=0.01 * float(found.deviation))
