"""Formats of results: one module each, with ``suffix`` and ``content``, and its name in `FORMATS`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from cardan.errors import refuse
from cardan.files import write_bytes
from cardan.texts import _

from . import csv, json, xlsx

FORMATS = {module.suffix: module for module in (csv, json, xlsx)}  # suffix -> module


def write(result: Any, path: Path) -> None:
    """Write a result to a file in the format of its suffix."""
    module = FORMATS.get(path.suffix.lower())
    if module is None:
        known = ", ".join(FORMATS)
        raise refuse(
            str(path),
            _("{suffix} is not a format of results; known are {known}").format(suffix=path.suffix, known=known),
        )
    write_bytes(path, module.content(result))
