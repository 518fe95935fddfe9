"""What there is to say of the checks of a drive: verdicts, corrective changes, what could not be judged."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table
from cardan.answers.quantity import Joined, Quantity, Say, Text, Written, say
from cardan.answers.question import Lacking
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.catalogue import Catalogue
from cardan.checks.audit.answers_agree import CHECK as AUDIT
from cardan.checks.audit.answers_agree import Compared, audit, verdict_on
from cardan.checks.check import part_of
from cardan.checks.checks import CHECKS, check
from cardan.checks.design import design
from cardan.checks.key_figures import key_figures
from cardan.checks.torsion.line import NO_MODEL
from cardan.checks.verdict import Verdict
from cardan.checks.verdict_table import (
    MOST,
    alike,
    counting,
    least_needs,
    missing_table,
    share,
    title_of,
    unconfirmed_remark,
    verdict_key,
    verdict_records,
    verdict_table,
)
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import bare_path
from cardan.drive.fields.wording import counted, in_words
from cardan.later import later
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.stability.in_use import larger_in_use
from cardan.texts import _, mark, plural
from cardan.units import dimension_of, factor

from .remedy import Remedy, most_helpful, remedies, typed

drawn = later("cardan.checks.figure")

REMEDIES = 3
"""Remedies shown of each failed verdict; programs get all."""

NEAR = 1.1
"""A change this much larger is as good as the smaller one where it makes more verdicts pass."""

URGENT = 10
"""Rows of verdicts on the first page; more only where more than these fail or are close."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Checked:
    """The verdicts on a drive and their remedies."""

    verdicts: tuple[Verdict, ...]
    remedies: tuple[Remedy, ...] = ()  # the smallest changes of single keys that make failed verdicts pass
    compared: tuple[Compared, ...] = ()  # answers side by side, where all were asked for

    @property
    def agreement(self) -> Verdict | None:
        """Whether answers that speak of the same quantity agree; None where nothing was compared."""
        return next((one for one in self.verdicts if one.check == AUDIT.name and one.run), None)

    @property
    def told(self) -> tuple[Verdict, ...]:
        """All verdicts but that answers agree, where they do: it is told by itself."""
        return tuple(one for one in self.verdicts if one.check != AUDIT.name or not one.passed)

    @property
    def binding(self) -> list[Verdict]:
        """Verdicts that were reached and that the drive must keep, the worst first.

        That answers agree is no merit of the drive; that they do not is its first trouble.
        """
        own = (one for one in self.verdicts if one.run and not one.advice)
        return sorted((one for one in own if one.check != AUDIT.name or not one.passed), key=_worst)

    @property
    def advice(self) -> list[Verdict]:
        """Rules of thumb that were reached, the worst first."""
        return sorted((one for one in self.verdicts if one.run and one.advice), key=_worst)

    @property
    def unconfirmed(self) -> list[Verdict]:
        """Verdicts that the drive must keep and that rest on what nothing confirms."""
        return [one for one in self.binding if not one.sure]

    @property
    def beyond(self) -> list[Verdict]:
        """Rules of thumb that the drive does not keep, the worst first."""
        return [one for one in self.advice if one.state == "failed"]

    @property
    def failed(self) -> list[Verdict]:
        """Verdicts that the drive must keep and does not."""
        return [one for one in self.binding if one.state == "failed"]


def _worst(one: Verdict) -> float:
    return -float(one.utilisation)


def lacking(_drive: Drive) -> Lacking:
    """Return what the drive file lacks to be checked: nothing; each check says what it needs."""
    return ()


