"""What is said of a design for least torsional vibration: the numbers of the search, for any reader."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.choices.torsion_design import ask
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.io import loads
from cardan.questions.torsion.optimise.answer import answer, lacking, otherwise, reasons
from cardan.questions.torsion.optimise.optimise import Grid, Worst, optimise_torsion
from cardan.questions.torsion.stability.torsion_stability import stability
from cardan.report.block import page
from cardan.texts import speaking
from cardan.units import deg

DRIVE = replace(
    Drive.from_angles([14 * deg, 14 * deg], plane_twists=[25 * deg]),
    shafts=(Shaft(number=2, stiffness=5000.0, damping=2.0, inertia=0.02),),
    stations=(Station(shaft=3, name="pump", inertia=0.8),),
    duty=Duty(torque=60.0, speed_range=(30.0, 60.0)),
)
YOKE = "shafts[1].yoke_angle_deg"


@pytest.fixture(scope="module")
def found():
    return optimise_torsion(DRIVE, free={YOKE: (-60.0, 20.0)}, method=Grid(points=3))


@pytest.mark.slow
def test_values_and_torques_are_those_of_the_search(found):
    said = answer(DRIVE, found)
    assert told(said.sentence, USUAL).startswith("the largest alternating torque falls from ±")
    values, peaks = said.tables
    assert list(values.columns[2].values) == [found.values[YOKE]]
    assert next(one for one in peaks.columns if one.key == "after").values == [found.peak_after.torque]
    assert page(said, USUAL).blocks


@pytest.mark.slow
def test_within_tolerances_too_nothing_falls_to_what_it_was(found):
    worst = Worst(torque=50.0, speed=40.0, element=0, unstable=False, sides=())
    for after, begins in ((49.9, "within its tolerances nothing that may change"), (20.0, "within its tolerances the")):
        better = replace(found, worst_before=worst, worst_after=replace(worst, torque=after))
        said = answer(DRIVE, better)
        assert told(said.sentence, USUAL).startswith(begins)
        assert (said.tone == "warning") is (after > 40.0)


@pytest.mark.slow
def test_the_joints_say_why(found):
    said = [told(one, USUAL) for one in reasons(found)]
    assert said[1] == "Joint 1 stands in the node of the mode: it causes no parametric excitation."
    assert any("residual" in one or "in-phase sum" in one for one in said)
    assert data(answer(DRIVE, found), USUAL)["why"] == said


def test_readers_are_told_in_their_units_and_language(found):
    pounds = Reader(units={"torque": "lbft"}, decimal=",")
    content = data(answer(DRIVE, found), pounds)
    lbft = 12 * 0.0254 * 0.45359237 * 9.80665
    assert content["after"]["alternating_torque_lbft"] == pytest.approx(found.peak_after.torque / lbft)
    assert content["history_lbft"][0][-1] == pytest.approx(found.history[0][-1] / lbft)
    assert "lbf·ft" in told(answer(DRIVE, found).sentence, pounds)
    with speaking("ru"):
        assert "об/мин" in told(answer(DRIVE, found).sentence, USUAL)


def test_speeds_and_something_that_twists_are_asked_for():
    assert not lacking(DRIVE)
    assert lacking(replace(DRIVE, duty=Duty(torque=60.0))) == (("duty.speed_range", "duty.speed"),)
    assert lacking(Drive.from_angles([0.2, 0.2]))[0] == ("stations", "shafts[1].stiffness")


def test_a_drive_whose_yokes_are_fixed_is_told_so():
    assert ask(replace(DRIVE, shafts=(replace(DRIVE.shafts[1], yoke_fixed=True),))) is None
    assert "--free" in otherwise(DRIVE)


SWUNG = """
format = 1
joints = [{ joint_angle_deg = 25 }, { joint_angle_deg = 25 }]
shafts = [
  { number = 2, length_mm = 300, yoke_angle_deg = 10, stiffness_Nm_per_rad = 4000, damping_Nms_per_rad = 0.3 },
]
stations = [{ shaft = 1, inertia_kg_m2 = 0.2 }, { shaft = 3, inertia_kg_m2 = 0.2 }]
duty = { input = "free", torque_Nm = 200, speed_rpm = 1909.8593 }
"""


@pytest.mark.slow
def test_a_drive_that_is_cured_of_instability_is_told_so_and_is():
    """What is told of it as built is the motion from which vibration grows, so nothing "falls" from there."""
    drive = loads(SWUNG)
    found = optimise_torsion(drive)
    said = answer(drive, found)
    told_of = [told(one.text, USUAL) for one in said.remarks]
    assert said.tone == "warning"  # nothing is known a little beside this speed
    assert told(said.sentence, USUAL).startswith("unstable as built, no more so with the best values; largest")
    assert any(one.startswith("As built the drive is unstable at 1\u202f910 rpm") for one in told_of)
    assert any(one.startswith("Stability was judged at 1\u202f910 rpm alone") for one in told_of)
    assert float(stability(drive).growth_rate) > 5.0
    assert float(stability(found.drive).growth_rate) < 1e-3


@pytest.mark.slow
def test_a_drive_that_nothing_makes_stable_is_told_so():
    drive = loads(SWUNG)
    found = optimise_torsion(drive, free={YOKE: (0.0, 40.0)}, method=Grid(points=3))
    said = answer(drive, found)
    assert said.tone == "warning"
    assert told(said.sentence, USUAL).startswith("the best values found do not make it stable everywhere; largest")
    worst = Worst(torque=50.0, speed=40.0, element=0, unstable=True, sides=())
    within = answer(drive, replace(found, worst_before=worst, worst_after=replace(worst, torque=90.0)))
    assert told(within.sentence, USUAL).startswith("within its tolerances, unstable as built, the largest")
    assert within.tone == "warning"
