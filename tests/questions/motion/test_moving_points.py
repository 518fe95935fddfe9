import dataclasses
from dataclasses import replace

import numpy as np
import pytest

from cardan.checks import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.movement import MOVEMENTS, Arm, Body, Harmonic, Hitch, Movement, Parallel, Random, Spectrum, Table
from cardan.drive.shaft import Segment
from cardan.errors import InputError
from cardan.questions.motion.moving_points import CARRY, common_period, default_times, moving_points, shortest_period
from cardan.questions.motion.standing import still

POINTS = np.asarray([[-1.0, 0.1, 0.0], [0.0, 0.0, 0.1], [1.2, 0.1, -0.2], [2.0, 0.2, -0.3]])
ALL = ("input", "joints[0]", "joints[1]", "output")
REAR = ("joints[1]", "output")
ROWS = np.linspace(0.0, 3.0, 61)

KINDS = [
    Hitch(moves=REAR, pivot=(0.6, 0.1, 0.0), yaw=0.5, pitch=0.2, pitch_phase=0.7, frequency=5.0, phase=0.2),
    Arm(moves=REAR, pivot=(0.2, 0.0, -0.1), axis=(0.1, 2.0, 0.3), amplitude=0.3, frequency=5.0, phase=0.2),
    Parallel(moves=REAR, pivot=(0.8, 0.0, -0.1), axis=(0.0, 1.0, 0.0), amplitude=0.3, frequency=5.0),
    Harmonic(moves=REAR, amplitude=(0.01, 0.02, 0.1), frequency=5.0, phase=1.0),
    Body(
        moves=ALL[1:],
        pivot=(0.6, 0.0, 0.0),
        amplitude=(0.01, 0.0, 0.05),
        roll=0.2,
        pitch=0.1,
        yaw=0.3,
        roll_phase=0.3,
        pitch_phase=1.0,
        yaw_phase=2.0,
        frequency=5.0,
    ),
    Table(
        moves=REAR,
        file="sway.csv",
        times=tuple(ROWS),
        shifts=tuple((0.0, 0.1 * float(np.sin(2.0 * t)), 0.02 * float(t)) for t in ROWS),
    ),
    Random(
        moves=REAR,
        axis=(0.0, 0.0, 2.0),
        deviation=0.02,
        spectrum=Spectrum(frequency=(2.0, 10.0, 20.0), density=(0.0, 1.0, 0.0)),
        seed=4,
        duration=20.0,
    ),
]


def test_every_kind_of_movement_is_carried_and_tested_here():
    assert set(CARRY) == set(MOVEMENTS) == {movement.kind for movement in KINDS}


@pytest.mark.parametrize("movement", KINDS, ids=lambda movement: movement.kind)
def test_velocities_and_accelerations_are_the_derivatives(movement: Movement):
    step = 1e-4
    times = 1.0 + step * np.arange(1001)
    position, velocity, acceleration = moving_points(POINTS, [movement], times)
    # h²/6 times the third derivative, up to some 50 m/s³ (spline: its third derivative jumps, h/2 of it).
    np.testing.assert_allclose(np.gradient(position, step, axis=0)[1:-1], velocity[1:-1], atol=1e-5)
    np.testing.assert_allclose(np.gradient(velocity, step, axis=0)[1:-1], acceleration[1:-1], atol=2e-4)
    named = ["input", "joints[0]", "joints[1]", "output"]
    still = [k for k, name in enumerate(named) if name not in movement.moves]
    np.testing.assert_array_equal(position[:, still], np.broadcast_to(POINTS[still], position[:, still].shape))
    assert np.all(np.ptp(position[:, [k for k in range(4) if k not in still]], axis=0).max(axis=-1) > 1e-4)


@pytest.mark.parametrize("movement", [KINDS[0], KINDS[1], KINDS[4]], ids=lambda movement: movement.kind)
def test_turning_movements_keep_distances(movement):
    moved = moving_points(POINTS, [movement], np.linspace(0.0, 2.0, 41))[0][:, -2:]
    distance = np.linalg.norm(moved[:, 1] - moved[:, 0], axis=-1)
    np.testing.assert_allclose(distance, np.linalg.norm(POINTS[3] - POINTS[2]), rtol=1e-14)


