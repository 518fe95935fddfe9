import numpy as np
import pytest

from cardan.book.instruments import cone_ratio, least_press, press, speed_ratio
from cardan.units import deg


def test_the_press_carries_the_torque_by_friction():
    torque, radius, friction = np.asarray([0.5, 40.0]), np.asarray([0.02, 0.3]), np.asarray([0.15, 0.05])
    assert np.allclose(friction * least_press(torque, radius, friction) * radius, torque, rtol=1e-15)
    assert np.allclose(press(torque, radius, friction, 3.0), 3.0 * least_press(torque, radius, friction), rtol=1e-15)


def test_rims_run_at_one_speed():
    assert float(speed_ratio(0.02, 0.05)) * 0.02 == pytest.approx(0.05, rel=1e-15)
    # A point of the common generatrix, at any distance from the apex, has the same speed on both cones.
    for far in (0.1, 0.7):
        ratio = float(cone_ratio(25 * deg, 50 * deg))
        assert ratio * far * np.sin(25 * deg) == pytest.approx(far * np.sin(50 * deg), rel=1e-15)
