"""Whatever rests on a mass that is estimated from span and journals says so, in every question of the register."""

from dataclasses import replace

import pytest

from cardan.answers.data import as_json, data
from cardan.answers.reader import Reader
from cardan.choices.check_answer import Checked
from cardan.drive.duty import Limits
from cardan.drive.yokes import estimated
from cardan.register import QUESTIONS

from .test_conditions import SLOW, plain


def drives():
    """Return a drive whose crosses say how large they are, and the same with ten times the mass that this gives."""
    bare = plain()
    joints = tuple(replace(one, cross=replace(one.cross, journal_length=0.016)) for one in bare.joints)
    assert all(joint.estimable for joint in joints)
    heavy = tuple(replace(one, mass=10.0 * estimated(one).mass) for one in joints)
    limits = Limits(speed_fluctuation=0.05, output_error=0.02, critical_speed=1.2)
    light = replace(bare, joints=joints, limits=limits)
    return light, replace(light, joints=heavy)


def told(question, drive):
    if question.lacking(drive):
        return None
    # Verdicts rest on what the questions beside them tell; asking for all of them twice takes minutes.
    result = Checked(verdicts=()) if question.name == "check" else question.ask(drive)
    return None if result is None else data(question.answer(drive, result), Reader())


@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=[pytest.mark.slow] if one in SLOW else []) for one in QUESTIONS]
)
def test_an_answer_that_goes_with_an_estimated_mass_says_so(name):
    light, heavy = (told(QUESTIONS[name], drive) for drive in drives())
    assert (light is None) == (heavy is None)
    if light is None:
        return
    codes = {one.get("code") for one in light["remarks"]}
    left = {"remarks", "file"}
    same = as_json({k: v for k, v in light.items() if k not in left}) == as_json(
        {k: v for k, v in heavy.items() if k not in left}
    )
    assert (same and name != "check") or "estimated_mass" in codes, "it rests on an estimated mass without a word"
    assert "estimated_mass" not in {one.get("code") for one in heavy["remarks"]}
