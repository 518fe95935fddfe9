"""The folder a user works in: no path outside it is read or written."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from cardan.errors import refuse
from cardan.files import Enclosed, write_text
from cardan.io.drive_file import text_of
from cardan.texts import _

MAX_UPLOAD = 2_000_000
"""Bytes of a file that a user may send."""

MAX_LISTED = 200
"""Files that are listed."""


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
        """Return the text of a file.

        Raises InputError: there is none of that name in the folder, or it is no text.
        """
        return text_of(self.place(name))[0]

    def write(self, name: str, text: str) -> str:
        """Write a file and return its name, with .toml at its end.

        Raises InputError: the name is none, leads out of the folder, or the file cannot be written.
        """
        full = name if name.endswith(".toml") or not name else f"{name}.toml"
        write_text(self.place(full), text)
        return full

    def place(self, name: str) -> Path:
        """Return where the file of a name is."""
        if not re.fullmatch(r"[^/\\\x00-\x1f:*?\"<>|.][^/\\\x00-\x1f:*?\"<>|]{0,120}", name):
            raise refuse("name", _("{name} is not a file name").format(name=repr(name)))
        return self.enclosed / name
