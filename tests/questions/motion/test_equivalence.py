import array_api_strict as strict
import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from cardan import Drive, equivalent_joint, motion
from cardan.drive.models.kinematics_model import chain
from cardan.maths.kernel.frames import rotate
from cardan.questions.motion.equivalence import SYNCHRONOUS, angle_of_largest_acceleration, largest_acceleration
from cardan.questions.motion.extremes import extremes
from cardan.sweeps import Drives, stack
from cardan.units import deg
from tests.builders.drives import plans

TURN = np.arange(0, 360, 0.5) * deg


@given(plans(joint_angle=60 * deg))
def test_largest_times_smallest_ratio_is_one(plan):
    joint = equivalent_joint(plan.drive)
    assert joint.ratio_max * joint.ratio_min == pytest.approx(1.0, abs=1e-15)
    # The kernel's own minimum (|a| - |b|)², not computed as the inverse.
    a, b = joint.pair
    assert (abs(a) - abs(b)) ** 2 == pytest.approx(joint.ratio_min, rel=1e-9)


@given(plans())
def test_the_irregularity_is_the_spread_of_the_vector_ratio(plan):
    # The sampled truth has a parabola through its extremes: 1e-9 for joint angles to 40° (chains reach steeper ones).
    assert equivalent_joint(plan.drive).speed_fluctuation == pytest.approx(
        plan.vectors.speed_fluctuation(), rel=1e-5, abs=1e-9
    )


@given(plans())
def test_the_equivalent_joint_moves_like_the_drive(plan):
    joint = equivalent_joint(plan.drive)
    assume(joint.speed_fluctuation > 1e-9)
    single = motion(Drive.from_angles([float(joint.joint_angle)], start_phase=float(joint.phase)), TURN)
    whole = motion(plan.drive, TURN)
    # The phase of a nearly synchronous drive is ill-conditioned, but then it does not matter either.
    assert np.allclose(single.output_angle, whole.output_angle, rtol=0, atol=2e-13)
    assert np.allclose(single.ratio, whole.ratio, rtol=0, atol=2e-13)


@given(plans())
def test_extremes_of_lead_and_acceleration_are_reached_and_not_passed(plan):
    joint = equivalent_joint(plan.drive)
    turn = motion(plan.drive, TURN)
    angle_error = turn.angle_error[-1]
    assert np.max(np.abs(turn.slope)) <= joint.max_acceleration * (1 + 1e-12) + 1e-14
    # Half-degree samples miss the top of a steep chain by some tenths of a percent.
    assert np.max(np.abs(turn.slope)) >= joint.max_acceleration * 0.99 - 1e-14
    assert (angle_error.max() - angle_error.min()) / 2 == pytest.approx(joint.max_angle_error, rel=1e-3, abs=1e-14)


@pytest.mark.slow
@given(plans(), st.floats(-np.pi, np.pi))
def test_the_start_changes_nothing_but_the_phase(plan, later):
    other = Drive.from_angles(
        plan.joint_angles,
        plane_twists=plan.plane_twists,
        yoke_angles=plan.yoke_angles,
        start_phase=plan.start_phase + later,
    )
    one, two = equivalent_joint(plan.drive), equivalent_joint(other)
    assert np.allclose(one.shaft_speed_fluctuation, two.shaft_speed_fluctuation, rtol=0, atol=2e-14)
    if one.speed_fluctuation > 1e-6:
        off = (two.phase - one.phase - later + np.pi / 2) % np.pi - np.pi / 2
        assert off == pytest.approx(0.0, abs=1e-8)
        assert 0.0 <= one.phase < np.pi + 1e-12


@st.composite
def lines(draw):
    """Draw points of a drive that never doubles back."""
    n = draw(st.integers(1, 5))
    steps = [[draw(st.floats(0.5, 2.0)), draw(st.floats(-0.4, 0.4)), draw(st.floats(-0.4, 0.4))] for _ in range(n + 1)]
    return np.cumsum([[0.0, 0.0, 0.0], *steps], axis=0)


@given(lines(), st.floats(-3, 3), st.floats(-3, 3), st.data())
def test_a_drive_carried_elsewhere_turns_alike(points, turn, tilt, data):
    yokes = [data.draw(st.floats(-1.5, 1.5)) for _ in range(len(points) - 3)]
    x, y, _ = np.eye(3)
    moved = rotate(rotate(points, x, np.asarray(turn)), y, np.asarray(tilt)) + np.asarray((100.0, -7.0, 3.0))
    one, two = (Drive.from_points(place, yoke_angles=yokes, start_phase=0.4) for place in (points, moved))
    # 100 m away coordinates carry 1e-14, axes of half a metre 3e-14, and planes of small joint angles lose the most.
    assume(np.all(chain(one).joint_angle > 1e-3))
    assert np.allclose(
        equivalent_joint(one).shaft_speed_fluctuation, equivalent_joint(two).shaft_speed_fluctuation, atol=1e-12
    )
    assert np.allclose(motion(one, TURN).shaft_angle, motion(two, TURN).shaft_angle, rtol=0, atol=1e-10)


