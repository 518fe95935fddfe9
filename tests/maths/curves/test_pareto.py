"""The Pareto front against the definition itself, row by row."""

import numpy as np
import pytest

from cardan.maths.curves.pareto import front


def plain(rows):
    """Return the front by comparing all rows with all."""
    found = []
    for row in rows:
        with np.errstate(invalid="ignore"):
            beaten = np.any(np.all(rows <= row, axis=1) & np.any(rows < row, axis=1))
        found.append(not beaten and not np.any(np.isnan(row)))
    return np.asarray(found, dtype=bool)


def smooth(draw, count, columns):
    return draw.random((count, columns))


def ties(draw, count, columns):
    return np.round(4.0 * draw.random((count, columns)))


def shell(draw, count, columns):
    """Rows of which none beats another."""
    rows = np.abs(draw.normal(size=(count, columns)))
    return -rows / np.linalg.norm(rows, axis=1, keepdims=True)


def gaps(draw, count, columns):
    rows = ties(draw, count, columns)
    rows[draw.random(rows.shape) < 0.03] = np.nan
    rows[draw.random(rows.shape) < 0.03] = np.inf
    rows[draw.random(rows.shape) < 0.01] = -np.inf
    return rows


@pytest.mark.parametrize("rows", [smooth, ties, shell, gaps])
@pytest.mark.parametrize("columns", [1, 2, 3, 4, 5])
def test_it_is_what_the_definition_says(rows, columns):
    draw = np.random.default_rng(columns)
    for count in (0, 1, 2, 31, 32, 33, 65, 300):
        table = rows(draw, count, columns)
        np.testing.assert_array_equal(front(table), plain(table))


def test_a_large_front_is_found_whole():
    """No row of a shell beats another, so that all of them stay however many they are."""
    table = shell(np.random.default_rng(0), 20_000, 3)
    assert np.all(front(table))
    worse = np.concatenate([table, table + 1e-3])
    np.testing.assert_array_equal(front(worse), np.arange(40_000) < 20_000)


def test_without_goals_nothing_beats_anything():
    assert np.all(front(np.zeros((3, 0))))
