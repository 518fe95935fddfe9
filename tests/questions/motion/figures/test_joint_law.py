"""Figures of joints by themselves hold their curves, and both renderers draw them."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan.answers.reader import USUAL
from cardan.drive.joints import Hooke
from cardan.figures.figure import Curve
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.joints import DoubleCardan, Tripod
from cardan.questions.motion.figures.joint_law import joint_figure
from cardan.questions.motion.joint_law import joint_over_angles, joint_turn
from cardan.units import deg

JOINTS = (Hooke(), DoubleCardan(centring_ratio=0.5), Tripod())


@pytest.mark.parametrize("joints", [JOINTS[:1], JOINTS[2:], JOINTS[1:], (JOINTS[2], JOINTS[2])], ids=len)
def test_both_renderers_draw_them(joints):
    turns, joint_angles = [joint_turn(one, 30 * deg) for one in joints], [joint_over_angles(one) for one in joints]
    figure = for_reader(joint_figure(turns, joint_angles), USUAL)
    assert figure.sentence.endswith(".")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]
    assert len(figure.entries) == len({one.kind for one in joints})


def test_the_curves_are_those_of_the_law():
    turns, joint_angles = [joint_turn(one, 30 * deg) for one in JOINTS], [joint_over_angles(one) for one in JOINTS]
    figure = for_reader(joint_figure(turns, joint_angles, ("one", "two", "three")), USUAL)
    for panel, wanted in zip(
        figure.panels,
        (
            [one.angle_error / deg for one in turns],
            [one.ratio for one in turns],
            [one.error / deg for one in joint_angles],
        ),
        strict=True,
    ):
        curves = [item for item in panel.series if isinstance(item, Curve)]
        for curve, values in zip(curves, wanted, strict=True):
            np.testing.assert_array_equal(curve.y, values)
        assert all(panel.y.low <= np.min(one) <= np.max(one) <= panel.y.high for one in wanted)
    assert "one has the largest angle error, ±4.12°" in figure.sentence
    assert [entry.label for entry in figure.entries] == ["one", "two", "three"]
