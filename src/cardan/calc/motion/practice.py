"""Calculations of practice: balance, accuracy of parts, layout, upkeep, materials, types of joints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from cardan.calc.calculation import Calculation, Values, at_least_zero, given, gives, positive
from cardan.catalogue import catalogue
from cardan.catalogue.rows import BalanceNorm, Lubrication, PartLimit
from cardan.choices.selection import JointDuty, select_joint
from cardan.errors import Problem
from cardan.formulas.upkeep import lubrication_shares, shaft_sections
from cardan.questions.bending.balance import allowed_unbalance
from cardan.texts import _, mark
from cardan.units import DIMENSIONS

from .angles import SLACK, angle

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


def _balance(values: Values) -> Values:
    found = allowed_unbalance(values["mass"], values["speed"], values["grade"])
    return {
        "U_per_gmm": found.whole / GMM,
        "U_per_plane_gmm": found.plane / GMM,
        "e_per_um": found.eccentricity / 1e-6,
        "force_N": found.force,
    }


GMM = DIMENSIONS["unbalance"]["g_mm"]
UNITS = tuple(unit for unit in DIMENSIONS["unbalance"])


def _convert(values: Values) -> Values:
    return {"unbalance_gmm": values["value"] * DIMENSIONS["unbalance"][values["unit"]] / GMM}


def _norm(values: Values) -> Values:
    limit = catalogue().rows(BalanceNorm)[values["vehicle_class"]].max_unbalance / DIMENSIONS["unbalance"]["N_cm"]
    return {"ok": values["unbalance_Ncm"] <= limit * (1.0 + SLACK), "limit_Ncm": limit}


def _accuracy(values: Values) -> Values:
    limits = catalogue().rows(PartLimit)
    violated = []
    for row, key in MEASURES[values["part"]].items():
        value = values[MEASURE[key].name]
        if value is not None and value > limits[row].limit * (1.0 + SLACK):
            violated.append(key)
    return {"ok": not violated, "violated": violated}


def _measures(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield measures of the other part, and a part of which nothing was measured."""
    part = values.get("part")
    if part is None:
        return
    own = [MEASURE[one] for one in MEASURES[part].values()]
    for item in MEASURE.values():
        if item not in own and values.get(item.name) is not None:
            text = _("is not a measure of a {part}; its measures are {known}")
            known = ", ".join(one.key for one in own)
            yield Problem(key(item.name), text.format(part=part, known=known), "unknown_key")
    if all(values.get(item.name, math.nan) is None for item in own):
        yield Problem(own[0].key, _("missing: give at least one measure"), "missing")


def _layout(values: Values) -> Values:
    sections = shaft_sections(values["wheelbase"])
    return {"shaft_sections": sections, "joints": sections + 1, "centre_bearings": sections - 1}


COUNTERS = {"hours": "hours", "distance": "km", "years": "years"}


def _lubrication(values: Values) -> Values:
    row = catalogue().rows(Lubrication)[values["item"]]
    shares = lubrication_shares(
        row,
        hours=None if values["hours"] is None else 3600.0 * values["hours"],
        distance=None if values["km"] is None else 1000.0 * values["km"],
        years=values["years"],
        severe=values["severe"],
    )
    by = [COUNTERS[name] for name, share in shares.items() if share >= 1.0 - SLACK]
    return {"due": bool(by), "by": by, "lubricant": row.lubricant}


