"""Reductions against plain NumPy on the whole table, however the rows were cut, and through JSON."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest

from cardan import InputError
from cardan.batch.points.axes import Points
from cardan.batch.table import summaries
from cardan.batch.table.reductions import KINDS, Reduce, at_work, reduce_of
from cardan.batch.work import Column
from cardan.sweeps import GridAxis, TableAxis

COUNT = 600
POINTS = Points(
    axes=(
        TableAxis(fields=("maker",), rows=(("a",), ("b",), ("c",)), facts=("maker",)),
        GridAxis(field="x_mm", start=0.0, stop=1.0, count=COUNT // 3),
    )
)
COLUMNS = tuple(
    Column(name=name, unit=unit, role=role, text=name)
    for name, unit, role in (("maker", "", "point"), ("x_mm", "mm", "point"), ("y_deg", "deg", "answer"))
)


def table():
    rng = np.random.default_rng(2)
    rows = POINTS.values(0, COUNT)
    rows["y_deg"] = np.round(rng.normal(10.0, 3.0, COUNT), 1)  # rounded: many are equal
    rows["status"] = (rng.random(COUNT) < 0.1).astype(np.int8)
    rows["y_deg"][rows["status"] != 0] = math.nan
    return rows


ROWS = table()
ANSWERED = ROWS["y_deg"][ROWS["status"] == 0]


def told(what, cuts=(0, COUNT)):
    """Reduce the table in pieces, each of which goes through JSON, and merge them."""
    (one,) = at_work([reduce_of(what) if isinstance(what, str) else what], POINTS, COLUMNS)
    state = one.empty()
    for start, stop in pairwise(cuts):
        part = {name: values[start:stop] for name, values in ROWS.items()}
        more = one.add(one.empty(), part, start)
        state = one.merge(state, json.loads(json.dumps(more)))
    return json.loads(json.dumps(one.result(state)))


CUTS = [(0, COUNT), (0, 1, 7, 300, 300, 599, COUNT), tuple(range(0, COUNT + 1, 50))]


@pytest.mark.parametrize("cuts", CUTS, ids=len)
def test_single_values_are_those_of_the_whole_table(cuts):
    assert told("max y_deg", cuts)["value"] == ANSWERED.max()
    assert told("min y_deg", cuts)["value"] == ANSWERED.min()
    assert told("mean y_deg", cuts)["value"] == pytest.approx(ANSWERED.mean(), rel=1e-14)
    assert told("std y_deg", cuts)["value"] == pytest.approx(ANSWERED.std(ddof=1), rel=1e-13)
    for percent in (0, 12.5, 50, 95, 100):
        found = told(f"p{percent} y_deg", cuts)
        assert found["value"] == pytest.approx(np.percentile(ANSWERED, percent), rel=1e-14)
        assert found["bound"] == 0.0
    assert told("count y_deg >= 10", cuts)["value"] == np.count_nonzero(ANSWERED >= 10)
    assert told("share 8 <= y_deg <= 10", cuts)["value"] == np.mean((ANSWERED >= 8) & (ANSWERED <= 10))


@pytest.mark.parametrize("cuts", CUTS, ids=len)
def test_the_greatest_point_is_the_first_of_equal_ones(cuts):
    for kind, best in (("argmax", np.nanmax), ("argmin", np.nanmin)):
        found = told(f"{kind} y_deg", cuts)
        row = int(np.flatnonzero(ROWS["y_deg"] == best(ROWS["y_deg"]))[0])
        assert found["row"] == row
        assert found["point"] == {"maker": ROWS["maker"][row], "x_mm": pytest.approx(ROWS["x_mm"][row])}


@pytest.mark.parametrize("cuts", CUTS, ids=len)
def test_groups_are_told_apart(cuts):
    kinds = {"max": np.nanmax, "mean": np.nanmean, "argmin": np.nanmin, "p50": np.nanmedian}
    for kind, plain in kinds.items():
        found = told(f"{kind} y_deg by maker", cuts)
        assert [group["maker"] for group in found["groups"]] == ["a", "b", "c"]
        expected = [plain(ROWS["y_deg"][ROWS["maker"] == name]) for name in "abc"]
        assert [one["value"] for one in found["values"]] == pytest.approx(expected, rel=1e-13)
    share = told("share y_deg >= 10 by maker", cuts)["values"][1]
    of = ROWS["y_deg"][(ROWS["maker"] == "b") & (ROWS["status"] == 0)]
    assert share == {"value": np.mean(of >= 10), "rows": of.size}


def test_a_histogram_with_ends_counts_what_lies_outside():
    found = told(Reduce(kind="histogram", of="y_deg", bins=8, low=6.0, high=14.0))
    counts, edges = np.histogram(ANSWERED, bins=8, range=(6.0, 14.0))
    assert (found["counts"], found["edges"]) == (counts.tolist(), edges.tolist())
    assert found["below"] == np.count_nonzero(ANSWERED < 6.0)
    assert found["above"] == np.count_nonzero(ANSWERED > 14.0)


@pytest.mark.parametrize("cuts", CUTS, ids=len)
def test_a_histogram_without_ends_covers_all(cuts):
    found = told("histogram y_deg", cuts)
    edges = np.asarray(found["edges"])
    assert len(found["counts"]) <= 50
    width = np.diff(edges)
    assert np.all(width == width[0])
    assert math.frexp(width[0])[0] == 0.5  # a power of two
    inside = [np.count_nonzero((a <= ANSWERED) & (b > ANSWERED)) for a, b in pairwise(edges)]
    assert found["counts"] == inside


def test_conditions_choose_the_rows():
    found = told(Reduce(kind="mean", of="y_deg", where=reduce_of("count x_mm <= 0.5").where))
    held = (ROWS["status"] == 0) & (ROWS["x_mm"] <= 0.5)
    assert found["value"] == pytest.approx(ROWS["y_deg"][held].mean(), rel=1e-13)


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 1, 0, 2)])
def test_percentiles_of_many_numbers_keep_their_bound_in_any_order(order, monkeypatch):
    monkeypatch.setattr(summaries, "KEPT", 1000)
    monkeypatch.setattr(summaries, "BINS", 512)
    rng = np.random.default_rng(4)
    parts = [rng.lognormal(0.0, 1.0, size) for size in (1500, 30, 4000, 700)]
    whole = np.concatenate(parts)
    state = summaries.rank_empty(1)
    for k in order:
        state = summaries.rank_merge(state, summaries.rank_add(summaries.rank_empty(1), parts[k], None))
    seen = json.loads(json.dumps(state[0]))
    assert 256 <= len(seen["counts"]) <= 512
    assert sum(seen["counts"]) == whole.size
    for share in (0.01, 0.5, 0.99):
        value, bound = summaries.rank_result(seen, share)
        near = np.sort(whole)[[math.floor(share * (whole.size - 1)), math.ceil(share * (whole.size - 1))]]
        assert near[0] - bound <= value <= near[1] + bound
        assert bound <= np.ptp(whole) / 256


def test_the_histogram_of_ranks_depends_on_the_numbers_alone(monkeypatch):
    monkeypatch.setattr(summaries, "KEPT", 300)
    values = np.random.default_rng(5).normal(0.0, 1e6, 5000)
    whole = summaries.rank_add(summaries.rank_empty(1), values, None)
    state = summaries.rank_empty(1)
    for part in np.array_split(values[::-1], 37):
        state = summaries.rank_add(state, part, None)
    assert state == whole


def test_unlimited_lives_stand_at_the_end():
    state = summaries.rank_add(summaries.rank_empty(1), np.asarray([1.0, math.inf, 2.0, math.inf]), None)
    assert summaries.rank_result(state[0], 0.0) == (1.0, 0.0)
    assert summaries.rank_result(state[0], 1.0)[0] == math.inf


def test_nothing_seen_tells_nothing():
    (one,) = at_work([reduce_of("max y_deg by maker")], POINTS, COLUMNS)
    assert [value["value"] for value in one.result(one.empty())["values"]] == [None] * 3


@pytest.mark.parametrize(
    ("what", "field", "expected"),
    [
        (Reduce(kind="max", of="z"), "reduce[0].of", "known"),
        (Reduce(kind="max", of="y_dg"), "reduce[0].of", "y_deg"),
        (Reduce(kind="most", of="y_deg"), "reduce[0].kind", "none of"),
        (Reduce(kind="share"), "reduce[0].where", "missing"),
        (Reduce(kind="max", of="y_deg", by=("y_deg",)), "reduce[0].by", "does not vary"),
        (Reduce(kind="percentile", of="y_deg", percent=101), "reduce[0].percent", "101"),
        (Reduce(kind="histogram", of="y_deg", low=1.0), "reduce[0].low", "both"),
        (Reduce(kind="histogram", of="y_deg", low=1.0, high=1.0), "reduce[0].high", "above"),
    ],
)
def test_what_cannot_be_told_is_refused(what, field, expected):
    with pytest.raises(InputError, match=expected) as error:
        at_work([what], POINTS, COLUMNS)
    assert error.value.field == field


@pytest.mark.parametrize("text", ["", "max", "greatest y", "percentile y", "p y", "share", "count y about 3"])
def test_texts_that_tell_nothing_are_refused(text):
    with pytest.raises(InputError):
        reduce_of(text)


@pytest.mark.parametrize(("low", "high", "bins"), [(0.0, 1.0, 10), (0.1, 0.7, 6), (1e-3, 5e-3, 40)])
def test_numbers_on_an_edge_count_where_the_edges_told_put_them(low, high, bins):
    edges = np.linspace(low, high, bins + 1)
    values = np.concatenate([edges, np.nextafter(edges, -9.0), np.nextafter(edges, 9.0), [-np.inf, np.inf]])
    state = summaries.histogram_add(summaries.histogram_empty(1, bins), values, None, low=low, high=high)
    assert state["counts"] == [np.histogram(values[np.isfinite(values)], edges)[0].tolist()]
    assert state["below"] == [np.count_nonzero(values < low)]
    assert state["above"] == [np.count_nonzero(values > high)]


@pytest.mark.parametrize("percent", [0, 1, 12.5, 95, 99.9, 100])
def test_percentiles_of_few_numbers_are_those_of_numpy_bit_for_bit(percent):
    values = np.random.default_rng(1).normal(size=4999)
    state = summaries.rank_add(summaries.rank_empty(1), values, None)
    value = Reduce(kind="percentile", of="y_deg", percent=percent)
    assert KINDS["percentile"].value(value, state, 0, dict)["value"] == np.percentile(values, percent)


def test_a_mean_with_an_infinite_number_is_infinite_however_it_is_cut():
    def seen(*values):
        return summaries.moment_add(summaries.moment_empty(1), np.asarray(values), None)

    for whole in (seen(1.0, math.inf), *(summaries.moment_merge(*two) for two in _both(seen(1.0), seen(math.inf)))):
        assert whole["mean"] == [math.inf]
        assert KINDS["std"].value(Reduce(kind="std"), whole, 0, dict)["value"] is None


def _both(one, other):
    return (one, other), (other, one)
