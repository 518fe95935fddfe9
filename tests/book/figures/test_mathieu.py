"""Charts of Mathieu's equation: what is shaded is what grows, and the drive stands where its numbers say."""

from dataclasses import replace
from itertools import combinations
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.path import Path

from cardan import figures
from cardan.book.figure import chart_panel
from cardan.book.mathieu_drive import mathieu_reduction
from cardan.figures.figure import Curve, Note, Shape
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.maths.periodic.mathieu import exponents
from cardan.units import deg, rpm

ONE = mathieu_reduction(
    [20 * deg], [0.0], [1000.0, 4000.0], first_inertia=1.0, last_inertia=0.4, speed=500 * rpm
)  # fmt: skip


def drawn(figure):
    assert figure.sentence.endswith(".")
    assert figure.sentence.count(". ") == 0
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]
    return figure


def shaded(panel, a, q):
    shapes = [item for item in panel.series if isinstance(item, Shape)]
    return any(Path(np.stack((shape.x, shape.y), axis=-1)).contains_point((a, q)) for shape in shapes)


def points(figure):
    found = [item for item in figure.panels[0].series if isinstance(item, Curve) and item.marker]
    return {item.label: (float(item.x[0]), float(item.y[0])) for item in found}


def test_what_is_shaded_grows():
    panel = chart_panel((-3.0, 18.0), 8.0, (), named=True)
    rng = np.random.default_rng(1)
    for a, q in zip(rng.uniform(-3.0, 18.0, 200), rng.uniform(0.0, 8.0, 200), strict=True):
        found = exponents(a, q)
        if abs(abs(float(found.half_trace)) - 1.0) > 0.02:  # not so near to an edge that its polygon decides
            assert shaded(panel, a, q) == (not found.stable)


def test_the_drive_stands_at_its_numbers_and_twice_as_high_as_the_book_has_it():
    figure = drawn(figures.for_result(ONE)[0])
    (book, mine) = points(figure).values()
    assert mine == (ONE.a, ONE.q)
    assert book == (ONE.a, ONE.q_book)
    assert shaded(figure.panels[0], *mine)
    assert not shaded(figure.panels[0], *book)
    assert "unstable at 500" in figure.sentence


@pytest.mark.parametrize("speed", [60.0, 250.0, 500.0, 5000.0])
def test_at_any_speed_the_drive_is_in_the_window(speed):
    there = replace(ONE, speed=speed * rpm)
    figure = drawn(figures.for_result(there)[0])
    panel = figure.panels[0]
    assert panel.x.label == "a = (ωₑ/ω₁)²"
    assert panel.y.low <= there.q <= panel.y.high
    assert panel.x.low <= there.a <= panel.x.high
    assert ("is stable" in figure.sentence) == bool(exponents(there.a, there.q).stable)
    ray = next(item for item in panel.series if isinstance(item, Curve) and item.dash == "dotted")
    assert ray.y == pytest.approx(ray.x * there.q / there.a, rel=1e-9)


def test_far_below_all_zones_the_first_one_is_shown():
    figure = drawn(figures.for_result(replace(ONE, speed=3.0 * rpm))[0])
    assert not points(figure)
    assert figure.panels[0].x.low < 1.0 < figure.panels[0].x.high


def test_a_straight_drive_has_a_chart_too():
    drawn(figures.for_result(replace(ONE, joint_angle=np.asarray([0.0])))[0])


def test_damping_draws_its_edges_inside_the_zones():
    panel = chart_panel((0.0, 6.0), 2.0, (), damping=0.1, named=True)
    edges = [item for item in panel.series if isinstance(item, Curve) and item.dash == "dashed"]
    assert len(edges) == 2
    for edge in edges:
        seen = np.isfinite(edge.x)
        assert exponents(edge.x[seen], edge.y[seen], 0.1).growth == pytest.approx(0.0, abs=1e-7)


def test_names_of_the_boundaries_keep_apart():
    """a₀ and b₁ run together where they leave the window: their names stand apart by more than their own height."""
    panel = chart_panel((-2.0, 18.0), 2.5, (), title="q")
    notes = [one for one in panel.series if isinstance(one, Note)]
    assert {"a₀", "b₁", "a₁"} <= {one.text for one in notes}
    for one, other in combinations(notes, 2):
        assert abs(one.x - other.x) > 0.2 or one.side != other.side or abs(one.y - other.y) > 0.12
    (left, right) = (next(one for one in notes if one.text == name) for name in ("a₀", "b₁"))
    assert abs(left.y - right.y) > 0.25