def _counters(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if all(values.get(name, math.nan) is None for name in ("hours", "km", "years")):
        yield Problem("hours", _("missing: give the hours, the km or the years since the last lubrication"), "missing")


def _material(values: Values) -> Values:
    row = catalogue().grade(values["grade"], field="grade")
    return {
        "heat_treatment": row.treatment,
        "hardness_HB": list(row.hardness_brinell) if row.hardness_brinell else None,
        "hardness_HRC": list(row.hardness_rockwell) if row.hardness_rockwell else None,
        "yield_MPa": row.yield_strength,
        "ultimate_MPa": row.ultimate_strength,
        "en_equivalent": row.european or None,
        "aisi_equivalent": row.american or None,
        "used_for": list(row.parts),
        "confidence": row.confidence,
        "source": row.source,
    }


def _uses(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a part that the grade is not used for, where both are known."""
    parts = {part for row in catalogue().tables["materials"].values() for part in row.parts}  # type: ignore[attr-defined]
    part = values.get("part")
    if part is not None and part not in parts:
        text = _("{part} is none of {known}")
        yield Problem(key("part"), text.format(part=repr(part), known=", ".join(sorted(parts))), "out_of_range")


def _select(values: Values) -> Values:
    need = JointDuty(
        torque=values["torque"],
        joint_angle=values["angle"],
        speed=values["speed"],
        synchronous=values["synchronous"],
        service_factor=values["service_factor"],
        continuous=values["continuous"],
        outer=values["outer_diameter"],
    )
    found = select_joint(need, include_beyond=values["include_beyond_seeds"])
    return {
        "ok": sorted(one.row.id for one in found if one.state == "ok"),
        "conditional": {one.row.id: list(one.flags) for one in found if one.state == "conditional"},
        "rejected": {one.row.id: list(one.causes) for one in found if one.state == "rejected"},
    }


MEASURE = {
    key: at_least_zero(
        key,
        mark("deviation as measured") + (mark(", on 100 mm") if key.endswith("per_100") else ""),
        "length",
        default=None,
    )
    for keys in MEASURES.values()
    for key in keys.values()
}

CALCULATIONS = (
    Calculation(
        name="balance",
        doc=mark("unbalance that a balance grade allows"),
        source="ISO 21940-11",
        takes=(
            positive("mass_kg", mark("mass of the shaft"), "mass"),
            positive("speed_rpm", mark("highest speed"), "angular_speed"),
            positive("grade_mm_s", mark("grade: 16 for G16"), "speed"),
        ),
        returns=(
            gives("U_per_gmm", mark("unbalance of the shaft [g mm]")),
            gives("U_per_plane_gmm", mark("in each of two planes [g mm]")),
            gives("e_per_um", mark("eccentricity of the centre of mass [µm]")),
            gives("force_N", mark("force that turns with the shaft"), "force"),
        ),
        answer=_balance,
    ),
    Calculation(
        name="unbalance_convert",
        doc=mark("unbalance from one unit to g mm"),
        source=mark("g = 9.80665 m/s²"),
        takes=(
            at_least_zero("value", mark("unbalance")),
            given("unit", mark("its unit"), kind="word", choices=UNITS),
        ),
        returns=(gives("unbalance_gmm", mark("unbalance [g mm]")),),
        answer=_convert,
    ),
    Calculation(
        name="balance_norm_book",
        doc=mark("whether an unbalance keeps the book's norm of a vehicle"),
        source="Kozhevnikov & Perfil'ev (1978), p. 247",
        takes=(
            given("vehicle_class", mark("vehicle"), kind="word", choices=tuple(catalogue().rows(BalanceNorm))),
            at_least_zero("unbalance_Ncm", mark("unbalance [N cm]")),
        ),
        returns=(gives("ok", mark("whether it does")), gives("limit_Ncm", mark("the norm [N cm]"))),
        answer=_norm,
    ),
    Calculation(
        name="accuracy_check",
        doc=mark("whether the measures of a yoke or a cross keep their limits"),
        source=mark("GOST 2752-74, by Kozhevnikov & Perfil'ev (1978)"),
        takes=(given("part", mark("part"), kind="word", choices=tuple(MEASURES)), *MEASURE.values()),
        returns=(gives("ok", mark("whether they do")), gives("violated", mark("the keys that do not"))),
        answer=_accuracy,
        check=_measures,
    ),
    Calculation(
        name="shaft_layout",
        doc=mark("how many shafts and centre bearings a wheelbase usually has"),
        source=mark("rule of practice, source unknown"),
        takes=(positive("wheelbase_m", mark("distance of the axles"), "length"),),
        returns=(
            gives("shaft_sections", mark("shafts in line")),
            gives("joints", mark("joints")),
            gives("centre_bearings", mark("centre bearings")),
        ),
        answer=_layout,
    ),
    Calculation(
        name="lubrication_due",
        doc=mark("whether lubrication is due, and by which counter"),
        source=mark(
            "Kozhevnikov & Perfil'ev (1978), pp. 248–249; half the intervals in water, mud or dust is a "
            "rule of this program"
        ),
        takes=(
            given("item", mark("what is lubricated"), kind="word", choices=tuple(catalogue().rows(Lubrication))),
            at_least_zero("hours", mark("hours run since the last time"), default=None),
            at_least_zero("km", mark("kilometres run since the last time"), default=None),
            at_least_zero("years", mark("years since the last time"), default=None),
            given("severe", mark("water, mud or dust"), kind="flag", default=False),
        ),
        returns=(
            gives("due", mark("whether it is")),
            gives("by", mark("hours, km, years: those reached")),
            gives("lubricant", mark("with what")),
        ),
        answer=_lubrication,
        check=_counters,
    ),
    Calculation(
        name="material",
        doc=mark("what the catalogue says of a grade"),
        source=mark("Kozhevnikov & Perfil'ev (1978), p. 230; see the source of each row"),
        takes=(
            given("grade", mark("grade, or its name in another standard"), kind="word"),
            given("part", mark("part it is to be used for"), kind="word", default=None),
        ),
        returns=(
            gives("heat_treatment", mark("treatment")),
            gives("hardness_HB", mark("Brinell hardness, from and to")),
            gives("hardness_HRC", mark("Rockwell C hardness, from and to")),
            gives("yield_MPa", mark("yield strength"), "stress"),
            gives("ultimate_MPa", mark("tensile strength"), "stress"),
            gives("en_equivalent", mark("European grade, the same or the nearest")),
            gives("aisi_equivalent", mark("AISI grade, the same or the nearest")),
            gives("used_for", mark("parts it is used for")),
            gives("confidence", mark("how sure the figures are")),
            gives("source", mark("where they come from")),
        ),
        answer=_material,
        check=_uses,
    ),
    Calculation(
        name="joint_selection",
        doc=mark("types of joints that do a job, under conditions or not, and why not"),
        source=mark("catalogue of types; Kozhevnikov & Perfil'ev (1978), chapter 1"),
        takes=(
            positive("torque_Nm", mark("torque"), "torque"),
            angle("angle_deg", mark("joint angle of the joint")),
            at_least_zero("speed_rpm", mark("speed"), "angular_speed"),
            given("synchronous", mark("whether the output must turn evenly"), kind="flag", default=False),
            positive("service_factor", mark("factor on the torque"), default=1.0),
            given("continuous", mark("whether it runs for long at a time"), kind="flag", default=True),
            positive("outer_diameter_m", mark("outer diameter of the joint"), "length", default=None),
            given("include_beyond_seeds", mark("whether modern types count"), kind="flag", default=False),
        ),
        returns=(
            gives("ok", mark("types that do")),
            gives("conditional", mark("types that do under conditions -> conditions")),
            gives("rejected", mark("types that do not -> causes")),
        ),
        answer=_select,
    ),
)
"""Calculations of this part."""
