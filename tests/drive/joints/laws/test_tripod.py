"""Against three rollers put into three tracks by least squares."""

from __future__ import annotations

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from scipy.optimize import least_squares

from cardan.drive.joints import tripod
from cardan.units import deg

THIRDS = 2 * np.pi / 3 * np.arange(3)


def tracks(phi, joint_angle, radius):
    """Return where the tracks, lines along z in space, pierce the spider's plane, and at which height."""
    x, y = radius * np.cos(phi + THIRDS), radius * np.sin(phi + THIRDS)
    z = x * np.tan(joint_angle)  # the plane rises along x by the joint angle
    return np.stack([x / np.cos(joint_angle), y], axis=-1), z


def closed(phi, joint_angle, radius):
    """Return angle and centre of a spider whose three arms pass through the tracks."""
    points, _z = tracks(phi, joint_angle, radius)

    def gap(x):
        way = points - x[1:]
        arm = np.stack([np.cos(x[0] + THIRDS), np.sin(x[0] + THIRDS)], axis=-1)
        return way[:, 0] * arm[:, 1] - way[:, 1] * arm[:, 0]

    found = least_squares(gap, [phi, 0.0, 0.0], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.abs(found.fun).max() < 1e-12 * radius
    return found.x


@pytest.mark.parametrize("joint_angle", [5 * deg, 20 * deg, 50 * deg])
@pytest.mark.parametrize("phi", [0.0, 0.4, 2.0, -5.0])
def test_the_spider_turns_evenly_and_runs_round_three_times(phi, joint_angle):
    psi, x, y = closed(phi, joint_angle, 20.0)
    assert psi == pytest.approx(phi, abs=1e-12)
    assert np.allclose(tripod.spider_centre(phi, joint_angle, 20.0), [x, y], rtol=0, atol=2e-11)
    points, z = tracks(phi, joint_angle, 20.0)
    reach = np.linalg.norm(points - [x, y], axis=-1)
    assert np.allclose(tripod.roller_reach(phi + THIRDS, joint_angle, 20.0), reach, rtol=0, atol=2e-11)
    assert np.allclose(tripod.track_travel(phi + THIRDS, joint_angle, 20.0), z, rtol=0, atol=1e-13)


@pytest.mark.parametrize("joint_angle", ["1e-12", "1e-5", "0.3", "1.5"])
def test_small_orbits_keep_their_digits(joint_angle):
    with mpmath.workdps(50):
        want = (1 / mpmath.cos(mpmath.mpf(float(joint_angle))) - 1) / 2
    assert float(tripod.orbit_radius(float(joint_angle), 1.0)) == pytest.approx(float(want), rel=1e-14)


def test_a_straight_joint_stands_still():
    assert np.all(np.asarray(tripod.spider_centre([0.0, 1.0], 0.0, 0.02)) == 0.0)
    assert np.all(tripod.roller_reach([0.0, 1.0], 0.0, 0.02) == 0.02)
    assert np.isnan(tripod.orbit_radius(np.nan, 0.02))
    assert float(tripod.shaft_tilt(20 * deg, 20.0, 400.0)) == pytest.approx(0.6417777 / 400, rel=1e-6)


def test_any_array_library_computes_them():
    phi, joint_angle, radius = (strict.asarray(x) for x in ([0.3, 0.7], 0.2, 0.02))
    for name in ("spider_centre", "roller_reach", "track_travel"):
        found = getattr(tripod, name)
        assert np.array_equal(np.asarray(found(phi, joint_angle, radius)), found([0.3, 0.7], 0.2, 0.02))


def pivoting(phi, joint_angle, radius, length):
    """Return the turn of a spider whose axis ends in a fixed point, seen without twist from its place without orbit.

    Three lines along its arms meet the three tracks: as many equations as the two leans and the turn.
    """
    x, y = np.array([np.cos(joint_angle), 0.0, np.sin(joint_angle)]), np.array([0.0, 1.0, 0.0])
    b = np.cross(x, y)

    def gaps(unknown):
        axis = b + unknown[0] * x + unknown[1] * y
        axis /= np.linalg.norm(axis)
        v = np.cross(b, axis)
        skew = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        turn = np.eye(3) + skew + skew @ skew / (1 + b @ axis)
        found = []
        for third in THIRDS:
            angle = phi + unknown[2] + third
            arm = turn @ (np.cos(angle) * x + np.sin(angle) * y)
            track = radius * np.array([np.cos(phi + third), np.sin(phi + third), 0.0])
            found.append((length * (b - axis) - track) @ np.cross([0.0, 0.0, 1.0], arm) / radius)
        return found

    return least_squares(gaps, np.zeros(3), xtol=1e-15, ftol=1e-15, gtol=1e-15).x[2]


@pytest.mark.parametrize(("joint_angle", "length"), [(20 * deg, 0.3), (12 * deg, 0.5)])
def test_a_shaft_that_pivots_on_a_far_joint_errs_at_order_three(joint_angle, length):
    """To first order in the orbit over the length: the rest is their square."""
    turn = np.linspace(0.0, 2 * np.pi, 13)
    found = [pivoting(phi, joint_angle, 0.02, length) for phi in turn]
    size = tripod.pivot_error(joint_angle, 0.02, length)
    np.testing.assert_allclose(found, size * np.sin(3 * turn), atol=2e-3 * size)
    if length == 0.3:
        assert size / deg == pytest.approx(0.0216, abs=1e-4)


def test_a_drive_file_tells_the_pivot():
    joint = tripod.Tripod(joint_angle=20 * deg, track_radius=0.02, pivot=0.3)
    own = {one.key: one.value for one in joint.inside(20 * deg)}
    assert own["pivot_error"] == pytest.approx(float(tripod.pivot_error(20 * deg, 0.02, 0.3)))
    assert own["nutation"] == pytest.approx(own["orbit"] / 0.3)
