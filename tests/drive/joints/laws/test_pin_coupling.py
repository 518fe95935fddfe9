"""Against two lines in space closed by least squares, in coordinates of their own."""

import re

import array_api_strict as strict
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares

from cardan import Drive, InputError, motion
from cardan.drive.joints import pin_coupling
from cardan.joints import PinCoupling
from cardan.units import deg

UNEQUAL = (30 * deg, 0.05, 0.052, 40 * deg, 42 * deg)


def turned(v, axis, angle):
    return v * np.cos(angle) + np.cross(axis, v) * np.sin(angle) + axis * (axis @ v) * (1 - np.cos(angle))


def pins(phi, psi, joint_angle, a, b, one, two):
    """Return starts and directions of both pins: shaft 1 from below along z, shaft 2 leaves it toward y."""
    away1, away2 = np.array([0.0, 0.0, -1.0]), np.array([0.0, np.sin(joint_angle), np.cos(joint_angle)])
    inner1, inner2 = np.array([0.0, 1.0, 0.0]), np.array([0.0, np.cos(joint_angle), -np.sin(joint_angle)])
    d1 = turned(-np.cos(one) * away1 + np.sin(one) * inner1, away1, phi)
    d2 = turned(-np.cos(two) * away2 + np.sin(two) * inner2, -away2, psi)
    return a * away1, d1, b * away2, d2


def closed(phi, joint_angle, a, b, one, two):
    """Return φ2 - φ1, x, y and the place of the contact."""

    def gap(u):
        start1, d1, start2, d2 = pins(phi, phi + u[0], joint_angle, a, b, one, two)
        return (start1 + u[1] * a * d1 - start2 - u[2] * a * d2) / a

    x = pin_coupling.stroke(joint_angle, 1.0, 0.5 * (one + two))
    found = least_squares(gap, [0.0, x[0], x[0]], xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=200)
    if np.linalg.norm(found.fun) > 1e-11 or min(found.x[1:]) <= 0:
        found = least_squares(gap, [0.0, x[1], x[1]], xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=200)
    assert np.linalg.norm(found.fun) < 1e-11
    start1, d1, _start2, _d2 = pins(phi, phi, joint_angle, a, b, one, two)
    return found.x[0], a * found.x[1], a * found.x[2], start1 + a * found.x[1] * d1


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.0, 360.0),
    st.floats(0.0, 60.0),
    st.floats(-0.04, 0.04),
    st.floats(0.2, 0.8),
    st.floats(-0.05, 0.05),
)
def test_the_pins_meet_where_space_says(angle, joint_angle, unequal, within, apart):
    low, high = pin_coupling.slant_range(joint_angle * deg)
    one = low + within * (high - low)
    two = low + (within + apart) * (high - low)
    given_as = (angle * deg, joint_angle * deg, 0.05, 0.05 * (1 + unequal), one, two)
    found = pin_coupling.pin_contact(*given_as)
    angle_error, x, y, _place = closed(*given_as)
    assume(x > 0 and y > 0)
    # Least squares stops at 1e-15 of the gap; near the ends of the range the lines cross at small angles.
    assert found.deviation == pytest.approx(angle_error, abs=1e-9)
    assert found.first == pytest.approx(x, rel=1e-8)
    assert found.second == pytest.approx(y, rel=1e-8)


@settings(max_examples=40)
@given(st.floats(0.0, 360.0), st.floats(0.0, 80.0), st.floats(0.02, 0.98))
def test_pins_alike_run_evenly_within_the_range_of_slants(angle, joint_angle, within):
    low, high = pin_coupling.slant_range(joint_angle * deg)
    slant = low + within * (high - low)
    found = pin_coupling.pin_contact(angle * deg, joint_angle * deg, 0.04, 0.04, slant, slant)
    assert found.deviation == pytest.approx(0.0, abs=1e-11)
    assert found.ratio == pytest.approx(1.0, abs=1e-9)
    assert found.ratio_slope == pytest.approx(0.0, abs=1e-7)
    half = 0.5 * joint_angle * deg
    x = 0.04 / (np.cos(slant) + np.sin(slant) * np.cos(angle * deg) * np.tan(half))
    assert found.first == pytest.approx(x, rel=1e-9)
    least, most = pin_coupling.stroke(joint_angle * deg, 0.04, slant)
    assert least * (1 - 1e-9) <= found.first <= most * (1 + 1e-9)


