import dataclasses
from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty, Limits
from cardan.drive.movement import Arm, Body, Harmonic, Hitch, Parallel, Random, Spectrum, Table
from cardan.drive.shaft import Shaft, Spline
from cardan.errors import InputError, JointAngleLimitError
from cardan.io.drive_file import loads
from cardan.joints import Tripod
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.instants import Position
from cardan.questions.motion.moving_points import moving_path
from cardan.questions.motion.turning import each_shaft
from cardan.units import deg

REAR = ("joints[1]", "output")


def words(found):
    return [told(one, USUAL) for one in found.warnings]


WOBBLING = {
    "offset cross": """kind = "offset_cross"
offset_mm = 20
reach_mm = 200""",
    "tripod": """kind = "tripod"
track_radius_mm = 20""",
}


@pytest.mark.slow
@pytest.mark.parametrize("joint", WOBBLING)
def test_shafts_that_wobble_do_so_at_every_instant(joint):
    drive = loads(f"""format = 1
input.point_mm = [-300, 0, 0]
output.point_mm = [700, 100, -300]
[[joints]]
{WOBBLING[joint]}
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [380, 20, -150]
[[shafts]]
number = 2
yoke_angle_deg = -60
[[movements]]
kind = "harmonic"
moves = ["joints[1]", "output"]
amplitude_mm = [0, 60, 50]
frequency_Hz = 1
""")
    found = articulation(drive, times=[0.0, 0.1, 0.3, 0.6])
    blind = replace(drive.joints[0], **({"offset": 0.0} if joint == "offset cross" else {"track_radius": None}))
    exact = articulation(replace(drive, joints=(blind, drive.joints[1])), times=found.times)
    for k, (first, *centres, last) in enumerate(found.points):
        joints = tuple(replace(one, centre=tuple(at)) for one, at in zip(drive.joints, centres, strict=True))
        ends = replace(drive.input, point=tuple(first)), replace(drive.output, point=tuple(last))
        still = replace(drive, joints=joints, input=ends[0], output=ends[1], movements=())
        assert found.speed_fluctuation[k] == pytest.approx(each_shaft(still).speed_fluctuation[-1], rel=1e-6)
        assert abs(found.speed_fluctuation[k] - exact.speed_fluctuation[k]) > 1e-4, "it wobbles"


def hitched(before, behind):
    return Drive.from_points([[-1.0, 0, 0], [-before, 0, 0], [behind, 0, 0], [1.5, 0, 0]])


@pytest.mark.parametrize(
    ("before", "behind", "yaw", "pitch", "expected"),
    [
        (0.4, 0.4, 30.0, 0.0, (15.0, 15.0, 0.7727406610312547, 0.0)),
        (0.4, 0.6, 30.0, 0.0, (18.067537291975043, 11.932462708024957, 0.9673118389725883, 0.05744926130285623)),
        (0.5, 0.5, 40.0, 12.0, (20.73491482383281, 20.73491482383281, 0.935228457140899, 0.0)),
    ],
)
def test_a_hitched_drive_agrees_with_vector_geometry(before, behind, yaw, pitch, expected):
    move = Hitch(moves=REAR, pivot=(0, 0, 0), yaw=yaw * deg, pitch=pitch * deg, frequency=1.0)
    found = articulation(hitched(before, behind), move, [0.5 * np.pi])
    # Expected values are double-precision vector geometry.
    assert np.rad2deg(found.joint_angle[0]) == pytest.approx(expected[:2], abs=1e-9)
    assert found.length[0, 1] == pytest.approx(expected[2], abs=1e-12)
    assert found.speed_fluctuation[0] == pytest.approx(expected[3], abs=1e-12)


@pytest.mark.parametrize(("before", "behind"), [(0.4, 0.4), (0.4, 0.41), (0.3, 0.5)])
def test_a_hitched_drive_follows_the_closed_form_and_is_even_only_when_the_pin_is_half_way(before, behind):
    move = Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.9, pitch=0.4, pitch_phase=0.8, frequency=1.0)
    time = np.linspace(0.0, 2.0 * np.pi, 25)
    found = articulation(hitched(before, behind), move, time)
    # Book Figs 56, 57: cos Δ = cos yaw cos pitch, tan α_1 = l_2 sin Δ/(l_1 + l_2 cos Δ) and so round.
    cosine = np.cos(0.9 * np.sin(time)) * np.cos(0.4 * np.sin(time + 0.8))
    sine = np.sqrt(1.0 - cosine**2)
    joint_angle = np.arctan2([behind * sine, before * sine], [before + behind * cosine, behind + before * cosine])
    np.testing.assert_allclose(
        found.joint_angle, joint_angle.T, atol=1e-8
    )  # the root of 1 - cos² loses half of the digits near 0
    length = np.sqrt(before**2 + behind**2 + 2.0 * before * behind * cosine)
    np.testing.assert_allclose(found.length[:, 1], length, rtol=1e-12)
    uneven = 2.0 * np.sinh(np.abs(np.log(np.cos(joint_angle[0]) / np.cos(joint_angle[1]))))
    np.testing.assert_allclose(found.speed_fluctuation, uneven, atol=1e-12)
    assert (found.speed_fluctuation.max() < 1e-13) == (before == behind)


