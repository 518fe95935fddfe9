"""What ``cardan check`` says: the table of verdicts, what could not be judged, and the cures."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

from .answer import Answer, Column, Remark, Table, Tone, significant

if TYPE_CHECKING:
    from cardan.checks import Verdict
    from cardan.choices.cure import Cure
    from cardan.drive.drive import Drive

    from .answer import Cell

SIGNS = {"passed": "●", "close": "▲", "failed": "✖"}

TONES: dict[str, Tone] = {"passed": "good", "close": "warning", "failed": "failed", "not_run": "plain"}

CURES = 4
"""Cures shown for each failed verdict; ``--json`` has all."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Judged:
    """A drive, its verdicts and their cures."""

    drive: Drive
    file: Path
    verdicts: tuple[Verdict, ...]
    cures: tuple[Cure, ...]
    sources: bool = False

    @property
    def binding(self) -> list[Verdict]:
        """Verdicts that were reached and that the drive must keep, the worst first."""
        return sorted((one for one in self.verdicts if one.run and not one.advice), key=_worst)

    @property
    def advice(self) -> list[Verdict]:
        """Rules of thumb that were reached, the worst first."""
        return sorted((one for one in self.verdicts if one.run and one.advice), key=_worst)

    @property
    def failed(self) -> list[Verdict]:
        """Verdicts that the drive must keep and does not."""
        return [one for one in self.binding if one.state == "failed"]


def _worst(one: Verdict) -> float:
    return -float(one.utilisation)


def answer(judged: Judged) -> Answer:
    """Return what to say of a judged drive."""
    failed = judged.failed
    close = [one for one in judged.binding if one.state == "close"]
    return Answer(
        sentence=sentence(judged),
        tone="failed" if failed else "warning" if close else "good" if judged.binding else "plain",
        tables=lambda: list(_tables(judged)),
        remarks=tuple(_remarks(judged)),
        content=lambda: _content(judged),
        csv=lambda: _rows(judged),
        figure=lambda: _figures(judged),
        code=1 if failed else 0,
    )


def sentence(judged: Judged) -> str:
    """Return the answer in a sentence."""
    from cardan.figures.wording import used

    from .source import title

    name, count, failed = title(judged.drive, judged.file), len(judged.binding), judged.failed
    if not count:
        text = _("{name}: nothing could be judged; the keys that are missing stand below.")
        if judged.advice:
            text = _("{name}: no limit that must be kept was judged; rules of thumb stand below.")
        return text.format(name=name)
    worst = judged.binding[0]
    share = used(float(worst.utilisation))
    if failed and count == 1:
        text = _("{name}: the only check fails: {title}, {used} of its limit.")
        return text.format(name=name, title=worst.title, used=share)
    if failed:
        text = plural(
            "{name}: {failed} of {count} checks fails: {title}, {used} of its limit.",
            "{name}: {failed} of {count} checks fail, worst {title}, {used} of its limit.",
            len(failed),
        )
        return text.format(name=name, failed=len(failed), count=count, title=worst.title, used=share)
    text = plural(
        "{name}: the only check passes: {title}, {used} of its limit.",
        "{name}: all {count} checks pass; nearest to its limit is {title}, {used} of it.",
        count,
    )
    return text.format(name=name, count=count, title=worst.title, used=share)


def listing() -> Answer:
    """Return all checks there are."""
    from cardan.checks import CHECKS

    columns = (Column(key="check", heading=_("check"), left=True), Column(key="judges", left=True, wrap=True))
    table = Table(columns=columns, rows=[[name, _(one.doc)] for name, one in CHECKS.items()])
    return Answer(
        sentence=_("{count} checks; each runs where the drive file says enough.").format(count=len(CHECKS)),
        tables=lambda: [table],
        content=lambda: {"checks": [{"name": name, "judges": _(one.doc)} for name, one in CHECKS.items()]},
        csv=lambda: table,
    )


def _tables(judged: Judged) -> Iterator[Table]:
    if judged.binding:
        yield _verdicts(judged.binding, "", sources=judged.sources)
    if judged.cures:
        yield _cures(judged)
    told = [one for one in judged.advice if judged.sources or one.state != "passed"]
    if told:
        yield _verdicts(told, _("Advice: rules of thumb, they fail no drive"), sources=judged.sources)
    lacking = list(_lacking(judged.verdicts))
    if lacking:
        columns = (
            Column(key="missing", heading=_("key to add"), left=True),
            Column(key="check", heading=_("what it tells"), left=True, wrap=True),
        )
        yield Table(columns=columns, rows=lacking, title=_("Could not be judged"))


