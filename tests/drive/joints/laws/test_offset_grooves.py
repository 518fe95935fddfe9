"""Against balls found by Newton's method in two grooves drawn in space."""

from __future__ import annotations

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from scipy.optimize import fsolve

from cardan.drive.joints import weiss
from cardan.drive.joints.common import laws
from cardan.joints import Rzeppa
from cardan.texts import speaking
from cardan.units import deg

E1, P1, N = np.eye(3)


def axes(joint_angle):
    e2 = np.array([-np.cos(joint_angle), np.sin(joint_angle), 0.0])
    return e2, np.array([np.sin(joint_angle), np.cos(joint_angle), 0.0])


def closed(phi, joint_angle, c1, c2, radius):
    """Return the ball and φ_2 where a point of groove 1 and a point of groove 2 fall together."""
    e2, p2 = axes(joint_angle)

    def ball(axis, arm, c, angle, t):
        return c * axis + radius * (np.sin(t) * axis + np.cos(t) * (np.cos(angle) * arm + np.sin(angle) * N))

    def gap(x):
        return (ball(E1, P1, c1, phi, x[0]) - ball(e2, p2, c2, x[1], x[2])) / radius

    (t, phi2, u), _info, _sure, _words = fsolve(gap, [0.0, phi, 0.0], xtol=1e-15, full_output=True)
    assert np.abs(gap([t, phi2, u])).max() < 1e-13
    return ball(E1, P1, c1, phi, t), phi2


CASES = [(0.9, 30 * deg, 3.0, 3.3), (2.5, 45 * deg, 5.0, 3.0), (-1.2, 10 * deg, 2.0, 2.0), (4.0, 70 * deg, 8.0, 9.0)]


@pytest.mark.parametrize(("phi", "joint_angle", "c1", "c2"), CASES)
def test_ball_and_angle_are_those_of_the_closed_grooves(phi, joint_angle, c1, c2):
    ball, phi2 = closed(phi, joint_angle, c1, c2, 30.0)
    along, out = weiss.ball_centre(phi, joint_angle, c1, c2, 30.0)
    assert np.allclose([along, out], [ball @ E1, np.hypot(ball[1], ball[2])], rtol=0, atol=1e-11)
    assert float(weiss.deviation(phi, joint_angle, c1, c2, 30.0)) == pytest.approx(phi2 - phi, abs=1e-12)


@pytest.mark.parametrize(("joint_angle", "c1", "c2"), [case[1:] for case in CASES])
def test_all_balls_lie_in_the_one_plane(joint_angle, c1, c2):
    phi = np.linspace(0, 2 * np.pi, 13)
    along, out = weiss.ball_centre(phi, joint_angle, c1, c2, 30.0)
    ball = along[:, None] * E1 + out[:, None] * (np.cos(phi)[:, None] * P1 + np.sin(phi)[:, None] * N)
    lean = 0.5 * joint_angle + weiss.plane_tilt(joint_angle, c1, c2)
    normal = np.cos(lean) * E1 - np.sin(lean) * P1
    assert np.allclose(ball @ normal, weiss.plane_offset(joint_angle, c1, c2), rtol=0, atol=1e-14 * 30)


def test_with_a_plane_through_the_centre_they_would_be_balls_of_a_tilted_plane():
    """Tilt and offset act apart to first order: take the offset's share away and the tilted plane is left."""
    phi, joint_angle, c = 0.8, 0.5, 0.004
    for play in (1e-5, 1e-6):
        off = weiss.plane_offset(joint_angle, c + play / 2, c - play / 2)
        tilt = weiss.plane_tilt(joint_angle, c + play / 2, c - play / 2)
        far = weiss.ball_centre(phi, joint_angle, c, c, 0.03)[1]
        want = laws.deviation(phi, joint_angle, tilt) - 2 * off / far * np.sin(joint_angle / 2) * np.sin(phi)
        found = weiss.deviation(phi, joint_angle, c + play / 2, c - play / 2, 0.03)
        assert float(found / want - 1) == pytest.approx(0, abs=3 * play / c)


@pytest.mark.parametrize("play", ["1e-15", "1e-6", "1e-3"])
@pytest.mark.parametrize("joint_angle", ["1e-7", "0.4", "1.4"])
def test_small_plays_keep_their_digits(play, joint_angle):
    c1, c2, radius = 0.004 + float(play), 0.004, 0.03
    with mpmath.workdps(50):
        a, one, two, size, phi = map(mpmath.mpf, (float(joint_angle), c1, c2, radius, 0.8))
        x, y = one + two * mpmath.cos(a), -two * mpmath.sin(a) * mpmath.cos(phi)
        far = (one**2 + two**2 + 2 * one * two * mpmath.cos(a)) / 2
        foot = far / (x * x + y * y)
        half = mpmath.sqrt(size**2 - far * foot) / mpmath.sqrt(x * x + y * y)
        h, r = one - foot * x - half * y, -foot * y + half * x
        phi2 = mpmath.atan2(r * mpmath.sin(phi), h * mpmath.sin(a) + r * mpmath.cos(a) * mpmath.cos(phi))
    found = float(weiss.deviation(0.8, float(joint_angle), c1, c2, radius))
    assert found == pytest.approx(float(phi2 - phi), rel=1e-14)


