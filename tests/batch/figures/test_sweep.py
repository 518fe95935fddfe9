"""Figures of sweeps: what is drawn is what the table holds, and every renderer draws it."""

from xml.etree import ElementTree

import numpy as np
import pytest

from cardan import figures
from cardan.answers.reader import Reader, reading
from cardan.batch.answering.asking import Formula
from cardan.batch.figures.sweep import curve_figure, heat_figure, histogram_figure, parallel_figure, pareto_figure
from cardan.batch.points.distributions import Uniform
from cardan.batch.search.boundary import boundary
from cardan.batch.search.goals import Goal, Limit
from cardan.batch.search.optimise import Global, optimise
from cardan.batch.search.pareto import pareto, pareto_search
from cardan.batch.search.sobol import one_at_a_time, sensitivity
from cardan.batch.table.views import Ranks
from cardan.figures.figure import Bars, Cells, Curve, Note, Rule
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from tests.batch.tables import COLUMNS, whole

HEIGHT, SPEED, SUPPLIER, SPEED_FLUCTUATION, JOINT_ANGLE, _STATUS = COLUMNS
ROWS = whole()
EVEN, STRAIGHT = Goal(name="speed_fluctuation"), Goal(name="joint_angle_deg[1]")
SUM = Formula.of(["x", "y", "z"], {"sum": lambda x, y, z: 3.0 * x + y, "still": lambda x, y, z: 0.0 * x})
BOX = [(-1.0, 1.0)] * 3


def drawn(figure):
    assert figure.sentence.endswith(".")
    assert figure.title in ElementTree.fromstring(inline_svg(figure)).get("aria-label")
    assert described(figure)["layout"]
    return figure


def of(figure, kind):
    return [item for panel in figure.panels for item in panel.series if isinstance(item, kind)]


def test_every_point_is_a_line_and_the_best_are_drawn_last():
    figure = drawn(parallel_figure(COLUMNS[:5], ROWS, goal=EVEN, total=10_000))
    lines = [one for one in of(figure, Curve) if len(one.x) > 2]
    assert sum(len(one.x) for one in lines) == 210 * 6
    assert lines[0].role == "faint"  # points without an answer
    best = lines[-1].y.reshape(-1, 6)
    assert np.all(best[:, 3] < 0.1)
    assert "joints[1].centre_mm[2] between" in figure.sentence
    assert "210 of 10\u202f000 points" in figure.source
    assert {"Alpha", "Beta"} <= {note.text for note in of(figure, Note)}


def test_the_best_by_a_goal_to_be_great_are_the_greatest():
    figure = parallel_figure(COLUMNS[:5], ROWS, goal=Goal(name="joint_angle_deg[1]", largest=True))
    best = [one for one in of(figure, Curve) if len(one.x) > 2][-1].y.reshape(-1, 6)
    assert np.all(best[:, 4] > 0.9)
    drawn(parallel_figure(COLUMNS[:2], {name: column[:0] for name, column in ROWS.items()}))
    drawn(parallel_figure(COLUMNS[:5], ROWS))


@pytest.mark.parametrize("goals", [(EVEN, STRAIGHT), (EVEN, STRAIGHT, Goal(name="duty.speed_rpm", largest=True))])
def test_the_choice_between_goals(goals):
    chosen = pareto(ROWS, goals)
    front = {name: column[chosen] for name, column in ROWS.items()}
    figure = drawn(pareto_figure(COLUMNS, goals, front, ROWS))
    dots = [one for one in of(figure, Curve) if one.marker > 4.0]
    assert sum(len(one.x) for one in dots) == np.count_nonzero(chosen)
    assert f"{np.count_nonzero(chosen)} choices, from speed fluctuation of the output 0.001" in figure.sentence
    one = {name: column[:1] for name, column in ROWS.items()}
    assert drawn(pareto_figure(COLUMNS, goals, one)).sentence.startswith(
        "One choice: speed fluctuation of the output 0.01"
    )
    none = {name: column[:0] for name, column in ROWS.items()}
    assert "No point" in drawn(pareto_figure(COLUMNS, goals, none)).sentence


def test_a_curve_has_the_values_in_the_order_of_its_field():
    x, y = np.asarray([90.0, -100.0, 0.0]), np.asarray([3.0, 1.0, np.nan])
    figure = drawn(curve_figure(HEIGHT, SPEED_FLUCTUATION, x, y))
    (curve,) = of(figure, Curve)
    np.testing.assert_array_equal(curve.x, [-100.0, 0.0, 90.0])
    np.testing.assert_array_equal(curve.y, [1.0, np.nan, 3.0])
    assert "Least is 1.00 at −100 mm, greatest 3.00 at 90.0 mm." in figure.sentence
    assert drawn(curve_figure(HEIGHT, SPEED_FLUCTUATION, x, y * 0.0)).sentence == "It is 0 at every point."
    assert drawn(curve_figure(HEIGHT, SPEED_FLUCTUATION, x, y * np.nan)).sentence == "No point has an answer."
    with reading(Reader(decimal=",")):
        assert "Least is 1,00 at" in curve_figure(HEIGHT, SPEED_FLUCTUATION, x, y).sentence
    words = drawn(curve_figure(SUPPLIER, SPEED_FLUCTUATION, np.asarray(["Alpha", "Beta", "Alpha"]), y))
    assert words.panels[0].x.texts == ("Alpha", "Beta")


