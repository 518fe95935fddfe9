"""What small functions of report return."""

from cardan.figures.figure import Axis
from cardan.report.block import Page, capital
from cardan.report.render.chart_data import digits
from cardan.report.render.charts import plain, reach, snug
from cardan.report.render.exports import page_data
from cardan.report.render.sheet import breadth, lines


def test_capital():
    assert capital("joint 2 fails first.") == "Joint 2 fails first."


def test_digits():
    assert (digits([0.0, 90.0]), digits([0.998765432, 1.0]), digits([2e-9, 1.5e-9])) == ("0", "0.00000", "0.0E+00")


def test_plain():
    assert (plain("=A1"), plain("Sheet!A1"), plain("runs")) == ("\u200b=A1", "Sheet！A1", "runs")


def test_snug():
    assert reach(snug(Axis(low=-0.3, high=4.3, ticks=(0.0, 2.0, 4.0)), (0.0, 4.2))) == (0.0, 4.3)


def test_reach():
    assert (reach(Axis(low=-0.3, high=4.3, ticks=(0.0, 2.0, 4.0))), reach(Axis(low=4e-5, high=0.03, log=True))) == (
        (-2.0, 4.3),
        (1e-05, 0.1),
    )


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
