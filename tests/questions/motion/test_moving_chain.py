"""Exact spins against body frames that are moved by vector geometry alone and differentiated numerically."""

import numpy as np
import pytest

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.maths.curves import paths
from cardan.maths.kernel import frames
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.instants import acceleration_range, speed_range
from cardan.questions.motion.motion import motion
from cardan.questions.motion.moving_chain import harmonic_points, moving_axes, moving_centres, moving_shafts

CASE = {
    "points": [[-1, 0, 0], [0, 0, 0], [1.5, 0.1, -0.25], [2.0, 0.1, -0.25]],
    "amplitude": [[0, 0, 0], [0, 0, 0], [0.02, 0.0, 0.08], [0.02, 0.0, 0.09]],
}


def wild(seed, joints=3, fixed=2, size=0.15, frequency=11.0):
    """A path of points that all swing on their own, the first ``fixed`` ones at rest."""
    rng = np.random.default_rng(seed)
    points = np.column_stack((np.arange(joints + 2.0), 0.25 * rng.standard_normal((joints + 2, 2))))
    amplitude = size * rng.standard_normal((joints + 2, 3))
    amplitude[:fixed] = 0.0
    return harmonic_points(points, amplitude, frequency=frequency, phase=rng.uniform(0.0, 6.0, joints + 2))


def frames_of(path, times, gamma, theta_1):
    """Cross arms (t, n, 3) by the plain steps of vector geometry; theta_1 from N × a_1 of the start, a_1 at rest."""
    points = path(times)[0]
    a = np.diff(points, axis=1)
    a = a / np.linalg.norm(a, axis=-1, keepdims=True)
    begin = np.diff(path(np.zeros(1))[0][0], axis=0)
    normal = np.cross(begin[0], begin[1])
    normal = normal / np.linalg.norm(normal)
    zero = np.cross(normal, a[0, 0])
    u = np.cos(theta_1)[:, None] * zero + np.sin(theta_1)[:, None] * normal
    arms = [u]
    for i in range(a.shape[1] - 1):
        v = np.cross(a[:, i + 1], arms[-1])
        v = v / np.linalg.norm(v, axis=-1, keepdims=True)
        last = i + 2 == a.shape[1]
        turn = 0.0 if last else -gamma[i]
        arms.append(np.cos(turn) * v + np.sin(turn) * np.cross(a[:, i + 1], v))
    return a, np.stack(arms, axis=1)


def spin_by_differences(a, arms, step):
    """ω_i = (db/dt)·(a × b) of a direction b fixed to shaft i, five-point differences."""
    middle = slice(2, len(arms) - 2)
    return np.einsum("tij,tij->ti", slope(arms, step), np.cross(a[middle], arms[middle]))


def slope(values, step):
    """Five-point differences over the first axis, two values lost at both ends."""
    first, second, third, fourth = (values[k : len(values) - 4 + k] for k in (0, 1, 3, 4))
    return (first - 8.0 * second + 8.0 * third - fourth) / (12.0 * step)


@pytest.mark.parametrize("seed", range(4))
def test_spins_are_those_of_differentiated_body_frames(seed):
    path = wild(seed)
    step = 2e-5
    times = 0.2 + step * np.arange(401)
    gamma = np.random.default_rng(100 + seed).uniform(-1.5, 1.5, 2)
    found = moving_centres(path, times, yoke_angle=gamma, speed=90.0, acceleration=200.0, start_phase=0.4)
    a, arms = frames_of(path, times, gamma, 0.4 + 90.0 * times + 100.0 * times**2)
    spin = spin_by_differences(a, arms, step)
    # h⁴ φ⁽⁵⁾/30 with (2ω)⁴ = 1e9 gives 1e-8 relative, rounding 1e-16/h = 1e-11 absolute.
    np.testing.assert_allclose(found.spins.spin[2:-2], spin, rtol=1e-7)
    acceleration = slope(found.spins.spin, step)
    np.testing.assert_allclose(
        found.spins.spin_acceleration[2:-2], acceleration, atol=1e-6 * np.max(np.abs(acceleration))
    )


