"""The strength page of the report: there where a file says enough, with the numbers of the analysis."""

from dataclasses import replace

import pytest

from cardan.checks.strength.strength import strength
from cardan.drive.duty import Duty
from cardan.figures.wording import significant
from cardan.io import example
from cardan.questions.forces.forces import forces
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.report.block import Page, Points
from cardan.report.report import page
from cardan.report.strength import bearing_up
from cardan.report.subject import Subject

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


@pytest.mark.slow
def test_a_weak_drive_is_an_alarm():
    drive = example("car-propshaft")
    weak = replace(drive, duty=Duty(torque=50 * drive.duty.torque, speed=100.0))
    text = "".join(parsed(page(weak)).words)
    assert f"of the {significant(weak.duty.torque)} N·m asked for" in text


def of(drive) -> Page:
    found = bearing_up(Subject(drive=drive))
    assert found is not None
    return found


def test_torsional_vibration_is_named_beside_the_torques_without_it():
    drive = example("cured-drive")
    found, runs = of(drive), torsion_response(drive)
    (said,) = found.alarms
    assert runs.floquet.verdict == Verdict.STABLE
    assert f"{significant(float(runs.torque_highest.max()), 3)} N·m" in said.text
    assert said.tone == "warning"  # 243 N·m, and the weakest part holds 818
    weak = replace(drive, limits=replace(drive.limits, twist=0.02))
    assert [one.tone for one in of(weak).alarms] == ["failed"]
    assert of(example("car-propshaft")).alarms == []


def test_no_torque_is_told_of_torsional_vibration_that_grows():
    drive = example("unstable-drive")
    (said,) = of(drive).alarms
    assert torsion_response(drive).floquet.verdict == Verdict.UNSTABLE
    assert "grows by itself" in said.text
    assert "N·m" not in said.text
    assert said.tone == "failed"


@pytest.mark.parametrize("name", ["truck-supports", "propshaft-with-rzeppa"])
def test_a_drive_that_carries_no_torque_is_not_rated(name):
    drive = example(name)
    assert of(drive).keys
    idle = Subject(drive=replace(drive, duty=replace(drive.duty, torque=0.0)))
    assert bearing_up(idle) is None


def test_loads_that_the_stresses_leave_out_are_told():
    drive = example("truck-supports")
    points = [one for block in of(drive).blocks if isinstance(block, Points) for one in block.items]
    journal = max(float(one.journals.size.max()) for one in (forces(drive), forces(drive).reverse))
    assert any(f"{significant(journal)} N, 5.3 % more" in one for one in points)
