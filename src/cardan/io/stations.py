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

    Parameters
    ----------
    text : str
        The drive file.
    drive : Drive
        The same drive, but with another thing on this station, or with it as a further one at the end.
    number : int
        Of the station, from 0.
    folder : str or Path
        Where files that the drive file names are looked for.

    Returns
    -------
    str
        The new text; it loads.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan.drive.station import Absorber, Station
    >>> text = "format = 1" + chr(10) + "[[joints]]" + chr(10) + "joint_angle_deg = 20  # steep" + chr(10)
    >>> disc = Station(shaft=2, inertia=0.02, absorber=Absorber(inertia=0.002, stiffness=40.0))
    >>> print(put_station(text, replace(loads(text), stations=(disc,)), 0))
    format = 1
    [[joints]]
    joint_angle_deg = 20  # steep
    <BLANKLINE>
    [[stations]]
    shaft = 2
    inertia_kg_m2 = 0.02
    absorber = {inertia_kg_m2 = 0.002, stiffness_Nm_per_rad = 40}
    <BLANKLINE>
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
    """Return one of the `[[stations]]` of a drive as it can stand in a file, a key a line.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan.drive.station import Station
    >>> from cardan.drive.station import Absorber
    >>> disc = Station(shaft=2, absorber=Absorber(inertia=0.002, stiffness=40.0))
    >>> print(station_text(replace(Drive.from_angles([0.1]), stations=(disc,)), 0))
    [[stations]]
    shaft = 2
    absorber.inertia_kg_m2 = 0.002
    absorber.stiffness_Nm_per_rad = 40
    """
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
