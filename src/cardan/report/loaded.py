"""The parts of the report about a drive under load and as made: each only where the drive file says enough."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.questions.gathering import principal
from cardan.register import QUESTIONS

from .answers import found_page
from .block import Page
from .subject import Subject

OWN = ("motion", "classical", "articulation", "phasing", "check")
"""Questions whose pages have places of their own in the report."""


def loaded(on: Subject) -> Iterator[Page]:
    """Yield the parts that the drive file asks for; none once the reader stopped the work."""
    asked = (one for one in QUESTIONS.values() if one.report and one.name not in OWN)
    for question in asked if on.complete else ():
        page = None if question.lacking(principal(question, on.drive)) else found_page(question, on)
        if page is not None:
            yield page
