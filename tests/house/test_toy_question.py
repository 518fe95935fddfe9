"""A question that someone adds is one module and one entry: it stands on every surface without another edit."""

import pytest

from cardan.app.parts.blocks import block_html
from cardan.batch.answering.asking import evaluator
from cardan.io import loads
from cardan.register import QUESTIONS, groups
from cardan.report.answers import answered, subject
from cardan.report.content import content
from cardan.report.render.html import text
from cardan.sweeps import sweep
from tests.cli.conftest import cardan, drive_file  # noqa: F401 - fixtures
from tests.fixtures.toy_question import QUESTION

FILE = """format = 1
name = "with a toy"

[[joints]]
joint_angle_deg = 20

[[joints]]
joint_angle_deg = 10

[duty]
torque_Nm = 100
"""


@pytest.fixture(autouse=True)
def known():
    """Make the question known, and forget it after."""
    QUESTIONS[QUESTION.name] = QUESTION
    yield
    del QUESTIONS[QUESTION.name]


@pytest.fixture
def file(drive_file):  # noqa: F811
    return drive_file(FILE)


def test_it_has_a_page_with_its_table(file):
    page = answered("toy", subject(loads(FILE)))
    assert page.title == "Toy question"
    assert page.answer == "The toy of 2 joints is 50.80 mm long."
    assert "<td" in "".join(map(block_html, page.blocks))


def test_it_stands_in_the_report():
    made = content(loads(FILE))
    assert "toy" in [page.name for page in made.pages]
    page = text(made)
    assert "Toy question" in page
    assert "length of the toy" in page


def test_it_has_a_tab_of_the_app():
    assert groups()["Toys"] == ("toy",)


def test_it_is_a_command(cardan, file):  # noqa: F811
    done = cardan("toy", file)
    assert done.code == 0, done.err
    assert "the toy of 2 joints is 50.80 mm long." in done.out
    assert cardan("toy", file, "--csv").out.splitlines() == ["joint,torque_Nm", "1,100.0", "2,50.0"]
    told = cardan("toy", file, "--json", "--unit", "length=in", "--torque-Nm", "200").content
    assert told["question"] == "toy"
    assert told["toy_length_in"] == pytest.approx(2.0)
    assert [one["torque_Nm"] for one in told["toys"]] == [200.0, 100.0]


def test_the_help_lists_it(cardan):  # noqa: F811
    assert "How long the toy of this drive is." in cardan("--help").out
    assert "cardan toy truck.toml" in cardan("toy", "--help").out


def test_it_says_what_the_file_lacks(cardan, drive_file):  # noqa: F811
    done = cardan("toy", drive_file(FILE.partition("[duty]")[0]), "--json")
    assert done.code == 2
    (problem,) = done.complaint["problems"]
    assert problem["field"].endswith("duty.torque_Nm")
    assert "needs it" in problem["message"]


def test_a_sweep_asks_it_and_says_where_it_lacks_something():
    found = sweep(loads(FILE), {"joints[0].joint_angle_deg": [10.0, 20.0]}, ["toy", "speed_fluctuation"]).table()
    assert found["toy_in"].tolist() == [2.0, 2.0]
    asked = evaluator(loads(FILE.partition("[duty]")[0]), [], ["toy"])
    answers, _status, (problem,) = asked.at({})
    assert not answers
    assert str(problem) == "toy: duty.torque: missing; the question toy needs it"
