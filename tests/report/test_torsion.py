"""The report's page of torsional vibration: present where the file asks for it, with the numbers of the analyses."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from cardan import Drive, example, torsion_modes, torsion_response
from cardan.drive.shaft import Shaft
from cardan.figures.wording import significant
from cardan.report.block import Page, Picture, Table, Words
from cardan.report.subject import Subject
from cardan.report.torsion import twisting


@cache
def of(drive: Drive) -> Page:
    """Return the page of a drive, made once for all tests."""
    return twisting(Subject(drive=drive))  # type: ignore[return-value]


def test_it_stands_only_where_masses_or_stiffnesses_are_given() -> None:
    assert of(example("z-arrangement")) is None
    assert of(example("truck-supports")) is None


@pytest.mark.slow
def test_the_first_page_tells_the_mode_and_the_swing() -> None:
    drive = example("truck-power-unit")
    found = of(drive)
    swing = float(np.max(torsion_response(drive).swing))
    assert found.keys[0][1].full == repr(float(torsion_modes(drive).omega[0]) / (2 * np.pi))
    assert found.keys[2][1].full == repr(swing)
    assert f"± {significant(swing, 3)} N·m" in found.answer
    assert found.alarms == []


def test_growing_vibration_is_an_alarm() -> None:
    found = of(example("unstable-drive"))
    assert [alarm.tone for alarm in found.alarms] == ["failed"]
    assert "principal zone of mode 1" in found.alarms[0].text
    assert "and small disturbances grow" in found.answer
    assert of(example("cured-drive")).alarms == []


def test_a_map_without_anything_on_it_is_a_sentence() -> None:
    blocks = of(example("pto-flywheel-absorber")).blocks
    assert any(isinstance(one, Words) and "grows nowhere" in one.text for one in blocks)
    names = [one.figure.name for one in blocks if isinstance(one, Picture)]
    assert "stability-map" not in names
    assert "stability-map" in [
        one.figure.name for one in of(example("unstable-drive")).blocks if isinstance(one, Picture)
    ]


@pytest.mark.slow
def test_what_is_met_in_use_is_told() -> None:
    drive = example("truck-power-unit")
    low = replace(drive, duty=replace(drive.duty, speed_range=(35.0, 85.0)))
    tones = [alarm.tone for alarm in of(low).alarms]
    assert tones == ["failed", "warning"]


def test_what_is_missing_is_told() -> None:
    drive = replace(example("z-arrangement"), shafts=(Shaft(number=2, stiffness=1e4),))
    found = of(drive)
    assert [alarm.tone for alarm in found.alarms] == ["warning"]
    assert "nothing here has inertia" in found.blocks[0].text


@pytest.mark.parametrize("name", ["truck-power-unit", "pto-flywheel"])
def test_every_check_passes(name: str) -> None:
    table = of(example(name)).blocks[-1]
    assert {row[-1].tone for row in table.rows} == {"good"}


def test_torques_that_are_only_rounding_are_nought() -> None:
    table = next(
        one for one in of(example("pto-flywheel-absorber")).blocks if isinstance(one, Table) and "Torques" in one.title
    )
    ring = next(row for row in table.rows if "absorber" in row[0].text)
    assert ring[1].text == "0"
    assert abs(float(ring[1].full)) < 1e-9 * float(ring[3].full)
