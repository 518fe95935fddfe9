"""Mechanism files in the app: read as what they are, asked for their pages, their report and its parts."""

import json
import pickle
from pathlib import Path

import pytest

from cardan.app.state.document import Workspace, read, sent
from cardan.app.state.question import asked
from cardan.app.state.session import Session
from cardan.app.state.work import MECHANISM, PART, asked_for, of_report, result
from cardan.files import Enclosed
from cardan.io import dumps, example_mechanism, example_text


@pytest.fixture
def session(tmp_path: Path) -> Session:
    made = Session(Workspace(tmp_path))
    made.open(example_text("crank-slider"), saved=False)
    return made


def test_a_mechanism_is_no_broken_drive(session: Session) -> None:
    document = session.document
    assert document.of_mechanism
    assert document.valid
    assert document.problems == ()
    assert document.mechanism == example_mechanism("crank-slider")
    assert session.drive is None


def test_what_is_wrong_with_a_mechanism_is_told_in_its_own_keys(session: Session) -> None:
    session.change(lambda text: text.replace('type = "P"', 'type = "Q"'))
    assert session.document.of_mechanism
    assert [one.field for one in session.document.problems] == ["joints[3].type"]
    assert asked(session, MECHANISM) is None


def test_the_page_is_built_anew_only_where_the_file_becomes_another_thing(session: Session) -> None:
    built: list[str] = []
    session.rebuild = lambda: built.append(session.document.text[:12])
    session.change(lambda text: text.replace("800", "900"))
    session.change(lambda text: text + "\n[[joints")  # no TOML while somebody types
    assert session.document.of_mechanism
    assert built == []
    session.rewrite(example_text("single-20deg"))
    assert len(built) == 1
    assert session.drive is not None
    session.undo()
    session.undo()
    assert len(built) == 2
    assert session.drive is None


@pytest.mark.slow
def test_its_pages_have_picture_motion_forces_and_mobility(session: Session) -> None:
    question = pickle.loads(pickle.dumps(asked(session, MECHANISM)))
    pages = result(question)
    assert [page.name for page in pages] == ["description", "motion", "forces", "mobility"]
    assert pages[0].blocks[0].figure.name == "space"
    assert "2 421 N" in str(pages[2].answer).replace("\u202f", " ")
    assert pickle.loads(pickle.dumps(pages))[1].title == "Motion"


@pytest.mark.slow
def test_its_report_and_parts_are_made(session: Session) -> None:
    html = result(of_report(session, "html"))
    assert b"crank-slider with hinges alone" in html.content
    told = json.loads(result(of_report(session, "json")).content)
    assert "motion" in json.dumps(told)
    page = result(asked(session, MECHANISM))[1]
    assert b"piston" in result(asked_for(session, PART, thing=page, kind="csv")).content


def test_a_mechanism_as_json_is_taken_too(tmp_path: Path) -> None:
    made = example_mechanism("parallelogram")
    text = sent("arm.json", dumps(made, form="json").encode(), Enclosed(tmp_path))
    assert read(text, Enclosed(tmp_path)).mechanism == made
