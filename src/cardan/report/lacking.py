"""What a part of the report says where the drive file does not answer it: what is missing, or why it is refused."""

from __future__ import annotations

from cardan.answers.question import Lacking
from cardan.drive.fields.keys import key_of
from cardan.errors import InputError
from cardan.texts import _

from .block import Page, Words


def told(lacking: Lacking) -> str:
    """Return in a sentence what is to be added to the drive file.

    lacking: paths; of each inner tuple any one would do.
    """
    either = _(" or ")
    keys = "; ".join(either.join(map(key_of, some)) for some in lacking)
    return _("This answer needs more in the drive file: {keys}.").format(keys=keys)


def refused(name: str, title: str, error: InputError) -> Page:
    """Return the page of a question that the drive file does not answer, with what is missing."""
    left = [f"{one.field}: {one.message}" for one in error.problems]
    alarm = _("{part} not calculated: {first}").format(part=title, first=left[0])
    answer = _("Not calculated; the drive file leaves open:")
    if all(one.code == "unknown_kind" for one in error.problems):
        answer = _("Not calculated for joints of these kinds:")
    return Page(
        name=name,
        title=title,
        answer=answer,
        blocks=[Words(text=text, tone="warning") for text in left],
        alarms=[Words(text=alarm, tone="warning")],
    )