def _verdicts(verdicts: Sequence[Verdict], title: str, *, sources: bool) -> Table:
    from cardan.checks.alike import alike, title_of

    columns = (
        Column(key="state", heading=_("verdict"), left=True),
        Column(key="utilisation", heading=_("used"), form=".2f"),
        Column(key="value", heading=_("value")),
        Column(key="limit", heading=_("limit"), left=True),
        Column(key="title", heading=_("what"), left=True, wrap=True),
    )
    words = {
        "passed": _("passed"),
        "close": _("close"),
        "failed": _("failed") if title == "" else _("beyond"),
    }
    rows: list[list[Cell]] = []
    groups = alike(verdicts)
    for group in groups:
        one, said = group[0], [title_of(group)]
        if one.note and (one.state != "passed" or sources):
            said.append(one.note)
        if sources:
            said.append(one.source)
        sign = SIGNS["close" if one.advice and one.state == "failed" else one.state]
        state = f"{sign} {words[one.state]}"
        rows.append([state, float(one.utilisation), shown(one, one.value), limit(one), "; ".join(said)])
    return Table(columns=columns, rows=rows, title=title, tones=[_tone(group[0]) for group in groups])


def _tone(one: Verdict) -> Tone:
    """Return the tone of a verdict; red is kept for limits that must be kept."""
    return "warning" if one.advice and one.state == "failed" else TONES[one.state]


def shown(one: Verdict, value: Any, digits: int = 4) -> str:
    """Return a figure of a verdict in the unit that people read it in, without this unit."""
    number = float(value) / unit_factor(one)
    if number == float("inf"):
        return "∞"
    return "0" if abs(number) < 1e-9 else significant(number, digits)


def limit(one: Verdict) -> str:
    """Return the limit of a verdict with its sense and unit; of a band the nearer end."""
    from cardan.checks.alike import deciding_limits
    from cardan.units import label

    ends = (f"{sense} {shown(one, value)}" for sense, value in deciding_limits(one))
    return f"{_(' or ').join(ends)} {label(one.unit)}".strip()


def unit_factor(one: Verdict) -> float:
    """Return how many SI units the unit of a verdict is."""
    from cardan.units import factor

    return factor(one.dimension, one.unit) if one.dimension else 1.0


def _cures(judged: Judged) -> Table:
    columns = (
        Column(key="path", heading=_("key to change"), left=True),
        Column(key="now", heading=_("now")),
        Column(key="value", heading=_("to")),
        Column(key="effect", heading=_("then passes"), left=True, wrap=True),
    )
    rows: list[list[Cell]] = []
    told: set[tuple[str, Any]] = set()
    for verdict in judged.failed:
        mine = [one for one in judged.cures if one.title == verdict.title and (one.path, one.value) not in told]
        own = [one for one in mine if not one.demand][: CURES - 1]
        for one in [*own, *[one for one in mine if one.demand][: CURES - len(own)]]:
            told.add((one.path, one.value))
            rows.append([one.path, figure(one.now), figure(one.value), effect(one)])
    return Table(columns=columns, rows=rows, title=_("What cures it: the smallest change of one key"))


def figure(value: float | int | str) -> str:
    """Return a value of a key as a file has it."""
    from cardan.choices.change import typed

    return typed(value)


def effect(one: Cure) -> str:
    """Return what a change lets pass and makes fail."""
    others = [title for title in one.solves if title != one.title]
    text = one.title
    if others:
        more = plural("{title} and {count} other", "{title} and {count} others", len(others))
        text = more.format(title=one.title, count=len(others))
    if one.note:
        text += f" ({one.note})"
    if one.breaks:
        text += _("; then fails: {titles}").format(titles=", ".join(one.breaks))
    return text


def _lacking(verdicts: Sequence[Verdict]) -> Iterator[list[Cell]]:
    """Yield keys to add, one a row, those that differ only by their number together, and what they tell."""
    from cardan.choices.lever import key_of

    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in verdicts:
        if one.missing:
            groups.setdefault(tuple(re.sub(r"\[\d+\]", "[]", path) for path in one.missing), []).append(one)
    for members in groups.values():
        keys = [key_of(path) for path in members[0].missing]
        if len({one.missing for one in members}) > 1:
            keys = list(dict.fromkeys(re.sub(r"\[\d+\]", "[…]", key) for key in keys))
        yield [keys[0], members[0].title if len(members) == 1 else _plain(members)]
        for key in keys[1:]:
            yield [key, ""]


