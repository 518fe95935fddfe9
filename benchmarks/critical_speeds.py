"""Bending critical speeds: one line of forty elements, many of them, a whole drive exactly; and its forced whirl."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import bending_speeds, example
from cardan.maths.linear.modes import synchronous
from cardan.maths.linear.rotor_beams import Line, line, matrices, round_section
from cardan.maths.linear.transfer import speeds
from cardan.questions.bending.line_whirl import line_whirl

from .harness import Figure, fastest

ELEMENTS, MODES = 40, 4

AIM = 2.0
"""Aim for four forward critical speeds with assembly, milliseconds."""

FORCED = 0.5
"""Aim for the forced whirl of a two-piece line at 1,000 speeds, seconds."""

PEER = 1490.0
"""ROSS, on another machine: four forward critical speeds of forty elements, milliseconds, without 80 to build."""


def beam(outer: tuple[int, ...] = (), elements: int = ELEMENTS) -> Line:
    """Return a tube of 1.5 m on two stiff bearings in elements, or many with lengths a little apart."""
    tube = round_section(0.076, 0.072, 2.1e11, 7850.0, poisson=0.3)
    spread = np.random.default_rng(1).uniform(0.9, 1.1, (*outer, 1)) if outer else 1.0
    return line(
        spread * np.full(elements, 1.5 / elements),
        tube.bending,
        tube.mass,
        shear=tube.shear,
        rotary=tube.rotary,
        spring=np.concatenate(([1e8], np.zeros(elements - 1), [1e8])),
    )


def figures(quick: bool) -> Iterator[Figure]:
    from scipy.linalg import eigh

    ready = matrices(beam())
    drive = example("two-piece-rubber-bearing")
    count = 20 if quick else 1000
    rounds = 5 if quick else 100
    jobs = {
        "elements": lambda: synchronous(beam(), MODES),
        "yardstick": lambda: eigh(ready.inertia - ready.gyroscopic, ready.stiffness),
        "exact": lambda: speeds(beam(elements=1), MODES),
    }
    best = fastest(jobs, rounds=rounds)
    size = len(ready.stiffness)
    yield Figure(
        bench=f"four forward critical speeds of {ELEMENTS} beam elements, with assembly",
        value=1e3 * best["elements"],
        unit="ms",
        yardstick=f"{1e3 * best['yardstick']:.3g} ms, scipy.linalg.eigh of size {size} alone; aim ≤ {AIM:g} ms",
        ratio=best["elements"] / best["yardstick"],
    )
    yield Figure(
        bench="the same beside ROSS",
        value=1e3 * best["elements"],
        unit="ms",
        yardstick=f"{PEER:g} ms, published for another machine",
        ratio=1e3 * best["elements"] / PEER,
    )
    yield Figure(
        bench="the same exactly, by transfer matrices that miss none",
        value=1e3 * best["exact"],
        unit="ms",
        yardstick=f"{1e3 * best['elements']:.3g} ms by elements",
        ratio=best["exact"] / best["elements"],
    )
    many = beam((count,))
    each = fastest({"many": lambda: synchronous(many, MODES)}, rounds=1 if quick else 3)["many"] / count
    yield Figure(
        bench=f"{count} lines of {ELEMENTS} elements in one call, each",
        value=1e3 * each,
        unit="ms",
        yardstick=f"{1e3 * best['elements']:.3g} ms one by one",
        ratio=each / best["elements"],
    )
    whole = fastest({"drive": lambda: bending_speeds(drive)}, rounds=2 if quick else 20)["drive"]
    yield Figure(
        bench="a two-piece drive: speeds, shapes, at rest, both ways",
        value=1e3 * whole,
        unit="ms",
        yardstick=f"{1e3 * best['elements']:.3g} ms for one line by elements",
        ratio=whole / best["elements"],
    )
    speed = np.linspace(10.0, 400.0, 100 if quick else 1000)
    whirl = fastest({"line": lambda: line_whirl(drive, speed=speed)}, rounds=1 if quick else 5)["line"]
    yield Figure(
        bench=f"forced whirl of the two-piece line at {len(speed)} speeds",
        value=whirl,
        unit="s",
        yardstick=f"aim ≤ {FORCED:g} s",
        ratio=whirl / FORCED,
    )
