"""What can be asked of every point of a sweep: what the questions of the register list as their columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from cardan.answers.sweepable import SweepQuestion
from cardan.errors import Problem, check
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import nearest


def questions() -> dict[str, SweepQuestion]:
    """Return everything that a sweep may ask, by its name."""
    return {one.name: one for question in QUESTIONS.values() for one in question.columns}


def _found(name: str) -> Iterator[SweepQuestion]:
    """Yield what a sweep may ask by a name, without importing more questions than need be."""
    first = [QUESTIONS[name]] if name in QUESTIONS else []
    yield from (one for question in (*first, *QUESTIONS.values()) for one in question.columns if one.name == name)


def asked(names: Sequence[str]) -> tuple[SweepQuestion, ...]:
    """Return questions by their names."""
    found = {name: next(_found(name), None) for name in dict.fromkeys(names)}
    problems = [] if names else [Problem("ask", _("nothing is asked"))]
    for k, name in enumerate(names):
        if found[name] is None:
            known = questions()
            near = nearest(name, known)
            text = _("unknown question {name}; the questions are {known}")
            said = text.format(name=repr(name), known=", ".join(known))
            problems.append(Problem("ask", said + (_("; the nearest is {near}").format(near=near) if near else "")))
        elif name in names[:k]:
            problems.append(Problem("ask", _("{name} is asked twice").format(name=name)))
    check(problems)
    return tuple(one for one in found.values() if one is not None)
