from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, InputError, motion
from cardan.drive.accuracy import Error
from cardan.drive.joints import Hooke
from cardan.drive.models.kinematics_model import Chain, chain
from cardan.drive.support import Support
from cardan.questions.accuracy.accuracy import TURNS, WAYS, course, one_turn, sensitivity, transmission_error
from cardan.sweeps import Drives
from cardan.units import deg, mm
from tests.builders.drives import plans
from tests.builders.loop_newton import solved

RIGHT = 0.5 * np.pi


def random_errors(rng, n, size):
    return rng.uniform(-size, size, (n, 5))


@pytest.mark.slow
@settings(max_examples=15)
@given(plans(most=4), st.integers(0, 10**6), st.floats(-3.0, 3.0))
def test_a_chain_of_loops_solved_by_newton_agrees(plan, seed, phi):
    """Each joint as a product of 4x4 matrices driven to the unit matrix, the angles and slides handed on by hand."""
    rng = np.random.default_rng(seed)
    n = len(plan.joint_angles)
    turns, ways = random_errors(rng, n, 1 * deg), random_errors(rng, n, 1 * mm)
    found = transmission_error(plan.drive, [phi], turns=turns, ways=ways)
    nominal = chain(plan.drive)
    theta, shift = phi + nominal.turn_before[0], 0.0
    perfect = theta
    for j in range(n):
        if j:
            theta, perfect = theta + nominal.turn_before[j], perfect + nominal.turn_before[j]
        theta += turns[j, 0]
        alpha = np.asarray([RIGHT, RIGHT, RIGHT, nominal.joint_angle[j]]) + turns[j, 1:]
        turned = np.arctan2(np.sin(theta), np.cos(theta) * np.cos(nominal.joint_angle[j]))
        c, s = np.cos(theta), np.sin(theta)
        near = np.sqrt(s**2 + (c * np.cos(nominal.joint_angle[j])) ** 2)
        phi2 = np.arctan2(np.cos(nominal.joint_angle[j]), np.sin(nominal.joint_angle[j]) * s)
        phi3 = np.arctan2(near, np.sin(nominal.joint_angle[j]) * c)
        start = [phi2, phi3, RIGHT - turned, 0.0, 0.0, 0.0]
        unknown, left = solved(alpha, ways[j, 1:], theta, shift + ways[j, 0], start)
        assert left < 1e-13
        theta, shift = RIGHT - unknown[2], -unknown[5]
        perfect = np.arctan2(np.sin(perfect), np.cos(perfect) * np.cos(nominal.joint_angle[j]))
        # Rounding of n joints, and Newton's last step.
        assert found.shift[j, 0] == pytest.approx(shift, abs=1e-14)
    assert np.angle(np.exp(1j * (theta - perfect))) == pytest.approx(found.error[0], abs=1e-12)
    assert bool(found.closes)


@pytest.mark.slow
@given(plans(straight=False), st.floats(-0.2, 0.2))
def test_an_error_of_the_first_phase_is_an_input_turned_on(plan, late):
    phi = one_turn(24)
    n = len(plan.joint_angles)
    turns = np.zeros((n, 5))
    turns[0, 0] = late
    found = transmission_error(plan.drive, phi, turns=turns)
    expected = motion(plan.drive, phi + late).output_angle - motion(plan.drive, phi).output_angle
    assert found.error == pytest.approx(expected, abs=1e-13)


@pytest.mark.slow
@given(plans(straight=False, joint_angle=30 * deg), st.floats(-2.0, 2.0), st.integers(0, 5))
def test_an_error_of_the_bend_is_another_bend(plan, more, which):
    phi = one_turn(24)
    j = which % len(plan.joint_angles)
    turns = np.zeros((len(plan.joint_angles), 5))
    turns[j, 4] = more * deg
    found = transmission_error(plan.drive, phi, turns=turns).error
    nominal = chain(plan.drive)
    changed = nominal.joint_angle + turns[:, 4]
    sign = np.where(
        changed < 0, -1.0, 1.0
    )  # a joint angle below zero is one above with the plane turned round: the same law
    other = Chain(
        joint_angle=changed * sign,
        plane_twist=nominal.plane_twist,
        yoke_angle=nominal.yoke_angle,
        start_phase=nominal.start_phase,
    )
    expected = motion(other, phi).output_angle - motion(nominal, phi).output_angle
    assert found - found[0] == pytest.approx(expected, abs=1e-12)


