"""Checks: one file each, a function from a design to verdicts."""

from .checks import CHECKS, as_tried, check, passes
from .design import Design, design
from .verdict import Verdict, utilisation

__all__ = ["CHECKS", "Design", "Verdict", "as_tried", "check", "design", "passes", "utilisation"]
