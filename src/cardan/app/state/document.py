"""The drive file a user works on: its text, the drive it describes, and what is wrong with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem
from cardan.files import Enclosed
from cardan.io import loads


@dataclass(frozen=True, eq=False, kw_only=True)
class Document:
    """A drive file as it stands, right or wrong.

    Attributes
    ----------
    text : str
        The file, TOML.
    drive : Drive or None
        What it describes; None while something is wrong with it.
    problems : tuple of Problem
        All that is wrong with it, in the loader's own words.
    """

    text: str
    drive: Drive | None = None
    problems: tuple[Problem, ...] = ()

    @property
    def valid(self) -> bool:
        """Whether it describes a drive."""
        return self.drive is not None


def read(text: str, folder: Enclosed) -> Document:
    """Return the document that a text is, with all its problems.

    Parameters
    ----------
    text : str
        A drive file.
    folder : Enclosed
        Where files that it names are looked for, and nowhere else.
    """
    try:
        return Document(text=text, drive=loads(text, folder=folder))
    except InputError as error:
        return Document(text=text, problems=error.problems)


def changed(document: Document, change: Callable[[str], str], folder: Enclosed) -> Document:
    """Return the document after a change of its text; a change that cannot be made leaves it and tells why.

    Raises
    ------
    InputError
        The change cannot be made.
    """
    return read(change(document.text), folder)
