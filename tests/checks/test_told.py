"""What verdicts tell of the speed, the band and the bend that they were reached with."""

from dataclasses import replace

import pytest

from cardan import Drive, example
from cardan.checks import check
from cardan.drive.duty import Duty
from cardan.units import deg, rpm


def test_accelerations_say_at_which_speed_they_are_judged_where_it_is_not_the_duty_s():
    drive = example("truck-duty-cycle")
    found = check(drive, only=["acceleration"])
    assert drive.duty.speed == pytest.approx(1500 * rpm)
    assert {one.note for one in found} == {"at 1\u202f800 rpm"}
    still = replace(drive, duty=Duty(speed=1500 * rpm))
    assert {one.note for one in check(still, only=["acceleration"])} == {""}


@pytest.mark.parametrize(("top", "value"), [(3900.0, "half"), (2000.0, "top")])
def test_a_range_of_speeds_is_held_against_half_the_critical_speed_itself(top, value):
    """A speed that nobody runs and no table names would be the geometric middle of the band."""
    drive = example("two-piece-rubber-bearing")
    drive = replace(drive, duty=replace(drive.duty, speed_range=(700 * rpm, top * rpm)))
    one = next(v for v in check(drive, only=["half_critical"]) if v.advice and v.title.endswith("shaft 3"))
    low, high = one.limit
    middle = 0.5 * (float(low) + float(high))
    assert float(one.value) == pytest.approx(middle if value == "half" else top * rpm)
    assert one.state == ("failed" if value == "half" else "passed")
    assert bool(one.note) == (value == "half")


@pytest.mark.parametrize("name", ["bend_at_speed", "angle_table"])
def test_no_rule_allows_more_than_a_joint_can_bend(name):
    drive = Drive.from_angles([0.02, 0.02], yoke_angles=[0.0])
    slow, quick = (check(drive, Duty(speed=speed * rpm), only=[name])[0] for speed in (10.0, 3000.0))
    assert float(slow.limit) == pytest.approx(45 * deg)
    assert "bend no further" in slow.note
    assert float(quick.limit) < 30 * deg
    assert not quick.note
