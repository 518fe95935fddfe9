"""Results as JSON: every field under its name, SI, full precision."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any

import numpy as np

suffix = ".json"


def text(result: Any) -> str:
    """Return a result as JSON text."""
    return json.dumps(plain(result), ensure_ascii=False, indent=2, allow_nan=False) + "\n"


def plain(value: Any) -> Any:
    """Return a result as dicts, lists, numbers and words: arrays as lists, complex as [re, im], not finite as null.

    Examples
    --------
    >>> plain({"a": np.asarray([1.0, np.nan]), "b": 1 + 2j})
    {'a': [1.0, None], 'b': [1.0, 2.0]}
    """
    if is_dataclass(value) and not isinstance(value, type):
        return {one.name: plain(getattr(value, one.name)) for one in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, Enum):
        return value.name.lower()
    if isinstance(value, str | bool | int) or value is None:
        return value
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return _number(value)


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
