"""Figures of strength and sizing: bars are the utilisations, tubes stand where they weigh, both renderers draw them."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import Drive, figures
from cardan.answers.reader import USUAL
from cardan.checks.strength.figure import uses_figure
from cardan.checks.strength.strength import strength
from cardan.choices.sizing import size
from cardan.choices.trade_off import trade_off
from cardan.drive.duty import Duty
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft
from cardan.figures.figure import Bars, Curve
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.units import mm, rpm

TUBE = Shaft(number=2, outer=70 * mm, wall=2.5 * mm, length=1.2, material=Material(grade="C45"))
DRIVE = replace(Drive.from_angles([0.2, 0.2]), shafts=(TUBE,), duty=Duty(torque=900.0, speed=2000 * rpm))


def drawn(figure):
    figure = for_reader(figure, USUAL)
    assert figure.sentence.endswith("" if figure.name == "strength" else ".")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]


def test_bars_are_what_is_used_from_the_most():
    found = strength(DRIVE)
    bars, tired = figures.for_result(found)
    drawn(bars)
    drawn(tired)
    (shown,) = [item for item in bars.panels[0].series if isinstance(item, Bars)]
    np.testing.assert_allclose(shown.size, 100 * np.sort([one.utilisation for one in found.judged])[::-1])
    point = [item for item in tired.panels[0].series if isinstance(item, Curve)][-1]
    assert 1.0 / float(point.x[0] + point.y[0]) == pytest.approx(float(found.shafts[1].fatigue.safety))


def test_what_the_bars_leave_out_is_said():
    found = strength(example("car-propshaft"))
    figure = for_reader(uses_figure(found), USUAL)
    assert f"the 16 most utilised of {len(found.judged)} checks" in figure.source
    assert "grey: limits that nothing confirms; grey: rules of thumb" in figure.source
    (bars,) = [one for one in figure.rows[0].panels[0].series if isinstance(one, Bars)]
    worst = sorted(found.judged, key=lambda one: -float(one.utilisation))[: len(bars.roles)]
    assert [role for role, one in zip(bars.roles, worst, strict=True) if one.state == "unconfirmed"]
    assert all((role == "muted") >= (one.state == "unconfirmed") for role, one in zip(bars.roles, worst, strict=True))
    assert "rules of thumb" not in for_reader(uses_figure(strength(DRIVE)), USUAL).source


def test_a_drive_that_says_nothing_has_a_figure_too():
    (figure,) = figures.for_result(strength(Drive.from_angles([0.1]), Duty(torque=1.0)))
    drawn(figure)


def test_tubes_stand_where_they_weigh():
    found = trade_off(DRIVE, None, 2)
    (figure,) = figures.for_result(found)
    drawn(figure)
    for panel in figure.panels:
        assert len([item for item in panel.series if isinstance(item, Curve)]) == len(found.wall) + 2
    here = [item for item in figure.panels[0].series if isinstance(item, Curve)][-1]
    assert (here.x[0], here.y[0]) == (found.now[2], 100 * found.now[3])


@pytest.mark.slow
@pytest.mark.parametrize("part", ["tube:2", "joint"])
def test_a_sized_part_is_drawn(part):
    found = size(DRIVE, None, part)
    (figure,) = figures.for_result(found)
    drawn(figure)
    (shown,) = [item for item in figure.panels[0].series if isinstance(item, Bars)]
    assert shown.size.size == len(found.tried or found.made)
