import numpy as np
import pytest

from cardan.book.varying_joint_angle import (
    driven_motion,
    planar_chain,
    swinging_chain,
    swinging_joint,
)
from cardan.maths.curves import paths
from cardan.questions.motion.instants import speed_range
from cardan.units import deg

SINGLE = [
    (
        {"mean": 12 * deg, "amplitude": 4 * deg, "frequency": 40.0, "speed": 150.0},
        0.0137,
        (147.1401348857779, 992.7838212248784),
    ),
    (
        {
            "mean": 20 * deg,
            "amplitude": 10 * deg,
            "frequency": 200.0,
            "phase": 30 * deg,
            "speed": 100.0,
            "acceleration": 300.0,
        },
        0.021,
        (105.6553964414095, 41.95806740448048),
    ),
]


@pytest.mark.parametrize(("given", "time", "expected"), SINGLE)
def test_swinging_joint_gives_the_differentiated_vector_geometry(given, time, expected):
    found = swinging_joint(time, **given)
    # Expected values are numerical derivatives taken with 40 digits, good to 1e-9 relative.
    assert (found.driven_speed, found.driven_acceleration) == pytest.approx(expected, rel=1e-9, abs=1e-7)


def test_swinging_double_joint_gives_the_differentiated_vector_geometry():
    found = swinging_chain(
        0.0123,
        mean=[15 * deg, 12 * deg],
        amplitude=[5 * deg, 3 * deg],
        frequency=60.0,
        phase=[0.0, np.pi / 2],
        yoke_angle=[0.0],
        speed=100.0,
    )
    expected = (98.92661983396638, -547.0245932201366)
    assert (found.driven_speed, found.driven_acceleration) == pytest.approx(expected, rel=1e-8)


def some_swing(times, mean=0.3, amplitude=0.2, frequency=31.0, phase=0.4):
    still = (np.asarray(mean), np.asarray(0.0), np.asarray(0.0))
    return paths.plus(still, paths.swing(amplitude, frequency, phase, times))


def test_single_joint_formula_is_the_derivative_of_the_driven_angle():
    times = np.linspace(0.0, 0.2, 400_001)
    joint_angle = some_swing(times)
    theta = 0.3 + 120.0 * times
    c = np.cos(joint_angle[0])
    driven = np.unwrap(np.arctan2(np.sin(theta), c * np.cos(theta)))
    speed, acceleration = driven_motion(joint_angle, theta, speed=120.0)
    # Central differences with h = 5e-7 s err by h² φ'''/6 and by rounding 1e-15/h.
    np.testing.assert_allclose(np.gradient(driven, times)[1:-1], speed[1:-1], atol=1e-5)
    np.testing.assert_allclose(np.gradient(speed, times)[1:-1], acceleration[1:-1], atol=2e-3)


def test_single_joint_formula_is_the_general_method_on_one_joint():
    times = np.linspace(0.0, 0.3, 101)
    joint_angle = some_swing(times)
    column = tuple(part[:, None] for part in joint_angle)
    general = planar_chain(column, 80.0 * times, yoke_angle=[], speed=80.0, start_phase=0.3)
    speed, acceleration = driven_motion(joint_angle, 80.0 * times + 0.3, speed=80.0)
    np.testing.assert_allclose(general.driven_speed, speed, rtol=1e-13)
    np.testing.assert_allclose(general.driven_acceleration, acceleration, rtol=1e-10, atol=1e-9)


def test_both_arrangements_stay_synchronous_when_the_bends_are_equal_at_all_times():
    times = np.linspace(0.0, 0.3, 101)
    joint_angle = some_swing(times)
    for sign in (1.0, -1.0):
        both = tuple(np.stack((part, sign * part), axis=-1) for part in joint_angle)
        found = planar_chain(both, 80.0 * times, yoke_angle=[0.0], speed=80.0)
        np.testing.assert_allclose(found.driven_speed, 80.0, rtol=1e-14)
        np.testing.assert_allclose(found.driven_acceleration, 0.0, atol=1e-10)


def test_bend_through_zero_is_regular():
    joint_angle = (np.asarray([0.0]), np.asarray([40.0]), np.asarray([0.0]))
    found = planar_chain(joint_angle, 0.7, yoke_angle=[], speed=100.0)
    assert found.driven_speed == pytest.approx(100.0, abs=1e-12)
    # At zero joint angle only the square of the rate is left: ε_2 = ½ sin 2θ α'².
    assert found.driven_acceleration == pytest.approx(0.5 * np.sin(1.4) * 1600.0)


@pytest.mark.parametrize(("joint_angle", "times"), [(5.0, 1.52), (10.0, 1.15), (20.0, 1.04)])
def test_rate_raises_irregularity_as_the_extremes_of_the_exact_speed_say(joint_angle, times):
    alpha, rate = np.deg2rad(joint_angle), 10.0
    axes = (
        np.asarray([[1.0, 0.0, 0.0], [np.cos(alpha), np.sin(alpha), 0.0]]),
        rate * np.asarray([[0.0, 0.0, 0.0], [-np.sin(alpha), np.cos(alpha), 0.0]]),
        np.zeros((2, 3)),
    )
    low, high = speed_range(axes, yoke_angle=[], speed=100.0)
    theta = np.linspace(0.0, np.pi, 20_001)
    speed, _acceleration = driven_motion((alpha, rate, 0.0), theta, speed=100.0)
    # The grid misses an extreme by (1.6e-4 rad)²/2 of the swing at most.
    assert (low[1], high[1]) == pytest.approx((speed.min(), speed.max()), abs=1e-6)
    frozen = np.sin(alpha) * np.tan(alpha)
    effect = np.sqrt(1.0 + (rate / (100.0 * np.sin(alpha))) ** 2)
    assert (high[1] - low[1]) / 100.0 / frozen == pytest.approx(effect, rel=1e-12)
    assert effect == pytest.approx(times, abs=0.006)
