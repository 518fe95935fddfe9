"""Keys of the drive file in words, where pages of the report speak of them."""

import re

import pytest

from cardan.checks import check
from cardan.checks.design import design
from cardan.drive.fields.keys import meant
from cardan.drive.fields.wording import in_words
from cardan.io import example


@pytest.mark.parametrize("name", ["truck-duty-cycle", "two-piece-rubber-bearing", "w-arrangement"])
def test_every_lever_has_words_with_numbers_from_one(name):
    drive = design(example(name)).drive
    design_variables = {path for one in check(drive) for path in one.design_variables}
    assert design_variables
    for path in design_variables:
        said = in_words(path)
        assert meant(re.sub(r"\[\d\]$", "", path)), path
        assert not re.search(r"[\[\]_;]", said), said
        numbered = re.match(r"(?:joints|shafts)\[(\d+)\]", path)
        assert numbered is None or f" {int(numbered[1]) + 1}" in said


def test_a_torque_of_the_duty_is_told_without_the_end_where_it_acts():
    told = in_words("duty.torque"), in_words("duty.blocks[0].torque"), in_words("joints[0].rating.max_torque")
    assert told == ("torque", "part 1 of the duty cycle: torque", "joint 1, rating: largest torque")
