"""Answers are kept by the content of what was asked, as many as are wanted, and only whole ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.maths.remembered import content, remembered


@dataclass(frozen=True, eq=False)
class Two:
    """Two arrays."""

    one: Any
    other: Any


def test_content_does_not_ask_who_holds_it() -> None:
    shared = np.arange(3.0)
    assert content(Two(shared, shared)) == content(Two(shared.copy(), shared.copy()))
    assert content(Two(shared, None)) != content(Two(shared, shared))
    assert content([Two(shared, (1, 2))]) != content([Two(shared, (1, 3))])
    assert content(np.zeros(2)) != content(np.zeros(2, dtype=int))


def test_the_last_answers_are_kept() -> None:
    asked = []

    @remembered(2)
    def doubled(value: Any) -> Any:
        asked.append(float(value[0]))
        return 2.0 * value

    for value in (1.0, 2.0, 1.0, 3.0, 1.0, 2.0):
        assert doubled(np.asarray([value])) == 2.0 * value
    assert asked == [1.0, 2.0, 3.0, 2.0]


def test_what_was_cut_short_is_asked_again() -> None:
    asked = []

    @remembered(2, keep=lambda found: found >= 0.0)
    def told(value: float, stop: bool = False) -> float:
        asked.append(stop)
        return -1.0 if stop else value

    assert [told(1.0, stop=True), told(1.0), told(1.0, stop=True)] == [-1.0, 1.0, 1.0]
    assert asked == [True, False]
