"""Modules that are imported where they are first needed: heavy ones, and those of an extra that need not be there.

This is the one place for that; every other import stands at the top of its file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping
from importlib import import_module
from typing import Any, TypeVar

from .errors import MissingExtraError
from .texts import _

T = TypeVar("T")


def later(name: str, missing: str = "", *, of: str = "") -> Callable[[], Any]:
    """Return what imports a module when it is called.

    missing: what to tell where it is not installed, marked for translation; empty for a module that is always there.
    of: what to take of the module; the module itself by default.
    Returns: takes nothing and returns the module; raises `MissingExtraError` where it is not installed.

    >>> fractions = later("fractions")
    >>> fractions().Fraction(1, 3)
    Fraction(1, 3)
    >>> later("fractions", of="Fraction")()(2, 6)
    Fraction(1, 3)
    >>> later("no_such_module", "this needs the extra: pip install 'cardan[extra]'")()
    Traceback (most recent call last):
        ...
    cardan.errors.MissingExtraError: this needs the extra: pip install 'cardan[extra]'
    """

    def module() -> Any:
        try:
            found = import_module(name)
        except ImportError:
            if not missing:
                raise
            raise MissingExtraError(_(missing)) from None
        return getattr(found, of) if of else found

    return module


class Kinds(MutableMapping[str, type[T]]):
    """A register of classes by their kind: the file of each is imported when somebody asks for it.

    >>> kinds = Kinds({"fraction": later("fractions", of="Fraction")})
    >>> list(kinds), kinds["fraction"](2, 6)
    (['fraction'], Fraction(1, 3))
    """

    def __init__(self, homes: dict[str, Callable[[], type[T]]]) -> None:
        self._homes = homes

    def __getitem__(self, kind: str) -> type[T]:
        return self._homes[kind]()

    def __setitem__(self, kind: str, made: type[T]) -> None:
        self._homes[kind] = lambda: made

    def __delitem__(self, kind: str) -> None:
        del self._homes[kind]

    def __iter__(self) -> Iterator[str]:
        return iter(self._homes)

    def __len__(self) -> int:
        return len(self._homes)
