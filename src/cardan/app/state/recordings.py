"""The recording that one user has open: where its file is, and what he says of it. Nobody else sees it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any
from weakref import WeakSet, finalize

from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.files import refusal
from cardan.io.examples import example_file
from cardan.io.signals import SIGNAL_FORMATS
from cardan.report.recorded import Recorded, Said, recorded
from cardan.texts import _

from .document import MAX_LISTED, Workspace

MAX_RECORDING = 100_000_000  # bytes of a recording that a user may send
DIAGNOSIS = "diagnosis"  # the question that is answered from a recording


@dataclass(frozen=True, kw_only=True)
class Recording:
    """A recording that is open."""

    name: str  # as the user calls it
    path: Path  # its file
    stamp: tuple[int, int]  # time of its last change and its size: another state of the file is another recording
    said: Said = field(default_factory=Said)  # what the user says of it


class Recordings:
    """The recording of one user, sent, or opened from the folder.

    workspace: the folder with the user's files; opened: the one that is open.
    """

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace
        self.opened: Recording | None = None
        self._delete_sent: Callable[[], object] = _nothing
        self._delete_coming: Callable[[], object] = _nothing
        _ALL.add(self)

    def names(self) -> tuple[str, ...]:
        """Return the recordings of the folder, the one changed last first."""
        found = [
            path
            for path in self.workspace.folder.glob("*")
            if path.suffix.lower() in SIGNAL_FORMATS and path.is_file() and not path.name.startswith(".")
        ]
        found.sort(key=lambda path: -path.stat().st_mtime)
        return tuple(path.name for path in found[:MAX_LISTED])

    def open(self, name: str) -> None:
        """Open a recording of the folder."""
        self._open(name, self.workspace.place(name))

    def open_example(self, name: str) -> None:
        """Open a shipped recording."""
        path = example_file(name)
        self._open(path.name, path)

    def room(self, name: str) -> Path:
        """Return where the content of a file that the user sends is put; `take` opens it then.

        name: as the browser calls it; nothing but its letters and its end are taken from it.
        """
        self._delete_coming()
        folder = Path(mkdtemp(prefix="cardan-"))
        self._delete_coming = finalize(self, rmtree, folder, ignore_errors=True)
        plain = re.sub(r"[^\w. -]+", "-", name.replace("\\", "/").rpartition("/")[2])[-80:].strip(". -")
        return folder / (plain or "recording")

    def take(self, name: str, path: Path) -> None:
        """Open the file that was put into its room; what was sent before is deleted."""
        if path.stat().st_size > MAX_RECORDING:
            self._delete_coming()
            raise refuse(name, _("larger than {size} MB").format(size=MAX_RECORDING // 10**6), "out_of_range")
        self._open(name, path)
        self._delete_sent()
        self._delete_sent, self._delete_coming = self._delete_coming, _nothing

    def say(self, **changes: Any) -> None:
        """Say more of the recording that is open, or something else."""
        if self.opened is not None:
            self.opened = replace(self.opened, said=replace(self.opened.said, **changes))

    def close(self) -> None:
        """Close the recording; what was sent is deleted."""
        self.opened = None
        self._delete_sent()
        self._delete_coming()

    def _open(self, name: str, path: Path) -> None:
        try:
            told = path.stat()
        except OSError as error:
            raise refuse(name, refusal(error)) from None
        self.opened = Recording(name=name, path=path, stamp=(told.st_mtime_ns, told.st_size))


_ALL: WeakSet[Recordings] = WeakSet()


def close_all() -> None:
    """Close the recordings of all users: the server ends, however it is made to."""
    for one in tuple(_ALL):
        one.close()


def _nothing() -> None:
    """Stand where nothing was sent."""


def heard(
    drive: Drive, recording: Recording, known: Catalogue | None, progress: Callable[[float], object] | None = None
) -> Recorded:
    """Return what a recording tells of a drive, in the language spoken."""
    return recorded(recording.path, drive, recording.said, known=known, progress=progress)
