"""Stability map of Mathieu's equation, 1000 x 1000 points."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.backends import Compiled, Plain
from cardan.maths.periodic.stability_map import stability_map

from .arithmetic import multiply_adds
from .harness import Figure, fastest

BEST = 857
"""Multiply-adds a point whose time is the best seen: 6.7 ns on processors that do 128 in a nanosecond."""

POINTS = 8
"""Points of the map that an integrator for general use is asked for."""


def trace(a: float, q: float) -> float:
    """Return half the trace by an integrator for general use: what one writes first."""
    from scipy.integrate import solve_ivp

    def rate(z: float, y: np.ndarray) -> list[float]:
        k = a - 2.0 * q * np.cos(2.0 * z)
        return [y[1], -k * y[0], y[3], -k * y[2]]

    found = solve_ivp(rate, (0.0, np.pi), [1.0, 0.0, 0.0, 1.0], method="LSODA", rtol=1e-7, atol=1e-9)
    return float(0.5 * (found.y[0, -1] + found.y[3, -1]))


def figures(quick: bool) -> Iterator[Figure]:
    side = 200 if quick else 1000
    a, q = np.linspace(0.0, 20.0, side)[None, :], np.linspace(0.0, 10.0, side)[:, None]
    few = np.linspace(1.0, 19.0, POINTS)
    out = stability_map(a, q, method=Compiled())

    def by_integrator() -> None:
        for one in few:
            trace(float(one), 5.0)

    jobs = {
        "arithmetic": lambda: multiply_adds(20 if quick else 400),
        "stability map of Mathieu's equation, compiled": lambda: stability_map(a, q, out=out, method=Compiled()),
        "the same with damping": lambda: stability_map(a, q, 0.05, out=out, method=Compiled()),
        "the same exact, array expressions": lambda: stability_map(a[:, ::5], q[::5], method=Plain()),
        "integrator": by_integrator,
    }
    best = fastest(jobs, rounds=2 if quick else 5)
    done = multiply_adds(20 if quick else 400)
    ideal = 1e9 * BEST * best["arithmetic"] / done
    general = 1e9 * best["integrator"] / POINTS
    points = {name: side * side if "exact" not in name else (side // 5) ** 2 for name in jobs}
    for name in [name for name in jobs if name not in ("arithmetic", "integrator")]:
        each, aim = 1e9 * best[name] / points[name], "" if "exact" in name else ", aim ≤ 2"
        yield Figure(
            bench=f"{name}, {points[name]} points",
            value=each,
            unit="ns",
            yardstick=f"{BEST} multiply-adds {ideal:.3g} ns{aim}; LSODA {general:.3g} ns",
            ratio=each / ideal,
        )
