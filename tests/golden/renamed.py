"""What is called otherwise now than when ``answers.json.xz`` was captured; all patterns are regular expressions.

Only names stand here, and what follows from an answer's new form: no entry may excuse a number that changed. Units need
none: ``life_h`` is found as ``life_s``. ``python -m tests.golden.check --suggest`` prints entries for `PATHS`.
"""

from __future__ import annotations

COMMAND_LINES: tuple[tuple[str, str], ...] = (
    (r"^tolerance ", "accuracy "),
    (r"^torsion calm ", "torsion optimise "),
    (r"--bend-deg", "--joint-angle-deg"),
    (r"--bends(?= )", "--joint-angles"),
    (r"--bend(?= )", "--joint-angle"),
    (r"^catalogue max_bends", "catalogue max_joint_angles"),
    (r"^(simulate-fault \S+) bends", r"\1 joint_angles"),
    (r"^(?!calc )(.*)\bbend_deg", r"\1joint_angle_deg"),
    (r"strength_used <= 1\b", "strength_used_percent <= 100"),
)
"""Pattern in a whole command line -> what stands there now: ``(r"^simulate-fault ", "fault ")``."""

PATHS: tuple[tuple[str, str, str], ...] = (
    ("rotor", r"peak_rpm", "peak_at_rpm"),
    ("diagnose", r"causes\.score", "causes.probability_percent"),
    ("simulate-fault", r"(orders|knocks)\.size(_m_s2|)", r"\1.amplitude"),
    ("life", r"parts\.bend_deg", "parts.joint_angle_deg"),
    ("torsion (response|stability)", r"growth_rate_1_per_s", "growth_rate_per_s"),
    ("torsion response", r"apart\.(.*)", r"nonsynchronous.\1"),
    ("torsion stability", r"nearest_zone_rpm", "nearest_zone_speed_rpm"),
    ("losses", r"efficiency_small_bends", "efficiency_small_joint_angles"),
    ("losses", r"(.*[._])?heat_W", r"\1power_loss_W"),
    ("mobility", r"(joints\.)?misfit(.*)", r"\1misalignment\2"),
    ("mobility", r"repairs(.*)", r"remedies\1"),
    ("mobility", r"turn\.comes_round", "turn.turns_through"),
    ("assembly", r"(.*\.)?let_go", r"\1release"),
    ("forces", r"(.*[._])heat(_mean)?_W", r"\1power_loss\2_W"),
    ("forces", r"(shafts\.|.*\.shaft_\d+_)bending(.*)", r"\1secondary_couple\2"),
    ("forces", r"joints\.bend_(.*)", r"joints.joint_angle_\1"),
    ("motion", r"equivalent_bend_deg", "equivalent_joint_angle_deg"),
    ("motion", r"irregularity", "speed_fluctuation_percent"),
    ("motion", r"joints\.bend_deg", "joints.joint_angle_deg"),
    ("motion", r"joints\.phase_angle_deg", "joints.initial_yoke_position_deg"),
    ("motion", r"max_lead_deg", "angle_error_deg"),
    ("motion", r"orders\.lead_deg", "orders.angle_error_deg"),
    ("motion", r"shafts\.irregularity_percent", "shafts.speed_fluctuation_percent"),
    ("motion", r"shafts\.max_lead_deg", "shafts.angle_error_deg"),
    ("articulation", r"history\.(joint_\d+)_bend_deg", r"history.\1_joint_angle_deg"),
    ("articulation", r"history\.(moving|shaft_\d+)_irregularity", r"history.\1_speed_fluctuation_percent"),
    ("articulation", r"joints\.bend_(min|max)_deg", r"joints.joint_angle_\1_deg"),
    ("joint", r"(joints|kinds)\.steepest_deg", r"\1.max_joint_angle_deg"),
    ("joint", r"bend_deg", "joint_angle_deg"),
    ("joint", r"joints\.bends\.bend_deg", "joints.over_joint_angle.joint_angle_deg"),
    ("joint", r"joints\.bends\.error_deg", "joints.over_joint_angle.angle_error_deg"),
    ("joint", r"joints\.bends\.irregularity", "joints.over_joint_angle.speed_fluctuation_percent"),
    ("joint", r"joints\.error_deg", "joints.angle_error_deg"),
    ("joint", r"joints\.irregularity", "joints.speed_fluctuation_percent"),
    ("joint", r"joints\.turn\.lead_deg", "joints.turn.angle_error_deg"),
    ("phases", r"equivalent_bend_(max|min)_deg", r"equivalent_joint_angle_\1_deg"),
    ("phases", r"irregularity_as_built", "speed_fluctuation_as_specified_percent"),
    ("phases", r"irregularity(_max|_min|)", r"speed_fluctuation\1_percent"),
    ("phases", r"settings\.joint_phase_angle_deg", "settings.initial_yoke_position_deg"),
    ("phases", r"settings\.(shaft_|pose_|)irregularity", r"settings.\1speed_fluctuation_percent"),
    ("phases", r"(joints\.|)bend(_before|)_deg", r"\1joint_angle\2_deg"),
    ("torsion (absorber|calm)", r"(\w+)\.swing_Nm", r"\1.alternating_torque_Nm"),
    ("torsion (absorber|calm)", r"curves\.(\w+)_swing_(\d+)_Nm", r"curves.\1_alternating_torque_\2_Nm"),
    ("torsion absorber", r"curves\.absorber_swing_deg", "curves.absorber_twist_deg"),
    ("torsion absorber", r"curves\.absorber_heat_W", "curves.absorber_power_loss_W"),
    ("torsion absorber", r"largest_heat_W", "largest_power_loss_W"),
    ("torsion (absorber|calm)", r"play_closed", "backlash_closed"),
    ("torsion calm", r"(\w+)\.push_left", r"\1.excitation_left"),
    ("strength", r"shafts\.bending_Nm", "shafts.secondary_couple_Nm"),
    ("strength", r"limits\.ends_at_Nm", "limits.limit_torque_Nm"),
    ("select", r"need\.bend_deg", "need.joint_angle_deg"),
    ("check", r"cures\.(.*)", r"remedies.\1"),
    ("torsion stability", r"over\.bend_deg", "over.joint_angle_deg"),
    ("sweep", r"(.*[._ ])?irregularity(.*)", r"\1speed_fluctuation_percent\2"),
    ("sweep", r"(.*)strength_used <= 1\b(.*)", r"\1strength_used_percent <= 100\2"),
    ("(sweep|catalogue|joint)", r"(.*[._ ])?irregularity(.*)bend(.*)", r"\1speed_fluctuation\2joint_angle\3"),
    ("(sweep|catalogue|joint)", r"(.*[._ ])?irregularity(.*)", r"\1speed_fluctuation\2"),
    ("(sweep|catalogue|joint)", r"(.*[._ ])?bend_(.*)", r"\1joint_angle_\2"),
)
"""Pattern at the start of the old command line, pattern of a whole old path, its new path (with or without unit):
``("life", r"joints\\.iso_h", "joints.rating_life_h")``. The first that fits counts."""

FIELDS: tuple[tuple[str, str], ...] = ()
"""Pattern in a refused field -> what stands there now."""

ANSWERED: tuple[str, ...] = (
    r"(forces|assembly) examples/truck-duty-cycle",
    r"torsion stability examples/pto-flywheel\.toml --speeds 300:1500:6",
    r"tolerance examples/overconstrained-pump\.toml",
    r"(forces|losses|assembly|accuracy|tolerance|articulation) "
    r"examples/(front-halfshaft|propshaft-with-rzeppa|double-cardan-propshaft|tracta-steered-axle)\.toml",
    r"(strength|select) examples/front-halfshaft\.toml$",  # its file says a torque
)
"""Command lines, by a pattern of their start, that were refused and are answered now."""

AMONG: tuple[tuple[str, str], ...] = (("simulate-fault", r"orders\.size"),)
"""Pattern of a command line's start, pattern of a whole old path: its numbers stand in another order now, or among
others, or under one name with several units."""
