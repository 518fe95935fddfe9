"""Which numbers and texts of a drive are out of range."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any
from unicodedata import category

from cardan.drive.shaft import Shaft
from cardan.errors import Problem
from cardan.reading.ranges import in_range, out_of_range, range_code, shown
from cardan.texts import _
from cardan.units import KEY, Key


@cache
def _keys(kind: type) -> tuple[tuple[str, Key | None], ...]:
    """Return the names of the fields of a dataclass, each with its key if it has one."""
    return tuple((field.name, field.metadata.get(KEY)) for field in fields(kind))


def range_problems(thing: Any, path: str = "") -> Iterator[Problem]:
    """Yield every number of a dataclass tree that is out of range or not finite, and every unprintable text."""
    for name, key in _keys(thing.__class__):
        value = getattr(thing, name)
        if value is None or isinstance(value, bool):
            continue
        if isinstance(value, float) and (key is None or in_range(key, value)):
            continue
        here = f"{path}.{name}" if path else name
        if isinstance(value, tuple) and value and is_dataclass(type(value[0])):
            for index, item in enumerate(value):
                place = item.number - 1 if isinstance(item, Shaft) else index
                yield from range_problems(item, f"{here}[{place}]")
        elif is_dataclass(type(value)):
            yield from range_problems(value, here)
        elif isinstance(value, str):
            yield from _text_problems(value, here, lines=name == "note")
            choices = key.choices if key is not None else ()
            if choices and value not in choices:
                text = _("{value} is none of {choices}")
                yield Problem(here, text.format(value=repr(value), choices=", ".join(choices)))
        elif key is not None:
            yield from _number_problems(value, key, here)


def _text_problems(text: str, path: str, *, lines: bool) -> Iterator[Problem]:
    """Yield a problem if a text holds a character that terminals obey instead of printing."""
    if text.isprintable():
        return
    found = next((sign for sign in text if category(sign) == "Cc" and not (lines and sign in "\n\r\t")), None)
    if found is not None:
        yield Problem(path, _("holds the control character {sign}; write plain text").format(sign=ascii(found)))


def _number_problems(value: Any, key: Key, path: str) -> Iterator[Problem]:
    if isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from _number_problems(item, key, f"{path}[{index}]")
    elif isinstance(value, int | float) and not in_range(key, value):
        yield Problem(path, out_of_range(shown(value, key), key, value), range_code(key, value))
