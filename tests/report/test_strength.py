"""The strength page of the report: there where a file says enough, with the numbers of the analysis."""

from dataclasses import replace

import pytest

from cardan.analysis.strength import strength
from cardan.drive.duty import Duty
from cardan.figures.wording import significant
from cardan.io import example
from cardan.report.report import page

from .test_report import parsed


@pytest.mark.parametrize(("name", "there"), [("car-propshaft", True), ("single-20deg", False)])
def test_the_page_stands_where_something_can_be_judged(name, there):
    assert ("strength" in parsed(page(example(name))).ids) is there


def test_it_says_the_torque_rating():
    drive = example("car-propshaft")
    found = strength(drive)
    text = "".join(parsed(page(drive)).words)
    assert f"up to {significant(found.rated_torque)} N·m until {found.governing.title} ends it." in text
    assert "torque rating of the whole drive" in text


def test_a_weak_drive_is_an_alarm():
    drive = example("car-propshaft")
    weak = replace(drive, duty=Duty(torque=50 * drive.duty.torque, speed=100.0))
    text = "".join(parsed(page(weak)).words)
    assert f"of the {significant(weak.duty.torque)} N·m asked for" in text
