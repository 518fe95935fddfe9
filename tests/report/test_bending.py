"""Critical speeds in the report: the page, its figures on the first page, and what it warns of."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from cardan.report.bending import whirling

from cardan import example
from cardan.drive.duty import Duty
from cardan.figures.wording import significant
from cardan.questions.bending.bending import bending_speeds
from cardan.report.block import Picture, Table
from cardan.units import rpm

VAN = example("two-piece-rubber-bearing")


def page(drive):
    return whirling(SimpleNamespace(drive=drive))


def test_the_numbers_are_those_of_the_analysis():
    found, shown = bending_speeds(VAN), page(VAN)
    modes = next(block for block in shown.blocks if isinstance(block, Table))
    assert [row[4].text for row in modes.rows] == [significant(speed / rpm) for speed in found.actual]
    assert [row[4].tone for row in modes.rows] == ["warning", "good", "plain"]
    assert [block.figure.name for block in shown.blocks if isinstance(block, Picture)] == [
        "critical-speeds",
        "mode-shapes",
    ]
    assert "1.82 times the highest speed in use" in shown.answer


def test_the_key_figure_has_its_limit():
    (row,) = page(VAN).keys
    assert [cell.text for cell in row[:5]] == [
        "critical speed, shaft 3 bows",
        "7\u202f095",
        "rpm",
        "≥ 6\u202f240",
        "0.88",
    ]
    assert row[-1].tone == "good"
    (row,) = page(replace(VAN, duty=Duty(speed_range=(50.0, 450.0)))).keys
    assert row[-1].tone == "warning"
    (row,) = page(replace(VAN, duty=Duty())).keys
    assert [cell.text for cell in row[3:]] == ["–", "–", ""]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("duty", "tones"),
    [
        (Duty(), []),
        (Duty(speed=300.0), []),
        (Duty(speed_range=(75.0, 400.0)), ["warning", "warning"]),
        (Duty(speed_range=(400.0, 500.0)), ["failed", "warning"]),
        (Duty(speed_range=(500.0, 900.0)), ["failed"]),
    ],
)
def test_alarms(duty, tones):
    assert [alarm.tone for alarm in page(replace(VAN, duty=duty)).alarms] == tones


def test_a_file_that_describes_half_of_it_is_told_what_lacks():
    support = replace(VAN.supports[0], radial=False, axial=True, stiffness=None)
    shown = page(replace(VAN, supports=(support,)))
    assert "can swing freely" in shown.blocks[0].text
    assert shown.alarms[0].tone == "warning"


def test_without_bodies_or_bearings_there_is_no_page():
    assert page(replace(VAN, supports=())) is None
    assert page(example("two-piece-rear-drive")) is None
    assert page(example("single-20deg")) is None
