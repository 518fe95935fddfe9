"""Against the loop of cross, shaft and support, closed in coordinates."""

import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from cardan.drive.joints import offset_cross
from cardan.units import deg

CASES = st.tuples(
    st.floats(1.0, 80.0), st.floats(-180.0, 180.0), st.floats(0.0, 0.3), st.floats(0.5, 2.0), st.sampled_from([-1, 1])
)


def closed(joint_angle, angle, e, reach, side):
    """Return the angle of pin 2 about OS, the angle of the shaft with OS, and its length.

    Shaft 1 runs along z, the support stands in the plane x z. Pin 2 turns about pin 1 until it is at right angles to
    the line from its own place to the support, as the shaft that it carries and that passes through the support is.
    """
    support = reach * np.array([np.sin(joint_angle), 0.0, np.cos(joint_angle)])
    one = np.array([np.cos(angle), np.sin(angle), 0.0])

    def joint(turn):
        along = np.cos(turn) * np.array([0.0, 0.0, 1.0]) + np.sin(turn) * np.cross(one, [0.0, 0.0, 1.0])
        return side * e * along, np.cross(along, one)

    def miss(turn):
        place, two = joint(turn)
        return two @ (support - place)

    # The common perpendicular stays within the joint angle of shaft 1.
    turn = brentq(miss, -0.5 * np.pi, 0.5 * np.pi, xtol=1e-15)
    place, two = joint(turn)
    line, shaft = support / reach, support - place
    up, out = np.array([0.0, 1.0, 0.0]), np.cross([0.0, 1.0, 0.0], line)
    about = np.arctan2(-two @ out, two @ up)
    tilt = np.arctan2(np.linalg.norm(np.cross(line, shaft)), line @ shaft)
    return about, tilt, np.linalg.norm(shaft)


@settings(max_examples=60)
@given(CASES)
def test_the_loop_closes_where_the_law_says(case):
    joint_angle, angle, e, reach, side = case
    joint_angle, angle = joint_angle * deg, angle * deg
    about, tilt, span = closed(joint_angle, angle, e, reach, side)
    away = np.remainder(about - offset_cross.output_angle(angle, joint_angle) + 1, 2 * np.pi) - 1
    # brentq leaves 1e-15 of the turn of pin 2; the length of the shaft, at least 0.2, passes on no more than ten times.
    assert away == pytest.approx(0.0, abs=1e-12)
    assert offset_cross.tilt(angle, joint_angle, e, reach, side) == pytest.approx(tilt, abs=1e-12)
    assert offset_cross.span(angle, joint_angle, e, reach, side) == pytest.approx(span, abs=1e-12)


def test_the_deviation_is_the_lead_of_the_output_angle():
    phi = np.linspace(-3.0, 3.0, 61)
    angle_error = offset_cross.output_angle(phi, 0.7) - phi
    np.testing.assert_allclose(offset_cross.deviation(phi, 0.7), angle_error, atol=1e-14)


def test_the_joint_runs_round_twice_a_turn():
    """The place of pin 2 leaves its mean by e sin α/2 in every direction, at twice the angle, for a long shaft."""
    joint_angle, e = 25 * deg, 0.02
    phi = np.linspace(0, 2 * np.pi, 721)[:-1]
    across = np.sin(joint_angle) * np.cos(
        phi
    )  # of pin 1 along OS: what the perpendicular has across OS points along pin 1
    flat = e * across[:, None] * np.stack([np.cos(phi) / np.cos(joint_angle), np.sin(phi)], -1)
    middle = flat.mean(0)
    radius = np.linalg.norm(flat - middle, axis=-1)
    assert radius == pytest.approx(0.5 * e * np.sin(joint_angle), rel=0.11), "an ellipse, 1/cos α longer than wide"
    reach = 1e4 * e
    swing = offset_cross.tilt(phi, joint_angle, e, reach)
    assert 0.5 * np.ptp(swing) == pytest.approx(float(offset_cross.wobble(joint_angle, e, reach)), rel=2e-4)


def test_the_shaking_force_is_that_of_a_mass_on_the_circle():
    m, omega, joint_angle, e, dt = 1.5, 100.0, 0.4, 0.02, 1e-5
    t = np.array([-dt, 0.0, dt])
    circle = 0.5 * e * np.sin(joint_angle) * np.exp(2j * omega * t)
    force = m * abs(circle[0] - 2 * circle[1] + circle[2]) / dt**2
    assert offset_cross.shaking_force(joint_angle, e, m, omega) == pytest.approx(force, rel=1e-5), (
        "of a difference quotient"
    )


def test_other_array_libraries():
    phi = strict.asarray([0.1, 2.0])
    got = offset_cross.tilt(phi, 0.3, 0.02, 0.5)
    np.testing.assert_allclose(np.asarray(got), offset_cross.tilt([0.1, 2.0], 0.3, 0.02, 0.5), rtol=1e-15)
    np.testing.assert_allclose(
        np.asarray(offset_cross.deviation(phi, 0.3)), offset_cross.deviation([0.1, 2.0], 0.3), rtol=1e-15
    )
