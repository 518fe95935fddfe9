"""Figures of critical speeds: what is drawn is what was found, and both renderers draw it."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import example, figures
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.figures.figure import Band, Bars, Curve, Rule, Shape
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.questions.bending.bending import bending_speeds, critical_speed_map
from cardan.questions.bending.figure import shapes_figure, speed_map_figure, speeds_figure
from cardan.units import rpm

VAN = example("two-piece-rubber-bearing")
TRUCK = example("truck-supports")


def drawn(figure):
    seen = for_reader(figure, USUAL)
    assert not seen.sentence or seen.sentence.endswith(".")
    assert ElementTree.fromstring(inline_svg(seen)).get("aria-label") == seen.spoken
    assert described(seen)["layout"]


def of(panel, kind):
    return [item for item in panel.series if isinstance(item, kind)]


@pytest.mark.parametrize("drive", [VAN, TRUCK], ids=["van", "truck"])
def test_results_have_their_figures(drive):
    found = bending_speeds(drive)
    names = [figure.name for figure in figures.for_result(found)]
    assert names == ["critical-speeds", "mode-shapes"]
    for figure in (*figures.for_result(found), *figures.for_result(critical_speed_map(drive, modes=1))):
        drawn(figure)


def test_bars_and_bands_are_the_speeds():
    found = bending_speeds(VAN)
    (panel,) = speeds_figure(found).panels
    (bars,) = of(panel, Bars)
    np.testing.assert_allclose(bars.size, found.actual / rpm)
    (used,) = of(panel, Band)
    assert (used.low, used.high) == pytest.approx((700.0, 3900.0))
    halves = [(float(shape.x.min()), float(shape.x.max())) for shape in of(panel, Shape)]
    np.testing.assert_allclose(halves, found.half_band / rpm)
    assert [shape.role for shape in of(panel, Shape)] == ["warning", "warning", "cross"]


def test_a_single_speed_is_a_line_and_none_is_nothing():
    one = speeds_figure(bending_speeds(VAN, Duty(speed=500.0)))
    assert [rule.value for rule in of(one.panels[0], Rule)] == pytest.approx([500.0 / rpm, 800.0 / rpm])
    drawn(one)
    none = speeds_figure(bending_speeds(VAN, Duty()))
    assert not of(none.panels[0], Rule)
    drawn(none)


@pytest.mark.parametrize(
    ("duty", "roles"),
    [
        (Duty(speed_range=(0.0, 400.0)), ("warning", "accent", "accent")),
        (Duty(speed_range=(300.0, 500.0)), ("warning", "warning", "accent")),
        (Duty(speed_range=(300.0, 600.0)), ("warning", "failed", "accent")),
        (Duty(speed_range=(300.0, 800.0)), ("warning", "failed", "accent")),
        (Duty(speed=900.0), ("warning", "failed", "accent")),
    ],
)
def test_what_fails_is_red_and_what_is_close_amber(duty, roles):
    (bars,) = of(speeds_figure(bending_speeds(VAN, duty)).panels[0], Bars)
    assert tuple(bars.roles) == roles


def test_shapes_run_through_their_joints():
    found = bending_speeds(VAN)
    figure = shapes_figure(found)
    assert len(figure.panels) == 3
    for k, panel in enumerate(figure.panels):
        lines = [curve for curve in of(panel, Curve) if curve.role.startswith("shaft")]
        assert [curve.role for curve in lines] == ["shaft 2", "shaft 3"]
        np.testing.assert_allclose(lines[0].x[-1], lines[1].x[0])
        np.testing.assert_allclose(lines[0].y[-1], lines[1].y[0])
        (joints,) = [curve for curve in of(panel, Curve) if curve.marker]
        np.testing.assert_allclose(joints.x, 1e3 * found.joint_place)
        assert joints.y[1] == pytest.approx(np.interp(found.joint_place[1], found.place, found.deflection[k]))
        assert len(of(panel, Shape)) == 2, "two joints held by their machines"


def test_many_modes_show_the_first_six():
    figure = shapes_figure(bending_speeds(TRUCK, modes=8))
    assert len(figure.panels) == 6
    drawn(figure)


def test_maps_cover_their_values():
    stiff = critical_speed_map(VAN, np.geomspace(1e3, 1e9, 5), modes=2)
    figure = speed_map_figure(stiff)
    assert figure.panels[0].x.log
    assert figure.panels[0].x.ticks[0] == 1.0
    assert len(of(figure.panels[0], Curve)) == 2
    drawn(figure)
    one = speed_map_figure(critical_speed_map(replace(VAN, duty=Duty(speed=100.0)), [2e5], modes=1))
    drawn(one)
    length = speed_map_figure(critical_speed_map(TRUCK, [1.0, 1.2], shaft=3, modes=1))
    np.testing.assert_allclose(of(length.panels[0], Curve)[0].x, [1000.0, 1200.0])
    drawn(length)
