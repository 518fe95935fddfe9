"""Exports of sweeps are read back by other programs: numbers with all their digits, words, holes, provenance."""

import csv
import json

import numpy as np
import openpyxl
import pyarrow.parquet as pq
import pytest

from cardan.batch.engine.running import run
from cardan.batch.search.goals import Goal
from cardan.batch.table.results import results
from cardan.errors import InputError
from cardan.io import sweep_export
from cardan.io.sweep_export import export
from tests.batch.tables import COLUMNS, SIZE, Suspension, stored, whole

NAMES = [column.name for column in COLUMNS]
TABLE = whole()


@pytest.fixture(scope="module", params=["folder", "memory"])
def found(request, tmp_path_factory):
    if request.param == "memory":
        return results(run(Suspension(), chunk=50))
    return results(stored(tmp_path_factory.mktemp("sweep") / "out").folder)


def same(rows, expected, within=0.0):
    """Compare columns of a file, None for what has no answer; a workbook keeps sixteen digits."""
    for name, column in expected.items():
        if column.dtype.kind in "UO":
            assert list(rows[name]) == column.tolist()
        else:
            told = np.asarray([np.nan if one in (None, "") else float(one) for one in rows[name]])
            np.testing.assert_allclose(told, column, rtol=within, atol=0.0)


def test_csv(found, tmp_path):
    assert export(found, tmp_path / "a.csv") == SIZE
    with open(tmp_path / "a.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == NAMES
    same({name: [row[name] for row in rows] for name in NAMES}, TABLE)
    assert [one.name for one in tmp_path.iterdir()] == ["a.csv"]


def test_parquet_with_its_provenance(found, tmp_path):
    assert export(found, tmp_path / "it's.parquet", where="status = 0") == 200
    table = pq.read_table(tmp_path / "it's.parquet")
    picked = TABLE["status"] == 0
    same(table.to_pydict(), {name: column[picked] for name, column in TABLE.items()})
    about = json.loads(pq.read_metadata(tmp_path / "it's.parquet").metadata[b"cardan"])
    assert about["provenance"]["drive"] == {"name": "truck"}
    assert about["columns"]["joint_angle_deg[1]"] == "deg"


@pytest.mark.slow
def test_a_workbook_has_numbers_and_a_sheet_on_where_they_come_from(found, tmp_path):
    assert export(found, tmp_path / "a.xlsx") == SIZE
    book = openpyxl.load_workbook(tmp_path / "a.xlsx")
    assert book.sheetnames == ["sweep", "provenance"]
    head, *rows = book["sweep"].iter_rows(values_only=True)
    assert list(head) == NAMES
    same({name: [row[k] for row in rows] for k, name in enumerate(NAMES)}, TABLE, within=1e-15)
    assert isinstance(rows[0][0], int | float)
    about = {row[0]: row[1] for row in book["provenance"].iter_rows(values_only=True)}
    assert about["joint_angle_deg[1]"] == "°"
    assert about["drive.name"] == "truck"
    assert about["seed"] == 3


@pytest.mark.parametrize("suffix", [".csv", ".parquet", ".xlsx"])
def test_chosen_rows(found, tmp_path, suffix):
    best = found.best(Goal(name="speed_fluctuation"), count=5)
    assert export(found, tmp_path / f"best{suffix}", rows=best) == 5
    if suffix == ".parquet":
        same(pq.read_table(tmp_path / "best.parquet").to_pydict(), best)


@pytest.mark.parametrize(
    "where",
    ["1 = 1) TO '{other}'; --", "(SELECT count(*) FROM read_csv('/etc/passwd')) > 0", "1 = 1; DROP VIEW sweep"],
)
@pytest.mark.parametrize("suffix", [".csv", ".parquet", ".xlsx"])
def test_a_condition_reaches_no_other_file(found, tmp_path, suffix, where):
    with pytest.raises(InputError, match=r"cannot be|only one SELECT"):
        export(found, tmp_path / f"a{suffix}", where=where.format(other=tmp_path / "other.csv"))
    assert not list(tmp_path.iterdir())


def test_a_condition_may_end_in_a_remark(found, tmp_path):
    assert export(found, tmp_path / "a.csv", where="status = 0 -- answered") == 200


@pytest.mark.slow
def test_what_cannot_be_written_is_told_and_leaves_nothing(found, tmp_path, monkeypatch):
    with pytest.raises(InputError, match=r"should end in one of \.csv"):
        export(found, tmp_path / "a.doc")
    for name in ("a.csv", "a.parquet", "a.xlsx"):
        with pytest.raises(InputError, match="cannot be written"):
            export(found, tmp_path / "nowhere" / name)
    with pytest.raises(InputError, match="cannot be"):
        export(found, tmp_path / "a.csv", where="no_such_column > 1")
    monkeypatch.setattr(sweep_export, "MOST_ROWS", 100)
    with pytest.raises(InputError, match=r"has 210 rows; a sheet holds 99.*\.parquet"):
        export(found, tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())
