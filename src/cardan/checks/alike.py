"""Verdicts that say the same of several joints or shafts, put together for a reader."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from cardan.texts import _

from .verdict import Verdict


def alike(verdicts: Iterable[Verdict]) -> list[tuple[Verdict, ...]]:
    """Return verdicts in groups: of one check, with limits used alike to a percent, differing in joint or shaft alone.

    The one that uses most of its limit stands first.
    verdicts: single ones that were reached.
    """
    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts:
        used = f"{float(np.max(one.utilisation)):.2f}"
        groups.setdefault((one.check, one.kind or one.title, used, one.state), []).append(one)
    return [_worst_first(sorted(group, key=lambda one: one.subject)) for group in groups.values()]


def _worst_first(group: list[Verdict]) -> tuple[Verdict, ...]:
    worst = max(group, key=_used)
    return (worst, *(one for one in group if one is not worst))


def _used(one: Verdict) -> float:
    """Return the share of its limit that is used, to four digits: what differs less reads the same."""
    return float(f"{float(np.max(one.utilisation)):.4g}")


def title_of(group: Sequence[Verdict]) -> str:
    """Return what a group of verdicts is about."""
    numbers = [one.number for one in group[1:] if one.number]
    if not numbers:
        return group[0].title
    return _("{title} (and {numbers})").format(title=group[0].title, numbers=", ".join(map(str, numbers)))


NOTHING = 1e-5
"""A length [m] below which a limit says that something must be left at all."""


def deciding_limits(one: Verdict) -> list[tuple[str, float]]:
    """Return senses and limits, in SI, that a reader compares the value with: both ends of a band it must leave.

    >>> deciding_limits(Verdict(check="", title="", value=1.5, limit=(1.0, 2.0), sense="outside"))
    [('≤', 1.0), ('≥', 2.0)]
    """
    if isinstance(one.limit, tuple) and one.sense == "outside" and one.limit[0] < one.value < one.limit[1]:
        return [("≤", float(one.limit[0])), ("≥", float(one.limit[1]))]
    return [deciding_limit(one)]


def deciding_limit(one: Verdict) -> tuple[str, float]:
    """Return the sense and the limit, in SI, that a reader compares the value with; of a band the nearer end.

    >>> deciding_limit(Verdict(check="", title="", value=3.0, limit=(1.0, 2.0), sense="outside"))
    ('≥', 2.0)
    """
    if not isinstance(one.limit, tuple):
        if one.sense == "at_least" and one.dimension == "length" and float(one.limit) < NOTHING:
            return ">", 0.0
        return ("≤" if one.sense == "at_most" else "≥"), float(one.limit)
    low, high = (float(end) for end in one.limit)
    above = float(one.value) ** 2 >= low * high
    if one.sense == "outside":
        return ("≥", high) if above else ("≤", low)
    return ("≤", high) if above else ("≥", low)
