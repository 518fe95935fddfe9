"""What is said of a whirling shaft: the numbers of the analysis, where the file gives an unbalance or a crack."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Duty
from cardan.drive.machine import RunUp
from cardan.drive.shaft import Shaft, ShaftCrack, Unbalance
from cardan.io import example
from cardan.questions.bending.rotor import rotor_response, rotor_run
from cardan.questions.bending.rotor_answer import answer, answer_of_run, ask, lacking
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import rpm

CAR = example("car-propshaft")
INCHES = Reader(units={"displacement": "mil", "mass": "lb"}, decimal=",")


def changed(drive, **fields):
    return replace(drive, shafts=(drive.shafts[0], replace(drive.shafts[1], **fields), *drive.shafts[2:]))


def cracked(*losses):
    return changed(CAR, crack=ShaftCrack(losses=losses))


def of(drive):
    return answer(drive, ask(drive))


def test_without_unbalance_and_crack_something_lacks():
    assert lacking(changed(CAR, unbalance=())) == (("shafts[1].unbalance", "shafts[1].crack"),)
    assert lacking(changed(cracked(0.2, 0.05), unbalance=())) == ()


@pytest.mark.slow
def test_its_table_is_that_of_the_analysis():
    drive = cracked(0.2, 0.05)
    said, found = of(drive), rotor_response(drive)
    amplitude = next(one for one in said.tables[0].columns if one.key == "amplitude")
    assert list(amplitude.values) == pytest.approx([found.peak(n)[1] for n in (1, 2, 3, -1)])
    made = page(said, USUAL)
    assert made.answer.startswith("Shaft 2 by itself whirls most in order 2")
    assert any(told(one.text, USUAL).startswith("In the whole line") for one in said.remarks)
    assert made.alarms == []
    assert [block.figure.name for block in made.blocks if hasattr(block, "figure")] == ["rotor", "rotor-orbits"]
    assert any(told(one.text, USUAL).startswith("Checked: power and multipliers agree") for one in said.remarks)


def couple():
    """A tube whose unbalances cancel in the mode between its joints, by symmetry."""
    pair = (
        Unbalance(position=0.1, amount=1.8e-4),
        Unbalance(position=0.9, amount=1.8e-4, angle=math.pi),
    )
    tube = Shaft(number=2, length=1.0, outer=0.076, wall=0.002, unbalance=pair)
    duty = Duty(speed=4000 * rpm, run_up=RunUp(start=300.0, end=400.0, duration=0.2))
    return replace(Drive.from_angles([0.05, 0.05]), shafts=(tube,), duty=duty)


@pytest.mark.slow
def test_unbalances_that_cancel_do_not_make_a_shaft_whirl_by_itself():
    said = of(couple())
    assert told(said.sentence, USUAL) == "shaft 2 by itself does not whirl: it has no unbalance in its mode."
    columns = {one.key: list(one.values) for one in said.tables[0].columns}
    assert columns["amplitude"] == [0.0] * 4
    assert columns["speed"] == columns["share"] == [None] * 4
    assert any("unbalance is 0 g·mm" in told(one.text, USUAL) for one in said.remarks)
    assert not any("--plot" in one.command for one in said.remarks)
    assert said.figures() == ()
    assert [one.name for one in of(CAR).figures()] == ["rotor", "rotor-orbits"]


def test_nor_does_it_while_the_speed_changes():
    drive = couple()
    said = answer_of_run(drive, *rotor_run(drive))
    assert "does not whirl" in told(said.sentence, USUAL)
    assert said.figures() == ()
    for column in said.full().columns[1:]:
        np.testing.assert_array_equal(column.values, 0.0)


@pytest.mark.slow
def test_readers_are_told_in_their_units_and_language():
    said = of(CAR)
    assert " mil at " in told(said.sentence, INCHES)
    found = rotor_response(CAR)
    assert data(said, INCHES)["rotor"]["mass_lb"] == pytest.approx(found.rotor.mass / 0.45359237)
    with speaking("ru"):
        assert "об/мин" in told(of(CAR).sentence, USUAL)
