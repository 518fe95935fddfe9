"""One four-joint drive: what a user at a prompt waits for."""

from __future__ import annotations

from collections.abc import Iterator

from cardan import Drive, equivalent_joint, motion
from cardan.sweeps import traces
from cardan.units import deg

from .harness import Figure, fastest

AIM = 1000.0
"""Microseconds."""


def truck() -> Drive:
    """Return the book's four-joint power unit with the printed angles."""
    return Drive.from_angles(
        [11.5 * deg, 15.3333 * deg, 15 * deg, 16.5 * deg], plane_twists=[1.9 * deg, -22.9333 * deg, 49.9833 * deg]
    )


def figures(quick: bool) -> Iterator[Figure]:
    drive = truck()
    jobs = {
        "motion of one drive, 361 positions": lambda: motion(drive),
        "stored traces of one drive, 361 positions": lambda: traces(drive),
        "equivalent joint of one drive": lambda: equivalent_joint(drive),
    }
    for name, seconds in fastest(jobs, rounds=20 if quick else 200).items():
        yield Figure(
            bench=name, value=1e6 * seconds, unit="µs", yardstick="1000 µs, aim ≤ 1", ratio=1e6 * seconds / AIM
        )
