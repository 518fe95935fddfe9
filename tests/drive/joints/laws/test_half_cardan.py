"""Against rotation matrices of a bell and its tongue, and sums over the contacts."""

import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from cardan.drive.joints import half_cardan
from cardan.units import deg


def output(phi, joint_angle):
    """Return the angle of a bell whose face stays at right angles to the diameter of the tongue."""
    diameter = np.array([np.cos(phi), np.sin(phi), 0.0])
    tilted = Rotation.from_euler("y", joint_angle).as_matrix()

    def miss(psi):
        return diameter @ tilted @ np.array([-np.sin(psi), np.cos(psi), 0.0])

    return brentq(miss, phi - 0.9, phi + 0.9, xtol=1e-15)


@settings(max_examples=30)
@given(st.floats(0.0, 360.0), st.floats(0.5, 60.0), st.integers(1, 6))
def test_every_pair_asks_for_what_its_face_says(angle, joint_angle, pairs):
    phi, joint_angle = angle * deg, joint_angle * deg
    places = phi + np.pi / pairs * np.arange(pairs)
    expected = [output(place, joint_angle) - place for place in places]
    got = half_cardan.demands(phi, joint_angle, pairs)
    np.testing.assert_allclose(got, expected, atol=1e-13)


@given(st.floats(0.0, 360.0), st.floats(0.5, 70.0), st.integers(1, 6))
def test_elastic_pairs_turn_by_the_mean(angle, joint_angle, pairs):
    phi, joint_angle = angle * deg, joint_angle * deg
    mean = half_cardan.demands(phi, joint_angle, pairs).mean()
    assert half_cardan.deviation(phi, joint_angle, pairs) == pytest.approx(mean, abs=1e-14)


@pytest.mark.parametrize("pairs", [1, 2, 3])
def test_the_ratio_is_the_slope_of_the_turn(pairs):
    phi, step = np.linspace(0, np.pi, 50), 1e-5
    turn = [half_cardan.deviation(phi + k * step, 0.8, pairs) for k in (-1, 1)]
    slope = 1 + (turn[1] - turn[0]) / (2 * step)
    np.testing.assert_allclose(half_cardan.ratio(phi, 0.8, pairs), slope, atol=1e-9)  # step² and rounding/step


@given(st.floats(0.0, 360.0), st.floats(0.5, 40.0), st.integers(1, 24), st.floats(-9.0, 1.0))
def test_stiff_pairs_share_a_torque_as_springs_that_push(angle, joint_angle, pairs, power):
    phi, alpha, windup = angle * deg, joint_angle * deg, 10.0**power
    ahead = half_cardan.demands(phi, alpha, pairs)
    behind = brentq(
        lambda at: np.maximum(0.0, ahead - at).sum() - windup,
        ahead.max() - 1.1 * windup,
        ahead.max(),
        xtol=1e-16,
        rtol=1e-14,
    )
    found = half_cardan.shares(phi, alpha, pairs, windup)
    np.testing.assert_allclose(found, np.maximum(0.0, ahead - behind), atol=1e-13)
    assert found.sum() == pytest.approx(windup, rel=1e-9, abs=1e-14)


def test_rigid_pairs_leave_all_to_one_and_soft_ones_share_alike():
    phi = np.linspace(0.0, 1.0, 7)
    stiff, soft = (half_cardan.shares(phi, 2 * deg, 20, windup) / windup for windup in (1e-12, 1e3))
    np.testing.assert_allclose(np.max(stiff, axis=-1), 1.0, rtol=1e-3)  # two pairs ask for the same here and there
    np.testing.assert_allclose(soft, 1.0 / 20, rtol=1e-5)


def test_the_play_is_the_greatest_difference_of_two_pairs():
    phi = np.linspace(0, np.pi, 20001)
    for joint_angle in (2 * deg, 10 * deg, 40 * deg):
        square = np.ptp(half_cardan.demands(phi, joint_angle, 2), axis=-1).max()
        assert half_cardan.play(joint_angle, 2) == pytest.approx(square, rel=1e-7)
        many = np.ptp(half_cardan.demands(phi[:200], joint_angle, 90), axis=-1).max()
        assert many <= half_cardan.play(joint_angle, 90) <= many * 1.001
    assert half_cardan.play(0.3, 1) == 0.0


def test_other_array_libraries():
    phi = strict.asarray([0.1, 2.0])
    for law in (half_cardan.deviation, half_cardan.ratio, half_cardan.demands):
        np.testing.assert_allclose(np.asarray(law(phi, 0.3, 3)), law([0.1, 2.0], 0.3, 3), rtol=1e-13, atol=1e-16)
    shared = half_cardan.shares(phi, 0.3, 3, 0.01)
    np.testing.assert_allclose(np.asarray(shared), half_cardan.shares([0.1, 2.0], 0.3, 3, 0.01), rtol=1e-13, atol=1e-16)
