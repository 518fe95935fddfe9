"""Every question of the register, of a drive with a pose, a movement, two load cases and a measured error.

Its answer either depends on each of them, or a remark says that it does not and why; and then it truly does not. The
cases come from the register, so that a new question cannot forget one.
"""

import os
from dataclasses import replace
from functools import cache

import pytest

from cardan.answers.data import as_json, data
from cardan.answers.reader import Reader
from cardan.drive.accuracy import Error
from cardan.drive.duty import Case
from cardan.drive.joints import JOINTS
from cardan.drive.movement import Harmonic
from cardan.drive.settings import Pose
from cardan.errors import InputError
from cardan.io import loads
from cardan.questions.gathering import gather, principal
from cardan.register import QUESTIONS
from tests.fixtures.joint_keys import KEYS

from .surfaces import sentences

ASPECTS = ("pose", "movement", "case", "error")

MISSING: set[tuple[str, str]] = set()
"""Question and aspect that it still leaves out without a word; this set only shrinks."""

MOVING = ("articulation", "road")
"""Questions that have no answer without a movement."""

SLOW = ("orders", "stability", "road", "run-up", "absorber", "optimise", "rotor", "check", "bending")

FIRST = """[[joints]]
centre_mm = [0, 0, 0]
friction = 0.02
cross = { span_mm = 80, journal_mm = 20 }
needles = { capacity_N = 30000, count = 22, diameter_mm = 2.5, length_mm = 14 }
rating = { torque_Nm = 900 }
"""
"""The first joint of the drive, where it is a cross joint."""

BEARING = """
[[supports]]
shaft = 2
position_mm = 100
stiffness_N_per_um = 50
"""
"""What the shaft behind a joint needs that holds nothing but the turn."""

WHOLE = """
format = 1
name = "all questions"
input.point_mm = [-300, 0, 0]
output.point_mm = [1400, 0, -180]

@

[[joints]]
centre_mm = [1000, 0, -150]
friction = 0.02
cross = { span_mm = 80, journal_mm = 20 }
needles = { capacity_N = 30000, count = 22, diameter_mm = 2.5, length_mm = 14 }
tolerance = { alpha1_arcmin = 4 }

[[shafts]]
number = 1
outer_mm = 50
stiffness_Nm_per_rad = 90000
inertia_kg_m2 = 0.3
material = "C45"

[[shafts]]
number = 2
outer_mm = 70
wall_mm = 2.5
loss_factor = 0.02
material = "C45"
unbalance = [{ position_mm = 500, amount_g_mm = 400 }]

[[shafts]]
number = 3
outer_mm = 50
stiffness_Nm_per_rad = 90000
inertia_kg_m2 = 0.5
material = "C45"

[[supports]]
shaft = 1
position_mm = -250
axial = true
stiffness_N_per_um = 50
axial_stiffness_N_per_um = 50

[[supports]]
shaft = 1
position_mm = -60
stiffness_N_per_um = 50
offset_mm = [0, 0, 0.1]

[[supports]]
shaft = 3
position_mm = 60
axial = true
stiffness_N_per_um = 50
axial_stiffness_N_per_um = 50

[[supports]]
shaft = 3
position_mm = 300
stiffness_N_per_um = 50

[duty]
speed_rpm = 1500
speed_range_rpm = [600, 1800]
torque_Nm = 250
life_h = 2000
application = "industrial"
run_up = { start_rpm = 300, end_rpm = 1500, duration_s = 1 }

[limits]
speed_fluctuation_percent = 5
output_error_deg = 1
"""


@cache
def plain(kind="hooke"):
    """Return a drive that every question answers, in one condition; its first joint may be of another kind."""
    other = f'[[joints]]\nkind = "{kind}"\ncentre_mm = [0, 0, 0]\n{KEYS[kind]}\n'
    bearing = BEARING if JOINTS[kind].loose is True else ""
    return loads(WHOLE.replace("@", FIRST if kind == "hooke" else other) + bearing)


