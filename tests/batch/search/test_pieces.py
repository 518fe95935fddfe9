"""Points asked piece by piece: all of them, in order, until told to stop."""

import numpy as np

from cardan.batch.answering.asking import Formula
from cardan.batch.search.goals import FIRST, MOST, answered

ASK = Formula.of(["x"], {"double": lambda x: 2.0 * x, "root": np.sqrt})
POINTS = np.linspace(-1.0, 100.0, 5 * FIRST + 3)[:, None]


def test_every_point_is_answered_once_and_in_order():
    told = []
    rows = answered(ASK, POINTS, ["double", "root"], told.append, begin=0.5)
    np.testing.assert_array_equal(rows["double"], 2.0 * POINTS[:, 0])
    np.testing.assert_array_equal(rows["status"] == 0, POINTS[:, 0] >= 0.0)
    assert told == sorted(told)
    assert told[0] > 0.5
    assert told[-1] == 1.0


def test_the_first_piece_is_small_and_none_is_beyond_the_memory_allowed():
    sizes = []

    def ask(points):
        sizes.append(len(points))
        return ASK(points)

    answered(ask, np.zeros((3 * MOST, 1)), ["double"])
    assert sizes[0] == FIRST
    assert max(sizes) <= MOST
    assert sum(sizes) == 3 * MOST


def test_a_stop_ends_it_but_not_what_is_done_already():
    asked = []

    def ask(points):
        asked.append(len(points))
        return ASK(points)

    assert answered(ask, POINTS, ["double"], lambda share: "stop") is None
    assert asked == [FIRST]
    assert len(answered(ASK, POINTS[:3], ["double"], lambda share: "stop")["double"]) == 3
    assert answered(ASK, POINTS[:0], ["double"])["double"].shape == (0,)
