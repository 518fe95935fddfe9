"""Joint angles in practice: limits by acceleration, rules of thumb, speed times angle."""

from __future__ import annotations

from typing import Any

from cardan.calc.calculation import Formulas, Values
from cardan.catalogue import catalogue
from cardan.catalogue.rows import AnglePair, SpeedAngleLimit
from cardan.questions.motion.angle_limits import TABLE_INERTIA, angle_limits, broken_rules, compound_angle
from cardan.reading.given import RIGHT, flag, given, positive, word, yoke_rotation

formula = Formulas(__doc__)


SLACK = 1e-12
"""A measure may exceed its limit by this share: what is left of rounding."""


@formula(
    "angular accelerations of two joints, and the second angle that keeps the torsional limit",
    "small angles as in shop practice, and exactly by the equivalent joint",
    positive("speed_rpm", "input speed"),
    yoke_rotation("theta1_deg", "angle of joint 1"),
    yoke_rotation("theta2_deg", "angle of joint 2"),
    flag("phased", "whether the joints are set to cancel", default=True),
    positive("limit_torsional_rad_s2", "largest acceleration", default=400.0),
    "theta_residual_deg = residual: angle of one joint as uneven",
    "torsional_rad_s2 = torsional: acceleration of the output",
    "inertia_drive_rad_s2 = inertia_drive: of the middle shaft when driving",
    "inertia_coast_rad_s2 = inertia_coast: of the middle shaft when coasting",
    "torsional_exact_rad_s2 = torsional_exact: acceleration of the output, exact",
    "theta2_min_deg = least: smallest second angle",
    "theta2_max_deg = most: largest second angle; none where none keeps the limit",
)
def _joint_angle_limits(v: Values) -> Any:
    return angle_limits(
        v.speed,
        v.theta1,
        v.theta2,
        phased=v.phased,
        torsional=v.limit_torsional,
    )


@formula(
    "largest second angle beside a first one, the articles' table as a formula",
    "θ_2 = √(θ_1² + 400/ω²), which gives the table of the web articles, section 26.1, to one digit",
    positive("speed_rpm", "input speed"),
    yoke_rotation("theta1_deg", "angle of joint 1"),
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
    yoke_rotation("theta1_deg", "angle of joint 1"),
    yoke_rotation("theta2_deg", "angle of joint 2"),
    "ok: whether they do",
    "violated: angle, difference",
)
def _angle_rule_6_1p5(v: Values) -> Any:
    broken = broken_rules(v.theta1, v.theta2)
    return not broken, list(broken)


@formula(
    "product of speed and bend against the limit of a joint",
    "Book pp. 64-65 for ball joints; Dana catalogue for its sizes",
    positive("speed_rpm", "speed"),
    yoke_rotation("alpha_deg", "joint_angle"),
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
