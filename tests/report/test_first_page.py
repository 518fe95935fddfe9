"""Which key figures stand on the first page: those of all answers, each once."""

from cardan.answers.answer import KeyFigure
from cardan.answers.quantity import Quantity
from cardan.io import example
from cardan.report.block import key_figures
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


def test_splines_are_told_in_their_worst_pose():
    (row,) = [one for one in key_rows(example("rolling-mill-upper-spindle")) if one[0].text.startswith("shortest")]
    assert row[0].text == "shortest engaged length of the spline, shaft 2, in the pose roll change"
