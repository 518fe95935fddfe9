"""Extremes, speed fluctuation and orders of many four-joint drives, without positions."""

from __future__ import annotations

from collections.abc import Iterator

from cardan import Extremes, equivalent_joint, extremes
from cardan.backends import Compiled, Plain

from .harness import Figure, fastest, random_drives

AIM = 60.0
"""Nanoseconds a drive."""


def figures(quick: bool) -> Iterator[Figure]:
    for count in (10_000,) if quick else (100_000, 1_000_000):
        drives = random_drives(count)
        out = extremes(drives, method=Compiled())

        def reused(drives=drives, out=out) -> Extremes:
            return extremes(drives, out=out, method=Compiled())

        def with_orders(drives=drives, out=out) -> None:
            extremes(drives, out=out, method=Compiled()).harmonics(4)

        def fresh(drives=drives) -> None:
            found = extremes(drives, method=Compiled())
            found.harmonics(4), found.phase

        best = fastest({"into given arrays": reused, "and four orders": with_orders, "all of it fresh": fresh})
        for name, seconds in best.items():
            yield _figure(f"extremes, {count} drives, {name}", 1e9 * seconds / count)
    few = random_drives(20_000)
    best = fastest(
        {
            "extremes, plain form": lambda: extremes(few, method=Plain()),
            "equivalent_joint, every shaft, plain form": lambda: equivalent_joint(few).speed_fluctuation,
        },
        rounds=3,
    )
    for name, seconds in best.items():
        yield _figure(name, 1e9 * seconds / 20_000, aim="")


def _figure(name: str, each: float, aim: str = ", aim ≤ 1") -> Figure:
    return Figure(bench=name, value=each, unit="ns", yardstick=f"{AIM:g} ns a drive{aim}", ratio=each / AIM)
