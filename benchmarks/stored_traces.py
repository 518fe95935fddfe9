"""Output angle, ratio and acceleration of 100,000 four-joint drives × 360 positions, stored."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.backends import Compiled, Plain
from cardan.sweeps import traces

from .harness import Figure, fastest, random_drives
from .memory import write, write_past_caches


def figures(quick: bool) -> Iterator[Figure]:
    count, joints = 10_000 if quick else 100_000, 4
    drives = random_drives(count, joints)
    for positions in (360, 361):
        angle = np.linspace(0.0, 2.0 * np.pi, positions)
        out = traces(drives, angle, method=Compiled())
        size = 3 * count * positions
        block = np.zeros(size + 16)
        skew = -(block.ctypes.data // 8) % 8
        block = block[skew : skew + size - size % 8]
        jobs = {
            "traces": lambda angle=angle, out=out: traces(drives, angle, out=out, method=Compiled()),
            "write": lambda block=block: write(block, 1.0),
            "past": lambda block=block: write_past_caches(block, 2.0),
        }
        best = fastest(jobs, rounds=9)
        rate, plain, past = (8e-9 * size / best[name] for name in ("traces", "write", "past"))
        name = f"stored traces, {count} drives × {positions} positions"
        yield Figure(
            bench=name,
            value=rate,
            unit="GB/s",
            yardstick=f"memory write, {plain:.3g} GB/s, aim ≥ 0.7",
            ratio=rate / plain,
        )
        yield Figure(
            bench=name,
            value=rate,
            unit="GB/s",
            yardstick=f"memory write past the caches, {past:.3g} GB/s, aim ≥ 0.7",
            ratio=rate / past,
        )
        each = 1e9 * best["traces"] / (count * positions * joints)
        yield Figure(bench=name, value=each, unit="ns", yardstick="0.19 ns a joint and position", ratio=each / 0.19)
    few = random_drives(count // 20, joints)
    out = traces(few, angle, method=Plain())
    best = fastest({"plain": lambda: traces(few, angle, out=out, method=Plain())}, rounds=3)
    each = 1e9 * best["plain"] / (count // 20 * positions * joints)
    yield Figure(
        bench="stored traces, plain form, one thread",
        value=each,
        unit="ns",
        yardstick="3.5 ns a joint and position",
        ratio=each / 3.5,
    )