@given(plans())
def test_harmonics_are_those_of_the_motion(plan):
    joint = equivalent_joint(plan.drive)
    angle_error = motion(plan.drive, np.arange(1024) * (2 * np.pi / 1024)).angle_error[-1]
    spectrum = 2 * np.abs(np.fft.rfft(angle_error)) / 1024
    assume(joint.tau < 0.9)
    # Orders above 512 alias in with τ^256/256 of the joint.
    assert np.allclose(joint.harmonics(5), spectrum[2:12:2], rtol=0, atol=1e-14)


def test_a_synchronous_drive_has_no_phase():
    joint = equivalent_joint(Drive.from_angles([20 * deg, 20 * deg], plane_twists=[0.6], yoke_angles=[-0.6]))
    assert joint.speed_fluctuation < SYNCHRONOUS
    assert np.isnan(joint.phase)
    assert joint.vertex[-1] == pytest.approx(0.0, abs=1e-15)


def test_a_double_joint_follows_the_cosine_rule():
    """cos α_eq = cos 20°/cos 12° for parallel yokes, and the product for crossed ones."""
    for yoke, want in ((0.0, np.cos(20 * deg) / np.cos(12 * deg)), (90 * deg, np.cos(20 * deg) * np.cos(12 * deg))):
        joint = equivalent_joint(Drive.from_angles([12 * deg, 20 * deg], yoke_angles=[yoke]))
        assert np.cos(joint.joint_angle) == pytest.approx(want, abs=1e-15)


def test_a_batch_is_its_drives():
    rng = np.random.default_rng(5)
    joint_angle, twist, yoke = rng.uniform(0, 0.7, (7, 4)), *rng.uniform(-3, 3, (2, 7, 3))
    whole = equivalent_joint(Drives.from_angles(joint_angle, plane_twist=twist, yoke_angle=yoke))
    for k in range(7):
        one = equivalent_joint(Drive.from_angles(joint_angle[k], plane_twists=twist[k], yoke_angles=yoke[k]))
        for name in (
            "shaft_speed_fluctuation",
            "joint_angle",
            "phase",
            "ratio_max",
            "max_angle_error",
            "max_acceleration",
            "tau",
        ):
            # Fused complex products in vector loops: rounding, not the last bit.
            assert np.allclose(getattr(whole, name)[k], getattr(one, name), rtol=1e-13, atol=1e-14), name
        assert np.allclose(whole.harmonics(3)[k], one.harmonics(3), rtol=1e-13, atol=1e-15)


def test_padded_drives_keep_their_equivalent_joint():
    both = equivalent_joint(stack([Drive.from_angles([0.3]), Drive.from_angles([0.1, 0.2, 0.3])]))
    assert both.speed_fluctuation[0] == pytest.approx(
        float(equivalent_joint(Drive.from_angles([0.3])).speed_fluctuation), abs=1e-15
    )
    assert np.allclose(both.shaft_speed_fluctuation[0], both.shaft_speed_fluctuation[0, 0])


def test_the_strict_array_api_suffices():
    joint_angle = [[0.3, 0.2, 0.1], [0.1, 0.1, 0.0]]
    one = equivalent_joint(Drives.from_angles(strict.asarray(joint_angle, dtype=strict.float64)))
    two = equivalent_joint(Drives.from_angles(joint_angle))
    for name in (
        "speed_fluctuation",
        "ratio_max",
        "ratio_min",
        "joint_angle",
        "max_angle_error",
        "max_acceleration",
        "vertex",
        "phase",
    ):
        mine = getattr(one, name)
        assert type(mine).__module__.startswith("array_api_strict")
        assert np.allclose(np.asarray(mine), getattr(two, name), rtol=1e-13, atol=1e-14, equal_nan=True), name
    assert np.allclose(np.asarray(one.harmonics(4)), two.harmonics(4), rtol=1e-13)


@pytest.mark.parametrize("joint_angle", [89.0, 89.9, 89.99])
def test_near_a_right_angle_digits_are_lost_slowly(joint_angle):
    joint = equivalent_joint(Drive.from_angles([joint_angle * deg]))
    # 1/cos α is itself known to ε α tan α only: 6e3 roundings at 89.99°.
    assert joint.ratio_max == pytest.approx(
        1 / np.cos(joint_angle * deg), rel=4e-16 * np.tan(joint_angle * deg) + 1e-15
    )
    assert joint.joint_angle == pytest.approx(joint_angle * deg, abs=1e-12)


@pytest.mark.parametrize("short", [1e-2, 1e-5, 1e-8, 1e-12])
def test_the_largest_acceleration_keeps_its_digits_near_a_right_angle(short):
    joint_angle = 0.5 * np.pi - short
    with mp.workdps(60):
        c, s = mp.cos(mp.mpf(joint_angle)), mp.sin(mp.mpf(joint_angle))
        k = s * s / (2 - s * s)
        x = 4 * k / (1 + mp.sqrt(1 + 8 * k * k))
        largest = float(4 * c * s * s * mp.sqrt(1 - x * x) / ((2 - s * s) ** 2 * (1 - k * x) ** 2))
        angle = float(mp.acos(x) / 2)
    assert largest_acceleration(joint_angle) == pytest.approx(largest, rel=1e-14)
    assert angle_of_largest_acceleration(joint_angle) == pytest.approx(angle, rel=1e-14)
    assert extremes(Drive.from_angles([joint_angle])).max_acceleration == pytest.approx(largest, rel=1e-13)
