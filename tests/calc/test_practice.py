"""Rules of practice: their bounds, and the data behind them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cardan.calc import calc
from cardan.catalogue import catalogue
from cardan.catalogue.rows import AnglePair
from cardan.choices.selection import JointDuty, select_joint
from cardan.errors import InputError
from cardan.questions.motion.angle_limits import angle_limits


def test_the_printed_table_of_angles_follows_its_law_to_one_digit() -> None:
    for row in catalogue().rows(AnglePair).values():
        for first, printed in enumerate(row.second_joint_angle):
            most = float(angle_limits(row.speed, math.radians(first), 0.0).most)
            # largest difference 0.063 degrees, the figure of the spec, plus half a digit
            assert math.degrees(most) == pytest.approx(math.degrees(printed), abs=0.064 + 1e-9)


@pytest.mark.parametrize("phased", [True, False])
def test_the_exact_acceleration_is_the_largest_over_a_turn(phased: bool) -> None:
    first, second, speed = math.radians(12.0), math.radians(19.0), 80.0
    angle = np.linspace(0.0, math.pi, 20_001)
    one = np.arctan2(np.sin(angle), np.cos(angle) * math.cos(first))  # the middle shaft behind joint 1
    turned = one if not phased else one + 0.5 * math.pi
    two = np.unwrap(np.arctan2(np.sin(turned), np.cos(turned) * math.cos(second)))
    step = angle[1] - angle[0]
    brute = speed**2 * np.max(np.abs(np.gradient(np.gradient(two, step), step)[5:-5]))
    found = angle_limits(speed, first, second, phased=phased).torsional_exact
    assert float(found) == pytest.approx(
        brute, rel=1e-5
    )  # second differences of 2e4 points: 3e-7 of rounding, 3e-8 of the step


def test_limits_are_inclusive() -> None:
    assert calc("angle_rule_6_1p5", {"theta1_deg": 4.5, "theta2_deg": 6.0})["ok"]
    assert calc("accuracy_check", {"part": "cross", "coaxiality_mm": 0.05})["ok"]
    assert calc("lubrication_due", {"item": "needle_bearings", "hours": 250.0, "severe": True})["by"] == ["hours"]
    assert calc("balance_norm_book", {"vehicle_class": "gaz_66", "unbalance_Ncm": 0.5})["ok"]


def test_a_measure_of_the_other_part_is_refused() -> None:
    with pytest.raises(InputError, match="not a measure of a cross"):
        calc("accuracy_check", {"part": "cross", "coaxiality_mm": 0.05, "axis_offset_mm": 0.1})


def test_every_type_is_judged_once_and_says_why() -> None:
    need = JointDuty(torque=2500.0, joint_angle=math.radians(38.0), speed=73.0, synchronous=True)
    found = select_joint(need, include_beyond=True)
    assert len(found) == len(catalogue().tables["joint_types"])
    assert all(bool(one.causes) == (one.state == "rejected") for one in found)
    states = [one.state for one in found]
    assert states == sorted(states, key=["ok", "conditional", "unrated", "rejected"].index)


def test_a_need_that_cannot_be_names_every_fault() -> None:
    with pytest.raises(InputError) as caught:
        JointDuty(torque=0.0, joint_angle=1.6, speed=-1.0, service_factor=0.0)
    assert [one.field for one in caught.value.problems] == ["torque", "joint_angle", "speed", "service_factor"]
