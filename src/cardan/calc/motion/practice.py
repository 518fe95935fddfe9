"""Practice: balance, accuracy of parts, layout, upkeep, materials, types of joints."""

from __future__ import annotations

import math
from typing import Any

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.catalogue import catalogue
from cardan.catalogue.rows import BalanceNorm, Lubrication, PartLimit
from cardan.choices.selection import Need, select_joint
from cardan.errors import Problem
from cardan.formulas.upkeep import lubrication_shares, shaft_sections
from cardan.questions.bending.balance import allowed_unbalance
from cardan.reading.given import at_least_zero, flag, gives, positive, word, yoke_rotation
from cardan.texts import _
from cardan.units import DIMENSIONS

from .angles import SLACK

formula = Formulas(__doc__)


MEASURES = {
    "yoke": {
        "axis_offset": "axis_offset_mm",
        "yoke_perpendicularity": "perpendicularity_mm_per_100",
        "face_symmetry": "face_symmetry_mm",
    },
    "cross": {
        "half_height_difference": "half_height_difference_mm",
        "cross_perpendicularity": "perpendicularity_mm_per_100",
        "coplanarity": "coplanarity_mm",
        "coaxiality": "coaxiality_mm",
    },
}
"""Part -> row of its limits -> key of the measure."""


GMM = DIMENSIONS["unbalance"]["g_mm"]
UNITS = tuple(unit for unit in DIMENSIONS["unbalance"])


def _measures(v: Values) -> Problems:
    """Yield measures of the other part, and a part of which nothing was measured."""
    part = v.get("part")
    if part is None:
        return
    own = [MEASURE[one] for one in MEASURES[part].values()]
    for item in MEASURE.values():
        if item not in own and v.get(item.name) is not None:
            text = _("is not a measure of a {part}; its measures are {known}")
            known = ", ".join(one.key for one in own)
            yield v.wrong(item.name, text.format(part=part, known=known), "unknown_key")
    if all(v.get(item.name, math.nan) is None for item in own):
        yield Problem(own[0].key, _("missing: give at least one measure"), "missing")


COUNTERS = {"hours": "hours", "distance": "km", "years": "years"}


def _counters(v: Values) -> Problems:
    if all(v.get(name, math.nan) is None for name in ("hours", "km", "years")):
        yield Problem("hours", _("missing: give the hours, the km or the years since the last lubrication"), "missing")


def _uses(v: Values) -> Problems:
    """Yield a part that the grade is not used for, where both are known."""
    parts = {part for row in catalogue().tables["materials"].values() for part in row.parts}  # type: ignore[attr-defined]
    part = v.get("part")
    if part is not None and part not in parts:
        text = _("{part} is none of {known}")
        yield v.wrong("part", text.format(part=repr(part), known=", ".join(sorted(parts))), "out_of_range")


MEASURE = {
    key: at_least_zero(
        key,
        "deviation as measured" + (", on 100 mm" if key.endswith("per_100") else ""),
        "length",
        default=None,
    )
    for keys in MEASURES.values()
    for key in keys.values()
}


@formula(
    "unbalance that a balance grade allows",
    "ISO 21940-11",
    positive("mass_kg", "mass of the shaft"),
    positive("speed_rpm", "highest speed"),
    positive("grade_mm_s", "grade: 16 for G16"),
    "U_per_gmm: unbalance of the shaft [g mm]",
    "U_per_plane_gmm: in each of two planes [g mm]",
    gives("e_per_um", "eccentricity of the centre of mass [µm]", None),
    "force_N: force that turns with the shaft",
)
def _balance(v: Values) -> Any:
    found = allowed_unbalance(v.mass, v.speed, v.grade)
    return found.whole / GMM, found.plane / GMM, found.eccentricity / 1e-6, found.force


@formula(
    "unbalance from one unit to g mm",
    "g = 9.80665 m/s²",
    at_least_zero("value", "unbalance"),
    word("unit", "its unit", *UNITS),
    "unbalance_gmm: unbalance [g mm]",
)
def _unbalance_convert(v: Values) -> Any:
    return v.value * DIMENSIONS["unbalance"][v.unit] / GMM


@formula(
    "whether an unbalance keeps the book's norm of a vehicle",
    "Book p. 247",
    word("vehicle_class", "vehicle", *catalogue().rows(BalanceNorm)),
    at_least_zero("unbalance_Ncm", "unbalance [N cm]"),
    "ok: whether it does",
    "limit_Ncm: the norm [N cm]",
)
def _balance_norm_book(v: Values) -> Any:
    limit = catalogue().rows(BalanceNorm)[v.vehicle_class].max_unbalance / DIMENSIONS["unbalance"]["N_cm"]
    return v.unbalance_Ncm <= limit * (1.0 + SLACK), limit


