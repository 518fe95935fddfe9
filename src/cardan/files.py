"""Writing a file as a whole or not at all, and finding the files that another one names."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

from cardan.errors import refuse
from cardan.texts import _, mark

REFUSALS = (
    mark("No such file or directory"),
    mark("Permission denied"),
    mark("Is a directory"),
    mark("Not a directory"),
    mark("File exists"),
    mark("File name too long"),
    mark("No space left on device"),
    mark("Read-only file system"),
    mark("Too many open files"),
    mark("Input/output error"),
)
"""What systems commonly say of a file."""


@dataclass(frozen=True, slots=True)
class Enclosed:
    """A folder that no name leads out of: for files from people one does not know."""

    path: Path  # the folder

    def __truediv__(self, name: str | Path) -> Path:
        try:
            there = (self.path / name).resolve()
        except (OSError, RuntimeError, ValueError):  # links in a circle, a zero byte
            raise refuse("name", _("{name} is not a file name").format(name=repr(str(name)))) from None
        if not there.is_relative_to(self.path.resolve()):
            raise refuse(str(name), _("leads out of the folder of the drive file"), "out_of_range")
        return there


def folder_of(folder: str | Path | Enclosed) -> Path | Enclosed:
    """Return the folder in which the files that another one names are looked for."""
    return Path(folder) if isinstance(folder, str) else folder


def refusal(error: OSError) -> str:
    """Return why the system refused a file, in its own words, without numbers.

    >>> refusal(FileNotFoundError(2, "No such file or directory"))
    'No such file or directory'
    """
    return _(error.strerror or str(error))


def write_text(path: Path, text: str) -> None:
    """Write a text file; a failure leaves what was there before. Raises InputError: the file cannot be written."""
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file; a failure leaves what was there before."""
    temporary: str | None = None
    try:
        path = path.resolve()  # through a link: the file is replaced, the link stays
        if path.exists() and not path.is_file():
            with path.open("wb") as stream:  # a device such as /dev/stdout
                stream.write(content)
            return
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
        os.chmod(temporary, mode)
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise refuse(str(path), _("cannot be written: {why}").format(why=refusal(error))) from None
    finally:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
