"""Against the loop of two hinged arms and a ball joint, and pins as circles without end."""

from dataclasses import replace

import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares

from cardan import Drive, InputError, motion
from cardan.drive.joints import clemens, pin_coupling
from cardan.drive.joints.clemens import Circle
from cardan.units import deg

ARM = Circle(axial=0.06, radial=0.01, radius=0.075)
OTHER = Circle(axial=0.062, radial=0.011, radius=0.074)


def closed(phi, joint_angle, first, second):
    """Return φ2 - φ1 of the loop R-R-S-R-R: arms swing in the meridian planes until their ends are one."""
    half = 0.5 * joint_angle
    # The halving plane is x = 0; shaft 1 leaves toward +x, shaft 2 toward -x, both rise toward the inner side, +y.
    e1, e2 = np.array([np.cos(half), np.sin(half), 0.0]), np.array([-np.cos(half), np.sin(half), 0.0])
    p1, p2, n = np.array([-np.sin(half), np.cos(half), 0.0]), np.array([np.sin(half), np.cos(half), 0.0]), [0, 0, 1.0]

    def end(e, p, angle, arm, circle):
        out = np.cos(angle) * p + np.sin(angle) * np.asarray(n)
        h, r = circle.axial + circle.radius * np.cos(arm), circle.radial + circle.radius * np.sin(arm)
        return h * e + r * out

    def gap(u):
        return (end(e1, p1, phi, u[1], first) - end(e2, p2, phi + u[0], u[2], second)) / first.radius

    arm = np.arccos(-first.axial / first.radius)
    found = least_squares(gap, [0.0, arm, arm], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert np.linalg.norm(found.fun) < 1e-11
    return found.x[0]


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.0, 360.0),
    st.floats(1.0, 40.0),
    st.floats(-0.03, 0.03),
    st.floats(-0.03, 0.03),
    st.floats(-0.03, 0.03),
)
def test_the_arms_meet_where_space_says(angle, joint_angle, h, r, radius):
    second = Circle(axial=0.06 * (1 + h), radial=0.01 * (1 + r), radius=0.075 * (1 + radius))
    found = clemens.deviation(angle * deg, joint_angle * deg, ARM, second)
    assert found == pytest.approx(closed(angle * deg, joint_angle * deg, ARM, second), abs=1e-10)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.0, 360.0), st.floats(0.0, 45.0), st.floats(0.03, 0.06), st.floats(0.0, 0.03))
def test_profiles_alike_run_evenly(angle, joint_angle, axial, radial):
    circle = Circle(axial=axial, radial=radial, radius=0.075)
    found = clemens.profile_contact(angle * deg, joint_angle * deg, circle, circle)
    assert found.deviation == pytest.approx(0.0, abs=1e-11)
    assert found.ratio == pytest.approx(1.0, abs=1e-9)
    assert found.height1 == pytest.approx(float(found.height2), abs=1e-11)


def test_the_ratio_is_the_slope_of_the_turn():
    phi, step = np.linspace(0, 2 * np.pi, 25), 1e-4
    turn = [clemens.deviation(phi + k * step, 30 * deg, ARM, OTHER) for k in (-1, 1)]
    ratio = clemens.ratio(phi, 30 * deg, ARM, OTHER)
    np.testing.assert_allclose(ratio, 1 + (turn[1] - turn[0]) / (2 * step), atol=1e-8)
    ahead = [clemens.ratio(phi + k * step, 30 * deg, ARM, OTHER) for k in (-1, 1)]
    slope = clemens.ratio_slope(phi, 30 * deg, ARM, OTHER)
    np.testing.assert_allclose(slope, (ahead[1] - ahead[0]) / (2 * step), atol=1e-7)


