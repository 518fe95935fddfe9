import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import Drive, InputError, motion
from cardan.drive.duty import Duty
from cardan.questions.motion.motion import initial_phases
from cardan.sweeps import Drives, stack
from cardan.units import deg
from tests.builders.drives import plans
from tests.builders.vector_model import VectorModel, cross, dot

LONG = np.arange(-500, 901) * deg
ANY = np.asarray([-7.1, -0.4, 0.0, 1.0, 2.5, 9.0])


@settings(max_examples=40)
@given(plans())
def test_every_shaft_turns_as_vectors_say_over_four_turns(plan):
    moved = motion(plan.drive, LONG)
    want = plan.vectors.continuous(LONG)
    # Vectors are normalised n times; 16 rad carry 2e-15 themselves. A joint of 40° widens an error by 1/cos at most.
    assert np.max(np.abs(moved.shaft_angle - want)) < 3e-14
    assert np.max(np.abs(moved.shaft_ratio - np.asarray(plan.vectors.ratios(LONG)))) < 3e-14


@settings(max_examples=12)
@given(plans(most=5), st.floats(-1.5, 1.5))
def test_ratio_and_acceleration_are_derivatives_of_vector_positions(plan, angle):
    moved = motion(plan.drive, [angle], speed=1.0)
    with mpmath.workdps(40):
        exact = [tuple(mpmath.mpf(x) for x in row) for row in (plan.joint_angles, plan.plane_twists, plan.yoke_angles)]
        model = VectorModel.from_angles(*exact, mpmath.mpf(plan.start_phase), lib=mpmath)
        for k in range(len(plan.joint_angles) + 1):

            def turned(phi, k=k):
                return model.angles(phi)[k]

            # 40 digits lose half in a second difference: 1e-20 is left, doubles decide.
            ratio, slope = (float(mpmath.diff(turned, angle, order)) for order in (1, 2))
            assert moved.shaft_ratio[k, 0] == pytest.approx(ratio, abs=1e-14)
            assert moved.shaft_acceleration[k, 0] == pytest.approx(slope, abs=3e-14)


@given(plans(), st.floats(-3, 3))
def test_crosses_turn_in_their_yokes_as_vectors_say(plan, angle):
    moved = motion(plan.drive, [angle])
    model = plan.vectors
    driving, driven = model.arms(angle)
    for i, (u, v) in enumerate(zip(driving, driven, strict=True)):
        # About u_i the cross turns from the plane across shaft i to where v is; about v from that across i+1 to u.
        into = cross(model.axes[i], u)
        assert moved.cross_driving[i, 0] == pytest.approx(np.arctan2(dot(cross(into, v), u), dot(into, v)), abs=1e-14)
        out = cross(v, model.axes[i + 1])
        assert moved.cross_driven[i, 0] == pytest.approx(np.arctan2(dot(cross(out, u), v), dot(out, u)), abs=1e-14)


@given(plans(), st.floats(-3, 3))
def test_rates_of_the_crosses_are_their_derivatives(plan, angle):
    step = 1e-5
    around = motion(plan.drive, [angle - 2 * step, angle - step, angle, angle + step, angle + 2 * step])
    for value, rate in (
        (around.cross_driving, around.cross_driving_rate),
        (around.cross_driven, around.cross_driven_rate),
    ):
        near, far = value[:, 3] - value[:, 1], value[:, 4] - value[:, 0]
        # Fourth-order difference: rounding 1e-16/1e-5 rules, 1e-11 and some.
        assert np.allclose(rate[:, 2], (8 * near - far) / (12 * step), rtol=0, atol=3e-10)


@given(plans(), st.floats(-np.pi, np.pi))
def test_another_start_only_shifts_the_angles(plan, later):
    """A drive started later by κ: same ratios κ further on, angles counted from there, for joint and shaft alike."""
    other = Drive.from_angles(
        plan.joint_angles,
        plane_twists=plan.plane_twists,
        yoke_angles=plan.yoke_angles,
        start_phase=plan.start_phase + later,
    )
    begin = motion(plan.drive, [later])
    here, there = motion(plan.drive, ANY + later), motion(other, ANY)
    assert np.allclose(here.shaft_ratio, there.shaft_ratio, rtol=0, atol=3e-14)
    assert np.allclose(here.shaft_angle - begin.shaft_angle, there.shaft_angle, rtol=0, atol=3e-14)


