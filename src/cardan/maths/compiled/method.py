"""How a large job is computed: compiled or as array expressions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np

from cardan.errors import MissingExtraError, refuse
from cardan.later import later
from cardan.texts import _

lanes = later("cardan.maths.compiled.lanes")


@dataclass(frozen=True, kw_only=True, slots=True)
class Plain:
    """Array expressions, by the library of the caller's arrays."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Compiled:
    """The numba kernel; NumPy arrays only.

    Parameters
    ----------
    threads : int, optional
        All processors this process may use by default; 1 where many processes share a machine.
    """

    threads: int | None = None

    def __post_init__(self) -> None:
        if self.threads is not None and self.threads < 1:
            raise refuse("threads", _("{given} given; at least one is needed").format(given=self.threads))


Method: TypeAlias = Plain | Compiled


@cache
def has_numba() -> bool:
    """Tell whether the kernels can be built here; imports numba."""
    try:
        lanes()
    except ImportError:
        return False
    return True


def chosen(method: Method | None, xp: object, large: bool) -> Method:
    """Return the method to use: the caller's, or the compiled one for large jobs on NumPy arrays.

    The choice depends on the job alone, not on what ran before, so that the same call gives the same bits.

    >>> chosen(None, np, large=False)
    Plain()
    """
    if isinstance(method, Compiled) and xp is np and not has_numba():
        raise MissingExtraError(_("the compiled method needs numba: pip install numba"))
    if method is not None:
        return method if xp is np else Plain()
    return Compiled() if large and xp is np and has_numba() else Plain()
