"""What is told of a drive that moves: motion, articulation, checks and first page name one instant and one value.

The truth beside them is the plain vector model of the drive at very many instants of its own.
"""

from dataclasses import replace

import numpy as np
import pytest

from cardan import example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.book.evidence import swing_by_vectors
from cardan.checks import check
from cardan.checks.key_figures import key_figures
from cardan.drive.conditions import in_poses
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty, Limits
from cardan.drive.joint_parts import Rating
from cardan.drive.movement import Arm, Body, Harmonic, Hitch
from cardan.questions.gathering import gather
from cardan.questions.motion.moving_points import default_times, moving_points
from cardan.questions.motion.standing import still
from cardan.register import QUESTIONS
from cardan.report import summary
from cardan.report.answers import subject
from cardan.units import deg, rpm

POINTS = [(-0.2, 0, 0), (0, 0, 0), (0.8, 0.02, -0.11), (1.3, 0.05, -0.16)]


def made(*movements: object, yokes: float = 0.4, points: object = POINTS) -> Drive:
    bare = Drive.from_points(points, yoke_angles=[yokes] * (len(points) - 3))
    return replace(bare, movements=movements, duty=Duty(speed=600 * rpm))


HITCH = Hitch(
    moves=("joints[1]", "output"), pivot=(0.5, 0, -0.3), yaw=0.5, pitch=0.2, pitch_phase=1.1, frequency=0.7, phase=0.3
)
BODY = Body(
    moves=("joints[1]", "output"), pivot=(1.0, 0, 0), amplitude=(0, 0, 0.05), pitch=0.1, pitch_phase=0.7, frequency=5.0
)
ARM = Arm(moves=("joints[1]", "output"), pivot=(0.1, 0.3, 0.0), axis=(0, 1, 0), amplitude=0.2, frequency=2.0)
TWO = (
    Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.12), frequency=4.0),
    Harmonic(moves=("joints[1]",), amplitude=(0.0, 0.05, 0.0), frequency=6.0, phase=0.9),
)
LONG = [*POINTS[:3], (1.5, 0.15, -0.1), (1.9, 0.2, -0.1)]

DRIVES = {
    "pto-hitch": example("pto-hitch"),
    "truck-rear-axle": example("truck-rear-axle"),
    "hitch": made(HITCH),
    "body": made(BODY, yokes=1.2),
    "arm": made(ARM),
    "two swings": made(*TWO),
    "three joints": made(replace(BODY, moves=("joints[1]", "joints[2]")), points=LONG),
}


def gathered(name, drive):
    question = QUESTIONS[name]
    answer = gather(question, drive, question.answer(drive, question.ask(drive)))
    return {key.name: key for key in answer.keys}


def vectors(drive, count):
    """Return δ of the output and joint angles at many instants, by plain vectors and single drives."""
    every = default_times(drive.movements)
    times = np.linspace(every[0], every[-1], count)
    points = moving_points(np.asarray(_points(drive)), drive.movements, times)[0]
    along = np.diff(points, axis=1)
    axis = along / np.linalg.norm(along, axis=-1, keepdims=True)
    joint_angle = np.arccos(np.clip(np.sum(axis[:, 1:] * axis[:, :-1], axis=-1), -1.0, 1.0))
    return times, joint_angle


def _points(drive):
    return [drive.input.point, *(joint.centre for joint in drive.joints), drive.output.point]


