"""Figures of forces over a movement: the largest of every turn, as the analysis has them."""

from dataclasses import replace

import numpy as np
import pytest

from cardan import figures
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.movement import Hitch
from cardan.figures.figure import Curve
from cardan.io import example
from cardan.questions.forces.moving_forces import moving_forces
from cardan.units import deg
from tests.questions.forces.figures.test_forces import drawn

PTO = example("pto-spline-thrust")
SWING = Hitch(
    moves=("joints[1]", "output"), pivot=(0.47, 0.0, -0.3), yaw=20 * deg, pitch=4 * deg, frequency=2 * np.pi * 0.5
)


def curves(panel):
    return [item for item in panel.series if isinstance(item, Curve)]


@pytest.mark.parametrize("frequency", [0.5, 5.0], ids=["many turns", "few turns"])
def test_both_renderers_draw_them(frequency):
    found = moving_forces(PTO, None, [replace(SWING, frequency=2 * np.pi * frequency)])
    made = figures.for_result(found)
    assert [figure.name for figure in made] == ["moving-reactions", "moving-torques"]
    for figure in made:
        drawn(figure)


def test_a_curve_is_the_largest_of_every_turn():
    found = moving_forces(PTO, None, [SWING])
    reactions, torques = figures.for_result(found)
    radial = curves(reactions.panels[0])
    for k, curve in enumerate(radial):
        np.testing.assert_array_equal(curve.y, found.each_turn(found.forces.radial[k])[1])
        np.testing.assert_array_equal(curve.x, found.turn_times)
    low, high = found.each_turn(found.forces.shaft_torque[1])
    upper, lower = curves(torques.panels[0])[2:4]
    np.testing.assert_array_equal(upper.y, high)
    np.testing.assert_array_equal(lower.y, low)
    assert reactions.sentence == ""  # the answer has said it
    assert told(torques.sentence, USUAL).startswith("The secondary couple is largest on shaft 2")


def test_without_supports_there_are_torques_alone():
    found = moving_forces(replace(PTO, supports=()), None, [SWING])
    assert [figure.name for figure in figures.for_result(found)] == ["moving-torques"]
