"""Checks: one file each, a function from drives and their duty to verdicts."""

from .verdict import Verdict, utilisation

__all__ = ["Verdict", "utilisation"]
