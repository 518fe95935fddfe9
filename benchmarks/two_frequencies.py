"""Torsional vibration of joints and an order that does not repeat with them: three joints, order 3.315, 400 speeds."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan import Drive, torsion_response
from cardan.drive.duty import Duty
from cardan.drive.machine import HarmonicTorque
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.units import deg, rpm

from .harness import Figure, fastest

AIM = 5.0
"""Seconds for 400 speeds on two processors."""

SPEEDS, LOW, HIGH = 400, 700.0, 1500.0


def drive() -> Drive:
    """Return a drive of three joints under 140 N·m, whose first mode the side band of order 1.315 meets at 834 rpm."""
    masses = [Station(shaft=k, end="start", inertia=j) for k, j in ((2, 0.02), (3, 0.03), (4, 0.02))]
    return replace(
        Drive.from_angles([14 * deg, 21 * deg, 11 * deg]),
        shafts=tuple(Shaft(number=k, stiffness=c, damping=2.0) for k, c in enumerate((9e3, 12e3, 11e3, 15e3), 1)),
        stations=(*masses, Station(shaft=4, end="end", name="load", inertia=0.19)),
        duty=Duty(
            speed=900 * rpm,
            torque=140.0,
            torques=(HarmonicTorque(amplitude=300.0, order=3.315, phase=0.3, station="load"),),
        ),
    )


def figures(quick: bool) -> Iterator[Figure]:
    asked, count = drive(), SPEEDS // 10 if quick else SPEEDS
    speed = np.linspace(LOW, HIGH, count) * rpm
    bare = replace(asked, duty=replace(asked.duty, torques=()))
    jobs = {
        "both": lambda: torsion_response(asked, speed=speed),
        "joints": lambda: torsion_response(bare, speed=speed),
    }
    best = fastest(jobs, rounds=1 if quick else 3)
    for yardstick, over in (
        (f"aim ≤ {AIM:g} s for {SPEEDS} speeds on two processors", AIM * count / SPEEDS),
        (f"the joints alone, {best['joints']:.3g} s", best["joints"]),
    ):
        yield Figure(
            bench=f"torsional response of joints and a non-synchronous order at {count} speeds",
            value=best["both"],
            unit="s",
            yardstick=yardstick,
            ratio=best["both"] / over,
        )