def _unfit(verdicts: Sequence[Verdict]) -> Iterator[Remark]:
    """Yield which checks do not fit joints of which kinds."""
    for why in dict.fromkeys(one.unfit for one in verdicts if one.unfit):
        titles = "; ".join(dict.fromkeys(one.title for one in verdicts if one.unfit == why))
        yield Remark(text=_("Not run ({why}): {titles}.").format(why=why, titles=titles))


def _plain(members: Sequence[Verdict]) -> str:
    from cardan.checks import CHECKS

    return "; ".join(dict.fromkeys(_(CHECKS[one.check].doc) for one in members))


def _remarks(judged: Judged) -> Iterator[Remark]:
    from cardan.choices.cure import most_helpful

    uncured = [one for one in judged.failed if all(cure.title != one.title for cure in judged.cures)]
    for one in uncured:
        text = _("Failed, and no single key cures it: {title}.")
        yield Remark(text=text.format(title=one.title), tone="failed")
    best = most_helpful(judged.cures)
    if best:
        yield Remark(text=plural("The change that helps most:", "The changes that help most:", len(best)), tone="next")
    for number, change in enumerate(best, start=1):
        text = _("{number}. {path} = {value} instead of {now}: {effect}")
        yield Remark(
            text=text.format(
                number=number,
                path=change.path,
                value=figure(change.value),
                now=figure(change.now),
                effect=effect(change),
            )
        )
    yield from _unfit(judged.verdicts)
    kept = sum(one.state == "passed" for one in judged.advice)
    if kept and not judged.sources:
        text = plural("One rule of thumb is kept.", "{count} rules of thumb are kept.", kept)
        yield Remark(text=text.format(count=kept))
    if judged.binding and not judged.sources:
        command = ("cardan", "check", str(judged.file), "--sources")
        yield Remark(text=_("All of them, with where the limits come from:"), command=command, tone="next")


def _rows(judged: Judged) -> Table:
    """Return every verdict, one a row."""
    from cardan.choices.lever import key_of

    keys = ("check", "subject", "title", "state", "advice", "value", "sense", "limit", "limit_high", "unit")
    columns = tuple(Column(key=key) for key in (*keys, "utilisation", "source", "missing", "note"))
    rows: list[list[Cell]] = []
    for one in judged.verdicts:
        low, high = _ends(one)
        missing = " ".join(key_of(path) for path in one.missing)
        value = float(one.value) / unit_factor(one) if one.run else None
        used = float(one.utilisation) if one.run else None
        rows.append(
            [
                *(one.check, one.subject, one.title, one.state, one.advice, value, one.sense, low, high, one.unit),
                *(used, one.source, missing, one.note),
            ]
        )
    return Table(columns=columns, rows=rows)


def _ends(one: Verdict) -> tuple[float | None, float | None]:
    if not one.run:
        return None, None
    if isinstance(one.limit, tuple):
        return float(one.limit[0]) / unit_factor(one), float(one.limit[1]) / unit_factor(one)
    return float(one.limit) / unit_factor(one), None


def _content(judged: Judged) -> dict[str, Any]:
    from dataclasses import asdict

    from cardan.choices.cure import most_helpful
    from cardan.choices.lever import key_of

    verdicts = []
    for one in judged.verdicts:
        low, high = _ends(one)
        verdicts.append(
            {
                "check": one.check,
                "subject": one.subject,
                "title": one.title,
                "state": one.state,
                "advice": one.advice,
                "value": float(one.value) / unit_factor(one) if one.run else None,
                "limit": low if high is None else [low, high],
                "sense": one.sense,
                "unit": one.unit,
                "utilisation": float(one.utilisation) if one.run else None,
                "source": one.source,
                "levers": [key_of(path) for path in one.levers],
                "missing": [key_of(path) for path in one.missing],
                "unfit": one.unfit,
                "note": one.note,
            }
        )
    return {
        "question": "check",
        "drive": judged.drive.name,
        "file": str(judged.file),
        "passed": not judged.failed,
        "verdicts": verdicts,
        "cures": [asdict(one) for one in judged.cures],
        "most_helpful": [asdict(one) for one in most_helpful(judged.cures)],
    }


def _figures(judged: Judged) -> Any:
    from cardan.checks.figure import check_figures

    return check_figures(judged.verdicts, name=judged.drive.name)
