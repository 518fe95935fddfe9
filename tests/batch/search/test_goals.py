"""Goals and limits: texts, and what they make of columns."""

import numpy as np
import pytest

from cardan.batch.search.goals import Goal, Limit, check_names, excess, goal_of, limit_of
from cardan.batch.work import Column
from cardan.errors import InputError

ROWS = {"a": np.asarray([1.0, 2.0, np.nan]), "b": np.asarray([-1.0, 0.0, 4.0])}


@pytest.mark.parametrize("text", ["min speed_fluctuation", "max joints[1].centre_mm[2]"])
def test_a_goal_is_told_as_it_was_written(text):
    assert str(goal_of(text)) == text


@pytest.mark.parametrize(
    ("text", "limit"),
    [
        ("a <= 0.02", Limit(name="a", high=0.02)),
        ("a>=-5e3", Limit(name="a", low=-5000.0)),
        ("-1 <= shafts[1].yoke_angle_deg <= .5", Limit(name="shafts[1].yoke_angle_deg", low=-1.0, high=0.5)),
        ("a <= 0.0200000001", Limit(name="a", high=0.0200000001)),
        ("a >= 1234567.25", Limit(name="a", low=1234567.25)),
    ],
)
def test_limits_are_read_and_told(text, limit):
    assert limit_of(text) == limit
    assert limit_of(str(limit)) == limit


@pytest.mark.parametrize("text", ["a", "a <= b", "1 <= a", "1 <= a >= 2", "2 <= a <= 1", "minimum a", "min a b", ""])
def test_what_is_no_limit_is_refused_in_words(text):
    with pytest.raises(InputError, match=r"not a limit|no number"):
        limit_of(text)
    with pytest.raises(InputError, match="not a goal"):
        goal_of(text)


def test_excess_is_negative_within_and_unknown_where_the_value_is():
    """Shares of the end passed: (2 - 1.5)/1.5 and so on by hand; an end at 0 counts in the column's unit."""
    np.testing.assert_allclose(Limit(name="a", high=1.5).excess(ROWS), [-1 / 3, 1 / 3, np.nan])
    np.testing.assert_allclose(Limit(name="b", low=0.0, high=2.0).excess(ROWS), [1.0, 0.0, 1.0])
    both = excess([Limit(name="a", high=1.5), Limit(name="b", low=0.0)], ROWS, 3)
    np.testing.assert_allclose(both, [1.0, 1 / 3, np.nan])
    assert np.all(excess([], ROWS, 3) == -np.inf)


def test_a_goal_to_be_great_costs_the_less_the_greater_it_is():
    np.testing.assert_array_equal(Goal(name="b", largest=True).cost(ROWS), [1.0, -0.0, -4.0])


def test_unknown_columns_are_named_all_at_once():
    columns = [Column(name=name, unit="", role="answer", text="") for name in ("speed_fluctuation", "life_h")]
    with pytest.raises(InputError) as refused:
        check_names([Goal(name="speed_fluctation"), Limit(name="zzz", high=1.0), Goal(name="life_h")], columns)
    assert "the nearest is speed_fluctuation" in str(refused.value)
    assert "known: speed_fluctuation, life_h" in str(refused.value)
    assert len(refused.value.problems) == 2
