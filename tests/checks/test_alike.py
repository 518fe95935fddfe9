"""Verdicts that say the same of several parts: the worst of them is the one that is shown."""

from cardan import example
from cardan.checks import check
from cardan.checks.verdict import Verdict
from cardan.checks.verdict_table import alike, title_of


def verdict(number: int, value: float) -> Verdict:
    subject = f"shafts[{number - 1}]"
    kind = "length of shaft {number}"
    title = kind.format(number=number)
    return Verdict(check="length", kind=kind, title=title, subject=subject, value=value, limit=1500.0)


def test_the_one_that_uses_most_stands_for_the_others():
    (group,) = alike([verdict(2, 700.9), verdict(3, 703.5), verdict(4, 702.2)])
    assert (title_of(group), group[0].value) == ("length of shaft 3 (and 2, 4)", 703.5)


def test_those_that_read_the_same_keep_their_order():
    (group,) = alike([verdict(1, 700.9), verdict(2, 700.9 * (1.0 + 1e-15))])
    assert title_of(group) == "length of shaft 1 (and 2)"


def test_no_group_hides_what_uses_more():
    found = [one for one in check(example("propshaft-with-rzeppa")) if one.run]
    assert all(group[0].utilisation >= 0.9999 * max(one.utilisation for one in group) for group in alike(found))