def test_pins_alike_have_closed_forms():
    phi = np.linspace(0.1, 2 * np.pi, 40)  # in the plane of the shafts the normal of the general form is 0/0
    for joint_angle, slant in ((30 * deg, 40 * deg), (70 * deg, 37 * deg), (5 * deg, 80 * deg)):
        found = pin_coupling.pin_contact(phi[:-1], joint_angle, 0.04, 0.04, slant, slant)
        np.testing.assert_allclose(
            found.first, pin_coupling.along_alike(phi[:-1], joint_angle, 0.04, slant), rtol=1e-10
        )
        np.testing.assert_allclose(
            found.force, pin_coupling.force_alike(phi[:-1], joint_angle, 0.04, slant), rtol=1e-10
        )


def test_the_stroke_is_reached_on_both_sides_of_the_bend():
    found = pin_coupling.pin_contact(np.array([0.0, np.pi]), 0.5, 0.04, 0.04, 0.7, 0.7)
    np.testing.assert_allclose(found.first, pin_coupling.stroke(0.5, 0.04, 0.7), rtol=1e-14)


def test_the_contact_of_pins_alike_runs_on_an_ellipse():
    """In the halving plane, over the plane of the shafts and across it."""
    joint_angle, slant = 50 * deg, 48 * deg
    places = np.array([closed(k * 20 * deg, joint_angle, 0.05, 0.05, slant, slant)[3] for k in range(18)])
    along = np.array([0.0, np.cos(0.5 * joint_angle), -np.sin(0.5 * joint_angle)])
    u, v = places @ along, places[:, 0]
    rows = np.stack([u * u, u, v * v], -1)  # u²/p² + ... = 1, on both sides of the plane of the shafts alike
    (a, b, c), left, _rank, _sizes = np.linalg.lstsq(rows, np.ones(len(u)), rcond=None)
    assert left < 1e-18
    shorter, longer = sorted(((1 + 0.25 * b * b / a) / a, (1 + 0.25 * b * b / a) / c))
    assert np.sqrt(1 - shorter / longer) == pytest.approx(
        float(pin_coupling.eccentricity(joint_angle, slant)), rel=1e-6
    )


def test_ratio_and_slope_are_derivatives_of_the_turn():
    phi, step = np.linspace(0, 2 * np.pi, 73), 1e-4
    before, here, after = (pin_coupling.pin_contact(phi + k * step, *UNEQUAL) for k in (-1, 0, 1))
    slope = 1 + (after.deviation - before.deviation) / (2 * step)
    np.testing.assert_allclose(here.ratio, slope, atol=2e-7)  # step²/6 times the third derivative, and less rounding
    np.testing.assert_allclose(here.ratio_slope, (after.ratio - before.ratio) / (2 * step), atol=2e-6)
    np.testing.assert_allclose(pin_coupling.ratio(phi, *UNEQUAL), here.ratio)


@pytest.mark.parametrize("angle", [10, 100, 250])
def test_the_contact_force_carries_the_torque_of_both_shafts(angle):
    phi = angle * deg
    found = pin_coupling.pin_contact(phi, *UNEQUAL)
    joint_angle = UNEQUAL[0]
    angle_error, _x, _y, place = closed(phi, *UNEQUAL)
    _start1, d1, _start2, d2 = pins(phi, phi + angle_error, *UNEQUAL)
    normal = np.cross(d1, d2) / np.linalg.norm(np.cross(d1, d2))
    about1, about2 = np.array([0.0, 0.0, -1.0]), -np.array([0.0, np.sin(joint_angle), np.cos(joint_angle)])
    torque1, torque2 = (about @ np.cross(place, found.force * normal) for about in (about1, about2))
    assert abs(torque1) == pytest.approx(1.0, rel=1e-9)
    assert torque1 / torque2 == pytest.approx(found.ratio, rel=1e-9), "power in is power out"


