"""Changing values in a drive file without losing its comments."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import tomlkit

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import tree_of
from cardan.drive.fields.paths import place, read, with_values
from cardan.files import Enclosed

from .drive_file import loads, toml_text, whole


def edit(
    text: str, values: Mapping[str, Any], *, folder: str | Path | Enclosed = ".", catalogues: Sequence[str | Path] = ()
) -> str:
    """Return a TOML drive file with other values; comments and layout stay.

    values: path with unit -> value in that unit, as in `fields.paths`. A field given in another unit, or by its
    opposite (``yoke_lead``), is replaced; None takes it out.
    folder: where files that the drive file names are looked for.
    Returns: the new text; it loads.
    Raises InputError: the text is no drive file, or a path or value does not fit.
    """
    drive = loads(text, folder=folder, catalogues=catalogues)
    wanted = with_values(drive, values)
    document = tomlkit.parse(text)
    for path in values:
        there = place(drive, path)
        if _named(document, there.steps):
            _table(document, there.steps[:-2])[there.steps[-2]] = values[path]
            continue
        table = _table(document, there.steps[: len(there.steps) - there.inside - 1])
        if values[path] is None:
            for spelling in there.field.spellings.keys() & table.keys():
                del table[spelling]
            continue
        inner = there.steps[len(there.steps) - there.inside :]
        others = [spelling for spelling in there.field.spellings if spelling in table and spelling != there.spelling]
        comment = "".join(removed(table, spelling) for spelling in others)
        if inner and there.spelling in table:
            _put(table[there.spelling], inner, values[path])
        else:
            whole = re.sub(r"(\[\d+\])+$", "", path) if inner else path
            table[there.spelling] = plain(read(wanted, whole))
        if comment:
            table[there.spelling].comment(comment)
    changed = tomlkit.dumps(document)
    loads(changed, folder=folder, catalogues=catalogues)
    return changed


def _named(document: Any, steps: Sequence[str | int]) -> bool:
    """Tell whether steps lead to the grade of a material that the file gives by this name alone."""
    if steps[-2:] != ("material", "grade"):
        return False
    held = _table(document, steps[:-2]).get("material", "")
    return isinstance(held, str)


def _table(document: Any, steps: Sequence[str | int]) -> Any:
    """Return the table that steps lead to, made where the file does not have it yet."""
    table = document
    for before, step in zip((None, *steps), steps, strict=False):
        table = shaft_table(table, step + 1) if before == "shafts" and isinstance(step, int) else _inside(table, step)
    return table


def _inside(table: Any, step: str | int) -> Any:
    if isinstance(step, str) and step not in table:
        inline = isinstance(table, tomlkit.items.InlineTable)
        table[step] = tomlkit.aot() if step == "shafts" else tomlkit.inline_table() if inline else tomlkit.table()
    return table[step]


def shaft_table(tables: Any, number: int) -> Any:
    """Return the table of a shaft, a new one at the end where the file does not describe it yet."""
    for table in tables:
        if table.get("number") == number:
            return table
    new: Any = tomlkit.inline_table() if isinstance(tables, tomlkit.items.Array) else tomlkit.table()
    new["number"] = number
    tables.append(new)
    return tables[-1]


def removed(table: Any, key: str) -> str:
    """Take a key out of a table and return its comment."""
    comment = str(table[key].trivia.comment).lstrip("# ")
    del table[key]
    return comment


def _put(items: Any, steps: Sequence[str | int], value: Any) -> None:
    """Change one number of a list where it stands."""
    for step in steps[:-1]:
        items = items[step]
    items[steps[-1]] = value


def plain(value: Any) -> Any:
    """Return tuples as lists, and whole numbers without a point."""
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return whole(value)


# Putting a station, or what hangs on one, into a drive file without losing its comments.


def put_station(text: str, drive: Drive, number: int, *, folder: str | Path = ".") -> str:
    """Return a TOML drive file with one of the `[[stations]]` of a drive; comments and layout stay.

    drive: the same drive, but with another thing on this station, or with it as a further one at the end.
    number: of the station, from 0; folder: where files that the drive file names are looked for.
    Returns: the new text; it loads.
    """
    wanted: dict[str, Any] = tree_of(drive)["stations"][number]
    document = tomlkit.parse(text)
    tables: Any = document.get("stations")
    if tables is not None and number < len(tables):
        table = tables[number]
        for key in ("absorber", "pendulum"):
            if key in wanted:
                table[key] = _inline(wanted[key])
    elif isinstance(tables, tomlkit.items.Array):
        tables.append(_inline(wanted))
    else:
        new = tomlkit.table()
        for key, value in wanted.items():
            new[key] = _inline(value) if isinstance(value, dict) else whole(value)
        if tables is None:
            tables = tomlkit.aot()
            if not text.endswith("\n\n"):
                document.add(tomlkit.nl())
            document["stations"] = tables
        tables.append(new)
    changed = tomlkit.dumps(document)
    loads(changed, folder=folder)
    return changed


def station_text(drive: Drive, number: int) -> str:
    """Return one of the `[[stations]]` of a drive as it can stand in a file, a key a line."""
    lines = ["[[stations]]"]
    for key, value in tree_of(drive)["stations"][number].items():
        if isinstance(value, dict):
            lines += [f"{key}.{line}" for line in toml_text(value).splitlines()]
        else:
            lines.append(toml_text({key: value}).strip())
    return "\n".join(lines)


def _inline(values: dict[str, Any]) -> Any:
    table = tomlkit.inline_table()
    for key, value in values.items():
        table[key] = _inline(value) if isinstance(value, dict) else whole(value)
    return table
