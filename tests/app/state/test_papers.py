"""Reports, parts of them and comparisons as answers to questions."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from zipfile import ZipFile

import pytest

from cardan.app.state import work
from cardan.app.state.document import Workspace
from cardan.app.state.question import Question, asked
from cardan.app.state.session import Session
from cardan.app.state.work import result
from cardan.figures.figure import Figure
from cardan.io import example_text
from cardan.report.block import Page, Picture, Table
from cardan.report.render.exports import Exported, kinds


@pytest.fixture
def session(tmp_path: Path) -> Session:
    made = Session(Workspace(tmp_path))
    made.open(example_text("z-arrangement"), saved=False)
    made.choose(units={"length": "in"}, decimal=",")
    return made


def answer(question: Question | None) -> Exported:
    assert question is not None
    made = result(question)
    assert isinstance(made, Exported)
    return made


def test_a_report_is_in_the_users_units_language_and_sign(session: Session) -> None:
    session.choose(language="ru")
    made = answer(work.of_report(session, "html"))
    text = made.content.decode()
    assert made.name.endswith(".html")
    assert "<html lang=ru" in text.replace('"', "")
    assert "дюйм" in text
    assert "centre_mm" in text  # the file as it stands


@pytest.mark.slow
@pytest.mark.parametrize(("form", "begin"), [("pdf", b"%PDF-"), ("interactive", b"<!"), ("json", b"{")])
def test_every_form_opens(session: Session, form: work.Form, begin: bytes) -> None:
    if form == "pdf":
        pytest.importorskip("typst")
    made = answer(work.of_report(session, form))
    assert made.content.startswith(begin)
    assert made.name.startswith("Z-arrangement")


@pytest.mark.slow
def test_a_workbook_holds_numbers_with_points(session: Session) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    pytest.importorskip("xlsxwriter")
    made = answer(work.of_report(session, "xlsx"))
    assert ZipFile(io.BytesIO(made.content)).testzip() is None
    book = openpyxl.load_workbook(io.BytesIO(made.content))
    said = [cell for sheet in book for row in sheet.iter_rows(values_only=True) for cell in row if cell is not None]
    assert sum(isinstance(cell, float) for cell in said) > 20
    assert any(isinstance(cell, str) and cell.endswith("[in]") for cell in said)


def test_figures_and_pages_go_as_every_kind_that_fits(session: Session) -> None:
    shown = page_of(session)
    table = answer(work.asked_for(session, work.PART, thing=shown, kind="csv"))
    rows = list(csv.reader(io.StringIO(table.content.decode("utf-8-sig"))))
    assert sum(cell.replace(".", "", 1).isdigit() for row in rows for cell in row) > 5
    figure = next(one.figure for one in shown.blocks if isinstance(one, Picture))
    assert isinstance(figure, Figure)
    for kind in ("svg", "json"):
        assert kind in kinds(figure)
        made = answer(work.asked_for(session, work.PART, thing=figure, kind=kind))
        assert made.name == f"Z-arrangement-motion.{kind}"
    assert json.loads(made.content)


def page_of(session: Session) -> Page:
    question = asked(session, "motion")
    assert question is not None
    page = result(question)
    assert isinstance(page, Page)
    return page


def test_variants_are_compared_in_the_users_units(session: Session) -> None:
    assert session.drive is not None
    rows = (("now, 300 mm", session.drive), ("b", session.drive))
    question = work.asked_for(session, work.COMPARE, variants=rows)
    assert question is not None
    page = result(question)
    assert isinstance(page, Page)
    heads = [column.heading for one in page.blocks if isinstance(one, Table) for column in one.columns]
    assert "now, 300 mm" in heads


def test_a_mistake_in_the_file_does_not_hinder_the_report(session: Session) -> None:
    session.rewrite(session.document.text + "\nnonsense = 1\n")
    assert not session.document.valid
    assert b"nonsense" not in answer(work.of_report(session, "json")).content


def test_without_a_drive_there_is_no_question(tmp_path: Path) -> None:
    assert work.of_report(Session(Workspace(tmp_path)), "html") is None


@pytest.mark.parametrize(
    ("name", "safe"),
    [
        ("Truck: 4 joints / rear", "Truck-4-joints-rear"),
        ("../../x", "x"),
        ("", "drive"),
        ("Вал №1", "Вал-1"),
        ("a" * 99, "a" * 60),
    ],
)
def test_names_of_files_are_safe(name: str, safe: str) -> None:
    assert work.safe(name) == safe