@pytest.mark.slow
@given(plans(joint_angle=60 * deg))
def test_the_mean_speed_of_every_shaft_is_that_of_the_input(plan):
    turn = motion(plan.drive, np.arange(4096) * (2 * np.pi / 4096))
    whole = motion(plan.drive, [0.0, np.pi, 2 * np.pi, -6 * np.pi])
    assert np.allclose(whole.shaft_angle, whole.angle, rtol=0, atol=2e-14)
    # Trapezoids of a periodic function converge geometrically, with τ^2048 of the chain: τ < 0.96 even at 6 × 60°.
    if turn.shaft_ratio.max() < 100:
        assert np.allclose(turn.shaft_ratio.mean(axis=-1), 1.0, rtol=0, atol=1e-12)


@given(plans(), st.floats(-5, 5), st.floats(0.1, 400.0), st.floats(-1e3, 1e3))
def test_acceleration_adds_what_the_input_gains_and_what_the_joints_make(plan, angle, speed, gain):
    moved = motion(plan.drive, [angle], speed=speed, acceleration=gain)
    steady = motion(plan.drive, [angle], speed=speed)
    added = moved.shaft_acceleration - steady.shaft_acceleration
    scale = speed**2 + abs(gain)
    assert np.allclose(added, gain * moved.shaft_ratio, rtol=0, atol=1e-13 * scale)
    assert np.allclose(moved.shaft_speed, speed * moved.shaft_ratio, rtol=1e-15, atol=0)


@given(plans())
def test_joint_angles_start_at_the_phase_angles(plan):
    start = motion(plan.drive, [0.0])
    assert np.allclose(start.yoke_rotation[:, 0], initial_phases(plan.drive), rtol=0, atol=1e-15)
    assert np.all(start.shaft_angle == 0.0)


def test_running_backwards_mirrors_the_accelerations_of_a_joint_started_in_its_plane():
    drive = Drive.from_angles([30 * deg])
    ahead, back = motion(drive, ANY, speed=50.0), motion(drive, -ANY, speed=-50.0)
    assert np.allclose(ahead.shaft_speed, -back.shaft_speed, rtol=0, atol=1e-12)
    assert np.allclose(ahead.shaft_acceleration, -back.shaft_acceleration, rtol=0, atol=1e-10)


@pytest.mark.parametrize("n", range(1, 7))
def test_a_batch_is_its_drives(n):
    """Not always to the last bit: NumPy fuses complex products in its vector loops, not in those over one number."""
    rng = np.random.default_rng(n)
    joint_angle, twist, yoke = rng.uniform(0, 0.7, (5, n)), *rng.uniform(-3, 3, (2, 5, n - 1))
    start = rng.uniform(-3, 3, 5)
    whole = motion(Drives.from_angles(joint_angle, plane_twist=twist, yoke_angle=yoke, start_phase=start), ANY)
    for k in range(5):
        one = motion(
            Drives.from_angles(joint_angle[k], plane_twist=twist[k], yoke_angle=yoke[k], start_phase=start[k]), ANY
        )
        for name in ("shaft_angle", "shaft_ratio", "shaft_slope", "yoke_rotation", "cross_driving", "cross_driven"):
            assert np.allclose(getattr(whole, name)[k], getattr(one, name), rtol=0, atol=4e-15), name


def test_padding_with_straight_joints_changes_nothing():
    short = Drive.from_angles([0.3, 0.2], plane_twists=[0.4], yoke_angles=[-0.2], start_phase=0.7)
    long = Drive.from_angles([0.1, 0.2, 0.3, 0.25])
    both = motion(stack([short, long]), ANY)
    alone = motion(short, ANY)
    assert np.array_equal(both.shaft_angle[0, 3:], both.shaft_angle[0, [2, 2]])
    for one, other in (
        (both.shaft_angle[0, :3], alone.shaft_angle),
        (both.ratio[0], alone.ratio),
        (both.slope[0], alone.slope),
        (both.shaft_angle[1], motion(long, ANY).shaft_angle),
    ):
        assert np.allclose(one, other, rtol=0, atol=4e-15)


