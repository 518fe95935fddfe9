"""Figures of forces of assembly: the numbers of the analysis, both renderers."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.figures.figure import Curve
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.maths.kernel import frames
from cardan.questions.forces.assembly import assembly
from cardan.questions.forces.figures.assembly import misalignment_figure

PUMP = example("overconstrained-pump")


def curves(panel):
    return [item for item in panel.series if isinstance(item, Curve)]


@pytest.mark.parametrize("name", ["overconstrained-pump", "truck-supports"])
@pytest.mark.parametrize("angle", [None, [0.5]])
def test_both_renderers_draw_them(name, angle):
    for figure in figures.for_result(assembly(example(name), angle=angle)):
        assert figure.sentence == ""  # the answer says it
        assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
        assert described(figure)["data"]


def test_curves_are_those_of_the_analysis():
    found = assembly(PUMP)
    radial, axial, joint = misalignment_figure(found).panels
    for k in range(4):
        np.testing.assert_array_equal(curves(radial)[k].y, found.radial[k])
    # Supports 1 and 4 alone hold lengthwise.
    np.testing.assert_array_equal([one.y for one in curves(axial)], found.axial[[0, 3]])
    np.testing.assert_array_equal(curves(joint)[0].y, frames.norm(found.joint_force[0]))


def test_curves_of_supports_have_the_colours_of_their_shafts():
    found = assembly(PUMP)
    assert found.support_shaft == (1, 1, 2, 2)
    assert [one.role for one in curves(misalignment_figure(found).panels[0])] == [
        "shaft 1",
        "shaft 1",
        "shaft 2",
        "shaft 2",
    ]
