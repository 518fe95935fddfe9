"""Pareto sets against the definition, and against fronts that are known in closed form."""

import numpy as np
import pytest

from cardan.batch.answering.asking import Formula
from cardan.batch.search.goals import Goal, Limit
from cardan.batch.search.pareto import pareto, pareto_search
from cardan.errors import InputError

ONE, TWO = Goal(name="one"), Goal(name="two")
TABLE = {
    "one": np.asarray([1.0, 2.0, 2.0, 0.0, np.nan, 0.5]),
    "two": np.asarray([1.0, 0.5, 2.0, 9.0, 0.0, 0.1]),
    "status": np.asarray([0, 0, 0, 0, 0, 2]),
}
ZDT1 = Formula.of(
    [f"x{k}" for k in range(4)],
    {
        "one": lambda x, *_rest: x,
        "two": lambda x, *rest: (g := 1.0 + 3.0 * sum(rest)) * (1.0 - np.sqrt(np.maximum(x, 0.0) / g)),
    },
)


def test_rows_without_an_answer_are_never_chosen():
    np.testing.assert_array_equal(pareto(TABLE, [ONE, TWO]), [True, True, False, True, False, False])


def test_limits_come_before_goals():
    chosen = pareto(TABLE, [ONE, TWO], [Limit(name="two", high=5.0), Limit(name="one", high=1.0)])
    np.testing.assert_array_equal(chosen, [True, False, False, False, False, False])


def test_great_and_small():
    chosen = pareto(TABLE, [ONE, Goal(name="two", largest=True)])
    np.testing.assert_array_equal(chosen, [False, False, False, True, False, False])


@pytest.mark.slow
def test_a_search_finds_a_front_that_is_known():
    """Zitzler, Deb and Thiele's first problem: two = 1 - √one, all other fields 0."""
    found = pareto_search(ZDT1, [(0.0, 1.0)] * 4, [ONE, TWO], population=40, generations=60, seed=1)
    assert found.status == "done"
    assert found.evaluations == 40 * 60
    one, two = found.values["one"], found.values["two"]
    np.testing.assert_allclose(two, 1.0 - np.sqrt(one), atol=0.08)
    assert np.all(np.diff(one) > 0.0)
    assert np.all(np.diff(two) < 0.0)
    assert one[0] < 0.05
    assert one[-1] > 0.9
    assert len(one) > 30
    again = pareto_search(ZDT1, [(0.0, 1.0)] * 4, [ONE, TWO], population=40, generations=60, seed=1)
    np.testing.assert_array_equal(again.points, found.points)


def test_limits_cut_the_front_and_unanswered_points_are_none():
    ask = Formula.of(["x"], {"one": lambda x: np.where(x < 4.0, x**2, np.nan), "two": lambda x: (x - 2.0) ** 2})
    limits = [Limit(name="one", low=1.0)]
    found = pareto_search(ask, [(-5.0, 5.0)], [ONE, TWO], limits=limits, population=20, generations=30)
    assert found.points.min() >= 1.0 - 1e-9
    assert found.points.max() <= 2.01
    none = pareto_search(ask, [(4.5, 5.0)], [ONE, TWO], population=4, generations=2)
    assert none.status == "nothing found"
    assert none.points.shape == (0, 1)


def test_a_stop_returns_what_was_found():
    found = pareto_search(ZDT1, [(0.0, 1.0)] * 4, [ONE, TWO], population=10, progress=lambda share: "stop")
    assert found.status == "cancelled"
    assert 0 < len(found.points) <= 10


def test_everything_wrong_is_told_at_once():
    with pytest.raises(InputError) as refused:
        pareto_search(ZDT1, [(0.0, 1.0)], [ONE], population=1)
    assert len(refused.value.problems) == 3
