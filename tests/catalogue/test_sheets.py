"""Catalogues from spreadsheets say what the same rows say in TOML; what is wrong is told as there."""

import pytest

from cardan.answers.data import as_csv
from cardan.answers.reader import USUAL
from cardan.catalogue.answer import answer_of_table
from cardan.catalogue.catalogue import Catalogue, catalogue, found, with_files
from cardan.catalogue.rows import JointSize
from cardan.catalogue.sheets import tree_of
from cardan.errors import InputError

TOML = """
[[joint_sizes]]
id = "58.10"
source = "catalogue 12"
type = "medium"
mass_kg = 2.1
recalled = ["mass", "rating.max_torque"]
cross = { span_mm = 62, journal_mm = 19 }
rating = { torque_Nm = 1250, convention = "Tc", max_joint_angle_deg = 25 }
"""
HEAD = (
    "id,source,type,mass_kg,recalled,cross.span_mm,cross.journal_mm,rating.torque_Nm,rating.convention,"
    "rating.max_joint_angle_deg"
)
LINE = "58.10,catalogue 12,medium,2.1,mass;rating.max_torque,62,19,1250,Tc,25"


@pytest.fixture
def wanted(tmp_path):
    (tmp_path / "own.toml").write_text(TOML)
    return with_files(Catalogue(tables={}), [tmp_path / "own.toml"]).tables


def test_a_csv_file_named_as_its_table(tmp_path, wanted):
    (tmp_path / "joint_sizes.csv").write_text(f"{HEAD}\n{LINE}\n\n")
    assert with_files(Catalogue(tables={}), [tmp_path / "joint_sizes.csv"]).tables == wanted


def test_decimal_commas_and_semicolons(tmp_path, wanted):
    line = LINE.replace("mass;rating.max_torque", '"mass;rating.max_torque"').replace(",", ";").replace("2.1", "2,1")
    (tmp_path / "joint_sizes.csv").write_text(f"{HEAD.replace(',', ';')}\n{line}\n", encoding="utf-8-sig")
    assert with_files(Catalogue(tables={}), [tmp_path / "joint_sizes.csv"]).tables == wanted


def test_a_workbook_whose_sheets_are_tables(tmp_path, wanted):
    book = pytest.importorskip("openpyxl").Workbook()
    sheet = book.active
    sheet.title = "joint_sizes"
    sheet.append(HEAD.split(","))
    sheet.append(
        [
            58.1 if k == 0 else float(one) if one.replace(".", "").isdigit() else one
            for k, one in enumerate(LINE.split(","))
        ]
    )
    sheet["A2"] = "58.10"
    book.save(tmp_path / "own.xlsx")
    assert with_files(Catalogue(tables={}), [tmp_path / "own.xlsx"]).tables == wanted


def test_what_is_wrong_is_told_with_row_and_key(tmp_path):
    (tmp_path / "joint_sizes.csv").write_text("id,source,mass_kg,colour\nA,x,heavy,red\n")
    (tmp_path / "sizes.csv").write_text("id,source\nA,x\n")
    (tmp_path / "own.xlsx").write_text("no workbook")
    with pytest.raises(InputError) as refused:
        with_files(Catalogue(tables={}), [tmp_path / name for name in ("joint_sizes.csv", "sizes.csv", "own.xlsx")])
    said = str(refused.value)
    for words in ("joint_sizes[0].mass_kg", "colour", "unknown table", "cannot be read as a workbook"):
        assert words in said, words


def test_rows_are_found_by_words():
    assert {type(row) for row in found(catalogue(), "gwb")["joint_sizes"]} == {JointSize}
    assert found(catalogue(), "gwb 687.15", "materials") == {}


@pytest.mark.parametrize("table", ["joint_sizes", "materials", "laminae", "joint_types"])
def test_what_is_told_as_csv_is_read_again(tmp_path, table):
    told = answer_of_table(catalogue(), table).full()
    (tmp_path / f"{table}.csv").write_text("\n".join(as_csv(told, USUAL)), encoding="utf-8")
    again = with_files(Catalogue(tables={}), [tmp_path / f"{table}.csv"]).tables[table]
    assert list(again) == list(catalogue().tables[table])


def test_the_name_of_a_csv_file_ends_with_that_of_its_table(tmp_path):
    text = "id,source\nacme-1,own tests\n"
    (tmp_path / "acme-speed_angle_limits.csv").write_text(text)
    assert list(tree_of(tmp_path / "acme-speed_angle_limits.csv")) == ["speed_angle_limits"]
    (tmp_path / "firm.csv").write_text(text)
    with pytest.raises(InputError, match=r"called after its own, as acme-joint_sizes\.csv; the tables are materials"):
        tree_of(tmp_path / "firm.csv")