def test_a_missed_plane_is_right_to_first_order():
    """Twice the shift leaves four times the rest, and the textbook example comes out."""
    phi, joint_angle, slant, a = np.linspace(0, 2 * np.pi, 361), 20 * deg, 45 * deg, 0.04
    rest = []
    for shift in (1e-5, 2e-5):
        found = pin_coupling.pin_contact(phi, joint_angle, a + shift, a - shift, slant, slant)
        off = pin_coupling.missed_by_pins(phi, joint_angle, shift, slant)
        first = pin_coupling.missed_plane(phi, joint_angle, off, found.first * np.sin(slant))
        rest.append(np.max(np.abs(found.deviation - first)))
    assert rest[1] / rest[0] == pytest.approx(4.0, abs=0.05)
    found = pin_coupling.pin_contact(phi, joint_angle, a + 0.2e-3, a - 0.2e-3, slant, slant)
    assert np.max(np.abs(found.deviation)) / deg == pytest.approx(0.107, abs=5e-4)
    assert np.ptp(found.ratio) == pytest.approx(0.0038, abs=5e-5)


def test_pins_that_do_not_meet_are_not_numbers():
    found = pin_coupling.pin_contact([0.0, np.pi], 30 * deg, 0.05, 0.05, 76 * deg, 76 * deg)
    assert np.isnan(found.deviation).any()
    assert np.array_equal(np.isnan(found.deviation), np.isnan(found.ratio))


def test_other_array_libraries():
    phi = strict.asarray([0.1, 2.0])
    ours, theirs = pin_coupling.pin_contact([0.1, 2.0], *UNEQUAL), pin_coupling.pin_contact(phi, *UNEQUAL)
    for name in ("deviation", "ratio", "ratio_slope", "first", "second", "force"):
        np.testing.assert_allclose(np.asarray(getattr(theirs, name)), getattr(ours, name), rtol=1e-12)


def test_what_turns_turns_once_a_turn_by_its_speed():
    """A contact that is lost and found elsewhere leaves out a part of the turn: such pins are refused."""
    draw = np.random.default_rng(2)
    turn, refused = np.arange(0.0, 360.0, 0.5) * deg, 0
    for _case in range(600):
        joint_angle = draw.uniform(0.05, 0.9)
        low, high = pin_coupling.slant_range(joint_angle)
        one, two = draw.uniform(low, high, 2)
        joint = PinCoupling(
            driving_slant=one, driven_slant=two, driving_distance=0.05, driven_distance=draw.uniform(0.03, 0.075)
        )
        lead, ratio, _slope = joint.deviation(turn, np.asarray(joint_angle))
        if not np.all(np.isfinite(lead)):
            refused += 1
            why = joint.stuck(joint_angle)
            assert "miss each other by" in why or "leaps" in why
        elif np.max(ratio) < 20.0:  # beyond it half a degree is too coarse for the sum
            assert np.mean(ratio) == pytest.approx(1.0, abs=1e-3)
    assert refused > 5


def test_pins_that_do_not_turn_say_why_and_where():
    """Alike, they lie in line where cos φ = tan θ/tan(α/2), are parallel where cos φ = -cot θ cot(α/2)."""
    for slant, word in ((20.0, "lie in one line"), (70.0, "are parallel")):
        with pytest.raises(InputError, match="between 25° and 65°") as refused:
            motion(Drive(joints=(PinCoupling(driving_slant=slant * deg, joint_angle=50 * deg),)))
        (problem,) = refused.value.problems
        assert word in problem.message
        place = float(re.search(r"driving mark ([\d.]+)° from", problem.message)[1]) * deg
        half, lean = np.tan(25 * deg), np.tan(slant * deg)
        sought = lean / half if slant < 25.0 else -1.0 / (lean * half)
        assert np.cos(place) == pytest.approx(sought, abs=3e-4)  # four digits of the angle
    apart = PinCoupling(
        driving_slant=38.08 * deg, driven_slant=20.47 * deg, driving_distance=0.05, driven_distance=0.032,
        joint_angle=35.24 * deg,
    )  # fmt: skip
    start, along, *_driven = pins(0.0, 0.0, 35.24 * deg, 0.05, 0.032, 38.08 * deg, 20.47 * deg)

    def between(u):
        _start, _along, other, way = pins(0.0, u[0], 35.24 * deg, 0.05, 0.032, 38.08 * deg, 20.47 * deg)
        return 1e3 * (start + u[1] * along - other - u[2] * way)

    nearest = min(
        np.linalg.norm(least_squares(between, [psi, x, x], bounds=([-7.0, 0.0, 0.0], [7.0, 5.0, 5.0])).fun)
        for psi in (0.0, 1.0, 3.0)
        for x in (0.01, 0.06)
    )
    with pytest.raises(InputError, match=rf"mark 0° from the plane .* miss each other by {nearest:.3g} mm"):
        motion(Drive(joints=(apart,)))