def test_leading_axes_are_free():
    joint_angle = np.full((2, 3, 4), 0.2)
    whole = motion(Drives.from_angles(joint_angle), ANY)
    assert whole.shaft_angle.shape == (2, 3, 5, 6)
    assert whole.ratio.shape == whole.slope.shape == whole.output_angle.shape == (2, 3, 6)
    assert whole.yoke_rotation.shape == whole.cross_driven_rate.shape == (2, 3, 4, 6)
    fast = motion(Drives.from_angles(joint_angle), ANY, speed=np.full((2, 3), 9.0))
    assert fast.shaft_speed.shape == (2, 3, 5, 6)


@pytest.mark.parametrize("joint_angles", [[0.0], [0.0, 0.3], [0.3, 0.0, 0.2], [0.0, 0.0]])
def test_straight_joints_turn_their_shafts_alike(joint_angles):
    n = len(joint_angles)
    moved = motion(Drive.from_angles(joint_angles, plane_twists=[0.5] * (n - 1), yoke_angles=[0.2] * (n - 1)), ANY)
    for i, joint_angle in enumerate(joint_angles):
        if joint_angle == 0.0:
            assert np.allclose(moved.shaft_angle[i + 1], moved.shaft_angle[i], rtol=0, atol=4e-15)


@pytest.mark.parametrize("joint_angle", [45.0, 80.0, 89.0, 89.9])
def test_a_joint_near_a_right_angle_against_forty_digits(joint_angle):
    phi = np.linspace(-3.0, 3.0, 121)
    moved = motion(Drive.from_angles([joint_angle * deg]), phi)
    with mpmath.workdps(40):
        alpha = mpmath.mpf(joint_angle * deg)
        want = []
        for x in map(mpmath.mpf, phi):
            s, c = mpmath.sin(x), mpmath.cos(x)
            want.append(x + mpmath.atan2((1 - mpmath.cos(alpha)) * s * c, mpmath.cos(alpha) * c * c + s * s))
        off = max(abs(mpmath.mpf(got) - w) for got, w in zip(moved.output_angle, want, strict=True))
    # The angle is worst where ratio is 1/cos α: an input rounding of 4e-16 rad counts that much.
    assert off < 1e-15 / np.cos(joint_angle * deg)


def test_a_thousand_joints_stay_finite():
    moved = motion(Drive.from_angles([10 * deg] * 1000, yoke_angles=[0.3] * 999), ANY)
    assert np.all(np.isfinite(moved.shaft_slope))
    assert np.all(moved.shaft_ratio > 0)


def test_the_strict_array_api_suffices():
    joint_angle, twist, yoke = [[0.3, 0.2], [0.1, 0.4]], [[0.5], [1.0]], [[0.1], [-0.4]]
    mine = [strict.asarray(x, dtype=strict.float64) for x in (joint_angle, twist, yoke)]
    one = motion(
        Drives.from_angles(mine[0], plane_twist=mine[1], yoke_angle=mine[2]),
        strict.asarray(ANY),
        speed=strict.asarray([10.0, 20.0], dtype=strict.float64),
    )
    two = motion(Drives.from_angles(joint_angle, plane_twist=twist, yoke_angle=yoke), ANY, speed=[10.0, 20.0])
    for name in (
        "shaft_angle",
        "shaft_speed",
        "shaft_acceleration",
        "yoke_rotation",
        "angle_error",
        "cross_driving",
        "cross_driven",
        "cross_driving_rate",
        "cross_driven_rate",
    ):
        assert type(getattr(one, name)).__module__.startswith("array_api_strict")
        assert np.allclose(np.asarray(getattr(one, name)), getattr(two, name), rtol=1e-14, atol=1e-13), name


def test_speeds_come_from_the_duty_or_are_asked_for():
    from dataclasses import replace

    drive = Drive.from_angles([0.3])
    with pytest.raises(InputError) as caught:
        _ = motion(drive).shaft_speed
    assert caught.value.field == "duty.speed"
    fast = replace(drive, duty=Duty(speed=100.0, acceleration=5.0))
    assert motion(fast, [0.0]).shaft_speed[0, 0] == 100.0
    assert motion(fast, [0.0]).shaft_acceleration[0, 0] == 5.0
    assert motion(fast, [0.0], speed=-3.0, acceleration=0.0).shaft_acceleration[0, 0] == 0.0


def test_one_turn_is_the_default_and_a_single_angle_a_list_of_one():
    drive = Drive.from_angles([0.3])
    assert motion(drive).angle.shape == (361,)
    assert motion(drive, 0.5).ratio.shape == (1,)
    with pytest.raises(InputError, match="2 axes"):
        motion(drive, [[0.1], [0.2]])
