"""Verdicts one by one, as a list of traffic lights has them: what, how much, by which limit, why, the remedies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np

from cardan.answers.answer import Column, Tone
from cardan.answers.printed import Cell, cell, number
from cardan.answers.quantity import Joined, Quantity, say, told
from cardan.answers.reader import reader
from cardan.checks import CHECKS, Verdict, check
from cardan.checks.verdict_table import MOST, alike, limit, verdict_key
from cardan.choices.check_answer import sentence as said
from cardan.choices.remedy import Remedy, remedies, typed
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import counted
from cardan.errors import CardanError, InputError
from cardan.figures.axes import percent
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.equivalence import SYNCHRONOUS
from cardan.questions.motion.kinds import kind_name
from cardan.questions.motion.moving_points import default_times
from cardan.questions.phases.answer import excess
from cardan.questions.phases.phases import Phasing
from cardan.questions.phases.setting import YokeSetting, values_of
from cardan.texts import _, plural

from .block import capital
from .subject import Progress, Subject

FIRST = "speed_fluctuation"  # the check whose number stands first
SELF_CHECK = "answers_agree"  # the check that asks every question anew
LEAST = 1e-5  # share below which the number that stands first tells no digits
REMEDIES = 3  # cures of a verdict; those after them move the drive more


@dataclass(frozen=True, kw_only=True)
class Light:
    """One verdict, or several that differ in joint or shaft alone."""

    name: str  # the same for the same verdict of another drive
    title: str  # what was judged
    tone: Tone  # how that came out: good, warning, failed
    verdict: str  # the same in a word
    value: Cell  # the value with its unit
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


def lights(on: Subject, *, swift: bool = False) -> tuple[Light, ...]:
    """Return the verdicts on a drive, the worst first, rules of thumb last; without remedies.

    swift: without `SELF_CHECK`, which asks every question anew.
    """
    asked = [name for name in CHECKS if name != SELF_CHECK] if swift else []
    run = [one for one in check(on.drive, known=on.known, only=asked) if one.run]
    return tuple(_light(group) for group in alike(sorted(run, key=lambda one: (one.advice, -float(one.utilisation)))))


def with_self_check(shown: Sequence[Light], before: Sequence[Light]) -> tuple[Light, ...]:
    """Return verdicts reached swiftly with that of `SELF_CHECK` as it was before; until it is reached anew."""
    own = [one for one in before if any(verdict.check == SELF_CHECK for verdict in one.verdicts)]
    return tuple(sorted((*shown, *own), key=lambda one: (one.advice, -one.used)))


@dataclass(frozen=True, kw_only=True)
class Headline:
    """The one number that stands first: how far the output is from turning uniformly."""

    title: str  # what it is
    value: str  # what it comes to, with its unit
    tone: Tone  # how good that is; plain where no limit is given


def headline(on: Subject, shown: Sequence[Light]) -> Headline:
    """Return the number that stands first: as its limit judges it, else the largest of a movement, else as drawn.

    shown: the verdicts, as of `lights`.
    """
    judged = next((one for one in shown if any(verdict.check == FIRST for verdict in one.verdicts)), None)
    if judged is not None:
        worst = max(float(one.value) for one in judged.verdicts if one.check == FIRST)
        return Headline(title=judged.title, value=_large(worst, judged.value.text), tone=judged.tone)
    if on.drive.movements:
        with suppress(CardanError):
            most = float(np.nanmax(articulation(on.drive, times=default_times(on.drive.movements)).speed_fluctuation))
            return _plain(_("largest speed fluctuation of the movement"), most)
    several = on.drive.movements or on.drive.poses
    return _plain(_("speed fluctuation of the drive as drawn") if several else _("speed fluctuation"), on.fluctuation)


def moving_span(drive: Drive) -> tuple[float, float]:
    """Return the first and the last instant of a drive's movements [s]; twice the same where nothing moves."""
    with suppress(CardanError):
        if drive.movements:
            first, *_between, last = map(float, default_times(drive.movements))
            return first, last
    return 0.0, 0.0


def headline_at(on: Subject, instant: float) -> Headline:
    """Return the number that stands first of a drive that its movements have brought to an instant [s]."""
    title = _("speed fluctuation at t = {time}").format(time=Quantity(instant, "time", 3).told(reader()))
    return _plain(title, float(articulation(on.drive, times=[instant]).speed_fluctuation[0]))


