"""A question that someone adds is one module and one entry: it stands on every surface without another edit."""

from dataclasses import replace

import pytest

from cardan.answers.question import Place
from cardan.app.parts.blocks import block_html
from cardan.batch.answering.asking import evaluator
from cardan.io import loads
from cardan.register import QUESTIONS, groups
from cardan.report.answers import answered, subject
from cardan.report.content import content
from cardan.report.render.html import text
from cardan.sweeps import sweep
from tests.cli.conftest import cardan, drive_file  # noqa: F401 - fixtures
from tests.fixtures import toy_question
from tests.fixtures.toy_question import QUESTION, answer

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


@pytest.mark.slow
@pytest.mark.parametrize(
    ("place", "stands"),
    [
        (Place(), ("main", "main")),
        (Place(part="aside"), ("", "aside")),
        (Place(part="nowhere"), ("", "")),
        (Place(beside="motion"), ("", "aside")),
        (Place(beside="torsion"), ("main", "main")),  # whose page this drive lacks
        (Place(calm=True), ("", "aside")),
    ],
)
def test_its_place_says_where_its_page_stands_and_when(monkeypatch, place, stands):
    monkeypatch.setitem(QUESTIONS, "toy", replace(QUESTION, place=place))
    monkeypatch.setattr(toy_question, "answer", lambda *given: replace(answer(*given), tone="good"))
    for full, where in zip((False, True), stands, strict=True):
        made = content(loads(FILE), full=full)
        pages = {"main": made.pages, "aside": made.appendix}
        assert [name for name, some in pages.items() if "toy" in [page.name for page in some]] == [where][: bool(where)]


@pytest.mark.parametrize(("tone", "where"), [("good", False), ("warning", True)])
def test_what_is_calm_is_read_where_it_is_not_good(monkeypatch, tone, where):
    monkeypatch.setitem(QUESTIONS, "toy", replace(QUESTION, place=Place(calm=True)))
    monkeypatch.setattr(toy_question, "answer", lambda *given: replace(answer(*given), tone=tone))
    assert ("toy" in [page.name for page in content(loads(FILE)).pages]) == where


@pytest.mark.parametrize(("order", "place"), [(-2, 1), (2, -1)])
def test_its_order_says_before_and_behind_which_pages_it_stands(monkeypatch, order, place):
    monkeypatch.setitem(QUESTIONS, "toy", replace(QUESTION, place=Place(order=order)))
    assert content(loads(FILE)).pages[place].name == "toy"  # behind the page of the drive itself


def test_what_stands_aside_on_its_page_is_told_with_all_of_it(monkeypatch):
    def aside(*given):
        made = answer(*given)
        return replace(made, tables=[replace(one, aside=True) for one in made.tables])

    monkeypatch.setattr(toy_question, "answer", aside)
    assert ["Toys" in text(content(loads(FILE), full=full)) for full in (False, True)] == [False, True]
    assert answered("toy", subject(loads(FILE))).blocks  # asked by itself it is told whole


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
