"""Figures of lives: the duty's point lies on its curve, bars are what the parts do, both renderers draw them."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.reader import USUAL
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty, History
from cardan.drive.joint_parts import Needles, Rating
from cardan.drive.joints import Hooke
from cardan.figures.figure import Bars, Curve
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.questions.life.figure import SHOWN, history_figure, methods_figure, parts_figure
from cardan.questions.life.life import life
from cardan.units import hour

JOINTS = tuple(
    Hooke(joint_angle=joint_angle, cross=Cross(span=0.08), needles=Needles(capacity=20e3), rating=Rating(torque=1000.0))
    for joint_angle in (0.1, 0.2)
)
DRIVE = Drive(joints=JOINTS)


def drawn(figure, sentence=True):
    """Draw a figure; where its answer says what it shows, it needs no sentence of its own."""
    figure = for_reader(figure, USUAL)
    assert figure.sentence.endswith("." if sentence else "")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]


def series(figure, kind):
    return [item for panel in figure.panels for item in panel.series if isinstance(item, kind)]


@pytest.mark.parametrize("demanded", [None, 100 * hour, 1e6 * hour])
def test_the_duty_lies_on_the_curve_of_the_joint_that_fails_first(demanded):
    found = life(DRIVE, Duty(speed=100.0, torque=400.0, life=demanded))
    figure, methods = figures.for_result(found)
    drawn(figure, sentence=demanded is not None)
    drawn(methods, sentence=False)
    *curves, point = series(figure, Curve)
    assert len(curves) == 2
    first = curves[found.governing - 1]
    assert np.interp(100.0, first.x, np.log(first.y)) == pytest.approx(np.log(point.y[0]), rel=1e-12)
    assert (first.x[0], first.y[0]) == pytest.approx((50.0, 2 ** (10 / 3) * found.drive / hour))


def test_bars_are_the_lives_by_each_method():
    found = life(DRIVE, Duty(speed=100.0, torque=400.0, life=100 * hour))
    (bars,) = series(methods_figure(found), Bars)
    i = found.governing - 1
    wanted = [found.combined(one)[i] for one in (found.driving, found.driven, found.simple, found.maker, found.book)]
    np.testing.assert_allclose(bars.size, np.asarray([*wanted, 100 * hour]) / hour)


def test_parts_are_told_by_time_and_damage():
    blocks = tuple(Block(torque=100.0 + 10.0 * k, speed=50.0, share=1 / 20) for k in range(20))
    found = life(DRIVE, Duty(blocks=blocks))
    for figure in figures.for_result(found):
        drawn(figure, sentence=figure.name not in ("life", "life-methods"))
    time, damage = series(parts_figure(found), Bars)
    assert len(time.size) == SHOWN
    assert damage.size[0] == pytest.approx(100.0 * found.damage[-1, found.governing - 1])
    few = life(DRIVE, Duty(blocks=(Block(torque=1.0, speed=1.0, share=0.4), Block(torque=2.0, speed=1.0, share=0.6))))
    for bars in series(parts_figure(few), Bars):
        assert np.sum(bars.size) == pytest.approx(100.0)


def test_a_measured_torque_is_a_histogram():
    history = History(file="x.csv", times=(0.0, 1.0, 3.0), torques=(-100.0, 500.0, 200.0))
    found = life(DRIVE, Duty(speed=100.0, torque_history=history))
    for figure in figures.for_result(found):
        drawn(figure, sentence=figure.name not in ("life", "life-methods"))
    for bars in series(history_figure(found), Bars):
        assert np.sum(bars.size) == pytest.approx(100.0)


def test_what_nothing_wears_is_drawn_too():
    (figure,) = figures.for_result(life(DRIVE, Duty(speed=100.0, torque=0.0)))
    drawn(figure)
    assert "No joint is damaged" in figure.sentence
