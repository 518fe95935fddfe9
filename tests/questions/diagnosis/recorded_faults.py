"""Random drives that keep the rules, and what recordings of their faults show; every one follows from its seed."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from cardan.drive.described import Input, Output
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints.hooke import Hooke
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.questions.bending.bending import bending_speeds
from cardan.questions.diagnosis.expected import FAULTS
from cardan.questions.diagnosis.features import features
from cardan.questions.diagnosis.simulate import simulate_fault
from cardan.units import rpm

CALIBRATION, EVALUATION = 100_000, 200_000
"""Where the seeds of both begin: no drive and no recording is in both."""

CLEANEST = {CALIBRATION: 40.0, EVALUATION: 10.0}
"""Largest signal-to-noise ratio [dB]; what is learnt has to hold for clean recordings too."""

KINDS = ("healthy", *FAULTS)
"""In turn; healthy twice as often as every fault."""


@lru_cache(maxsize=64)
def random_drive(seed, pieces=None):
    """Return a drive of one or two tubes that stays below half its critical speed, as the rules ask."""
    rng = np.random.default_rng([seed, 7])
    drawn = int(rng.integers(1, 3))
    pieces = pieces or drawn
    outer, wall = rng.uniform(0.06, 0.11), rng.uniform(0.002, 0.004)
    points = [np.zeros(3)]
    # A front piece runs nearly straight on; the joint angles at both ends of the last piece are about equal: so the
    # rules ask.
    joint_angle = rng.choice([-1.0, 1.0]) * math.radians(rng.uniform(2.0, 5.0))
    slopes = np.cumsum([*([math.radians(rng.uniform(0.5, 1.2))] * (pieces - 1)), joint_angle])
    for slope in slopes:
        points.append(points[-1] + rng.uniform(0.9, 1.4) * np.array([math.cos(slope), 0.0, math.sin(slope)]))
    last = slopes[-1] - joint_angle - math.radians(rng.uniform(-0.4, 0.4))
    end = points[-1] + 0.3 * np.array([math.cos(last), 0.0, math.sin(last)])
    length = float(np.linalg.norm(points[1] - points[0]))
    supports = [Support(shaft=1, position=-0.1, axial=True), Support(shaft=1, position=-0.25)]
    if pieces == 2:
        supports.append(Support(shaft=2, position=0.93 * length))
    supports += [Support(shaft=pieces + 2, position=0.1, axial=True), Support(shaft=pieces + 2, position=0.22)]
    drive = Drive(
        name=f"random {seed}",
        input=Input(point=(-0.3, 0.0, 0.0)),
        output=Output(point=tuple(float(x) for x in end)),
        joints=tuple(Hooke(centre=tuple(float(x) for x in one)) for one in points),
        shafts=tuple(Shaft(number=k + 2, outer=outer, wall=wall) for k in range(pieces)),
        supports=tuple(supports),
    )
    top = float(rng.uniform(0.33, 0.44)) * float(bending_speeds(drive, modes=1).actual[0])
    top = min(top, 5500.0 * rpm)
    torque = float(rng.uniform(2e5, 9e5)) * outer**3 * wall / 0.003
    return replace(drive, duty=Duty(speed=top, speed_range=(0.15 * top, top), torque=torque))


def case(number, start):
    """Return drive, fault, severity, seed and signal-to-noise ratio [dB] of a recording."""
    seed = start + number
    rng = np.random.default_rng([seed, 3])
    fault = KINDS[number % len(KINDS)]
    drive = random_drive(start + number // 8, 2 if fault == "centre_bearing" else None)
    severity = float(np.exp(rng.uniform(math.log(0.8), math.log(2.0))))
    return drive, fault, severity, seed, float(rng.uniform(0.0, CLEANEST[start]))


def recording(number, start):
    """Return drive, fault and recording."""
    drive, fault, severity, seed, snr = case(number, start)
    return drive, fault, simulate_fault(drive, fault, severity=severity, seed=seed, snr=snr)


def shown(number, start):
    """Return the fault of a recording and what it shows."""
    drive, fault, signal = recording(number, start)
    return fault, features(signal, drive)
