"""Putting a station, or what hangs on one, into a drive file without losing its comments."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import tomlkit

from cardan.drive.drive import Drive
from cardan.drive.fields.tables import tree_of

from .drive_file import loads
from .writer import toml_text, whole


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
