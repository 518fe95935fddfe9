"""Changing values in a drive file without losing its comments."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from cardan.drive.paths import place, with_values

from .drive_file import loads


def edit(text: str, values: Mapping[str, Any]) -> str:
    """Return a TOML drive file with other values; comments and layout stay.

    Parameters
    ----------
    text : str
        The drive file.
    values : mapping of str to value
        Path with unit -> value in that unit, as in `cardan.drive.paths`. A field given in another unit, or by its
        opposite (``yoke_lead``), is replaced.

    Returns
    -------
    str
        The new text; it loads.

    Raises
    ------
    InputError
        The text is no drive file, or a path or value does not fit.

    Examples
    --------
    >>> print(edit("format = 1  # first" + chr(10) + "[[joints]]" + chr(10) + "bend_deg = 20",
    ...            {"joints[0].bend_deg": 25}))
    format = 1  # first
    [[joints]]
    bend_deg = 25
    """
    import tomlkit

    drive = loads(text)
    with_values(drive, values)
    document = tomlkit.parse(text)
    for path, value in values.items():
        there = place(drive, path)
        table: Any = document
        steps = list(there.steps)
        inner = steps[len(steps) - there.inside :]
        owner: Any = drive
        for k, step in enumerate(steps[: len(steps) - there.inside - 1]):
            if steps[k - 1 : k] == ["shafts"] and isinstance(step, int):
                table = _shaft(table, step + 1)
            else:
                table = _inside(table, step)
            owner = owner[step] if isinstance(step, int) else getattr(owner, step)
        one = there.field
        key = path.rsplit(".", 1)[-1].partition("[")[0]
        if inner:
            value = _with_items(getattr(owner, one.name), inner, value, there.factor)
        present = [spelling for spelling in one.spellings if spelling in table]
        if present and present != [key]:
            for spelling in present:
                del table[spelling]
        table[key] = value
    changed = tomlkit.dumps(document)
    loads(changed)
    return changed


def _inside(table: Any, step: str | int) -> Any:
    import tomlkit

    if isinstance(step, int):
        return table[step]
    if step not in table:
        table[step] = tomlkit.aot() if step == "shafts" else tomlkit.table()
    return table[step]


def _shaft(tables: Any, number: int) -> Any:
    """Return the table of a shaft, a new one at the end where the file does not describe it yet."""
    import tomlkit

    for table in tables:
        if table.get("number") == number:
            return table
    new = tomlkit.table()
    new["number"] = number
    tables.append(new)
    return tables[-1]


def _with_items(held: Any, inner: list[Any], value: Any, factor: float) -> Any:
    """Return the whole list in the path's unit with one of its numbers changed."""
    items = [list(item) if isinstance(item, tuple) else item / factor if factor != 1.0 else item for item in held]
    here: Any = items
    for step in inner[:-1]:
        here = here[step]
    here[inner[-1]] = value
    return items
