"""From nested tables to dataclasses: every problem of a file at once, each on the path the user wrote."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, is_dataclass
from typing import Any, get_args, get_origin

from cardan.errors import InputError, Problem
from cardan.texts import _

from .fields import WORD_OR_FLAG, Field, fields_of, spellings_of
from .scalar import Wrong, as_given, nearest_of, scalar, unknown_key


def _near(cls: type, key: str) -> tuple[str, str]:
    """Return what to say of a key that a class does not know; which field it meant is not guessed."""
    return unknown_key(key, spellings_of(cls)), ""


@dataclass(frozen=True, kw_only=True)
class Form:
    """What a reader must know of a sort of file beside its classes."""

    spelled: Callable[[str, Any], str]  # path in Python and class of the whole -> path as we write it
    # base class -> its kinds by the value of the key ``kind``, and the default kind
    kinds: Mapping[type, tuple[Mapping[str, type], str | None]] = field(default_factory=dict)
    # class of a table that may be given by a name alone -> field that holds the name
    named: Mapping[type, str] = field(default_factory=dict)
    # class and key it does not know -> what to say of it, and the field it meant
    unknown: Callable[[type, str], tuple[str, str]] = _near
    # name of a field that is read in a way of its own -> function of value and reading place
    own: Mapping[str, Callable[[Any, Place], Any]] = field(default_factory=dict)
    # what is done to each thing that was read, at its reading place
    finished: Callable[[Any, Place], Any] = lambda thing, _place: thing
    # class, table and place in a list -> its index in paths
    index: Callable[[Any, Any, int], int] = lambda _cls, _table, k: k


@dataclass(slots=True)
class Findings:
    """What a reading brings to light.

    A field that was refused gets a placeholder that keeps the whole in its form, so that the rest of the file can
    still be judged; what is then said about the placeholder is left out.
    """

    root: Any  # what the file describes
    form: Form
    at: str = ""  # path of the whole in its file
    problems: list[Problem] = field(default_factory=list)  # with paths as written in the file
    spelled: dict[str, str] = field(default_factory=dict)  # path in Python -> path as written
    doubtful: set[str] = field(default_factory=set)  # paths in Python of fields that were refused

    def follow(self, problem: Problem) -> None:
        """Note a problem of the whole, unless it only follows from another one."""
        path = problem.field
        if not any(_within(path, other) or _within(other, path) for other in self.doubtful):
            self.problems.append(Problem(self.as_written(path), problem.message))

    def as_written(self, path: str) -> str:
        """Return the path of a field as the file spells it, or as we would."""
        whole, rest = path, ""
        while whole:
            if whole in self.spelled:
                return self.spelled[whole] + rest
            if not whole.endswith("]"):
                break
            whole = whole[: whole.rindex("[")]
            rest = path[len(whole) :]
        return _joined(self.at, self.form.spelled(path, self.root))


def _within(path: str, other: str) -> bool:
    """Tell whether a path is another one or leads further into it."""
    return path == other or (path.startswith(other) and path[len(other)] in ".[")


@dataclass(frozen=True, slots=True)
class Place:
    """Where in a file a value stands, and what was found there: its path as written, and in Python."""

    found: Findings
    written: str = ""
    path: str = ""

    def key(self, key: str, name: str = "") -> Place:
        """Return the place of a key, which is the field ``name`` in Python."""
        return Place(self.found, _joined(self.written, key), _joined(self.path, name or key))

    def item(self, k: int) -> Place:
        """Return the place of an entry of a list."""
        return Place(self.found, f"{self.written}[{k}]", f"{self.path}[{k}]")

    def refuse(self, message: str, code: str = "") -> None:
        """Note a problem here, and that this field is not to be trusted."""
        self.found.problems.append(Problem(self.written, message, code))
        self.found.doubtful.add(self.path)


def _joined(path: str, name: str) -> str:
    return f"{path}.{name}" if path else name


def read_table(cls: Any, table: Mapping[str, Any], form: Form, at: str = "") -> tuple[Any, list[Problem]]:
    """Return the thing of a class with the keys of a file that a table describes, and all that is wrong with it.

    table: the table, with the tables in it; at: path of the table in the file.
    """
    found = Findings(cls, form, at)
    thing = None
    try:
        thing = cls(**values_of(cls, table, Place(found, at)))
    except InputError as error:
        for problem in error.problems:
            found.follow(problem)
        if not found.problems:  # pragma: no cover - a problem of a placeholder has its own in the file
            raise
    return thing, found.problems


def values_of(cls: type, table: Mapping[str, Any], here: Place) -> dict[str, Any]:
    """Return the arguments of a class from a table, placeholders where the table has nothing fit."""
    known, fields = spellings_of(cls), fields_of(cls)
    used: dict[str, str] = {}
    values: dict[str, Any] = {}
    for key, value in table.items():
        if key not in known:
            _note_unknown(cls, str(key), here)
            continue
        name, factor = known[key]
        place = here.key(key, name)
        if name in used:
            place.refuse(_("{other} gives the same already").format(other=used[name]))
            continue
        used[name] = key
        here.found.spelled[place.path] = place.written
        values[name] = _value(fields[name], fields[name].type, value, (key, factor), place)
    for name, one in fields.items():
        place = here.key(one.spelling, name)
        if name in used:
            continue
        if place.path in here.found.doubtful:
            values[name] = _blank(one.type, here)
        elif one.required:
            place.refuse(_("missing: {doc}").format(doc=_(one.key.doc)), "missing")
            values[name] = _blank(one.type, here)
    return values


def _note_unknown(cls: type, key: str, here: Place) -> None:
    message, name = here.found.form.unknown(cls, key)
    if name:
        here.key(key, name).refuse(message)
    else:
        here.found.problems.append(Problem(here.key(key).written, message))


def _value(one: Field, kind: Any, value: Any, spelling: tuple[str, float], here: Place) -> Any:
    """Return a value in SI as the field's type wants it, or a placeholder after noting what is wrong."""
    form = here.found.form
    if one.name in form.own and get_origin(kind) is tuple:
        return form.own[one.name](value, here)
    if get_origin(kind) is tuple:
        return _list(one, kind, value, spelling, here)
    if kind in form.kinds:
        return _kind(kind, value, here)
    if is_dataclass(kind):
        if kind in form.named and isinstance(value, str):
            return form.finished(kind(**{form.named[kind]: value}), here)  # type: ignore[index, operator]
        if not is_table(value, here):
            return _blank(kind, here)
        return form.finished(kind(**values_of(kind, value, here)), here)  # type: ignore[arg-type, operator]
    key, factor = spelling
    result = scalar(kind, value, one.key, factor, one.unit(key))
    if isinstance(result, Wrong):
        here.refuse(result.message, result.code)
        return _blank(kind, here)
    return result


