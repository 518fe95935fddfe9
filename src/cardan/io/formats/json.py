"""Results as JSON: every field and property under its name, SI, full precision; drives as in a drive file."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import tree_of
from cardan.errors import InputError

suffix = ".json"


def content(result: Any) -> bytes:
    """Return a result as the bytes of a JSON file."""
    return text(result).encode()


def text(result: Any) -> str:
    """Return a result as JSON text."""
    return json.dumps(plain(result), ensure_ascii=False, indent=2, allow_nan=False) + "\n"


def plain(value: Any) -> Any:
    """Return a result as dicts, lists, numbers and words: arrays as lists, complex as [re, im], not finite as null.

    Properties that need what the result does not have, such as a speed, are left out.
    """
    if is_dataclass(value) and not isinstance(value, type):
        return tree_of(value) if isinstance(value, Drive) else dict(_named(value))
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, Enum):
        return value.name.lower()
    if isinstance(value, str | bool | int) or value is None:
        return value
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return _number(value)


def _named(thing: Any) -> Iterator[tuple[str, Any]]:
    """Yield fields and public properties of a dataclass."""
    for one in fields(thing):
        yield one.name, plain(getattr(thing, one.name))
    for cls in reversed(type(thing).__mro__):
        for name, member in vars(cls).items():
            if isinstance(member, property) and not name.startswith("_"):
                with suppress(InputError):
                    yield name, plain(getattr(thing, name))


def _number(value: Any) -> Any:
    array = np.asarray(value)
    if array.dtype.kind not in "bifcu":
        return str(value)
    if array.ndim:
        return [_number(item) for item in array]
    number = array.item()
    if isinstance(number, complex):
        return [_number(number.real), _number(number.imag)]
    return number if not isinstance(number, float) or math.isfinite(number) else None
