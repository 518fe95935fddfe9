"""Key figures of one name are one quantity: what the first page tells is what its chapters tell."""

from collections import defaultdict

import pytest

from cardan import check, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.io.examples import example_names
from cardan.report.block import key_figures
from tests.builders.reports import content_of


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_the_first_page_tells_what_its_chapters_tell(name):
    drive = example(name)
    pages = content_of(name).pages
    every = defaultdict(list)
    for page in pages:
        for key in page.keys:
            every[key.name].append(key)
    for keys in every.values():
        # another value of the same name is that of another condition, which its place names, or of a drive that moves
        for one in keys[1:]:
            alike = one.value.value == pytest.approx(keys[0].value.value, rel=1e-9, abs=1e-12)
            assert alike or told(one.called, USUAL) != told(keys[0].called, USUAL), keys
            assert one.value.dimension == keys[0].value.dimension
            moved = "moving" in told(one.title, USUAL) or bool(drive.movements) or bool(drive.poses)
            assert alike or moved, keys
    first = {key.name: key for key in key_figures([page.keys for page in pages])}
    assert set(first) == set(every)
    verdicts = [one for one in check(drive) if one.run]
    for key in first.values():
        own = [float(one.value) for one in verdicts if one.check == key.check]
        if own and key.place == "" and not drive.movements and not drive.poses:
            assert any(key.value.value == pytest.approx(value, rel=1e-6, abs=1e-9) for value in own), key


def test_the_angle_error_of_a_perfect_drive_is_not_that_of_its_joints_as_made():
    """Both stand on the first page: how the output runs by design, and what errors and tolerances add."""
    titles = {
        told(key.called, USUAL): key.value.value for page in content_of("instrument-joint").pages for key in page.keys
    }
    design = titles["angle error of the output, ±"]
    made = titles["angle error of the output by the joints as made, root of squares"]
    assert design > 10.0 * made