def test_equal_offsets_are_even_at_any_bend():
    phi, joint_angle = np.linspace(-7, 7, 50), np.linspace(0, 1.3, 7)[:, None]
    assert np.all(weiss.deviation(phi, joint_angle, 0.003, 0.003, 0.03) == 0.0)
    assert np.all(weiss.plane_tilt(joint_angle, 0.003, 0.003) == 0.0)
    assert np.all(weiss.plane_offset(joint_angle, 0.003, 0.003) == 0.0)


@pytest.mark.parametrize(("c1", "c2", "radius"), [(0.03, 0.03, 0.02), (0.003, 0.003, -1.0), (0.003, np.nan, 0.03)])
def test_grooves_that_do_not_meet_have_no_ball(c1, c2, radius):
    assert np.isnan(weiss.deviation(0.3, 0.4, c1, c2, radius))


def test_any_array_library_computes_them():
    phi, joint_angle = strict.asarray([0.1, 0.6]), strict.asarray([0.3, 0.7])
    lengths = [strict.asarray(x) for x in (0.004, 0.003, 0.03)]
    found = weiss.deviation(phi, joint_angle, *lengths)
    assert np.array_equal(np.asarray(found), weiss.deviation([0.1, 0.6], [0.3, 0.7], 0.004, 0.003, 0.03))


@pytest.mark.parametrize("balls", [1, 3, 4])
def test_balls_that_share_turn_as_the_mean_of_each_however_sharp(balls):
    """Grooves offset eight times as far as the others, far bent: the law has harmonics of a hundredfold order."""
    joint = weiss.Weiss(driving_offset=0.0263, driven_offset=0.0033, groove_radius=0.0241, balls=balls)
    theta = np.linspace(0.0, 2.0 * np.pi, 331) + 0.013
    each = [weiss.deviation(theta + k * 2.0 * np.pi / balls, 59.0 * deg, 0.0263, 0.0033, 0.0241) for k in range(balls)]
    found = joint.deviation(theta, np.asarray(59.0 * deg))
    assert np.abs(found[0] - np.mean(each, axis=0)).max() < 1e-12


def test_grooves_that_turn_the_shaft_another_way_round_make_no_joint():
    """The ball passes between both shafts, so that the driven one swings to and fro instead of turning."""
    sizes = 0.0273, 0.0148, 0.0238
    theta = np.linspace(0.0, 2.0 * np.pi, 4001)
    turned = np.unwrap(theta + weiss.deviation(theta, 72.0 * deg, *sizes))
    assert np.ptp(turned) < 2.0 * np.pi - 0.1
    joint = weiss.Weiss(**dict(zip(weiss.Weiss.law_sizes, sizes, strict=True)), balls=1)
    assert np.all(np.isnan(joint.deviation(theta, np.asarray(72.0 * deg))[0]))
    assert np.all(np.isfinite(joint.deviation(theta, np.asarray(20.0 * deg))[0]))
    with speaking("en"):
        assert joint.stuck(72.0 * deg).endswith(f"turns to and fro by {np.ptp(turned) / deg:.4g}°")


def test_grooves_that_do_not_meet_are_told_with_place_and_gap():
    """The plane of the balls is as far from one groove centre as from the other: its points in the meridian plane."""
    c1, c2, radius = 0.03, 0.025, 0.02
    other = c2 * axes(30.0 * deg)[0]
    gaps = []
    for phi in np.radians(np.arange(0.0, 360.0, 0.5)):
        way = np.cos(phi) * P1 + np.sin(phi) * N
        normal = c1 * E1 - other
        level = 0.5 * (c1**2 - other @ other)
        a, b = normal @ E1, normal @ way
        gaps.append(abs(level - a * c1) / np.hypot(a, b) - radius)
    k = int(np.argmax(gaps))
    for kind in (weiss.Weiss, Rzeppa):
        with speaking("en"):
            said = kind(driving_offset=c1, driven_offset=c2, groove_radius=radius).stuck(30.0 * deg)
        assert f"driving mark {0.5 * k:.4g}°" in said
        assert said.endswith(f"by {gaps[k] * 1e3:.3g} mm")
