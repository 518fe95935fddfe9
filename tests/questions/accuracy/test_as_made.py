"""How a drive turns with errors as made: against the loops of its joints, stepped by hand, and one joint alone."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.reader import Reader
from cardan.checks.checks import check
from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.drive.duty import Limits
from cardan.questions.accuracy.accuracy import transmission_error
from cardan.questions.accuracy.as_made import as_made
from cardan.questions.gathering import gather
from cardan.questions.motion.motion import motion
from cardan.register import QUESTIONS
from cardan.report.answers import subject
from cardan.report.summary import uniformity
from cardan.units import deg


def made(joint_angles, **error):
    drive = Drive.from_angles([joint_angle * deg for joint_angle in joint_angles])
    return replace(drive, joints=(replace(drive.joints[0], error=Error(**error)), *drive.joints[1:]))


@pytest.mark.parametrize("joint_angles", [(20.0,), (10.0, 10.0), (8.0, 15.0, 7.0)])
def test_the_slope_is_that_of_the_loops_stepped_by_hand(joint_angles):
    drive = made(joint_angles, alpha1=0.2 * deg, alpha3=0.1 * deg)
    step, angle = 1e-4, np.linspace(0.0, 2.0 * np.pi, 3600, endpoint=False)

    def out(at):
        return motion(drive, at).shaft_angle[-1] + transmission_error(drive, at).error

    ratio = (out(angle + step) - out(angle - step)) / (2.0 * step)
    angle_error = out(angle) - angle
    found = as_made(drive)
    assert found.fluctuation == pytest.approx(np.ptp(ratio), rel=1e-5)  # steps of 0.1° and 1e-4 rad
    assert found.angle_error == pytest.approx(0.5 * np.ptp(angle_error), rel=1e-5)


def test_without_errors_it_is_the_closed_form_of_one_joint():
    found = as_made(made((20.0,), alpha1=0.0))
    alpha = 20 * deg
    assert found.fluctuation == pytest.approx(1.0 / np.cos(alpha) - np.cos(alpha), rel=1e-9)
    assert found.angle_error == pytest.approx(
        np.arctan(np.sin(0.5 * alpha) ** 2 * 2 / (2 * np.sqrt(np.cos(alpha)))), rel=1e-6
    )


def test_an_even_drive_with_errors_is_nowhere_told_to_be_exactly_even():
    drive = made((10.0, 10.0), alpha1=0.2 * deg)
    question = QUESTIONS["motion"]
    told = gather(question, drive, question.answer(drive, question.ask(drive)))
    assert told.sentence.told(Reader()).endswith("uniform but for the errors of its joints as made.")
    (figure,) = [key for key in told.keys if key.name == "speed_fluctuation_as_made"]
    assert figure.value.value == as_made(drive).fluctuation
    first = uniformity(subject(drive)).text
    assert "With the errors of its joints as made the speed fluctuation is 0.1231 %" in first
    assert "exactly" not in first


def test_the_checks_judge_the_output_as_made():
    drive = replace(
        made((10.0, 10.0), alpha1=0.2 * deg), limits=Limits(speed_fluctuation=0.001, output_error=0.1 * deg)
    )
    verdicts = {one.check: one for one in check(drive, only=["speed_fluctuation", "output_error"])}
    found = as_made(drive)
    assert float(verdicts["speed_fluctuation"].value) == found.fluctuation > 0.001
    assert float(verdicts["output_error"].value) == found.angle_error
    assert {one.note for one in verdicts.values()} == {"with the errors as made"}
