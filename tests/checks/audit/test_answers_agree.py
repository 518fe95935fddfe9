"""Answers that speak of the same quantity agree, of all examples and of drives at random; where not, it is told."""

import math
from dataclasses import replace

import pytest

from cardan import Drive, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check, design
from cardan.checks.audit import answers_agree, pairs
from cardan.checks.audit.answers_agree import CHECK, Compared, audit
from cardan.checks.audit.pairs import PAIRS
from cardan.checks.design import Design
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import fatigue, fatigue_life, lasting
from cardan.choices.check_answer import answer, checked
from cardan.drive.duty import Limits
from cardan.drive.joints import JOINTS
from cardan.drive.machine import Event
from cardan.drive.material import Material
from cardan.io.examples import example_names
from cardan.questions.motion.turning import each_shaft
from tests.audit.running import audited
from tests.house.test_kinds import drive_with

QUICK, WHOLE = 120, 12
"""Drives at random whose quick pairs are compared, and those of them all whose pairs are; `python -m tests.audit` asks
thousands."""


def named(pair):
    return f"{pair.quantity}: {pair.first}, {pair.second}"


def contradictions(found):
    return [(named(one.pair), one.part, one.values, one.deviation) for one in found if one.deviation > 1.0]


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_nothing_about_an_example_contradicts_itself(name):
    found = audit(design(example(name)))
    assert found
    assert contradictions(found) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", JOINTS)
def test_nothing_about_a_joint_of_any_kind_contradicts_itself(kind):
    found = audit(design(drive_with(kind)))
    assert found
    assert contradictions(found) == []


@pytest.mark.slow
def test_nothing_about_a_drive_at_random_contradicts_itself():
    for seed in range(QUICK):
        found = audited(seed, quick=seed >= WHOLE)
        assert contradictions(found or ()) == [], seed


def turning_about():
    """Return a drive whose torque reverses while its output swings to the side, near resonance, without backlash."""
    drive = example("pto-baler")
    shafts = list(drive.shafts)
    shafts[1] = replace(shafts[1], spline=replace(shafts[1].spline, backlash=0.0))
    swing = replace(drive.movements[0], moves=("output",), pivot=drive.joints[1].centre)
    return replace(drive, shafts=tuple(shafts), movements=(swing,))


def borne():
    """Return a drive whose centre bearing is one of the catalogue."""
    drive = example("pickup-two-piece")
    return replace(drive, supports=(replace(drive.supports[0], bore=None, bearing="6207-2RS"),))


def started():
    """Return a drive that runs up through its resonance, twelve thousand times."""
    drive = example("pto-flywheel")
    return replace(drive, duty=replace(drive.duty, starts=12000.0, life=1.8e7))


def run_up():
    """Return the same with an absorber and without play."""
    return replace(example("pto-flywheel-absorber"), duty=started().duty)


WIDE = (
    "car-propshaft",
    "propshaft-with-rzeppa",
    "steering-column",
    "pto-flywheel-absorber",
    "pto-spline-thrust",
    "composite-propshaft",
)
"""Examples that have, with one at random and those above, all pairs."""


@pytest.mark.slow
def test_every_pair_is_compared_somewhere():
    """A pair whose readings never meet would compare nothing."""
    drives = (*map(example, WIDE), turning_about(), borne(), started(), run_up())
    found = [one for drive in drives for one in audit(design(drive))]
    found += audited(6) or ()
    assert {named(one) for one in PAIRS} == {named(one.pair) for one in found}
    assert contradictions(found) == []


@pytest.mark.parametrize("pair", PAIRS, ids=named)
def test_a_pair_that_differs_by_more_than_it_may_is_seen(pair):
    size = 2.0 * max(pair.least, 1.0)
    for more, agrees in ((0.5, True), (3.0, False)):
        other = size * (1.0 - more * pair.tolerance)
        one = Compared(pair=pair, part="", values=(size, other))
        assert (one.deviation <= 1.0) == agrees
    assert Compared(pair=pair, part="", values=(float("inf"), float("inf"))).deviation == 0.0
    assert Compared(pair=pair, part="", values=(float("inf"), 1.0)).deviation > 1.0


@pytest.mark.slow
def test_strength_that_leaves_torsional_vibration_out_contradicts_the_response(monkeypatch):
    """A drive near its resonance: without what vibration adds, strength counts less than the response tells."""
    monkeypatch.setattr(Design, "_vibration", lambda _design, _case: None)
    found = contradictions(audit(design(example("pto-flywheel"))))
    assert found
    assert {name.partition(" of")[0] for name, *_rest in found} == {"largest torque"}