@pytest.mark.slow
@pytest.mark.parametrize("name", DRIVES)
def test_motion_articulation_checks_and_first_page_tell_the_same(name):
    drive = DRIVES[name]
    limits = replace(drive.limits, speed_fluctuation=0.5, joint_angle=60 * deg, output_error=1.0)
    drive = replace(drive, limits=limits)
    motion, moving = gathered("motion", drive), gathered("articulation", drive)
    share = motion["speed_fluctuation"].value.value
    # The same quantity by other ways: each is found to the square of the place of a flat top.
    assert moving["speed_fluctuation_moving"].value.value == pytest.approx(share, rel=1e-8)
    verdicts = check(drive, only=["speed_fluctuation", "joint_angle", "output_error"])
    by_check = {one.check: one for one in verdicts if one.check != "joint_angle"}
    assert float(by_check["speed_fluctuation"].value) == pytest.approx(share, rel=1e-8)
    assert float(by_check["output_error"].value) == pytest.approx(motion["angle_error"].value.value, rel=1e-8)
    joint_angle = motion["joint_angle"].value.value
    assert max(float(one.value) for one in verdicts if one.check == "joint_angle") == pytest.approx(joint_angle)
    (first,) = [one for one in key_figures(drive, verdicts) if one.name == "joint_angle"]
    assert first.value.value == pytest.approx(joint_angle, rel=1e-8)
    page = told(summary.uniformity(subject(drive)).text, USUAL)
    place = told(motion["speed_fluctuation"].place, USUAL)
    assert "movement" in place
    value = motion["speed_fluctuation"].value
    assert f"reaches {told(replace(value, digits=3), USUAL)} ({place})." in page
    when = place.split("at ")[-1].removesuffix(" of the movement")
    assert when in told(by_check["speed_fluctuation"].note, USUAL)


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in DRIVES if not DRIVES[name].poses])
def test_the_governing_instant_is_the_worst_of_very_many(name):
    """The joint angle by vectors at 20,001 instants, the speed fluctuation by one drive of vectors at 200 of them."""
    drive = DRIVES[name]
    motion = gathered("motion", drive)
    times, joint_angle = vectors(drive, 20_001)
    most = max(float(np.max(joint_angle)), max(float(a) for a in joint_angle[0]))
    # A step of 1/20,000 of the span misses the top of two swings by (6π/20,000)²/8 of what it rises.
    assert motion["joint_angle"].value.value == pytest.approx(most, rel=1e-6)
    yokes = [shaft.yoke_angle for shaft in drive.shafts[1:-1]]
    seen = [swing_by_vectors(still(drive, time), yokes) for time in times[:: 20_000 // 200]]
    share = motion["speed_fluctuation"].value.value
    assert max(seen) <= share * (1.0 + 1e-6)
    assert max(seen) == pytest.approx(share, rel=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["hitch", "body", "two swings"])
def test_loads_are_judged_where_each_of_them_is_worst(name):
    """One check at a time at 400 instants of its own: no instant is worse than the one that is told."""
    bare = DRIVES[name]
    shafts = tuple(replace(one, outer=0.05) if one.number == 2 else one for one in bare.shafts)
    joints = tuple(replace(one, rating=Rating(max_torque=900.0)) for one in bare.joints)
    drive = replace(bare, shafts=shafts, joints=joints, duty=replace(bare.duty, torque=400.0), limits=Limits(twist=0.1))
    only = ["joint_torque", "twist", "tube_strength", "gap_closure"]
    found = [one for one in check(drive, only=only) if one.run]
    assert found
    every = default_times(drive.movements)
    at = [check(still(drive, time), only=only) for time in np.linspace(every[0], every[-1], 401)]
    for one in found:
        rows = [next(its for its in verdicts if (its.check, its.title) == (one.check, one.title)) for verdicts in at]
        used = [float(its.utilisation) for its in rows]
        # Instants a fortieth of a step from the top: (2π/120/40)²/2 below it.
        assert max(used) <= float(one.utilisation) * (1.0 + 1e-6), one.title
        assert max(used) == pytest.approx(float(one.utilisation), rel=1e-3), one.title


def test_every_pose_moves_and_its_worst_instant_counts():
    drive = DRIVES["truck-rear-axle"]
    most = max(
        gathered("motion", replace(one.drive, movements=drive.movements))["speed_fluctuation"].value.value
        for one in in_poses(drive)
    )
    assert gathered("motion", drive)["speed_fluctuation"].value.value == pytest.approx(most, rel=1e-12)
