"""Tolerances by exact samples: a million joints with errors, 72 positions each."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan import Drive, Tolerance, tolerance
from cardan.backends import Compiled, Plain
from cardan.maths.arrays import Array
from cardan.methods import MonteCarlo
from cardan.questions.accuracy.accuracy import error_arrays, one_turn, transmission_error
from cardan.questions.accuracy.allocation import allocate
from cardan.questions.accuracy.sampling import Exact, Sums, drawn
from cardan.units import deg

from .harness import Figure, fastest

POSITIONS, AIM = 72, 48.0
"""Positions of a turn; how much faster than Newton's method in NumPy the loops are to be solved."""

ALLOTTED = 50.0
"""Aim for one allocation of a four-joint drive, milliseconds."""

SQUARE = Tolerance(alpha1=0.1 * deg, alpha2=0.1 * deg, alpha3=0.1 * deg, alpha4=0.1 * deg)


def newton(alpha: Array, phi: Array) -> Array:
    """Return φ_4 of loops (m, 4) at positions (p,) by Newton's method, as array expressions: what one writes first."""
    c1, c2, c3, c4 = (np.cos(alpha[:, k, None]) for k in range(4))
    s1, _s2, s3, s4 = (np.sin(alpha[:, k, None]) for k in range(4))
    a = s3 * s1 * np.sin(phi)
    b = -s3 * (c1 * s4 + s1 * c4 * np.cos(phi))
    c = c2 - c3 * (c1 * c4 - s1 * s4 * np.cos(phi))
    angle = np.broadcast_to(np.arctan2(np.cos(alpha[0, 3]) * np.cos(phi), np.sin(phi)), a.shape)
    for _iteration in range(3):
        sine, cosine = np.sin(angle), np.cos(angle)
        angle = angle - (a * sine + b * cosine - c) / (a * cosine - b * sine)
    return angle


def figures(quick: bool) -> Iterator[Figure]:
    count, few = (2**15, 2**12) if quick else (2**20, 2**15)
    drive, phi = Drive.from_angles([25 * deg]), one_turn(POSITIONS)
    limits = np.concatenate(error_arrays([SQUARE]), axis=-1)
    known, centre = np.zeros_like(limits), transmission_error(drive, phi)
    seats = limits[0][limits[0] > 0]
    errors = np.concatenate(list(drawn(seats, ["normal"] * 4, count, seed=1, points="sobol")))
    perfect = np.asarray([0.5 * np.pi] * 3 + [25 * deg])

    def loops(method: Compiled | Plain, rows: int) -> None:
        exact = Exact(drive, phi, known=known, limits=limits, centre=centre, samples=rows, method=method)
        exact.add(errors[:rows], (Sums(centre.error), Sums(centre.output_shift)))

    def by_newton() -> None:
        piece = 200
        for first in range(0, few, piece):
            newton(perfect + errors[first : first + piece], phi)

    jobs = {
        "newton": by_newton,
        "loops, compiled": lambda: loops(Compiled(), count),
        "loops, array expressions": lambda: loops(Plain(), few),
        "tolerance, compiled, with drawing and quantiles": lambda: tolerance(
            drive, SQUARE, method=MonteCarlo(samples=count, positions=POSITIONS, compute=Compiled())
        ),
    }
    best = fastest(jobs, rounds=3 if quick else 5)
    rows = {name: few if "array" in name or name == "newton" else count for name in jobs}
    each = {name: 1e9 * seconds / (rows[name] * POSITIONS) for name, seconds in best.items()}
    for name in list(jobs)[1:]:
        yield Figure(
            bench=f"exact {name}, {rows[name]} samples x {POSITIONS} positions",
            value=each[name],
            unit="ns",
            yardstick=f"Newton in NumPy {each['newton']:.3g} ns / {AIM:g}"
            + (", aim ≤ 1" if name == "loops, compiled" else ""),
            ratio=each[name] * AIM / each["newton"],
        )
    many = Drive.from_angles([20 * deg, 15 * deg, 15 * deg, 10 * deg], yoke_angles=[0.2, 0.4, 0.1])
    seconds = fastest({"allocate": lambda: allocate(many, 0.1 * deg)}, rounds=5)["allocate"]
    yield Figure(
        bench="cheapest tolerances of a four-joint drive",
        value=1e3 * seconds,
        unit="ms",
        yardstick=f"{ALLOTTED:g} ms, aim ≤ 1",
        ratio=1e3 * seconds / ALLOTTED,
    )