def having(aspect, kind="hooke"):
    """Return the drive with an aspect more."""
    drive = plain(kind)
    if aspect == "pose":
        lower = (("joints[1].centre_mm", (1010.0, 30.0, -260.0)), ("output.point_mm", (1410.0, 30.0, -290.0)))
        return replace(drive, poses=(Pose(name="low", share=0.4, set=lower),))
    if aspect == "movement":
        swing = Harmonic(moves=("joints[1]", "output"), amplitude=(0.0, 0.0, 0.06), frequency=3.0)
        return replace(drive, movements=(swing,))
    if aspect == "case":
        case = Case(name="hill", torque=600.0, speed=200.0, share=0.3)
        return replace(drive, duty=replace(drive.duty, cases=(case,)))
    first, last = drive.joints
    if first.single_cross:
        first = replace(first, error=Error(s1=0.05e-3, alpha1=0.002))
    return replace(drive, joints=(first, replace(last, error=Error(s1=0.02e-3, alpha1=0.001))))


def told(question, drive):
    """Return what is said of a drive, for a program; None where there is no answer."""
    one = principal(question, drive)
    if question.lacking(one):
        return None
    result = question.ask(one)
    if result is None:
        return None
    answer = gather(question, drive, question.answer(one, result))
    found = data(answer, Reader())
    found["keys"] = [[key.name, key.value.value] for key in answer.keys]
    return found


def answered(question, drive):
    """Return what is said of a drive as `told` does; None where a kind of joint is refused, or holds no shaft.

    A cross with offset carries the next joint around, unless its ball stands there: no bearings can follow.
    """
    try:
        return told(question, drive)
    except InputError as error:
        if all(one.field.endswith((".kind", "supports", ".reach")) for one in error.problems):
            return None
        raise


@cache
def said_plainly(name, kind="hooke", moving=False):
    return answered(QUESTIONS[name], having("movement", kind) if moving else plain(kind))


def cases():
    """Yield every question with every aspect; with other kinds than cross joints the quick ones, each with one aspect.

    Which one goes round with question and kind, so that every aspect meets every question with some kinds and every
    kind with some questions. With CARDAN_ALL_KINDS all of them are asked, which takes ten minutes.
    """
    every = "CARDAN_ALL_KINDS" in os.environ
    for row, kind in enumerate(JOINTS):
        quick = [one for one in QUESTIONS if one not in SLOW]
        for column, name in enumerate(QUESTIONS if kind == "hooke" else quick):
            asked = ASPECTS if kind == "hooke" or every else [ASPECTS[(row + column) % len(ASPECTS)]]
            for aspect in asked:
                marks = [pytest.mark.slow] if name in SLOW or kind != "hooke" else []
                yield pytest.param(name, aspect, kind, marks=marks, id=f"{name}-{aspect}-{kind}")


def test_nothing_is_missing_that_is_not_asked():
    assert {name for name, _aspect in MISSING} <= set(QUESTIONS)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "aspect", "kind"), list(cases()))
def test_every_question_depends_on_it_or_says_why_not(name, aspect, kind):
    question, drive = QUESTIONS[name], having(aspect, kind)
    before, now = said_plainly(name, kind), answered(question, drive)
    if name in MOVING and aspect != "movement":
        before = said_plainly(name, kind, moving=True)
        now = answered(question, replace(drive, movements=having("movement", kind).movements))
    if kind != "hooke" and now is None:
        assert before is None, "it refuses this kind of joint whatever else the drive has"
        return
    assert now is not None, "the drive of this test answers every question"
    if name in MOVING and aspect == "movement":
        return
    assert [one["text"] for one in now["remarks"] if sentences(one["text"]) > 1] == []
    own = {one["text"] for one in (before or {}).get("remarks", ())}
    new = [one for one in now["remarks"] if one["text"] not in own]
    without = [one for one in new if one.get("code") in (f"without_{aspect}", "same", "left_out")]
    changed = numbers(question, now, aspect) != numbers(question, before, aspect)
    assert not (changed and without), "it says that it does not depend on this, and does"
    held = bool(changed or without)
    assert held or (name, aspect) in MISSING, "it leaves this out without a word"
    assert not (held and (name, aspect) in MISSING), "no longer missing: take it out of the set"


def numbers(question, said, aspect):
    """Return all that is said, as a program gets it, but for remarks and the table that names the conditions."""
    left = {"remarks", "conditions"} if aspect in question.without else {"remarks"}
    return as_json({key: value for key, value in (said or {}).items() if key not in left})
