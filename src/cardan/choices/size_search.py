"""The smallest size at which checks pass: many sizes judged at once, the range narrowed down to the last digits."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from cardan.catalogue import Catalogue
from cardan.checks import Verdict, check
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import with_values
from cardan.errors import InputError, Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost_of
from cardan.texts import _

from .preferred import SLACK, round_up
from .sized import CHECKS, STEPS, Sizing, used

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

    def worst_of(factor: Array) -> Array:
        vary = {name: value * factor for name, value in free.items()}
        with np.errstate(all="ignore"):
            verdicts = _of(check(base, only=names, vary=vary, known=rows), subject)
        worst = np.max([np.broadcast_to(np.asarray(one.utilisation, dtype=float), factor.shape) for one in verdicts], 0)
        return np.where(np.isnan(worst), math.inf, worst)

    factor = smallest(worst_of, *_range(most))
    if factor is None:
        worst = foremost_of(counted, used)
        text = _("no size passes; {title} is never within its limit")
        raise refuse(spelled(subject), text.format(title=worst.title), "out_of_range")

    def alone(factor: float) -> float:
        sized = with_values(base, {name: value * factor for name, value in free.items()})
        return max(used(one) for one in _of(check(sized, only=names, known=rows), subject))

    factor = settled(alone, factor)
    exact = {name: value * factor for name, value in free.items()}
    values = {name: _made(name, one, series) for name, one in exact.items()}
    for _try in range(20):  # a thicker wall can cost what a thicker tube gains
        whole = with_values(base, values)
        made = _of(check(whole, only=names, known=rows), subject)
        if all(one.utilisation <= 1.0 for one in made):
            break
        values = {
            name: value if _bare(name) == "inner" else _made(name, value + STEPS[_bare(name)], series)
            for name, value in values.items()
        }
    limits = _of(check(with_values(base, exact), only=names, known=rows), subject)
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
    every = [one for one in check(base, only=names, known=rows) if one.subject in ("", subject)]
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
