"""What is wrong with bores: of one shaft, or of its segments."""

from __future__ import annotations

from collections.abc import Callable

from cardan.texts import _

from .calculation import Problems, Values


def bores(outer: str, inner: str) -> Callable[[Values], Problems]:
    """Return a check that an inner diameter is less than its outer one, where both are given."""

    def check(v: Values) -> Problems:
        one, other = v.get(inner), v.get(outer)
        if one is not None and other is not None and one >= other:
            text = _("{inner:.6g} mm is not less than the outer diameter, {outer:.6g} mm")
            yield v.wrong(inner, text.format(inner=1e3 * one, outer=1e3 * other), "out_of_range")

    return check


def segment_bores(outer: str, inner: str) -> Callable[[Values], Problems]:
    """Return a check that a table of segments holds one at least, each with a bore that leaves a wall."""

    def check(v: Values) -> Problems:
        segments = v.get("segments")
        if segments is not None and not segments:
            yield v.wrong("segments", _("empty; a shaft has at least one segment"), "empty")
        for row in segments or ():
            yield from bores(outer, inner)(row)

    return check
