"""Pages, tables and figures as files of their own: every kind opens, and holds the numbers of what it shows."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from cardan.drive.drive import Drive
from cardan.errors import InputError, MissingExtraError
from cardan.figures.figure import Curve
from cardan.report.block import Column, Page, Picture, Table, number, words
from cardan.report.content import content
from cardan.report.render import renderer
from cardan.report.render.exports import MEDIA, export, exported, kinds
from cardan.units import deg

SAID = content(Drive.from_angles([20 * deg, 15 * deg], name="two / joints"), full=True)
PAGE = next(page for page in SAID.pages if page.name == "motion")
FIGURES = [block.figure for page in SAID.pages for block in page.blocks if isinstance(block, Picture)]
TABLES = [block for block in PAGE.blocks if isinstance(block, Table)]
BEGINNING = {
    "html": b"<!doctype html>",
    "pdf": b"%PDF-",
    "xlsx": b"PK",
    "csv": b"\xef\xbb\xbf",
    "json": b"{",
    "svg": b"<?xml",
    "png": b"\x89PNG",
}


def figure(name: str):
    return next(one for one in FIGURES if one.name == name)


@pytest.mark.slow
@pytest.mark.parametrize("thing", [PAGE, TABLES[0], figure("orders"), figure("views")])
def test_every_kind_is_what_it_is_called(thing: object) -> None:
    for kind in kinds(thing):
        made = exported(thing, kind, title="two / joints")
        assert made.content.startswith(BEGINNING[kind]), kind
        assert made.media_type == MEDIA[kind]
        assert made.name.startswith("two-joints")
        assert made.name.endswith(f".{kind}")


def test_a_page_as_csv_has_its_tables_below_each_other_in_full() -> None:
    text = exported(PAGE, "csv").content.decode("utf-8-sig")
    rows = iter(csv.reader(io.StringIO(text)))
    for table in TABLES:
        if table.title:
            assert next(rows) == [table.title]
        assert [head.partition(" [")[0] for head in next(rows)] == [column.heading for column in table.columns]
        for line in table.rows:
            for found, cell in zip(next(rows), line, strict=True):
                assert (float(found) == float(cell.full)) if cell.full else (found == cell.text)
        assert next(rows, []) == []
    assert next(rows, None) is None


def test_a_figure_as_csv_and_as_json_holds_its_curves() -> None:
    motion = figure("motion")
    panel = motion.panels[0]
    curves = [one for one in panel.series if isinstance(one, Curve)]
    rows = list(csv.reader(io.StringIO(exported(motion, "csv").content.decode("utf-8-sig"))))
    assert rows[0] == [panel.heading]
    assert rows[1][1:] == [f"{one.label} [{panel.y.unit}]" for one in curves]
    held = np.asarray(rows[2 : 2 + len(curves[0].x)], dtype=float)
    np.testing.assert_array_equal(held[:, 0], curves[0].x)
    np.testing.assert_array_equal(held[:, 1:].T, [one.y for one in curves])
    told = json.loads(exported(motion, "json").content)
    series = [one for one in told["panels"][0]["series"] if one["kind"] == "curve"]
    assert [one["y"] for one in series] == [one.y.tolist() for one in curves]
    assert (told["panels"][0]["y"]["label"], told["panels"][0]["y"]["unit"]) == (panel.y.label, panel.y.unit)


def test_a_report_as_json_holds_every_number_in_full() -> None:
    told = json.loads(exported(SAID, "json").content)
    assert [page["title"] for page in told["pages"]] == [page.title for page in SAID.pages]
    assert told["judgement"]["text"] == SAID.judgement.text
    (page,) = [one for one in told["pages"] if one["name"] == "motion"]
    held = [block for block in page["blocks"] if block["kind"] == "table"]
    for found, table in zip(held, TABLES, strict=True):
        for row, line in zip(found["rows"], table.rows, strict=True):
            assert [one["value"] for one in row if one["value"] is not None] == [float(c.full) for c in line if c.full]


@pytest.mark.slow
def test_a_page_as_workbook_has_its_sheet_and_the_numbers_of_its_charts() -> None:
    made = exported(PAGE, "xlsx", title="=1+1")
    book = openpyxl.load_workbook(io.BytesIO(made.content))
    assert book.sheetnames == ["Motion", "Motion data"]
    assert made.name == "1-1-motion.xlsx"
    single = openpyxl.load_workbook(io.BytesIO(exported(figure("orders"), "xlsx").content)).worksheets[0]
    assert [cell.value for cell in single["A"]].count(figure("orders").title) == 1


def test_words_that_a_spreadsheet_would_reckon_are_marked_in_a_csv() -> None:
    evil = ["=1+1", "+1 x", "-x", "@x", "\tx"]
    table = Table(
        columns=[Column(heading="=x"), Column(heading="n")], rows=[[words(t), number("−1", -1.5)] for t in evil]
    )
    rows = list(csv.reader(io.StringIO(exported(table, "csv").content.decode("utf-8-sig"))))
    assert rows == [["'=x", "n"], *([f"'{text}", "-1.5"] for text in evil)]


def test_what_cannot_be_exported_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Page(name="x", title="x", answer="", blocks=[])
    for thing, kind in ((PAGE, "png"), (plain, "csv"), (SAID, "svg"), (TABLES[0], "pdf"), (PAGE, "exe")):
        with pytest.raises(InputError, match=f"{kind} is none of"):
            exported(thing, kind)
    monkeypatch.setattr(renderer, "find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install 'cardan\[xlsx\]'"):
        export(PAGE, tmp_path / "page.xlsx")
    with pytest.raises(InputError, match="cannot be written"):
        export(PAGE, tmp_path / "none" / "page.csv")
    assert not list(tmp_path.iterdir())
    assert export(replace(plain, blocks=[TABLES[0]]), tmp_path / "page.csv").read_bytes()


def test_names_are_short_and_safe() -> None:
    table = Table(columns=(), rows=[[]], title="../../Усилия: \x00 " + "a" * 200)
    name = exported(table, "csv", title="C:\\x").name
    assert name.startswith("C-x-Усилия-aaa")
    assert len(name) == 84
    assert exported(replace(table, title="..."), "json").name == "cardan.json"
