"""Who reads a report writes no file: it tells what keys mean, and the terminal tells the keys themselves."""

from __future__ import annotations

import html
import re
from pathlib import Path

import pytest

from cardan import check, load
from cardan.answers.answer import Table
from cardan.answers.printed import printed
from cardan.answers.quantity import Written, say, told
from cardan.answers.reader import Reader
from cardan.checks.verdict_table import missing_table
from cardan.drive.fields.wording import written
from cardan.report.report import page

EXAMPLES = Path(__file__).parents[2] / "examples"
PARTS = r"\[\[|\b(joints|shafts|supports|stations)\[|\b(duty|limits|cross|needles)\.[a-z]"
KEY = re.compile(PARTS + r"|_(mm|deg|rpm|Nm|kg|m2|percent)\b")
DRAWN = re.compile(r"<(script|style|svg|pre)\b.*?</\1>", re.DOTALL)  # the file itself stands in the appendix


def words(text: str) -> list[str]:
    """Return the lines of a page as people read them."""
    lines = re.sub(r"</(p|td|th|li|h\d|div|dd|dt|span|figcaption)>", "\n", DRAWN.sub("", text))
    return html.unescape(re.sub(r"<[^>]+>", "", lines)).splitlines()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["overconstrained-pump", "pickup-two-piece", "cured-drive", "mill-spindle"])
def test_a_report_holds_no_keys(name: str) -> None:
    path = EXAMPLES / f"{name}.toml"
    found = words(page(load(path), source_text=path.read_text("utf8"), full=True))
    assert len(found) > 100
    # matrices of the method are written in brackets too
    assert [one for one in found if KEY.search(one) and "G = J R" not in one] == []


def test_a_key_in_a_sentence_is_told_to_each_reader_in_their_way() -> None:
    said = say("Give {keys}{how}.", keys=written("shafts[1].yoke_angle", "duty.speed"), how=Written(" (both)", ""))
    assert told(said, Reader()) == "Give shafts[1].yoke_angle_deg, duty.speed_rpm (both)."
    assert told(said, Reader(keys="meaning")) == "Give shaft 2: yoke angle, input speed."


def test_the_table_of_checks_not_run_is_told_in_both_ways() -> None:
    drive = load(EXAMPLES / "z-arrangement.toml")
    table: Table = missing_table([one for one in check(drive) if one.missing])
    keys, meant = (str(printed(table, reader)) for reader in (Reader(), Reader(keys="meaning")))
    assert "shafts[1].outer_mm" in keys
    assert "Keys count from 0" in keys
    assert "shaft 2: outer diameter" in meant
    assert "shafts[" not in meant
    assert "_mm" not in meant
