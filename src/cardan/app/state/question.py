"""A question about the drive, or the mechanism, that a user works on, as it goes to another process."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from cardan.answers.reader import USUAL, Reader
from cardan.drive.drive import Drive
from cardan.files import Enclosed
from cardan.mechanisms import Mechanism

from .session import Session

Progress: TypeAlias = Callable[[float], object]


@dataclass(frozen=True, eq=False, kw_only=True)
class Question:
    """What somebody wants to know."""

    # a question of `cardan.register.QUESTIONS`, `VERDICTS`, `REMEDIES`, one of `papers`, or `recordings.DIAGNOSIS`
    name: str
    drive: Drive | Mechanism  # about which drive, or mechanism
    folder: Path  # where files that the drive names are looked for, and nowhere else
    language: str = "en"
    reader: Reader = USUAL  # in which units, with which decimal sign
    choices: Mapping[str, Any] = field(default_factory=dict)  # what the user chose beside the drive

    @property
    def key(self) -> str:
        """The same for questions with the same answer in the same words and units."""
        seen = (self.matter, sorted(self.reader.units.items()), self.reader.sign)
        return hashlib.sha256(pickle.dumps(seen)).hexdigest()

    @property
    def matter(self) -> str:
        """The same for questions with the same answer in the same language, whatever units it is told in."""
        files = []
        named: tuple[str, ...] = ()
        if isinstance(self.drive, Drive):
            named = (*self.drive.settings.catalogues, *filter(None, [self.drive.report.logo]))
        for name in named:
            try:
                told = (Enclosed(self.folder) / name).stat()
                files.append((name, told.st_mtime_ns, told.st_size))
            except Exception:  # a file that is not there, or not to be read: the answer will say so
                files.append((name, 0, 0))
        whole = (self.name, self.drive, str(self.folder), self.language, sorted(self.choices.items()), files)
        return hashlib.sha256(pickle.dumps(whole)).hexdigest()


def asked(session: Session, name: str, **choices: Any) -> Question | None:
    """Return the question about the drive, or the mechanism, that a user works on; None while there is none."""
    drive = session.document.mechanism if session.document.of_mechanism else session.drive
    if drive is None:
        return None
    folder = session.workspace.folder
    language = session.choices.language
    return Question(name=name, drive=drive, folder=folder, language=language, reader=session.reader, choices=choices)
