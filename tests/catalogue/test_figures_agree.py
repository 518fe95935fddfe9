"""Figures of the catalogue beside those that checks use: the same everywhere, with the law behind a printed table."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import numpy as np
import pytest

from cardan.catalogue import catalogue
from cardan.catalogue.rows import (
    AngleNorm,
    BalanceGrade,
    GuideValue,
    JointSize,
    Lubrication,
    MaxJointAngle,
    PartLimit,
    SpeedAngleLimit,
)
from cardan.checks.angles.speed_fluctuation import EVEN
from cardan.checks.practice.length import LONGEST
from cardan.formulas.critical_speed import CATALOGUE, HALF_BAND, tube_speed
from cardan.formulas.joint_rating import POWER
from cardan.units import deg, mm, rpm

INCH = 25.4 * mm
KNOWN = catalogue()
LIMITS = KNOWN.table("limits", GuideValue)


def test_accelerations_are_those_of_the_makers_program() -> None:
    norm = KNOWN.rows(AngleNorm)["spicer"]
    figures = (norm.torsional, norm.inertia_drive, norm.inertia_coast)
    for name in ("acceleration_driveshaft_program", "acceleration_spicer_dsag0200"):
        assert LIMITS[name].angular_acceleration == figures
    beyond = LIMITS["acceleration_driveshaft_program_max"].angular_acceleration
    assert all(one > usual for one, usual in zip(beyond, figures, strict=True))


def test_spicers_table_of_angles_has_the_products_its_note_tells() -> None:
    rows = KNOWN.rows(MaxJointAngle).values()
    products = [row.speed * row.max_joint_angle / (rpm * deg) for row in rows]
    told = LIMITS["speed_angle_spicer_table"]
    least, most = map(float, re.findall(r"(\d{5})", told.note))
    assert min(products) == pytest.approx(least)
    assert max(products) == pytest.approx(most, rel=1e-3)
    assert told.speed_angle[0] / (rpm * deg) == pytest.approx(np.median(products), rel=0.01)
    # printed in degrees and minutes: 3°15', 3°40', 4°15' …; each a multiple of five minutes to the digits given
    for row in rows:
        assert row.max_joint_angle / deg * 12.0 == pytest.approx(round(row.max_joint_angle / deg * 12.0), abs=0.07)


def test_speed_times_angle_falls_with_the_size_as_the_speed_does() -> None:
    rows = [row for name, row in KNOWN.rows(SpeedAngleLimit).items() if name.startswith("dana")]
    assert len(rows) == 12
    for smaller, larger in pairwise(rows):
        assert smaller.max_speed_angle >= larger.max_speed_angle
        assert smaller.max_speed is not None
        assert larger.max_speed is not None
        assert smaller.max_speed >= larger.max_speed


def test_what_counts_as_uniform_is_elbes_limit_and_that_of_the_joint_angle_beside_it() -> None:
    assert LIMITS["non_uniformity_elbe"].value == (EVEN,)
    row = LIMITS["non_uniformity_resultant_bend"]
    assert row.value == (EVEN,)
    # of one joint ω₂ lies between cos α and 1/cos α times ω₁: U = tan α sin α
    assert math.tan(row.joint_angle[0]) * math.sin(row.joint_angle[0]) == pytest.approx(EVEN, rel=4e-3)


def test_shares_of_the_critical_speed_are_the_makers() -> None:
    assert LIMITS["critical_ims_vehicle"].value == (CATALOGUE["automotive"],)
    assert LIMITS["critical_ims_industry"].value == (CATALOGUE["industrial"],)
    # others allow more, so that these judge on the safe side
    for name in ("critical_driveshaft_program", "critical_cardan_india", "critical_general_shafts", "critical_gwb"):
        assert LIMITS[name].value[0] > max(CATALOGUE.values())


def test_the_band_about_half_the_critical_speed_lies_in_that_of_the_makers() -> None:
    # "8 % above or below 50 %": taken as 8 % of the half; read as points of the whole it is twice as wide
    band = 0.5 * (1.0 - HALF_BAND), 0.5 * (1.0 + HALF_BAND)
    for name in ("critical_cardan_india", "critical_driveshaft_program"):
        low, high = LIMITS[name].avoid
        assert (low, high) == pytest.approx((0.5 - HALF_BAND, 0.5 + HALF_BAND))
        assert low < band[0] < band[1] < high


def test_formulas_of_the_critical_speed_are_that_of_a_steel_tube() -> None:
    def constant(name: str) -> float:
        (found,) = re.findall(r"= ([\d.e]+) \* sqrt", LIMITS[name].formula)
        return float(found)

    outer, inner, length = 3.5 * INCH, (3.5 - 2 * 0.120) * INCH, 60.0 * INCH
    hypot = math.hypot(outer, inner)
    by_inch = constant("critical_speed_sae_inch") * hypot / INCH / (length / INCH) ** 2 * rpm
    by_mm = constant("critical_speed_ims_mm") * hypot / mm / (length / mm) ** 2 * rpm
    assert by_inch == pytest.approx(LIMITS["critical_speed_sae_check"].speed[0], rel=1e-4)
    assert by_mm == pytest.approx(by_inch, rel=0.02)
    assert float(tube_speed(length, outer, inner)) == pytest.approx(by_inch, rel=0.02)


def test_grades_of_balance_are_their_names_and_steps_of_the_standard() -> None:
    rows = KNOWN.rows(BalanceGrade)
    for name, row in rows.items():
        assert row.speed == pytest.approx(1e-3 * float(name.removeprefix("G")))
    standard = sorted(row.speed for row in rows.values() if "no grade" not in row.source)
    steps = np.diff(np.log(standard))
    assert np.exp(steps) == pytest.approx(2.5, rel=0.02)  # ISO 21940-11: 0.4 to 4000 in steps of 2.5


def test_the_formula_of_the_residual_unbalance_is_the_grade_over_the_speed() -> None:
    (constant,) = re.findall(r"= (\d+) \* G \* m / n", LIMITS["balance_residual_unbalance"].formula)
    assert float(constant) * 1e-6 == pytest.approx(1e-3 / rpm, rel=1e-4)  # g·mm from mm/s, kg and rpm


def test_the_exponent_of_life_and_the_ratings_are_those_of_the_formulas() -> None:
    for name in ("life_gwb", "life_spicer"):
        (top, bottom) = re.findall(r"\^\((\d+)/(\d+)\)", LIMITS[name].formula)[0]
        assert float(top) / float(bottom) == POWER
    # Spicer's 1.5e6 h·rpm·deg: at its bearing torque, 100 rpm and 3° a joint lasts 5000 h
    (constant,) = re.findall(r"= ([\d.e]+) / \(n", LIMITS["life_spicer"].formula)
    basis = LIMITS["life_basis_ims_needle"]
    assert float(constant) / (100.0 * basis.joint_angle[0] / deg) == basis.time[0] / 3600.0


def test_lengths_between_joints_are_the_rule_of_thumb_of_the_smallest_tube() -> None:
    rows = [row for name, row in LIMITS.items() if name.startswith("length_tube")]
    assert rows[0].length[0] == pytest.approx(LONGEST, rel=0.02)
    assert [row.diameter[0] for row in rows] == sorted(row.diameter[0] for row in rows)
    assert np.diff([row.length[0] for row in rows]) == pytest.approx(5.0 * INCH, rel=1e-3)


def test_ranges_of_series_hold_the_sizes_of_the_series() -> None:
    sizes = KNOWN.rows(JointSize)
    for series, begins in (
        ("series_gwb_587", "gwb-587"),
        ("series_gwb_390", "gwb-390"),
        ("series_gwb_687_688", "gwb-68"),
    ):
        low, high = LIMITS[series].torque
        ratings = [row.rating.max_torque for name, row in sizes.items() if name.startswith(begins)]
        assert ratings
        assert all(low * 0.999 <= one <= high * 1.001 for one in ratings if one is not None), (series, ratings)


def test_no_row_of_lubrication_or_of_parts_stands_twice() -> None:
    greases = [(row.lubricant, row.hours, row.distance, row.years) for row in KNOWN.rows(Lubrication).values()]
    loose = [(row.lubricant, row.time[0] if row.time else None) for row in LIMITS.values() if row.name == "lubrication"]
    assert not {one[:2] for one in greases} & set(loose)
    assert not set(KNOWN.rows(PartLimit)) & {name.removeprefix("play_") for name in LIMITS}


def test_figures_of_the_same_thing_by_several_makers_stay_together() -> None:
    for maker in ("ij900", "ims", "gwb"):
        factors = [row.value[0] for name, row in LIMITS.items() if name.startswith(f"prime_mover_{maker}")]
        assert factors == sorted(factors)
        assert factors[0] == 1.0
    types = [LIMITS[f"pto_type_{number}"] for number in (1, 2, 3, 4)]
    assert [row.speed[0] / rpm for row in types] == pytest.approx([540.0, 1000.0, 1000.0, 1300.0])
    assert [row.power[0] for row in types] == sorted(row.power[0] for row in types)
