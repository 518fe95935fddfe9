"""What is wrong with bores: of one shaft, or of its segments."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from cardan.errors import Problem
from cardan.texts import _

from .calculation import Values

Key: TypeAlias = Callable[[str], str]
Check: TypeAlias = Callable[[Values, Key], Iterator[Problem]]


def bores(outer: str, inner: str) -> Check:
    """Return a check that an inner diameter is less than its outer one, where both are given."""

    def check(values: Values, key: Key) -> Iterator[Problem]:
        one, other = values.get(inner), values.get(outer)
        if one is not None and other is not None and one >= other:
            text = _("{inner:.6g} mm is not less than the outer diameter, {outer:.6g} mm")
            yield Problem(key(inner), text.format(inner=1e3 * one, outer=1e3 * other), "out_of_range")

    return check


def segment_bores(outer: str, inner: str) -> Check:
    """Return a check that a table of segments holds one at least, each with a bore that leaves a wall."""

    def check(values: Values, key: Key) -> Iterator[Problem]:
        segments = values.get("segments")
        if segments is not None and not segments:
            yield Problem(key("segments"), _("empty; a shaft has at least one segment"), "empty")
        for k, row in enumerate(segments or ()):
            yield from bores(outer, inner)(row, lambda name, k=k: key(f"segments[{k}].{name}"))  # type: ignore[misc]

    return check
