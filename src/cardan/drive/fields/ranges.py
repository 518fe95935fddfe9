"""Which numbers and words the fields of a drive may hold, and what to say of others."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any
from unicodedata import category

from cardan.drive.shaft import Shaft
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import KEY, Key, factor, label, preferred

HUGE = 1e12
"""Numbers beyond this, in SI, are slips of the pen; their squares would leave the range of floating point numbers."""


def shown(value: float, key: Key, unit: str = "") -> str:
    """Return a value in SI as the user would write it, in the preferred unit or a given one.

    Examples
    --------
    >>> shown(0.02, Key("", "length")), shown(0.0254, Key("", "length"), "in")
    ('20 mm', '1 in')
    """
    if key.dimension is None:
        return f"{value:.6g}"
    unit = unit or preferred(key.dimension)
    text = label(unit)
    return f"{value / factor(key.dimension, unit):.6g}{'' if text == '°' else ' '}{text}"


def allowed(key: Key, unit: str = "", *, mirrored: bool = False) -> str:
    """Return the allowed range of a key in words.

    Parameters
    ----------
    key : Key
        The key.
    unit : str
        Unit of the words; the preferred one when empty.
    mirrored : bool
        The range of the key with the opposite sign.

    Examples
    --------
    >>> allowed(Key("", "angle", low=0.0, below=1.0), "rad")
    'at least 0 rad and less than 1 rad'
    """
    low, above, high, below = key.low, key.above, key.high, key.below
    if mirrored:
        low, above, high, below = (0.0 - bound for bound in (high, below, low, above))
    parts = []
    if low > -math.inf:
        parts.append(_("at least {value}").format(value=shown(low, key, unit)))
    if above > -math.inf:
        parts.append(_("more than {value}").format(value=shown(above, key, unit)))
    if high < math.inf:
        parts.append(_("at most {value}").format(value=shown(high, key, unit)))
    if below < math.inf:
        parts.append(_("less than {value}").format(value=shown(below, key, unit)))
    return _(" and ").join(parts) or _("a finite number")


def in_range(key: Key, value: float) -> bool:
    """Tell whether a value in SI is allowed for a key, and no slip of the pen."""
    return key.allows(value) and abs(value) <= HUGE


def out_of_range(given: str, key: Key, value: float, unit: str = "", *, mirrored: bool = False) -> str:
    """Return what to say of a number that is not `in_range`, as it was given and as a value in SI."""
    if key.allows(value):
        return _("{value} is not allowed; no drive has such a number").format(value=given)
    return _("{value} is not allowed; allowed is {allowed}").format(
        value=given, allowed=allowed(key, unit, mirrored=mirrored)
    )


def range_code(key: Key, value: float) -> str:
    """Return the word of `cardan.errors.CODES` for a number in SI that is not `in_range`.

    Examples
    --------
    >>> range_code(Key("", "length", above=0.0), 0.0), range_code(Key("", "torque", low=0.0), -1.0)
    ('not_positive', 'negative')
    >>> range_code(Key("", "angle", low=0.0, below=1.57), -0.1), range_code(Key(""), math.nan)
    ('out_of_range', 'not_finite')
    """
    if not math.isfinite(value):
        return "not_finite"
    if key.above == 0.0 and value <= 0.0:
        return "not_positive"
    if key.low == 0.0 and value < 0.0 and key.high == key.below == math.inf:
        return "negative"
    return "out_of_range"


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
