"""The smallest size at which checks pass: many sizes at once, those that are made, and what stood before."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.catalogue import Catalogue
from cardan.checks import Verdict, as_tried, check
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import with_values
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError, Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.texts import _

REACH = (1e-4, 1e4)
"""Smallest and largest share of the size tried first that are looked at."""

SETTLED = 1e-10
"""Share of its limit by which a part may be off it."""

NEAR = 0.1
"""Logarithm of what judging many sizes at once can be off."""

ROUNDS = 15
"""Steps of the secant at most; four are usual."""

PLACES = 41
"""Sizes looked at in a round."""

AGAIN, NEARLY = 6, 1e-3
"""Times that sizes are looked for with the vibration of the last one found, and the change at which that ends."""

LARGER, TRIED, HALVES = 1.04, 24, 6
"""Step by which sizes grow, how many are tried, and how often the last is halved, where that does not rest."""

FINE = 1e-13
"""Share of a size to which it is found."""


def solved(
    base: Drive,
    kind: str,
    subject: str,
    free: Mapping[str, float],
    before: Mapping[str, float | None],
    series: str,
    rows: Catalogue,
    *,
    need: Sequence[str] = (),
    only: Sequence[str] = (),
    most: float = math.inf,
) -> Sizing:
    """Return a part whose sizes grow together until its checks pass.

    ``most`` limits the factor on them: from above, or from below where it is negative.
    """
    names = tuple(only or CHECKS[kind])
    counted, skipped = _counted(base, names, subject, rows)
    lacking = [name for name in (need or names) if name not in {one.check for one in counted}]
    if lacking:
        fields = skipped or ("duty.torque",)
        raise InputError(Problem(path, _("missing; the size depends on it"), "missing") for path in fields)

    near = base

    def worst_of(factor: Array) -> Array:
        vary = {name: value * factor for name, value in free.items()}
        with np.errstate(all="ignore"):
            verdicts = _of(check(near, only=names, vary=vary, known=rows), subject)
        worst = np.max([np.broadcast_to(np.asarray(one.utilisation, dtype=float), factor.shape) for one in verdicts], 0)
        return np.where(np.isnan(worst), math.inf, worst)

    factor = smallest(worst_of, *_range(most))
    if factor is None:
        worst = foremost_of(counted, used)
        text = _("no size passes; {title} is never within its limit")
        raise refuse(spelled(subject), text.format(title=worst.title), "out_of_range")

    def alone(factor: float) -> float:
        sized = with_values(base, {name: value * factor for name, value in free.items()})
        return max(used(one) for one in _of(as_tried(sized, names, known=rows), subject))

    for _round in range(AGAIN if has_torsion(base) else 0):  # many sizes at once vibrate like one of them: the last
        near = with_values(base, {name: value * factor for name, value in free.items()})
        again = smallest(worst_of, *_range(most))
        if again is None or abs(again / factor - 1.0) < NEARLY:
            break
        factor = again
    if has_torsion(base) and alone(factor) > 1.0 + NEARLY:
        factor = _larger(alone, factor, _range(most)[1], subject)
    factor = settled(alone, factor)
    exact = {name: value * factor for name, value in free.items()}
    values = {name: _made(name, one, series) for name, one in exact.items()}
    for _try in range(20):  # a thicker wall can cost what a thicker tube gains
        whole = with_values(base, values)
        made = _of(as_tried(whole, names, known=rows), subject)
        if all(one.utilisation <= 1.0 for one in made):
            break
        values = {
            name: value if _bare(name) == "inner" else _made(name, value + STEPS[_bare(name)], series)
            for name, value in values.items()
        }
    limits = _of(as_tried(with_values(base, exact), names, known=rows), subject)
    return Sizing(
        part=kind,
        subject=subject,
        exact=exact,
        values=values,
        before=before,
        limits=limits,
        made=made,
        drive=whole,
        skipped=skipped,
        series=series,
    )


def _larger(alone: Callable[[float], float], factor: float, most: float, subject: str) -> float:
    """Return the first of ever larger factors at which a part passes that vibrates differently at every size."""
    for k in range(1, TRIED + 1):
        larger = factor * LARGER**k
        if larger <= most and alone(larger) <= 1.0:
            return _closer(alone, larger / LARGER, larger)
    text = _("no size near passes: with every one the drive vibrates in torsion too strongly")
    raise refuse(spelled(subject), text, "out_of_range")


def _closer(alone: Callable[[float], float], low: float, high: float) -> float:
    """Return a factor that passes, close to where a part is at its limit: between one that fails and one that does."""
    for _half in range(HALVES):
        if alone(high) >= math.exp(-NEAR):
            break
        middle = math.sqrt(low * high)
        low, high = (low, middle) if alone(middle) <= 1.0 else (middle, high)
    return high


def smallest(utilisation: Callable[[Array], Array], low: float, high: float) -> float | None:
    """Return the smallest factor at which a utilisation is at most 1, None where there is none.

    utilisation: from factors (m,) to the utilisation there (m,); low, high: where to look.

    >>> print(f"{smallest(lambda x: 8.0 / x**3, 0.1, 100.0):.12f}")
    2.000000000000
    """
    places = np.geomspace(low, high, 4 * PLACES)
    for _round in range(40):
        fine = np.asarray(utilisation(places)) <= 1.0
        if not np.any(fine):
            return None
        first = int(np.argmax(fine))
        if first == 0:
            return float(places[0])
        low, high = float(places[first - 1]), float(places[first])
        if high - low <= FINE * high:
            return high
        places = np.linspace(low, high, PLACES)
        if not np.all(np.diff(places) > 0.0):
            return high
    return high


def settled(utilisation: Callable[[float], float], factor: float) -> float:
    """Return a factor near a given one at which a utilisation is 1 or just below.

    Checks of many sizes at once take the critical speed of a line to go with that of its shaft; one by one they know
    it. The difference is small, and a few steps of the secant settle it.
    utilisation: from a factor to the utilisation there.

    >>> print(f"{settled(lambda x: 4.0 / x**2, 1.97):.10f}")
    2.0000000000
    """
    place, size = math.log(factor), math.log(utilisation(factor))
    if abs(size) <= SETTLED or abs(size) > NEAR:  # held by its room, not by a check
        return factor
    before, old = place, size
    place += 0.5 * size
    for _step in range(ROUNDS):
        size = math.log(utilisation(math.exp(place)))
        if abs(size) <= 0.01 * SETTLED or size == old:
            break
        before, old, place = place, size, place - size * (place - before) / (size - old)
    return math.exp(place) * (1.0 + 0.01 * SETTLED)


def _range(most: float) -> tuple[float, float]:
    low, high = REACH
    if math.isinf(most):
        return low, high
    if most < 0.0:
        return max(low, -most * (1.0 + 1e-9)), high
    return low, most


def _counted(
    base: Drive, names: Sequence[str], subject: str, rows: Catalogue
) -> tuple[tuple[Verdict, ...], tuple[str, ...]]:
    """Return the verdicts that count for a size, and the paths for want of which others do not."""
    every = [one for one in as_tried(base, names, known=rows) if one.subject in ("", subject)]
    skipped = tuple(dict.fromkeys(path for one in every for path in one.missing))
    return tuple(one for one in every if one.run and not one.advice), skipped


def _of(verdicts: Sequence[Verdict], subject: str) -> tuple[Verdict, ...]:
    return tuple(one for one in verdicts if one.subject in ("", subject) and one.run and not one.advice)


def _made(path: str, value: float, series: str) -> float:
    """Return a size as it is made: rounded up, bores down."""
    step = STEPS[_bare(path)]
    if _bare(path) == "inner":
        return step * math.floor(value / step * (1.0 + SLACK))
    return round_up(value, step=step, series=series)


def _bare(path: str) -> str:
    """Return the name of the key of a path without its unit."""
    return path.rpartition(".")[2].rpartition("_")[0]


# Sizes that are made: preferred numbers, and steps of a drawing.

R20 = (1.0, 1.12, 1.25, 1.4, 1.6, 1.8, 2.0, 2.24, 2.5, 2.8, 3.15, 3.55, 4.0, 4.5, 5.0, 5.6, 6.3, 7.1, 8.0, 9.0)
"""Preferred numbers of ISO 3, series R20."""

SERIES = ("step", "R20", "R10", "R40")
"""What sizes can be rounded up to: steps of a drawing, or preferred numbers."""

SLACK = 1e-9
"""A size may be above a preferred one by this share: what is left of rounding."""

R40 = tuple(
    sorted(
        {
            *R20,
            1.06,
            1.18,
            1.32,
            1.5,
            1.7,
            1.9,
            2.12,
            2.36,
            2.65,
            3.0,
            3.35,
            3.75,
            4.25,
            4.75,
            5.3,
            6.0,
            6.7,
            7.5,
            8.5,
            9.5,
        }
    )
)

ROWS = {"R10": R20[::2], "R20": R20, "R40": R40}


def round_up(value: float, *, step: float, series: str = "step") -> float:
    """Return the smallest size that is made and no smaller than a value.

    value: above zero; step: step of the drawing, in the unit of the value; series: one of `SERIES`.
    """
    if series not in SERIES:
        names = ", ".join(SERIES)
        raise refuse("series", _("{value} is none of {choices}").format(value=repr(series), choices=names))
    if series == "step":
        digits = max(0, 3 - math.floor(math.log10(step)))
        return round(step * math.ceil(value / step * (1.0 - SLACK)), digits)
    decade = 10.0 ** math.floor(math.log10(value))
    row = (*ROWS[series], 10.0)
    return float(f"{decade * next(one for one in row if one * decade * (1.0 + SLACK) >= value):.6g}")


# What a part was sized to, by which checks, and what stood before.

Hold: TypeAlias = Literal["ratio", "wall", "outer"]

HOLDS: tuple[Hold, ...] = ("ratio", "wall", "outer")
"""What a tube keeps while it is sized: its wall over its outer diameter, its wall, its outer diameter."""

PARTS = ("tube", "shaft", "journal", "needles", "joint")
"""What can be sized."""

CHECKS = {
    "tube": (
        "tube_strength",
        "tube_fatigue",
        "shaft_life",
        "start_fatigue",
        "tube_buckling",
        "twist",
        "critical_speed",
    ),
    "shaft": ("tube_strength", "tube_fatigue", "shaft_life", "start_fatigue", "twist", "critical_speed"),
    "journal": ("journal_strength",),
    "needles": ("bearing_life", "needle_static"),
    "joint": (
        "joint_angle",
        "joint_torque",
        "rated_torque",
        "max_speed",
        "speed_angle",
        "rim_speed",
        "journal_strength",
        "yoke_strength",
        "needle_static",
        "bearing_life",
    ),
}
"""Part -> checks that its size must pass."""

STEPS = {
    "outer": 1.0,
    "inner": 1.0,
    "wall": 0.1,
    "ply_thickness": 0.01,
    "journal": 0.5,
    "capacity": 100.0,
    "static_capacity": 100.0,
}
"""Steps of a drawing, by the key that is sized, in its unit: mm and N."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tried:
    """A size of the catalogue and what the checks say of it."""

    id: str
    outer: float  # outer, mass [m, kg]: nan where the catalogue does not say
    mass: float  # [kg]
    utilisation: float  # largest of the checks that could be judged; nan where none could
    passed: bool
    unknown: str = ""  # "torque" or "life" where nothing in the catalogue lets a check judge it
    worst: Verdict | None = None  # the check with the largest utilisation
    missing: tuple[str, ...] = ()  # paths for want of which some checks could not be judged


