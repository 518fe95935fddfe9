"""The page of a cracked shaft: there where the file gives one, with the numbers of the analysis."""

from dataclasses import replace

import pytest
from cardan.report.rotor import whirling_cracked

from cardan.drive.crack import ShaftCrack
from cardan.io import example
from cardan.questions.bending.rotor_response import rotor_response
from cardan.report.subject import asked


def cracked(*losses):
    drive = example("car-propshaft")
    shaft = replace(drive.shafts[1], crack=ShaftCrack(losses=losses))
    return replace(drive, shafts=(drive.shafts[0], shaft, *drive.shafts[2:]))


def of(drive):
    return whirling_cracked(asked(drive, None, None))


def test_there_is_no_page_without_a_crack():
    assert of(example("car-propshaft")) is None


def test_its_table_is_that_of_the_analysis():
    drive = cracked(0.2, 0.05)
    page, found = of(drive), rotor_response(drive)
    rows = next(block for block in page.blocks if getattr(block, "title", "").startswith("Orders")).rows
    assert [float(row[1].full) for row in rows] == pytest.approx([1e6 * found.peak(n)[1] for n in (1, 2, 3, -1)])
    assert page.answer.startswith("Shaft 2 whirls most in order 2")
    assert page.alarms == []
    verdict = next(block for block in page.blocks if getattr(block, "title", "") == "Checks").rows[0][-1]
    assert verdict.tone == "good"
    assert [block.figure.name for block in page.blocks if hasattr(block, "figure")] == ["rotor", "rotor-orbits"]
