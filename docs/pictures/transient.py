"""Picture of motion in time: a motor that passes the resonance of its joint, and one that hangs on it."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.maths.compiled.method import Compiled
from cardan.questions.torsion.model.inputs import Falling
from cardan.questions.torsion.model.torsional_model import Torque, torsional_line
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.torsion_transient import sommerfeld
from cardan.questions.torsion.transient.transient import simulate
from cardan.units import deg, rpm

from .kit import ACCENT, INK, PALE, SERIES, page

PUSH, NO_LOAD, SPAN = 8.0, 80.0, 30.0


def hang() -> Figure:
    """Draw the mean speed of a run-up with a mild and with a steep bend."""
    figure, axes = page(9.0, 3.8)
    critical = 0.5 * np.sqrt(500.0 * 2.0 / 0.52) / rpm
    axes.axhline(critical, color=PALE, lw=1.2, ls="--")
    axes.text(SPAN, critical + 14.0, "order 2 meets the natural frequency", size=10, ha="right", color=INK)
    push = Torque(station=0, law=Falling(standstill=PUSH, slope=PUSH / NO_LOAD))
    for color, joint_angle in zip(SERIES, (15.0, 34.0), strict=False):
        line = torsional_line(
            [[0.5, 0.02], [0.02, 0.5]],
            stiffness=[[1000.0], [1000.0]],
            damping=[[0.3], [0.3]],
            joint_angle=[joint_angle * deg],
            torques=[push],
        )
        way = FixedStep(per_period=12, compute=Compiled(threads=1))
        found = simulate(line, span=SPAN, times=3001, method=way)
        turned = found.coordinate[:, 0] / (2.0 * np.pi)
        edges = np.interp(np.arange(0.0, turned[-1], 1.0), turned, found.times)
        axes.plot(0.5 * (edges[1:] + edges[:-1]), 2.0 * np.pi / np.diff(edges) / rpm, color=color, lw=2)
        axes.text(10.0, 600.0 if joint_angle < 30 else 150.0, f"joint angle {joint_angle:.0f}°", color=color, size=11)
        for one in sommerfeld(line, found):
            axes.plot([one.start, one.end], [one.speed / rpm] * 2, color=ACCENT, lw=1.5, ls=":")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("mean speed over a turn [rpm]")
    axes.set_ylim(0.0, 760.0)
    axes.set_xlim(0.0, SPAN)
    return figure


PICTURES = {"transient-hanging": hang}