def test_arm_keeps_the_distance_to_its_axis_and_starts_at_rest():
    arm = dataclasses.replace(KINDS[1], phase=0.0)
    moved = moving_points(POINTS, [arm], np.linspace(0.0, 2.0, 41))[0]
    np.testing.assert_allclose(moved[0], POINTS, atol=1e-15)
    axis = np.asarray(arm.axis) / np.linalg.norm(arm.axis)
    arms = moved[:, 2] - np.asarray(arm.pivot)
    np.testing.assert_allclose(arms @ axis, arms[0] @ axis, atol=1e-14)


def test_signs_of_yaw_pitch_and_roll():
    quarter = [0.5 * np.pi]

    def at_the_peak(point, **turns):
        body = Body(moves=("output",), pivot=(0.0, 0.0, 0.0), frequency=1.0, **turns)
        return moving_points([[0, 0, 0], [1, 0, 0], point], [body], quarter)[0][0, 2]

    half = 0.5 * np.pi
    np.testing.assert_allclose(at_the_peak([2, 0, 0], yaw=half), [0, 2, 0], atol=1e-15)
    np.testing.assert_allclose(at_the_peak([2, 0, 0], pitch=half), [0, 0, -2], atol=1e-15)
    np.testing.assert_allclose(at_the_peak([0, 2, 0], roll=half), [0, 0, 2], atol=1e-15)
    np.testing.assert_allclose(at_the_peak([2, 0, 0], yaw=half, pitch=half), [0, 0, -2], atol=1e-15)
    np.testing.assert_allclose(at_the_peak([0, 2, 0], yaw=half, roll=half), [0, 0, 2], atol=1e-15)


def test_parallel_guidance_shifts_without_turning():
    moved = moving_points(POINTS, [KINDS[2]], np.linspace(0.0, 2.0, 41))[0]
    np.testing.assert_allclose(moved[:, 3] - moved[:, 2], np.broadcast_to(POINTS[3] - POINTS[2], (41, 3)), atol=1e-15)
    arm = np.linalg.norm(moved[:, 2] - np.asarray(KINDS[2].pivot), axis=-1)
    np.testing.assert_allclose(arm, arm[0], rtol=1e-14)


