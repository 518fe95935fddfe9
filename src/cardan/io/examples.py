"""The shipped examples."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.texts import _
from cardan.units import nearest

from .drive_file import load


@cache
def _folder() -> Path:
    """Return where the examples are: in the installed package, or beside ``src`` in a working copy."""
    package = Path(__file__).parents[1]
    installed = package / "examples"
    return installed if installed.is_dir() else package.parents[1] / "examples"


def example_names() -> tuple[str, ...]:
    """Return the names of the shipped examples.

    Examples
    --------
    >>> "single-20deg" in example_names()
    True
    """
    return tuple(sorted(path.stem for path in _folder().glob("*.toml")))


def example_file(name: str) -> Path:
    """Return the file of a shipped example.

    Raises
    ------
    InputError
        There is no example of that name; the message names the nearest.
    """
    if name not in example_names():
        near = nearest(name, example_names())
        hint = _("; the nearest is {near}").format(near=near) if near else ""
        raise refuse(
            "example",
            _("{name} is no shipped example{hint}; there are {names}").format(
                name=repr(name), hint=hint, names=", ".join(example_names())
            ),
        )
    return _folder() / f"{name}.toml"


def example_text(name: str) -> str:
    """Return the text of a shipped example, with its comments."""
    return example_file(name).read_text("utf-8")


def example(name: str) -> Drive:
    """Return a shipped example.

    Parameters
    ----------
    name : str
        One of `example_names`.

    Returns
    -------
    Drive

    Raises
    ------
    InputError
        There is no example of that name.

    Examples
    --------
    >>> example("single-20deg").name
    'single joint at 20 degrees'
    """
    return load(example_file(name))
