"""How closely a number must be met again, and why not more closely.

Two ways to compare: *exactly*, as a change of the code on one machine must, where all but rounding noise is equal to
1e-12 of the largest number of its column; and as any processor must, whose sums round otherwise.
"""

from __future__ import annotations

EXACT = 1e-12
"""Relative to the largest magnitude of a column, on the machine that captured."""

ANYWHERE = 1e-9
"""The same on any processor, where differences below `NOISE` do not count either."""

NOISE = {True: 1e-12, False: 1e-9}
"""Exactly or not -> numbers below this share of the largest of their dimension in the answer, or of `ORDINARY`, are
noise of rounding: all are alike."""

ORDINARY = {"length": 1e-2, "mass": 1e-2, "inertia": 1e-3, "unbalance": 1e-5, "stress": 1e6, "time": 1e-2}
"""Dimension -> a magnitude in SI that matters in drives; 1 for all others and for what has no dimension."""

CLASS = float("inf")
"""Only that there are numbers counts."""

RESIDUAL = 1e-6

RESIDUALS: tuple[tuple[str, str], ...] = (
    ("", r"(.*[.])?((power|energy|closure|determinant|max)_)?residual(_J|_at_end)?"),
    ("", r"(.*[.])?(energy_)?imbalance"),
    ("forces", r"(power|force|moment)_left"),
    ("tolerance", r"optimality"),
)
"""Command, path: checks of the program on itself, which tell rounding; below `RESIDUAL` all are alike, even where all
else is compared exactly."""

SEARCHED = "a search that stops within its own tolerance"
FLAT = "where a curve is greatest is found to the root of rounding, for its top is flat"
PLACED = "where a search finds its optimum is known to the root of the tolerance of what is least there"
TWICE = "the same greatest load comes twice a turn, and rounding decides which of the two is told"
REFINED = "points are added where the curve bends, and rounding decides on the last of them"
MANY = "more yokes than evenness needs: rounding decides which of many equally even settings is told"
ALIKE = "alike but for rounding: the first is told now, the captured answer had another"
ITERATED = "iterated until its residual is small, to fewer digits than it has"
STEPPED = "integrated in time with steps that its errors choose"
AROUND_ZERO = "the mean of samples around zero, small beside each of them"

LOOSER: tuple[tuple[str, str, float, str], ...] = (
    ("rotor", r"response[.].*", CLASS, REFINED),
    ("forces|calc joint_reactions", r"(.*[.])?\w*_at_deg", CLASS, TWICE),
    ("articulation examples/pto-hitch.toml", r"worst[.]time_s", CLASS, ALIKE),
    ("articulation", r".*time_s", 1e-6, FLAT),
    ("life examples/car-propshaft.toml", r"governing_joint", CLASS, ALIKE),
    ("phases examples/six-joints.toml --fix", r"settings[.].*", CLASS, MANY),
    ("phases .*--layout", r".*", 1e-4, SEARCHED),
    ("phases|calc synthesis", r".*", 1e-7, SEARCHED),
    ("tolerance .*--allocate|calc tolerance_alloc", r".*", 1e-6, SEARCHED),
    ("calc tolerance_montecarlo|tolerance .*--method samples", r"(.*[.])?mean\w*", 1e-6, AROUND_ZERO),
    ("check", r"cures?[.].*", 1e-6, SEARCHED),
    ("strength .*--size", r".*", 1e-8, SEARCHED),
    ("sweep .*boundary", r".*", 1e-6, SEARCHED),
    ("torsion modes", r"modes[.]nodes_mm", 1e-3, "where a shape that hardly bends passes zero"),
    ("torsion (calm|absorber)", r"evaluations", CLASS, SEARCHED),
    ("torsion absorber", r"(.*[.])?(damping_\w+|\w*power_loss_W)", 1e-3, PLACED),
    ("torsion (calm|absorber)", r".*", 1e-5, SEARCHED),
    ("torsion simulate|calc torsional_simulation", r".*_at_s", 1e-5, FLAT),
    ("torsion simulate|calc torsional_simulation", r".*", 1e-7, STEPPED),
    ("torsion response|calc periodic_response", r".*", 1e-6, ITERATED),
    ("mobility .*--turn|calc (finite|loop)_mobility", r".*", 1e-7, ITERATED),
)
"""Command, path, tolerance on any processor, reason. The first that fits counts."""
