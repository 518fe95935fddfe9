"""Figures of accuracy: the numbers of the analyses, both renderers."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.reader import USUAL, Reader
from cardan.drive.accuracy import Error, Tolerance
from cardan.drive.drive import Drive
from cardan.figures.figure import Bars, Curve, Shape
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example
from cardan.questions.accuracy.accuracy import transmission_error
from cardan.questions.accuracy.figure import MICRON, band_figure, error_figure, pareto_figure
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.questions.accuracy.tolerance import Linear, WorstCase, tolerance
from cardan.units import arcmin, deg

INSTRUMENT = example("instrument-joint")
THREE = Drive.from_angles([0.3, 0.2, 0.4])


def drawn(made):
    figure = for_reader(made, USUAL)
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["data"]


@pytest.mark.parametrize("method", [Linear(), WorstCase(), MonteCarlo(samples=200, seed=1)])
def test_both_renderers_draw_them(method):
    made = figures.for_result(tolerance(INSTRUMENT, method=method))
    assert [figure.name for figure in made] == ["band", "pareto"]
    for figure in made:
        drawn(figure)


def test_bands_are_those_of_the_analysis():
    found = tolerance(INSTRUMENT)
    for panel, one, size in zip(band_figure(found).panels, (found.output, found.shift), (arcmin, MICRON), strict=True):
        wide, inner = [item for item in panel.series if isinstance(item, Shape)]
        np.testing.assert_allclose(np.min(wide.y) * size, np.min(one.lower))
        np.testing.assert_allclose(np.max(wide.y) * size, np.max(one.upper))
        np.testing.assert_allclose(np.max(inner.y) * size, np.max(one.upper_95))


def test_bars_are_the_shares_from_the_largest():
    found = tolerance(INSTRUMENT)
    for panel, one in zip(pareto_figure(found).panels, (found.output, found.shift), strict=True):
        (bars,) = [item for item in panel.series if isinstance(item, Bars)]
        np.testing.assert_allclose(bars.size, [100.0 * row.share for row in one.contributions])
        assert np.sum(bars.size) == pytest.approx(100.0)
        assert np.all(np.diff(bars.size) <= 0.0)
    assert pareto_figure(found).panels[0].y.texts[:2] == ("yoke phase of joint 1", "α₂ of joint 1")


def test_many_tolerances_keep_to_the_page_and_angles_alone_shift_nothing():
    found = tolerance(THREE, Tolerance(alpha1=1e-3, alpha2=1e-3, alpha3=1e-3, alpha4=1e-3, phase=1e-3))
    figure = pareto_figure(found)
    drawn(figure)
    (panel,) = figure.panels
    assert len(panel.y.texts) == 10
    assert len(band_figure(found).panels) == 1
    lengths = tolerance(THREE, Tolerance(a2=1e-5))
    for one in figures.for_result(lengths):
        drawn(one)


def test_known_errors_are_drawn_exactly_and_to_first_order():
    found = transmission_error(THREE, errors=Error(alpha2=1e-2, a1=1e-5))
    (figure,) = figures.for_result(found)
    drawn(figure)
    exact, first = [item for item in figure.panels[0].series if isinstance(item, Curve)]
    np.testing.assert_allclose(exact.y[:-1] * arcmin, found.error)
    np.testing.assert_allclose(first.y[:-1] * arcmin, found.error_linear)
    assert exact.y[-1] == exact.y[0]
    assert len(error_figure(found, shifts=False).panels) == 1


def test_known_errors_shift_the_band():
    joint = replace(INSTRUMENT.joints[0], error=Error(alpha2=2 * arcmin))
    figure = band_figure(tolerance(replace(INSTRUMENT, joints=(joint,))))
    drawn(figure)
    assert "known errors alone" in [item.label for item in figure.entries]


def test_axes_and_bars_are_in_the_units_of_the_reader():
    found = tolerance(INSTRUMENT)
    who = Reader(units={"angle": "deg", "displacement": "in"}, decimal=",")
    band, pareto = (for_reader(one, who) for one in figures.for_result(found))
    assert [panel.heading for panel in band.panels] == [
        "Angle error of the output [°]",
        "Shift of the output shaft [in]",
    ]
    wide = band.panels[0].series[0]
    np.testing.assert_allclose(np.max(wide.y), np.max(found.output.upper) / deg)
    (bars,) = pareto.panels[0].series
    assert bars.texts[0] == "75,0 %, ±0,0355°"
