"""Verdicts one by one, as a list of traffic lights has them: what, how much, by which limit, why, and what cures it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from cardan.checks import Verdict, check
from cardan.checks.alike import alike, deciding_limits, title_of
from cardan.choices.change import typed
from cardan.choices.cure import Cure, cures
from cardan.errors import InputError
from cardan.figures.wording import fixed, significant
from cardan.texts import _, plural
from cardan.units import factor, label

from .applying import Applicable
from .block import Cell, Tone, number
from .subject import Progress, Subject

CURES = 3
"""Cures of a verdict; those after them move the drive more."""

TONES: dict[str, Tone] = {"passed": "good", "close": "warning", "failed": "failed"}


@dataclass(frozen=True, kw_only=True)
class Light:
    """One verdict, or several that differ in joint or shaft alone.

    Parameters
    ----------
    name : str
        The same for the same verdict of another drive.
    title : str
        What was judged.
    tone : str
        How that came out: good, warning, failed.
    verdict : str
        The same in a word.
    value : Cell
        The value, in `unit`.
    unit : str
        Unit that people read it in.
    limit : str
        The limit with its sense.
    used : float
        Share of the limit that is used.
    source, why : str
        Where the limit comes from; what it means or assumes.
    path : str
        Part of the drive that it is about: ``joints[1]``; empty for the whole drive.
    levers : tuple of str
        Paths of keys that move the value.
    advice : bool
        A rule of thumb that fails no drive.
    cures : tuple of Applicable
        Smallest changes of one key that make it pass; empty before they were looked for.
    count : int
        How many verdicts it stands for.
    """

    name: str
    title: str
    tone: Tone
    verdict: str
    value: Cell
    unit: str
    limit: str
    used: float
    source: str
    why: str
    path: str
    levers: tuple[str, ...] = ()
    advice: bool = False
    cures: tuple[Applicable, ...] = ()
    count: int = 1


def lights(on: Subject) -> tuple[Light, ...]:
    """Return the verdicts on a drive, the worst first, rules of thumb last; without cures.

    Parameters
    ----------
    on : Subject
        The drive.

    Raises
    ------
    InputError
        The drive cannot be judged.

    Examples
    --------
    >>> from cardan.drive.drive import Drive
    >>> from cardan.drive.duty import Limits
    >>> bent = replace(Drive.from_angles([0.5]), limits=Limits(bend=0.4))
    >>> print(lights(Subject(drive=bent))[0].title)
    bend of joint 1
    """
    run = [one for one in check(on.drive, known=on.known) if one.run]
    return tuple(_light(group) for group in alike(sorted(run, key=lambda one: (one.advice, -float(one.utilisation)))))


def with_cures(on: Subject, progress: Progress | None = None) -> tuple[Light, ...]:
    """Return the same with what cures the failed ones.

    Parameters
    ----------
    on : Subject
        The drive.
    progress : function, optional
        Called with the share done; answering "stop" leaves the verdicts that come after without cures.
    """
    shown = lights(on)
    if all(one.tone != "failed" for one in shown):
        return shown
    try:
        found = cures(on.drive, check(on.drive, known=on.known), known=on.known, progress=progress)
    except InputError:
        return shown
    return tuple(replace(one, cures=_applicable(one, found)) for one in shown)


def _light(group: Sequence[Verdict]) -> Light:
    one = group[0]
    limits = (f"{sense} {_figure(one, limit).text}" for sense, limit in deciding_limits(one))
    beyond = one.advice and one.state == "failed"
    tone: Tone = "warning" if beyond else TONES[one.state]
    said = {"good": _("passed"), "warning": _("close"), "failed": _("failed")}[tone]
    return Light(
        name=f"{one.check} {one.subject}",
        title=title_of(group),
        tone=tone,
        verdict=_("beyond") if beyond else said,
        value=_figure(one, float(one.value)),
        unit=label(one.unit),
        limit=f"{_(' or ').join(limits)} {label(one.unit)}".strip(),
        used=float(one.utilisation),
        source=one.source,
        why=one.note,
        path=one.subject,
        levers=one.levers,
        advice=one.advice,
        count=len(group),
    )


def _figure(one: Verdict, value: float) -> Cell:
    shown = value / (factor(one.dimension, one.unit) if one.dimension else 1.0)
    if shown == float("inf"):
        return Cell(text="∞")
    return number("0" if abs(shown) < 1e-9 else significant(shown), shown)


def _applicable(light: Light, found: Sequence[Cure]) -> tuple[Applicable, ...]:
    mine = [one for one in found if f"{one.check} {one.subject}" == light.name]
    return tuple(
        Applicable(
            label=f"{one.path} = {typed(one.value)}",
            effect=_effect(one),
            values={one.path: one.value},
        )
        for one in mine[:CURES]
    )


def _effect(one: Cure) -> str:
    text = _("instead of {now}").format(now=typed(one.now))
    others = len([title for title in one.solves if title != one.title])
    if others:
        more = plural("cures one more", "cures {count} more", others).format(count=others)
        text = _("{change}; {more}").format(change=text, more=more)
    if one.breaks:
        text = _("{change}; then fails: {titles}").format(change=text, titles=", ".join(one.breaks))
    return text


def sentence(shown: Sequence[Light]) -> str:
    """Return in a sentence how verdicts came out.

    Parameters
    ----------
    shown : sequence of Light
        All of a drive.
    """
    binding = [one for one in shown if not one.advice]
    failed = sum(one.count for one in binding if one.tone == "failed")
    count = sum(one.count for one in binding)
    if not binding:
        return _("Nothing could be judged: the drive file gives neither limits nor what they need.")
    if failed and count == 1:
        return _("The one limit that could be judged is not kept.")
    if failed:
        return plural(
            "{failed} of {count} limits is not kept.", "{failed} of {count} limits are not kept.", failed
        ).format(failed=failed, count=count)
    worst = fixed(binding[0].used)
    return plural(
        "The one limit that could be judged is kept, {used} of it.",
        "All {count} limits that could be judged are kept, at most {used} of them.",
        count,
    ).format(count=count, used=worst)
