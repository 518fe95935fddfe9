"""Where a command takes its drive from."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.io import load, loads
from cardan.texts import _

from .failure import about

STDIN = Path("-")


def read(path: Path, catalogues: Sequence[Path] = ()) -> Drive:
    """Return the drive of a file, or of standard input when the path is ``-``; with rows of further catalogues.

    Raises RefusedError: everything that is wrong with the file, with its name.
    """
    if path == STDIN:
        return read_with_text(path, catalogues)[0]
    with about(str(path)):
        return load(path, catalogues=catalogues)


def read_with_text(path: Path, catalogues: Sequence[Path] = ()) -> tuple[Drive, str]:
    """Return the drive of a file and the file's text; see `read`."""
    if path != STDIN:
        drive = read(path, catalogues)
        with about(str(path)):
            return drive, path.read_text("utf-8-sig")
    name = _("standard input")
    with about(name):
        text = stdin_text()
        return loads(text, form=form_of(path, text), name=name, catalogues=catalogues), text


def form_of(path: Path, text: str) -> str:
    """Return ``"json"`` or ``"toml"``: by the suffix, or by the first sign of standard input."""
    if path == STDIN:
        return "json" if text.lstrip().startswith("{") else "toml"
    return "json" if path.suffix.lower() == ".json" else "toml"


def stdin_text() -> str:
    """Return what stands on standard input."""
    stream = getattr(sys.stdin, "buffer", None)
    try:
        return stream.read().decode("utf-8-sig") if stream else sys.stdin.read()
    except UnicodeDecodeError as error:
        raise refuse("", _("is not UTF-8 text (byte {byte})").format(byte=error.start)) from error