def _list(one: Field, kind: Any, value: Any, spelling: tuple[str, float], here: Place) -> Any:
    parts = get_args(kind)
    tables = parts[0] in here.found.form.kinds or is_dataclass(parts[0])
    if not isinstance(value, list):
        wanted = _("tables, each under [[{key}]]").format(key=spelling[0]) if tables else _("a list")
        here.refuse(_("must be {wanted}, not {given}").format(wanted=wanted, given=as_given(value)))
        return _blank(kind, here)
    endless = len(parts) == 2 and parts[1] is Ellipsis
    if not endless and len(value) != len(parts):
        here.refuse(_("has {given} entries; {wanted} are needed").format(given=len(value), wanted=len(parts)))
        return _blank(kind, here)
    items = []
    for k, item in enumerate(value):
        part = parts[0] if endless else parts[k]
        place = here.item(here.found.form.index(part, item, k))
        read = _value(one, part, item, spelling, place)
        if not tables or place.key("number").path not in here.found.doubtful:
            items.append(read)
    return tuple(items)


def _kind(base: Any, value: Any, here: Place) -> Any:
    """Return the thing of the class that its ``kind`` names; of the base class if it names none."""
    kinds, default = here.found.form.kinds[base]
    if not is_table(value, here):
        return _blank(base, here)
    name = value.get("kind", default)
    rest = {key: item for key, item in value.items() if key != "kind"}
    if isinstance(name, str) and name in kinds:
        return here.found.form.finished(kinds[name](**values_of(kinds[name], rest, here)), here)
    if name is None:
        message = _("missing; one of {kinds}").format(kinds=", ".join(kinds))
    else:
        message = _("{given} is none of {kinds}").format(given=as_given(name), kinds=", ".join(kinds))
        message += nearest_of(name, kinds)
    here.key("kind").refuse(message)
    owned = {key: item for key, item in rest.items() if key in spellings_of(base)}
    for key in rest:
        if not any(key in spellings_of(kind) for kind in (base, *kinds.values())):
            _note_unknown(base, str(key), here)
    return base(**values_of(base, owned, here))


def _blank(kind: Any, here: Place) -> Any:
    """Return a placeholder that keeps the shape of a type: nan for numbers, blanks in tables."""
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        return () if parts[-1] is Ellipsis else tuple(_blank(part, here) for part in parts)
    if kind in here.found.form.kinds or is_dataclass(kind):
        return kind(**{name: _blank(one.type, here) for name, one in fields_of(kind).items() if one.required})
    return {float: math.nan, int: 1, bool: False, WORD_OR_FLAG: False}.get(kind, "")


def is_table(value: Any, here: Place) -> bool:
    """Tell whether a value is a table, and note where it is not."""
    if not isinstance(value, Mapping):
        here.refuse(_("must be a table, not {given}").format(given=as_given(value)))
    return isinstance(value, Mapping)