def test_hitch_half_way_stays_synchronous_moving_too_at_every_yaw_and_pitch():
    move = Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.7, pitch=0.3, pitch_phase=1.1, frequency=40.0)
    drive = hitched(0.4, 0.4)
    found = articulation(drive, move, speed=20.0)
    assert found.speed_fluctuation.max() < 1e-14
    assert found.moving_speed_fluctuation.max() < 1e-12
    # A drive that is even at all times carries frames over by the shortest arc from input to output axis; where the
    # plane of the shafts turns, that frame itself spins about the output axis: an even offset of the speed.
    step = 1e-6
    before, behind = (articulation(drive, move, found.times + shift).points for shift in (-step, step))
    way = (found.points[:, 3] - found.points[:, 2]) / 1.1
    rate = ((behind - before)[:, 3] - (behind - before)[:, 2]) / (2.0 * step * 1.1)
    offset = np.cross(rate, way)[:, 0] / (1.0 + way[:, 0])
    assert np.max(np.abs(offset)) > 1.0
    # Differences of positions: rounding 1e-16/1e-6, and h² times the third derivative, 1e-12/6 · 40³.
    np.testing.assert_allclose(found.shaft_speed[:, -1] - 20.0, offset, atol=1e-7)
    plane = articulation(drive, dataclasses.replace(move, pitch=0.0), speed=20.0)
    np.testing.assert_allclose(plane.shaft_speed[:, -1], 20.0, rtol=1e-12)


def test_a_drive_on_an_arm_agrees_with_vector_geometry():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.4, 0, -0.15], [2.4, 0, -0.18]])
    move = Arm(moves=REAR, pivot=(0.2, 0, -0.1), axis=(0, 1, 0), amplitude=4 * deg, frequency=3.0)
    found = articulation(drive, move, [np.pi / 6.0])
    # Expected values are double-precision vector geometry.
    np.testing.assert_allclose(found.points[0, 2], [1.3935890366245827, 0.0, -0.23358597100594156], atol=1e-14)
    along = (found.points[0, 3] - found.points[0, 2]) / np.linalg.norm(found.points[0, 3] - found.points[0, 2])
    np.testing.assert_allclose(along, [0.9950236960851011, 0.0, -0.09963856798019671], atol=1e-14)
    assert np.rad2deg(found.joint_angle[0]) == pytest.approx([9.515162824503472, 3.796804822848015], abs=1e-10)
    assert found.length[0, 1] == pytest.approx(1.4130296560408848, abs=1e-13)
    assert found.speed_fluctuation[0] == pytest.approx(0.023313291424677363, abs=1e-12)


def test_parallel_guidance_stays_synchronous_standing_and_moving():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0, -0.1]])
    move = Parallel(moves=REAR, pivot=(0.8, 0.5, -0.1), axis=(1, 0.2, 0), amplitude=0.4, frequency=30.0)
    found = articulation(drive, move, speed=200.0)
    np.testing.assert_allclose(found.joint_angle[:, 0], found.joint_angle[:, 1], atol=1e-13)
    assert found.speed_fluctuation.max() < 1e-13
    # tan α = offset/axial distance
    way = found.points[:, 2] - found.points[:, 1]
    np.testing.assert_allclose(np.tan(found.joint_angle[:, 0]), np.hypot(way[:, 1], way[:, 2]) / way[:, 0], rtol=1e-12)
    # Parallel end axes that do not turn: the drive transmits exactly, whatever the plane of the joint angles does.
    np.testing.assert_allclose(found.shaft_speed[:, -1], 200.0, rtol=1e-12)
    assert found.moving_speed_fluctuation.max() < 1e-12


