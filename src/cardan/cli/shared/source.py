"""Where a command takes its drive from."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.io import load, load_either, loads, loads_either
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.limits import MAX_BYTES, check_size, limited
from cardan.texts import _

from .failure import about
from .options import argument, flag, option

# Options that mean the same in every command.

DriveFile: TypeAlias = Annotated[Path, argument("FILE", _("Drive file, TOML or JSON; - reads standard input."))]
EitherFile: TypeAlias = Annotated[
    Path, argument("FILE", _("Drive or mechanism file, TOML or JSON; - reads standard input."))
]
AsJson: TypeAlias = Annotated[bool, flag("--json", _("Print everything as JSON, errors (on stderr) too."))]
AsCsv: TypeAlias = Annotated[bool, flag("--csv", _("Print the full table as CSV."))]
Plot: TypeAlias = Annotated[
    Path | None, option("--plot", "PATH", _("Draw the figure into PATH: .svg, .png, .pdf or .html."))
]
SpeedRpm: TypeAlias = Annotated[
    float | None, option("--speed-rpm", "RPM", _("Input speed, instead of the one in the file."))
]
MoreRows: TypeAlias = Annotated[
    list[Path] | None,
    option("--catalogue", "FILE", _("Catalogue file with more sizes, types, grades or standards; may be repeated.")),
]
Force: TypeAlias = Annotated[bool, flag("--force", _("Overwrite PATH where it is not FILE itself."))]


STDIN = Path("-")


def read(path: Path, catalogues: Sequence[Path] = ()) -> Drive:
    """Return the drive of a file, or of standard input when the path is ``-``; with rows of further catalogues."""
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


def read_either(path: Path) -> Drive | Mechanism:
    """Return the drive or mechanism of a file, or of standard input when the path is ``-``."""
    return either_with_text(path)[0]


def either_with_text(path: Path) -> tuple[Drive | Mechanism, str]:
    """Return the drive or mechanism of a file and the file's text; see `read_either`."""
    name = _("standard input") if path == STDIN else str(path)
    with about(name):
        if path != STDIN:
            return load_either(path), path.read_text("utf-8-sig")
        text = stdin_text()
        return loads_either(text, form=form_of(path, text), name=name), text


def form_of(path: Path, text: str) -> str:
    """Return ``"json"`` or ``"toml"``: by the suffix, or by the first sign of standard input."""
    if path == STDIN:
        return "json" if text.lstrip().startswith("{") else "toml"
    return "json" if path.suffix.lower() == ".json" else "toml"


def stdin_text() -> str:
    """Return what stands on standard input."""
    stream = getattr(sys.stdin, "buffer", None)
    try:
        if stream is None:
            return sys.stdin.read()
        content: bytes = stream.read(MAX_BYTES + 1 if limited() else -1)
        check_size(len(content), "")
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise refuse("", _("is not UTF-8 text (byte {byte})").format(byte=error.start)) from error


# Values that stand behind ``key=`` on the command line.

PLAIN = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
"""Numbers as people write them; JSON takes no leading point or plus, no point at the end."""


def value_of(text: str) -> Any:
    """Return a value: JSON, any usual number, or else the word as it stands."""
    try:
        return json.loads(text)
    except ValueError:
        return float(text) if re.fullmatch(PLAIN, text) else text
