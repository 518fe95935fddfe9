"""What is said of the balance of shafts: limits, what was measured, and the masses that cancel it."""

import math
from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty
from cardan.drive.shaft import Unbalance
from cardan.io import example
from cardan.questions.bending.balance import balance
from cardan.questions.bending.balance_answer import answer, ask, lacking
from cardan.report.block import page
from cardan.texts import speaking

CAR = example("car-propshaft")
INCHES = Reader(units={"mass": "lb"}, decimal=",")


def of(drive, **choices):
    return answer(drive, ask(drive, **choices))


def column(table, key):
    return list(next(one for one in table.columns if one.key == key).values)


def test_limits_and_corrections_are_those_of_the_analysis():
    said, found = of(CAR), balance(CAR)
    limits, planes, fixes = said.tables
    assert column(limits, "allowed") == [one.allowed for one in found.shafts]
    assert column(planes, "utilisation") == [plane.utilisation for one in found.shafts for plane in one.planes]
    assert column(fixes, "mass") == [fix.mass for one in found.shafts for fix in one.corrections]
    assert (said.tone, said.code) == ("good", 0)
    assert page(said, USUAL).answer == "Balanced well enough for 4\u202f000 rpm."


def test_too_much_unbalance_is_a_failure():
    tube = CAR.shafts[1]
    much = tuple(replace(one, amount=10.0 * one.amount) for one in tube.unbalance)
    said = of(replace(CAR, shafts=(CAR.shafts[0], replace(tube, unbalance=much), *CAR.shafts[2:])))
    assert (said.tone, said.code) == ("failed", 1)
    assert told(said.sentence, USUAL) == (
        "too much unbalance on shaft 2 at 4\u202f000 rpm: 554 g·mm in a plane that may have 279 g·mm."
    )


def paired(*unbalances):
    tube = replace(CAR.shafts[1], unbalance=tuple(unbalances))
    return of(replace(CAR, shafts=(CAR.shafts[0], tube, *CAR.shafts[2:])))


def test_what_cancels_is_no_unbalance_but_for_rounding():
    """A mass against a couple goes at 0°, not 360°; two that cancel leave none, and no angle to put one at."""
    one, other = Unbalance(position=0.1, amount=1.8e-4), Unbalance(position=0.9, amount=1.8e-4, angle=math.pi)
    fixes = paired(one, other).tables[-1]
    assert column(fixes, "angle") == pytest.approx([math.pi, 0.0])
    limits, planes, fixes = paired(one, replace(other, position=0.1)).tables
    assert (column(limits, "unbalance"), column(limits, "couple")) == ([0.0], [0.0])
    assert column(planes, "unbalance") == column(fixes, "unbalance") == [0.0, 0.0]
    assert all(math.isnan(angle) for angle in column(fixes, "angle"))


def test_an_assumed_grade_is_told():
    said = of(example("two-piece-rubber-bearing"))
    assert said.facts["grade_assumed"]
    assert any("G16 is usual for these shafts" in told(one.text, USUAL) for one in said.remarks)


def test_readers_are_told_in_their_units_and_language():
    said = of(CAR)
    assert data(said, INCHES)["shafts"][0]["mass_lb"] == pytest.approx(balance(CAR).shafts[0].mass / 0.45359237)
    with speaking("ru"):
        assert "об/мин" in told(of(CAR).sentence, USUAL)


def test_what_the_drive_file_lacks_is_told():
    assert lacking(CAR) == ()
    assert lacking(replace(CAR, duty=Duty())) == (("duty.speed_range", "duty.speed"),)
    assert lacking(example("single-20deg"))
