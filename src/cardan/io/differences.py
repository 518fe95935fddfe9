"""In what drives differ: the keys of their files that do not say the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, is_dataclass
from typing import Any

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.reading.fields import Field, fields_of
from cardan.texts import _
from cardan.units import DIMENSIONS, label

from .drive_file import whole

MOST = 12  # significant digits that count: 20° and 20° calculated otherwise are the same
LONG = 7  # letters of a number above which a unit is looked for that makes it shorter


@dataclass(frozen=True, kw_only=True)
class Difference:
    """A key that does not say the same in all drives."""

    path: str  # path of the field, without a unit: ``joints[1].centre``; ``shafts[1]`` is shaft number 2
    doc: str  # what it means, in the language spoken
    values: tuple[str, ...]  # what each drive says, in a unit that keeps it short; empty where it says nothing


def differences(drives: Sequence[Drive]) -> tuple[Difference, ...]:
    """Return the keys that do not say the same in all drives, in the order of the file.

    A key that one drive leaves at its default and another gives as just that is no difference. Where a whole table is
    missing in a drive, only the table is told.
    """
    if not drives:
        raise refuse("drives", _("at least one is needed"))
    return tuple(_between("", tuple(drives)))


def _between(path: str, things: tuple[Any, ...]) -> Iterator[Difference]:
    """Yield differences of tables at the same place."""
    known: dict[str, Field] = {}
    for thing in things:
        known |= {name: one for name, one in fields_of(type(thing)).items() if name not in known}
    kinds = tuple(str(getattr(thing, "kind", "")) for thing in things)
    if len(set(kinds)) > 1:
        yield Difference(path=f"{path}.kind", doc=_("kind"), values=kinds)
    for name, one in known.items():
        place = f"{path}.{name}" if path else name
        values = tuple(getattr(thing, name, None) if name in fields_of(type(thing)) else None for thing in things)
        yield from _of_field(place, one, values)


def _of_field(path: str, one: Field, values: tuple[Any, ...]) -> Iterator[Difference]:
    if any(is_dataclass(value) for value in values):
        yield from _of_tables(path, one, values)
    elif any(isinstance(value, tuple) and value and is_dataclass(value[0]) for value in values):
        rows = [value if isinstance(value, tuple) else () for value in values]
        for k in range(max(map(len, rows))):
            at = tuple(row[k] if k < len(row) else None for row in rows)
            yield from _of_tables(f"{path}[{k}]", one, at)
    else:
        told = tuple("" if value is None else _told(one, value) for value in values)
        if len(set(told)) > 1:
            yield Difference(path=path, doc=_(one.key.doc), values=told)


def _of_tables(path: str, one: Field, tables: tuple[Any, ...]) -> Iterator[Difference]:
    if all(table is not None for table in tables):
        yield from _between(path, tables)
    elif any(table is not None for table in tables):
        said = tuple("" if table is None else _name(table) for table in tables)
        yield Difference(path=path, doc=_(one.key.doc), values=said)


def _name(table: Any) -> str:
    """Return what a whole table is called where another drive has none."""
    for field in ("name", "kind", "grade", "file"):
        value = getattr(table, field, "")
        if value and isinstance(value, str):
            return value
    return _("given")


def _told(one: Field, value: Any) -> str:
    """Return a value in the words of the file, with its unit behind it."""
    if one.name == "set":
        return ", ".join(f"{path} = {item}" for path, item in value)
    if one.key.dimension is None:
        return ", ".join(_plain(item) for item in value) if isinstance(value, tuple) else _plain(value)
    numbers, known = tuple(_flat(value)), DIMENSIONS[one.key.dimension]
    said = {unit: tuple(_number(number / size) for number in numbers) for unit, size in known.items()}
    unit = next(iter(known))
    if max(map(len, said[unit]), default=0) > LONG:
        unit = min(known, key=lambda other: max(map(len, said[other])))
    printed = label(unit)
    return f"{', '.join(said[unit])}{'' if printed in ('°', '′') else ' '}{printed}".strip()


def _number(value: float) -> str:
    return repr(whole(float(f"{value:.{MOST}g}"))).replace("-", "−")


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple):
        return ", ".join(map(_plain, value))
    return str(whole(value))


def _flat(value: Any) -> Iterator[float]:
    if isinstance(value, tuple):
        for item in value:
            yield from _flat(item)
    else:
        yield float(value)
