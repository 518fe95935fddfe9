"""Layouts by their graph against trying everything, by minimum cuts and by the rank of screws at a general position."""

import itertools

import numpy as np
import pytest

from cardan.maths.kernel import screws
from cardan.mechanism.constraints import constraints
from cardan.mechanism.counting import partition
from cardan.mechanism.layouts import BEARINGS, Layout, layouts, number_of_layouts
from cardan.mechanism.mechanism import Mechanism, Pair

PARTS = ("", *BEARINGS)


def everything(joints, *, splines):
    """Every way to choose joints, splines and bearings of a chain, held well or not."""
    for ways in itertools.product(*joints):
        for cut in itertools.product((False, True), repeat=len(joints) + 1):
            if sum(cut) <= splines:
                held = [itertools.product(PARTS, repeat=1 + one) for one in cut[1:]]
                first = [("R", *rest) for rest in itertools.product(PARTS, repeat=int(cut[0]))]
                for shafts in itertools.product(first, *held):
                    yield Layout(joints=ways, shafts=shafts)


def by_cut(one):
    """Whether the graph moves once and nothing of it is held twice: the minimum cut of `partition`."""
    found = partition(one.graph, frame="0", input_link="1")
    return (found.mobility, found.redundant) == (1, 0)


def by_sets(one):
    """Whether every set of parts moves in one way at least, and all of them together in just one."""
    links = sorted({link for pair in one.graph for link in pair.links} - {"0"})

    def moves(some):
        inside = {"0", *some}
        return 6 * len(some) - sum(pair.constraints for pair in one.graph if set(pair.links) <= inside)

    sets = (some for size in range(1, len(links)) for some in itertools.combinations(links, size))
    return moves(links) == 1 and all(moves(some) >= 1 for some in sets)


def key(one):
    return one.joints, one.shafts


def mechanism(one, seed):
    """The pairs of a layout on shafts that lie anyhow, in the order of its graph; every joint of 2 is a cross."""
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(loc=(3.0, 0.0, 0.0), size=(len(one.shafts) + 1, 3)), axis=0)
    axis = np.diff(points, axis=0)
    pairs, link = [], 1

    def joined(kind, ends, point, way, second=None):
        pairs.append(
            Pair(
                id=f"{len(pairs)}",
                type=kind,
                links=ends,
                point=tuple(point),
                axis=tuple(way),
                axis2=None if second is None else tuple(second),
            )
        )

    for k, parts in enumerate(one.shafts):
        start, way = points[k], axis[k]
        for place, bearing in enumerate(parts):
            if place:
                joined("P", (f"{link}", f"{link + 1}"), start + 0.5 * way, way)
                link += 1
            elif k:
                before, (first, second) = f"{link}", rng.normal(size=(2, 3))
                for step in {2: "U", 3: "PU", 5: "PPPU"}[one.joints[k - 1]]:
                    link += 1
                    along = axis[k - 1] if one.joints[k - 1] == 3 else rng.normal(size=3)
                    slide = step == "P"
                    joined(step, (before, f"{link}"), start, along if slide else first, None if slide else second)
                    before = f"{link}"
            if bearing:
                joined(bearing, ("0", f"{link}"), start + (0.3 + 0.4 * place) * way, way)
    return Mechanism(frame="0", input_link="1", joints=tuple(pairs))


def regular(one, seed=3):
    """Whether its constraints are independent and leave one motion, in which the input turns."""
    whole = mechanism(one, seed)
    system = constraints(whole)
    matrix = system.matrix()
    held = np.concatenate((matrix, system.holding([whole.links.index("1")])))
    rank = screws.rank(matrix).value
    return rank == len(matrix) == matrix.shape[1] - 1 and screws.rank(held).value == matrix.shape[1]


@pytest.mark.parametrize(
    ("joints", "splines"),
    [
        ([(2, 3, 5)], 2),
        ([(2,), (2,)], 1),
        pytest.param([(2, 3, 5), (2, 5)], 1, marks=pytest.mark.slow),
        pytest.param([(2,), (2,)], 3, marks=pytest.mark.slow),
    ],
)
def test_none_is_missing_and_none_too_many(joints, splines):
    """All sets of parts of every choice there is say the same."""
    tried = {key(one) for one in everything(joints, splines=splines) if by_sets(one)}
    found = [key(one) for one in layouts(joints, splines=splines)]
    assert len(found) == len(set(found)) == number_of_layouts(joints, splines=splines)
    assert set(found) == tried
    assert all(by_cut(one) for one in layouts(joints, splines=splines))


@pytest.mark.slow
@pytest.mark.parametrize(("joints", "splines"), [([(2, 3, 5)], 2), ([(2,), (2,)], 1)])
def test_what_the_rank_allows_the_graph_allows(joints, splines):
    """Geometry can only take away: no layout that is regular where shafts lie anyhow is missing."""
    found = {key(one) for one in layouts(joints, splines=splines)}
    true = {key(one) for one in everything(joints, splines=splines) if regular(one)}
    assert true
    assert true <= found
    assert {key(one) for one in layouts(joints, splines=splines) if regular(one, seed=5)} == true


def test_the_numbers_grow_as_the_paths_are_counted():
    """Without splines crosses leave two ways each: by hand 1, 2 and 5 layouts."""
    assert [number_of_layouts([(2,)] * n, splines=0) for n in (1, 2, 3)] == [1, 2, 5]
    assert [number_of_layouts([(2,)] * n) for n in (1, 2, 3, 6)] == [5, 45, 425, 361125]


def test_those_with_the_fewest_parts_come_first():
    parts = [one.parts for one in layouts([(2,)] * 3)]
    assert len(parts) == 425
    assert parts == sorted(parts)
    first = next(layouts([(2,)] * 12))
    assert first.parts <= min(parts) + 12


BOOK = {
    "a": (("R",), ("SG",), ("", ""), ("R",)),
    "b": (("R",), ("", ""), ("R",), ("SG",)),
    "e": (("R",), ("C",), ("", ""), ("S",)),
}
"""Three-joint drives of Book Fig. 47; c and d are b with a group for the last bearing."""


def test_the_drives_of_the_book_are_among_them_and_the_faulty_one_is_not():
    found = {one.shafts for one in layouts([(2,)] * 3)}
    assert BOOK["a"] in found
    assert BOOK["b"] in found
    assert BOOK["e"] not in found
    assert regular(Layout(joints=(2, 2, 2), shafts=BOOK["a"]))
    assert regular(Layout(joints=(2, 2, 2), shafts=BOOK["b"]))
    assert not by_cut(Layout(joints=(2, 2, 2), shafts=BOOK["e"]))


def test_mirror_images_hold_just_enough_too():
    every = list(layouts([(2, 3)] * 2))
    found = {key(one) for one in every}
    ends = [one for one in every if one.mirrored is not None]
    assert ends
    for one in ends:
        assert one.mirrored.mirrored == one
        assert key(one.mirrored) in found
