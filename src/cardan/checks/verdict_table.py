"""Verdicts side by side, once for terminal, report, files and app: in words, as records, as key figures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.answer import Cell, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, Unit, Written, say
from cardan.answers.question import Lacking, all_of
from cardan.drive.fields.keys import key_of
from cardan.drive.fields.wording import written
from cardan.texts import _, plural
from cardan.units import factor

from .verdict import State, Verdict

TONES: dict[State, Tone] = {
    "passed": "good",
    "unconfirmed": "warning",
    "close": "warning",
    "failed": "failed",
    "not_run": "plain",
}

CONDITIONS = frozenset(("acceleration", "speed_fluctuation", "joint_angle", "plunge", "spline_overlap"))
"""Checks whose note says at which speed, in which pose or when the value is reached: it belongs to what is judged."""

MOST = 1000.0
"""A limit that is exceeded more often is told as exceeded beyond that."""

BY = "by"
"""Name of the column of a table of verdicts that says where limits come from."""

NOTHING = 1e-9
"""A value up to this, in its unit, is told as nothing."""


def tone_of(one: Verdict) -> Tone:
    """Return how good a verdict is; red is kept for limits that must be kept."""
    return "warning" if one.advice and one.state == "failed" else TONES[one.state]


def word_of(one: Verdict) -> str:
    """Return a verdict in a word."""
    if one.advice and one.state == "failed":
        return _("beyond")
    unsure = not one.sure and not one.advice
    return {
        "passed": _("passed"),
        "unconfirmed": _("met, unconfirmed limit") if one.advice else _("met, unconfirmed rating"),
        "close": _("close, unconfirmed rating") if unsure else _("close"),
        "failed": _("failed, unconfirmed rating") if unsure else _("failed"),
        "not_run": _("not run"),
    }[one.state]


def amount(one: Verdict, value: Any, *, given: bool = False) -> Quantity:
    """Return a figure of a verdict; a limit as it was given, without zeros at its end."""
    least = NOTHING * (factor(one.dimension, one.unit) if one.dimension else 1.0)
    return Quantity(0.0 if abs(float(value)) <= least else float(value), one.dimension, unit=one.unit, trim=given)


def share(used: float) -> Quantity:
    """Return a utilisation for a sentence, in percent.

    >>> from cardan.answers.reader import USUAL
    >>> share(1.357).told(USUAL), share(0.2838).told(USUAL), share(float("inf")).told(USUAL)
    ('136 %', '28.4 %', '> 100\u202f000 %')
    """
    return Quantity(used, "share", 3, most=MOST)


def limit(one: Verdict) -> Cell | Text:
    """Return the limit of a verdict with its sense; of a band the nearer end, or both where it must be left."""
    ends = deciding_limits(one)
    if len(ends) == 2:
        (_at_most, low), (_at_least, high) = ends
        return say(_("≤ {low:bare} or ≥ {high}"), low=amount(one, low, given=True), high=amount(one, high, given=True))
    sense, end = ends[0]
    return Cell(value=amount(one, end, given=True), before=f"{sense} ")


def said_of(group: Sequence[Verdict], *, sources: bool = False) -> Text:
    """Return what a group of verdicts is about, with its note where that matters, or with all that stands behind it."""
    one = group[0]
    if sources:
        return Joined([title_of(group), one.note, one.source, *one.provenance], between="; ")
    if one.check in CONDITIONS:
        return Joined([title_of(group), one.note])
    return Joined([title_of(group), "" if one.met else one.note], between="; ")


def verdict_table(
    verdicts: Sequence[Verdict], title: str = "", *, sources: bool = False, torque: float | None = None
) -> Table:
    """Return verdicts as people read them, those that say the same of several parts in one row.

    verdicts: single ones that were reached.
    sources: say in a brief table, too, where each comes from; a full one has a column for it.
    torque: torque of the duty [N·m]: with it, at which torque each limit is reached.
    """
    groups = alike(verdicts)
    first = [group[0] for group in groups]
    ends = () if torque is None else (_limit_torque(first, torque),)
    return Table(
        title=title,
        columns=(
            Column(
                key="",
                heading=_("verdict"),
                values=[Cell(value=word_of(one), tone=tone_of(one)) for one in first],
                left=True,
            ),
            Column(
                key="",
                heading=_("utilisation"),
                values=[float(one.utilisation) for one in first],
                decimals=2,
                most=MOST,
            ),
            Column(
                key="", heading=_("value"), values=[Cell(value=amount(one, one.value), unit=False) for one in first]
            ),
            Column(key="", heading=_("limit"), values=[limit(one) for one in first], left=True),
            *ends,
            Column(
                key="",
                heading=_("what"),
                values=[said_of(group, sources=sources) for group in groups],
                wrap=True,
                left=True,
            ),
            Column(
                key=BY,
                heading=_("by"),
                values=[Joined([one.source, *one.provenance, _unsaid(one)], between="; ") for one in first],
                left=True,
                depth="data" if sources else "full",
            ),
        ),
    )


def unconfirmed_remark(verdicts: Sequence[Verdict]) -> Iterator[Remark]:
    """Yield on which rows of the catalogue verdicts rest that nothing confirms."""
    loose = [one for one in verdicts if not one.sure and not one.advice]
    if loose:
        text = plural(
            "One verdict is met or failed by an unconfirmed rating: {rows}; give the maker's or the standard's own.",
            "{count} verdicts are met or failed by unconfirmed ratings: {rows}; give the maker's or the standard's "
            "own.",
            len(loose),
        )
        rows = dict.fromkeys(part for one in loose for part in one.provenance)
        yield Remark(text=say(text, count=len(loose), rows=", ".join(rows)), tone="warning")


def verdict_key(group: Sequence[Verdict]) -> KeyFigure:
    """Return verdicts that say the same of several parts as a figure with its limit."""
    one, ends = group[0], deciding_limits(group[0])
    sense, end = ends[0]
    return KeyFigure(
        name=f"{one.check} {one.subject}",
        title=title_of(group),
        place=one.note if one.check in CONDITIONS else "",
        value=amount(one, one.value),
        limit=amount(one, end, given=True),
        beyond=amount(one, ends[1][1], given=True) if len(ends) == 2 else None,
        better="less" if sense == "≤" else "more",
        verdict=word_of(one),
        tone=tone_of(one),
        used=float(one.utilisation),
    )


def verdict_records(
    verdicts: Sequence[Verdict], name: str, *, torque: float | None = None, flat: bool = False
) -> Table:
    """Return verdicts for programs, one a row: value and limit in the unit that stands beside them.

    verdicts: single ones; name: of the table in JSON.
    torque: torque of the duty [N·m]: with it, at which torque each limit is reached.
    flat: rows of CSV: both ends of a band in columns of their own, lists of keys with blanks between them.
    """
    ends = [_ends(one) for one in verdicts]
    keys = [[key_of(path) for path in one.missing] for one in verdicts]
    design_variables = [[key_of(path) for path in one.design_variables] for one in verdicts]
    told: dict[str, Any] = {
        "check": [one.check for one in verdicts],
        "subject": [one.subject for one in verdicts],
        "title": [one.title for one in verdicts],
        "state": [one.state for one in verdicts],
        "advice": [one.advice for one in verdicts],
        "value": [_number(one, one.value) for one in verdicts],
        "sense": [one.sense for one in verdicts],
    }
    if flat:
        told |= {"limit": [low for low, _high in ends], "limit_high": [high for _low, high in ends]}
    else:
        told["limit"] = [low if high is None else [low, high] for low, high in ends]
    told |= {
        "unit": [Unit(one.dimension, one.unit) if one.dimension else "" for one in verdicts],
        "utilisation": [float(one.utilisation) if one.run else None for one in verdicts],
    }
    columns = [Column(key=key, values=values, depth="data") for key, values in told.items()]
    if torque is not None:
        columns.append(replace(_limit_torque(verdicts, torque), key="limit_torque", depth="data"))
    last: dict[str, Any] = {
        "source": [one.source for one in verdicts],
        "confidence": [one.confidence for one in verdicts],
        "provenance": ["; ".join(one.provenance) if flat else list(one.provenance) for one in verdicts],
    }
    last |= (
        {"missing": [" ".join(one) for one in keys]}
        if flat
        else {"design_variables": design_variables, "missing": keys}
    )
    last |= {"unfit": [one.unfit for one in verdicts], "note": [one.note for one in verdicts]}
    columns += [Column(key=key, values=values, depth="data") for key, values in last.items()]
    return Table(name=name, columns=columns, records=True, depth="data")


MISSING = "missing"  # name of the table of checks not run


def counting() -> Written:
    """Return how keys count parts."""
    return Written(_("Keys count from 0: joints[0] is joint 1, shafts[0] is shaft 1."), "", "")


def missing_table(verdicts: Sequence[Verdict], depth: Any = "full") -> Table:
    """Return what could not be judged for want of which keys, joints and shafts alike in one row."""
    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts:
        if one.missing:
            own = (path.replace(one.subject, "", 1) if one.subject else path for path in one.missing)
            groups.setdefault((one.check, one.kind, *own), []).append(one)
    counted = any("[" in path for one in verdicts for path in one.missing)
    return Table(
        name=MISSING,
        title=_("Checks not run, and the keys they need"),
        columns=(
            Column(
                key="",
                heading=_("key to add"),
                values=[written(*group[0].missing) for group in groups.values()],
                left=True,
                wrap=True,
            ),
            Column(
                key="",
                heading=_("what it tells"),
                values=[title_of(group) for group in groups.values()],
                left=True,
                wrap=True,
            ),
        ),
        note=counting() if counted else "",
        depth=depth,
    )


def least_needs(verdicts: Sequence[Verdict]) -> Lacking:
    """Return what lets something be judged: of each kind of part what that check lacks which lacks least."""
    least: dict[str, tuple[str, ...]] = {}
    for one in verdicts:
        if one.missing:
            part = one.missing[0].partition(".")[0].partition("[")[0]
            if part not in least or len(one.missing) < len(least[part]):
                least[part] = tuple(one.missing)
    return all_of([path for some in least.values() for path in some])


def _unsaid(one: Verdict) -> Text:
    """Return the note of a verdict where it does not stand with what is judged."""
    return one.note if one.met and one.check not in CONDITIONS else ""


def _limit_torque(verdicts: Sequence[Verdict], torque: float) -> Column:
    """Return at which torque each limit is reached."""
    values = [torque * float(one.torque_factor) if one.run else None for one in verdicts]
    return Column(key="", heading=_("limit torque"), values=values, dimension="torque", most=1e7 * torque)


def _number(one: Verdict, value: Any) -> Quantity | None:
    return Quantity(float(value), one.dimension, unit=one.unit) if one.run else None


def _ends(one: Verdict) -> tuple[Quantity | None, Quantity | None]:
    if isinstance(one.limit, tuple):
        return _number(one, one.limit[0]), _number(one, one.limit[1])
    return _number(one, one.limit), None


# Verdicts that say the same of several joints or shafts, put together for a reader.


def alike(verdicts: Iterable[Verdict]) -> list[tuple[Verdict, ...]]:
    """Return verdicts in groups: of one check, with limits used alike to a percent, differing in joint or shaft alone.

    Advice that is not followed is told once, however far each is from it. The one that uses most of its limit stands
    first.
    verdicts: single ones that were reached.
    """
    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts:
        used = "" if one.advice and not one.met else f"{float(np.max(one.utilisation)):.2f}"
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


NO_LENGTH = 1e-5
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
        if one.sense == "at_least" and one.dimension == "length" and float(one.limit) < NO_LENGTH:
            return ">", 0.0
        return ("≤" if one.sense == "at_most" else "≥"), float(one.limit)
    low, high = (float(end) for end in one.limit)
    above = float(one.value) ** 2 >= low * high
    if one.sense == "outside":
        return ("≥", high) if above else ("≤", low)
    return ("≤", high) if above else ("≥", low)
