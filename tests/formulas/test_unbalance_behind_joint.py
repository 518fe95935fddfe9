"""Unbalance behind a joint: the force itself by differences of the plain angle, and first order."""

import math

import numpy as np
import pytest

from cardan import InputError
from cardan.formulas.unbalance_behind_joint import unbalance_behind_joint
from cardan.units import deg


@pytest.mark.parametrize(("joint_angle", "phase"), [(6 * deg, 0.0), (30 * deg, 0.5), (60 * deg, -2.0)])
def test_the_orders_add_up_to_the_force(joint_angle, phase):
    found = unbalance_behind_joint(joint_angle, phase, reach=121)
    angle = np.linspace(0.0, 2.0 * np.pi, 50)

    def vector(turned):
        behind = np.arctan2(np.sin(turned + phase), np.cos(joint_angle) * np.cos(turned + phase))
        start = math.atan2(math.sin(phase), math.cos(joint_angle) * math.cos(phase))
        return np.exp(1j * (behind - start))

    h = 1e-3
    slopes = -(vector(angle + h) - 2.0 * vector(angle) + vector(angle - h)) / h**2
    # The second difference misses h²/12 of the fourth derivative, which steep joints have much of.
    size = np.abs(found.order**2 * found.force).sum()
    np.testing.assert_allclose(found.force @ np.exp(1j * np.outer(found.order, angle)), slopes, atol=h**2 / 10 * size)
    assert found.residual < 1e-12


def test_first_order_and_batches():
    found = unbalance_behind_joint([[1 * deg], [2 * deg]], [0.0, 0.3, 1.0], reach=3)
    assert found.size.shape == (2, 3, 4)
    tau = np.tan(np.asarray([0.5, 1.0]) * deg) ** 2
    np.testing.assert_allclose(found.size[:, 0], np.stack([0 * tau, tau / 2, 1 + 0 * tau, 4.5 * tau], -1), atol=3e-7)
    np.testing.assert_allclose(found.size[:, 1:], found.size[:, :1].repeat(2, 1), rtol=1e-13)


def test_what_makes_no_joint_is_named():
    with pytest.raises(InputError) as caught:
        unbalance_behind_joint(90 * deg, np.inf, reach=0)
    assert [problem.field for problem in caught.value.problems] == ["joint_angle", "phase", "reach"]