@settings(max_examples=30)
@given(plans(joint_angle=35 * deg), st.integers(0, 10**6))
def test_sensitivities_are_the_differences_of_the_exact_chain(plan, seed):
    phi = one_turn(12)
    n = len(plan.joint_angles)
    table = sensitivity(plan.drive, phi)
    rng = np.random.default_rng(seed)
    direction = rng.uniform(-1, 1, (n, 5))
    h = 1e-4
    up, down = (transmission_error(plan.drive, phi, turns=k * h * direction).error for k in (1, -1))
    # The third derivative along a direction of length up to √(5n) is below 1e3; h² of it.
    assert (up - down) / (2 * h) == pytest.approx(np.sum(table * direction, axis=(-2, -1)), abs=1e-4)


@pytest.mark.slow
@given(plans(), st.integers(0, 10**6))
def test_lengths_feel_what_angles_feel(plan, seed):
    """The same table serves both, and without errors of angles it is exact for lengths of any size."""
    phi = one_turn(12)
    n = len(plan.joint_angles)
    ways = random_errors(np.random.default_rng(seed), n, 1.0)
    found = transmission_error(plan.drive, phi, ways=ways)
    expected = np.sum(sensitivity(plan.drive, phi) * ways, axis=(-2, -1))
    assert found.output_shift == pytest.approx(expected, abs=1e-12)
    assert found.shift_linear == pytest.approx(found.shift, abs=1e-12)
    assert np.max(np.abs(found.error)) < 1e-14


@settings(max_examples=40)
@given(plans(most=4, joint_angle=25 * deg), st.integers(0, 10**6))
def test_what_is_left_of_the_linear_errors_is_of_second_order(plan, seed):
    rng = np.random.default_rng(seed)
    n = len(plan.joint_angles)
    turns, ways = random_errors(rng, n, 1.0), random_errors(rng, n, 1.0)
    left = []
    for size in (1e-3, 1e-4):
        found = transmission_error(plan.drive, one_turn(24), turns=size * turns, ways=size * ways)
        left.append(
            [
                np.max(np.abs(found.error - found.error_linear)),
                np.max(np.abs(found.shift - found.shift_linear)),
            ]
        )
    # A tenth of the error leaves about a hundredth; third order and rounding the rest.
    assert np.all(np.asarray(left[1]) < 0.0105 * np.asarray(left[0]) + 1e-9)


def test_squareness_of_the_pins_shows_once_a_turn_and_the_cross_as_an_offset():
    drive = Drive.from_angles([30 * deg])
    curves = {name: transmission_error(drive, errors=Error(**{name: 0.01 * deg})) for name in TURNS}
    parts = {name: course(curve.error / (0.01 * deg)) for name, curve in curves.items()}
    for name in ("alpha1", "alpha3"):
        # Second-order terms are 0.01° of the error.
        assert parts[name].mean == pytest.approx(0.0, abs=1e-3)
        assert parts[name].second == pytest.approx(0.0, abs=1e-3)
        assert parts[name].first > 0.5
    peak = {name: np.max(np.abs(curves[name].error)) / (0.01 * deg) for name in TURNS}
    assert peak["alpha1"] == pytest.approx(np.sin(30 * deg), rel=1e-3)
    assert peak["alpha3"] == pytest.approx(np.tan(30 * deg), rel=1e-3)
    assert peak["alpha4"] == pytest.approx(0.5 * np.tan(30 * deg), rel=1e-3)
    assert peak["alpha2"] == pytest.approx(1 / np.cos(30 * deg), rel=1e-3)
    assert parts["alpha2"].mean == pytest.approx(1.0, abs=0.1)
    assert parts["alpha2"].first == pytest.approx(0.0, abs=1e-3)
    assert parts["alpha4"].mean == pytest.approx(0.0, abs=1e-3)


def test_a_shaft_held_along_its_axis_ends_the_shift():
    drive = Drive.from_angles([20 * deg, 15 * deg], yoke_angles=[0.3])
    ways = np.zeros((2, 5))
    ways[0] = 1e-3
    free = transmission_error(drive, ways=ways)
    assert np.max(np.abs(free.output_shift)) > 1e-3
    held = transmission_error(drive, ways=ways, located=[2])
    assert np.max(np.abs(held.output_shift)) == 0.0
    assert np.array_equal(held.shift[0], free.shift[0])
    assert np.array_equal(held.shift_linear[1], 0 * held.angle)
    centred = replace(drive, supports=(Support(shaft=2, position=0.4, axial=True),))
    assert np.array_equal(transmission_error(centred, ways=ways).shift, held.shift)
    own = np.zeros((2, 5))
    own[1] = 1e-3
    assert np.array_equal(
        transmission_error(drive, ways=own, located=[2]).shift, transmission_error(drive, ways=own).shift
    )
    table = sensitivity(drive, [0.5], located=[2])
    assert np.all(table[:, 0] == 0.0)
    assert np.array_equal(table[:, 1], sensitivity(drive, [0.5])[:, 1])


