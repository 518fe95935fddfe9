"""Reading a table of a file key by key: every problem is noted with its path, and unknown keys with the nearest."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from cardan.errors import InputError, Problem
from cardan.texts import _

from .scalar import ANY, Wrong, as_given, scalar, unknown_key


@dataclass(kw_only=True)
class Table:
    """A table of a file while it is read."""

    given: Mapping[str, Any]  # its keys and values
    path: str = ""  # where it stands in the file; empty for the file itself
    problems: list[Problem] = field(default_factory=list)  # what was found; tables within share it
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
        return str(self._scalar(key, default, str, choices) or "")

    def number(self, key: str, default: float | None = None) -> float:
        """Return the finite number of a key; required when there is no default."""
        return float(self._scalar(key, default, float) or 0.0)

    def whole(self, key: str, default: int | None = None) -> int:
        """Return the whole number of a key; required when there is no default."""
        return int(self._scalar(key, default, int) or 0)

    def items(self, key: str, *, required: bool = False) -> list[Any]:
        """Return the list of a key, empty when it is not given."""
        return list(self._list(key, None if required else [], list, _("a list")) or [])

    def texts(self, key: str) -> list[str]:
        """Return the list of texts of a key, empty when it is not given."""
        found = self.items(key)
        if any(not isinstance(one, str) for one in found):
            self.refuse(key, _("a list of texts is needed"))
        return [one for one in found if isinstance(one, str)]

    def table(self, key: str) -> Table:
        """Return the table of a key, an empty one when it is not given."""
        value = self._list(key, {}, dict, _("a table"))
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
                self.refuse(key, unknown_key(key, self.known))

    def _scalar(self, key: str, default: Any, kind: type, choices: Sequence[str] = ()) -> Any:
        value = self._taken(key, default, {float: _("a number"), int: _("a whole number")}.get(kind, _("a text")))
        found = default if value is None else scalar(kind, value, replace(ANY, choices=tuple(choices)))
        if isinstance(found, Wrong):
            self.refuse(key, found.message)
            return default
        return found

    def _list(self, key: str, default: Any, kind: type, wanted: str) -> Any:
        value = self._taken(key, default, wanted)
        if value is not None and not isinstance(value, kind):
            self.refuse(key, _("must be {wanted}, not {given}").format(wanted=wanted, given=as_given(value)))
            return default
        return value

    def _taken(self, key: str, default: Any, wanted: str) -> Any:
        self.known[key] = None
        if key not in self.given and default is None:
            self.refuse(key, _("missing; {wanted} is needed").format(wanted=wanted))
        return self.given.get(key, default)
