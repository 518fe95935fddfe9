"""Files: drives in and out, results out."""

from __future__ import annotations

from .drive_file import dumps, load, load_either, load_mechanism, loads, loads_either, loads_mechanism
from .examples import example, example_mechanism, example_names, example_text, recording_names, starter
from .schema import mechanism_reference, mechanism_schema, reference, schema
from .shipped import mechanism_names

__all__ = [
    "dumps", "example", "example_mechanism", "example_names", "example_text", "load", "load_either", "load_mechanism",
    "loads", "loads_either", "loads_mechanism", "mechanism_names", "mechanism_reference", "mechanism_schema",
    "recording_names", "reference", "schema", "starter",
]  # fmt: skip