def checked(
    drive: Drive,
    *,
    only: Sequence[str] = (),
    known: Catalogue | None = None,
    whole: bool = False,
    progress: Callable[[float], object] | None = None,
) -> Checked:
    """Return the verdicts on a drive and their remedies.

    only: names of checks; all when empty.
    known: the shipped one when not given.
    whole: compare all answers that speak of the same quantity, those too that take long.
    progress: called with the share done; answering "stop" ends the search for remedies.
    """
    verdicts = check(drive, only=only, known=known)
    compared: tuple[Compared, ...] = ()
    if whole:
        subject = design(drive, known=known)
        compared = audit(subject)
        told = replace(AUDIT, judge=lambda _design: verdict_on(compared)).verdicts(subject)
        verdicts = (*(one for one in verdicts if one.check != AUDIT.name), *told)
    found = remedies(drive, verdicts, known=known, progress=progress)
    return Checked(verdicts=verdicts, remedies=found, compared=compared)


def ask(drive: Drive, *, known: Catalogue | None = None) -> Checked | None:
    """Return the verdicts on a drive and their remedies; None where nothing could be judged that matters."""
    found = checked(drive, known=known)
    return found if found.binding or found.beyond else None


def otherwise(drive: Drive) -> str | Lacking:
    """Return why nothing can be told."""
    return least_needs(check(drive)) or _("There is nothing to be told of this drive.")


def answer(drive: Drive, result: Checked, *, sources: bool = False, missing: bool = False) -> Answer:
    """Return what there is to say of the checks of a drive.

    sources: say in brief, too, where every verdict comes from.
    missing: say in brief, too, which keys the checks need that were not run.
    """
    close = any(one.state in ("close", "unconfirmed") for one in result.binding)
    return Answer(
        name="check",
        title=_("Checks"),
        sentence=sentence(result.verdicts),
        tone="failed"
        if result.failed
        else "warning"
        if close or (result.beyond and not result.binding)
        else "good"
        if result.binding
        else "plain",
        figures=lambda: drawn().check_figures(result.told, name=drive.name),
        tables=tuple(_tables(drive, result, sources=sources, missing=missing)),
        remarks=(
            *yokes_estimated(drive),
            *(replace(one, aside=True) for one in larger_in_use(drive)),  # torsional vibration tells it too
            *_remarks(result, sources=sources, missing=missing),
        ),
        keys=tuple(key_figures(drive, result.verdicts)),
        facts={
            "passed": not result.failed,
            "answers_agree": None if result.agreement is None else bool(result.agreement.passed),
            "unconfirmed": len(result.unconfirmed),
            "remedies": [asdict(one) for one in result.remedies],
            "most_helpful": [asdict(one) for one in most_helpful(result.remedies)],
        },
        full=lambda: verdict_records(result.told, "", flat=True),
        code=1 if result.failed else 0,
    )


def sentence(verdicts: Sequence[Verdict]) -> Say | str:
    """Return in a sentence how verdicts came out."""
    result = Checked(verdicts=tuple(verdicts))
    binding, failed = result.binding, result.failed
    if not binding:
        if result.beyond:
            text = _("no limit that must be kept could be judged; beyond a rule of thumb: {title}, at {used} of it.")
            worst = result.beyond[0]
            return say(text, title=worst.title, used=share(float(worst.utilisation)))
        if result.advice:
            return _("no limit that must be kept could be judged, only rules of thumb.")
        if unfit := [one.unfit for one in result.verdicts if one.unfit]:
            return _("nothing could be judged: {why}.").format(why=unfit[0])
        return _("nothing could be judged: the drive file gives neither limits nor what they need.")
    worst, count = binding[0], len(binding)
    if failed:
        text = _("the only check failed: {title}, at {used} of its limit.")
        if count > 1:
            text = _("{failed} of {count} checks failed: {title}, at {used} of its limit.")
        if len(failed) > 1:
            text = _("{failed} of {count} checks failed; worst: {title}, at {used} of its limit.")
    else:
        unsure = len(result.unconfirmed)
        text = _("the only check passed: {title}, at {used} of its limit.")
        if count > 1:
            text = _("all {count} checks passed; closest: {title} ({used}).")
        if unsure:
            text = _("all {count} checks met, {unsure} by unconfirmed ratings; closest: {title} ({used}).")
        if unsure == count:
            text = _("all checks met, by unconfirmed ratings; closest: {title} ({used}).")
        if unsure == count == 1:
            text = _("the only check met, by an unconfirmed rating: {title}, at {used} of its limit.")
    used, loose = share(float(worst.utilisation)), len(result.unconfirmed)
    return say(text, failed=len(failed), count=count, unsure=loose, title=worst.title, used=used)