@dataclass(frozen=True, eq=False, kw_only=True)
class Sizing:
    """The smallest size of a part that passes.

    Attributes
    ----------
    part, subject : str
        What was sized, as ``tube`` and ``shafts[1]``; the subject is empty for all joints alike.
    exact : mapping of str to float
        Paths with units -> the values at which the part is just at its limit.
    values : mapping of str to float, str or None
        The same as they are made, rounded up; the row of the catalogue of a joint; None where a key is to be left out.
    before : mapping of str to float or None
        What the drive says now.
    limits : tuple of Verdict
        Of the checks that count, at the exact size; at the chosen one for a joint.
    made : tuple of Verdict
        The same for the part as it is made.
    drive : Drive
        With the part as it is made.
    tried : tuple of Tried
        Sizes of the catalogue, the smallest first.
    skipped : tuple of str
        Paths for want of which some checks do not count.
    series : str
        What the sizes were rounded up to.
    """

    part: str
    subject: str
    exact: Mapping[str, float]
    values: Mapping[str, float | str | None]
    before: Mapping[str, float | str | None]
    limits: tuple[Verdict, ...]
    made: tuple[Verdict, ...]
    drive: Drive
    tried: tuple[Tried, ...] = ()
    skipped: tuple[str, ...] = ()
    series: str = "step"

    @property
    def governing(self) -> Verdict | None:
        """The check that decides the size."""
        return foremost_of(self.limits, used) if self.limits else None

    @property
    def found(self) -> bool:
        """Whether any size passes."""
        return bool(self.values)


def used(verdict: Verdict) -> float:
    """Return the largest utilisation of a verdict."""
    return float(np.max(verdict.utilisation))