def test_a_pin_is_a_circle_without_end():
    """Deviation, ratio and force of pins are those of ever larger circles that touch them: the rest falls like 1/R."""
    joint_angle, a, b, one, two = 30 * deg, 0.05, 0.052, 40 * deg, 42 * deg
    phi = np.linspace(0, 2 * np.pi, 13)
    pins = pin_coupling.pin_contact(phi, joint_angle, a, b, one, two)

    def circle(start, slant, radius):
        x = 0.06  # touches the pin about where it is used
        h, r = start - x * np.cos(slant), x * np.sin(slant)
        return Circle(axial=h - radius * np.sin(slant), radial=r - radius * np.cos(slant), radius=radius)

    rest = []
    for radius in (5.0, 10.0):
        found = clemens.profile_contact(phi, joint_angle, circle(a, one, radius), circle(b, two, radius))
        rest.append([np.max(np.abs(getattr(found, n) - getattr(pins, n))) for n in ("deviation", "ratio", "force")])
    assert np.asarray(rest[0]) / np.asarray(rest[1]) == pytest.approx([2.0] * 3, rel=0.03)
    assert rest[1][0] < 1e-3


def test_balls_in_offset_grooves_lie_in_the_plane_of_the_groove_centres():
    joint_angle, c1, c2, radius = 30 * deg, 0.006, 0.005, 0.03
    phi = np.linspace(0, 2 * np.pi, 7)[:-1]
    first, second = (Circle(axial=c, radial=0.0, radius=radius) for c in (c1, c2))
    found = clemens.profile_contact(phi, joint_angle, first, second)
    # A·(c1 e1 - c2 e2) = (c1² - c2²)/2, heights being A·e1 and A·e2.
    np.testing.assert_allclose(c1 * found.height1 - c2 * found.height2, 0.5 * (c1**2 - c2**2), atol=1e-16)


def test_profiles_that_do_not_meet_are_not_numbers():
    far = Circle(axial=1.0, radial=0.0, radius=0.01)
    assert np.isnan(clemens.deviation(0.3, 0.2, ARM, far))


def test_other_array_libraries():
    phi = strict.asarray([0.1, 2.0])
    got = clemens.profile_contact(phi, 0.3, ARM, OTHER)
    want = clemens.profile_contact([0.1, 2.0], 0.3, ARM, OTHER)
    np.testing.assert_allclose(np.asarray(got.deviation), want.deviation, rtol=1e-10)
    np.testing.assert_allclose(np.asarray(got.ratio), want.ratio, rtol=1e-10)


def test_arms_alike_reach_each_other_as_the_contact_says():
    """The sides of the halving plane that count against the contact looked for all round."""
    draw = np.random.default_rng(5)
    turn, seen = np.arange(0.0, 360.0, 3.0) * deg, []
    for _case in range(120):
        axial, radial = draw.uniform(0.03, 0.07), draw.uniform(0.0, 0.03)
        radius, joint_angle = np.hypot(axial, radial) * draw.uniform(0.4, 1.3), draw.uniform(0.05, 1.2)
        own = clemens.ClemensProfile(axial=axial, radial=radial, radius=radius)
        circle = Circle(axial=axial, radial=radial, radius=radius)
        found = clemens.profile_contact(turn, joint_angle, circle, circle).deviation
        meets = bool(clemens.meets(own, np.asarray(joint_angle)))
        assert meets == bool(np.all(np.abs(found) < 1e-9)), (axial, radial, radius, joint_angle)
        seen.append(meets)
    assert 20 < sum(seen) < 100


@pytest.mark.parametrize("driven", [None, 0.03])
def test_arms_that_are_too_short_are_told_by_how_much(driven):
    """At half a turn the circles, mirrored in the halving plane, are apart by twice what they miss of it."""
    own = clemens.ClemensProfile(axial=0.06, radial=0.03, radius=0.03)
    other = None if driven is None else replace(own, radial=0.03)
    joint = clemens.Clemens(driving=own, driven=other, joint_angle=20 * deg)
    apart = 2.0 * ((0.06 * np.cos(10 * deg) + 0.03 * np.sin(10 * deg)) - 0.03)
    with pytest.raises(InputError, match=rf"mark 180° from the plane .* miss each other by {1e3 * apart:.3g} mm"):
        motion(Drive(joints=(joint,)))


def test_arms_whose_contact_leaps_do_not_turn():
    one, two = (
        clemens.ClemensProfile(axial=a, radial=r, radius=radius)
        for a, r, radius in ((0.0673, 0.00776, 0.06364), (0.05638, 0.006, 0.05948))
    )
    with pytest.raises(InputError, match="contact leaps"):
        motion(Drive(joints=(clemens.Clemens(driving=one, driven=two, joint_angle=44.5 * deg),)))
