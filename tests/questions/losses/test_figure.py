"""Figures of losses: all heat is in the bars, both renderers draw them."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.figures.figure import Bars, Curve
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.questions.losses.figure import LONG, SHOWN, heat_figure, heat_parts, map_figure
from cardan.questions.losses.losses import loss_map, losses
from cardan.units import rpm

TRUCK = example("truck-supports")


def drawn(figure):
    assert figure.sentence.endswith(".")
    assert figure.sentence.count(". ") == 0
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]


def bars(figure):
    (found,) = [item for panel in figure.panels for item in panel.series if isinstance(item, Bars)]
    return found


@pytest.mark.parametrize("name", ["truck-supports", "pto-spline-thrust"])
def test_bars_are_the_parts_from_the_warmest_and_hold_all_heat(name):
    found = losses(example(name))
    (figure,) = figures.for_result(found)
    drawn(figure)
    size = bars(figure).size
    assert np.all(np.diff(size) <= 0.0)
    assert np.sum(size) == pytest.approx(found.heat, rel=1e-12)


def test_curves_are_those_of_the_joints():
    found = losses(TRUCK)
    curves = [item for item in heat_figure(found).panels[1].series if isinstance(item, Curve)]
    for curve, row in zip(curves, found.joint_power, strict=True):
        np.testing.assert_array_equal(curve.y, row)


def test_many_parts_share_the_last_bar():
    joint = TRUCK.joints[0]
    many = Drive(joints=tuple(Hooke(bend=0.1, friction=0.02, cross=joint.cross) for _number in range(15)))
    found = losses(many, Duty(speed=100.0, torque=100.0))
    figure = heat_figure(found)
    drawn(figure)
    assert len(bars(figure).size) == SHOWN
    assert np.sum(bars(figure).size) == pytest.approx(found.heat, rel=1e-12)
    assert "4 other parts" in figure.panels[0].y.texts


def test_a_locked_drive_and_a_straight_one_are_drawn():
    joint = replace(TRUCK.joints[2], friction=40.0)
    locked = losses(replace(TRUCK, joints=(*TRUCK.joints[:2], joint)))
    figure = heat_figure(locked)
    drawn(figure)
    assert "Friction holds joint 3" in figure.sentence
    straight = losses(
        Drive(joints=(Hooke(bend=0.0, friction=0.02, cross=TRUCK.joints[0].cross),)), Duty(speed=1.0, torque=1.0)
    )
    assert heat_parts(straight) == []
    drawn(heat_figure(straight))
    assert heat_figure(straight).sentence == "No part gets warm."


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


def test_parts_are_called_by_their_names():
    found = losses(TRUCK)
    names = [name for name, _heat, _role in heat_parts(found, TRUCK)]
    assert "support 3 centre bearing" in names
    assert names[0] == "joint 2 centre"
    assert [row[1:] for row in heat_parts(found, TRUCK)] == [row[1:] for row in heat_parts(found)]


def test_long_names_are_cut_in_the_figure_alone():
    drive = example("instrument-joint")
    found = losses(drive)
    assert "support 1 handwheel side, outer" in [name for name, _heat, _role in heat_parts(found, drive)]
    (axis,) = [panel.y for panel in heat_figure(found, drive).panels if any(isinstance(s, Bars) for s in panel.series)]
    assert max(map(len, axis.texts)) == LONG
