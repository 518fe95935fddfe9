"""How closely a number must be met again, and why not more closely.

Two ways to compare: *exactly*, as a change of the code on one machine must, where all but rounding noise is equal to
1e-12 of the largest number of its column; and as any processor must, whose sums round otherwise.
"""

from __future__ import annotations

EXACT = 1e-12
"""Relative to the largest magnitude of a column, on the machine that captured."""

ANYWHERE = 1e-9
"""The same on any processor."""

NOISE = {True: 1e-12, False: 1e-9}
"""Exactly or not -> numbers below this share of the largest of their dimension in the answer, or of `ORDINARY`, are
noise of rounding: all are alike."""

ORDINARY = {"length": 1e-2, "mass": 1e-2, "inertia": 1e-3, "unbalance": 1e-5, "stress": 1e6, "time": 1e-2}
"""Dimension -> a magnitude in SI that matters in drives; 1 for all others and for what has no dimension."""

CLASS = float("inf")
"""Only what kind of a number it is (finite, infinite, none) counts."""

RESIDUAL = 1e-6

RESIDUALS: tuple[tuple[str, str], ...] = ()
"""Command, path: checks of the program on itself, which tell rounding; below `RESIDUAL` all are alike, even where all
else is compared exactly."""

LOOSER: tuple[tuple[str, str, float, str], ...] = ()
"""Command, path, tolerance on any processor, reason."""