@pytest.mark.slow
def test_strength_that_leaves_the_torques_of_starts_out_contradicts_what_they_cost(monkeypatch):
    monkeypatch.setattr(pairs, "happening", lambda _design: [])
    found = contradictions(audit(design(started())))
    assert {name.partition(":")[0] for name, *_rest in found} == {"largest torque of every shaft in starts and events"}


@pytest.mark.slow
def test_a_shaft_that_lasts_but_for_its_load_steps_is_no_contradiction():
    """What it bears as it runs is without end; the steps of its load tire it beside that."""
    drive = example("pto-flywheel")
    shafts = list(drive.shafts)
    shafts[1] = replace(shafts[1], material=Material(grade="C45"))
    step = Event(kind="load_step", count=1e5, torque=1500.0, duration=0.01)
    drive = replace(drive, shafts=tuple(shafts), duty=replace(drive.duty, torque=100.0, life=1.8e7, events=(step,)))
    subject = design(drive)
    assert all(
        float(fatigue(subject, 1, one, case).safety) > 1.0 for one in sections(subject, 1) for case in lasting(subject)
    )
    assert math.isfinite(fatigue_life(subject, 1))
    assert contradictions(audit(subject)) == []


def test_a_contradiction_fails_the_drive_and_is_told_with_both_values(monkeypatch):
    wrong = replace(PAIRS[2], read=(PAIRS[2].read[0], lambda asked: {one: 0.5 for one in PAIRS[2].read[0](asked)}))
    monkeypatch.setattr(answers_agree, "PAIRS", (wrong,))
    drive = replace(Drive.from_angles([0.1, 0.5]), limits=Limits(joint_angle=1.0))
    result = checked(drive)
    said = answer(drive, result)
    assert said.tone == "failed"
    assert said.code == 1
    assert result.failed[0].check == "answers_agree"
    assert said.facts["answers_agree"] is False
    assert "answers_agree" in next(one for one in said.tables if one.name == "verdicts").columns[0].values
    (alarm,) = [told(one.text, USUAL) for one in said.remarks if "contradict" in told(one.text, USUAL)]
    share = 100.0 * float(each_shaft(drive).speed_fluctuation[-1])
    assert f"{share:.2f} % in motion, 50.00 % in speed_fluctuation" in alarm
    assert not any("no single parameter" in told(one.text, USUAL) for one in said.remarks)


def test_that_answers_agree_is_no_merit_of_the_drive():
    drive = replace(Drive.from_angles([0.1, 0.5]), limits=Limits(joint_angle=1.0))
    result = checked(drive)
    (one,) = [one for one in result.verdicts if one.check == "answers_agree"]
    assert one.state == "passed"
    assert one not in result.binding
    assert "comparisons" in one.note
    said = answer(drive, result)
    assert said.facts["answers_agree"] is True
    assert "answers_agree" not in next(one for one in said.tables if one.name == "verdicts").columns[0].values
    (remark,) = [one for one in said.remarks if one.code == "answers_agree"]
    assert told(remark.text, USUAL) == f"Answers that speak of the same quantity agree: {one.note}."


def test_all_are_told_side_by_side_where_they_are_asked_for():
    drive = example("pto-drive")
    result = checked(drive, whole=True)
    assert len(result.compared) > len(audit(design(drive), quick=True))
    (table,) = [one for one in answer(drive, result).tables if one.name == "compared"]
    assert len(table.columns[0].values) == len(result.compared)
    keys = {column.key: column for column in table.columns if column.key}
    assert set(keys) >= {
        "quantity",
        "part",
        "first",
        "first_value",
        "second",
        "second_value",
        "deviation",
        "tolerance",
        "why",
    }
    assert all(keys["why"].values)
    assert list(keys["deviation"].values) == sorted(keys["deviation"].values, reverse=True)


def test_many_drives_and_poses_are_not_compared_one_by_one():
    drive = Drive.from_angles([0.1, 0.2])
    assert check(drive, only=["answers_agree"], vary={"joints[0].joint_angle_deg": [1.0, 2.0]}) == ()
    posed = example("rolling-mill-upper-spindle")
    assert posed.poses
    assert len(check(posed, only=["answers_agree"])) == 1


def test_what_one_of_them_does_not_answer_is_not_compared():
    found = audit(design(Drive.from_angles([0.1])))
    assert {one.pair.second for one in found} <= {"motion", "joint_angle", "accuracy", "phasing"}
    assert CHECK.name == "answers_agree"
    assert all(callable(read) for one in pairs.PAIRS for read in one.read)
