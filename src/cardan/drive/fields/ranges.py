"""Which numbers and texts of a drive are out of range."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any
from unicodedata import category

from cardan.drive.shaft import Shaft
from cardan.errors import Problem
from cardan.reading.ranges import in_range, out_of_range, range_code, shown
from cardan.texts import _
from cardan.units import KEY, Key


def range_problems(thing: Any, path: str = "") -> Iterator[Problem]:
    """Yield every number of a dataclass tree that is out of range or not finite, and every unprintable text."""
    for field in fields(thing):
        value = getattr(thing, field.name)
        here = f"{path}.{field.name}" if path else field.name
        if isinstance(value, tuple) and value and is_dataclass(value[0]):
            for index, item in enumerate(value):
                place = item.number - 1 if isinstance(item, Shaft) else index
                yield from range_problems(item, f"{here}[{place}]")
        elif is_dataclass(value):
            yield from range_problems(value, here)
        elif isinstance(value, str):
            yield from _text_problems(value, here, lines=field.name == "note")
            choices = field.metadata[KEY].choices if KEY in field.metadata else ()
            if choices and value not in choices:
                text = _("{value} is none of {choices}")
                yield Problem(here, text.format(value=repr(value), choices=", ".join(choices)))
        elif KEY in field.metadata and not isinstance(value, bool):
            yield from _number_problems(value, field.metadata[KEY], here)


def _text_problems(text: str, path: str, *, lines: bool) -> Iterator[Problem]:
    """Yield a problem if a text holds a character that terminals obey instead of printing."""
    found = next((sign for sign in text if category(sign) == "Cc" and not (lines and sign in "\n\r\t")), None)
    if found is not None:
        yield Problem(path, _("holds the control character {sign}; write plain text").format(sign=ascii(found)))


def _number_problems(value: Any, key: Key, path: str) -> Iterator[Problem]:
    if isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from _number_problems(item, key, f"{path}[{index}]")
    elif isinstance(value, int | float) and not in_range(key, value):
        yield Problem(path, out_of_range(shown(value, key), key, value), range_code(key, value))
