"""What is said of torsional vibration along a movement: the numbers of the result, on the surfaces of all questions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.checks.design import design
from cardan.checks.strength.shaft_life import fatigue_life
from cardan.checks.torsion.road import ask
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.movement import Harmonic
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.questions.torsion.road.answer import COLUMNS, answer, lacking
from cardan.questions.torsion.road.road import road_torsion
from cardan.register import QUESTIONS

STEEL = Material(ultimate_strength=600e6, yield_strength=400e6)


def drive(size: float, rate: float = 0.1, outer: float = 0.03, **duty: float) -> Drive:
    tube = Shaft(number=2, outer=outer, inner=0.6 * outer, stiffness=5000.0, damping=4.0, material=STEEL)
    return replace(
        Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1, 0, 0.2)]),
        movements=(Harmonic(moves=("output",), amplitude=(0.0, 0.0, size), frequency=rate),),
        shafts=(tube,),
        stations=(Station(shaft=2, inertia=0.4),),
        duty=Duty(speed=60.0, torque=300.0, **duty),
    )


def test_all_is_told() -> None:
    found = ask(drive(0.15))
    said = answer(drive(0.15), found)
    facts = data(said, Reader())
    assert facts["largest_torque_Nm"] == pytest.approx(found.peak[0])
    assert facts["reversals_per_hour"] == pytest.approx((3600.0 * found.reversals).tolist())
    assert facts["method"] == "standing"
    assert [one.name for one in said.figures()] == ["torsion-road"]
    assert {one.name for one in said.tables} == {"elements", "orders", "damage"}
    assert "over 62.8 s of the movement the torque reaches" in told(said.sentence, USUAL)
    question = QUESTIONS["road"]
    assert question.columns[0].of_one is not None
    row = question.columns[0].of_one(drive(0.15))
    assert row == pytest.approx([found.peak[0], found.resonance, found.unstable, 3600.0 * np.max(found.reversals)])
    assert len(COLUMNS[0].columns(drive(0.15))) == len(row)


def test_what_is_lacking() -> None:
    bare = replace(drive(0.1), movements=(), duty=Duty())
    assert {("movements",), ("duty.speed",)} <= set(lacking(bare))


def test_damage_of_a_drive_that_hardly_moves_is_that_of_its_life() -> None:
    """A movement of 1 μm leaves the drive where it stands: its damage is that of running there."""
    still = drive(1e-6, outer=0.025, life=3.6e7)
    (found,) = ask(still).damage
    assert found.shaft == 2
    life = fatigue_life(design(replace(still, movements=())), 1)
    assert found.rate > 0.0
    assert found.rate == pytest.approx(1.0 / life, rel=1e-5)
    more = ask(drive(0.1, outer=0.025, life=3.6e7)).damage[0]
    assert more.rate > found.rate


@pytest.mark.slow
def test_in_time_the_same_is_told() -> None:
    quick = drive(0.1, rate=25.0)
    found = road_torsion(quick)
    said = data(answer(quick, found), Reader())
    assert said["method"] == "in_time"
    assert not said["slow_enough"]