def test_reference_of_moving_centres():
    path = harmonic_points(CASE["points"], CASE["amplitude"], frequency=9.0, phase=[0.0, 0.0, 0.3, 0.3])
    found = moving_centres(path, 0.123, yoke_angle=[0.0], speed=150.0)
    # From differentiated body frames with 40 digits.
    np.testing.assert_allclose(found.spins.spin[0], [150.0, 150.65373967508188, 149.63313164368842], rtol=1e-12)
    expected = [0.0, 324.3777876286763, -55.353284944006745]
    np.testing.assert_allclose(found.spins.spin_acceleration[0], expected, atol=1e-7)
    np.testing.assert_allclose(found.shafts.length_acceleration[0, 1], -0.8618856111595669, rtol=1e-10)
    np.testing.assert_allclose(np.rad2deg(found.shafts.joint_angle[0]), [7.428759454737048, 8.423913824964], rtol=1e-10)


def test_resting_points_give_the_frozen_motion():
    points = np.asarray([[-1, 0, 0], [0, 0, 0], [1.5, 0.3, -0.25], [2.0, 0.1, -0.25], [3.0, 0.0, 0.2]])
    gamma = [0.3, -0.8]
    times = np.linspace(0.0, 0.1, 51)
    path = harmonic_points(points, 0.0 * points, frequency=1.0)
    found = moving_centres(path, times, yoke_angle=gamma, speed=100.0, acceleration=50.0, start_phase=0.2)
    drive = Drive.from_points(points.tolist(), yoke_angles=gamma, start_phase=0.2)
    plain = motion(drive, 100.0 * times + 25.0 * times**2)
    np.testing.assert_allclose(found.spins.frozen_ratio, plain.shaft_ratio.T, rtol=1e-13)
    speed = 100.0 + 50.0 * times
    expected = 50.0 * plain.shaft_ratio + speed**2 * plain.shaft_slope
    np.testing.assert_allclose(found.spins.spin_acceleration, expected.T, atol=1e-9)


def test_cross_arms_stay_at_right_angles():
    found = moving_centres(wild(5), np.linspace(0.0, 1.0, 30), yoke_angle=[0.1, 0.2], speed=30.0)
    u, v, a = found.spins.driving_arm, found.spins.driven_arm, found.shafts.axis
    for one, two in ((u, v), (u, a[:, :-1]), (v, a[:, 1:])):
        np.testing.assert_allclose(np.einsum("tij,tij->ti", one, two), 0.0, atol=1e-14)


def test_straight_joints_pass_the_spin_on():
    points = [[-1.0, 0, 0], [0.0, 0, 0], [1.0, 0, 0], [2.0, 0, 0]]
    amplitude = [[0.0] * 3, [0.0] * 3, [0.0, 0.0, 0.2], [0.0, 0.0, 0.4]]
    found = moving_centres(harmonic_points(points, amplitude, frequency=8.0), [0.0], yoke_angle=[0.4], speed=70.0)
    np.testing.assert_allclose(found.spins.spin, 70.0, rtol=1e-14)
    assert np.all(np.isfinite(found.spins.spin_acceleration))


@pytest.mark.parametrize("seed", range(3))
def test_lengths_and_axes_have_their_derivatives(seed):
    path = wild(seed, fixed=0)
    step = 1e-4
    times = step * np.arange(1001)
    shafts = moving_shafts(path(times))
    for value, rate in (
        (shafts.length, shafts.length_rate),
        (shafts.length_rate, shafts.length_acceleration),
        (shafts.axis, shafts.axis_rate),
        (shafts.axis_rate, shafts.axis_acceleration),
    ):
        # h²/6 of the third derivative: 1e-8/6 · 11³ · a few units.
        np.testing.assert_allclose(np.gradient(value, step, axis=0)[1:-1], rate[1:-1], atol=1e-4)


def test_moving_input_axis_carries_the_yoke_without_twisting():
    """The spin of the first shaft is the one asked for, though its axis runs round a cone."""
    path = wild(2, fixed=0, size=0.2)
    step = 2e-5
    times = 0.3 + step * np.arange(201)
    found = moving_centres(path, times, yoke_angle=[0.3, 0.1], speed=40.0)
    u = found.spins.driving_arm[:, :1]
    np.testing.assert_allclose(spin_by_differences(found.shafts.axis[:, :1], u, step), 40.0, rtol=1e-8)
    following = spin_by_differences(found.shafts.axis[:, 1:], np.concatenate((found.spins.driven_arm,), axis=1), step)
    np.testing.assert_allclose(found.spins.spin[2:-2, 1:], following, rtol=1e-7)


