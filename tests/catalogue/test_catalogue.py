"""Every row loads, has a source and figures that can be; a user's file adds to it and is checked."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

from cardan.catalogue import TABLES, Catalogue, catalogue, material, with_files
from cardan.catalogue.catalogue import FILES, shipped_file
from cardan.catalogue.rows import (
    FLAGS,
    AnglePair,
    BalanceGrade,
    Fault,
    Grade,
    GuideValue,
    JointSize,
    LifeFactor,
    row_flat,
    row_tree,
)
from cardan.errors import InputError
from cardan.texts import speaking

ROWS = [row for rows in catalogue().tables.values() for row in rows.values()]


def test_each_shipped_file_holds_the_tables_it_is_asked_for() -> None:
    assert {name: tuple(shipped_file(name)) for name in FILES} == FILES
    assert {path.name for path in files("cardan.catalogue").iterdir() if path.name.endswith(".toml")} == {
        f"{name}.toml" for name in FILES
    }


def test_every_table_has_rows() -> None:
    assert set(catalogue().tables) == set(TABLES)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_every_row_has_a_source(row: object) -> None:
    assert len(row.source) > 3  # type: ignore[attr-defined]


@pytest.mark.parametrize("row", catalogue().rows(Grade).values(), ids=lambda row: row.id)
def test_materials_are_plausible(row: Grade) -> None:
    assert 2000.0 < row.density < 8000.0
    assert 40e9 < row.youngs < 215e9
    # isotropic: G = E/(2(1+nu)) within the rounding of published figures
    assert row.shear == pytest.approx(row.youngs / (2.0 * (1.0 + row.poisson)), rel=0.03)
    if row.yield_strength is not None and row.ultimate_strength is not None:
        assert 0.3 < row.yield_strength / row.ultimate_strength < 1.0


@pytest.mark.parametrize("name", ["life_factors", "speed_angle_factors"])
def test_factor_tables_rise(name: str) -> None:
    rows = catalogue().table(name, LifeFactor).values()
    at, factor = np.asarray([[row.at, row.factor] for row in rows]).T
    assert np.all(np.diff(at) > 0.0)
    assert np.all(np.diff(factor) > 0.0)


def test_the_angle_table_falls_with_speed_and_rises_along_its_rows() -> None:
    rows = list(catalogue().rows(AnglePair).values())
    assert [row.speed for row in rows] == sorted(row.speed for row in rows)
    assert all(np.all(np.diff(row.second_joint_angle) >= 0.0) for row in rows)
    first = [row.second_joint_angle[0] for row in rows]
    assert first == sorted(first, reverse=True)


SIZES = list(catalogue().rows(JointSize).values())


@pytest.mark.parametrize("row", [row for row in SIZES if row.series == "example"], ids=lambda row: row.id)
def test_the_example_series_says_that_it_is_made_up_and_holds_together(row: JointSize) -> None:
    assert row.confidence == "made_up"
    assert row.cross is not None
    assert row.needles is not None
    assert row.rating is not None
    pitch = row.cross.journal + row.needles.diameter
    room = np.pi / np.arcsin(row.needles.diameter / pitch)
    assert row.needles.count <= room < row.needles.count + 1.0  # a full row
    assert row.rating.torque == pytest.approx(row.needles.capacity * row.cross.span, rel=0.06)  # Tc = 2 C R, rounded


def test_nothing_but_the_example_series_is_made_up_and_it_is_offered_to_nobody_else() -> None:
    made_up = {row.id for row in SIZES if row.confidence == "made_up"}
    assert made_up == {row.id for row in SIZES if row.series == "example"}
    assert not made_up & {row.id for row in catalogue().offered()}
    assert {row.id for row in catalogue().offered("gwb-587.50")} == {"gwb-587.50", "gwb-587.55", "gwb-587.60"}


@pytest.mark.parametrize("row", [row for row in SIZES if row.series.startswith("GWB")], ids=lambda row: row.id)
def test_the_torque_of_a_gwb_size_is_that_of_its_capacity_factor(row: JointSize) -> None:
    hours = row.maker.capacity_factor * 1e10 / (100.0 * 3.0 * (1e-3 * row.rating.torque) ** (10.0 / 3.0))
    assert hours == pytest.approx(5000.0, rel=0.02)  # the torque is rounded
    assert row.rating.max_torque == row.maker.functional_limit < row.maker.elastic_limit


@pytest.mark.parametrize("row", [row for row in SIZES if row.series.startswith("Spicer")], ids=lambda row: row.id)
def test_a_spicer_size_is_rated_by_its_bearing_torque(row: JointSize) -> None:
    if row.maker is None or row.maker.bearing_torque is None:
        return
    assert row.rating.torque == pytest.approx(row.maker.bearing_torque, rel=0.01)
    assert row.rating.max_torque == pytest.approx(min(row.maker.industrial, row.maker.elastic_limit), rel=0.01)


def test_figures_that_the_source_does_not_give_are_named_and_count_as_recalled() -> None:
    for row in SIZES:
        for figure in (*row.recalled, *row.derived):
            part, _dot, name = figure.partition(".")
            assert getattr(getattr(row, part), name) is not None, (row.id, figure)
    row = catalogue().rows(JointSize)["gwb-687.15"]
    assert (row.sure("rating.outer").confidence, row.sure("rating.torque").confidence) == ("recalled", "confirmed")


def test_an_unknown_grade_is_answered_by_its_standard_and_strength() -> None:
    with pytest.raises(
        InputError,
        match="by that name alone: name its state of delivery or its thickness, as in S355J2H-16, S355J2H-40",
    ):
        catalogue().grade("S355")
    with pytest.raises(InputError, match="nearest to its yield strength of 460 MPa are"):
        catalogue().grade("S460")
    with pytest.raises(InputError) as caught:
        catalogue().grade("Q9")
    assert "nearest" not in str(caught.value)


def test_every_grade_of_balance_is_there() -> None:
    speeds = {row.id: 1e3 * row.speed for row in catalogue().rows(BalanceGrade).values()}
    grades = ("G0.4", "G1", "G2.5", "G6.3", "G16", "G40", "G100", "G250", "G630", "G1600", "G4000")
    assert [speeds[name] for name in grades] == pytest.approx([float(name[1:]) for name in grades])


def test_every_fault_has_a_sign_and_each_circumstance_its_own_fault() -> None:
    rows = catalogue().rows(Fault).values()
    assert all(row.orders or row.symptoms for row in rows)
    assert sorted(flag for row in rows for flag in row.flags) == sorted(FLAGS)
    assert len({row.fault for row in rows}) == len(rows)


def test_a_fault_of_unknown_circumstance_is_refused(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(
        '[[faults]]\nid = "a"\nfault = "f"\ninspection = "i"\nrepair = "r"\nsource = "s"\norders = [0]\n'
        'flags = ["moon"]\n',
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        with_files(catalogue(), [own])
    fields = [problem.field.removeprefix(f"{own}: ") for problem in caught.value.problems]
    assert fields == ["faults[0].orders[0]", "faults[0].flags[0]"]


def test_a_grade_is_found_by_any_of_its_names() -> None:
    assert {catalogue().grade(name).id for name in ("45", "C45", "1045", "c45")} == {"45"}
    assert material("17Cr3").grade == "17Cr3"


def test_an_unknown_grade_names_the_nearest() -> None:
    with pytest.raises(InputError, match="42CrMo4"):
        catalogue().grade("42CrMo")


def test_rows_of_a_file_are_added_and_replace_their_like(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('[[materials]]\nid = "45"\nyield_strength_MPa = 400\nsource = "own test"\n', encoding="utf-8")
    both = with_files(catalogue(), [own])
    assert material("45", known=both).yield_strength == 400e6
    assert material("40", known=both) == material("40")
    assert material("45").yield_strength == 355e6


def test_every_fault_of_a_file_is_named_at_once(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(
        '[[materials]]\nid = "a"\nyield_strength_MP = 400\n[[joint_sizes]]\nid = "b"\nsource = "x"\n'
        "cross = { span_mm = -1 }\n[[stuff]]\n",
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        with_files(catalogue(), [own, tmp_path / "none.toml"])
    fields = [problem.field.removeprefix(f"{own}: ") for problem in caught.value.problems]
    assert fields == [
        "materials[0].yield_strength_MP",
        "materials[0].source",
        "joint_sizes[0].cross.span_mm",
        "stuff",
        str(tmp_path / "none.toml"),
    ]


def test_a_row_of_a_file_takes_over_its_own_id_alone(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text('[[materials]]\nid = "mine"\neuropean = "C45"\nsource = "s"\n', encoding="utf-8")
    assert with_files(catalogue(), [own]).grade("C45").id == "45"
    own.write_text('[[materials]]\nid = "C45"\nsource = "s"\n', encoding="utf-8")
    assert with_files(catalogue(), [own]).grade("C45").id == "C45"


def test_figures_that_contradict_each_other_are_refused(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text(
        '[[materials]]\nid = "a"\nsource = "s"\nyield_strength_MPa = 500\nultimate_strength_MPa = 400\n'
        '[[joint_types]]\nid = "b"\nsource = "s"\nname = "n"\nfamily = "f"\nsynchronous = "no"\n'
        "min_torque_Nm = 10\nmax_torque_Nm = 5\n",
        encoding="utf-8",
    )
    with pytest.raises(InputError) as caught:
        with_files(catalogue(), [own])
    fields = [problem.field.removeprefix(f"{own}: ") for problem in caught.value.problems]
    assert fields == ["materials[0].ultimate_strength_MPa", "joint_types[0].max_torque_Nm"]


def test_rows_are_told_in_the_language_spoken_and_kept_as_their_file_has_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("cardan.catalogue.rows._", str.upper)
    known = Catalogue(tables=catalogue().tables)
    with speaking("ru"):
        fault, grade = known.row(Fault, "F10"), known.grade("C22")
    own = known.tables["faults"]["F10"]
    assert isinstance(own, Fault)
    for name in ("fault", "inspection", "repair", "source"):
        assert getattr(fault, name) == getattr(own, name).upper()
    assert (fault.id, fault.symptoms, grade.id, grade.parts) == (own.id, own.symptoms, "20", ("tube",))
    assert row_flat(grade)["parts"] == "TUBE"
    assert known.row(Fault, "F10") is own


@pytest.mark.parametrize(("table", "count"), [("limits", 107), ("factors", 75)])
def test_values_of_practice_say_what_they_are_and_how_sure(table: str, count: int) -> None:
    rows = catalogue().table(table, GuideValue)
    assert len(rows) == count
    for row in rows.values():
        told = set(row_tree(row)) - {"id", "source", "confidence", "note", "name", "uses"}
        assert told or row.note, row.id
        assert row.source


def test_values_of_practice_are_those_of_their_sources() -> None:
    limits, factors = (catalogue().table(name, GuideValue) for name in ("limits", "factors"))
    assert limits["bolt_XS150"].torque == (105.0,)
    assert limits["series_gwb_587"].torque == (43e3, 57e3)
    assert limits["play_end_play"].length[0] == pytest.approx(0.0024 * 0.0254, rel=2e-3)
    assert factors["friction_spline_steel_greased"].value == (0.11,)
    assert factors["lv-200"].turning_stiffness[0] == pytest.approx(82 * 180 / np.pi, rel=2e-3)
    assert {row.confidence for row in factors.values()} == {"confirmed", "recalled"}
