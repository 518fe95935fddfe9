"""Bearings of supports: rows of the catalogue, and what a support that names one gets from it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from cardan.app.state.form import OFFERED
from cardan.catalogue import TABLES, catalogue, completed
from cardan.catalogue.completion import shortened
from cardan.catalogue.given import sources
from cardan.catalogue.provenance import rows_behind
from cardan.catalogue.rows import Bearing
from cardan.drive.drive import Drive
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.io import dumps, loads
from cardan.units import mm, rpm

ROWS = catalogue().rows(Bearing)

TEXT = """
format = 1
[[joints]]
joint_angle_deg = 10
[[supports]]
shaft = 1
position_mm = -60
axial = true
bearing = "6207-2RS"
"""

BORES = {"00": 10, "01": 12, "02": 15, "03": 17}
"""Bore numbers of ISO 15 that are not a fifth of the bore."""


@pytest.mark.parametrize("row", ROWS.values(), ids=lambda row: row.id)
def test_dimensions_follow_from_the_designation(row: Bearing) -> None:
    number = row.id[2:4]
    assert row.bore / mm == pytest.approx(BORES.get(number, 5 * int(number)))
    assert row.width < 0.5 * row.outer
    assert 1.2 < row.capacity / row.static_capacity < 2.6


@pytest.mark.parametrize("number", range(13))
def test_a_heavier_series_of_one_bore_carries_more_and_turns_slower(number: int) -> None:
    own = [ROWS[f"{series}{number:02d}"] for series in (60, 62, 63)]
    assert own == sorted(own, key=lambda row: row.capacity)
    assert own == sorted(own, key=lambda row: -row.max_speed)
    assert len({row.bore for row in own}) == 1


def test_contact_seals_cost_speed_alone() -> None:
    sealed = [row for name, row in ROWS.items() if name.endswith("-2RS")]
    assert len(sealed) == 39
    for row in sealed:
        plain = ROWS[row.id.removesuffix("-2RS")]
        assert row.max_speed < 0.85 * plain.max_speed
        assert replace(plain, id=row.id, max_speed=row.max_speed, note=row.note) == row


def test_a_support_gets_the_figures_of_its_bearing() -> None:
    drive = loads(TEXT)
    one = drive.supports[0]
    assert (one.bore, one.capacity, one.static_capacity) == pytest.approx((0.035, 25700.0, 15300.0))
    assert one.max_speed == pytest.approx(6300 * rpm)
    assert [row.id for row in rows_behind(drive, catalogue(), "supports[0].capacity")] == ["6207-2RS"]
    assert any(str(text).startswith("6207-2RS: TPI") for text in sources(drive))


def test_what_a_file_gives_itself_stays_and_is_its_own() -> None:
    drive = loads(TEXT + "capacity_N = 30000\nbore_mm = 34\n")
    one = drive.supports[0]
    assert (one.bore, one.capacity, one.static_capacity) == pytest.approx((0.034, 30000.0, 15300.0))
    assert not rows_behind(drive, catalogue(), "supports[0].capacity")
    assert loads(dumps(drive)) == drive


def test_a_file_is_written_with_the_name_alone() -> None:
    drive = loads(TEXT)
    text = dumps(drive)
    assert "6207-2RS" in text
    assert "capacity" not in text
    assert loads(text) == drive
    assert shortened(drive).supports[0] == Support(shaft=1, position=-0.06, axial=True, bearing="6207-2RS")


def test_friction_acts_at_the_bore_of_the_bearing() -> None:
    assert loads(TEXT + "friction = 0.0015\n").supports[0].bore == pytest.approx(0.035)


@pytest.mark.parametrize(
    ("name", "near"), [("6207ZZ", "6207"), ("6208-2RS1", "6208-2RS"), ("6314-2RS", "6312-2RS|6311-2RS|6304-2RS|6314")]
)
def test_a_name_that_is_not_there_is_answered_with_the_nearest(name: str, near: str) -> None:
    with pytest.raises(InputError, match=f"the nearest is ({near})") as caught:
        loads(TEXT.replace("6207-2RS", name))
    assert [problem.field for problem in caught.value.problems] == ["supports[0].bearing"]


def test_a_firm_adds_its_own(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(
        '[[bearings]]\nid = "CB-30"\nsource = "own catalogue"\nbore_mm = 30\nouter_mm = 62\nwidth_mm = 20\n'
        "capacity_N = 21000\nstatic_capacity_N = 12000\n",
        encoding="utf-8",
    )
    text = TEXT.replace("6207-2RS", "CB-30") + '[settings]\ncatalogues = ["own.toml"]\n'
    assert loads(text, folder=tmp_path).supports[0].capacity == pytest.approx(21000.0)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text((tmp_path / "own.toml").read_text().replace("outer_mm = 62", "outer_mm = 29"), encoding="utf-8")
    with pytest.raises(InputError, match="outer_mm: is below the bore"):
        loads(text.replace("own.toml", "wrong.toml"), folder=tmp_path)


def test_a_drive_in_python_is_completed_too() -> None:
    bare = replace(Drive.from_angles([0.1]), supports=(Support(shaft=1, position=-0.06, bearing="6008"),))
    assert completed(bare).supports[0].capacity == pytest.approx(16800.0)


def test_the_app_offers_the_rows() -> None:
    assert TABLES[OFFERED["bearing"]] is Bearing