def test_a_map_has_the_values_where_they_belong():
    x, y = np.asarray([-100.0, 0.0, 90.0]), np.asarray([500.0, 1000.0])
    values = np.asarray([[3.0, 1.0, np.nan], [4.0, 2.0, 5.0]])
    figure = drawn(heat_figure(HEIGHT, SPEED, SPEED_FLUCTUATION, x, y, values))
    cells, bar = of(figure, Cells)
    np.testing.assert_array_equal(cells.values, values)
    np.testing.assert_allclose(cells.x, [-150.0, -50.0, 45.0, 135.0])
    assert (bar.y[0], bar.y[-1]) == (1.0, 5.0)
    assert "Least is 1.00 at 0 mm and 500 rpm, greatest 5.00 at 90.0 mm and 1\u202f000 rpm." in figure.sentence
    words = drawn(heat_figure(SUPPLIER, SPEED, SPEED_FLUCTUATION, np.asarray(["Alpha", "Beta"]), y, values[:, :2]))
    assert words.panels[0].x.texts == ("Alpha", "Beta")
    empty = heat_figure(HEIGHT, SPEED, SPEED_FLUCTUATION, x, y, values * np.nan)
    assert drawn(empty).sentence == "No point has an answer."


def test_a_histogram_rules_in_what_it_is_told():
    figure = drawn(
        histogram_figure(JOINT_ANGLE, np.asarray([0.0, 1.0, 2.0]), np.asarray([3, 9]), marks={"mean": 1.4}, unknown=2)
    )
    (bars,) = of(figure, Bars)
    assert list(bars.size) == [3, 9]
    assert [rule.value for rule in of(figure, Rule)] == [1.4]
    assert "75.0 % of 12, lie between 1.00° and 2.00°" in figure.sentence
    assert "2 points have no answer" in figure.source


def test_whom_the_spread_is_owed_to():
    found = sensitivity(SUM, [Uniform(low=-1.0, high=1.0)] * 3, samples=2048)
    first, second = (drawn(one) for one in figures.for_result(found))
    total, _alone = of(first, Bars)
    np.testing.assert_array_equal(total.size[::-1], found.total[0][list(found.ranked(0))])
    assert first.panels[0].y.texts == ("z", "y", "x")
    assert "90 % of its variance is due to x, 10 % to y." in first.sentence
    assert second.sentence == "The answer does not vary."


def test_one_field_at_a_time():
    found = one_at_a_time(SUM, [0.0] * 3, [-1.0] * 3, [1.0] * 3)
    figure = drawn(figures.for_result(found)[0])
    low, high = of(figure, Bars)
    np.testing.assert_array_equal(low.size, [0.0, -1.0, -3.0])
    np.testing.assert_array_equal(high.size, [0.0, 1.0, 3.0])
    assert figure.sentence == "x moves it farthest, from −3.00 to 3.00."


def test_what_an_answer_goes_with():
    found = Ranks(answer=JOINT_ANGLE, fields=(HEIGHT, SPEED), correlation=np.asarray([-0.9, 0.2]), points=99)
    (figure,) = (drawn(one) for one in figures.for_result(found))
    (bars,) = of(figure, Bars)
    assert bars.size.tolist() == [0.2, -0.9]
    assert figure.sentence == "It falls most steadily with joints[1].centre_mm[2]."
    none = Ranks(answer=JOINT_ANGLE, fields=(), correlation=np.empty(0), points=9)
    assert "No field" in drawn(figures.for_result(none)[0]).sentence


def test_a_boundary_is_drawn_with_what_was_asked():
    disc = Formula.of(["x", "y"], {"r": lambda x, y: x * x + y * y})
    found = boundary(disc, BOX[:2], [Limit(name="r", high=0.5)])
    (figure,) = (drawn(one) for one in figures.for_result(found))
    line = next(one for one in of(figure, Curve) if one.label == "boundary")
    np.testing.assert_array_equal(np.stack([line.x, line.y], axis=1), found.lines[0])
    assert f"{found.evaluations:,} points evaluated".replace(",", "\u202f") in figure.source
    for high, said in ((5.0, "everywhere"), (-1.0, "nowhere")):
        assert said in drawn(figures.for_result(boundary(disc, BOX[:2], [Limit(name="r", high=high)]))[0]).sentence


def test_searches():
    two = Formula.of(["x"], {"one": lambda x: x**2, "two": lambda x: (x - 0.5) ** 2})
    found = pareto_search(two, BOX[:1], [Goal(name="one"), Goal(name="two")], population=8, generations=4)
    (figure,) = (drawn(one) for one in figures.for_result(found))
    assert f"{len(found.points)} choices" in figure.sentence
    best = optimise(two, BOX[:1], Goal(name="two"), method=Global(generations=4))
    (figure,) = (drawn(one) for one in figures.for_result(best))
    (line,) = of(figure, Curve)
    assert line.y[-1] == best.value
    nothing = optimise(two, BOX[:1], Goal(name="two"), limits=[Limit(name="one", low=9.0)])
    assert drawn(figures.for_result(nothing)[0]).sentence == "No point keeps the limits."


@pytest.mark.slow
def test_pictures_are_files(tmp_path):
    figure = parallel_figure(COLUMNS[:5], ROWS, goal=EVEN)
    for suffix in (".png", ".pdf"):
        assert figures.save(figure, tmp_path / f"lines{suffix}").stat().st_size > 1000
