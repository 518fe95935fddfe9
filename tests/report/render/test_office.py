"""Workbooks in a spreadsheet that is not ours: LibreOffice opens them with every sheet, number and chart."""

import io
import shutil
import subprocess

import openpyxl
import pytest

from cardan.report.render.workbook import written
from tests.builders.reports import content_of

OFFICE = shutil.which("soffice") or shutil.which("libreoffice")

pytestmark = [pytest.mark.slow, pytest.mark.skipif(OFFICE is None, reason="LibreOffice is not installed here")]


def saved_again(book: bytes, folder) -> bytes:
    """Return a workbook as LibreOffice saves what it has read of it."""
    (folder / "report.xlsx").write_bytes(book)
    profile = f"-env:UserInstallation={(folder / 'profile').as_uri()}"
    order = [OFFICE, profile, "--headless", "--convert-to", "xlsx", "--outdir", str(folder / "again")]
    subprocess.run([*order, str(folder / "report.xlsx")], check=True, capture_output=True, timeout=300)
    return (folder / "again" / "report.xlsx").read_bytes()  # is not there where the file could not be loaded


def numbers(sheet) -> dict[str, float]:
    return {
        cell.coordinate: float(cell.value)
        for row in sheet.iter_rows()
        for cell in row
        if cell.data_type == "n" and cell.value
    }


@pytest.mark.parametrize("name", ["pickup-two-piece", "pto-drive", "mill-spindle"])
def test_libreoffice_reads_every_sheet_number_and_chart(name, tmp_path):
    book = written(content_of(name))
    ours, theirs = (openpyxl.load_workbook(io.BytesIO(one)) for one in (book, saved_again(book, tmp_path)))
    assert theirs.sheetnames == ours.sheetnames
    for own, read in zip(ours.worksheets, theirs.worksheets, strict=True):
        assert len(read._charts) == len(own._charts), own.title
        assert numbers(read) == pytest.approx(numbers(own), rel=1e-12), own.title
    assert sum(len(numbers(sheet)) for sheet in ours.worksheets) > 1000


def test_a_broken_workbook_is_not_read(tmp_path):
    book = written(content_of("single-20deg"))
    with pytest.raises(FileNotFoundError):
        saved_again(book[: len(book) // 2], tmp_path)
