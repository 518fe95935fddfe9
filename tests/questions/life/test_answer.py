"""What is said of the life of the joints: the numbers of the analysis, for any reader, where a duty asks for lives."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader, fixed
from cardan.drive.duty import History
from cardan.io import example
from cardan.questions.life.answer import answer, ask, lacking
from cardan.questions.life.life import life
from cardan.questions.life.lives import METHODS
from cardan.report.block import page, row
from cardan.texts import speaking
from cardan.units import hour

INCHES = Reader(units={"torque": "lbft", "force": "lbf"}, decimal=",")


def of(drive):
    return answer(drive, ask(drive))


def column(table, key):
    return next(one for one in table.columns if one.key == key)


def test_a_life_too_short_stands_first_with_what_would_do():
    drive = example("truck-duty-cycle")
    said, found = of(drive), life(drive)
    (key,) = said.keys
    assert told(key.called, USUAL) == "life of the joint that fails first, joint 3"
    assert (key.value.value, key.limit.value, key.better, key.tone) == (found.drive, 8000 * hour, "more", "failed")
    made = page(said, USUAL)
    assert [cell.text for cell in row(said.keys[0], USUAL)[3:5]] == ["≥ 8\u202f000", fixed(8000 * hour / found.drive)]
    assert [one.tone for one in made.alarms] == ["failed"]
    assert made.answer == "Too short; joint 3 (axle) fails after 5\u202f943 h, and 8\u202f000 h are asked for."
    assert said.code == 1


def test_the_tables_are_those_of_the_analysis():
    drive = example("truck-duty-cycle")
    said, found = of(drive), life(drive)
    joints, parts = said.tables
    for method in METHODS:
        assert list(column(joints, method).values) == list(found.of(method))
    for joint in (1, 2, 3):
        assert sum(column(parts, f"joint_{joint}_damage").values) == pytest.approx(1.0)
    assert any("roller paths do not overlap" in told(one.text, USUAL) for one in said.remarks)


def test_readers_are_told_in_their_units_and_language():
    drive = example("truck-duty-cycle")
    said = of(drive)
    (failed,) = [one for one in said.remarks if one.tone == "failed"]
    assert told(failed.text, INCHES).endswith("or with a capacity of 15\u202f484 lbf instead of 14\u202f163 lbf.")
    assert data(said, INCHES)["joints"][0]["equivalent_torque_lbft"] == pytest.approx(1590.5, abs=0.1)
    with speaking("ru"):
        assert "шарнир 3" in told(of(drive).keys[0].called, USUAL)


def test_a_measured_torque_has_its_figure():
    drive = example("car-propshaft")
    measured = History(file="run.csv", times=(0.0, 5.0, 30.0, 40.0), torques=(100.0, 500.0, 200.0, 100.0))
    said = of(replace(drive, duty=replace(drive.duty, blocks=(), torque=None, torque_history=measured)))
    assert [figure.name for figure in said.figures()] == ["life", "life-methods", "life-history"]


@pytest.mark.parametrize("change", ["no bearings", "no life asked for", "no duty"])
def test_what_the_drive_file_lacks_is_told(change):
    drive = example("mill-spindle")
    if change == "no bearings":
        drive = replace(drive, joints=tuple(replace(one, needles=None, rating=None, size="") for one in drive.joints))
    elif change == "no life asked for":
        drive = replace(drive, duty=replace(drive.duty, life=None))
    else:
        drive = replace(drive, duty=replace(drive.duty, torque=None))
    assert lacking(drive)


def test_the_dynamic_capacity_that_is_meant_stands_there():
    drive = example("truck-duty-cycle")
    found = life(drive)
    heavy = next(told(one.message, USUAL) for one in found.cautions if one.code == "heavy_load")
    assert "over half of their dynamic capacity of 63\u202f000 N" in heavy
    capacity = column(of(drive).tables[0], "capacity")
    assert (capacity.heading, list(capacity.values)) == ("dynamic capacity", list(found.bearings.capacity))
