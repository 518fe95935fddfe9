"""What is called otherwise now than when ``answers.json.xz`` was captured; all patterns are regular expressions.

Only names stand here, and what follows from an answer's new form: no entry may excuse a number that changed. Units need
none: ``life_h`` is found as ``life_s``. ``python -m tests.golden.check --suggest`` prints entries for `PATHS`.
"""

from __future__ import annotations

COMMAND_LINES: tuple[tuple[str, str], ...] = ()
"""Pattern in a whole command line -> what stands there now: ``(r"^simulate-fault ", "fault ")``."""

PATHS: tuple[tuple[str, str, str], ...] = (
    ("life", r"parts\.bend_deg", "parts.joint_angle_deg"),
    ("strength", r"shafts\.bending_Nm", "shafts.secondary_couple_Nm"),
    ("strength", r"limits\.ends_at_Nm", "limits.limit_torque_Nm"),
    ("check", r"cures\.(.*)", r"remedies.\1"),
)
"""Pattern at the start of the old command line, pattern of a whole old path, its new path (with or without unit):
``("life", r"joints\\.iso_h", "joints.rating_life_h")``. The first that fits counts."""

FIELDS: tuple[tuple[str, str], ...] = ()
"""Pattern in a refused field -> what stands there now."""

ANSWERED: tuple[str, ...] = ()
"""Command lines, by a pattern of their start, that were refused and are answered now."""

AMONG: tuple[tuple[str, str], ...] = ()
"""Pattern of a command line's start, pattern of a whole old path: its numbers stand in another order now, or among
others."""