def test_worst_instants_lie_between_the_instants():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0, -0.1]])
    move = Harmonic(moves=("joints[1]",), amplitude=(0.0, 0.0, 0.2), frequency=1.0, phase=0.1234)
    found = articulation(drive, move, speed=100.0)
    peak = {(one.what, one.number): one for one in found.worst}
    time = 1.5 * np.pi - 0.1234
    exact = articulation(drive, move, [time])
    joint_angle = peak["joint_angle", 1]
    # Found to 1e-7 of the span in time; the value is flat there.
    assert joint_angle.time == pytest.approx(time, abs=1e-5)
    assert joint_angle.value == pytest.approx(exact.joint_angle[0, 0], abs=1e-12)
    assert joint_angle.value == pytest.approx(np.arctan(0.3), abs=1e-12)
    assert peak["speed_fluctuation", 3].value >= found.speed_fluctuation.max()
    assert peak["speed_error", 3].value >= found.speed_error.max()
    assert peak["length_max", 2].value == pytest.approx(np.hypot(1.0, 0.3), abs=1e-9)


def test_sampled_speeds_stay_in_their_range():
    drive = Drive.from_points([[-1, 0, 0], [0, 0.1, 0], [1.0, 0, -0.1], [2.0, 0.2, -0.1]], yoke_angles=[0.4])
    move = Body(
        moves=("input", "joints[0]", "output"),
        pivot=(0, 0, 0),
        roll=0.2,
        pitch=0.1,
        yaw=0.2,
        yaw_phase=1.0,
        frequency=9.0,
    )
    found = articulation(drive, move, speed=170.0)
    assert np.all(found.shaft_speed <= found.speed_high + 1e-9)
    assert np.all(found.shaft_speed >= found.speed_low - 1e-9)
    assert np.all(found.shaft_acceleration <= found.acceleration_high + 1e-6)
    assert np.all(found.shaft_acceleration >= found.acceleration_low - 1e-6)
    np.testing.assert_allclose(found.speed_low[:, 0], 170.0)
    # Over 361 unrelated yoke positions the sampled speeds come near both ends.
    assert np.max((found.shaft_speed - found.speed_low)[:, -1] / (found.speed_high - found.speed_low)[:, -1]) > 0.99


def test_a_long_span_tells_the_same_as_a_short_one_and_sparse_instants_are_warned_of():
    move = Harmonic(moves=REAR, amplitude=(0.02, 0.0, 0.05), frequency=2.0 * np.pi * 1.6)
    drive = Drive.from_points([[-0.3, 0, 0], [0, 0, 0], [1.2, 0, -0.1], [1.8, 0, -0.1]])
    short = articulation(drive, move)
    long = articulation(drive, move, until=600.0)  # 960 swings
    assert words(short) == words(long)
    # Between instants a sixth of a period apart the quintic errs by (2π/12)⁶/720, 3e-5 of the swing.
    assert long.splines[0].stroke == pytest.approx(short.splines[0].stroke, rel=1e-4)
    sparse = articulation(drive, move, np.linspace(0.0, 600.0, 401))
    assert any("1.5 s apart" in text and "0.625 s" in text for text in words(sparse))


@pytest.mark.parametrize(("times", "until"), [(None, 0.0), (None, np.nan), ([0.0, 1.0], 1.0)])
def test_refuses_a_span_that_is_none(times, until):
    move = Harmonic(moves=REAR, amplitude=(0.0, 0.0, 0.05), frequency=10.0)
    with pytest.raises(InputError) as caught:
        articulation(hitched(0.4, 0.4), move, times, until=until)
    assert caught.value.field == "until"


def test_slow_movement_approaches_the_frozen_irregularity():
    drive = Drive.from_points([[-1, 0, 0], [0, 0.1, 0], [1.0, 0, -0.1], [2.0, 0.2, -0.1]])
    move = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=1e-4)
    found = articulation(drive, move, speed=300.0)
    # The rates are 1e-6 of the speed.
    np.testing.assert_allclose(found.moving_speed_fluctuation, found.speed_fluctuation, rtol=1e-5)


def test_slip_path_and_stroke_of_the_telescoping_shaft():
    drive = dataclasses.replace(
        Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0, -0.1]]),
        shafts=(Shaft(number=2, spline=Spline(engaged=0.05, gap=0.02)),),
        limits=Limits(spline_overlap=0.04),
    )
    move = Harmonic(moves=REAR, amplitude=(0.0, 0.0, 0.2), frequency=1.0)
    found = articulation(drive, move)
    (one,) = found.splines
    times = np.linspace(0.0, 2.0 * np.pi, 200_001)
    length = np.hypot(1.0, -0.1 + 0.2 * np.sin(times))
    assert one.shaft == 2
    assert one.slip_path == pytest.approx(np.sum(np.abs(np.diff(length))), abs=1e-8)
    assert one.stroke == pytest.approx(np.ptp(length), abs=1e-9)
    assert one.engaged_min == pytest.approx(0.05 - (np.hypot(1.0, 0.3) - np.hypot(1.0, 0.1)), abs=1e-9)
    assert [flag.field for flag in one.flags] == ["shafts[1].spline.engaged"]
    assert one.flags[0].message in found.warnings


