"""From the tables of a catalogue file to rows, every problem at once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from cardan.drive.fields.keys import NAMED, Field, fields_of, spellings_of
from cardan.drive.fields.ranges import in_range, out_of_range
from cardan.errors import InputError, Problem
from cardan.texts import _
from cardan.units import nearest

from .rows import TABLES, Row


def rows_of(tree: Mapping[str, Any]) -> tuple[dict[str, dict[str, Row]], list[Problem]]:
    """Return the rows of the tables of a file by table and id, and all that is wrong with it."""
    found: dict[str, dict[str, Row]] = {}
    problems: list[Problem] = []
    for name, rows in tree.items():
        if name not in TABLES:
            near = nearest(name, TABLES)
            text = _("unknown table; the tables are {known}").format(known=", ".join(TABLES))
            problems.append(Problem(name, text + (_("; did you mean {near}?").format(near=near) if near else "")))
        elif not isinstance(rows, list) or not all(isinstance(row, Mapping) for row in rows):
            problems.append(Problem(name, _("must be tables, each under [[{key}]]").format(key=name)))
        else:
            found[name] = {}
            for k, table in enumerate(rows):
                row = read(TABLES[name], table, f"{name}[{k}]", problems)
                if row is None:
                    continue
                if row.id in found[name]:
                    problems.append(Problem(f"{name}[{k}].id", _("{id} stands twice").format(id=row.id)))
                found[name][row.id] = row
    return found, problems


def read(cls: type, table: Mapping[str, Any], path: str, problems: list[Problem]) -> Any:
    """Return an instance of a class from a table, or None after noting what is wrong with it."""
    known, values = spellings_of(cls), {}
    before = len(problems)
    for key, value in table.items():
        here = f"{path}.{key}"
        if key not in known:
            near = nearest(key, known)
            problems.append(
                Problem(here, _("unknown key") + (_("; did you mean {near}?").format(near=near) if near else ""))
            )
            continue
        name, factor = known[key]
        if name in values:
            problems.append(Problem(here, _("is given twice, in two units")))
        else:
            values[name] = _value(fields_of(cls)[name], fields_of(cls)[name].type, value, key, factor, here, problems)
    for name, one in fields_of(cls).items():
        if one.required and name not in values:
            problems.append(Problem(f"{path}.{one.spelling}", _("missing: {doc}").format(doc=_(one.key.doc))))
    if len(problems) > before:
        return None
    try:
        return cls(**values)
    except InputError as error:
        problems += [Problem(f"{path}.{_spelled(cls, problem.field)}", problem.message) for problem in error.problems]
        return None


def _spelled(cls: type, field: str) -> str:
    """Return the key of a field, the name itself where it is none of the class."""
    own = fields_of(cls).get(field)
    return field if own is None else own.spelling


def _value(one: Field, kind: Any, value: Any, key: str, factor: float, here: str, problems: list[Problem]) -> Any:
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        endless = len(parts) == 2 and parts[1] is Ellipsis
        if not isinstance(value, list) or not (endless or len(value) == len(parts)):
            wanted = _("a list") if endless else _("a list of {count}").format(count=len(parts))
            problems.append(Problem(here, _("must be {wanted}").format(wanted=wanted)))
            return None
        each = [parts[0] if endless else parts[k] for k in range(len(value))]
        return tuple(
            _value(one, part, item, key, factor, f"{here}[{k}]", problems)
            for k, (part, item) in enumerate(zip(each, value, strict=True))
        )
    if is_dataclass(kind):
        if kind in NAMED and isinstance(value, str):
            return kind(**{NAMED[kind]: value})
        if not isinstance(value, Mapping):
            problems.append(Problem(here, _("must be a table")))
            return None
        return read(kind, value, here, problems)  # type: ignore[arg-type]
    problems += _scalar_problems(one, kind, value, key, factor, here)
    return value * factor if kind is float and isinstance(value, int | float) else value


def _scalar_problems(one: Field, kind: Any, value: Any, key: str, factor: float, here: str) -> Iterator[Problem]:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if kind is float or kind is int:
        if not number or (kind is int and not isinstance(value, int)):
            yield Problem(here, _("must be a number"))
        elif not in_range(one.key, value * factor):
            yield Problem(here, out_of_range(repr(value), one.key, value * factor, one.unit(key), mirrored=False))
    elif kind is bool:
        if not isinstance(value, bool):
            yield Problem(here, _("must be true or false"))
    elif not isinstance(value, str) and not (isinstance(value, bool) and kind is not str):
        yield Problem(here, _("must be a text"))
    elif one.key.choices and isinstance(value, str) and value not in one.key.choices:
        choices = ", ".join(one.key.choices)
        yield Problem(here, _("{value} is none of {choices}").format(value=repr(value), choices=choices))
    elif one.name in ("id", "source") and not str(value).strip():
        yield Problem(here, _("must not be empty"))
