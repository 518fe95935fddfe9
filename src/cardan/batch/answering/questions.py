"""What can be asked of every point of a sweep: what the questions of the register list as their columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cardan.answers.question import Question
from cardan.answers.sweepable import SweepQuestion
from cardan.errors import Problem, check
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import nearest


def questions(*, mechanism: bool = False) -> dict[str, SweepQuestion]:
    """Return everything that a sweep may ask of a drive, or of a mechanism, by its name."""
    return {one.name: one for question in _every(mechanism) for one in question.columns}


def _every(mechanism: bool) -> Sequence[Question]:
    every = tuple(QUESTIONS.values())
    return [one.of_mechanism for one in every if one.mechanism] if mechanism else every


def _found(name: str, mechanism: bool) -> Iterator[SweepQuestion]:
    """Yield what a sweep may ask by a name, without importing more questions than need be."""
    every = sorted(_every(mechanism), key=lambda one: one.name != name)
    yield from (one for question in every for one in question.columns if one.name == name)


def asked(names: Sequence[str], *, mechanism: bool = False) -> tuple[SweepQuestion, ...]:
    """Return questions about a drive, or about a mechanism, by their names."""
    found = {name: next(_found(name, mechanism), None) for name in dict.fromkeys(names)}
    problems = [] if names else [Problem("ask", _("nothing is asked"))]
    for k, name in enumerate(names):
        if found[name] is None:
            known = questions(mechanism=mechanism)
            near = nearest(name, known)
            text = _("unknown question {name}; the questions are {known}")
            said = text.format(name=repr(name), known=", ".join(known))
            problems.append(Problem("ask", said + (_("; the nearest is {near}").format(near=near) if near else "")))
        elif name in names[:k]:
            problems.append(Problem("ask", _("{name} is asked twice").format(name=name)))
    check(problems)
    return tuple(one for one in found.values() if one is not None)
