"""What damps parts whose damping nobody gave: loss factors that are usual, with their sources."""

from __future__ import annotations

from cardan.texts import mark

LOSS = {"shaft": 0.01, "support": 0.1}
"""Loss factor η = 2ζ that a mode counts with where nothing says more: of steel shafts with their joints and splines,
bending or twisting; of a bearing in natural rubber.

Steel by itself loses less than 0.002; joints, splines and bearings bring shaft lines to 0.01 and more, 1 % and more of
critical damping (M. A. Corbo, S. B. Malanoski, Practical Design Against Torsional Vibration, 25th Turbomachinery
Symposium, 1996; recalled, not confirmed). Half a percent of critical damping is below what is measured there. Unfilled
natural rubber has 0.05 to 0.15.
"""

SHAFT_SOURCE = mark("loss factor of steel shaft lines, a low value after Corbo and Malanoski 1996, recalled")
"""Where the loss factor of shafts comes from, in words."""
