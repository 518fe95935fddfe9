"""What small functions of workbooks return."""

from cardan.figures.figure import Axis
from cardan.io.workbook.chart_data import digits
from cardan.io.workbook.charts import plain, reach, snug


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
