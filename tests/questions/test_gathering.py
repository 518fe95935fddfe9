"""Questions asked condition by condition: the one that governs is named, and none is mixed with another."""

from dataclasses import replace
from math import cos, radians

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import Reader
from cardan.drive.accuracy import Tolerance
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty
from cardan.drive.movement import Harmonic, Hitch
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft
from cardan.questions.gathering import gather, principal, ways
from cardan.questions.motion.standing import still
from cardan.register import QUESTIONS
from cardan.report.answers import answered, subject
from cardan.units import deg

READER = Reader()


def drive(**fields):
    plain = Drive.from_angles([20 * deg, 20 * deg])
    crossed = tuple(replace(one, cross=Cross(span=0.08)) for one in plain.joints)
    return replace(plain, joints=crossed, **fields)


def asked(name, one):
    question = QUESTIONS[name]
    at = principal(question, one)
    return gather(question, one, question.answer(at, question.ask(at)))


def test_the_load_of_a_peak_is_never_told_as_that_of_the_mean():
    peak = Case(name="clutch let go", torque=1000.0)
    found = asked("forces", drive(duty=Duty(torque=200.0, cases=(peak,))))
    (load,) = [key for key in found.keys if key.name == "journal_load"]
    # The cross carries T/cos θ at most: M/(d cos α) in a yoke.
    assert load.value.value == pytest.approx(1000.0 / 0.08 / _cosine(20.0), rel=1e-3)
    assert told(load.place, READER).endswith("clutch let go")
    rows = data(found, READER)["conditions"]
    assert [row["condition"] for row in rows] == ["the torque of the duty", "clutch let go"]
    assert rows[1]["journal_load_N"] == pytest.approx(5.0 * rows[0]["journal_load_N"])


def _cosine(angle):
    return cos(radians(angle))


def test_the_pose_that_governs_is_named_and_all_stand_side_by_side():
    turned = Pose(name="turned", share=0.25, set=(("joints[1].joint_angle_deg", 35.0),))
    found = asked("motion", drive(poses=(turned,)))
    (share,) = [key for key in found.keys if key.name == "speed_fluctuation"]
    assert told(share.place, READER) == "pose turned"
    rows = data(found, READER)["conditions"]
    assert [(row["condition"], row["share_percent"]) for row in rows] == [("as drawn", 75.0), ("pose turned", 25.0)]
    assert share.value.value == pytest.approx(rows[1]["speed_fluctuation_percent"] / 100.0)


def test_what_is_alike_everywhere_is_said_once():
    same = Pose(name="same", share=0.5, set=(("joints[0].joint_angle_deg", 20.0),))
    found = asked("motion", drive(poses=(same,)))
    assert [one.code for one in found.remarks if one.code] == ["same"]
    assert "conditions" not in data(found, READER)


def test_a_question_without_conditions_is_not_asked_twice():
    plain = drive(duty=Duty(torque=200.0))
    answer = QUESTIONS["forces"].answer(plain, QUESTIONS["forces"].ask(plain))
    assert gather(QUESTIONS["forces"], plain, answer) is answer
    assert len(ways(QUESTIONS["forces"], plain)) == 1


def test_load_cases_alone_answer_what_needs_a_torque():
    cases = (Case(name="a", torque=100.0, share=0.5), Case(name="b", torque=300.0, share=0.5))
    found = asked("forces", drive(duty=Duty(cases=cases)))
    assert [row["condition"] for row in data(found, READER)["conditions"]] == ["a", "b"]


def test_the_load_case_that_stands_for_the_duty_is_named_also_where_it_is_the_only_one():
    one = drive(duty=Duty(cases=(Case(name="shunting", torque=90.0),)))
    said = [told(remark.text, READER) for remark in asked("forces", one).remarks]
    assert "Where nothing else is said, figures are of this condition: shunting." in said
    several = drive(duty=Duty(cases=(Case(name="road", torque=50.0), Case(name="shunting", torque=90.0))))
    found = asked("forces", several)
    said = [told(remark.text, READER) for remark in found.remarks]
    assert "Where nothing else is said, figures are of this condition: shunting." in said
    assert found.tables[-1].note == ""


def test_a_part_of_the_duty_cycle_bends_the_joints_as_it_says():
    flat = drive(duty=Duty(blocks=(Block(torque=90.0, speed=100.0, share=1.0, joint_angle=5 * deg),)))
    at = principal(QUESTIONS["forces"], flat)
    assert [joint.joint_angle for joint in at.joints] == pytest.approx([5 * deg, 5 * deg])


def test_the_page_of_a_report_tells_the_conditions_too():
    turned = Pose(name="turned", share=0.25, set=(("joints[1].joint_angle_deg", 35.0),))
    page = answered("motion", subject(drive(poses=(turned,))))
    assert any(getattr(block, "title", "") == "In each condition" for block in page.blocks)


def test_a_condition_that_lacks_what_the_question_needs_is_named():
    """Orders over a range of speeds: the load case holds one speed, and the range is that of the duty itself."""
    bare = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.2)])
    shafts = tuple(Shaft(number=k, inertia=0.1, stiffness=5e4) for k in (1, 2))
    hill = Case(name="hill", torque=500.0, speed=80.0)
    duty = Duty(speed=100.0, speed_range=(90.0, 110.0), torque=200.0, cases=(hill,))
    found = asked("orders", replace(bare, shafts=shafts, duty=duty))
    (left,) = [told(one.text, READER) for one in found.remarks if one.code == "left_out"]
    assert left == "Left out for want of duty.speed_range_rpm: hill."
    assert "conditions" not in data(found, READER)


@pytest.mark.slow
def test_what_has_no_course_is_followed_from_some_instants_to_its_worst():
    """Asked at instants of its own, no key figure is worse than the one that is told."""
    swing = {"yaw": 0.5, "pitch": 0.2, "pitch_phase": 1.1, "frequency": 2.0}
    hitch = Hitch(moves=("joints[1]", "output"), pivot=(0.4, 0, -0.3), **swing)
    bare = Drive.from_points([(-0.2, 0, 0), (0, 0, 0), (0.8, 0.02, -0.11), (1.3, 0.05, -0.16)], yoke_angles=[0.4])
    loose = tuple(replace(one, tolerance=Tolerance(alpha1=0.001, s1=0.1e-3)) for one in bare.joints)
    moving = replace(bare, joints=loose, movements=(hitch,), duty=Duty(speed=100.0, torque=200.0))
    found, question = asked("accuracy", moving), QUESTIONS["accuracy"]
    told_worst = {key.name: float(key.value.value) for key in found.keys if key.better == "less"}
    assert told_worst
    for time in np.linspace(0.0, np.pi, 40):
        here = still(moving, time)
        for key in question.answer(here, question.ask(here)).keys:
            if key.better == "less":
                assert float(key.value.value) <= told_worst[key.name] * (1.0 + 1e-4), (key.name, time)


def test_what_takes_long_says_at_which_instants_it_was_asked():
    swing = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=2.0)
    bare = Drive.from_points([(-1, 0, 0), (0, 0, 0), (1, 0, -0.2)])
    shafts = tuple(Shaft(number=k, inertia=0.1, stiffness=5e4) for k in (1, 2))
    moving = replace(bare, shafts=shafts, movements=(swing,), duty=Duty(speed=100.0, torque=200.0))
    assert [one.code for one in asked("torsion", moving).remarks if one.code == "outermost"] == ["outermost"]
    assert not [one.code for one in asked("motion", moving).remarks if one.code == "outermost"]
