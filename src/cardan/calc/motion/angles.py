"""Calculations of joint angles in practice: limits by acceleration, rules of thumb, speed times angle."""

from __future__ import annotations

from cardan.calc.calculation import Calculation, Given, Values, given, gives, positive
from cardan.catalogue import catalogue
from cardan.catalogue.rows import AnglePair, SpeedAngleLimit
from cardan.questions.motion.angle_limits import TABLE_INERTIA, angle_limits, broken_rules, compound_angle
from cardan.texts import mark

from .kinematics import RIGHT

SLACK = 1e-12
"""A measure may exceed its limit by this share: what is left of rounding."""


def angle(key: str, doc: str) -> Given:
    """Declare an angle between two shafts."""
    return given(key, doc, "angle", low=0.0, below=RIGHT)


def _limits(values: Values) -> Values:
    found = angle_limits(
        values["speed"],
        values["theta1"],
        values["theta2"],
        phased=values["phased"],
        torsional=values["limit_torsional"],
    )
    return {
        "theta_residual_deg": found.residual,
        "torsional_rad_s2": found.torsional,
        "inertia_drive_rad_s2": found.inertia_drive,
        "inertia_coast_rad_s2": found.inertia_coast,
        "torsional_exact_rad_s2": found.torsional_exact,
        "theta2_min_deg": found.least,
        "theta2_max_deg": found.most,
    }


def _table(values: Values) -> Values:
    found = angle_limits(values["speed"], values["theta1"], values["theta1"])
    speeds = [row.speed for row in catalogue().rows(AnglePair).values()]
    warnings = []
    if not min(speeds) - 1e-9 <= values["speed"] <= max(speeds) + 1e-9:
        warnings.append("extrapolated")
    if values["speed"] ** 2 * found.most**2 > TABLE_INERTIA:
        warnings.append("inertia_limit")
    return {"theta2_max_deg": found.most, "warnings": warnings}


def _rule(values: Values) -> Values:
    broken = broken_rules(values["theta1"], values["theta2"])
    return {"ok": not broken, "violated": list(broken)}


def _product(values: Values) -> Values:
    row = catalogue().rows(SpeedAngleLimit)[values["joint"]]
    product = values["speed"] * values["alpha"]
    violated = ["n_alpha"] if product > row.max_speed_angle * (1.0 + SLACK) else []
    if row.max_speed is not None and values["speed"] > row.max_speed * (1.0 + SLACK):
        violated.append("speed")
    return {
        "n_alpha_rpm_deg": product,
        "limit_rpm_deg": row.max_speed_angle,
        "ok": not violated,
        "violated": violated,
    }


def _compound(values: Values) -> Values:
    exact, small = compound_angle(values["top_view"], values["side_view"])
    return {"angle_deg": exact, "angle_small_deg": small}


CALCULATIONS = (
    Calculation(
        name="joint_angle_limits",
        doc=mark("angular accelerations of two joints, and the second angle that keeps the torsional limit"),
        source=mark("small angles as in shop practice, and exactly by the equivalent joint"),
        takes=(
            positive("speed_rpm", mark("input speed"), "angular_speed"),
            angle("theta1_deg", mark("angle of joint 1")),
            angle("theta2_deg", mark("angle of joint 2")),
            given("phased", mark("whether the joints are set to cancel"), kind="flag", default=True),
            positive("limit_torsional_rad_s2", mark("largest acceleration"), "angular_acceleration", default=400.0),
        ),
        returns=(
            gives("theta_residual_deg", mark("angle of one joint as uneven"), "angle"),
            gives("torsional_rad_s2", mark("acceleration of the output"), "angular_acceleration"),
            gives("inertia_drive_rad_s2", mark("of the middle shaft when driving"), "angular_acceleration"),
            gives("inertia_coast_rad_s2", mark("of the middle shaft when coasting"), "angular_acceleration"),
            gives("torsional_exact_rad_s2", mark("acceleration of the output, exact"), "angular_acceleration"),
            gives("theta2_min_deg", mark("smallest second angle"), "angle"),
            gives("theta2_max_deg", mark("largest second angle; none where none keeps the limit"), "angle"),
        ),
        answer=_limits,
    ),
    Calculation(
        name="joint_angle_table",
        doc=mark("largest second angle beside a first one, the articles' table as a formula"),
        source=mark("θ_2 = √(θ_1² + 400/ω²), which gives the table of joint angles in use, to one digit"),
        takes=(
            positive("speed_rpm", mark("input speed"), "angular_speed"),
            angle("theta1_deg", mark("angle of joint 1")),
        ),
        returns=(
            gives("theta2_max_deg", mark("largest angle of joint 2"), "angle"),
            gives("warnings", mark("extrapolated: not a speed of the table; inertia_limit: beyond its rows")),
        ),
        answer=_table,
    ),
    Calculation(
        name="angle_rule_6_1p5",
        doc=mark("whether two angles keep the rule of 6° each and 1.5° difference"),
        source=mark("rule of practice, source unknown"),
        takes=(angle("theta1_deg", mark("angle of joint 1")), angle("theta2_deg", mark("angle of joint 2"))),
        returns=(gives("ok", mark("whether they do")), gives("violated", mark("angle, difference"))),
        answer=_rule,
    ),
    Calculation(
        name="speed_angle_product",
        doc=mark("product of speed and bend against the limit of a joint"),
        source=mark("Kozhevnikov & Perfil'ev (1978), pp. 64–65 for ball joints; Dana catalogue for its sizes"),
        takes=(
            positive("speed_rpm", mark("speed"), "angular_speed"),
            angle("alpha_deg", mark("joint angle")),
            given("joint", mark("row of the catalogue"), kind="word", choices=tuple(catalogue().rows(SpeedAngleLimit))),
        ),
        returns=(
            gives("n_alpha_rpm_deg", mark("product"), "speed_angle"),
            gives("limit_rpm_deg", mark("its limit"), "speed_angle"),
            gives("ok", mark("whether speed and product keep their limits")),
            gives("violated", mark("n_alpha, speed")),
        ),
        answer=_product,
    ),
    Calculation(
        name="compound_angle",
        doc=mark("angle between two shafts from its top and side view"),
        source=mark("tan θ = √(tan²T + tan²S)"),
        takes=(
            given("top_view_deg", mark("angle in the top view"), "angle", above=-RIGHT, below=RIGHT),
            given("side_view_deg", mark("angle in the side view"), "angle", above=-RIGHT, below=RIGHT),
        ),
        returns=(
            gives("angle_deg", mark("exact"), "angle"),
            gives("angle_small_deg", mark("by the shop's formula √(T² + S²)"), "angle"),
        ),
        answer=_compound,
    ),
)
"""Calculations of this part."""
