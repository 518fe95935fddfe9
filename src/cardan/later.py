"""Modules that are imported where they are first needed: heavy ones, and those of an extra that need not be there.

This is the one place for that; every other import stands at the top of its file.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from .errors import MissingExtraError
from .texts import _


def later(name: str, missing: str = "") -> Callable[[], Any]:
    """Return what imports a module when it is called.

    missing: what to tell where it is not installed, marked for translation; empty for a module that is always there.
    Returns: takes nothing and returns the module; raises `MissingExtraError` where it is not installed.

    >>> fractions = later("fractions")
    >>> fractions().Fraction(1, 3)
    Fraction(1, 3)
    >>> later("no_such_module", "this needs the extra: pip install 'cardan[extra]'")()
    Traceback (most recent call last):
        ...
    cardan.errors.MissingExtraError: this needs the extra: pip install 'cardan[extra]'
    """

    def module() -> Any:
        try:
            return import_module(name)
        except ImportError:
            if not missing:
                raise
            raise MissingExtraError(_(missing)) from None

    return module
