"""The best point where it is known: on a circle, at a tip, in one of many dips."""

import math

import numpy as np
import pytest

from cardan.batch.answering.asking import Formula
from cardan.batch.search.goals import Goal, Limit
from cardan.batch.search.optimise import Global, Local, optimise
from cardan.errors import InputError

PLANE = Formula.of(["x", "y"], {"sum": lambda x, y: x + y, "radius2": lambda x, y: x * x + y * y})
BOX = [(-2.0, 2.0)] * 2
DIPS = Formula.of(
    ["x", "y"],
    {"z": lambda x, y: 20.0 + sum(t * t - 10.0 * np.cos(2.0 * math.pi * t) for t in (x - 1.3, y - 0.7))},
)
HALF = Formula.of(["x"], {"z": lambda x: np.where(x > 0.5, (x - 0.6) ** 2, np.nan)})


@pytest.mark.slow
@pytest.mark.parametrize("method", [Local(), Local(start=(1.0, -1.0)), Global()])
@pytest.mark.parametrize("largest", [False, True])
def test_the_end_of_a_diagonal_on_a_circle(method, largest):
    """On the unit circle x + y goes from -√2 to √2; the limit is kept to its ten-millionth."""
    found = optimise(
        PLANE, BOX, Goal(name="sum", largest=largest), limits=[Limit(name="radius2", high=1.0)], method=method
    )
    sign = 1.0 if largest else -1.0
    assert found.status == "converged"
    assert found.feasible
    assert found.value == pytest.approx(sign * math.sqrt(2.0), abs=1e-4)
    np.testing.assert_allclose(found.point, sign * math.sqrt(0.5), atol=1e-2)
    assert found.values["radius2"] <= 1.0 + 1e-9
    best = found.history[:, 1] * sign
    assert np.all(np.diff(best) > 0.0)


def test_a_corner_of_the_box():
    found = optimise(PLANE, BOX, Goal(name="sum"))
    np.testing.assert_array_equal(found.point, [-2.0, -2.0])


def test_a_tip_is_found_as_well_as_a_bowl():
    """The speed fluctuation of a drive that can be even comes to nought in a tip, not in a bowl."""
    tip = Formula.of(["x", "y"], {"z": lambda x, y: np.hypot(x - 0.3, y + 0.2)})
    assert optimise(tip, BOX, Goal(name="z")).value < 1e-5


@pytest.mark.slow
def test_the_deepest_of_many_dips_needs_the_global_search():
    near = optimise(DIPS, [(-5.0, 5.0)] * 2, Goal(name="z"))
    far = optimise(DIPS, [(-5.0, 5.0)] * 2, Goal(name="z"), method=Global(seed=1))
    assert near.status == far.status == "converged"
    assert near.value > 1.0
    assert far.value < 1e-8
    np.testing.assert_allclose(far.point, [1.3, 0.7], atol=1e-5)
    again = optimise(DIPS, [(-5.0, 5.0)] * 2, Goal(name="z"), method=Global(seed=1))
    np.testing.assert_array_equal(again.point, far.point)
    assert again.evaluations == far.evaluations


@pytest.mark.parametrize("method", [Local(), Global(generations=30)])
def test_points_without_an_answer_are_passed_by(method):
    assert optimise(HALF, [(-2.0, 2.0)], Goal(name="z"), method=method).point == pytest.approx(0.6, abs=1e-5)
    none = optimise(HALF, [(-2.0, 0.2)], Goal(name="z"), method=method)
    assert (none.status, none.values) == ("nothing found", {})
    assert np.all(np.isnan(none.point))


def test_where_no_point_keeps_a_limit_the_nearest_is_told():
    found = optimise(PLANE, [(1.0, 2.0)] * 2, Goal(name="sum"), limits=[Limit(name="radius2", high=1.0)])
    assert found.status == "nothing found"
    assert not found.feasible
    assert found.excess == pytest.approx(1.0, abs=1e-5)


def test_it_says_when_it_ran_out_of_points_or_was_stopped():
    assert optimise(DIPS, BOX, Goal(name="z"), method=Local(most=8)).status == "not converged"
    told = []
    stopped = optimise(DIPS, BOX, Goal(name="z"), method=Global(), progress=lambda share: told.append(share) or "stop")
    assert stopped.status == "cancelled"
    assert stopped.evaluations > 0
    assert len(told) == 1
    assert math.isfinite(stopped.value)


def test_everything_wrong_is_told_at_once():
    with pytest.raises(InputError, match="no such column"):
        optimise(PLANE, BOX, Goal(name="radius"))
    with pytest.raises(InputError) as refused:
        optimise(PLANE, [(1.0, 1.0), (0.0, math.inf)], Goal(name="sum"), method=Local(start=(1.0,)))
    assert len(refused.value.problems) == 3
    with pytest.raises(InputError, match="start: y"):
        optimise(PLANE, BOX, Goal(name="sum"), method=Local(start=(1.0, 3.0)))
