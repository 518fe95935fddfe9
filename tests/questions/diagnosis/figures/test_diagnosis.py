"""Figures of recordings: what is drawn is what was found, and both renderers draw it."""

from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.reader import USUAL
from cardan.figures.figure import Curve, Note, Rule, Shape
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.questions.diagnosis.figures.orders import LINES, map_figure
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.recordings import estimate_rotation, orbit, order_map, order_spectrum, torsional_vibration, tracked_orders
from tests.builders.recordings import recorded

SIGNAL = recorded({1: (0.5, 0.0), 2: (2.0, 1.0)}, noise=0.05)
FRONT = SIGNAL.channel("front")
SHAFT = estimate_rotation(SIGNAL)
SPECTRUM = order_spectrum(FRONT, SHAFT)
MAP = order_map(FRONT, SHAFT)
TRACKS = tracked_orders(FRONT, SHAFT, [1.0, 2.0])
SENSORS = [
    Channel(name=name, quantity="displacement", values=1e-6 * np.roll(FRONT.values, shift), rate=FRONT.rate)
    for name, shift in (("x", 0), ("y", 70))
]
ORBIT = orbit(*SENSORS, SHAFT)
TIME = np.arange(30000) / 10000
SWUNG = 100 * TIME + 0.01 * np.sin(200 * TIME)
WHEEL = torsional_vibration(Channel(name="wheel", quantity="pulses", values=np.sin(24 * SWUNG), rate=1e4), 24)
ALL = (SPECTRUM, MAP, TRACKS, SHAFT, ORBIT, WHEEL)


def seen(found):
    """Return the figure of a result, as the usual reader sees it."""
    (figure,) = figures.for_result(found)
    return for_reader(figure, USUAL)


@pytest.mark.parametrize("found", ALL, ids=lambda one: type(one).__name__)
def test_both_renderers_draw_it_with_one_sentence(found):
    figure = seen(found)
    assert figure.sentence.endswith(".")
    assert figure.sentence.count(". ") == 0
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]


@pytest.mark.parametrize("found", ALL, ids=lambda one: type(one).__name__)
def test_what_is_doubtful_is_said(found):
    assert seen(replace(found, confidence=0.25)).sentence.endswith("The confidence is only 25 %.")


def test_peaks_are_named():
    figure = seen(SPECTRUM)
    notes = [one for one in figure.panels[0].series if isinstance(one, Note)]
    assert [one.text for one in notes] == ["2×", "1×"]
    assert notes[0].y == pytest.approx(2.0, rel=0.01)
    assert "the highest order is 2 with 2.0" in figure.sentence


def test_a_map_has_a_line_for_each_range_of_speed_with_orders_and_resonances():
    figure = map_figure(MAP, critical_speeds=[300.0, 1e6], orders={2: "joint"})
    series = figure.panels[0].series
    assert [one.text for one in series if isinstance(one, Rule)] == ["joint"]
    lines = [one for one in series if isinstance(one, Curve) and not one.label]
    assert len(lines) == sum(isinstance(one, Shape) for one in series) <= LINES
    (crossing,) = [one for one in series if isinstance(one, Curve) and one.label]
    # Order times speed is the natural frequency all along the curve.
    assert crossing.x * crossing.y == pytest.approx(300.0 * 30 / np.pi)


def test_a_steady_run_is_drawn_over_time():
    steady = recorded({1: (0.5, 0.0)}, gain=0.0)
    (figure,) = figures.for_result(tracked_orders(steady.channel("front"), estimate_rotation(steady), [1.0]))
    assert figure.panels[0].x.unit == "s"
    unmarked = replace(TRACKS, phased=False)
    assert len(figures.for_result(unmarked)[0].panels) == 1


def test_amplitudes_of_the_tracks_are_those_found():
    (figure,) = figures.for_result(TRACKS)
    curves = [one for one in figure.panels[0].series if isinstance(one, Curve)]
    for curve, row in zip(curves, TRACKS.amplitude, strict=True):
        assert np.sort(curve.y) == pytest.approx(np.sort(row))


def test_a_run_up_and_a_hold_at_another_level_are_not_mixed():
    """Over the speed only the run-up: a hold has the same speed with other amplitudes."""
    count = TRACKS.speed.size
    held = replace(
        TRACKS,
        time=np.concatenate([TRACKS.time, TRACKS.time[-1] + TRACKS.time]),
        speed=np.concatenate([TRACKS.speed, np.full(count, 0.9 * TRACKS.speed[-1])]),
        value=np.concatenate([TRACKS.value, 9.0 * TRACKS.value], axis=1),
    )
    (figure,) = figures.for_result(held)
    assert figure.panels[0].x.unit == "rpm"
    for curve, row in zip(figure.panels[0].series, TRACKS.amplitude, strict=True):
        assert set(curve.y) <= set(row)
        assert len(curve.y) >= count - 3  # where it ends is smoothed over five windows
    swaying = replace(TRACKS, speed=TRACKS.speed[0] * (2.0 + np.sin(np.arange(count))))
    assert figures.for_result(swaying)[0].panels[0].x.unit == "s"
