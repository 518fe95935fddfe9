"""Where the shipped examples are."""

from __future__ import annotations

from functools import cache
from pathlib import Path


@cache
def examples_folder() -> Path:
    """Return where the examples are: in the installed package, or beside ``src`` in a working copy."""
    package = Path(__file__).parents[1]
    installed = package / "examples"
    return installed if installed.is_dir() else package.parents[1] / "examples"


def mechanism_names() -> tuple[str, ...]:
    """Return the names of the shipped examples of mechanisms.

    Examples
    --------
    >>> "hooke-stiff-bearings" in mechanism_names()
    True
    """
    return tuple(sorted(path.stem for path in (examples_folder() / "mechanisms").glob("*.toml")))
