"""Figures of mobility: the graph of links and joints, positions over a turn, loops that do not close."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import example, figures
from cardan.answers.reader import USUAL
from cardan.figures.figure import Curve, Note
from cardan.figures.for_reader import for_reader
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import mechanism_names
from cardan.mechanism.mechanism import PAIRS
from cardan.mechanisms import example_mechanism
from cardan.questions.mobility.figure import graph_figure
from cardan.questions.mobility.finite_mobility import finite_mobility, mobility_over_turn
from cardan.questions.mobility.mobility import mobility
from tests.builders.mechanisms import anyhow


def drawn(result):
    for figure in figures.for_result(result):
        figure = for_reader(figure, USUAL)
        assert not figure.sentence or figure.sentence.endswith(".")
        assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
        assert described(figure)["data"]
        yield figure


@pytest.mark.parametrize("name", mechanism_names())
def test_every_mechanism_is_drawn_by_both(name):
    found = mobility(example_mechanism(name))
    (figure,) = drawn(found)
    notes = [item.text for item in figure.panels[0].series if isinstance(item, Note)]
    assert all(any(text.startswith(link) for text in notes) for link in found.mechanism.links)
    dots = [item for item in figure.panels[0].series if isinstance(item, Curve) and item.marker]
    assert [item.role == "warning" for item in dots] == [one.strained for one in found.joints]
    assert all(f"{one.type}: {PAIRS[one.type].name}" in figure.source for one in found.joints)


def test_no_two_links_lie_on_each_other():
    rng = np.random.default_rng(1)
    for _k in range(5):
        found = mobility(anyhow(rng, links=7, loops=3))
        bars = [
            (float(np.mean(item.x)), float(item.y[0]))
            for item in graph_figure(found).panels[0].series
            if isinstance(item, Curve) and item.width == 5.0
        ]
        assert len(bars) == 7
        far = [np.hypot(a[0] - b[0], a[1] - b[1]) for k, a in enumerate(bars) for b in bars[:k]]
        assert min(far) > 0.39


@pytest.mark.slow
def test_a_drive_a_turn_and_a_loop_that_stays_open_are_drawn():
    pump = example("overconstrained-pump")
    assert len(list(drawn(mobility(pump)))) == 1
    (turn,) = drawn(mobility_over_turn(pump, positions=6))
    np.testing.assert_array_equal(turn.panels[0].series[0].y, [3.0] * 6)
    found = finite_mobility(example_mechanism("maize-drive-offset"), angle=0.5)
    (closure,) = drawn(found)
    np.testing.assert_allclose(closure.panels[0].series[0].y, found.gap * 1e3)
    (closed,) = drawn(finite_mobility(example_mechanism("crank-slider"), angle=0.5))
    assert "close at every angle" in closed.sentence
