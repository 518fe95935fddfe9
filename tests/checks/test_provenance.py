"""What verdicts rest on: figures of the catalogue that nothing confirms, and limits of another application."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from cardan import check, example
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.catalogue import catalogue, completed
from cardan.catalogue.rows import UNSURE, Grade, JointSize
from cardan.checks.strength.answer import answer as strength_answer
from cardan.checks.strength.answer import ask as strength_ask
from cardan.checks.verdict_table import tone_of, word_of
from cardan.choices.check_answer import answer, checked
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joint_parts import Rating
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft
from cardan.questions.life.answer import answer as life_answer
from cardan.questions.life.answer import ask as life_ask
from cardan.report.subject import asked
from cardan.report.verdict_list import lights
from cardan.units import deg, rpm

SIZED = Drive(
    joints=(Hooke(joint_angle=5 * deg, size="example-75"), Hooke(joint_angle=5 * deg, size="example-75")),
    shafts=(Shaft(number=2, length=0.8, outer=0.06, wall=0.003, material=Material(grade="45"), yoke_angle=0.0),),
    duty=Duty(torque=200.0, speed=1000 * rpm, life=3.6e6),
)


def verdict(drive, name, number=1):
    return next(one for one in check(drive, only=[name]) if one.number in (0, number))


def test_what_the_catalogue_invents_makes_no_verdict_green():
    assert catalogue().rows(JointSize)["example-75"].confidence == "made_up"
    for name in ("joint_torque", "rated_torque", "max_speed", "joint_angle", "journal_strength", "bearing_life"):
        one = verdict(SIZED, name)
        assert float(one.utilisation) < 0.9
        assert (one.state, one.confidence, tone_of(one)) == ("unconfirmed", "made_up", "warning")
        assert one.passed
        assert one.met
        assert "example-75 (made up for examples)" in one.provenance
        assert word_of(one) == "met, unconfirmed rating"


def test_a_rating_of_the_user_s_own_counts_as_sure():
    own = replace(SIZED.joints[0], rating=Rating(max_torque=1700.0))
    drive = replace(SIZED, joints=(own, SIZED.joints[1]))
    assert (verdict(drive, "joint_torque").state, verdict(drive, "joint_torque").provenance) == ("passed", ())
    assert verdict(drive, "joint_torque", 2).state == "unconfirmed"
    assert verdict(drive, "max_speed").state == "unconfirmed"


def test_a_recalled_strength_is_said_and_the_same_figure_given_otherwise_is_not():
    assert catalogue().rows(Grade)["45"].confidence == "recalled"
    one = next(one for one in check(SIZED, only=["tube_strength"]) if one.run)
    assert (one.state, one.provenance) == ("unconfirmed", ("45 (recalled, not looked up)",))
    tested = replace(SIZED.shafts[1], material=Material(yield_strength=355e6))
    assert next(one for one in check(replace(SIZED, shafts=(tested,)), only=["tube_strength"]) if one.run).sure


def test_what_an_invented_rating_fails_still_fails_and_says_so():
    strong = replace(SIZED, duty=replace(SIZED.duty, torque=5000.0))
    one = verdict(strong, "joint_torque")
    assert (one.state, one.advice, word_of(one)) == ("failed", False, "failed, unconfirmed rating")


def test_a_limit_from_an_unconfirmed_source_is_advice():
    drive = Drive(joints=(Hooke(joint_angle=25 * deg),), duty=Duty(speed=1500 * rpm))
    (sure,) = check(drive, only=["acceleration"])
    assert (sure.state, sure.advice, sure.confidence) == ("failed", False, "confirmed")
    (recalled,) = check(replace(drive, settings=replace(drive.settings, norm="sae_ae7")), only=["acceleration"])
    assert (recalled.limit, recalled.state, recalled.advice) == (400.0, "failed", True)
    assert "recalled, not looked up" in recalled.provenance


def test_limits_of_vehicles_are_not_applied_to_other_drives():
    drive = Drive(joints=(Hooke(joint_angle=10 * deg), Hooke(joint_angle=8 * deg)), duty=Duty(speed=3000 * rpm))
    names = ["acceleration", "angle_rule", "angle_table", "joint_angle_at_speed", "length"]
    assert all(one.run for one in check(drive, only=names[:4]))
    mill = replace(drive, duty=replace(drive.duty, application="industrial"))
    found = check(mill, only=names)
    assert {one.check for one in found} == set(names)
    assert all("industrial" in one.unfit for one in found)
    asked_for = replace(mill, settings=replace(mill.settings, norm="spicer"))
    assert all(one.run for one in check(asked_for, only=["acceleration"]))


@pytest.mark.slow
def test_every_surface_says_it():
    found = answer(SIZED, checked(SIZED))
    assert found.tone == "warning"
    assert found.code == 0
    text = told(found.sentence, USUAL)
    loose = [one for one in check(SIZED) if one.run and not one.advice and not one.sure]
    count = len(checked(SIZED).binding)  # that answers agree is no check of the drive
    assert text.startswith(f"all {count} checks met, {len(loose)} by unconfirmed ratings")
    remark = next(one for one in map(lambda one: told(one.text, USUAL), found.remarks) if "example-75" in one)
    assert "45 (recalled, not looked up)" in remark
    records = json.loads(json.dumps(data(found, USUAL)))
    row = next(one for one in records["verdicts"] if one["check"] == "joint_torque")
    assert (row["state"], row["confidence"]) == ("unconfirmed", "made_up")
    assert row["provenance"] == ["example-75 (made up for examples)"]
    assert records["unconfirmed"] == len(loose)
    light = next(one for one in lights(asked(SIZED, None, None)) if one.title.startswith("largest torque of joint 1"))
    assert (light.tone, light.verdict) == ("warning", "met, unconfirmed rating")
    assert "made up for examples" in light.source
    strong = strength_answer(SIZED, strength_ask(SIZED))
    assert strong.tone == "warning"
    assert any("example-75" in told(one.text, USUAL) for one in strong.remarks)
    whole = completed(SIZED)
    lives = life_answer(whole, life_ask(whole))
    assert lives.tone == "warning"
    assert "example-75 (made up for examples)" in lives.facts["provenance"]


def test_a_drive_with_its_own_figures_is_green():
    drive = example("overconstrained-pump")
    assert all(one.sure for one in check(drive) if one.run and not one.advice)


@pytest.mark.parametrize("word", sorted(UNSURE))
def test_no_row_that_is_unsure_claims_to_be_looked_up(word):
    rows = [row for table in catalogue().tables.values() for row in table.values() if row.confidence == word]
    assert all(row.source for row in rows)


@pytest.mark.slow
def test_sources_of_limits_are_citations():
    for name in ("truck-duty-cycle", "car-propshaft", "six-joints", "pto-drive"):
        for one in check(example(name)):
            source = told(one.source, USUAL)
            assert "Book" not in source
            assert "web articles" not in source
