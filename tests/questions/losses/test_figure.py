"""Figures of losses: all that is lost is in the bars, both renderers draw them."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.figures.figure import Bars, Curve
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.questions.losses.figure import LONG, SHOWN, loss_figure, loss_parts, map_figure
from cardan.questions.losses.losses import loss_map, losses
from cardan.units import rpm

TRUCK = example("truck-supports")


def drawn(figure):
    figure = for_reader(figure, USUAL)
    assert not figure.sentence or figure.sentence.endswith(".")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]


def bars(figure):
    (found,) = [item for panel in figure.panels for item in panel.series if isinstance(item, Bars)]
    return found


@pytest.mark.parametrize("name", ["truck-supports", "pto-spline-thrust"])
def test_bars_are_the_parts_from_the_largest_and_hold_all_that_is_lost(name):
    found = losses(example(name))
    (figure,) = figures.for_result(found)
    drawn(figure)
    size = bars(figure).size
    assert np.all(np.diff(size) <= 0.0)
    assert np.sum(size) == pytest.approx(found.heat, rel=1e-12)


def test_curves_are_those_of_the_joints():
    found = losses(TRUCK)
    curves = [item for item in loss_figure(found).panels[1].series if isinstance(item, Curve)]
    for curve, row in zip(curves, found.joint_power, strict=True):
        np.testing.assert_array_equal(curve.y, row)


def test_many_parts_share_the_last_bar():
    joint = TRUCK.joints[0]
    many = Drive(joints=tuple(Hooke(joint_angle=0.1, friction=0.02, cross=joint.cross) for _number in range(15)))
    found = losses(many, Duty(speed=100.0, torque=100.0))
    figure = loss_figure(found)
    drawn(figure)
    assert len(bars(figure).size) == SHOWN
    assert np.sum(bars(figure).size) == pytest.approx(found.heat, rel=1e-12)
    assert "4 other parts" in figure.panels[0].y.texts


def test_a_locked_drive_and_a_straight_one_are_drawn():
    joint = replace(TRUCK.joints[2], friction=40.0)
    locked = losses(replace(TRUCK, joints=(*TRUCK.joints[:2], joint)))
    figure = loss_figure(locked)
    drawn(figure)
    straight = losses(
        Drive(joints=(Hooke(joint_angle=0.0, friction=0.02, cross=TRUCK.joints[0].cross),)), Duty(speed=1.0, torque=1.0)
    )
    assert [part.loss for part in loss_parts(straight)] == [0.0]
    drawn(loss_figure(straight))


@pytest.mark.slow
def test_a_map_shows_a_curve_for_every_speed_by_rising_torque():
    found = loss_map(TRUCK, [100 * rpm, 3000 * rpm], [500.0, 100.0, 1000.0])
    (figure,) = figures.for_result(found)
    drawn(figure)
    share, heat = ([item for item in panel.series if isinstance(item, Curve)] for panel in figure.panels)
    for k in range(2):
        np.testing.assert_array_equal(heat[k].x, [100.0, 500.0, 1000.0])
        np.testing.assert_array_equal(heat[k].y, found.heat[k, [1, 0, 2]])
        np.testing.assert_allclose(share[k].y, 100.0 * found.efficiency[k, [1, 0, 2]])
    drawn(map_figure(loss_map(TRUCK, [10.0], [5.0])))
    drawn(map_figure(loss_map(TRUCK)))


def test_a_map_tells_where_it_is_best_unless_that_is_everywhere():
    heavy = map_figure(loss_map(TRUCK, [1800 * rpm], [10.0, 1600.0]))
    said = "The efficiency is highest at 1\u202f800 rpm and 1\u202f600 N·m, at the end of what is shown: 99.77 %."
    assert told(heavy.sentence, USUAL) == said
    joint = Hooke(joint_angle=0.3, friction=0.02, cross=TRUCK.joints[0].cross)
    single = loss_map(Drive(joints=(joint,)), [10.0, 20.0], [5.0, 50.0])
    assert map_figure(single).sentence == ""


def test_parts_are_called_by_their_names():
    found = losses(TRUCK)
    parts = {part.named: part for part in loss_parts(found, TRUCK)}
    assert {"support 3 (centre bearing)", "joint 2 (centre)"} < set(parts)
    assert not parts["spline of shaft 3 (rear piece)"].counted
    assert [part.loss for part in loss_parts(found)] == [part.loss for part in parts.values() if part.loss]


def test_long_names_are_cut_in_the_figure_alone():
    drive = example("instrument-joint")
    found = losses(drive)
    assert "support 1 (handwheel side, outer)" in [part.named for part in loss_parts(found, drive)]
    (axis,) = [panel.y for panel in loss_figure(found, drive).panels if any(isinstance(s, Bars) for s in panel.series)]
    assert max(map(len, axis.texts)) == LONG
