"""The drive file a user works on: its text, the drive it describes, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, refuse
from cardan.files import Enclosed
from cardan.io import dumps, loads
from cardan.io.drive_file import parsed
from cardan.texts import _

from .form import tree_of
from .workspace import MAX_UPLOAD


@dataclass(frozen=True, eq=False, kw_only=True)
class Document:
    """A drive file as it stands, right or wrong."""

    text: str  # the file, TOML
    drive: Drive | None = None  # what it describes; None while something is wrong with it
    problems: tuple[Problem, ...] = ()  # all that is wrong with it, in the loader's own words

    @cached_property
    def tree(self) -> dict[str, Any] | None:
        """The tables of the text, read once; None where it is no TOML."""
        return tree_of(self.text)

    @property
    def valid(self) -> bool:
        """Whether it describes a drive."""
        return self.drive is not None


def read(text: str, folder: Enclosed) -> Document:
    """Return the document that a text is, with all its problems.

    text: a drive file; folder: where files that it names are looked for, and nowhere else.
    """
    try:
        return Document(text=text, drive=loads(text, folder=folder))
    except InputError as error:
        return Document(text=text, problems=error.problems)


def changed(document: Document, change: Callable[[str], str], folder: Enclosed) -> Document:
    """Return the document after a change of its text; a change that cannot be made leaves it and tells why.

    Raises InputError: the change cannot be made.
    """
    return read(change(document.text), folder)


def sent(name: str, content: bytes, folder: Enclosed) -> str:
    """Return the TOML text of a file that a user sent, JSON translated.

    A file that is TOML but no sound drive is taken as it is: what is wrong with it is then shown beside it.
    """
    if len(content) > MAX_UPLOAD:
        raise refuse(name, _("is larger than {limit} MB; no drive file is").format(limit=MAX_UPLOAD // 10**6))
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise refuse(name, _("is not UTF-8 text (byte {byte})").format(byte=error.start)) from None
    if name.lower().endswith(".json"):
        return dumps(loads(text, folder=folder, form="json", name=name))
    parsed(text, "toml", name)
    return text
