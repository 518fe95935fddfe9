"""What is said of critical speeds: the numbers of the analysis for any reader, what alarms, and what the file lacks."""

from dataclasses import replace

import pytest

from cardan import example
from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader, significant
from cardan.drive.duty import Duty
from cardan.questions.bending.answer import answer, answer_of_map, ask, lacking
from cardan.questions.bending.bending import bending_speeds, critical_speed_map
from cardan.register import QUESTIONS
from cardan.report.answers import found_page, subject
from cardan.report.block import Picture, Table, page, row
from cardan.texts import speaking
from cardan.units import rpm

VAN = example("two-piece-rubber-bearing")
ELSEWHERE = Reader(units={"angular_speed": "rad_s", "length": "in"}, decimal=",")


def of(drive):
    return answer(drive, ask(drive))


def test_the_numbers_are_those_of_the_analysis():
    found, made = bending_speeds(VAN), page(of(VAN), USUAL)
    modes = next(block for block in made.blocks if isinstance(block, Table))
    assert [row[4].text for row in modes.rows] == [significant(speed / rpm) for speed in found.actual]
    assert [row[4].tone for row in modes.rows] == ["warning", "good", "plain"]
    assert [block.figure.name for block in made.blocks if isinstance(block, Picture)] == [
        "critical-speeds",
        "mode-shapes",
    ]
    assert "1.82 times the highest speed in use" in made.answer


def test_the_key_figure_has_its_limit():
    (key,) = of(VAN).keys
    shown = row(key, USUAL)
    assert [cell.text for cell in shown[:5]] == [
        "bending critical speed, first bending mode, shaft 3 (rear piece)",
        "7\u202f095",
        "rpm",
        "≥ 6\u202f240",
        "0.88",
    ]
    assert shown[-1].tone == "good"
    (key,) = of(replace(VAN, duty=Duty(speed_range=(50.0, 450.0)))).keys
    assert key.tone == "warning"
    (key,) = of(replace(VAN, duty=Duty())).keys
    assert [cell.text for cell in row(key, USUAL)[3:]] == ["–", "–", ""]


@pytest.mark.parametrize(
    ("duty", "tones"),
    [
        (Duty(), []),
        (Duty(speed=300.0), ["warning"]),
        (Duty(speed=140.0), ["failed", "warning"]),
        (Duty(speed_range=(75.0, 400.0)), ["warning", "warning"]),
        (Duty(speed_range=(400.0, 500.0)), ["failed", "warning", "warning"]),
        (Duty(speed_range=(500.0, 900.0)), ["failed", "warning"]),
    ],
)
def test_alarms(duty, tones):
    said = of(replace(VAN, duty=duty))
    assert [alarm.tone for alarm in page(said, USUAL).alarms] == tones
    assert said.code == ("failed" in tones)


def test_readers_are_told_in_their_units_and_language():
    said = of(VAN)
    assert "743,0 rad/s, 1,82 times" in told(said.sentence, ELSEWHERE)
    found = bending_speeds(VAN)
    content = data(said, ELSEWHERE)
    assert [one["actual_rad_s"] for one in content["modes"]] == found.actual.tolist()
    with speaking("ru"):
        assert "об/мин" in told(of(VAN).sentence, USUAL)


def test_a_map_has_its_own_table_and_figure():
    result = ask(VAN)
    varied = critical_speed_map(VAN, modes=2)
    said = answer_of_map(VAN, result, varied)
    (table,) = said.tables
    assert table.title == "Critical speeds over the stiffness of support 1 (centre bearing)"
    assert len(said.full().columns[0].values) == len(varied.value)
    assert [figure.name for figure in said.figures()][:2] == ["critical-speeds", "mode-shapes"]


def test_a_file_that_describes_half_of_it_is_told_what_lacks():
    support = replace(VAN.supports[0], radial=False, axial=True, stiffness=None)
    shown = found_page(QUESTIONS["bending"], subject(replace(VAN, supports=(support,))))
    assert "can pivot freely" in shown.blocks[0].text
    assert shown.alarms[0].tone == "warning"


def test_without_bodies_or_bearings_something_lacks():
    assert lacking(replace(VAN, supports=())) == (("supports",),)
    assert lacking(example("two-piece-rear-drive"))
    assert lacking(example("single-20deg"))