def _tables(drive: Drive, result: Checked, *, sources: bool, missing: bool) -> Iterator[Table]:
    if result.binding:
        yield verdict_table(result.binding, sources=sources)
    if result.remedies:
        yield remedy_table(drive, result)
    told = [one for one in result.advice if sources or not one.met]
    if told:
        yield verdict_table(told, _("Advice: rules of thumb, they fail no drive"), sources=sources)
    lacks = [one for one in result.verdicts if one.missing]
    if lacks:
        yield missing_table(lacks, "brief" if missing or not result.binding else "full")
    if result.compared:
        yield compared_table(drive, result.compared)
    yield verdict_records(result.told, "verdicts")


def compared_table(drive: Drive, found: Sequence[Compared]) -> Table:
    """Return answers that speak of the same quantity side by side, those that differ most first."""
    rows = sorted(found, key=lambda one: -one.deviation)

    def side(k: int) -> list[Cell]:
        return [
            Cell(value=Quantity(one.values[k], one.pair.dimension), before="" if k == 0 or same(one) else "≥ ")
            for one in rows
        ]

    def same(one: Compared) -> bool:
        return one.pair.sense == "same"

    parts = [_part(drive, one.part) for one in rows]
    return Table(
        name="compared",
        title=_("Answers that speak of the same quantity, side by side"),
        records=True,
        columns=(
            Column(
                key="deviation",
                heading=_("of what may be"),
                values=[one.deviation for one in rows],
                decimals=2,
                most=MOST,
            ),
            Column(key="first_value", heading=_("first"), values=side(0)),
            Column(key="second_value", heading=_("second"), values=side(1)),
            Column(
                key="",
                heading=_("questions"),
                values=[f"{one.pair.first}, {one.pair.second}" for one in rows],
                left=True,
            ),
            Column(
                key="",
                heading=_("what"),
                values=[Joined([_(one.pair.quantity), part]) for one, part in zip(rows, parts, strict=True)],
                left=True,
                wrap=True,
            ),
            Column(key="quantity", values=[_(one.pair.quantity) for one in rows], depth="data"),
            Column(key="part", values=[one.part for one in rows], depth="data"),
            Column(key="first", values=[one.pair.first for one in rows], depth="data"),
            Column(key="second", values=[one.pair.second for one in rows], depth="data"),
            Column(key="tolerance", values=[one.pair.tolerance for one in rows], depth="data"),
            Column(key="why", values=[_(one.pair.why) for one in rows], depth="data"),
        ),
        note=_("How far they may differ, and why, stands in the JSON."),
    )


def _part(drive: Drive, path: str) -> str:
    """Return a part in words; what is no part of the drive as it is called."""
    if not path.startswith(("joints[", "shafts[")):
        return path.partition("[")[0]
    kind = _("joint {number}") if path.startswith("joints[") else _("shaft {number}")
    return kind.format(number=part_of(drive, path))


