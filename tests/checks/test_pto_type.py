"""Power and speed of a power take-off against those of its type."""

from __future__ import annotations

import numpy as np
import pytest

from cardan import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Case, Duty
from cardan.units import rpm

DRIVE = Drive.from_angles([0.2, 0.2])


def judged(**duty):
    return check(DRIVE, Duty(application="industrial", **duty), only=["pto_type"])


def test_power_is_torque_times_speed_and_the_rating_is_no_warning_of_its_own_speed():
    (power,) = judged(pto_type=1, speed=540 * rpm, torque=300.0)
    assert power.value == pytest.approx(300.0 * 540 * 2 * np.pi / 60)
    assert power.limit == 60e3
    assert power.advice  # the figures of ISO 500 are recalled


def test_the_case_with_most_power_decides_not_the_largest_torque():
    cases = (Case(name="start", torque=900.0, speed=100 * rpm), Case(name="work", torque=400.0, speed=540 * rpm))
    (power,) = judged(pto_type=1, cases=cases)
    assert power.value == pytest.approx(400.0 * 540 * rpm)
    assert "work" in str(power.note)


def test_a_faster_shaft_than_the_type_turns_is_told():
    power, speed = judged(pto_type=2, speed=1300 * rpm, torque=100.0)
    assert power.passed
    assert (speed.value, speed.limit) == pytest.approx((1300 * rpm, 1000 * rpm))
    assert not speed.passed


def test_it_judges_nothing_where_no_type_is_given_and_names_what_it_lacks():
    assert judged(speed=540 * rpm, torque=300.0) == ()
    (lacks,) = judged(pto_type=1)
    assert lacks.missing == ("duty.torque", "duty.speed")
