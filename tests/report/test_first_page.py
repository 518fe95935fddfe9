"""Which key figures stand on the first page: those of all answers, each once."""

from collections import Counter
from dataclasses import replace

import pytest

from cardan.answers.answer import KeyFigure
from cardan.answers.quantity import Quantity
from cardan.answers.reader import USUAL
from cardan.io import example
from cardan.report.block import Points, Table, Words, key_figures, row, untold
from cardan.report.content import content
from tests.builders.reports import content_of
from tests.report.first_page import key_rows


def figures(answer, **values):
    return [KeyFigure(name=name, title=answer, value=Quantity(value)) for name, value in values.items()]


def test_a_name_that_several_answers_tell_stands_once_as_the_last_tells_it():
    found = key_figures([figures("one", a=1.0, b=2.0), figures("two", c=3.0), figures("three", a=4.0)])
    assert [(one.name, one.title, one.value.value) for one in found] == [
        ("a", "three", 4.0),
        ("b", "one", 2.0),
        ("c", "two", 3.0),
    ]


def test_figures_of_one_name_in_one_answer_stand_below_each_other():
    pair = [*figures("left", a=1.0), *figures("right", a=2.0)]
    assert [one.title for one in key_figures([figures("old", a=0.0), pair])] == ["left", "right"]


def test_whether_yokes_could_make_it_uniform_is_said_of_the_speed_fluctuation():
    assert key_rows(example("truck-wrong-yokes"))[0][-1].text == "can be made uniform"
    assert key_rows(example("single-20deg"))[0][-1].text == "cannot be uniform"
    assert key_rows(example("z-arrangement"))[0][-1].text == "exactly uniform"


@pytest.mark.slow
def test_splines_are_told_in_their_worst_pose():
    (row,) = [one for one in key_rows(example("rolling-mill-upper-spindle")) if one[0].text.startswith("shortest")]
    assert row[0].text == "shortest engaged length of the spline, shaft 2, in the pose roll change"


def test_a_limit_of_nothing_must_be_exceeded():
    left = KeyFigure(name="gap", title="gap", value=Quantity(0.07, "length"), limit=Quantity(0.0, "length"))
    assert [row(replace(left, better=sense), USUAL)[3].text for sense in ("more", "less")] == ["> 0", "≤ 0"]


def test_what_repeats_a_figure_is_told_where_it_is_another_number_only():
    first = KeyFigure(name="fluctuation", title="fluctuation", value=Quantity(0.05, "share"))
    same, other = (
        replace(first, name="moving", repeats="fluctuation", value=Quantity(v, "share")) for v in (0.05, 0.06)
    )
    assert [one.name for one in untold([first, same], ())] == ["fluctuation"]
    assert [one.name for one in untold([first, other], ())] == ["fluctuation", "moving"]


@pytest.mark.slow
def test_the_first_page_of_a_moving_drive_tells_its_speed_fluctuation_once():
    found = content(example("pto-hitch"))
    told = [cells[0].text for cells in found.figures.rows]
    (fluctuation,) = [text for text in told if "speed fluctuation" in text]
    assert "of the movement" in fluctuation
    (travel,) = [cells for cells in found.lights.rows if "remaining travel" in cells[0].text]
    assert travel[3].text == "> 0"


def sentences(block):
    """Return what a block says in sentences."""
    if isinstance(block, Words):
        return [block.text]
    if isinstance(block, Points):
        return list(block.items)
    return [block.note] if isinstance(block, Table) and block.note else []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-duty-cycle", "pickup-two-piece", "pto-drive", "mill-spindle"])
def test_no_sentence_stands_twice_in_the_report(name):
    found = content_of(name)
    first = [*found.warnings, found.lights, found.remedies, found.figures, found.changes]
    said = [text for block in first for text in sentences(block)]
    said += [text for page in found.pages for block in page.blocks for text in sentences(block)]
    assert len(said) > 20
    assert [text for text, count in Counter(said).items() if count > 1] == []


@pytest.mark.slow
def test_a_joint_angle_that_an_unconfirmed_rating_allows_is_not_green():
    drive = example("car-propshaft")  # its sizes are made up
    (found,) = [one for one in key_rows(drive) if one[0].text.startswith("largest joint angle")]
    assert (found[-1].text, found[-1].tone) == ("met, unconfirmed rating", "warning")
