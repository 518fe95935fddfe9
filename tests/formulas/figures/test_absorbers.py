"""Figures of absorbers and run-ups: what is drawn is what was found, and the sentence tells it."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.figures.figure import Curve, Rule
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.formulas.absorbers import absorber_response, absorber_variants, h_infinity
from cardan.formulas.run_up import joint_run_up, run_up
from cardan.units import deg


def drawn(found):
    (figure,) = figures.for_result(found)
    assert figure.sentence.endswith(".")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]
    return figure


def curves(figure):
    return [item for panel in figure.panels for item in panel.series if isinstance(item, Curve)]


@pytest.mark.parametrize("alpha", [0.002, 0.1, 2.0])
def test_every_variant_has_its_curve_and_none_of_the_damped_ones_leaves_the_panel(alpha):
    found = absorber_variants(alpha)
    figure = drawn(found)
    assert [item.label for item in curves(figure)] == [entry.label for entry in figure.entries]
    assert len(curves(figure)) == len(found.kinds)
    panel = figure.panels[0]
    best = float(found.peak[-1])
    assert panel.y.low < best < panel.y.high
    assert panel.x.low <= found.peak_beta[-1] <= panel.x.high
    assert len(panel.y.ticks) >= 3
    assert f"{best:.3g}"[:3] in figure.sentence


def test_variants_take_the_frequencies_given():
    found = absorber_variants(0.1, [0.5, 1.0])
    assert found.amplification.shape == (5, 2)
    assert np.isinf(found.amplification[0, 1])
    assert found.amplification[1, 1] == 0.0
    drawn(found)


def test_before_and_after_an_absorber():
    best = h_infinity(0.2)
    found = absorber_response(np.linspace(0.1, 2.0, 400), 0.2, best.frequency_ratio, best.damping)
    before, after, twist = curves(drawn(found))
    np.testing.assert_array_equal(after.y, found.amplification)
    np.testing.assert_array_equal(before.y, found.bare)
    np.testing.assert_array_equal(twist.y, abs(found.twist))


def test_an_undamped_absorber_is_said_to_have_no_bound():
    found = absorber_response(np.linspace(0.1, 2.0, 400), 0.2, 1.0)
    assert "no bound at 0.801 and 1.25" in drawn(found).sentence
    exact = absorber_response([0.5, 1.0], 0.2, 0.0)
    assert np.isnan(curves(drawn(exact))[1].y[1])


def test_the_peak_of_a_run_up_is_ruled_in():
    found = run_up(20.0, 0.02, 8.0, 6.0)
    figure = drawn(found)
    rules = [item.value for item in figure.panels[0].series if isinstance(item, Rule)]
    assert rules == [found.passing_time, found.peak, -found.peak]
    assert "7.77" in figure.sentence


def test_the_torque_behind_a_joint_stands_over_the_speed():
    figure = drawn(joint_run_up(20 * deg, 2000.0, 0.5, 20.0, 4.0, damping=0.5))
    assert "842 N·m at 358 rpm, after passing the resonance at 302 rpm" in figure.sentence
    (curve,) = curves(figure)
    assert curve.x[-1] == pytest.approx(80.0 * 30 / np.pi)
    short = drawn(joint_run_up(20 * deg, 2000.0, 0.5, 20.0, 1.0, damping=0.5))
    assert "ends before the resonance" in short.sentence
