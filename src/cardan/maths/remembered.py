"""Answers of slow functions are kept by the content of what was asked, whoever asks again."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import fields, is_dataclass
from functools import wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

import numpy as np

Asked = ParamSpec("Asked")
Found = TypeVar("Found")


def content(value: Any) -> Hashable:
    """Return what a value holds, equal wherever arrays, dataclasses, lists and tuples hold the same.

    >>> content(np.zeros(2)) == content(np.zeros(2)), content(np.zeros(2)) == content(np.zeros((2, 1)))
    (True, False)
    """
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if is_dataclass(value):
        return type(value), *(content(getattr(value, one.name)) for one in fields(value))
    if isinstance(value, (tuple, list)):
        return type(value), *(content(one) for one in value)
    found: Hashable = value
    return found


def remembered(
    most: int, *, keep: Callable[[Any], bool] = lambda found: True
) -> Callable[[Callable[Asked, Found]], Callable[Asked, Found]]:
    """Return a decorator that keeps the last answers of a function, for equal positional arguments.

    most: answers that are kept. keep: whether an answer may be kept. Keyword arguments do not count: no answer may
    depend on them.

    >>> @remembered(2)
    ... def doubled(value, progress=None):
    ...     print("asked")
    ...     return 2.0 * value
    >>> doubled(np.ones(2)), doubled(np.ones(2), progress=print)
    asked
    (array([2., 2.]), array([2., 2.]))
    """

    def keeping(function: Callable[Asked, Found]) -> Callable[Asked, Found]:
        kept: OrderedDict[Hashable, Found] = OrderedDict()
        lock = Lock()

        @wraps(function)
        def asked(*what: Asked.args, **how: Asked.kwargs) -> Found:
            key = content(what)
            with lock:
                if key in kept:
                    kept.move_to_end(key)
                    return kept[key]
            found = function(*what, **how)
            if keep(found):
                with lock:
                    kept[key] = found
                    while len(kept) > most:
                        kept.popitem(last=False)
            return found

        return asked

    return keeping
