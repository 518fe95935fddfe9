"""Paths of a drive file as a page counts: joint 1 is the first."""

from __future__ import annotations

from cardan.errors import InputError
from cardan.io.amend import steps_of
from cardan.texts import _, mark

TITLES = {
    "joints": mark("Joint {number}"),
    "shafts": mark("Shaft {number}"),
    "supports": mark("Support {number}"),
    "stations": mark("Station {number}"),
    "movements": mark("Movement {number}"),
    "poses": mark("Pose {number}"),
}
"""List of tables of a drive file -> what one of them is called on a page."""


def counted(path: str) -> str:
    """Return a path as a page counts, the names of keys as the file has them; a name of something else as it is.

    >>> counted("shafts[2].parts[0].mass_kg")
    'Shaft 3 · parts 1 · mass_kg'
    """
    told: list[str] = []
    try:
        steps = steps_of(path) if "[" in path else (path,)
    except InputError:  # the name of a file, say
        return path
    for step in steps:
        if isinstance(step, int) and told:
            name = told.pop()
            told.append(_(TITLES[name]).format(number=step + 1) if name in TITLES else f"{name} {step + 1}")
        else:
            told.append(str(step))
    return " · ".join(told)
