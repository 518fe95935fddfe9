"""Critical speeds while a spline slides: at the instant where a shaft is longest, or a held speed meets half of one.

The truth beside them is the uniform tube between two hinges, and the drive drawn as it stands at very many instants.
"""

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks.checks import check
from cardan.drive.conditions import in_poses
from cardan.drive.duty import Case, Duty
from cardan.drive.material import Material
from cardan.drive.movement import Harmonic
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.formulas.critical_speed import uniform_speed
from cardan.questions.bending.bending import bending_speeds, length_powers
from cardan.questions.gathering import gather
from cardan.questions.motion.moving_points import default_times
from cardan.questions.motion.standing import still
from cardan.register import QUESTIONS

STEEL = Material(youngs=2.1e11, density=7850.0)
TUBE = {"outer": 0.06, "inner": 0.055, "material": STEEL}
LENGTH, STROKE, PERIOD = 1.2, 0.15, 0.5


def sliding(speed, **fields):
    """Return a telescopic shaft whose far joint moves along it: as drawn it is `LENGTH` long."""
    line = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (LENGTH, 0, 0), (LENGTH + 0.3, 0, 0)])
    swing = Harmonic(moves=("joints[1]", "output"), amplitude=(STROKE, 0.0, 0.0), frequency=2.0 * np.pi / PERIOD)
    return replace(
        line,
        shafts=(Shaft(number=2, spline=Spline(), **TUBE),),
        movements=(swing,),
        duty=Duty(speed=speed),
        **fields,
    )


def closed(length):
    """Return the first critical speed of the tube between two hinges, 0.9 of it with a spline [rad/s]."""
    found = uniform_speed(length, TUBE["outer"], TUBE["inner"], STEEL.youngs, STEEL.density, modes=1)
    return 0.9 * float(np.ravel(found)[0])


def verdicts(drive, name):
    return {one.title: one for one in check(drive, only=[name]) if one.run}


def worst(drive, name, count=21):
    """Return the largest use of each limit at very many instants, each judged as a drive that stands so."""
    every = default_times(drive.movements)
    found = {}
    for time in np.linspace(every[0], every[-1], count):
        for title, one in verdicts(still(drive, float(time)), name).items():
            found[title] = max(found.get(title, 0.0), float(one.utilisation))
    return found


def test_a_shaft_whirls_at_the_speed_of_its_longest():
    speed = closed(LENGTH) / 1.7
    drive = sliding(speed)
    margin = verdicts(drive, "critical_speed")["margin n_crit/n of shaft 2, real"]
    # The elements know shear and rotary inertia, (π r/L)²(E/κG - 1)/2 = 0.5 % of the closed form, which lacks them.
    assert margin.value * speed == pytest.approx(closed(LENGTH + STROKE), rel=6e-3)
    assert margin.value == pytest.approx(bending_speeds(still(drive, 0.25 * PERIOD)).actual[0] / speed, rel=1e-6)
    assert margin.state == "failed"
    assert verdicts(replace(drive, movements=()), "critical_speed")[margin.title].state != "failed"
    assert "at 0.125 s" in told(margin.note, USUAL)


def test_the_question_and_the_check_tell_one_speed_and_one_instant():
    drive = sliding(closed(LENGTH) / 1.7)
    question = QUESTIONS["bending"]
    said = gather(question, drive, question.answer(drive, question.ask(drive)))
    (key,) = [one for one in said.keys if one.name == "critical_speed"]
    margin = verdicts(drive, "critical_speed")["margin n_crit/n of shaft 2, real"]
    assert key.value.value == pytest.approx(margin.value * drive.duty.speed, rel=1e-9)
    assert "at 0.125 s of the movement" in told(key.place, USUAL)
    assert not [one for one in said.remarks if one.code == "outermost"]


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.0, 0.4, 0.8])
def test_a_speed_met_half_way_by_half_the_critical_speed_fails(share):
    """Half of it passes the speed held between drawn and longest, and both ends may keep clear of it."""
    met = 0.5 * closed(LENGTH + share * STROKE)
    drive = sliding(met)
    found = verdicts(drive, "half_critical")
    dense = worst(drive, "half_critical")
    for title, use in dense.items():
        # What is told holds at an instant; no other is worse, but for the power law that finds it.
        assert use <= float(found[title].utilisation) * (1.0 + 2e-3), title
    assert found["clearance from half critical speed, shaft 2"].state == "failed"
    question = QUESTIONS["bending"]
    assert gather(question, drive, question.answer(drive, question.ask(drive))).tone == "failed"


