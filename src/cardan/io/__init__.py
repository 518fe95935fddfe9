"""Files: drives in and out, results out."""

from __future__ import annotations

from .drive_file import dumps, load, loads, save
from .edit import edit
from .examples import example, example_names, example_text
from .reference import reference
from .schema import schema
from .starter import starter

__all__ = [
    "dumps",
    "edit",
    "example",
    "example_names",
    "example_text",
    "load",
    "loads",
    "reference",
    "save",
    "schema",
    "starter",
]
