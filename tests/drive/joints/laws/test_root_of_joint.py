"""The turning vector behind a joint: its Fourier sum against the transform of the plain arctangent."""

import numpy as np
import pytest

from cardan.formulas.unbalance_behind_joint import vector_orders


@pytest.mark.parametrize("joint_angle", [0.0, 0.1, 0.6, 1.2, 1.5])
def test_the_orders_are_those_of_the_sampled_vector(joint_angle):
    count = 1 << 14
    angle = 2.0 * np.pi * np.arange(count) / count
    behind = np.arctan2(np.sin(angle), np.cos(joint_angle) * np.cos(angle))
    spectrum = np.fft.fft(np.exp(1j * behind)) / count
    order = np.arange(-40, 41)
    # 16 384 samples leave nothing of the orders that fold back, even at 86°.
    np.testing.assert_allclose(vector_orders(np.tan(0.5 * joint_angle) ** 2, order), spectrum[order].real, atol=1e-14)
    np.testing.assert_allclose(spectrum[order].imag, 0.0, atol=1e-14)


def test_first_order_and_the_sum_of_squares():
    tau = np.asarray([1e-6, 0.3])
    found = vector_orders(tau, np.arange(-201, 202))
    np.testing.assert_allclose(np.sum(found**2, axis=-1), 1.0, rtol=1e-13)
    np.testing.assert_allclose(vector_orders(1e-6, [3, -1]) / 1e-6, [0.5, -0.5], rtol=1e-5)
