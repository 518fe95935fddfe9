import numpy as np
import pytest

from cardan.book.instruments import least_press, press, speed_ratio


def test_the_press_carries_the_torque_by_friction():
    torque, radius, friction = np.asarray([0.5, 40.0]), np.asarray([0.02, 0.3]), np.asarray([0.15, 0.05])
    assert np.allclose(friction * least_press(torque, radius, friction) * radius, torque, rtol=1e-15)
    assert np.allclose(press(torque, radius, friction, 3.0), 3.0 * least_press(torque, radius, friction), rtol=1e-15)


def test_rims_run_at_one_speed():
    assert float(speed_ratio(0.02, 0.05)) * 0.02 == pytest.approx(0.05, rel=1e-15)
