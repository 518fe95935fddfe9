"""Reading a table of a file key by key: every problem is noted with its path, and unknown keys with the nearest."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from cardan.errors import InputError, Problem
from cardan.texts import _
from cardan.units import nearest

NUMBER = (int, float)
"""Kinds of a number."""


@dataclass(kw_only=True)
class Table:
    """A table of a file while it is read.

    Attributes
    ----------
    given : mapping
        Its keys and values.
    path : str
        Where it stands in the file; empty for the file itself.
    problems : list of Problem
        What was found; tables within share it.
    """

    given: Mapping[str, Any]
    path: str = ""
    problems: list[Problem] = field(default_factory=list)
    known: dict[str, None] = field(default_factory=dict)

    def at(self, key: str) -> str:
        """Return the path of a key."""
        return f"{self.path}.{key}" if self.path else key

    def refuse(self, key: str, message: str) -> None:
        """Note a problem with a key."""
        self.problems.append(Problem(self.at(key) if key else self.path, message))

    def follow(self, key: str, error: InputError) -> None:
        """Note the problems of what was made of a key."""
        for one in error.problems:
            inner = f"{self.at(key) if key else self.path}: {one.field}" if one.field else self.at(key)
            self.problems.append(Problem(inner.removeprefix(": "), one.message, one.code))

    def has(self, key: str) -> bool:
        """Tell whether a key is given, and take note of it."""
        self.known[key] = None
        return key in self.given

    def text(self, key: str, default: str | None = None, *, choices: Sequence[str] = ()) -> str:
        """Return the text of a key; required when there is no default."""
        value = self._taken(key, default, str, _("a text"))
        if choices and value not in choices and key in self.given and isinstance(self.given[key], str):
            self.refuse(key, _("{value} is none of {choices}").format(value=repr(value), choices=", ".join(choices)))
        return str(value or "")

    def number(self, key: str, default: float | None = None) -> float:
        """Return the finite number of a key; required when there is no default."""
        value = self._taken(key, default, NUMBER, _("a number"))
        if isinstance(value, bool) or (value is not None and not abs(value) <= sys.float_info.max):
            self.refuse(key, _("{value} is not a finite number").format(value=repr(value)[:40]))
            return 0.0
        return float(value or 0.0)

    def whole(self, key: str, default: int | None = None) -> int:
        """Return the whole number of a key; required when there is no default."""
        value = self._taken(key, default, int, _("a whole number"))
        if isinstance(value, bool):
            self.refuse(key, _("{value} is not a whole number").format(value=value))
            return 0
        return int(value or 0)

    def items(self, key: str, *, required: bool = False) -> list[Any]:
        """Return the list of a key, empty when it is not given."""
        return list(self._taken(key, None if required else [], list, _("a list")) or [])

    def texts(self, key: str) -> list[str]:
        """Return the list of texts of a key, empty when it is not given."""
        found = self.items(key)
        if any(not isinstance(one, str) for one in found):
            self.refuse(key, _("a list of texts is needed"))
        return [one for one in found if isinstance(one, str)]

    def table(self, key: str) -> Table:
        """Return the table of a key, an empty one when it is not given."""
        value = self._taken(key, {}, dict, _("a table"))
        return Table(given=value or {}, path=self.at(key), problems=self.problems)

    def tables(self, key: str, *, required: bool = False) -> Iterator[Table]:
        """Yield the tables of a list of them."""
        for k, value in enumerate(self.items(key, required=required)):
            if isinstance(value, dict):
                yield Table(given=value, path=f"{self.at(key)}[{k}]", problems=self.problems)
            else:
                self.problems.append(Problem(f"{self.at(key)}[{k}]", _("a table is needed")))

    def finish(self) -> None:
        """Note every key that nobody asked for."""
        for key in self.given:
            if key not in self.known:
                near = nearest(key, self.known)
                text = _("unknown key; the nearest is {near}") if near else _("unknown key; known here: {known}")
                self.refuse(key, text.format(near=near, known=", ".join(self.known)))

    def _taken(self, key: str, default: Any, kind: Any, wanted: str) -> Any:
        self.known[key] = None
        if key not in self.given:
            if default is None:
                self.refuse(key, _("missing; {wanted} is needed").format(wanted=wanted))
            return default
        value = self.given[key]
        if not isinstance(value, kind):
            text = _("{value} does not fit this key, which holds {wanted}")
            self.refuse(key, text.format(value=repr(value)[:40], wanted=wanted))
            return default
        return value