def _plain(title: str, share: float) -> Headline:
    return Headline(title=title, value=_large(share, number(Quantity(share, "share", 3), reader()).text), tone="plain")


def _large(share: float, text: str) -> str:
    """Return a share as it stands in large letters, with no digits that are rounding and nothing else."""
    return f"< {number(Quantity(LEAST, 'share', 1), reader()).text}" if 0.0 < share < LEAST else text


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
        value=number(key.value, who),
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
        Applicable(label=f"{counted(one.path)} = {typed(one.value)}", effect=_effect(one), values={one.path: one.value})
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
    """Return in a sentence how verdicts came out."""
    return capital(told(said([verdict for one in shown for verdict in one.verdicts]), reader()))


__all__ = [
    "MOST",
    "Headline",
    "Light",
    "headline",
    "headline_at",
    "lights",
    "moving_span",
    "sentence",
    "with_remedies",
    "with_self_check",
]


# What can be put into a drive file with one touch: settings of the yokes, and changes that cure failed verdicts.

SHOWN = 3  # settings with spline teeth beside the exact ones


@dataclass(frozen=True, kw_only=True)
class Applicable:
    """A change of the drive file that has a name."""

    label: str  # what it is called
    effect: str = ""  # what it comes to, in a few words
    # path with unit -> value, as `cardan.io.edit.edit` takes them; empty where the file has it so
    values: Mapping[str, float | int | str] = field(default_factory=dict)


def settings(on: Subject) -> tuple[Applicable, ...]:
    """Return the settings of the yokes that can be applied, as in the table of settings, without the one as built."""
    found = _phasing(on)
    if found is None:
        return ()
    steered = (one.setting for one in found.steering[1:])
    several = (*found.settings, *found.spline_settings[:SHOWN], *found.pose_settings, *steered)
    return tuple(_of(one, on) for one in several)


def synchronous(on: Subject) -> Applicable | str:
    """Return the setting that makes the drive synchronous, or as nearly as the teeth of its splines allow.

    Where there is none to apply, a sentence says why.
    """
    if on.joints == 1:
        return _("A single joint has no second one to undo it.")
    try:
        found = _phasing(on)
    except InputError as error:
        return "; ".join(problem.message for problem in error.problems)
    if found is None:
        own = ", ".join(f"{k} ({kind_name(joint)})" for k, joint in enumerate(on.drive.joints, start=1))
        return _("Yoke angles cannot be found for these joints: {joints}.").format(joints=own)
    if found.as_built.speed_fluctuation < SYNCHRONOUS:
        return _("The yokes stand right: the drive is synchronous.")
    exact = [one for one in found.settings if one.speed_fluctuation < SYNCHRONOUS]
    if not exact:
        return _why_not(on, found)
    if not found.spline_settings:
        return _of(exact[0], on)
    best = found.spline_settings[0]
    if best.speed_fluctuation < SYNCHRONOUS:
        return _of(best, on)
    if not best.speed_fluctuation < found.as_built.speed_fluctuation - SYNCHRONOUS:
        return _("The angles for a uniform output do not exist on these splines; on the teeth the yokes stand best.")
    told = _of(best, on)
    return replace(told, effect=_("{leaves}, the best that exists on these splines").format(leaves=told.effect))


def _phasing(on: Subject) -> Phasing | None:
    """Return what the yokes can do; None where joints turn by laws of their own that count."""
    try:
        return on.phasing
    except InputError:
        if on.by_laws:
            return None
        raise


def _why_not(on: Subject, found: Phasing) -> str:
    least = percent(found.speed_fluctuation_min)
    if found.limiting_joint is None or len(found.limiting_joints) != 1:
        text = _(
            "Joints tied by held yokes act as one with too much speed fluctuation for the others; {least} is the least."
        )
        return text.format(least=least)
    i = found.limiting_joint - 1
    why = excess(found, on.joints, float(on.joint_angle[i]), plain=on.drive.joints[i].single_cross)
    return say(_("It cannot be made uniform. {why}"), why=why).told(reader())


def _of(one: YokeSetting, on: Subject) -> Applicable:
    effect = _("leaves {share}").format(share=percent(one.speed_fluctuation))
    return Applicable(label=one.label, effect=effect, values=values_of(one, on.drive))
