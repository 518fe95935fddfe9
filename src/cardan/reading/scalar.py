"""One value of a file: in SI, or what is wrong with it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from cardan.texts import _, mark
from cardan.units import Key, nearest

from .fields import WORD_OR_FLAG
from .ranges import in_range, out_of_range, range_code

SCALARS = (float, int, bool, str, WORD_OR_FLAG)  # types of one value
WANTED = {
    float: mark("a number"),
    int: mark("a whole number"),
    bool: mark("true or false"),
    WORD_OR_FLAG: mark("true, false or a word"),
}
TEXT = mark("a text")
ANY = Key("")  # key of a number of any size, which is no quantity of a drive


@dataclass(frozen=True, slots=True)
class Wrong:
    """What is wrong with a value: message and code of a problem."""

    message: str
    code: str = ""


def scalar(kind: Any, value: Any, key: Key, factor: float = 1.0, unit: str = "") -> Any:
    """Return a number in SI, a flag or a word as its type wants it, or what is `Wrong` with it.

    kind: one of `SCALARS`; value: as it stands in the file; key: what it means and may be.
    factor: to SI; below 0 where the key has the opposite sign.
    unit: in which the range is told; the preferred one when empty.
    """
    number = isinstance(value, int | float) and not isinstance(value, bool)
    fits = {
        float: number,
        int: number and isinstance(value, int),
        bool: isinstance(value, bool),
        WORD_OR_FLAG: isinstance(value, bool | str),
    }.get(kind, isinstance(value, str))
    if key.choices and (kind is str or isinstance(value, str)) and value not in key.choices:
        text = _("{value} is none of {choices}").format(value=as_given(value), choices=", ".join(key.choices))
        return Wrong(text + nearest_of(value, key.choices), "out_of_range")
    if not fits:
        code = "" if not number or kind is not int else "out_of_range" if math.isfinite(value) else "not_finite"
        return Wrong(
            _("must be {wanted}, not {given}").format(wanted=_(WANTED.get(kind, TEXT)), given=as_given(value)), code
        )
    if kind is float or kind is int:
        result = in_si(value, factor) + 0.0
        if in_range(key, result) or (key == ANY and math.isfinite(result)):
            return value if kind is int else result
        text = out_of_range(as_given(value), key, result, unit, mirrored=factor < 0)
        return Wrong(text, range_code(key, result))
    if isinstance(value, str) and not value.isascii() and any("\ud800" <= letter <= "\udfff" for letter in value):
        return Wrong(_("holds half a character (a lone surrogate), which no file can keep"))
    return value


def in_si(value: float, factor: float) -> float:
    """Return a number in SI, infinite where it is a whole number that no float can hold."""
    try:
        return float(value) * factor
    except OverflowError:
        return math.inf


def unknown_key(key: str, known: Iterable[str]) -> str:
    """Return what to say of a key that a table does not know."""
    every = list(known)
    near = nearest(key, every)
    if near:
        return _("unknown key; the nearest known one is {near}").format(near=near)
    return _("unknown key; known here: {known}").format(known=", ".join(every))


def nearest_of(word: Any, known: Iterable[str]) -> str:
    """Return what to add of the known word that is nearest, nothing where none is."""
    near = nearest(word, list(known)) if isinstance(word, str) else None
    return _("; the nearest is {near}").format(near=near) if near else ""


def as_given(value: Any) -> str:
    """Return a value as the user wrote it, shortened."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return _("a table")
    if isinstance(value, list):
        return _("a list")
    if value is None:
        return "null"
    text = repr(value) if isinstance(value, str | int | float) else str(value)
    return text if len(text) <= 40 else text[:37] + "..."
