"""Lip seals of supports: rows of the catalogue, and what a support that names one gets from it."""

from __future__ import annotations

import pytest

from cardan.app.state.form import OFFERED
from cardan.catalogue import TABLES, catalogue
from cardan.catalogue.catalogue import found
from cardan.catalogue.completion import shortened
from cardan.catalogue.given import sources
from cardan.catalogue.provenance import rows_behind
from cardan.catalogue.rows import ShaftSeal
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.io import dumps, loads
from cardan.units import mm

ROWS = catalogue().rows(ShaftSeal)

TEXT = """
format = 1
[[joints]]
joint_angle_deg = 10
[[supports]]
shaft = 1
position_mm = -60
bearing = "6207"
seal = "35x52x8"
"""


@pytest.mark.parametrize("row", ROWS.values(), ids=lambda row: row.id)
def test_a_seal_is_called_by_its_sizes(row: ShaftSeal) -> None:
    assert row.id == f"{row.seal_diameter / mm:g}x{row.outer / mm:g}x{row.width / mm:g}"
    assert 4.9 < (row.outer - row.seal_diameter) / 2 / mm < 20.1


def test_larger_shafts_have_no_narrower_seals() -> None:
    widths = [row.width for row in sorted(ROWS.values(), key=lambda row: row.seal_diameter)]
    assert widths == sorted(widths)
    assert {round(width / mm) for width in widths} == {7, 8, 10, 12, 15, 20}


def test_a_support_gets_the_diameter_of_its_seal_beside_what_its_bearing_brings() -> None:
    drive = loads(TEXT)
    one = drive.supports[0]
    assert (one.seal_diameter, one.bore, one.seals) == (pytest.approx(0.035), pytest.approx(0.035), 1)
    assert [row.id for row in rows_behind(drive, catalogue(), "supports[0].seal_diameter")] == ["35x52x8"]
    assert any(str(text).startswith("35x52x8: GB/T 13871.1") for text in sources(drive))
    assert loads(dumps(drive)) == drive
    bare = Support(shaft=1, position=-0.06, bearing="6207", seal="35x52x8")
    assert shortened(drive).supports[0] == bare


def test_what_a_file_gives_itself_stays() -> None:
    worn = loads(TEXT + "seal_diameter_mm = 34.5\nseals = 2\n").supports[0]
    assert (worn.seal_diameter, worn.seals) == (pytest.approx(0.0345), 2)
    alone = loads(TEXT.replace('seal = "35x52x8"', "seal_diameter_mm = 33"))
    assert alone.supports[0].seal_diameter == pytest.approx(0.033)


@pytest.mark.parametrize(
    ("wrong", "field", "say"),
    [
        ('seal = "35x52x9"', "supports[0].seal", "the nearest is 35x5"),
        ("seals = 2", "supports[0].seal_diameter", "seals rub on the shaft"),
        ("max_lip_speed_m_s = 12", "supports[0].seal_diameter", "seals rub on the shaft"),
        ("seal_diameter_mm = 30\nseals = 0", "supports[0].seals", "at least 1"),
    ],
)
def test_what_is_wrong_is_named(wrong: str, field: str, say: str) -> None:
    with pytest.raises(InputError, match=say) as caught:
        loads(TEXT.replace('seal = "35x52x8"', wrong))
    assert [problem.field.removesuffix("_mm") for problem in caught.value.problems] == [field]


def test_a_firm_adds_its_own_with_the_speed_it_allows(tmp_path) -> None:
    text = '[[shaft_seals]]\nid = "HS-33"\nsource = "own"\nseal_diameter_mm = 33\nouter_mm = 50\nwidth_mm = 8\n'
    (tmp_path / "own.toml").write_text(text + "max_lip_speed_m_s = 14\n", encoding="utf-8")
    named = TEXT.replace("35x52x8", "HS-33") + '[settings]\ncatalogues = ["own.toml"]\n'
    one = loads(named, folder=tmp_path).supports[0]
    assert (one.seal_diameter, one.max_lip_speed) == pytest.approx((0.033, 14.0))
    (tmp_path / "own.toml").write_text(text.replace("outer_mm = 50", "outer_mm = 30"), encoding="utf-8")
    with pytest.raises(InputError, match="outer_mm: is below the diameter of the shaft"):
        loads(named, folder=tmp_path)


@pytest.mark.parametrize("words", ["seal", "lip seal", "rotary shaft"])
def test_who_looks_for_seals_finds_them(words: str) -> None:
    assert len(found(catalogue(), words)["shaft_seals"]) == len(ROWS)


def test_the_app_offers_the_rows() -> None:
    assert TABLES[OFFERED["seal"]] is ShaftSeal