def test_shaft_that_slides_without_a_spline_is_told():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0, -0.1]])
    found = articulation(drive, Harmonic(moves=REAR, amplitude=(0.01, 0.0, 0.0), frequency=1.0))
    assert any("shaft 2 changes its length by" in text and "no spline" in text for text in words(found))
    plunging = replace(drive, joints=(Tripod(centre=drive.joints[0].centre), drive.joints[1]))
    slip_yoke = replace(drive, shafts=(Shaft(number=1, spline=Spline()),))
    for taken_up in (plunging, slip_yoke):
        found = articulation(taken_up, Harmonic(moves=REAR, amplitude=(0.01, 0.0, 0.0), frequency=1.0))
        assert found.splines[0].stroke > 0.0
        assert not any("no spline" in text for text in words(found))


def test_shaft_of_constant_length_is_no_telescope():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0, -0.1]])
    swing = Arm(moves=REAR, pivot=(0, 0, 0), axis=(0, 1, 0), amplitude=0.2, frequency=1.0)
    found = articulation(drive, swing)
    assert found.splines == ()
    assert found.warnings == ()


def test_steep_and_impossible_instants_carry_a_status():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, 0]])
    move = Hitch(moves=("output",), pivot=(0, 0, 0), yaw=100 * deg, frequency=1.0)
    found = articulation(drive, move, speed=10.0)
    joint_angle = np.abs(100.0 * np.sin(found.times))
    np.testing.assert_array_equal(found.status == Position.IMPOSSIBLE, joint_angle >= 90.0)
    np.testing.assert_array_equal(found.status == Position.STEEP, (joint_angle > 45.0) & (joint_angle < 90.0))
    good = found.status < Position.IMPOSSIBLE
    for table in (found.joint_angle, found.speed_fluctuation, found.shaft_speed, found.speed_high):
        assert np.all(np.isfinite(table[good]))
        assert np.all(np.isnan(table[~good]))
    assert any("90°" in text for text in words(found))
    assert any("45°" in text for text in words(found))
    assert max(one.value for one in found.worst if one.what == "joint_angle") < 0.5 * np.pi
    assert found.envelope["joint_angle"][1][0] < 0.5 * np.pi


def test_centres_that_meet_are_impossible_instants():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, 0], [2.0, 0, 0]])
    meeting = Harmonic(moves=REAR, amplitude=(-1.0, 0.0, 0.0), frequency=1.0)
    found = articulation(drive, meeting, [0.0, 0.5 * np.pi, np.pi], speed=10.0)
    assert list(found.status) == [Position.FINE, Position.IMPOSSIBLE, Position.FINE]
    assert np.isfinite(found.splines[0].max_rate)


def test_without_a_speed_there_are_no_speeds():
    drive = hitched(0.4, 0.6)
    found = articulation(drive, Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.5, frequency=1.0))
    assert found.speed is None
    assert found.shaft_speed is None
    assert found.speed_low is None
    assert np.all(np.isnan(found.moving_speed_fluctuation))
    assert {one.what for one in found.worst} == {"joint_angle", "speed_fluctuation", "length_min", "length_max"}


def test_a_movement_without_a_possible_instant_is_refused():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, 0]])
    with pytest.raises(JointAngleLimitError, match="every instant"):
        articulation(drive, Harmonic(moves=("output",), amplitude=(-3.0, 0.0, 0.0), frequency=1.0), [1.0, 2.0])


def test_the_file_says_movement_and_speed():
    move = Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.5, frequency=2.0)
    drive = dataclasses.replace(hitched(0.4, 0.6), movements=(move,), duty=Duty(speed=60.0, acceleration=3.0))
    found = articulation(drive)
    assert found.times[-1] == pytest.approx(np.pi)
    np.testing.assert_allclose(found.shaft_speed[:, 0], 60.0 + 3.0 * found.times)
    with pytest.raises(InputError, match="movements"):
        articulation(hitched(0.4, 0.6))


