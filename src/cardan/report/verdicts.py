"""Whether the drive keeps its limits: traffic lights, the changes that help most, then every verdict."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cardan.checks import Verdict, check
from cardan.checks.alike import alike, deciding_limit, title_of
from cardan.errors import InputError
from cardan.figures.check import check_figures
from cardan.figures.wording import fixed, significant
from cardan.synthesis.cure import Cure, cures, most_helpful
from cardan.synthesis.lever import key_of
from cardan.texts import _, plural
from cardan.units import factor, label

from .balance import refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Tone, Words, number, verdict_columns, words
from .subject import Subject

LIGHTS = 10
"""Verdicts on the first page; more only where more than these fail or are close."""

CURES = 4
"""Cures shown for each failed verdict."""

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
    blocks: list[Block] = [
        *(Picture(figure=figure) for figure in check_figures(verdicts, name=on.drive.name)),
        _table(binding, _("Verdicts"), sources=True),
    ]
    if found:
        blocks.append(_cures(found, _("What cures it: the smallest change of one key")))
    if advice:
        blocks.append(_table(advice, _("Advice: rules of thumb, they fail no drive"), sources=True))
    lacking = [one for one in verdicts if one.missing]
    if lacking:
        blocks.append(_lacking(lacking))
    unfit = [f"{one.title}: {one.unfit}" for one in verdicts if one.unfit]
    if unfit:
        blocks.append(Points(title=_("Not judged for joints of these kinds"), items=unfit))
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
        changes=_cures(most_helpful(found), _("Changes that help most")) if found else None,
    )


def _worst(one: Verdict) -> float:
    return -float(one.utilisation)


def _sentence(binding: Sequence[Verdict]) -> str:
    failed = [one for one in binding if one.state == "failed"]
    used = fixed(float(binding[0].utilisation))
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
    urgent = [one for one in binding if one.state != "passed"]
    shown = [*urgent, *(one for one in binding if one.state == "passed")][: max(LIGHTS, len(urgent))]
    left = len(binding) - len(shown)
    note = plural("One more limit is kept.", "{count} more limits are kept.", left).format(count=left) if left else ""
    return _table(shown, _("Limits"), note=note)


def _table(verdicts: Sequence[Verdict], title: str, *, note: str = "", sources: bool = False) -> Table:
    rows = []
    for group in alike(verdicts):
        one = group[0]
        sense, limit = deciding_limit(one)
        tone = "warning" if one.advice and one.state == "failed" else TONES[one.state]
        said = {"good": _("passed"), "warning": _("close"), "failed": _("failed")}[tone]
        row = [
            words(title_of(group)),
            _figure(one, float(one.value)),
            words(label(one.unit)),
            _figure(one, limit, sense),
            number(fixed(float(one.utilisation)), float(one.utilisation)),
            words(_("beyond") if one.advice and one.state == "failed" else said, tone),
        ]
        rows.append([*row, words("; ".join(part for part in (one.source, one.note) if part))] if sources else row)
    by = (Column(heading=_("by"), left=True),) if sources else ()
    return Table(columns=(*verdict_columns(), *by), rows=rows, title=title, note=note)


def _figure(one: Verdict, value: float, sense: str = "") -> Cell:
    """Return a figure in the unit of its verdict, behind its sense where it is a limit."""
    shown = value / (factor(one.dimension, one.unit) if one.dimension else 1.0)
    if shown == float("inf"):
        return Cell(text=f"{sense} ∞".strip())
    text = "0" if abs(shown) < 1e-9 else significant(shown)
    return number(f"{sense} {text}".strip(), shown)


def _cures(found: Sequence[Cure], title: str) -> Table:
    rows = []
    told: dict[str, int] = {}
    for one in found:
        told[one.title] = told.get(one.title, 0) + 1
        if told[one.title] > CURES:
            continue
        others = len([other for other in one.solves if other != one.title])
        effect = one.title
        if others:
            effect = plural("{title} and {count} other", "{title} and {count} others", others).format(
                title=one.title, count=others
            )
        rows.append(
            [
                words(one.path),
                _value(one.now),
                _value(one.value),
                words(effect + (f" ({one.note})" if one.note else "")),
                words(", ".join(one.breaks), "warning" if one.breaks else "plain"),
            ]
        )
    return Table(
        columns=(
            Column(heading=_("key"), left=True),
            Column(heading=_("now")),
            Column(heading=_("to")),
            Column(heading=_("then passes"), left=True),
            Column(heading=_("then fails"), left=True),
        ),
        rows=rows,
        title=title,
    )


def _value(value: float | int | str) -> Cell:
    return words(value) if isinstance(value, str) else number(f"{value:.10g}", value)


def _lacking(verdicts: Sequence[Verdict]) -> Table:
    rows = [[words(one.title), words(", ".join(key_of(path) for path in one.missing))] for one in verdicts]
    return Table(
        columns=(Column(heading=_("what"), left=True), Column(heading=_("key to add"), left=True)),
        rows=rows,
        title=_("Could not be judged"),
    )
