"""What verdicts tell of the speed, the band and the joint angle that they were reached with."""

import json
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.drive.duty import Duty
from cardan.drive.fields.paths import read, with_values
from cardan.io import loads
from cardan.questions.bending.bending import bending_speeds
from cardan.units import deg, rpm


def test_accelerations_say_at_which_speed_they_are_judged_where_it_is_not_the_duty_s():
    drive = example("truck-duty-cycle")
    found = check(drive, only=["acceleration"])
    assert drive.duty.speed == pytest.approx(1500 * rpm)
    assert {told(one.note, USUAL) for one in found} == {"at 1\u202f800 rpm"}
    still = replace(drive, duty=Duty(speed=1500 * rpm))
    assert {told(one.note, USUAL) for one in check(still, only=["acceleration"])} == {""}


@pytest.mark.parametrize(("top", "value"), [(3900.0, "half"), (2000.0, "top")])
def test_a_range_of_speeds_is_held_against_half_the_critical_speed_itself(top, value):
    """A speed that nobody runs and no table names would be the geometric middle of the band."""
    drive = example("two-piece-rubber-bearing")
    drive = replace(drive, duty=replace(drive.duty, speed_range=(700 * rpm, top * rpm)))
    one = next(v for v in check(drive, only=["half_critical"]) if v.advice and v.title.endswith("shaft 3 (rear piece)"))
    low, high = one.limit
    middle = 0.5 * (float(low) + float(high))
    assert float(one.value) == pytest.approx(middle if value == "half" else top * rpm)
    assert one.state == ("failed" if value == "half" else "passed")
    assert bool(one.note) == (value == "half")


@pytest.mark.parametrize("name", ["joint_angle_at_speed", "angle_table"])
def test_no_rule_allows_more_than_a_joint_can_bend(name):
    drive = Drive.from_angles([0.02, 0.02], yoke_angles=[0.0])
    slow, quick = (check(drive, Duty(speed=speed * rpm), only=[name])[0] for speed in (10.0, 3000.0))
    assert float(slow.limit) == pytest.approx(45 * deg)
    assert "reach no larger angle" in slow.note
    assert float(quick.limit) < 30 * deg
    assert not quick.note


def test_an_end_shaft_that_whirls_on_its_supports_is_judged_like_the_others():
    """The page on critical speeds and the limits say the same of it."""
    drive = example("overconstrained-pump")
    found = bending_speeds(drive)
    assert found.bowing is not None
    assert found.margin is not None
    assert found.bowing.number == 1
    real, computed, *_others = check(drive, only=["critical_speed"])
    assert (real.subject, real.state, real.advice) == ("shafts[0]", "unconfirmed", True)
    assert real.value == pytest.approx(found.margin.ratio)
    assert "49\u202f529 rpm, computed for the whole line" in told(computed.note, USUAL)


@pytest.mark.parametrize("path", ["shafts[0].outer_mm", "shafts[1].outer_mm"])
def test_end_shafts_of_many_drives_whirl_nearly_as_one_by_one(path):
    """The speed goes with a power of the size that is found from the line: 10 % change it to a third of a percent."""
    drive = example("overconstrained-pump")
    values = [share * read(drive, path) for share in (0.93, 1.1)]
    many = check(drive, only=["critical_speed"], vary={path: values})[0]
    ones = [check(with_values(drive, {path: one}), only=["critical_speed"])[0].value for one in values]
    assert many.value == pytest.approx(ones, rel=3e-3)
    assert many.note == "scaled from the speed of the drive as it is, computed for the whole line"
    assert many.value != pytest.approx(check(drive, only=["critical_speed"])[0].value, rel=3e-3)


@pytest.mark.parametrize(("wear", "said"), [(0.9, "0.9 of the 9\u202f418 rpm"), (1.0, "9\u202f418 rpm, computed")])
def test_a_critical_speed_says_whether_it_is_the_computed_one(wear, said):
    drive = with_values(example("car-propshaft"), {"shafts[1].wear_factor": wear})
    assert told(check(drive, only=["critical_speed"])[0].note, USUAL).startswith(said)


@pytest.mark.parametrize("name", ["tube_strength", "tube_fatigue", "twist", "critical_speed", "half_critical"])
def test_all_that_is_missing_is_named_at_once(name):
    """With what is named the check runs: nobody is asked for more in a second round."""
    lacking = {path for one in check(Drive.from_angles([0.1, 0.2]), only=[name]) for path in one.missing}
    material = {path.rpartition(".")[2] for path in lacking if "material" in path}
    shaft = {"number": 2}
    shaft |= {f"{name}_mm": size for name, size in (("outer", 60), ("length", 900)) if f"shafts[1].{name}" in lacking}
    if material:
        shaft["material"] = {f"{name}_MPa": 400 for name in sorted(material)}
    duty = {key: 300 for key in ("torque_Nm", "speed_rpm") if f"duty.{key.partition('_')[0]}" in lacking}
    text = json.dumps(
        {"format": 1, "joints": [{"joint_angle_deg": 5}, {"joint_angle_deg": 9}], "shafts": [shaft], "duty": duty}
    )
    assert len(lacking) == len(duty) + len(material) + ("outer_mm" in shaft) + ("length_mm" in shaft)
    assert all(one.run for one in check(loads(text, form="json"), only=[name]))


def test_rounding_makes_no_pose_the_worst():
    """A synchronous drive swings by the last digits alone, in whatever pose these are largest."""
    drive = example("rolling-mill-lower-spindle")
    asked = replace(drive, settings=replace(drive.settings, norm="spicer"))
    (turns,) = (one for one in check(asked, only=["acceleration"]) if "output" in one.title)
    assert turns.utilisation < 1e-15
    assert not turns.note


def test_the_lower_end_of_a_range_of_speeds_may_vary():
    drive = with_values(example("overconstrained-pump"), {"duty.speed_range_rpm": [1000.0, 40000.0]})
    path, values = "duty.speed_range_rpm[0]", [20000.0, 30000.0]
    many = check(drive, only=["half_critical"], vary={path: values})
    for k, value in enumerate(values):
        for a, b in zip(many, check(with_values(drive, {path: value}), only=["half_critical"]), strict=True):
            assert np.broadcast_to(a.value, 2)[k] == pytest.approx(b.value, rel=1e-12), a.title
