"""Results as CSV, JSON and workbooks."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import numpy as np
import openpyxl
import pytest

from cardan import InputError, articulation, equivalent_joint, example, motion, phases, save
from cardan.errors import MissingExtraError
from cardan.io.formats import xlsx


def test_motion_as_csv(tmp_path: Path) -> None:
    found = motion(example("truck-printed-angles"))
    save(found, tmp_path / "a.csv")
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert len(rows) == found.angle.shape[0]
    assert float(rows[60]["shaft_5_ratio"]) == found.ratio[60]
    assert float(rows[90]["angle_deg"]) == pytest.approx(90.0, abs=1e-12)
    assert "shaft_5_acceleration_rad_s2" in rows[0]


def test_articulation_as_csv(tmp_path: Path) -> None:
    found = articulation(example("pto-hitch"))
    save(found, tmp_path / "a.csv")
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert [float(row["time_s"]) for row in rows] == found.times.tolist()
    assert float(rows[3]["shaft_2_length_mm"]) == pytest.approx(1e3 * found.length[3, 1], rel=1e-15)


@pytest.mark.parametrize("name", ["single-20deg", "truck-printed-angles", "three-joints-unequal", "six-joints"])
def test_results_as_json(name: str, tmp_path: Path) -> None:
    drive = example(name)
    for k, result in enumerate((motion(drive), equivalent_joint(drive), phases(drive))):
        save(result, tmp_path / f"{k}.json")
        assert isinstance(json.loads((tmp_path / f"{k}.json").read_text()), dict)
    held = json.loads((tmp_path / "0.json").read_text())
    np.testing.assert_array_equal(held["shaft_ratio"], motion(drive).shaft_ratio)


def test_unknown_format_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"known are \.csv, \.json"):
        save(motion(example("single-20deg")), tmp_path / "a.xls")
    with pytest.raises(InputError, match="not a table"):
        save(equivalent_joint(example("single-20deg")), tmp_path / "a.csv")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_table_as_a_workbook_holds_the_numbers_of_the_csv(tmp_path: Path) -> None:
    found = motion(example("truck-printed-angles"))
    save(found, tmp_path / "a.xlsx")
    save(found, tmp_path / "a.csv")
    head, *rows = openpyxl.load_workbook(tmp_path / "a.xlsx").worksheets[0].iter_rows(values_only=True)
    named, *lines = csv.reader((tmp_path / "a.csv").read_text().splitlines())
    assert list(head) == named
    # A workbook holds numbers with 16 digits, as every spreadsheet does.
    np.testing.assert_allclose(np.asarray(rows), np.asarray(lines, dtype=float), rtol=1e-15, atol=0.0)


def test_words_of_a_table_stay_words_and_numbers_that_are_none_do_not_break_it(tmp_path: Path) -> None:
    save({"=A1": ["=1+1", "+1", "@x"], "b": [np.nan, np.inf, -1.5]}, tmp_path / "a.xlsx")
    cells = [cell for row in openpyxl.load_workbook(tmp_path / "a.xlsx").active for cell in row]
    assert [cell.value for cell in cells] == ["=A1", "b", "=1+1", None, "+1", "∞", "@x", -1.5]
    assert [cell.data_type for cell in cells[::2]] == ["s"] * 4


def test_the_same_table_gives_the_same_workbook() -> None:
    columns = {"a": [1.0, 2.0]}
    first, second = (xlsx.table(columns) for _ in range(2))
    assert first == second


def test_more_rows_than_a_sheet_has_are_refused() -> None:
    with pytest.raises(InputError, match="a sheet holds"):
        xlsx.table({"a": np.zeros(1_048_576)})


def test_without_the_library_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xlsxwriter", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'cardan\[xlsx\]'"):
        save({"a": [1.0]}, tmp_path / "a.xlsx")
    assert not list(tmp_path.iterdir())
