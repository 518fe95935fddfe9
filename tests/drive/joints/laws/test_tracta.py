"""Against the loop of two forks, two blocks and the plane between them, closed by least squares."""

from __future__ import annotations

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from cardan.drive.joints import tracta
from cardan.maths.kernel import mobius
from cardan.units import deg


def turned(axis, angle):
    return Rotation.from_rotvec(angle * np.asarray(axis)).as_matrix()


def closed(phi, joint_angle, oa, ob):
    """Return φ_2 of the loop R-R-E-R-R.

    Each block swivels about an axis across its shaft, through its fork's centre, and holds a plane through that axis;
    both planes are one.
    """
    e1, e2 = np.array([1.0, 0, 0]), np.array([-np.cos(joint_angle), np.sin(joint_angle), 0])
    m1, m2 = np.array([0, 1.0, 0]), np.array([np.sin(joint_angle), np.cos(joint_angle), 0])
    a, b = oa * e1, ob * e2

    def planes(phi2, s1, s2):
        # Shaft 2 turns against its own outward axis, as seen from outside.
        fork1, fork2 = turned(e1, phi), turned(-e2, phi2)
        return (fork1 @ turned(m1, s1) @ np.cross(e1, m1), fork2 @ turned(m2, s2) @ np.cross(-e2, m2))

    def gap(x):
        n1, n2 = planes(*x)
        return np.concatenate([n1 - n2, [(b - a) @ n1 / (oa + ob)]])

    found = least_squares(gap, [phi, 0.0, 0.0], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.linalg.norm(found.fun) < 1e-12
    return found.x[0]


@pytest.mark.parametrize(
    ("joint_angle", "oa", "ob"), [(30 * deg, 20.0, 21.0), (50 * deg, 20.0, 12.0), (15 * deg, 3.0, 3.0)]
)
@pytest.mark.parametrize("phi", [0.2, 0.9, 1.5, 2.4])
def test_the_closed_loop_turns_so(joint_angle, oa, ob, phi):
    want = closed(phi, joint_angle, oa, ob)
    assert float(phi + tracta.deviation(phi, joint_angle, oa, ob)) == pytest.approx(want, abs=1e-12)


def test_bends_are_those_of_the_triangle():
    rng = np.random.default_rng(3)
    joint_angle, oa, ob = rng.uniform(0, 1.5, 100), rng.uniform(1, 5, 100), rng.uniform(1, 5, 100)
    one, two = tracta.joint_angles(joint_angle, oa, ob)
    assert np.allclose(one, np.arctan2(ob * np.sin(joint_angle), oa + ob * np.cos(joint_angle)), rtol=0, atol=5e-16)
    assert np.allclose(one + two, joint_angle, rtol=0, atol=5e-16)
    kappa = np.cos(two) / np.cos(one)
    assert np.allclose(tracta.speed_fluctuation(joint_angle, oa, ob), np.abs(kappa - 1 / kappa), rtol=0, atol=1e-14)
    w = np.exp(2j * 0.7)
    moved = mobius.apply(tracta.pair(joint_angle, oa, ob), w)
    assert np.allclose(moved, w * np.exp(2j * tracta.deviation(0.7, joint_angle, oa, ob)), rtol=0, atol=2e-15)
    assert np.allclose(np.tan(0.7 + tracta.deviation(0.7, joint_angle, oa, ob)), kappa * np.tan(0.7), rtol=1e-14)


@pytest.mark.parametrize("joint_angle", ["1e-8", "0.5", "1.55"])
def test_nearly_equal_lengths_keep_their_digits(joint_angle):
    oa, ob = 0.02, 0.02 * (1 + 1e-12)
    with mpmath.workdps(50):
        alpha, one, two = mpmath.mpf(float(joint_angle)), mpmath.mpf(oa), mpmath.mpf(ob)
        a1 = mpmath.atan2(two * mpmath.sin(alpha), one + two * mpmath.cos(alpha))
        kappa = mpmath.cos(alpha - a1) / mpmath.cos(a1)
        want = abs(kappa - 1 / kappa)
    assert float(tracta.speed_fluctuation(float(joint_angle), oa, ob)) == pytest.approx(float(want), rel=4e-15)


def test_equal_lengths_are_even_and_nan_stays():
    assert np.all(tracta.deviation(np.linspace(0, 7, 9), [[0.0], [0.5], [1.5]], 0.02, 0.02) == 0.0)
    assert np.all(tracta.speed_fluctuation([0.0, 0.5], 0.02, 0.02) == 0.0)
    assert np.isnan(tracta.deviation(0.2, [np.nan], 0.02, 0.03)).all()


def test_any_array_library_computes_them():
    joint_angle, oa, ob = (strict.asarray(x) for x in ([0.3, 0.7], 0.02, 0.021))
    assert np.array_equal(
        np.asarray(tracta.deviation(joint_angle, joint_angle, oa, ob)),
        tracta.deviation([0.3, 0.7], [0.3, 0.7], 0.02, 0.021),
    )
