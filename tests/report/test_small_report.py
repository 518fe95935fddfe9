"""What small functions of report return."""

from cardan.report.block import Page, capital
from cardan.report.render.exports import page_data
from cardan.report.render.sheet import breadth, lines


def test_capital():
    assert capital("joint 2 fails first.") == "Joint 2 fails first."


def test_page_data():
    assert page_data(Page(name="motion", title="Motion", answer="It turns evenly.", blocks=[])) == {
        "name": "motion",
        "title": "Motion",
        "answer": "It turns evenly.",
        "blocks": [],
    }


def test_lines():
    assert (lines("greatest acceleration [rad/s²]", 12.0), lines("", 12.0), lines("x" * 25, 12.0)) == (3, 1, 2)


def test_breadth():
    assert (breadth("100"), breadth("mm") > 3.0 > breadth("illi")) == (3.0, True)
