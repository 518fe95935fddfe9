"""Writes changed values into a copy of a drive file, its comments kept."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from cardan.drive.drive import Drive
from cardan.drive.fields.paths import with_values
from cardan.io import dumps
from cardan.io.edit import edit

from .output import write_text


def write_changed(drive: Drive, text: str, values: Mapping[str, Any], out: Path) -> None:
    """Write a drive file with other values.

    drive: the drive as it stands in the file; values: path with unit -> value; out: where to, TOML or JSON.
    """
    if is_json(out, text):
        form = "json" if out.suffix.lower() == ".json" else "toml"
        written = dumps(with_values(drive, values), form=form)
    else:
        written = edit(text, values) if values else text
    write_text(out, written, "--out")


def is_json(out: Path, text: str) -> bool:
    """Return whether a file is written or was read as JSON, so that there are no comments to keep."""
    return out.suffix.lower() == ".json" or text.lstrip().startswith("{")
