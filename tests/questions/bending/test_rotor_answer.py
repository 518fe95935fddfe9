"""What is said of a whirling shaft: the numbers of the analysis, where the file gives an unbalance or a crack."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.shaft import ShaftCrack
from cardan.io import example
from cardan.questions.bending.rotor import rotor_response
from cardan.questions.bending.rotor_answer import answer, ask, lacking
from cardan.report.block import page
from cardan.texts import speaking

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


@pytest.mark.slow
def test_readers_are_told_in_their_units_and_language():
    said = of(CAR)
    assert " mil at " in told(said.sentence, INCHES)
    found = rotor_response(CAR)
    assert data(said, INCHES)["rotor"]["mass_lb"] == pytest.approx(found.rotor.mass / 0.45359237)
    with speaking("ru"):
        assert "об/мин" in told(of(CAR).sentence, USUAL)
