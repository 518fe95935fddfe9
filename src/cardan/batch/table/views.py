"""What pictures of a sweep are made of: a map over two fields, a histogram, which field an answer goes with."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.batch.work import Column
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .results import TABLE, Results, condition, quoted

FINEST = 160  # columns and rows of a map at most; what is finer is put together
COARSE = 60  # columns and rows of a map whose fields take more values than that
DRAWN = 100_000  # rows that ranks are told from, at most


@dataclass(frozen=True, eq=False, kw_only=True)
class Map:
    """A column over two fields."""

    across: Column
    up: Column
    value: Column
    x: Array  # x, y (m,), (k,): values, or middles of ranges, rising; or words
    y: Array  # (m,), (k,)
    values: Array  # (k, m): means of the points of a cell; nan where none has an answer
    points: int  # that the cells hold


def map_of(results: Results, across: str, up: str, value: str, *, where: str = "") -> Map:
    """Return a column over two fields: each value of them, or ranges where there are many.

    across, up, value: names of columns; where: condition in SQL.
    """
    columns = [results.column(name) for name in (across, up, value)]
    if value not in {column.name for column in results.numbers}:
        raise refuse("map", _("{name} holds no numbers").format(name=value))
    told = [_places(results, name, where) for name in (across, up)]
    (x_of, x), (y_of, y) = told
    rows = results.query(
        f"SELECT {x_of} AS i, {y_of} AS j, avg({quoted(value)}) AS v, count(*) AS n FROM {TABLE}"
        f"{condition(where)} GROUP BY i, j"
    )
    i, j = (_index(places, rows[key]) for places, key in ((x, "i"), (y, "j")))
    values = np.full((len(y), len(x)), math.nan)
    values[j, i] = rows["v"]
    middles = [_middles(results, name, places, how) for name, places, how in ((across, x, x_of), (up, y, y_of))]
    points = int(np.sum(rows["n"]))
    return Map(
        across=columns[0], up=columns[1], value=columns[2], x=middles[0], y=middles[1], values=values, points=points
    )


def _places(results: Results, name: str, where: str) -> tuple[str, Array]:
    """Return the place of a row along a field in SQL, and all such places: its values, or numbers of ranges."""
    column = quoted(name)
    count = results.query(f"SELECT count(DISTINCT {column}) AS n FROM {TABLE}{condition(where)}")["n"][0]
    if not count:
        raise refuse("where", _("no row fulfils this"))
    if count <= FINEST:
        distinct = results.query(f"SELECT DISTINCT {column} AS v FROM {TABLE}{condition(where)} ORDER BY v")["v"]
        return column, distinct
    span = results.spans([name], where=where)[name]
    width = (span["most"] - span["least"]) / COARSE
    return f"least(floor(({column} - {span['least']!r}) / {width!r}), {COARSE - 1})", np.arange(float(COARSE))


def _middles(results: Results, name: str, places: Array, how: str) -> Array:
    """Return the values that places stand for."""
    if how == quoted(name):
        return places
    span = results.spans([name])[name]
    return span["least"] + (places + 0.5) * (span["most"] - span["least"]) / COARSE


def _index(places: Array, found: Array) -> Array:
    if places.dtype.kind == "O" or found.dtype.kind == "O":
        known = {place: k for k, place in enumerate(places.tolist())}
        return np.asarray([known[one] for one in found.tolist()], dtype=int)
    return np.searchsorted(places, found)


@dataclass(frozen=True, eq=False, kw_only=True)
class Histogram:
    """How often the values of a column occur."""

    column: Column
    edges: Array  # (m + 1,): between the ranges
    counts: Array  # (m,): points in each
    mean: float  # of these
    unknown: int  # points without an answer, or with one that is not finite


def histogram_of(results: Results, name: str, *, bins: int = 30, where: str = "") -> Histogram:
    """Return how often the values of a column occur.

    name: a column of numbers; bins: ranges, all of one width; where: condition in SQL.
    """
    column = results.column(name)
    if name not in {one.name for one in results.numbers}:
        raise refuse("histogram", _("{name} holds no numbers").format(name=name))
    finite = " AND ".join([*([f"({where})"] if where else []), f"isfinite({quoted(name)})"])
    span = results.spans([name], where=finite)[name]
    low, high = span["least"], span["most"]
    if not low < high:
        low, high = (low - 0.5, low + 0.5) if math.isfinite(low) else (0.0, 1.0)
    width = high / bins - low / bins
    place = f"least(floor(({quoted(name)} - {low!r}) / {width!r}), {bins - 1})"
    rows = results.query(f"SELECT {place} AS k, count({quoted(name)}) AS n FROM {TABLE}{condition(finite)} GROUP BY k")
    counts = np.zeros(bins)
    counts[np.asarray(rows["k"], dtype=int)] = rows["n"]
    edges = low + width * np.arange(bins + 1)
    unknown = results.count(where) - int(np.sum(counts))
    return Histogram(column=column, edges=edges, counts=counts, mean=span["mean"], unknown=unknown)


@dataclass(frozen=True, eq=False, kw_only=True)
class Ranks:
    """How an answer rises and falls with each field."""

    answer: Column
    fields: tuple[Column, ...]  # that hold numbers and vary, the weightiest first
    # (d,): of ranks (Spearman): 1 where the answer always rises with the field, -1 where it always falls
    correlation: Array
    points: int  # looked at


def ranks_of(results: Results, answer: str, *, fields: Sequence[str] = (), where: str = "") -> Ranks:
    """Return the rank correlations of an answer with fields.

    fields: others; all points that are numbers by default.
    Of all rows with an answer, or of `DRAWN` drawn from them.
    """
    column = results.column(answer)
    numbers = {one.name: one for one in results.numbers}
    chosen = [results.column(name) for name in fields] or [one for one in results.numbers if one.role == "point"]
    problem = next((name for name in (answer, *(one.name for one in chosen)) if name not in numbers), None)
    if problem is not None:
        raise refuse("tornado", _("{name} holds no numbers").format(name=problem))
    told = " AND ".join([*([f"({where})"] if where else []), f"{quoted(answer)} IS NOT NULL"])
    rows = results.sample(list(dict.fromkeys([answer, *(one.name for one in chosen)])), DRAWN, where=told)
    mine = scipy.stats.rankdata(rows[answer])
    found = []
    for one in chosen:
        other = scipy.stats.rankdata(rows[one.name])
        if one.name != answer and len(mine) > 1 and np.ptp(other) > 0.0 and np.ptp(mine) > 0.0:
            found.append((float(np.corrcoef(mine, other)[0, 1]), one))
    found.sort(key=lambda pair: -abs(pair[0]))
    correlation = np.asarray([value for value, _one in found])
    return Ranks(answer=column, fields=tuple(one for _value, one in found), correlation=correlation, points=len(mine))
