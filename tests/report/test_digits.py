"""Digits of the report: as many as tell numbers apart."""

import re

from cardan.io import example
from cardan.report.block import Words
from cardan.report.phasing import phasing
from cardan.report.subject import asked


def test_sides_of_small_bends_have_three_digits():
    said = " ".join(
        one.text
        for one in phasing(asked(example("two-piece-rubber-bearing"), None, None)).blocks
        if isinstance(one, Words)
    )
    sides = re.search(r"here ([0-9., ]+), and", said)
    assert sides is not None
    longest = max(sides[1].split(", "), key=float)
    assert len(longest.lstrip("0.")) == 3
