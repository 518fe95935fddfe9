"""The shipped examples."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _
from cardan.units import nearest

from .drive_file import load
from .mechanism_file import load_mechanism


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


def mechanism_names() -> tuple[str, ...]:
    """Return the names of the shipped examples of mechanisms.

    Examples
    --------
    >>> "hooke-stiff-bearings" in mechanism_names()
    True
    """
    return tuple(sorted(path.stem for path in (_folder() / "mechanisms").glob("*.toml")))


def recording_names() -> tuple[str, ...]:
    """Return the names of the shipped recordings.

    Examples
    --------
    >>> "truck-worn-spline" in recording_names()
    True
    """
    return tuple(sorted(path.stem for path in (_folder() / "recordings").glob("*.csv")))


def example_file(name: str) -> Path:
    """Return the file of a shipped example: a drive, a mechanism or a recording."""
    if name in mechanism_names():
        return _folder() / "mechanisms" / f"{name}.toml"
    if name in recording_names():
        return _folder() / "recordings" / f"{name}.csv"
    if name not in example_names():
        near = nearest(name, (*example_names(), *mechanism_names(), *recording_names()))
        hint = _("; the nearest is {near}").format(near=near) if near else ""
        raise refuse(
            "example",
            _("{name} is not a shipped example{hint}; there are {names}").format(
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

    See Also
    --------
    load, example_mechanism

    Examples
    --------
    >>> example("single-20deg").name
    'single joint at 20 degrees'
    """
    return load(example_file(name))


def example_mechanism(name: str) -> Mechanism:
    """Return a shipped example of a mechanism.

    Parameters
    ----------
    name : str
        One of `mechanism_names`.

    Returns
    -------
    Mechanism

    Raises
    ------
    InputError
        There is no example of that name, or it is a drive.

    See Also
    --------
    load_mechanism, example

    Examples
    --------
    >>> example_mechanism("hooke-stiff-bearings").links
    ('shaft 1', 'cross', 'shaft 2')
    """
    return load_mechanism(example_file(name))
