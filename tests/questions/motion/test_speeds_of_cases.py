"""A drive whose speeds stand in its load cases alone: no answer says that it has none."""

from dataclasses import replace

import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.duty import Case, Duty
from cardan.questions.gathering import gather
from cardan.questions.motion.turning import each_shaft
from cardan.register import QUESTIONS
from cardan.report.report import page
from cardan.units import deg, rpm


@pytest.mark.slow
def test_accelerations_are_told_at_the_speeds_of_the_cases_and_not_over_a_square():
    cases = (Case(name="mean", torque=220.0, speed=2500 * rpm, share=1.0), Case(name="peak", torque=900.0, speed=94.0))
    drive = replace(Drive.from_angles([5 * deg, 12 * deg]), duty=Duty(cases=cases))
    question = QUESTIONS["motion"]
    keys = {one.name: one for one in gather(question, drive, question.answer(drive, question.ask(drive))).keys}
    assert "relative_acceleration" not in keys
    most = float(each_shaft(drive).max_acceleration[-1]) * (2500 * rpm) ** 2
    assert abs(keys["acceleration"].value.value / most - 1.0) < 1e-9
    assert "mean" in told(keys["acceleration"].place, USUAL)
    assert "No input speed" not in page(drive)
    assert "No input speed" in page(replace(drive, duty=Duty()))
