import itertools

import numpy as np
import pytest

from cardan import InputError
from cardan.mechanism.counting import Join, joins, partition
from tests.builders.mechanisms import hooke


def graph(text):
    """Pairs written 01 12-3: two links, then the constraints unless they are five."""
    out = []
    for word in text.split():
        ends, _dash, s = word.partition("-")
        a, b = ends.split(".") if "." in ends else ends
        out.append(Join(links=(a, b), constraints=int(s or 5)))
    return out


def by_trying(pairs, frame, given):
    """The least count over all sets of links, and what all sets with it have in common."""
    fixed = {frame, given}
    others = sorted({link for pair in pairs for link in pair.links} - fixed)
    counts = {}
    for size in range(len(others) + 1):
        for some in itertools.combinations(others, size):
            here = set(some)
            inside = [p for p in pairs if set(p.links) <= here | fixed and not set(p.links) <= fixed]
            counts[some] = 6 * size - sum(p.constraints for p in inside)
    least = min(counts.values())
    return -least, tuple(sorted(set.intersection(*(set(s) for s, count in counts.items() if count == least))))


@pytest.mark.parametrize("seed", range(12))
def test_the_cut_finds_what_trying_every_set_finds(seed):
    rng = np.random.default_rng(seed)
    links = int(rng.integers(3, 9))
    ends = [(int(rng.integers(0, k)), k) for k in range(1, links + 1)]
    ends += [tuple(int(x) for x in rng.choice(links + 1, 2, replace=False)) for _k in range(int(rng.integers(1, 5)))]
    pairs = [Join(links=(str(a), str(b)), constraints=int(rng.integers(2, 6))) for a, b in ends]
    found = partition(pairs, frame="0", input_link="1")
    assert (found.redundant, found.overconstrained) == by_trying(pairs, "0", "1")


@pytest.mark.parametrize(
    ("text", "groups"),
    [
        ("01 12 23 30-2 34 45 56 67 78 80", [("45678", 0), ("23", 0)]),
        ("01 12 23 34 45 56 60 67 78 80-2", [("78", 0), ("23456", 0)]),
        ("01 12 23 30-4 34 45 56 67 78 80-3", [("678", 0), ("45", 2), ("23", -2)]),
    ],
)
def test_the_drives_of_the_book_fall_apart_as_it_says(text, groups):
    found = partition(graph(text), frame="0", input_link="1")
    assert [("".join(one.links), one.mobility) for one in found.groups] == groups


def test_the_faulty_drive_hides_from_the_formula_but_not_from_its_parts():
    found = partition(graph("01 12 23 30-4 34 45 56 67 78 80-3"), frame="0", input_link="1")
    assert (found.formula, found.mobility, found.redundant) == (1, 3, 2)
    assert found.overconstrained == ("2", "3")


def test_the_maize_harvester_is_one_group_with_one_constraint_too_many():
    text = "0.1 1.2 2.3 3.4 4.5 5.6 6.7 7.8 8.0 6.10 10.9 9.0"
    found = partition(graph(text), frame="0", input_link="1")
    assert [one.mobility for one in found.groups] == [-1]
    assert found.groups[0].links == ("2", "3", "4", "5", "6", "7", "8", "9", "10")
    assert found.overconstrained[0] == "10"  # sorted as text


def test_an_input_held_in_two_bearings_is_held_too_often_by_itself():
    assert partition(graph("01 12 20"), frame="0", input_link="1").excess == 0
    assert partition(graph("01-3 01-2 12 20"), frame="0", input_link="1").excess == 0
    assert partition(graph("01 01"), frame="0", input_link="1").excess == 5


def test_many_links_are_no_trouble():
    count = 60
    pairs = [Join(links=(str(k), str((k + 1) % count)), constraints=5) for k in range(count)]
    found = partition(pairs, frame="0", input_link="1")
    assert (found.redundant, found.formula) == (0, 6 * (count - 1) - 5 * count)


def test_a_mechanism_has_its_graph():
    assert [one.constraints for one in joins(hooke(kinds="RRCS"))] == [5, 5, 4, 3]


@pytest.mark.parametrize(
    ("text", "frame", "given", "field"),
    [
        ("01 12 34", "0", "1", "pairs"),
        ("01 11", "0", "1", "pairs[1].links"),
        ("01 12-6", "0", "1", "pairs[1].constraints"),
        ("01 12", "9", "1", "frame"),
        ("01 12", "0", "0", "input_link"),
        ("01 12", "0", "7", "input_link"),
        ("", "0", "1", "pairs"),
    ],
)
def test_what_is_no_graph_is_named(text, frame, given, field):
    with pytest.raises(InputError) as caught:
        partition(graph(text), frame=frame, input_link=given)
    assert caught.value.field == field