def test_movements_follow_one_another():
    shift = Harmonic(moves=("output",), amplitude=(0.0, 0.5, 0.0), frequency=1.0)
    turn = Arm(moves=("output",), pivot=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0), amplitude=0.5 * np.pi, frequency=1.0)
    points = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
    first = moving_points(points, [shift, turn], [0.5 * np.pi])[0][0, 2]
    last = moving_points(points, [turn, shift], [0.5 * np.pi])[0][0, 2]
    np.testing.assert_allclose(first, [-0.5, 2.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(last, [0.0, 2.5, 0.0], atol=1e-15)


def test_table_of_an_analytic_motion_gives_that_motion():
    analytic = Harmonic(moves=REAR, amplitude=(0.0, 0.03, 0.05), frequency=6.0, phase=0.3)
    rows = np.linspace(0.0, 2.0, 401)
    swing = np.sin(6.0 * rows + 0.3)
    table = Table(
        moves=REAR, file="swing.csv", times=tuple(rows), shifts=tuple((0.0, 0.03 * s, 0.05 * s) for s in swing)
    )
    times = np.linspace(0.2, 1.8, 777)
    for order, tolerance in enumerate((1e-9, 2e-7, 2e-4)):
        # Cubic spline with h = 5 ms: errors h⁴/384 x⁗ = 1e-10, h³/24 = 4e-7·…, h²/8 x⁗ = 2e-4.
        exact = moving_points(POINTS, [analytic], times)[order]
        found = moving_points(POINTS, [table], times)[order]
        np.testing.assert_allclose(found, exact, atol=tolerance)


def test_random_path_has_the_deviation_asked_for():
    movement = dataclasses.replace(KINDS[6], duration=400.0)
    path = moving_points(POINTS, [movement], np.linspace(0.0, 400.0, 8001))[0][:, 3] - POINTS[3]
    # Some 400·18/π independent values: 1.5 % scatter.
    assert np.std(path[:, 2]) == pytest.approx(0.02, rel=0.05)
    np.testing.assert_array_equal(path[:, :2], 0.0)


def test_refuses_instants_outside_a_table_and_tables_not_read():
    with pytest.raises(InputError, match=r"3.5 s lies outside"):
        moving_points(POINTS, [KINDS[5]], [0.0, 3.5])
    with pytest.raises(InputError, match="has not been read"):
        moving_points(POINTS, [Table(moves=REAR, file="sway.csv")], [0.0])


@pytest.mark.parametrize(
    ("movement", "field"),
    [
        (Table(moves=REAR, file="a.csv", times=(0.0, 0.0), shifts=((0, 0, 0), (0, 0, 1))), "movements[0].file"),
        (Table(moves=REAR, file="a.csv", times=(0.0,), shifts=((0, 0, 0),)), "movements[0].file"),
        (Table(moves=REAR, file="a.csv", times=(0.0, 1.0), shifts=((0, 0, 0),)), "movements[0].shifts"),
        (dataclasses.replace(KINDS[6], axis=(0.0, 0.0, 0.0)), "movements[0].axis"),
        (
            dataclasses.replace(KINDS[6], spectrum=Spectrum(frequency=(2.0, 1.0), density=(0.0, 1.0))),
            "movements[0].spectrum.frequency",
        ),
        (
            dataclasses.replace(KINDS[6], spectrum=Spectrum(frequency=(1.0, 2.0), density=(0.0, 0.0))),
            "movements[0].spectrum.density",
        ),
        (dataclasses.replace(KINDS[6], spectrum=Spectrum(frequency=(1.0,), density=(1.0,))), "movements[0].spectrum"),
    ],
)
def test_a_drive_refuses_movements_that_contradict_themselves(movement, field):
    drive = Drive.from_points(POINTS.tolist())
    with pytest.raises(InputError) as caught:
        dataclasses.replace(drive, movements=(movement,))
    assert caught.value.field.startswith(field)


def test_common_period():
    assert common_period([0.5]) == 0.5
    assert common_period([1.0, 1.5, 0.4]) == pytest.approx(6.0, rel=1e-14)
    assert common_period([1.0, np.sqrt(2.0)]) == pytest.approx(20.0 * np.sqrt(2.0))


def test_default_times_cover_what_moves():
    swing, table, random = KINDS[3], KINDS[5], KINDS[6]
    assert default_times([swing])[-1] == pytest.approx(2.0 * np.pi / 5.0)
    assert default_times([swing, random])[-1] == 20.0
    assert default_times([swing, table, random])[-1] == 3.0
    assert np.diff(default_times([swing, table]))[0] <= 2.0 * np.pi / 5.0 / 119.0


def test_a_long_time_is_followed_as_finely_as_a_short_one_or_refused():
    swing = KINDS[3]
    period = 2.0 * np.pi / swing.frequency
    assert shortest_period([swing, KINDS[5]]) == pytest.approx(period)
    times = default_times([swing], 10_000.0 * period)
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(10_000.0 * period)
    assert np.diff(times)[0] <= period / 6.0
    with pytest.raises(InputError, match="look at a shorter time"):
        default_times([swing], 100_000.0 * period)


def test_the_stretches_of_a_shaft_that_slides_are_drawn_to_fit_where_it_stands():
    steps = (Segment(length=0.3, outer=0.05), Segment(length=0.7, outer=0.08, inner=0.07))
    bare = Drive.from_points([(-0.2, 0, 0), (0, 0, 0), (1, 0, 0), (1.3, 0, 0)])
    slide = Harmonic(moves=("joints[1]", "output"), amplitude=(0.04, 0.0, 0.0), frequency=2.0 * np.pi)
    shafts = (bare.shafts[0], replace(bare.shafts[1], segments=steps), bare.shafts[2])
    drive = replace(bare, shafts=shafts, movements=(slide,), duty=Duty(speed=100.0, torque=200.0))
    here = still(drive, 0.25)
    assert [one.length for one in here.shafts[1].segments] == pytest.approx([0.3 * 1.04, 0.7 * 1.04], rel=1e-12)
    assert here.shafts[1].segments[1].inner == 0.07
    assert check(drive)
