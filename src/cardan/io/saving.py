"""Anything into a file: drives, mechanisms, recordings, results."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.files import write_text
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.diagnosis.signals.signal import Signal
from cardan.texts import _

from .drive_file import dumps
from .formats import write
from .shifts import keep_rows
from .signals import write as write_signal


def save(thing: Any, path: str | Path) -> None:
    """Write a drive, a mechanism, a recording or a result to a file; the suffix says how.

    Parameters
    ----------
    thing : Drive, Mechanism, Signal or result
        A drive or a mechanism is written as ``.toml`` or ``.json``, with the CSV files that it names beside it where
        there are none yet; a recording as ``.csv``, ``.wav``, ``.uff`` or ``.tdms``; a result in one of the formats of
        `cardan.io.formats`.
    path : str or Path
        Replaced as a whole or not at all.

    Raises
    ------
    InputError
        The suffix is not known, the file cannot be written, or a CSV file there holds other rows than the drive.

    See Also
    --------
    load

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from cardan import Drive, load, save
    >>> with TemporaryDirectory() as folder:
    ...     save(Drive.from_angles([0.1]), Path(folder) / "drive.toml")
    ...     load(Path(folder) / "drive.toml").form
    'angles'
    """
    where = Path(path)
    if not isinstance(thing, Drive | Mechanism):
        if isinstance(thing, Signal):
            write_signal(thing, where)
            return
        write(thing, where)
        return
    form = where.suffix.lower().lstrip(".")
    if form not in ("toml", "json"):
        raise refuse(str(where), _("a drive is saved as .toml or .json"))
    text = dumps(thing, form=form)
    if isinstance(thing, Drive):
        keep_rows(thing, where.parent)
    write_text(where, text)
