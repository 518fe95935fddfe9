"""The drive file a user works on: its text, the drive it describes, and what is wrong with it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, refuse
from cardan.files import Enclosed, write_text
from cardan.io import dumps, loads_either
from cardan.io.text import describes_mechanism, parsed, text_of
from cardan.mechanisms import Mechanism
from cardan.reading.limits import check_size
from cardan.texts import _

from .form import tree_of

Change: TypeAlias = Callable[[str], str]  # of a file: text before -> text behind; another process can take it

# Undo and redo: every text that the drive file was.

DEPTH = 200  # steps kept
ROOM = 20_000_000  # characters kept at most, of long files fewer steps


@dataclass(frozen=True, slots=True)
class History:
    """The texts before and after the present one."""

    before: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()

    def after(self, text: str) -> History:
        """Return the history once ``text`` gave way to a new one; what was undone is forgotten."""
        steps = (*self.before, text)[-DEPTH:]
        while len(steps) > 1 and sum(map(len, steps)) > ROOM:
            steps = steps[1:]
        return History(steps, ())

    def undone(self, text: str) -> tuple[str, History]:
        """Return the text before ``text``, and the history there; the text itself where there is none before."""
        if not self.before:
            return text, self
        return self.before[-1], History(self.before[:-1], (text, *self.behind))

    def redone(self, text: str) -> tuple[str, History]:
        """Return the text that was undone last, and the history there; the text itself where there is none."""
        if not self.behind:
            return text, self
        return self.behind[0], History((*self.before, text), self.behind[1:])


# The folder a user works in: no path outside it is read or written.

MAX_LISTED = 200  # files that are listed


@dataclass(frozen=True, slots=True)
class Workspace:
    """A folder with drive files."""

    folder: Path  # where they are

    @property
    def enclosed(self) -> Enclosed:
        """The folder, such that no name leads out of it."""
        return Enclosed(self.folder)

    def names(self) -> tuple[str, ...]:
        """Return the drive files of the folder, the one changed last first."""
        found = [path for path in self.folder.glob("*.toml") if path.is_file() and not path.name.startswith(".")]
        found.sort(key=lambda path: -path.stat().st_mtime)
        return tuple(path.name for path in found[:MAX_LISTED])

    def read(self, name: str) -> str:
        """Return the text of a file."""
        return text_of(self.place(name))[0]

    def write(self, name: str, text: str) -> str:
        """Write a file and return its name, with .toml at its end."""
        write_text(self.place(full_name(name)), text)
        return full_name(name)

    def there(self, name: str) -> str | None:
        """Return the text of a file; None where there is no such file, nothing where it is no text that we read."""
        try:
            return self.read(name) if os.path.lexists(self.place(name)) else None
        except InputError:
            return ""

    def stamp(self, name: str) -> tuple[int, int, int] | None:
        """Return what differs once a file was written again; None where there is no such file."""
        try:
            told = self.place(name).stat()
        except OSError:
            return None
        return told.st_mtime_ns, told.st_size, told.st_ino

    def free(self, name: str) -> str:
        """Return a name like another one that no file of the folder has."""
        stem, number = full_name(name).removesuffix(".toml"), 1
        while os.path.lexists(self.place(free := f"{stem}-{number}.toml" if number > 1 else f"{stem}.toml")):
            number += 1
        return free

    def place(self, name: str) -> Path:
        """Return where the file of a name is."""
        if not re.fullmatch(r"[^/\\\x00-\x1f:*?\"<>|.][^/\\\x00-\x1f:*?\"<>|]{0,120}", name):
            raise refuse("name", _("{name} is not a file name").format(name=repr(name)))
        return self.enclosed / name


def full_name(name: str) -> str:
    """Return the name of a file with .toml at its end."""
    return name if name.endswith(".toml") or not name else f"{name}.toml"


@dataclass(frozen=True, eq=False, kw_only=True)
class Document:
    """A drive file as it stands, right or wrong."""

    text: str  # the file, TOML
    drive: Drive | None = None  # what it describes; None while something is wrong with it
    mechanism: Mechanism | None = None  # the same of a mechanism file
    of_mechanism: bool = False  # whether it is one, right or wrong
    problems: tuple[Problem, ...] = ()  # all that is wrong with it, in the loader's own words

    @cached_property
    def tree(self) -> dict[str, Any] | None:
        """The tables of the text, read once; None where it is no TOML."""
        return tree_of(self.text)

    @property
    def valid(self) -> bool:
        """Whether it describes a drive, or a mechanism."""
        return self.drive is not None or self.mechanism is not None


def read(text: str, folder: Enclosed) -> Document:
    """Return the document that a text is, with all its problems.

    text: a drive file, or a mechanism file; folder: where files that it names are looked for, and nowhere else.
    """
    try:
        found = loads_either(text, folder=folder)
    except InputError as error:
        tree = tree_of(text)
        return Document(text=text, problems=error.problems, of_mechanism=bool(tree) and describes_mechanism(tree or {}))
    if isinstance(found, Mechanism):
        return Document(text=text, mechanism=found, of_mechanism=True)
    return Document(text=text, drive=found)


def changed(document: Document, change: Change, folder: Enclosed) -> Document:
    """Return the document after a change of its text; a change that cannot be made leaves it and tells why."""
    return read(change(document.text), folder)


HEAVY = 24  # tables of a file up to which it is read, judged and drawn in a few hundredths of a second
LONG = 20_000  # characters likewise

_TABLE = re.compile(r"^[ \t]*\[|\{", re.MULTILINE)


def heavy(text: str) -> bool:
    """Tell whether a file is so large that work on it would keep other windows waiting."""
    return len(text) > LONG or len(_TABLE.findall(text)) > HEAVY


@dataclass(frozen=True, eq=False, kw_only=True)
class Edit:
    """A change of a heavy file, as it goes to another process."""

    text: str  # the file before
    change: Change
    folder: Path  # where files that it names are looked for, and nowhere else
    language: str  # in which it is told why it cannot be made
    name: str = "edit"
    key: str = ""  # its answer is not kept

    def made(self) -> Document:
        """Return the document behind the change."""
        document = read(self.change(self.text), Enclosed(self.folder))
        assert document.tree is not None or not document.valid  # read there, so that it need not be read again here
        return document


def sent(name: str, content: bytes, folder: Enclosed) -> str:
    """Return the TOML text of a file that a user sent, JSON translated.

    A file that is TOML but no sound drive is taken as it is: what is wrong with it is then shown beside it.
    """
    check_size(len(content), name)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise refuse(name, _("is not UTF-8 text (byte {byte})").format(byte=error.start)) from None
    if name.lower().endswith(".json"):
        return dumps(loads_either(text, folder=folder, form="json", name=name))
    if not parsed(text, "toml", name):
        raise refuse(name, _("holds no table"))
    return text
