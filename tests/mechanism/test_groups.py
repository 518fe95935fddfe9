import itertools

import pytest

from cardan import InputError
from cardan.mechanism.counting import group, minus_groups, zero_groups

# Book Tables 2 and 3 as far as they are legible, completed by hand.
ZERO = {
    1: "51 42 33",
    2: "552 543 534 525 453 444",
    3: "5553 5544 5535 5454 5445 4554",
    4: "55554 55545 55455",
    5: "555555",
    6: "",
}
MINUS = {
    (1, 1): "52 43",
    (1, 2): "553 544 535 454",
    (1, 3): "5554 5545",
    (1, 4): "55555",
    (2, 1): "53 44",
    (2, 2): "554 545",
    (2, 3): "5555",
    (3, 1): "54",
    (3, 2): "555",
    (4, 1): "55",
    (4, 2): "",
    (5, 1): "",
}


def strings(groups):
    return " ".join("".join(map(str, one.constraints)) for one in groups)


@pytest.mark.parametrize("links", ZERO)
def test_zero_groups_are_those_of_the_table(links):
    assert strings(zero_groups(links)) == ZERO[links]


@pytest.mark.parametrize(("constraints", "links"), MINUS)
def test_minus_groups_are_those_of_the_table(constraints, links):
    assert strings(minus_groups(constraints, links)) == MINUS[constraints, links]


def test_enumeration_finds_what_trying_every_string_finds():
    for links in range(1, 5):
        every = {max(s, s[::-1]) for s in itertools.product(range(1, 6), repeat=links + 1)}
        for constraints in range(5):
            wanted = {s for s in every if 6 * links - sum(s) == -constraints}
            assert {one.constraints for one in minus_groups(constraints, links)} == wanted


def test_a_group_is_told_by_its_mobility():
    assert (group([5, 5, 5]).kind, group([5, 5, 5]).net) == ("minus", 3)
    assert (group([5, 2, 5]).kind, group([5, 2, 5]).links) == ("zero", 2)
    assert (group([4, 4, 3]).kind, group([4, 4, 3]).mobility) == ("plus", 1)  # 5-2-5 is a zero dyad, not a minus one


@pytest.mark.parametrize(("given", "field"), [([5], "constraints"), ([], "constraints"), ([5, 6], "constraints[1]")])
def test_what_is_no_chain_is_refused(given, field):
    with pytest.raises(InputError) as caught:
        group(given)
    assert caught.value.field == field
