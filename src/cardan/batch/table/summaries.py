"""What summaries have seen of many numbers, group by group: states that merge in any order and that JSON holds.

Every state has one entry for each group; ``add`` puts further numbers in, ``merge`` joins two states.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np

from cardan.batch.work import State
from cardan.maths.arrays import Array

Groups: TypeAlias = "Array | None"  # group of each number, array of int (n,); None where there is one group
KEPT = 50_000  # so many numbers are kept as they are for a percentile; of more, a histogram is
BINS = 16_384  # bins of such a histogram at most; it has at least half as many


def _lists(count: int, **blank: Any) -> State:
    return {name: [value] * count for name, value in blank.items()}


def _split(values: Array, groups: Groups, count: int) -> list[Array]:
    """Return the numbers of each group, in their order."""
    if groups is None:
        return [values]
    order = np.argsort(groups, kind="stable")
    ends = np.searchsorted(groups[order], np.arange(count + 1))
    return [values[order[a:b]] for a, b in pairwise(ends)]


# ---- extremes: the best number and the first row that has it


def extreme_empty(count: int) -> State:
    """Return the state of no numbers."""
    return _lists(count, best=None, row=-1)


def extreme_add(state: State, values: Array, rows: Array, groups: Groups, *, largest: bool) -> State:
    """Return the state with further numbers, each from its row; of equal ones the lowest row counts."""
    count = len(state["best"])
    found = extreme_empty(count)
    if groups is None and values.size:
        k = int(np.argmax(values) if largest else np.argmin(values))
        found["best"][0], found["row"][0] = float(values[k]), int(rows[k])
    elif groups is not None and values.size:
        best = np.full(count, -np.inf if largest else np.inf)
        (np.maximum if largest else np.minimum).at(best, groups, values)
        at = np.flatnonzero(values == best[groups])[::-1]  # backwards, so that the first row is written last
        first = np.full(count, -1, dtype=np.int64)
        first[groups[at]] = rows[at]
        seen = (first >= 0).tolist()
        found["best"] = [value if there else None for value, there in zip(best.tolist(), seen, strict=True)]
        found["row"] = first.tolist()
    return extreme_merge(state, found, largest=largest)


def extreme_merge(one: State, other: State, *, largest: bool) -> State:
    """Return the state that has seen both."""
    merged = extreme_empty(len(one["best"]))
    for k, (a, b) in enumerate(zip(one["best"], other["best"], strict=True)):
        i, j = one["row"][k], other["row"][k]
        if a is None or (b is not None and ((b > a if largest else b < a) or (b == a and j < i))):
            a, i = b, j
        merged["best"][k], merged["row"][k] = a, i
    return merged


# ---- moments: count, mean, sum of squares about it


def moment_empty(count: int) -> State:
    """Return the state of no numbers."""
    return _lists(count, n=0, mean=0.0, square=0.0)


def moment_add(state: State, values: Array, groups: Groups) -> State:
    """Return the state with further numbers."""
    count = len(state["n"])
    if groups is None:
        n = np.asarray([values.size])
        mean = np.asarray([float(np.mean(values)) if values.size else 0.0])
        with np.errstate(invalid="ignore"):  # of an infinite number there is no distance
            square = np.asarray([float(np.sum(np.square(values - mean[0])))])
    else:
        n = np.bincount(groups, minlength=count)
        mean = np.bincount(groups, values, minlength=count) / np.maximum(n, 1)
        with np.errstate(invalid="ignore"):
            square = np.bincount(groups, (values - mean[groups]) ** 2, minlength=count)
    return moment_merge(state, {"n": n.tolist(), "mean": mean.tolist(), "square": square.tolist()})


def moment_merge(one: State, other: State) -> State:
    """Return the state that has seen both (Chan, Golub, LeVeque 1979)."""
    merged = moment_empty(len(one["n"]))
    for k, (n, m) in enumerate(zip(one["n"], other["n"], strict=True)):
        whole = n + m
        if whole:
            step = other["mean"][k] - one["mean"][k]
            merged["n"][k] = whole
            merged["mean"][k] = one["mean"][k] + step * (m / whole) if n and m else (other if m else one)["mean"][k]
            if not math.isfinite(step):
                merged["mean"][k] = one["mean"][k] + other["mean"][k]
            merged["square"][k] = (
                one["square"][k] + other["square"][k] + (step * step * n * m / whole if n and m else 0.0)
            )
    return merged


# ---- counts


def count_empty(count: int) -> State:
    """Return the state of no rows."""
    return _lists(count, n=0, of=0)


def count_add(state: State, chosen: Array, groups: Groups) -> State:
    """Return the state with further rows, those chosen among them."""
    count = len(state["n"])
    if groups is None:
        return count_merge(state, {"n": [int(np.count_nonzero(chosen))], "of": [int(chosen.size)]})
    n, of = np.bincount(groups, chosen, minlength=count).astype(int), np.bincount(groups, minlength=count)
    return count_merge(state, {"n": n.tolist(), "of": of.tolist()})


def count_merge(one: State, other: State) -> State:
    """Return the state that has seen both."""
    return {name: [a + b for a, b in zip(one[name], other[name], strict=True)] for name in one}


# ---- histograms with given edges


def histogram_empty(count: int, bins: int) -> State:
    """Return the state of no numbers."""
    return {"below": [0] * count, "above": [0] * count, "counts": [[0] * bins for _k in range(count)]}


def histogram_add(state: State, values: Array, groups: Groups, *, low: float, high: float) -> State:
    """Return the state with further numbers; the upper end belongs to the last bin."""
    count, bins = len(state["counts"]), len(state["counts"][0])
    edges = np.concatenate([[np.nan], np.linspace(low, high, bins + 1), [np.nan]])
    place = np.clip(np.floor((values - low) * (bins / (high - low))), -1, bins).astype(int) + 1
    place -= values < edges[place]  # next to an edge the quotient may have been rounded over it
    place += values >= edges[place + 1]
    place[values == high] = bins
    place += 0 if groups is None else groups * (bins + 2)
    table = np.bincount(place, minlength=count * (bins + 2)).reshape(count, bins + 2)
    found = {"below": table[:, 0].tolist(), "above": table[:, -1].tolist(), "counts": table[:, 1:-1].tolist()}
    return histogram_merge(state, found)


def histogram_merge(one: State, other: State) -> State:
    """Return the state that has seen both."""
    pairs = zip(one["counts"], other["counts"], strict=True)
    return {
        "below": [a + b for a, b in zip(one["below"], other["below"], strict=True)],
        "above": [a + b for a, b in zip(one["above"], other["above"], strict=True)],
        "counts": [[x + y for x, y in zip(a, b, strict=True)] for a, b in pairs],
    }


# ---- ranks: numbers as they are, or a histogram whose bins are powers of two wide


def rank_empty(count: int) -> State:
    """Return the state of no numbers."""
    return [{"kept": [], "least": 0, "most": 0, "exponent": None, "first": 0, "counts": []} for _k in range(count)]


def rank_add(state: State, values: Array, groups: Groups) -> State:
    """Return the state with further numbers; infinite ones are counted at the ends."""
    parts = _split(values, groups, len(state))
    return [_ranked(seen, part, len(state)) for seen, part in zip(state, parts, strict=True)]


def _ranked(seen: Mapping[str, Any], values: Array, share: int) -> State:
    finite = values[np.isfinite(values)]
    infinite = values[~np.isfinite(values)]
    found: dict[str, Any] = {
        "kept": np.sort(finite).tolist() if finite.size <= room(share)[0] else None,
        "least": int(np.count_nonzero(infinite < 0.0)),
        "most": int(np.count_nonzero(infinite > 0.0)),
        "exponent": None,
        "first": 0,
        "counts": [],
    }
    return _joined(seen, found, share, finite)


def room(share: int) -> tuple[int, int]:
    """Return how many numbers each of so many groups may keep, and how many bins its histogram may have."""
    return max(256, KEPT // share), max(256, BINS // share)


def rank_merge(one: State, other: State) -> State:
    """Return the state that has seen both."""
    return [_joined(a, b, len(one), None) for a, b in zip(one, other, strict=True)]


def _joined(one: Mapping[str, Any], other: Mapping[str, Any], share: int, new: Array | None) -> State:
    """Return one state of two; ``new`` are the numbers of the other where it could not keep them."""
    keep, bins = room(share)
    least, most = one["least"] + other["least"], one["most"] + other["most"]
    blank = {"least": least, "most": most, "exponent": None, "first": 0, "counts": []}
    a, b = one["kept"], other["kept"]
    if a is not None and b is not None and len(a) + len(b) <= keep:
        return {**blank, "kept": np.sort(np.asarray(a + b, dtype=float), kind="stable").tolist()}
    raw = [np.asarray(kept, dtype=float) for kept in (a, b) if kept]
    raw += [new] if b is None and new is not None else []
    given = [part for part in (one, other) if part["exponent"] is not None]
    exponent, first, counts = binned(raw, given, bins)
    return {**blank, "kept": None, "exponent": exponent, "first": first, "counts": counts}


def binned(raw: list[Array], given: list[Mapping[str, Any]], bins: int) -> tuple[int, int, list[int]]:
    """Return the histogram of numbers and of other histograms: exponent of its bins, number of the first, counts.

    Bin j of width 2^e holds j·2^e ≤ x < (j+1)·2^e; e is the least with which all numbers lie in so many bins, so that
    it depends on the numbers alone and not on the order in which they came. A histogram that is too fine for it is
    coarsened exactly, j → ⌊j/2⌋.
    """
    ends = [float(edge) for part in raw if part.size for edge in (part.min(), part.max())]
    lowest = [math.frexp(max((abs(one) for one in ends), default=1.0))[1] - 52]
    exponent = max([*(int(part["exponent"]) for part in given), *([] if given else lowest)])

    def places(e: int) -> list[int]:
        here: list[int] = [math.floor(math.ldexp(one, -e)) for one in ends]
        for part in given:
            down = e - int(part["exponent"])
            here += [int(part["first"]) >> down, (int(part["first"]) + len(part["counts"]) - 1) >> down]
        return here

    found = places(exponent)
    while found and max(found) - min(found) >= bins:
        exponent += 1
        found = places(exponent)
    first = min(found, default=0)
    counts = np.zeros(max(found, default=0) - first + 1, dtype=np.int64)
    for part in raw:
        at = np.floor(np.ldexp(part, -exponent)).astype(np.int64) - first
        counts += np.bincount(at, minlength=counts.size)
    for part in given:
        old = np.arange(len(part["counts"]), dtype=np.int64) + int(part["first"])
        at = (old >> (exponent - int(part["exponent"]))) - first
        np.add.at(counts, at, np.asarray(part["counts"], dtype=np.int64))
    return exponent, first, counts.tolist()


def rank_result(seen: Mapping[str, Any], share: float) -> tuple[float, float]:
    """Return a percentile and how far it may be off.

    seen: the state of one group; share: in [0, 1].
    Between the two numbers next to place share·(n - 1), in proportion, as `numpy.percentile` has it; of a histogram
    the middle of the bin that holds that place, half its width off at most. nan where nothing was seen.
    """
    least, most = seen["least"], seen["most"]
    inner = len(seen["kept"]) if seen["kept"] is not None else sum(seen["counts"])
    total = least + inner + most
    if not total:
        return math.nan, 0.0
    place = share * (total - 1)
    low, part = int(place), place - int(place)
    ends = [_at(seen, k - least, inner) for k in (low, min(low + 1, total - 1))]
    (a, wide), (b, _wide) = ends
    near = part < 0.5 or math.isinf(b - a)  # from the nearer end, which rounds as NumPy does
    value = a if part == 0.0 or a == b else a + part * (b - a) if near else b - (b - a) * (1.0 - part)
    return value, wide if seen["kept"] is None and math.isfinite(value) else 0.0


def _at(seen: Mapping[str, Any], place: int, inner: int) -> tuple[float, float]:
    if not 0 <= place < inner:
        return (-math.inf if place < 0 else math.inf), 0.0
    if seen["kept"] is not None:
        return float(seen["kept"][place]), 0.0
    k = int(np.searchsorted(np.cumsum(seen["counts"]), place, side="right"))
    width = math.ldexp(1.0, seen["exponent"])
    return (seen["first"] + k + 0.5) * width, 0.5 * width
