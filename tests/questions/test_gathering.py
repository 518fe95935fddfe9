"""Questions asked condition by condition: the one that governs is named, and none is mixed with another."""

from dataclasses import replace
from math import cos, radians

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import Reader
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Case, Duty
from cardan.drive.pose import Pose
from cardan.questions.gathering import gather, principal, ways
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


def test_the_page_of_a_report_tells_the_conditions_too():
    turned = Pose(name="turned", share=0.25, set=(("joints[1].joint_angle_deg", 35.0),))
    page = answered("motion", subject(drive(poses=(turned,))))
    assert any(getattr(block, "title", "") == "In each condition" for block in page.blocks)
