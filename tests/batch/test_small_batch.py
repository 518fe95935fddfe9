"""What small functions of batch return."""

import numpy as np

from cardan.answers.reader import Reader
from cardan.batch.answering.many import one
from cardan.batch.answering.questions import asked
from cardan.batch.figures.sweep import amount, counted, name_of, shortened, title_of
from cardan.batch.points.axes import column
from cardan.batch.points.distributions import correlated
from cardan.batch.points.fields import present, spots_of, spread_out
from cardan.batch.search.answer import quantity
from cardan.batch.sweep import listed
from cardan.batch.table.results import quoted
from cardan.batch.table.summaries import count_add, count_empty, extreme_add, extreme_empty
from cardan.batch.work import Column
from cardan.batch.work import Column as Field
from cardan.drive.drive import Drive


def test_one():
    assert repr(one(Drive.from_angles([0.3])).output.joint_angle) == "array([0.3])"


def test_asked():
    assert [one.name for one in asked(["speed_fluctuation", "life"])] == ["speed_fluctuation", "life"]


def test_counted():
    assert counted(100000) == "100\u202f000"


def test_amount():
    assert amount(Column(name="alpha_eq_deg", unit="deg", role="answer", text=""), 1.25) == "1.25°"


def test_title_of():
    assert (
        title_of(Column(name="alpha_eq_deg", unit="deg", role="answer", text="equivalent angle"))
        == "equivalent angle [°]"
    )


def test_shortened():
    assert (shortened("shafts[1].spline.mean_diameter_mm", 20), shortened("speed_fluctuation of the output", 20)) == (
        "…ne.mean_diameter_mm",
        "speed_fluctuation o…",
    )


def test_name_of():
    assert (
        name_of(Column(name="alpha_eq_deg", unit="deg", role="answer", text="equivalent angle")) == "equivalent angle"
    )
    assert (
        name_of(Column(name="joints[1].centre_mm[2]", unit="mm", role="point", text="joint centre"))
        == "joints[1].centre_mm[2]"
    )


def test_column():
    assert repr((column((1, 2.5)), column((True, False)))) == "(array([1. , 2.5]), array([ True, False]))"


def test_correlated():
    assert repr(correlated(("a", "b"), (("a", "b", 0.6),))) == "array([[1. , 0. ],\n       [0.6, 0.8]])"


def test_present():
    assert present(Drive.from_angles([0.0, 0.2]), "joints[0].joint_angle_deg") == 0.0


def test_spread_out():
    assert spread_out("joints[0].centre_mm", [[0, 1, 2], [3, 4, 5]])[0][2] == "joints[0].centre_mm[2]"


def test_spots_of():
    assert spots_of(Drive.from_angles([0.1, 0.2]), ["joints[1].joint_angle_deg"])[0].unit == "deg"


def test_quantity():
    joint_angle = Field(name="greatest_joint_angle_deg", unit="deg", role="answer", text="")
    assert quantity(joint_angle, 12.0).told(Reader()) == "12.00°"


def test_listed():
    drive = Drive.from_points([(0, 0, 0), (0.3, 0, 0), (1, 0.1, 0)])
    assert listed(drive, "joints[0].centre_mm", [[0, 1, 2]]).fields[2] == "joints[0].centre_mm[2]"


def test_quoted():
    assert quoted("joints[1].centre_mm[2]") == '"joints[1].centre_mm[2]"'


def test_count_add():
    assert count_add(count_empty(1), np.asarray([True, False, True]), None) == {"n": [2], "of": [3]}


def test_extreme_add():
    assert extreme_add(extreme_empty(1), np.asarray([1.0, 3.0, 3.0]), np.asarray([7, 8, 9]), None, largest=True) == {
        "best": [3.0],
        "row": [8],
    }
