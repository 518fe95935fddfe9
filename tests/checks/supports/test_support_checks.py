"""Verdicts on the bearings of supports: against the closed forms of one joint, and what is said where they lack."""

import math
from dataclasses import replace

import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.drive.drive import Drive
from cardan.drive.duty import Case, Duty
from cardan.drive.movement import Harmonic
from cardan.drive.settings import Pose
from cardan.drive.support import Support
from cardan.questions.life.life import life
from cardan.units import deg, hour, rpm

PLACE, TORQUE, ALPHA = 0.2, 800.0, 20 * deg
NAMES = ("support_life", "support_static", "support_speed")
DUTY = Duty(torque=TORQUE, speed=1000 * rpm, life=1000 * hour)
SUPPORTS = (
    Support(shaft=1, position=-0.1, axial=True),
    Support(shaft=1, position=-0.3),
    Support(name="centre", shaft=2, position=PLACE, bearing="6207-2RS"),
)


def single(duty=DUTY, **fields):
    return replace(Drive.from_angles([ALPHA]), **{"supports": SUPPORTS, "duty": duty} | fields)


def judged(drive, **given):
    return {one.check: one for one in check(drive, only=NAMES, **given)}


def test_the_life_is_that_of_the_question():
    found = judged(single())
    assert [one.subject for one in found.values()] == ["supports[2]"] * 3
    assert found["support_life"].title == "life of the bearing of support 3 (centre)"
    load = TORQUE * math.tan(ALPHA) / PLACE
    by_hand = 1e6 * 60 / 1000 * (25.7e3 / load) ** 3 * 3 * math.pi / 4
    assert found["support_life"].value == pytest.approx(by_hand, rel=1e-9)
    short = judged(single(duty=replace(DUTY, life=1.01 * by_hand)))
    assert (found["support_life"].state, short["support_life"].state) == ("passed", "failed")


def test_the_largest_load_counts_the_peaks_of_the_duty_and_of_poses():
    shunt = Case(name="shunt", torque=6 * TORQUE, speed=100 * rpm, shock_factor=1.5)
    found = judged(single(duty=replace(DUTY, cases=(shunt,))))["support_static"]
    load = 9 * TORQUE * math.tan(ALPHA) / PLACE
    assert found.value == pytest.approx(load, rel=1e-9)
    assert found.limit == 15.3e3
    assert told(found.note, USUAL) == "decided by shunt"
    assert (found.state, found.utilisation > 0.85) == ("passed", True)
    steep = Pose(name="turned", set=(("joints[0].joint_angle_deg", 35.0),))
    posed = judged(single(duty=replace(DUTY, cases=(shunt,)), poses=(steep,)))["support_static"]
    assert posed.value == pytest.approx(9 * TORQUE * math.tan(35 * deg) / PLACE, rel=1e-9)
    assert posed.state == "failed"


@pytest.mark.slow
def test_the_load_counts_the_movement():
    base = Drive.from_points([(-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, 0.1)])
    still = replace(base, supports=SUPPORTS, duty=DUTY)
    rise = Harmonic(moves=("output",), amplitude=(0.0, 0.0, 0.1), frequency=0.1)
    value = judged(replace(still, movements=(rise,)))["support_static"].value
    assert value == pytest.approx(TORQUE * 0.4 / PLACE, rel=5e-3)  # in steps of 5° of 167 turns
    assert judged(still)["support_static"].value == pytest.approx(TORQUE * 0.2 / PLACE, rel=1e-9)


def test_contact_seals_cost_speed():
    fast = replace(DUTY, speed=8000 * rpm)
    sealed = judged(single(duty=fast))["support_speed"]
    assert (sealed.state, sealed.limit / rpm) == ("failed", pytest.approx(6300.0))
    plain = (*SUPPORTS[:2], replace(SUPPORTS[2], bearing="6207"))
    assert judged(single(duty=fast, supports=plain))["support_speed"].state == "passed"
    swept = judged(single(), vary={"duty.speed_rpm": [1000.0, 6300.0, 6400.0]})["support_speed"]
    assert list(swept.passed) == [True, True, False]


def test_what_lacks_is_named():
    bare = judged(single(duty=Duty()))
    assert bare["support_life"].missing == ("duty.life", "duty.torque", "duty.speed")
    assert bare["support_static"].missing == ("duty.torque",)
    assert bare["support_speed"].missing == ("duty.speed",)
    assert judged(single(supports=SUPPORTS[:2])) == {}
    bound = judged(single(supports=(*SUPPORTS, Support(shaft=2, position=0.3))))
    assert all("their forces are not known" in bound[name].unfit for name in NAMES[:2])
    many = judged(single(), vary={"duty.torque_Nm": [800.0, 900.0]})
    assert all("one drive at a time" in many[name].unfit for name in NAMES[:2])
    lives = judged(single(), vary={"duty.life_h": [10.0, 1e7]})["support_life"]
    assert list(lives.passed) == [True, False]


def test_a_drive_of_supports_alone_lasts_as_they_do():
    drive = single()
    found = judged(drive)["support_life"].value
    rated = (*SUPPORTS[:2], replace(SUPPORTS[2], capacity=25.7e3, static_capacity=15.3e3))
    assert found == life(replace(drive, supports=rated)).drive


def test_the_speed_under_a_lip_is_half_the_diameter_times_the_speed():
    sealed = (*SUPPORTS[:2], replace(SUPPORTS[2], seal="40x62x8", seal_diameter=0.04, max_lip_speed=2.0))
    found = {one.check: one for one in check(single(supports=sealed), only=("seal_speed",))}["seal_speed"]
    assert found.value == pytest.approx(math.pi * 0.04 * 1000 / 60, rel=1e-12)
    assert (found.subject, found.state, found.limit) == ("supports[2]", "failed", 2.0)
    assert found.title == "speed under the seals of support 3 (centre)"
    assert [one.missing for one in check(single(duty=Duty(), supports=sealed), only=("seal_speed",))] == [
        ("duty.speed",)
    ]
    swept = check(single(supports=sealed), only=("seal_speed",), vary={"duty.speed_rpm": [900.0, 1000.0]})
    assert list(swept[0].passed) == [True, False]
    assert not check(single(), only=("seal_speed",))
