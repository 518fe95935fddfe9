"""Forced torsional response of a straight line: 20 inertias, 1000 frequencies."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.backends import Compiled, Plain
from cardan.maths.arrays import Array
from cardan.maths.linear.tridiagonal import modes, response

from .harness import Figure, fastest

STATIONS, AIM = 20, 60.0
"""Inertias; how much faster than an inverse a frequency, openTorsion's way, the response is to be: where that took 18,
0.3 ms."""


def line(count: int) -> tuple[Array, Array, Array, Array]:
    """Return masses, couplings with losses, frequencies and loads of a line."""
    rng = np.random.default_rng(1)
    coupling = rng.uniform(1e4, 1e5, STATIONS - 1) * (1.0 + 0.02j)
    return rng.uniform(0.1, 2.0, STATIONS), coupling, np.linspace(1.0, 400.0, count), np.eye(STATIONS)[3]


def stiffness(coupling: Array) -> Array:
    steps = np.diff(np.eye(STATIONS), axis=0)
    return steps.T @ np.diag(coupling) @ steps


def by_inverse(mass: Array, coupling: Array, omega: Array, load: Array) -> Array:
    """Return the displacements as openTorsion finds them: a full inverse at each frequency."""
    matrix, found = stiffness(coupling), np.empty((STATIONS, omega.size), dtype=complex)
    for k, w in enumerate(omega):
        found[:, k] = np.linalg.inv(matrix - w * w * np.diag(mass)) @ load
    return found


def by_batch(mass: Array, coupling: Array, omega: Array, load: Array) -> Array:
    """Return the displacements from one batch of full matrices."""
    matrix = stiffness(coupling) - omega[:, None, None] ** 2 * np.diag(mass)
    found: Array = np.linalg.solve(matrix, np.broadcast_to(load[:, None], (omega.size, STATIONS, 1)))[..., 0].T
    return found


def written(omega: Array) -> None:
    """Write as many numbers as the answer has: displacements and torques, to fresh memory."""
    np.full((2, STATIONS, omega.size), 1j)


def figures(quick: bool) -> Iterator[Figure]:
    given = line(100 if quick else 1000)
    mass, coupling, omega, _load = given
    jobs = {
        "a full inverse each": partial(by_inverse, *given),
        "a batch of full matrices": partial(by_batch, *given),
        "writing": partial(written, omega),
        "compiled": partial(response, *given, method=Compiled()),
        "array expressions": partial(response, *given, method=Plain()),
        "modes": partial(modes, mass, coupling.real),
    }
    best = {name: 1e3 * seconds for name, seconds in fastest(jobs, rounds=3 if quick else 25).items()}
    size = f"{STATIONS} inertias x {omega.size} frequencies"
    inverse, compiled = best["a full inverse each"], best["compiled"]
    for yardstick, ratio in (
        (f"a full inverse a frequency (openTorsion) {inverse:.3g} ms / {AIM:g}, aim ≤ 1", compiled * AIM / inverse),
        (f"writing the answer to fresh memory {best['writing']:.3g} ms", compiled / best["writing"]),
    ):
        bench = f"torsional response, compiled, {size}"
        yield Figure(bench=bench, value=compiled, unit="ms", yardstick=yardstick, ratio=ratio)
    yield Figure(
        bench=f"torsional response, array expressions, {size}",
        value=best["array expressions"],
        unit="ms",
        yardstick=f"numpy.linalg.solve of all {best['a batch of full matrices']:.3g} ms",
        ratio=best["array expressions"] / best["a batch of full matrices"],
    )
    yield Figure(
        bench=f"torsional natural frequencies and modes, {STATIONS} inertias",
        value=best["modes"],
        unit="ms",
        yardstick=f"response at {omega.size} frequencies, array expressions, {best['array expressions']:.3g} ms",
        ratio=best["modes"] / best["array expressions"],
    )