def remedy_table(drive: Drive, result: Checked, *, helpful: bool = False) -> Table:
    """Return the smallest changes of single keys that make failed verdicts pass, those that help most first.

    helpful: only those that help most, parts by name and values with units, with a word on what has no remedy.
    """
    found = result.remedies
    best = list(most_helpful(found))
    shown = best if helpful else [*best, *_others(found, best)]
    notes: list[Text] = [counting()] if not helpful and any("[" in one.path for one in shown) else []
    if 0 < len(best) < len(shown):
        text = plural("The first change helps most.", "The first {count} changes together help most.", len(best))
        notes.insert(0, text.format(count=len(best)))
    if helpful:
        notes.extend(_unremedied(result))
    words = [in_words(bare_path(drive, one.path)) for one in shown]
    keys = [Written(one.path, said, counted(one.path)) for one, said in zip(shown, words, strict=True)]
    heading = _("what") if helpful else _("key to change")
    return Table(
        title=_("Changes that help most") if helpful else _("Corrective changes (one parameter each)"),
        columns=(
            Column(key="", heading=heading, values=words if helpful else keys),
            Column(key="", heading=_("now"), values=[_value(one, one.now, helpful) for one in shown]),
            Column(key="", heading=_("to"), values=[_value(one, one.value, helpful) for one in shown]),
            Column(key="", heading=_("then passes"), values=[_effect(one) for one in shown], wrap=True),
        ),
        note=Joined(notes, between=" "),
    )


def _value(one: Remedy, value: float | int | str, told: bool) -> Text:
    """Return a value of a change as its key takes it; told, and in reports, with its unit as readers are used to."""
    if isinstance(value, str) or not one.unit:
        return typed(value)
    dimension = dimension_of(one.unit)
    amount = Quantity(value * factor(dimension, one.unit), dimension, 6, unit=one.unit, trim=True)
    return amount if told else Written(typed(value), amount)


def _others(found: Sequence[Remedy], best: Sequence[Remedy]) -> Iterator[Remedy]:
    """Yield the remedies beside the best: each change once, so many of each verdict, none outdone by another."""
    told: dict[str, int] = {}
    seen = {(one.path, one.value) for one in best}
    for one in found:
        if (one.path, one.value) in seen or any(_outdone(one, other) for other in found):
            continue
        seen.add((one.path, one.value))
        told[one.title] = told.get(one.title, 0) + 1
        if told[one.title] <= REMEDIES:
            yield one


def _outdone(one: Remedy, other: Remedy) -> bool:
    """Tell whether hardly more of the same change makes more verdicts pass."""
    if one.path != other.path or other.change > NEAR * one.change or len(other.breaks) > len(one.breaks):
        return False
    return {one.title, *one.solves} < {other.title, *other.solves}


def _effect(one: Remedy) -> Cell:
    """Return what passes with a change, and what fails then."""
    others = [title for title in one.solves if title != one.title]
    text = one.title
    if others:
        more = plural("{title} and {count} other", "{title} and {count} others", len(others))
        text = more.format(title=one.title, count=len(others))
    if one.note:
        text += f" ({one.note})"
    if one.breaks:
        text += _("; then fails: {titles}").format(titles=", ".join(one.breaks))
    return Cell(value=text, tone="warning" if one.breaks else "plain")


def urgent(result: Checked) -> tuple[list[KeyFigure], int]:
    """Return the verdicts of the first page: what fails or is close, then the nearest; and how many are left out."""
    groups = alike(result.binding)
    first = [group for group in groups if not group[0].met]
    passed = [group for group in groups if group[0].met]
    shown = [*first, *passed][: max(URGENT, len(first))]
    return [verdict_key(group) for group in shown], len(result.binding) - sum(map(len, shown))