@pytest.mark.parametrize("seed", range(4))
def test_spin_range_holds_every_yoke_position(seed):
    path = wild(seed, fixed=0, frequency=25.0)
    shafts = moving_shafts(path(np.asarray([0.2])))
    axes = tuple(part[0] for part in (shafts.axis, shafts.axis_rate, shafts.axis_acceleration))
    gamma = [0.7, -0.4]
    low, high = speed_range(axes, yoke_angle=gamma, speed=30.0)
    theta = np.linspace(0.0, np.pi, 40_001)
    arms = frames.rotate(frames.perpendicular(axes[0][0]), axes[0][0], theta)
    each = moving_axes(tuple(part[None] for part in axes), arms, yoke_angle=gamma, speed=30.0, acceleration=70.0)
    # The grid misses an extreme by (8e-5 rad)² of the swing at most.
    np.testing.assert_allclose(low, each.spin.min(axis=0), rtol=2e-7)
    np.testing.assert_allclose(high, each.spin.max(axis=0), rtol=2e-7)
    low, high = acceleration_range(axes, yoke_angle=gamma, speed=30.0, acceleration=70.0)
    gain = each.spin_acceleration
    np.testing.assert_allclose(low, gain.min(axis=0), atol=2e-7 * np.ptp(gain), rtol=1e-12)
    np.testing.assert_allclose(high, gain.max(axis=0), atol=2e-7 * np.ptp(gain), rtol=1e-12)


def test_spin_range_at_rest_is_the_equivalent_joint():
    drive = Drive.from_angles([0.3, 0.5, 0.2], plane_twists=[0.4, -1.0], yoke_angles=[0.1, 0.9])
    axis = geometry(drive).axis
    low, high = speed_range((axis, 0.0 * axis, 0.0 * axis), yoke_angle=[0.1, 0.9], speed=1.0)
    np.testing.assert_allclose((high - low)[1:], equivalent_joint(drive).shaft_speed_fluctuation, rtol=1e-13)
    low, high = acceleration_range((axis, 0.0 * axis, 0.0 * axis), yoke_angle=[0.1, 0.9], speed=1.0)
    largest = equivalent_joint(drive).max_acceleration
    assert (-low[-1], high[-1]) == pytest.approx((largest, largest), rel=1e-12)


def test_rigid_motion_of_the_whole_drive_adds_the_turn_about_each_axis():
    """A drive turning as one body with Ω about an axis: every spin relative to the body is as at rest."""
    points = np.asarray([[-1, 0, 0], [0, 0, 0], [1.5, 0.3, -0.25], [2.0, 0.1, -0.25]])
    rate = np.asarray([2.0, -3.0, 4.0])
    size = np.linalg.norm(rate)
    pole = rate / size

    def path(times):
        still = np.broadcast_to(points, (times.size, *points.shape))
        angle = (size * times, size + 0.0 * times, 0.0 * times)
        return paths.turned(paths.turning(pole, angle), paths.resting(still))

    shafts = moving_shafts(path(np.asarray([0.0])))
    axes = (shafts.axis[0], shafts.axis_rate[0], shafts.axis_acceleration[0])
    normal = frames.unit(np.cross(axes[0][0], axes[0][1]))
    arm = frames.rotate(np.cross(normal, axes[0][0]), axes[0][0], np.asarray(0.3))
    carried = 50.0 + axes[0] @ rate
    turning = moving_axes(axes, arm, yoke_angle=[0.2], speed=carried[0]).spin - axes[0] @ rate
    resting = moving_axes((axes[0], 0.0 * axes[0], 0.0 * axes[0]), arm, yoke_angle=[0.2], speed=50.0).spin
    np.testing.assert_allclose(turning, resting, rtol=1e-13)


def test_any_array_library_gives_the_same():
    strict = pytest.importorskip("array_api_strict")
    points = wild(1)(np.linspace(0.0, 0.3, 4))
    shafts = moving_shafts(points)
    strange = moving_shafts(tuple(strict.asarray(part) for part in points))
    np.testing.assert_allclose(np.asarray(strange.length_acceleration), shafts.length_acceleration, rtol=1e-14)
    axes = (shafts.axis, shafts.axis_rate, shafts.axis_acceleration)
    other = tuple(strict.asarray(part) for part in axes)
    ours = speed_range(axes, yoke_angle=[0.3, -0.2], speed=30.0)
    theirs = speed_range(other, yoke_angle=strict.asarray([0.3, -0.2]), speed=30.0)
    np.testing.assert_allclose(np.asarray(theirs[1]), ours[1], rtol=1e-14)
