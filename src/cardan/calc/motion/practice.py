"""Practice: joint angles, balance, accuracy of parts, layout, upkeep, materials, types of joints."""

from __future__ import annotations

import math
from typing import Any

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.catalogue import catalogue
from cardan.catalogue.rows import AnglePair, BalanceNorm, Lubrication, PartLimit, SpeedAngleLimit
from cardan.choices.selection import JointDuty, select_joint
from cardan.errors import Problem
from cardan.formulas.maintenance import lubrication_shares, shaft_sections
from cardan.questions.bending.balance import allowed_unbalance
from cardan.questions.motion.angle_limits import TABLE_INERTIA, angle_limits, broken_rules, compound_angle
from cardan.reading.given import RIGHT, at_least_zero, flag, given, gives, joint_angle, positive, word
from cardan.texts import _
from cardan.units import DIMENSIONS

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
        yield v.wrong(
            "part", _("{part} is none of {known}"), "out_of_range", part=repr(part), known=", ".join(sorted(parts))
        )


MEASURE = {
    key: at_least_zero(
        key, "deviation as measured" + (", on 100 mm" if key.endswith("per_100") else ""), "length", default=None
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
    "whether an unbalance keeps the permissible value of a vehicle by Kozhevnikov and Perfil'ev (1978)",
    "Kozhevnikov & Perfil'ev (1978), p. 247",
    word("vehicle_class", "vehicle", *catalogue().rows(BalanceNorm)),
    at_least_zero("unbalance_Ncm", "unbalance [N cm]"),
    "ok: whether it does",
    "limit_Ncm: the permissible value [N cm]",
)
def _balance_norm_book(v: Values) -> Any:
    limit = catalogue().rows(BalanceNorm)[v.vehicle_class].max_unbalance / DIMENSIONS["unbalance"]["N_cm"]
    return v.unbalance_Ncm <= limit * (1.0 + SLACK), limit


@formula(
    "whether the measures of a yoke or a cross keep their limits",
    "GOST 2752-74, by Kozhevnikov & Perfil'ev (1978)",
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
    "Kozhevnikov & Perfil'ev (1978), pp. 248–249; half the intervals in water, mud or dust is a rule of this program",
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
    "Kozhevnikov & Perfil'ev (1978), p. 230; see the source of each row",
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
    "confidence: how sure the figures are",
    "source: where they come from",
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
    "catalogue of types; Kozhevnikov & Perfil'ev (1978), chapter 1",
    positive("torque_Nm", "torque"),
    joint_angle("angle_deg", "joint angle of the joint"),
    at_least_zero("speed_rpm", "speed"),
    flag("synchronous", "whether the output must turn uniformly"),
    positive("service_factor", "factor on the torque", default=1.0),
    flag("continuous", "whether it runs for long at a time", default=True),
    positive("outer_diameter_m", "outer diameter of the joint", default=None),
    flag("include_beyond_seeds", "whether modern types count"),
    "ok: types that do",
    "conditional: types that do under conditions -> conditions",
    "rejected: types that do not -> causes",
)
def _joint_selection(v: Values) -> Any:
    need = JointDuty(
        joint_angle=v.angle,
        outer=v.outer_diameter,
        **v.of("torque", "speed", "synchronous", "service_factor", "continuous"),
    )
    found = select_joint(need, include_beyond=v.include_beyond_seeds)
    return {
        "ok": sorted(one.row.id for one in found if one.state == "ok"),
        "conditional": {one.row.id: list(one.flags) for one in found if one.state in ("conditional", "unrated")},
        "rejected": {one.row.id: list(one.causes) for one in found if one.state == "rejected"},
    }


SLACK = 1e-12
"""A measure may exceed its limit by this share: what is left of rounding."""


@formula(
    "angular accelerations of two joints, and the second angle that keeps the torsional limit",
    "small angles as in shop practice, and exactly by the equivalent joint",
    positive("speed_rpm", "input speed"),
    joint_angle("theta1_deg", "angle of joint 1"),
    joint_angle("theta2_deg", "angle of joint 2"),
    flag("phased", "whether the joints are set to cancel", default=True),
    positive("limit_torsional_rad_s2", "largest acceleration", default=400.0),
    "theta_residual_deg = residual: angle of one joint with the same speed fluctuation",
    "torsional_rad_s2 = torsional: acceleration of the output",
    "inertia_drive_rad_s2 = inertia_drive: of the middle shaft when driving",
    "inertia_coast_rad_s2 = inertia_coast: of the middle shaft when coasting",
    "torsional_exact_rad_s2 = torsional_exact: acceleration of the output, exact",
    "theta2_min_deg = least: smallest second angle",
    "theta2_max_deg = most: largest second angle; none where none keeps the limit",
)
def _joint_angle_limits(v: Values) -> Any:
    return angle_limits(v.speed, v.theta1, v.theta2, phased=v.phased, torsional=v.limit_torsional)


@formula(
    "largest second angle beside a first one, the articles' table as a formula",
    "θ_2 = √(θ_1² + 400/ω²), which gives the table of the web articles, section 26.1, to one digit",
    positive("speed_rpm", "input speed"),
    joint_angle("theta1_deg", "angle of joint 1"),
    "theta2_max_deg: largest angle of joint 2",
    "warnings: extrapolated: not a speed of the table; inertia_limit: beyond its rows",
)
def _joint_angle_table(v: Values) -> Any:
    found = angle_limits(v.speed, v.theta1, v.theta1)
    speeds = [row.speed for row in catalogue().rows(AnglePair).values()]
    warnings = []
    if not min(speeds) - 1e-9 <= v.speed <= max(speeds) + 1e-9:
        warnings.append("extrapolated")
    if v.speed**2 * found.most**2 > TABLE_INERTIA:
        warnings.append("inertia_limit")
    return found.most, warnings


@formula(
    "whether two angles keep the rule of 6° each and 1.5° difference",
    "web articles on drive shafts",
    joint_angle("theta1_deg", "angle of joint 1"),
    joint_angle("theta2_deg", "angle of joint 2"),
    "ok: whether they do",
    "violated: angle, difference",
)
def _angle_rule_6_1p5(v: Values) -> Any:
    broken = broken_rules(v.theta1, v.theta2)
    return not broken, list(broken)


@formula(
    "product of speed and joint angle against the limit of a joint",
    "Kozhevnikov & Perfil'ev (1978), pp. 64–65 for ball joints; Dana catalogue for its sizes",
    positive("speed_rpm", "speed"),
    joint_angle("alpha_deg", "joint angle"),
    word("joint", "row of the catalogue", *catalogue().rows(SpeedAngleLimit)),
    "n_alpha_rpm_deg: product",
    "limit_rpm_deg: its limit",
    "ok: whether speed and product keep their limits",
    "violated: n_alpha, speed",
)
def _speed_angle_product(v: Values) -> Any:
    row = catalogue().rows(SpeedAngleLimit)[v.joint]
    product = v.speed * v.alpha
    violated = ["n_alpha"] if product > row.max_speed_angle * (1.0 + SLACK) else []
    if row.max_speed is not None and v.speed > row.max_speed * (1.0 + SLACK):
        violated.append("speed")
    return product, row.max_speed_angle, not violated, violated


@formula(
    "angle between two shafts from its top and side view",
    "tan θ = √(tan²T + tan²S)",
    given("top_view_deg", "angle in the top view", above=-RIGHT, below=RIGHT),
    given("side_view_deg", "angle in the side view", above=-RIGHT, below=RIGHT),
    "angle_deg: exact",
    "angle_small_deg: by the shop's formula √(T² + S²)",
)
def _compound_angle(v: Values) -> Any:
    exact, small = compound_angle(v.top_view, v.side_view)
    return exact, small
