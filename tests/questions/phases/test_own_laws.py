"""Yokes of drives with joints that turn by laws of their own: against the motion, brute force and the exact polygon."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, phases
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.joints import JOINTS
from cardan.drive.settings import Pose, Steering
from cardan.io.drive_file import loads
from cardan.questions.motion.motion import motion
from cardan.questions.motion.turning import each_shaft
from cardan.questions.phases.own_laws import Search, WobblingCourse, course_of
from cardan.register import QUESTIONS
from cardan.units import deg
from tests.questions.test_every_joint import drive_of

TURN = np.linspace(0.0, 2.0 * np.pi, 1441)


def with_yokes(drive, yokes):
    shafts = tuple(
        replace(one, yoke_angle=float(yokes[one.number - 2])) if 2 <= one.number <= len(drive.joints) else one
        for one in drive.shafts
    )
    return replace(drive, shafts=shafts)


def fluctuation(drive):
    return float(np.ptp(motion(drive, TURN).ratio))


def two(first=50, second=60):
    """Return a drive with two like pin couplings in a plane, the second one bent back."""
    pins = f'kind = "pin_coupling"\ndriving_distance_mm = {first}\ndriven_distance_mm = {second}\n'
    return loads(
        f"format = 1\n[[joints]]\njoint_angle_deg = 8\n{pins}[[joints]]\njoint_angle_deg = 8\n{pins}"
        "[[shafts]]\nnumber = 2\nyoke_angle_deg = 20\n"
    )


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pin_coupling", "clemens"])
@pytest.mark.parametrize("first", [True, False])
def test_what_a_setting_leaves_is_what_the_motion_leaves(kind, first):
    drive = replace(drive_of(kind, first), movements=())
    found = phases(drive)
    assert found.followed
    assert found.as_built.speed_fluctuation == pytest.approx(fluctuation(drive), rel=1e-6)
    best = found.settings[0]
    left = fluctuation(with_yokes(drive, best.yoke_angle))
    assert best.speed_fluctuation == pytest.approx(left, rel=1e-6)
    assert found.speed_fluctuation_min == best.speed_fluctuation
    tried = [fluctuation(with_yokes(drive, [angle])) for angle in np.arange(0.0, 2.0 * np.pi, 10 * deg)]
    assert min(tried) >= left - 1e-9
    assert max(tried) <= found.speed_fluctuation_max * (1.0 + 1e-6)
    off = [fluctuation(with_yokes(drive, best.yoke_angle + sign * deg)) for sign in (1.0, -1.0)]
    assert best.one_off[0] == pytest.approx(max(off) - left, abs=1e-7)  # of quarter degrees
    np.testing.assert_allclose(
        best.shaft_speed_fluctuation,
        np.ptp(motion(with_yokes(drive, best.yoke_angle), TURN).shaft_ratio[1:], axis=-1),
        rtol=1e-6,
    )


@pytest.mark.slow
def test_what_is_found_is_not_told_as_proved():
    drive = replace(drive_of("pin_coupling", True), movements=())
    told = QUESTIONS["phasing"].answer(drive, phases(drive))
    assert "the best yoke angles found leave" in str(told.sentence)
    assert any("without proof" in str(one.text) for one in told.remarks)


@pytest.mark.slow
def test_half_a_turn_of_a_yoke_counts():
    found = phases(two())
    best = found.settings[0].yoke_angle
    other = with_yokes(two(), best + np.pi)
    assert fluctuation(other) > 2.0 * found.speed_fluctuation_min
    assert -np.pi < best[0] <= np.pi


@pytest.mark.slow
@pytest.mark.parametrize("angles", [[20, 20], [20, 25, 10], [10, 12, 14, 9]])
def test_the_search_finds_what_the_polygon_proves(angles):
    drive = Drive.from_angles(np.radians(angles), plane_twists=[0.3] * (len(angles) - 1))
    proved = phases(drive)
    free = list(range(len(angles) - 1))
    found = Search([course_of(drive)], np.zeros(len(free)), free)
    least = found.best(lambda left: left[..., 0])
    assert found.left(least)[0] == pytest.approx(proved.speed_fluctuation_min, abs=1e-7)
    most = found.best(lambda left: -left[..., 0])
    assert found.left(most)[0] == pytest.approx(proved.speed_fluctuation_max, rel=1e-9)


@pytest.mark.slow
def test_held_yokes_stay_and_teeth_are_kept():
    drive = two()
    assert phases(drive, fixed={2: 0.5}).settings[0].yoke_angle == pytest.approx([0.5])
    splined = loads(
        'format = 1\n[[joints]]\njoint_angle_deg = 8\nkind = "pin_coupling"\ndriving_distance_mm = 50\n'
        "driven_distance_mm = 60\n[[joints]]\njoint_angle_deg = 9\n[[shafts]]\nnumber = 2\nspline.teeth = 8\n"
    )
    found = phases(splined)
    assert found.spline_steps == {2: 8}
    every = [fluctuation(with_yokes(splined, [2.0 * np.pi * k / 8])) for k in range(8)]
    assert found.spline_settings[0].speed_fluctuation == pytest.approx(min(every), rel=1e-6)


@pytest.mark.slow
def test_poses_are_suited():
    drive = replace(two(), poses=(Pose(name="steep", share=0.5, set=(("joints[1].joint_angle_deg", 14.0),)),))
    found = phases(drive)
    assert found.poses == ("steep",)
    worst, mean = found.pose_settings

    def left(one):
        return np.asarray([one.speed_fluctuation, one.pose_speed_fluctuation[0]])

    for one in (found.settings[0], mean):
        assert left(worst).max() <= left(one).max() + 1e-9
    for one in (found.settings[0], worst):
        assert left(mean).mean() <= left(one).mean() + 1e-9


def test_a_steering_column_needs_the_form():
    with pytest.raises(InputError, match="law of its own"):
        phases(replace(two(), steering=Steering(lock=8.0)))


def wobbling_drive(second):
    """Return a drive with a tripod whose shaft wobbles, before a cross or alone, with what it pivots about."""
    tripod = '[[joints]]\nkind = "tripod"\njoint_angle_deg = 20\ntrack_radius_mm = 20\n'
    return loads("format = 1\n" + tripod + second)


CROSS = "[[joints]]\njoint_angle_deg = 20\nplane_twist_deg = 30\n[[shafts]]\nnumber = 2\nlength_mm = 300\n"


def test_yokes_beside_a_wobble_leave_what_the_motion_leaves():
    drive = wobbling_drive(CROSS)
    found = phases(drive)
    assert found.followed
    assert found.as_built.shaft_speed_fluctuation == pytest.approx(each_shaft(drive).speed_fluctuation, rel=1e-9)
    settings = [found.settings[0].yoke_angle, np.asarray([1.0]), np.asarray([2.5])]
    for yokes in settings:
        moved = with_yokes(drive, yokes)
        here = WobblingCourse(drive).fluctuation(yokes)
        assert here == pytest.approx(each_shaft(moved).speed_fluctuation, rel=1e-9)
        assert WobblingCourse(drive).initial_phases(yokes) == pytest.approx(motion(moved, [0.0]).yoke_rotation[:, 0])
    tried = [fluctuation(with_yokes(drive, [angle])) for angle in np.arange(0.0, 2.0 * np.pi, 10 * deg)]
    assert found.speed_fluctuation_min <= min(tried) + 1e-9
    assert found.speed_fluctuation_max >= max(tried) * (1.0 - 1e-6)
    assert min(tried) < found.speed_fluctuation_max - 5e-4  # the yokes count


def test_a_last_tripod_that_pivots_leaves_by_its_yokes_what_the_motion_leaves():
    drive = wobbling_drive("pivot_mm = 300\n")
    question = QUESTIONS["phasing"]
    found = question.ask(drive)
    assert found.speed_fluctuation_min == pytest.approx(float(each_shaft(drive).speed_fluctuation[-1]), rel=1e-9)
    assert [one.name for one in question.answer(drive, found).keys] == ["speed_fluctuation"]


SHAFT = "[[shafts]]\nnumber = {}\nlength_mm = 300\n"


def test_of_settings_beside_a_wobble_that_leave_the_same_the_nearest_counts():
    """Behind a tripod a yoke by a sixth of a turn on leaves the same."""
    second = "[[joints]]\njoint_angle_deg = 15\nplane_twist_deg = 40\n"
    third = "[[joints]]\njoint_angle_deg = 12\nplane_twist_deg = 20\n"
    drive = wobbling_drive(second + third + SHAFT.format(2) + SHAFT.format(3))
    best = phases(drive).settings[0]
    assert abs(best.yoke_angle[0]) <= 30 * deg
    for turn in (60 * deg, -60 * deg):
        moved = WobblingCourse(drive).fluctuation(best.yoke_angle + np.asarray([turn, 0.0]))[-1]
        assert moved >= best.speed_fluctuation - 1e-9


def test_yokes_that_change_nothing_are_said_to_change_nothing():
    drive = wobbling_drive('[[joints]]\nkind = "rzeppa"\njoint_angle_deg = 15\n' + SHAFT.format(2))
    question = QUESTIONS["phasing"]
    said = question.answer(drive, question.ask(drive))
    assert "however the yokes stand" in told(said.sentence, USUAL)
    assert not any("free yokes reach" in told(one.text, USUAL) for one in said.remarks)
    held = phases(drive, fixed={2: 1.0})
    assert "however the yokes stand" not in told(question.answer(drive, held).sentence, USUAL)


def test_a_steering_column_has_no_wobbling_shaft():
    with pytest.raises(InputError, match=r"joints\[0\]\.kind: its driven shaft wobbles"):
        phases(replace(wobbling_drive(CROSS), steering=Steering(lock=8.0)))


@pytest.mark.slow
@pytest.mark.parametrize("kind", JOINTS)
@pytest.mark.parametrize("first", [True, False])
def test_yokes_behind_and_before_every_kind_are_phased(kind, first):
    drive = drive_of(kind, first)
    question = QUESTIONS["phasing"]
    told = question.answer(drive, question.ask(drive))
    assert told.keys


def test_a_joint_alone_has_no_yokes_to_turn():
    """One bent pin coupling: nothing is free, and what it leaves is told."""
    text = 'format = 1\n[[joints]]\nkind = "pin_coupling"\njoint_angle_deg = 8\n'
    drive = loads(text + "driving_distance_mm = 50\ndriven_distance_mm = 60\n")
    found = phases(drive)
    assert found.settings == ()
    assert found.free == ()
    assert found.as_built.speed_fluctuation == found.speed_fluctuation_min == found.speed_fluctuation_max
    assert found.as_built.speed_fluctuation == pytest.approx(fluctuation(drive), rel=1e-6)
