"""Verdicts that say the same of several joints or shafts, put together for a reader."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np

from cardan.texts import _

from .verdict import Verdict


def alike(verdicts: Iterable[Verdict]) -> list[tuple[Verdict, ...]]:
    """Return verdicts in groups: of one check, with limits used alike to a percent, differing in joint or shaft alone.

    Parameters
    ----------
    verdicts : iterable of Verdict
        Single ones that were reached.
    """
    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts:
        kind = re.sub(r"\d+", "#", one.title) if one.subject else one.title
        used = f"{float(np.max(one.utilisation)):.2f}"
        groups.setdefault((one.check, kind, used, one.state), []).append(one)
    return [tuple(sorted(group, key=lambda one: one.subject)) for group in groups.values()]


def title_of(group: Sequence[Verdict]) -> str:
    """Return what a group of verdicts is about.

    Examples
    --------
    >>> one, two = (Verdict(check="bend", title=f"bend of joint {k}", subject=f"joints[{k - 1}]") for k in (1, 2))
    >>> title_of([one, two])
    'bend of joint 1 (and 2)'
    """
    numbers = [int(found[1]) + 1 for one in group[1:] if (found := re.search(r"\[(\d+)\]", one.subject))]
    if not numbers:
        return group[0].title
    return _("{title} (and {numbers})").format(title=group[0].title, numbers=", ".join(map(str, numbers)))


def deciding_limit(one: Verdict) -> tuple[str, float]:
    """Return the sense and the limit, in SI, that a reader compares the value with; of a band the nearer end.

    Examples
    --------
    >>> deciding_limit(Verdict(check="", title="", value=3.0, limit=(1.0, 2.0), sense="outside"))
    ('≥', 2.0)
    """
    if not isinstance(one.limit, tuple):
        return ("≤" if one.sense == "at_most" else "≥"), float(one.limit)
    low, high = (float(end) for end in one.limit)
    above = float(one.value) ** 2 >= low * high
    if one.sense == "outside":
        return ("≥", high) if above else ("≤", low)
    return ("≤", high) if above else ("≥", low)