def _remarks(result: Checked, *, sources: bool, missing: bool) -> Iterator[Remark]:
    yield from (Remark(text=text, tone="failed") for text in _unremedied(result))
    if result.failed:
        yield Remark(text=sentence(result.verdicts), tone="failed", alarm=True, depth="data")
    yield from (
        Remark(text=say(_("Two answers contradict each other: {note}"), note=one.note), tone="failed", alarm=True)
        for one in result.failed
        if one.check == AUDIT.name
    )
    for why in dict.fromkeys(one.unfit for one in result.verdicts if one.unfit):
        titles = "; ".join(map(title_of, _alike_unfit([one for one in result.verdicts if one.unfit == why])))
        yield Remark(text=_("Not run ({why}): {titles}.").format(why=why, titles=titles))
    if result.beyond and not result.binding:
        yield Remark(text=sentence(result.verdicts), tone="warning", alarm=True, depth="data")
    yield from unconfirmed_remark(result.binding)
    agreement = result.agreement
    if agreement is not None and agreement.passed:
        text = _("Answers that speak of the same quantity agree: {count}.")
        yield Remark(text=say(text, count=agreement.note), code=AUDIT.name, aside=True)
    kept = sum(one.met for one in result.advice)
    if kept and not sources:
        text = plural("One rule of thumb is kept.", "{count} rules of thumb are kept.", kept)
        yield Remark(text=text.format(count=kept))
    if any(NO_MODEL[0] in one.missing for one in result.verdicts):
        text = _("Torsional vibration was not looked at: the file says nothing of masses and stiffness (stations).")
        yield Remark(text=text, tone="warning")
    lacks = sum(bool(one.missing) for one in result.verdicts)
    if lacks and result.binding and not missing:
        text = plural("One check not run; which key it needs:", "{count} checks not run; which keys they need:", lacks)
        command = ("cardan", "check", FILE, "--missing")
        yield Remark(text=text.format(count=lacks), command=command, tone="next")
    if result.binding and not sources:
        command = ("cardan", "check", FILE, "--sources")
        yield Remark(text=_("All of them, with where the limits come from:"), command=command, tone="next")


def _unremedied(result: Checked) -> Iterator[str]:
    """Yield what fails and has no remedy."""
    remedied = {one.title for one in result.remedies}
    text = _("Failed, and no single parameter remedies it: {title}.")
    own = [one for one in result.failed if one.check != AUDIT.name]
    yield from (text.format(title=one.title) for one in own if one.title not in remedied)


def _alike_unfit(verdicts: Sequence[Verdict]) -> list[list[Verdict]]:
    """Return verdicts in groups that differ in the number of a joint or shaft alone."""
    groups: dict[tuple[str, str], list[Verdict]] = {}
    for one in verdicts:
        groups.setdefault((one.check, one.kind), []).append(one)
    return list(groups.values())


def answer_of_list() -> Answer:
    """Return all checks there are."""
    names, judges = list(CHECKS), [_(one.doc) for one in CHECKS.values()]
    return Answer(
        name="checks",
        title=_("Checks"),
        sentence=_("{count} checks; each runs where the drive file says enough.").format(count=len(CHECKS)),
        tables=[
            Table(
                name="checks",
                records=True,
                columns=(
                    Column(key="name", heading=_("check"), values=names, left=True),
                    Column(key="judges", heading=_("judges"), values=judges, left=True, wrap=True),
                ),
            )
        ],
    )


def _column_values(drive: Drive) -> tuple[float, float, float]:
    verdicts = check(drive, only=[name for name in CHECKS if name != AUDIT.name])
    binding = [one for one in verdicts if one.run and not one.advice]
    used = [float(np.max(one.utilisation)) for one in binding]
    failed, loose = sum(not one <= 1.0 for one in used), sum(not one.sure for one in binding)
    return (max(used, default=0.0), float(failed), float(loose))


COLUMNS = (
    SweepQuestion(
        name="check",
        doc=mark(
            "greatest utilisation over all checks that the drive can be put to, how many fail, and how many rest on "
            "unconfirmed ratings"
        ),
        told=(
            OutputColumn.of("utilisation_percent", mark("greatest utilisation of a limit")),
            OutputColumn(name="failed_checks", text=mark("how many checks fail")),
            OutputColumn(
                name="unconfirmed_checks", text=mark("how many checks are met or failed by unconfirmed ratings")
            ),
        ),
        of_one=_column_values,
        counts=("pose", "movement", "case", "error"),
    ),
)
"""What a sweep may ask of checks."""
