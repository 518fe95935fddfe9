"""Verdicts one by one, as a list of traffic lights has them: what, how much, by which limit, why, the remedies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cardan.answers.answer import Column, Tone
from cardan.answers.printed import Cell, cell, number
from cardan.answers.quantity import Joined, told
from cardan.answers.reader import reader
from cardan.checks import Verdict, check
from cardan.checks.alike import alike
from cardan.checks.verdict_table import MOST, limit, verdict_key
from cardan.choices.change import typed
from cardan.choices.check_answer import sentence as said
from cardan.choices.remedy import Remedy, remedies
from cardan.errors import InputError
from cardan.texts import _, plural

from .applying import Applicable
from .page import capital
from .subject import Progress, Subject

REMEDIES = 3
"""Cures of a verdict; those after them move the drive more."""


@dataclass(frozen=True, kw_only=True)
class Light:
    """One verdict, or several that differ in joint or shaft alone."""

    name: str  # the same for the same verdict of another drive
    title: str  # what was judged
    tone: Tone  # how that came out: good, warning, failed
    verdict: str  # the same in a word
    value: Cell  # the value, in `unit`
    unit: str  # unit that people read it in
    limit: str  # the limit with its sense
    used: float  # share of the limit that is used
    source: str  # source, why: where the limit comes from; what it means or assumes
    why: str
    path: str  # part of the drive that it is about: ``joints[1]``; empty for the whole drive
    design_variables: tuple[str, ...] = ()  # paths of keys that move the value
    advice: bool = False  # a rule of thumb that fails no drive
    # smallest changes of one key that make it pass; empty before they were looked for
    remedies: tuple[Applicable, ...] = ()
    verdicts: tuple[Verdict, ...] = ()  # those it stands for


def lights(on: Subject) -> tuple[Light, ...]:
    """Return the verdicts on a drive, the worst first, rules of thumb last; without remedies."""
    run = [one for one in check(on.drive, known=on.known) if one.run]
    return tuple(_light(group) for group in alike(sorted(run, key=lambda one: (one.advice, -float(one.utilisation)))))


def with_remedies(on: Subject, progress: Progress | None = None) -> tuple[Light, ...]:
    """Return the same with the remedies of the failed ones.

    progress: called with the share done; answering "stop" leaves the verdicts that come after without remedies.
    """
    shown = lights(on)
    if all(one.tone != "failed" for one in shown):
        return shown
    try:
        found = remedies(on.drive, check(on.drive, known=on.known), known=on.known, progress=progress)
    except InputError:
        return shown
    return tuple(replace(one, remedies=_applicable(one, found)) for one in shown)


def _light(group: Sequence[Verdict]) -> Light:
    one, who = group[0], reader()
    key = verdict_key(group)
    shown = limit(one)
    return Light(
        name=key.name,
        title=told(key.title, who),
        tone=key.tone,
        verdict=key.verdict,
        value=number(key.value, who, unit=False),
        unit=who.label(key.value.dimension, key.value.unit),
        limit=cell(shown, Column(key="", values=()), who).text,
        used=float(one.utilisation),
        source=told(Joined([one.source, *one.provenance], between="; "), who),
        why=told(one.note, who),
        path=one.subject,
        design_variables=one.design_variables,
        advice=one.advice,
        verdicts=tuple(group),
    )


def _applicable(light: Light, found: Sequence[Remedy]) -> tuple[Applicable, ...]:
    mine = [one for one in found if f"{one.check} {one.subject}" == light.name]
    return tuple(
        Applicable(
            label=f"{one.path} = {typed(one.value)}",
            effect=_effect(one),
            values={one.path: one.value},
        )
        for one in mine[:REMEDIES]
    )


def _effect(one: Remedy) -> str:
    text = _("instead of {now}").format(now=typed(one.now))
    others = len([title for title in one.solves if title != one.title])
    if others:
        more = plural("remedies one more", "remedies {count} more", others).format(count=others)
        text = _("{change}; {more}").format(change=text, more=more)
    if one.breaks:
        text = _("{change}; then fails: {titles}").format(change=text, titles=", ".join(one.breaks))
    return text


def sentence(shown: Sequence[Light]) -> str:
    """Return in a sentence how verdicts came out.

    shown: all of a drive.
    """
    return capital(told(said([verdict for one in shown for verdict in one.verdicts]), reader()))


__all__ = ["MOST", "Light", "lights", "sentence", "with_remedies"]
