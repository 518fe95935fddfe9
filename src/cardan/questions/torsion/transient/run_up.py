"""A run-up of the duty followed in time, in steps of one length, unless that takes too long."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.machine import RunUp
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes

from .fixed_steps import FixedStep
from .torsion_transient import AFTER, Transient, transient

SMOOTH, STRIKING = 20.0, 600.0
"""Steps in a period of the fastest vibration, and in drives with backlash: contacts fall somewhere within a step."""

MOST = 3e6
"""Steps that are waited for."""

ACROSS, SAMPLES = 20.0, (1501, 4001)
"""Samples of the curves: in a period of order 2 at the highest speed, fewest and most in all."""

ORDER = 4.0
"""Highest order of the joints that counts."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FollowedRunUp:
    """A run-up with the resonances on its way."""

    course: RunUp  # how the speed of the input goes
    modes: TorsionModes  # what it passes
    steps: float  # how many steps it takes, about
    motion: Transient | None  # torques and speeds in time; None where that takes too many steps


def follow(drive: Drive, course: RunUp, *, progress: Callable[[float], object] | None = None) -> FollowedRunUp:
    """Return a run-up of a drive, followed in time where that does not take too long.

    drive: with this run-up in its duty; course: how the speed of its input goes.
    """
    modes = torsion_modes(drive)
    each = STRIKING if np.any(modes.train.model.backlash > 0.0) else SMOOTH
    top = max(abs(course.start), abs(course.end))
    fastest = max(float(np.max(modes.omega, initial=0.0)), ORDER * top)
    steps = (1.0 + AFTER) * course.duration * fastest / (2.0 * math.pi) * each
    if steps > MOST:
        return FollowedRunUp(course=course, modes=modes, steps=steps, motion=None)
    samples = int(min(max(ACROSS * 2.0 * top / (2.0 * math.pi) * course.duration, SAMPLES[0]), SAMPLES[1]))
    motion = transient(drive, times=samples, method=FixedStep(per_period=each), progress=progress)
    return FollowedRunUp(course=course, modes=modes, steps=steps, motion=motion)
