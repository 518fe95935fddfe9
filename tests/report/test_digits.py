"""Digits of the report: as many as tell numbers apart."""

import re

import numpy as np

from cardan.io import example
from cardan.report.block import Words
from cardan.report.phasing import phasing
from cardan.report.subject import asked
from cardan.report.turning import extremes_table


def test_ratios_of_a_nearly_even_shaft_are_not_alike():
    nearly, uneven = [0.9999506, 1.0000494, 9.88e-5, 1e-5, 1e-4], [0.97, 1.03, 0.06, 0.01, 0.06]
    (first, second) = extremes_table(np.asarray([nearly, uneven]), None, even=1e-13).rows
    assert [cell.text for cell in first[1:3]] == ["0.999951", "1.000049"]
    assert [cell.text for cell in second[1:3]] == ["0.9700", "1.0300"]


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
