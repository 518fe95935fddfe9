"""Files: drives in and out, results out."""

from __future__ import annotations

from .drive_file import dumps, load, loads
from .examples import example, example_mechanism, example_names, example_text, mechanism_names, recording_names
from .mechanism_file import load_either, load_mechanism, loads_either, loads_mechanism
from .reference import mechanism_reference, reference
from .schema import mechanism_schema, schema
from .starter import starter

__all__ = [
    "dumps",
    "example",
    "example_mechanism",
    "example_names",
    "example_text",
    "load",
    "load_either",
    "load_mechanism",
    "loads",
    "loads_either",
    "loads_mechanism",
    "mechanism_names",
    "mechanism_reference",
    "mechanism_schema",
    "recording_names",
    "reference",
    "schema",
    "starter",
]
