"""The verdicts beside the view: traffic lights with their values, why they are so, remedies of the failed ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from typing import cast

from nicegui import ui

from cardan.app.state.jobs import Job, Jobs, own_fault
from cardan.app.state.question import Question, asked
from cardan.app.state.session import Session
from cardan.app.state.work import REMEDIES, VERDICTS, Judged, result
from cardan.app.state.work import SOON as SOONER
from cardan.drive.fields.wording import counted
from cardan.errors import CardanError
from cardan.report.answers import subject
from cardan.report.block import SIGNS
from cardan.report.verdict_list import (
    MOST,
    Applicable,
    Headline,
    Light,
    headline_at,
    sentence,
    synchronous,
    with_self_check,
)
from cardan.texts import _

from .answers import applied
from .widgets import Live, Timer, escaped, first

QUIET = 0.4  # seconds without an edit after which cures are looked for
LOOK = 0.2  # seconds between two looks whether they were found
KEPT = 100  # remedies that can be pressed, the newest ones: the browser may show older ones for a moment

PRESSED = """(event) => {
  const button = event.target.closest('[data-do]');
  if (button) return emit(button.dataset.do);
  const verdict = event.target.closest('summary')?.parentElement;
  if (verdict && !verdict.open) emit('look ' + verdict.dataset.name);
}"""
"""Tells which cure was pressed, or which verdict is opened; the browser knows which ones are open."""


class Verdicts:
    """The list of verdicts.

    jobs: where cures are looked for.
    compare: called to compare the drive with others; no button for it when not given.
    """

    def __init__(self, session: Session, jobs: Jobs, *, compare: Callable[[], object] | None = None) -> None:
        self.session = session
        self.lights: tuple[Light, ...] = ()
        self._offered: dict[str, Applicable] = {}  # by label; those too of a moment ago: what is pressed was seen
        self._jobs = jobs
        self._job: Job | None = None
        self._due: Timer | None = None
        self._watch: Timer | None = None
        with ui.element("div").classes("lights") as self.body:
            self._problems = ui.html("", sanitize=False).props("role=alert").props('data-mark="problems-of-verdicts"')
            self._first = Live().classes("first").props('data-mark="headline"')
            self._summed = Live().classes("summed").props("role=status").props('data-mark="judgement"')
            with ui.element("div").classes("tools"):
                even = ui.button(_("make synchronous"), on_click=self._even).props("outline dense no-caps size=sm")
                even.props('data-mark="make-synchronous"')
                if compare is not None:
                    button = ui.button(_("compare with …"), on_click=compare)
                    button.props("outline dense no-caps size=sm").props('data-mark="compare"')
            self._told = ui.label().classes("hint").props("role=status")
            self._list = Live().classes("list").props('data-mark="verdicts"')
            self._list.on("click", lambda event: self._pressed(str(event.args)), js_handler=PRESSED)
        self._told.set_visibility(False)
        session.listen("drive", self._follow, first=True)
        session.listen("text", self._judge)
        session.listen("choices", self._follow)
        session.listen("instant", self._stand)
        self._number: Headline | None = None
        self._follow()
        self._judge()

    def _follow(self) -> None:
        """Judge the drive as it is now; cures come once the user is quiet."""
        self._end()
        self._told.set_visibility(False)
        question = asked(self.session, VERDICTS, swift=bool(self.lights) and not self.session.heavy)
        if question is None:
            return
        if self.session.heavy:
            self._list.classes(add="stale")
            self._ask(question, limit=SOONER)
            return
        try:
            found = result(question)
        except CardanError as error:
            self._summed.say(str(error))
            self._show(())
            return
        except Exception as error:  # whatever it is, the page goes on and says so
            self._summed.say(own_fault(question.language, f"{type(error).__name__}: {error}"))
            self._show(())
            return
        self._found(cast("Judged", found), swift=question.choices["swift"])

    def _found(self, judged: Judged, *, swift: bool = False) -> None:
        """Show the number that stands first and the verdicts; what takes longer follows once the user is quiet."""
        self._number, found = judged
        self._stand()
        self._list.classes(remove="stale")
        self._tell(with_self_check(found, self.lights) if swift else found)
        if swift or any(one.tone == "failed" for one in found):
            self._due = Timer(self.session, self.body, QUIET, self._search, once=True)

    def _stand(self) -> None:
        """Show the number that stands first: of the instant that is looked at, else of the whole drive."""
        drive, instant, number = self.session.drive, self.session.instant, self._number
        if drive is not None and instant is not None:
            with suppress(CardanError):
                number = headline_at(subject(drive), instant)
        if number is not None:
            self._first.show(headline_html(number))

    def _search(self) -> None:
        question = asked(self.session, REMEDIES)
        if question is not None:
            self._ask(question)

    def _ask(self, question: Question, limit: float = inf) -> None:
        self._job = self._jobs.ask(question, self.session, limit=limit)
        if self._job.finished:
            self._look()
        else:
            self._watch = Timer(self.session, self.body, LOOK, self._look, once=False)

    def _look(self) -> None:
        job = self._job
        if job is None or not job.finished:
            return
        self._end()
        if job.question.drive is not self.session.drive:
            return
        if job.state == "failed" and job.question.name == VERDICTS:
            self._summed.say(job.message)
        elif job.state == "done":
            (self._found if job.question.name == VERDICTS else self._tell)(job.result)

    def _tell(self, found: Sequence[Light]) -> None:
        self._summed.say(sentence(found))
        self._show(found)

    def _show(self, found: Sequence[Light]) -> None:
        self.lights = tuple(found)
        offered = {remedy.label: remedy for one in self.lights for remedy in one.remedies}
        older = [one for one in self._offered.items() if one[0] not in offered]
        self._offered = dict([*older, *offered.items()][-KEPT:])
        self._list.show(lights_html(self.lights))

    def _judge(self) -> None:
        """Show what is wrong with the file, over the verdicts of when it was sound."""
        document = self.session.document
        self._list.classes(**{"remove" if document.valid else "add": "stale"})
        said = "".join(f"<li>{escaped(told)}</li>" for told in first(document.problems))
        head = _("The file describes no drive; the verdicts below are those of when it last did.")
        if self.session.drive is None:
            head = _("The file describes no drive yet.")
        self._problems.set_content("" if document.valid else f'<p class="wrong">{escaped(head)}</p><ul>{said}</ul>')

    def _pressed(self, what: str) -> None:
        action, _space, name = what.partition(" ")
        if action == "look":
            light = next((one for one in self.lights if one.name == name), None)
            if light is not None and light.tone == "failed":
                self.session.select(field_of(light))
            return
        if name in self._offered:
            with self.session.speaking():
                applied(self.session, self._offered[name])

    def _even(self) -> None:
        """Put the best exact setting of the yokes into the file, or say why there is none."""
        drive = self.session.drive
        if drive is None:
            return
        with self.session.speaking():
            found = synchronous(subject(drive))
            if isinstance(found, Applicable):
                applied(self.session, found)
            else:
                self._told.text = found
                self._told.set_visibility(True)

    def _end(self) -> None:
        for waiting in (self._due, self._watch):
            if waiting is not None:
                waiting.cancel()
        self._due = self._watch = None
        if self._job is not None and not self._job.finished:
            self._jobs.cancel(self._job)


def field_of(light: Light) -> str:
    """Return the path of what a failed verdict is to be cured at: its first remedy, a design variable, or its part."""
    paths = [path for remedy in light.remedies for path in remedy.values]
    return next(iter((*paths, *light.design_variables, light.path)), "")


def headline_html(number: Headline) -> str:
    """Return the number that stands first."""
    return f'<b class="{number.tone}">{escaped(number.value)}</b><span>{escaped(number.title)}</span>'


def lights_html(lights: Sequence[Light]) -> str:
    """Return the list of verdicts, rules of thumb under a heading of their own."""
    parts = [_light(one) for one in lights if not one.advice]
    advice = [_light(one) for one in lights if one.advice]
    if advice:
        parts.append(f"<h3>{escaped(_('Advice: rules of thumb, they fail no drive'))}</h3>")
    return "".join([*parts, *advice])


def _light(one: Light) -> str:
    value = escaped(one.value.text)
    full = f' title="{escaped(one.value.full)}"' if one.value.full else ""
    summary = (
        f'<summary><span class="sign" aria-hidden="true">{SIGNS[one.tone]}</span>'
        f'<span>{escaped(one.title)}<span class="word">{escaped(one.verdict)}</span></span>'
        f'<span class="value"{full}>{value}<span class="word">{_against(one)}</span></span></summary>'
    )
    return f'<details class="{one.tone}" data-name="{escaped(one.name)}">{summary}{_more(one)}</details>'


def _against(one: Light) -> str:
    """Return limit and share of it, each of which stays in a line."""
    used = f"{100.0 * one.used:.0f}" if one.used <= MOST else f"> {100.0 * MOST:.0f}"
    told = [f"<span>{escaped(one.limit.rstrip())}</span>"] if one.limit.strip() else []
    return " ".join([*told, f"<b>{used} %</b>"])


def _more(one: Light) -> str:
    share = min(one.used, 1.0) if one.used == one.used else 1.0
    said = _("{share} % of the limit").format(
        share=f"{100.0 * one.used:.0f}" if one.used <= MOST else f"> {100.0 * MOST:.0f}"
    )
    bar = f'<div class="used" role="img" aria-label="{escaped(said)}"><i style="width:{100.0 * share:.1f}%"></i></div>'
    rows = [
        (_("limit"), one.limit),
        (_("utilisation"), said),
        (_("by"), one.source),
        (_("why"), one.why),
        (_("depends on"), ", ".join(map(counted, one.design_variables[:6]))),
    ]
    told = "".join(f"<dt>{escaped(name)}</dt><dd>{escaped(text)}</dd>" for name, text in rows if text)
    return f'<div class="more">{bar}<dl>{told}</dl>{"".join(_remedies(one))}</div>'


def _remedies(one: Light) -> list[str]:
    if not one.remedies:
        return []
    word = escaped(_("apply"))
    made = [f"<h3>{escaped(_('Remedies'))}</h3>"]
    for remedy in one.remedies:
        name = escaped(f"cure {remedy.label}")
        made.append(
            f'<div class="cure"><code>{escaped(remedy.label)}</code><small>{escaped(remedy.effect)}</small>'
            f'<button type="button" class="apply" data-do="{name}">{word}</button></div>'
        )
    return made
