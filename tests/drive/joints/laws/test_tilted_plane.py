"""Against the ball drawn in space, and against 40 digits."""

from __future__ import annotations

import array_api_strict as strict
import mpmath
import numpy as np
import pytest

from cardan.drive.joints.common import laws
from cardan.maths.kernel import mobius
from cardan.units import deg

RANDOM = np.random.default_rng(7)
JOINT_ANGLE, TILT = RANDOM.uniform(0, 60, 200) * deg, RANDOM.uniform(-20, 20, 200) * deg
PHI = RANDOM.uniform(-7, 7, 200)


def driven_angle(phi, joint_angle, tilt):
    """Cut the meridian plane of shaft 1 with the plane of the balls, and see the point from shaft 2."""
    e1, p1, n = np.eye(3)
    p2 = np.array([np.sin(joint_angle), np.cos(joint_angle), 0.0])
    lean = 0.5 * joint_angle + tilt
    normal = np.cos(lean) * e1 - np.sin(lean) * p1  # turned from shaft 1 towards -e2
    side = np.cos(phi) * p1 + np.sin(phi) * n
    ball = np.cross(normal, np.cross(e1, side))
    ball *= np.sign(ball @ side)
    return np.arctan2(ball @ n, ball @ p2)


def test_the_ball_drawn_in_space_turns_the_shafts_so():
    found = laws.deviation(PHI, JOINT_ANGLE, TILT)
    for phi, joint_angle, tilt, one in zip(PHI, JOINT_ANGLE, TILT, found, strict=True):
        gap = driven_angle(phi, joint_angle, tilt) - phi - one
        assert abs(np.remainder(gap + np.pi, 2 * np.pi) - np.pi) < 1e-14  # some units in the last place of angles


def test_the_normal_stands_between_the_shafts():
    """The normal of the drawing, α/2 + η from shaft 1, is α/2 - η from the other."""
    e2 = np.array([-np.cos(JOINT_ANGLE), np.sin(JOINT_ANGLE)])
    lean = 0.5 * JOINT_ANGLE + TILT
    along = -(e2[0] * np.cos(lean) - e2[1] * np.sin(lean))
    assert np.allclose(along, np.cos(0.5 * JOINT_ANGLE - TILT), rtol=0, atol=1e-15)


def test_map_deviation_and_irregularity_are_of_one_joint():
    pair = laws.pair(JOINT_ANGLE, TILT)
    w = np.exp(2j * PHI)
    gap = laws.deviation(PHI, JOINT_ANGLE, TILT)
    assert np.allclose(mobius.apply(pair, w), w * np.exp(2j * gap), rtol=0, atol=4e-15)
    delta = laws.speed_fluctuation(JOINT_ANGLE, TILT)
    kappa = np.cos(0.5 * JOINT_ANGLE + TILT) / np.cos(0.5 * JOINT_ANGLE - TILT)
    assert np.allclose(delta, np.abs(kappa - 1 / kappa), rtol=0, atol=1e-14)
    assert np.allclose(mobius.speed_fluctuation(pair), delta, rtol=1e-14)
    assert np.allclose(np.abs(laws.tau(JOINT_ANGLE, TILT)), mobius.tau(pair), rtol=1e-14)
    # κ - 1/κ ≈ -4η tan(α/2) while η is small.
    small = laws.speed_fluctuation(JOINT_ANGLE, 1e-6)
    assert np.allclose(small, 4e-6 * np.tan(0.5 * JOINT_ANGLE), rtol=1e-10)


@pytest.mark.parametrize("joint_angle", ["0", "1e-9", "0.7", "1.5707"])
@pytest.mark.parametrize("tilt", ["1e-300", "1e-12", "-3e-5"])
def test_no_digit_is_lost_to_small_tilts_and_great_bends(joint_angle, tilt):
    with mpmath.workdps(60):
        a, e, phi = mpmath.mpf(float(joint_angle)), mpmath.mpf(float(tilt)), mpmath.mpf(0.3)
        p, q = a / 2 + e, a / 2 - e
        kappa = mpmath.cos(p) / mpmath.cos(q)
        s, c = mpmath.sin(phi), mpmath.cos(phi)
        gap = mpmath.atan2((kappa - 1) * s * c, c * c + kappa * s * s)
        delta = abs(kappa - 1 / kappa)
    # A joint angle of 89.99° leaves cos(α/2)-like terms whole; the tangent of half of it is harmless.
    assert float(laws.deviation(0.3, float(joint_angle), float(tilt))) == pytest.approx(float(gap), rel=4e-15)
    assert float(laws.speed_fluctuation(float(joint_angle), float(tilt))) == pytest.approx(float(delta), rel=4e-15)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 8])
def test_balls_together_are_the_balls_one_by_one(count):
    joint_angle, tilt, phi = JOINT_ANGLE[:20], TILT[:20], PHI[:20]
    each = np.stack([laws.deviation(phi + 2 * np.pi * k / count, joint_angle, tilt) for k in range(count)])
    found = laws.ball_demands(phi, joint_angle, tilt, count)
    # Sines of angles up to 7 + 2π: each is right to 2e-15.
    assert np.allclose(found.mean, each.mean(axis=0), rtol=0, atol=5e-15)
    assert np.allclose(found.spread, np.ptp(each, axis=0), rtol=0, atol=5e-15)
    assert np.allclose(found.largest, np.abs(each).max(axis=0), rtol=0, atol=5e-15)


def test_six_balls_leave_order_six_of_the_cube():
    t = float(laws.tau(0.5, 0.01))
    phi = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    orders = np.abs(np.fft.rfft(laws.ball_demands(phi, 0.5, 0.01).mean)) / 24
    assert orders[6] == pytest.approx(abs(t) ** 3 / 3, rel=1e-6)
    assert np.delete(orders, [6, 12]).max() < 1e-20


@pytest.mark.parametrize(("joint_angle", "tilt"), [(1.5, 0.9), (0.5, -1.4), (np.nan, 0.1), (0.5, np.nan)])
def test_where_nothing_turns_there_is_no_number(joint_angle, tilt):
    for found in (
        laws.tau(joint_angle, tilt),
        laws.deviation(0.2, joint_angle, tilt),
        laws.speed_fluctuation(joint_angle, tilt),
        laws.ball_demands(0.2, [joint_angle, 0.3], [tilt, 0.0]).mean[0],
        laws.pair(joint_angle, tilt)[1].real,
    ):
        assert np.isnan(found)


def test_a_straight_joint_and_a_true_plane_are_even():
    assert np.all(laws.deviation(PHI, 0.0, TILT) == 0.0)
    assert np.all(laws.deviation(PHI, JOINT_ANGLE, 0.0) == 0.0)
    assert np.all(mobius.apply(laws.pair(JOINT_ANGLE, 0.0), 1j) == 1j)


def test_any_array_library_computes_them():
    phi, joint_angle, tilt = (strict.asarray(x[:5]) for x in (PHI, JOINT_ANGLE, TILT))
    assert np.array_equal(
        np.asarray(laws.deviation(phi, joint_angle, tilt)), laws.deviation(PHI, JOINT_ANGLE, TILT)[:5]
    )
    assert np.asarray(laws.ball_demands(phi, joint_angle, tilt).spread).shape == (5,)
