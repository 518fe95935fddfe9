"""Tables of errors and tolerances of a kind: the joint angle, the place of its yoke, and the sizes its law follows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import field, fields, make_dataclass
from functools import cache
from typing import Any

from cardan.drive.accuracy import Cost, Error, Tolerance
from cardan.units import KEY, Key

COMMON = frozenset(("alpha4", "phase"))
"""Errors that a joint of any kind can have."""


@cache
def tables(kind: Any) -> Mapping[str, Any]:
    """Return the classes of the keys `error` and `tolerance` of a kind, and of the cost of its tolerances."""
    keys: dict[str, Key] = kind.size_keys()
    cost = _table(kind, "cost", Cost, [_cost(name, key) for name, key in keys.items()])
    own = [_size(name, key) for name, key in keys.items()]
    error = _table(kind, "error", Error, own)
    wide = [_size(name, key, low=0.0) for name, key in keys.items()]
    priced = next(one for one in fields(Tolerance) if one.name == "cost")
    given = ("cost", cost | None, field(default=None, metadata=priced.metadata))
    return {"error": error, "tolerance": _table(kind, "tolerance", Tolerance, [*wide, given]), "cost": cost}


def _size(name: str, key: Key, low: float = -math.inf) -> tuple[str, Any, Any]:
    return name, float, field(default=0.0, metadata={KEY: Key(key.doc, key.dimension, low=low)})


def _cost(name: str, key: Key) -> tuple[str, Any, Any]:
    return name, float, field(default=1.0, metadata={KEY: Key(key.doc, above=0.0)})


def _table(kind: Any, name: str, base: type, own: list[tuple[str, Any, Any]]) -> type:
    common = {one.name for one in fields(base) if KEY in one.metadata and one.name not in ("distribution", "cost")}

    def reduced(self: Any) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        return _restored, (kind, name, {one.name: getattr(self, one.name) for one in fields(self)})

    says = {"foreign": common - COMMON, "__reduce__": reduced, "__module__": kind.__module__, "__doc__": base.__doc__}
    options: dict[str, Any] = {"frozen": True, "kw_only": True, "slots": True}
    return make_dataclass(f"{kind.__name__}{base.__name__}", own, bases=(base,), namespace=says, **options)


def _restored(kind: Any, name: str, values: dict[str, Any]) -> Any:
    """Return a table as it was before it went to another process."""
    return tables(kind)[name](**values)
