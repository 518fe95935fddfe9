"""Makes the recordings beside it: the truck with centre bearing with each fault, as its sensors would have seen it.

``python examples/recordings/make.py`` writes them anew, the same every time. The tests compare.
"""

from __future__ import annotations

import textwrap
from dataclasses import replace
from math import floor, log10
from pathlib import Path

import numpy as np

from cardan import example
from cardan.io.signals.csv import content_of
from cardan.recordings import Channel, Signal, TestSchedule, simulate_fault

DRIVE = "truck-supports"

RUNS = TestSchedule(run_up=6.5, hold=2.5, rate=500.0)

SEVERITY, SNR = 1.5, 12.0
"""How bad a fault is, over a plain one, and how far the vibration stands above the noise [dB]."""

OTHERWISE = {
    "joint_angles": (3.0, 12.0),
    "half_critical": (0.8, 20.0),
    "critical": (0.6, 20.0),
    "worn_joint": (2.0, 20.0),
}
"""Faults that this drive shows less or more plainly than others."""

LEFT_OUT = "input axial"
"""A channel that these recordings do without."""

FAULTS = {
    "healthy": (1, "nothing wrong"),
    "unbalance": (1, "an unbalance on its longest shaft"),
    "lost_weight": (1, "a balance weight lost"),
    "bent": (2, "a bent tube"),
    "joint_angles": (2, "joints that bend too much"),
    "phase": (1, "a spline put together some teeth off, yokes out of phase"),
    "half_critical": (2, "a critical speed of which the joints hit the half"),
    "tight_joint": (1, "a tight joint"),
    "critical": (1, "a critical speed too near the running speed"),
    "crack": (1, "a crack across its longest shaft"),
    "worn_joint": (2, "a worn joint"),
    "worn_spline": (1, "a worn spline"),
    "centre_bearing": (1, "a worn centre bearing"),
}
"""Fault -> seed, and what the head of its file says."""


def rounded(channel: Channel) -> Channel:
    """Return a channel with the digits that a logger would have kept."""
    digits = {"pulses": 2, "angular_speed": 5}.get(channel.quantity, 3)
    step = 10.0 ** (floor(log10(float(np.max(np.abs(channel.values))))) - digits + 1)
    return replace(channel, values=np.round(np.round(channel.values / step) * step, 12))


def recording(fault: str) -> Signal:
    """Return the recording of a fault."""
    seed, _words = FAULTS[fault]
    severity, snr = OTHERWISE.get(fault, (SEVERITY, SNR))
    found = simulate_fault(example(DRIVE), fault, severity=severity, seed=seed, snr=snr, runs=RUNS)
    kept = tuple(rounded(one) for one in found.channels if one.name != LEFT_OUT)
    return Signal(name=file_name(fault), channels=kept, tacho=0)


def file_name(fault: str) -> str:
    """Return the name of the file of a fault."""
    return f"truck-{fault.replace('_', '-')}.csv"


def content(fault: str) -> bytes:
    """Return the file of a fault."""
    _seed, words = FAULTS[fault]
    head = (
        f"Recording of the truck with centre bearing (truck-supports) with {words}: a run-up, then one speed under "
        "load and coasting. Simulated with a seed by examples/recordings/make.py, not measured."
    )
    lines = "".join(f"# {line}\n" for line in textwrap.wrap(head, 110))
    return lines.encode() + content_of(recording(fault))


if __name__ == "__main__":
    for one in FAULTS:
        (Path(__file__).parent / file_name(one)).write_bytes(content(one))
