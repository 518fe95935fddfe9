"""Whether the drive keeps its limits: traffic lights, the changes that help most, then every verdict."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from cardan.checks import Verdict, check
from cardan.checks.alike import alike, deciding_limits, title_of
from cardan.checks.figure import check_figures
from cardan.choices.change import typed
from cardan.choices.cure import Cure, cures, most_helpful
from cardan.choices.lever import key_of
from cardan.errors import InputError
from cardan.figures.wording import fixed, given, significant
from cardan.texts import _, plural
from cardan.units import factor, label

from .balance import refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Tone, Words, number, verdict_columns, words
from .named import in_words
from .subject import Subject

LIGHTS = 10
"""Rows of verdicts on the first page; more only where more than these fail or are close."""

CURES = 4
"""Cures shown for each failed verdict."""

CONDITIONS = frozenset(("acceleration", "irregularity", "bend", "spline_overlap"))
"""Checks whose note says at which speed, in which pose or when the value is reached: it belongs to what is judged."""

NEAR = 1.1
"""A change this much larger is as good as the smaller one where it makes more verdicts pass."""

TONES: dict[str, Tone] = {"passed": "good", "close": "warning", "failed": "failed"}


@dataclass(frozen=True, eq=False, kw_only=True)
class Judged:
    """Verdicts on a drive and what of them stands where in the report.

    Attributes
    ----------
    page : Page or None
        All of them; None where nothing was judged.
    lights : Table or None
        Those that matter most, for the first page.
    changes : Table or None
        The changes that help most, for the first page; None where nothing fails.
    """

    page: Page | None = None
    lights: Table | None = None
    changes: Table | None = None


def judged(on: Subject) -> Judged:
    """Return the verdicts on a drive."""
    title = _("Limits")
    try:
        verdicts = check(on.drive, known=on.known)
        found = cures(on.drive, verdicts, known=on.known)
    except InputError as error:
        return Judged(page=refused("limits", title, error))
    binding = sorted((one for one in verdicts if one.run and not one.advice), key=_worst)
    if not binding:
        return Judged()
    advice = sorted((one for one in verdicts if one.run and one.advice), key=_worst)
    answer = _sentence(binding)
    cured = {one.title for one in found}
    uncured = [one.title for one in binding if one.state == "failed" and one.title not in cured]
    blocks: list[Block] = [
        *(Picture(figure=figure) for figure in check_figures(verdicts, name=on.drive.name)),
        _table(binding, _("Verdicts"), sources=True),
    ]
    if found:
        blocks.append(_cures(found, _("What cures it: the smallest change of one key"), uncured))
    elif uncured:
        blocks.append(Words(text=_uncured(uncured), tone="warning"))
    if advice:
        blocks.append(_table(advice, _("Advice: rules of thumb, they fail no drive"), sources=True))
    lacking = [one for one in verdicts if one.missing]
    if lacking:
        blocks.append(_lacking(lacking))
    unfit = [one for one in verdicts if one.unfit]
    if unfit:
        blocks.append(Points(title=_("Not judged for joints of these kinds"), items=list(_unfit(unfit))))
    failed = [one for one in binding if one.state == "failed"]
    return Judged(
        page=Page(
            name="limits",
            title=title,
            answer=answer,
            blocks=blocks,
            alarms=[Words(text=answer, tone="failed")] if failed else [],
        ),
        lights=_lights(binding),
        changes=_cures(most_helpful(found), _("Changes that help most"), uncured) if found else None,
    )


def _worst(one: Verdict) -> float:
    return -float(one.utilisation)


def _sentence(binding: Sequence[Verdict]) -> str:
    failed = [one for one in binding if one.state == "failed"]
    used = fixed(float(binding[0].utilisation))
    used = "< 0.01" if float(binding[0].utilisation) < 0.005 else used
    if failed and len(binding) == 1:
        text = _("The one limit that could be judged is not kept: {title}, {used} of it.")
        return text.format(title=binding[0].title, used=used)
    if failed:
        text = plural(
            "{failed} of {count} limits is not kept: {title}, {used} of it.",
            "{failed} of {count} limits are not kept, worst {title}, {used} of it.",
            len(failed),
        )
        return text.format(failed=len(failed), count=len(binding), title=binding[0].title, used=used)
    text = plural(
        "The one limit that could be judged is kept: {title}, {used} of it.",
        "All {count} limits that could be judged are kept; nearest is {title}, {used} of it.",
        len(binding),
    )
    return text.format(count=len(binding), title=binding[0].title, used=used)


def _lights(binding: Sequence[Verdict]) -> Table:
    groups = alike(binding)
    urgent = [group for group in groups if group[0].state != "passed"]
    shown = [*urgent, *(group for group in groups if group[0].state == "passed")][: max(LIGHTS, len(urgent))]
    left = len(binding) - sum(map(len, shown))
    note = plural("One more limit is kept.", "{count} more limits are kept.", left).format(count=left) if left else ""
    return _table([one for group in shown for one in group], _("Limits"), note=note)


def _table(verdicts: Sequence[Verdict], title: str, *, note: str = "", sources: bool = False) -> Table:
    rows = []
    for group in alike(verdicts):
        one = group[0]
        ends = deciding_limits(one)
        condition = f", {one.note}" if one.note and one.check in CONDITIONS else ""
        tone = "warning" if one.advice and one.state == "failed" else TONES[one.state]
        said = {"good": _("passed"), "warning": _("close"), "failed": _("failed")}[tone]
        row = [
            words(title_of(group) + condition),
            _figure(one, float(one.value)),
            words(label(one.unit)),
            _figure(one, ends[0][1], ends[0][0]) if len(ends) == 1 else words(_limits(one, ends)),
            number(fixed(float(one.utilisation)), float(one.utilisation)),
            words(_("beyond") if one.advice and one.state == "failed" else said, tone),
        ]
        rows.append(
            [*row, words("; ".join(part for part in (one.source, "" if condition else one.note) if part))]
            if sources
            else row
        )
    by = (Column(heading=_("by"), left=True),) if sources else ()
    return Table(columns=(*verdict_columns(), *by), rows=rows, title=title, note=note)


def _figure(one: Verdict, value: float, sense: str = "") -> Cell:
    """Return a figure in the unit of its verdict, behind its sense where it is a limit."""
    shown = value / (factor(one.dimension, one.unit) if one.dimension else 1.0)
    if shown == float("inf"):
        return Cell(text=f"{sense} ∞".strip())
    text = "0" if abs(shown) < 1e-9 else (given if sense else significant)(shown)
    return number(f"{sense} {text}".strip(), shown)


def _limits(one: Verdict, ends: Sequence[tuple[str, float]]) -> str:
    """Return both ends of a band."""
    return _(" or ").join(_figure(one, limit, sense).text for sense, limit in ends)


def _cures(found: Sequence[Cure], title: str, uncured: Sequence[str]) -> Table:
    rows = []
    told: dict[str, int] = {}
    shown: set[tuple[str, float | int | str]] = set()
    for one in found:
        if (one.path, one.value) in shown or any(_outdone(one, other) for other in found):
            continue
        shown.add((one.path, one.value))
        told[one.title] = told.get(one.title, 0) + 1
        if told[one.title] > CURES:
            continue
        rows.append(
            [
                words(in_words(re.sub(rf"_{one.unit}(?=\[|$)", "", one.path) if one.unit else one.path)),
                _value(one.now, one.unit),
                _value(one.value, one.unit),
                words(_effect(one)),
                words(", ".join(one.breaks), "failed" if one.breaks else "plain"),
                words(one.path),
            ]
        )
    return Table(
        columns=(
            Column(heading=_("change"), left=True),
            Column(heading=_("now")),
            Column(heading=_("to")),
            Column(heading=_("then passes"), left=True),
            Column(heading=_("then fails"), left=True),
            Column(heading=_("key"), left=True),
        ),
        rows=rows,
        title=title,
        note=" ".join(
            [
                *([_from_nought([one.path for one in found])] if found else []),
                *([_uncured(uncured)] if uncured else []),
            ]
        ),
    )


def _outdone(one: Cure, other: Cure) -> bool:
    """Tell whether hardly more of the same change makes more verdicts pass."""
    if one.path != other.path or other.change > NEAR * one.change or len(other.breaks) > len(one.breaks):
        return False
    return {one.title, *one.solves} < {other.title, *other.solves}


def _uncured(titles: Sequence[str]) -> str:
    return " ".join(_("Failed, and no single key cures it: {title}.").format(title=one) for one in titles)


def _effect(one: Cure) -> str:
    """Return what passes with a change: by name where that is short."""
    others = [title for title in one.solves if title != one.title]
    effect = "; ".join((one.title, *others))
    if len(others) > 1:
        effect = plural("{title} and {count} other", "{title} and {count} others", len(others)).format(
            title=one.title, count=len(others)
        )
    return effect + (f" ({one.note})" if one.note else "")


def _value(value: float | int | str, unit: str) -> Cell:
    return words(f"{typed(value)}{'' if label(unit) == '°' else ' '}{label(unit)}".strip())


def _from_nought(paths: Sequence[str]) -> str:
    """Return that keys count from 0, where one of them counts."""
    counted = any("[" in path for path in paths)
    return _("Keys count from 0: joints[0] is joint 1, shafts[0] is shaft 1.") if counted else ""


def _unfit(verdicts: Sequence[Verdict]) -> Iterator[str]:
    """Yield for each reason what was not judged."""
    for why in dict.fromkeys(one.unfit for one in verdicts):
        groups = _numbered([one for one in verdicts if one.unfit == why])
        titles = "; ".join(map(title_of, groups))
        yield _("Not run ({why}): {titles}.").format(why=why, titles=titles)


def _numbered(verdicts: Sequence[Verdict]) -> list[list[Verdict]]:
    """Return verdicts in groups that differ in the number of a joint or shaft alone, their missing keys too."""
    groups: dict[tuple[object, ...], list[Verdict]] = {}
    for one in verdicts:
        kind = re.sub(r"\d+", "#", one.title, count=1) if one.subject else one.title
        missing = tuple(re.sub(r"\[\d+\]", "[#]", path) for path in one.missing)
        groups.setdefault((one.check, kind, missing), []).append(one)
    return list(groups.values())


def _lacking(verdicts: Sequence[Verdict]) -> Table:
    rows = []
    for group in _numbered(verdicts):
        keys = ", ".join(dict.fromkeys(key_of(path) for path in group[0].missing))
        rows.append([words(title_of(group)), words(keys)])
    paths = [path for one in verdicts for path in one.missing]
    return Table(
        columns=(Column(heading=_("what"), left=True), Column(heading=_("key to add"), left=True)),
        rows=rows,
        title=_("Could not be judged"),
        note=_from_nought(paths),
    )