@formula(
    "whether the measures of a yoke or a cross keep their limits",
    "GOST 2752-74, by the Book",
    word("part", "part", *MEASURES),
    *MEASURE.values(),
    "ok: whether they do",
    "violated: the keys that do not",
    check=_measures,
)
def _accuracy_check(v: Values) -> Any:
    limits = catalogue().rows(PartLimit)
    violated = []
    for row, key in MEASURES[v.part].items():
        value = v[MEASURE[key].name]
        if value is not None and value > limits[row].limit * (1.0 + SLACK):
            violated.append(key)
    return not violated, violated


@formula(
    "how many shafts and centre bearings a wheelbase usually has",
    "web articles on drive shafts",
    positive("wheelbase_m", "distance of the axles"),
    "shaft_sections: shafts in line",
    "joints: joints",
    "centre_bearings: centre bearings",
)
def _shaft_layout(v: Values) -> Any:
    sections = shaft_sections(v.wheelbase)
    return sections, sections + 1, sections - 1


@formula(
    "whether lubrication is due, and by which counter",
    "Book pp. 248-249; half the intervals in water, mud or dust is a rule of this program",
    word("item", "what is lubricated", *catalogue().rows(Lubrication)),
    at_least_zero("hours", "hours run since the last time", default=None),
    at_least_zero("km", "kilometres run since the last time", default=None),
    at_least_zero("years", "years since the last time", default=None),
    flag("severe", "water, mud or dust"),
    "due: whether it is",
    "by: hours, km, years: those reached",
    "lubricant: with what",
    check=_counters,
)
def _lubrication_due(v: Values) -> Any:
    row = catalogue().rows(Lubrication)[v.item]
    shares = lubrication_shares(
        row,
        hours=None if v.hours is None else 3600.0 * v.hours,
        distance=None if v.km is None else 1000.0 * v.km,
        years=v.years,
        severe=v.severe,
    )
    by = [COUNTERS[name] for name, share in shares.items() if share >= 1.0 - SLACK]
    return bool(by), by, row.lubricant


@formula(
    "what the catalogue says of a grade",
    "Book p. 230; see the source of each row",
    word("grade", "grade, or its name in another standard"),
    word("part", "part it is to be used for", default=None),
    "heat_treatment = treatment: treatment",
    "hardness_HB: Brinell hardness, from and to",
    "hardness_HRC: Rockwell C hardness, from and to",
    "yield_MPa = yield_strength: yield strength",
    "ultimate_MPa = ultimate_strength: tensile strength",
    "en_equivalent: European grade, the same or the nearest",
    "aisi_equivalent: AISI grade, the same or the nearest",
    "used_for: parts it is used for",
    "confidence = confidence: how sure the figures are",
    "source = source: where they come from",
    check=_uses,
)
def _material(v: Values) -> Any:
    row = catalogue().grade(v.grade, field="grade")
    return row, {
        "hardness_HB": list(row.hardness_brinell) if row.hardness_brinell else None,
        "hardness_HRC": list(row.hardness_rockwell) if row.hardness_rockwell else None,
        "en_equivalent": row.european or None,
        "aisi_equivalent": row.american or None,
        "used_for": list(row.parts),
    }


@formula(
    "types of joints that do a job, under conditions or not, and why not",
    "catalogue of types; Book, chapter 1",
    positive("torque_Nm", "torque"),
    yoke_rotation("angle_deg", "joint angle of the joint"),
    at_least_zero("speed_rpm", "speed"),
    flag("synchronous", "whether the output must turn evenly"),
    positive("service_factor", "factor on the torque", default=1.0),
    flag("continuous", "whether it runs for long at a time", default=True),
    positive("outer_diameter_m", "outer diameter of the joint", default=None),
    flag("include_beyond_seeds", "whether modern types count"),
    "ok: types that do",
    "conditional: types that do under conditions -> conditions",
    "rejected: types that do not -> causes",
)
def _joint_selection(v: Values) -> Any:
    need = Need(
        joint_angle=v.angle,
        outer=v.outer_diameter,
        **v.of("torque", "speed", "synchronous", "service_factor", "continuous"),
    )
    found = select_joint(need, include_beyond=v.include_beyond_seeds)
    return {
        "ok": sorted(one.row.id for one in found if one.state == "ok"),
        "conditional": {one.row.id: list(one.flags) for one in found if one.state == "conditional"},
        "rejected": {one.row.id: list(one.causes) for one in found if one.state == "rejected"},
    }