def test_errors_of_the_drive_file_are_taken():
    skew = Error(alpha1=0.1 * deg, s1=0.1 * mm)
    joints = (Hooke(joint_angle=30 * deg, plane_twist=0.0, error=skew), Hooke(joint_angle=30 * deg, plane_twist=0.0))
    drive = Drive(joints=joints)
    found = transmission_error(drive)
    turns, ways = np.zeros((2, 5)), np.zeros((2, 5))
    turns[0, TURNS.index("alpha1")] = 0.1 * deg
    ways[0, WAYS.index("s1")] = 0.1 * mm
    assert np.array_equal(found.error, transmission_error(drive, turns=turns, ways=ways).error)
    assert np.array_equal(found.shift, transmission_error(drive, errors=[skew, None]).shift)
    assert np.max(np.abs(transmission_error(drive, errors=[None, None]).error)) < 1e-15


def test_batches_of_drives_and_of_errors():
    rng = np.random.default_rng(1)
    many = Drives.from_angles(rng.uniform(0, 0.6, (5, 3)), yoke_angle=rng.uniform(-1, 1, (5, 2)))
    turns, ways = rng.uniform(-0.01, 0.01, (5, 3, 5)), rng.uniform(-0.01, 0.01, (5, 3, 5))
    phi = one_turn(7)
    found = transmission_error(many, phi, turns=turns, ways=ways)
    assert found.error.shape == (5, 7)
    assert found.shift.shape == (5, 3, 7)
    assert sensitivity(many, phi).shape == (5, 7, 3, 5)
    for k in range(5):
        alone = transmission_error(
            Drives.from_angles(many.chain.joint_angle[k], yoke_angle=many.chain.yoke_angle[k]),
            phi,
            turns=turns[k],
            ways=ways[k],
        )
        assert found.error[k] == pytest.approx(alone.error, abs=1e-15)
        assert found.shift[k] == pytest.approx(alone.shift, abs=1e-16)
    cast = transmission_error(Drive.from_angles([0.2, 0.3, 0.1]), phi, turns=turns)
    assert cast.error.shape == (5, 7)


def test_a_joint_that_cannot_be_assembled_is_told_in_a_batch():
    turns = np.zeros((2, 1, 5))
    turns[1, 0, 2] = 20 * deg
    found = transmission_error(Drive.from_angles([80 * deg]), turns=turns)
    assert list(found.closes) == [True, False]
    assert np.all(np.isfinite(found.error[0]))
    assert np.any(np.isnan(found.error[1]))
    assert np.any(np.isfinite(found.error[1]))


def test_errors_on_the_standard_alone():
    xp = pytest.importorskip("array_api_strict")
    rng = np.random.default_rng(1)
    joint_angle, yoke, turns = (
        rng.uniform(0, 0.6, (4, 3)),
        rng.uniform(-1, 1, (4, 2)),
        rng.uniform(-0.01, 0.01, (4, 3, 5)),
    )
    phi = one_turn(6)
    plain = transmission_error(Drives.from_angles(joint_angle, yoke_angle=yoke), phi, turns=turns, ways=turns)
    strict = transmission_error(
        Drives.from_angles(xp.asarray(joint_angle), yoke_angle=xp.asarray(yoke)),
        xp.asarray(phi),
        turns=xp.asarray(turns),
        ways=xp.asarray(turns),
    )
    assert np.allclose(np.asarray(strict.error), plain.error, rtol=0, atol=1e-14)
    assert np.allclose(np.asarray(strict.shift_linear), plain.shift_linear, rtol=0, atol=1e-14)
    table = sensitivity(Drives.from_angles(xp.asarray(joint_angle), yoke_angle=xp.asarray(yoke)), xp.asarray(phi))
    assert np.allclose(
        np.asarray(table), sensitivity(Drives.from_angles(joint_angle, yoke_angle=yoke), phi), atol=1e-14
    )
    assert np.asarray(course(strict.error).first).shape == (4,)


@pytest.mark.parametrize(
    ("given_errors", "field"),
    [
        ({"turns": np.zeros((3, 5))}, "turns"),
        ({"ways": np.zeros((2, 4))}, "ways"),
        ({"errors": [None]}, "errors"),
        ({"errors": Error(), "turns": np.zeros((2, 5))}, "errors"),
    ],
)
def test_errors_of_another_number_of_joints_are_refused(given_errors, field):
    with pytest.raises(InputError) as caught:
        transmission_error(Drive.from_angles([0.1, 0.2]), **given_errors)
    assert caught.value.field == field
