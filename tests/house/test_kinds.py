"""The table of kinds of joints and questions that the documentation shows: each cell asked, from both registers.

`python -m tests.house.test_kinds` prints it anew.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS
from cardan.drive.movement import Harmonic
from cardan.errors import InputError
from cardan.io.drive_file import loads
from cardan.questions.mobility.drive_mechanism import unheld
from cardan.register import QUESTIONS
from tests.fixtures.joint_keys import KEYS
from tests.fixtures.own_joints import cross

from .test_conditions import BEARING, FIRST, SLOW, WHOLE

PAGE = Path(__file__).parents[2] / "docs" / "joint-types.md"

ASKED = [name for name in QUESTIONS if name not in SLOW and name != "classical"]
"""Questions of the table: those that take long ask the same of a kind as one of them; one is of cross joints alone."""


def drive_with(kind: str) -> Drive:
    """Return a drive that every question answers, whose first joint is of a kind."""
    keys = KEYS[kind].replace("reach_mm = 400", f"reach_mm = {math.hypot(1000.0, 150.0)!r}")  # its ball: the next joint
    own = FIRST if kind == "hooke" else f'[[joints]]\nkind = "{kind}"\ncentre_mm = [0, 0, 0]\n{keys}\n'
    drive = loads(WHOLE.replace("@", own))
    return loads(WHOLE.replace("@", own) + BEARING) if unheld(drive) else drive


BEHIND = WHOLE[WHOLE.index("@") + 1 : WHOLE.index("[[shafts]]")]
"""The second joint of the drive."""

ELSEWHERE = ("articulation", "accuracy", "forces", "losses", "life", "assembly")
"""Questions that `tests/questions/test_every_joint.py` asks of each kind at both places."""


def drive_behind(kind: str) -> Drive:
    """Return a drive in space, with a spline, whose second joint is of a kind."""
    keys = KEYS[kind] if kind != "hooke" else BEHIND.split("-150]")[1]
    own = f'\n\n[[joints]]\nkind = "{kind}"\ncentre_mm = [1000, 60, -150]\n{keys}\n\n'
    text = WHOLE.replace(BEHIND, own).replace("@", FIRST)
    if kind == "offset_cross":  # its ball holds the shaft behind it, and a bearing the one before it
        return loads(text[: text.index("[[supports]]\nshaft = 3")] + BEARING + text[text.index("[duty]") :])
    drive = loads(text)
    if unheld(drive):
        return loads(text + BEARING)
    sliding = text.replace("number = 2\n", "number = 2\nspline = { friction = 0.1, mean_diameter_mm = 50 }\n")
    return drive if drive.joints[1].slides else loads(sliding)


def told(name: str, drive: Drive) -> str:
    """Return "" where a question is answered, else why not."""
    question = QUESTIONS[name]
    if name == "articulation":
        swing = Harmonic(moves=("joints[1]", "output"), amplitude=(0.0, 0.0, 0.06), frequency=3.0)
        drive = replace(drive, movements=(swing,))
    try:
        question.result(drive)
    except InputError as error:
        return error.problems[0].message
    return ""


@cache
def answered(kind: str) -> dict[str, str]:
    drive = drive_with(kind)
    return {name: told(name, drive) for name in ASKED}


def head() -> list[str]:
    return ["| kind | " + " | ".join(ASKED) + " |", "|---|" + "---|" * len(ASKED)]


def row(kind: str) -> str:
    cells = ["–" if answered(kind)[name] else "●" for name in ASKED]
    return f"| `{kind}` | " + " | ".join(cells) + " |"


def test_the_page_has_its_head():
    assert "\n".join(head()) in PAGE.read_text(encoding="utf8")


@pytest.mark.slow
@pytest.mark.parametrize("kind", JOINTS)
def test_every_cell_is_answered(kind):
    assert {name: reason for name, reason in answered(kind).items() if reason} == {}
    assert row(kind) in PAGE.read_text(encoding="utf8").splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("kind", JOINTS)
def test_every_cell_is_answered_behind_another_joint(kind):
    drive = drive_behind(kind)
    asked = [name for name in ASKED if name not in ELSEWHERE]
    refused = {name: why for name in asked if (why := told(name, drive))}
    if kind == "offset_cross":
        assert "holds its shaft in a bearing of its own" in refused.pop("layouts")
    assert refused == {}


@pytest.mark.slow
def test_a_joint_that_holds_one_way_alone_answers_every_question():
    """A cross as a mechanism file, both of whose pins slide: it passes on its torque and a force along its normal."""
    made = drive_with("mechanism")
    own = replace(
        made.joints[0], drawing=cross("driving pin", "driven pin", diameter=0.01, bearing_distance=0.03).drawing
    )
    drive = replace(loads(WHOLE.replace("@", FIRST) + BEARING), joints=(replace(own, friction=0.05), *made.joints[1:]))
    assert own.free_ways == 2
    assert {name: told(name, drive) for name in ASKED} == dict.fromkeys(ASKED, "")


if __name__ == "__main__":
    print("\n".join(head() + [row(kind) for kind in JOINTS]))
    for kind in JOINTS:
        for name, reason in answered(kind).items():
            if reason:
                print(f"{name}, {kind}: {reason}")