def test_a_function_of_time_can_move_the_drive():
    drive = hitched(0.4, 0.6)
    move = Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.5, frequency=2.0)
    times = np.linspace(0.0, 1.0, 11)
    points = [[-1.0, 0, 0], [-0.4, 0, 0], [0.6, 0, 0], [1.5, 0, 0]]
    by_function = articulation(drive, moving_path(points, [move]), times, speed=9.0)
    by_movement = articulation(drive, move, times, speed=9.0)
    np.testing.assert_array_equal(by_function.shaft_speed, by_movement.shaft_speed)
    with pytest.raises(InputError, match="times"):
        articulation(drive, moving_path(points, [move]))
    with pytest.raises(InputError, match="shape"):
        articulation(drive, moving_path(points[:3], []), times)


@pytest.mark.parametrize("times", [[], [0.0, 0.0], [1.0, 0.5], [0.0, np.nan]])
def test_refuses_instants_that_do_not_rise(times):
    with pytest.raises(InputError, match="times"):
        articulation(hitched(0.4, 0.6), Hitch(moves=REAR, pivot=(0, 0, 0), yaw=0.5, frequency=2.0), times)


def test_table_reproduces_the_exact_speeds_of_the_motion_it_was_made_from():
    drive = Drive.from_points([[-1, 0, 0], [0, 0.1, 0], [1.0, 0, -0.1], [2.0, 0.2, -0.1]])
    swing = Harmonic(moves=REAR, amplitude=(0.0, 0.02, 0.05), frequency=6.0)
    rows = np.linspace(0.0, 2.0, 801)
    way = np.sin(6.0 * rows)
    table = Table(moves=REAR, file="t.csv", times=tuple(rows), shifts=tuple((0.0, 0.02 * s, 0.05 * s) for s in way))
    times = np.linspace(0.2, 1.8, 99)
    exact, found = (articulation(drive, move, times, speed=100.0) for move in (swing, table))
    # The spline errs by about 1e-7 of the velocity and 5e-5 of the acceleration of the points.
    np.testing.assert_allclose(found.shaft_speed, exact.shaft_speed, atol=1e-6)
    np.testing.assert_allclose(found.shaft_acceleration, exact.shaft_acceleration, atol=2e-3)


def test_tables_that_begin_later_start_the_drive_there():
    rows = np.linspace(5.0, 6.0, 21)
    table = Table(moves=REAR, file="t.csv", times=tuple(rows), shifts=tuple((0.0, 0.0, 0.1 * (t - 5.0)) for t in rows))
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.1], [2.0, 0.2, -0.1]])
    found = articulation(drive, table, speed=10.0)
    assert found.times[0] == 5.0
    np.testing.assert_allclose(found.shaft_speed[:, 0], 10.0)


def test_assumed_lengths_are_told():
    drive = Drive.from_angles([0.2, 0.2])
    found = articulation(drive, Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=1.0))
    assert found.assumed
    assert any("assumed" in text for text in words(found))


def test_plane_twist_of_parallel_planes_does_not_flicker():
    drive = Drive.from_points([[-1, 0, 0], [0, 0, 0], [1.0, 0, -0.3], [2.0, 0, -0.3]])
    found = articulation(drive, Harmonic(moves=REAR, amplitude=(0.1, 1e-17, 0.1), frequency=1.0))
    assert np.max(np.abs(np.diff(found.plane_twist[:, 0]))) < 1e-6


FLAT = Spectrum(frequency=(1.0, 2.0), density=(1.0, 1.0))
ROUGH = Random(moves=REAR, axis=(0.0, 0.0, 1.0), deviation=0.01, spectrum=FLAT, duration=1.0)


@pytest.mark.parametrize(
    ("movement", "field"),
    [
        (dataclasses.replace(ROUGH, moves=("joints[9]",)), "movements[0].moves"),
        (dataclasses.replace(ROUGH, axis=(0.0, 0.0, 0.0)), "movements[0].axis"),
        (dataclasses.replace(ROUGH, spectrum=Spectrum(frequency=(1.0,), density=(1.0,))), "movements[0].spectrum"),
        (Harmonic(moves=REAR, amplitude=(0.0, 0.0, 0.1), frequency=0.0), "movements[0].frequency"),
        (Table(moves=REAR, file="road.csv"), "movements"),
    ],
)
def test_a_movement_given_beside_the_drive_is_checked_as_one_of_its_own(movement, field):
    with pytest.raises(InputError) as caught:
        articulation(hitched(0.4, 0.4), movement)
    assert caught.value.field.startswith(field)
