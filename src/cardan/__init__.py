"""cardan: universal-joint (cardan, Hooke) shaft drives, analysed and designed from one description.

Python is SI and radians throughout; write ``20 * deg``. Each public name is imported on first use. What a newcomer
needs stands here; the rest in `cardan.sweeps`, `cardan.recordings`, `cardan.parts`, `cardan.joints`,
`cardan.mechanisms`, `cardan.backends` and `cardan.methods`.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any

from .version import VERSION

__version__ = VERSION

with open(f"{__path__[0]}/__init__.pyi", encoding="utf-8") as stub:
    _HOMES = {line[3]: line[1].removeprefix(".") for line in map(str.split, stub) if line[:1] == ["from"]}
"""Public name -> where it is from, as the stub beside this file tells it to type checkers; empty for a module here."""

__all__ = sorted([*_HOMES, "__version__"])


class _Package(ModuleType):
    """Some questions share their name with the subpackage they live in; importing that must not hide them."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not _HOMES.get(name) or not isinstance(value, ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'cardan' has no attribute {name!r}")
    home = _HOMES[name]
    return getattr(import_module(f".{home}", __name__), name) if home else import_module(f".{name}", __name__)


def __dir__() -> list[str]:
    return __all__
