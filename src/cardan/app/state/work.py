"""A question about a drive, and its answer: what the pages of the app show, made here or in a process of its own."""

from __future__ import annotations

from typing import TypeAlias

from cardan.answers.reader import reading
from cardan.files import Enclosed
from cardan.io.drive_file import known_to
from cardan.report.answers import answered, subject
from cardan.report.block import Page
from cardan.report.lights import Light, lights, with_remedies
from cardan.report.recorded import Recorded
from cardan.report.render.exports import Exported
from cardan.texts import speaking

from . import papers, recordings
from .question import Progress, Question

Result: TypeAlias = Page | tuple[Light, ...] | Exported | Recorded


VERDICTS, REMEDIES = "verdicts", "remedies"
"""Questions beside those of the register: the verdicts, and the same with what cures them."""


def result(question: Question, progress: Progress | None = None) -> Result:
    """Return the answer to a question, in its language.

    Raises InputError: the files that the drive names cannot be read, or it cannot be judged.
    """
    with speaking(question.language), reading(question.reader):
        known = known_to(question.drive, Enclosed(question.folder)) if question.drive.settings.catalogues else None
        if question.name in (papers.REPORT, papers.PART, papers.COMPARE):
            return papers.made(question, known, progress)
        if question.name == recordings.DIAGNOSIS:
            return recordings.heard(question.drive, question.choices["recording"], known, progress)
        on = subject(question.drive, known=known)
        if question.name == VERDICTS:
            return lights(on)
        if question.name == REMEDIES:
            return with_remedies(on, progress)
        return answered(question.name, on, progress, question.choices)
