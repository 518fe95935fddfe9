"""Checks of torsional vibration along a movement agree with each other: what one finds there no other passes."""

from dataclasses import replace

import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks.checks import check
from cardan.checks.strength.answer import answer, ask
from cardan.io import loads

NODDING = """
format = 1
[[joints]]
joint_angle_deg = 4
[[joints]]
joint_angle_deg = 4
[[shafts]]
number = 2
length_mm = 900
outer_mm = 60
wall_mm = 3
loss_factor = 0.02
material = { yield_strength_MPa = 355, ultimate_strength_MPa = 490 }
[[stations]]
shaft = 1
inertia_kg_m2 = 0.9
[[stations]]
shaft = 3
inertia_kg_m2 = 0.4
[duty]
speed_rpm = 1450
torque_Nm = 200
[[movements]]
name = "nod"
kind = "harmonic"
moves = ["joints[1]", "output"]
amplitude_mm = [0, 0, 90]
frequency_Hz = 0.2
"""
"""A drive that nods into resonance: as drawn its torque alternates by a tenth, at 3.75 s by forty times its mean."""

ASKED = ("torsional_resonance", "gap_closure", "torque_reversal")


@pytest.mark.slow
def test_alternating_torque_and_gaps_are_judged_where_the_torque_turns_about():
    drive = loads(NODDING)
    found = {(one.check, one.subject): one for one in check(drive, only=ASKED)}
    swing, dip = found["torsional_resonance", "shafts[1]"], found["torque_reversal", "shafts[1]"]
    assert swing.state == "failed"
    assert "while the drive moves, at 3.75 s" in told(swing.note, USUAL)
    # half the range of a torque that is nearly a sine is its dip below the mean
    assert float(swing.value) == pytest.approx(float(dip.value), rel=0.01)
    gaps = found["gap_closure", ""]
    assert (gaps.state, "turns about" in gaps.unfit) == ("not_run", True)
    clear = found["torsional_resonance", ""]
    assert "as drawn" in told(clear.note, USUAL)
    drawn = {(one.check, one.subject): one for one in check(replace(drive, movements=()), only=ASKED)}
    assert drawn["torsional_resonance", "shafts[1]"].state == drawn["gap_closure", ""].state == "passed"


@pytest.mark.slow
def test_strength_says_that_its_tables_are_of_the_drive_as_drawn():
    for drive, moves in ((loads(NODDING), True), (replace(loads(NODDING), movements=()), False)):
        said = answer(drive, ask(drive))
        notes = [told(one.note, USUAL) for one in said.tables if one.name == "shafts"]
        assert [one.startswith("Largest over the turn of the drive as drawn") for one in notes] == [moves]
        counted = [told(one.text, USUAL) for one in said.remarks if "vibration is counted" in told(one.text, USUAL)]
        assert ["rpm, as drawn, the torque in" in one for one in counted] == [moves]
