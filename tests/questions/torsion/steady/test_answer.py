"""What is said of steady torsional vibration at a speed and over many."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import example, torsion_response
from cardan.answers.data import as_csv
from cardan.answers.quantity import Quantity, told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.duty import Block, Case, Duty, History
from cardan.drive.machine import ConstantTorque
from cardan.questions.torsion.model.answer import ranges, torques_left_out
from cardan.questions.torsion.steady import answer as home
from cardan.units import rpm


def test_whole_speeds_keep_their_zeros() -> None:
    speeds = rpm * np.linspace(1300.0, 1400.0, 5)
    assert (
        told(ranges(speeds, [False, True, True, False, False], "angular_speed"), USUAL)
        == "1\u202f325 to 1\u202f350 rpm"
    )
    comma = Reader(decimal=",")
    assert told(ranges([1.5, 2.5, 3.5], [True, False, True]), comma) == "1,5; 3,5"
    assert told(ranges([1.0, 2.0], [False, False]), USUAL) == ""


@pytest.mark.slow
def test_orders_are_asked_over_the_operating_range(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(home, "SWEEP", 5)
    drive = example("unstable-drive")
    assert home.lacking(replace(drive, duty=replace(drive.duty, speed_range=None))) == (("duty.speed_range",),)
    within = replace(drive, duty=replace(drive.duty, speed_range=(0.0, 150.0)))
    found = home.ask(within)
    assert set(np.linspace(7.5, 150.0, 5)) < set(found.speed), "and more about the peak"
    said = home.answer(within, found)
    assert said.name == "orders"
    assert [one.name for one in said.figures()] == ["torsion-sweep", "torsion-waterfall"]
    assert said.full is not None
    first, *rows = "".join(as_csv(said.full(), USUAL)).splitlines()
    assert first.startswith("speed_rpm,status,verdict,growth_rate_per_s,element_1_mean_Nm,element_1_min_Nm")
    assert len(rows) == len(found.speed)


@pytest.mark.slow
def test_one_speed_has_its_orders_beside_each_other() -> None:
    drive = example("truck-power-unit")
    found = torsion_response(drive)
    said = home.answer(drive, found)
    elements, stations = said.tables
    assert [one.heading for one in elements.columns][1:] == [
        "mean",
        "lowest",
        "highest",
        "± order 2",
        "± order 4",
        "± other (order)",
    ]
    assert list(elements.columns[3].values) == found.torque_highest.tolist()
    assert len(stations.columns[0].values) == len(found.train.model.names)
    apart = [told(one.text, USUAL) for one in said.remarks if "non-synchronous" in told(one.text, USUAL)]
    assert apart[0].startswith("Order 6.8 does not repeat within two turns")


def test_rounding_of_a_straight_drive_is_no_alternating_torque() -> None:
    drive = replace(example("pto-baler"), movements=())
    found = torsion_response(drive)
    assert 0.0 < np.max(found.swing) < 1e-9
    said = home.answer(drive, found)
    assert "the alternating torque in shaft 2 is ±0 N·m about 150.0 N·m" in told(said.sentence, USUAL)
    assert said.keys[0].value == Quantity(0.0, "torque")


@pytest.mark.parametrize("torque", [None, 1e-3])
def test_without_a_mean_torque_none_is_told_and_nothing_reverses(torque: float | None) -> None:
    """What damping leaves of a mean is no torque that changes its sign; the smallest torque of the duty is one."""
    drive = example("unstable-drive")
    drive = replace(drive, duty=Duty(speed=900.0 * rpm, torque=torque))
    found = torsion_response(drive)
    swing, mean = float(np.max(found.swing)), float(found.steady.torque.mean[int(np.argmax(found.swing))])
    assert 0.0 < abs(mean) < 1e-3 * swing
    said = told(home.answer(drive, found).sentence, USUAL)
    assert ("about 0 N·m; stable." in said) == (torque is None)
    assert ("changes its sign" in said) == (torque is not None)


def test_a_load_takes_the_place_of_the_torques_of_all_load_cases() -> None:
    drive, load = example("unstable-drive"), ConstantTorque(torque=60.0)
    case = Case(name="one", torque=9.0)
    drive = replace(
        drive, duty=Duty(speed=900.0 * rpm, load=load, cases=(case, replace(case, name="two", torque=90.0)))
    )
    remarks = home.answer(drive, torsion_response(drive)).remarks
    assert [one.code for one in remarks].count("torques_left_out") == 1


@pytest.mark.parametrize(
    ("duty", "acts", "parts"),
    [
        (Duty(speed=90.0, torque=5.0), "", ""),
        (Duty(speed=90.0, blocks=(Block(torque=5.0, speed=90.0, share=1.0),)), "No mean torque", "of the duty cycle"),
        (Duty(speed=90.0, cases=(Case(name="one", torque=5.0),)), "No mean torque", "of the load cases"),
        (Duty(speed=90.0, torque_history=History(file="one.csv")), "No mean torque", "the measured torque"),
        (Duty(torque=5.0, cases=(Case(name="one", torque=9.0),)), "only that of the duty, 5.000 N·m", "load cases"),
        (
            Duty(load=ConstantTorque(torque=5.0), cases=(Case(name="one", torque=9.0),)),
            "only that of the machine",
            "load cases",
        ),
    ],
)
def test_torques_that_do_not_act_are_named(duty: Duty, acts: str, parts: str) -> None:
    drive = example("single-20deg")
    object.__setattr__(drive, "duty", duty)
    said = [told(one.text, USUAL) for one in torques_left_out(drive)]
    assert len(said) == bool(acts)
    assert all(("in torsion response" in one) == (duty.load is None) for one in said)
    assert all(acts in one and parts in one for one in said)