def test_a_verdict_reached_in_a_pose_alone_counts():
    """As drawn the speed is far below; pulled out the shaft comes within 20 % of its critical speed."""
    pulled = Pose(name="pulled", set=(("joints[1].centre_mm", (1900.0, 0, 0)), ("output.point_mm", (2200.0, 0, 0))))
    drive = replace(sliding(0.9 * closed(1.9)), movements=(), poses=(pulled,))
    title = "clearance from the critical speed, shaft 2"
    assert title not in verdicts(replace(drive, poses=()), "critical_speed")
    one = verdicts(drive, "critical_speed")[title]
    assert one.state == "failed"
    assert told(one.note, USUAL).count("in the pose pulled") == 1
    there = in_poses(drive)[1].drive
    assert one.utilisation == pytest.approx(verdicts(there, "critical_speed")[title].utilisation, rel=1e-12)


def test_a_bounce_follows_the_length_of_the_line():
    """A soft centre bearing before a sliding rear shaft: its mode as judged at 200 instants."""
    line = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.1, 0, 0), (2.4, 0, 0), (2.7, 0, 0)])
    swing = Harmonic(moves=("joints[2]", "output"), amplitude=(0.2, 0.0, 0.0), frequency=2.0 * np.pi)
    drive = replace(
        line,
        shafts=(Shaft(number=2, **TUBE), Shaft(number=3, spline=Spline(), **TUBE)),
        supports=(Support(shaft=2, position=1.0, stiffness=1e5),),
        movements=(swing,),
        duty=Duty(speed_range=(10.0, 150.0), cases=(Case(name="road", torque=1.0, speed=150.0),)),
    )
    for name in ("critical_speed", "half_critical"):
        found, dense = verdicts(drive, name), worst(drive, name, 13)
        assert set(found) >= set(dense)
        for title, use in dense.items():
            assert use <= float(found[title].utilisation) * (1.0 + 2e-3), title


def test_powers_of_length_are_those_of_the_line_drawn_longer():
    drive = replace(sliding(100.0), movements=())
    (power,) = length_powers(drive, 3)
    assert power[0] == pytest.approx(-2.0, abs=0.02)  # of a tube between hinges, but for shear
    for k, one in enumerate(power):
        longer = Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1.01 * LENGTH, 0, 0), (LENGTH + 0.3, 0, 0)])
        ratio = bending_speeds(replace(longer, shafts=drive.shafts)).speed[k] / bending_speeds(drive).speed[k]
        assert ratio == pytest.approx(1.01**one, rel=1e-4)


def test_many_drives_are_judged_while_they_move_as_one_by_one():
    drive, wide = sliding(closed(LENGTH) / 1.7), [58.0, 60.0, 64.0]
    title = "margin n_crit/n of shaft 2, real"
    path = "shafts[1].outer_mm"
    (many,) = [one for one in check(drive, only=["critical_speed"], vary={path: wide}) if one.title == title]
    for outer, value in zip(wide, many.value, strict=True):
        shaft = replace(drive.shafts[1], outer=outer / 1000.0)
        one = verdicts(replace(drive, shafts=(drive.shafts[0], shaft, drive.shafts[2])), "critical_speed")[title]
        assert value == pytest.approx(one.value, rel=5e-3)  # the batch scales the line by the tube alone
