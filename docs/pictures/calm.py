"""Pictures of measures against torsional vibration: torques before and after, and the excitations of joints."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cardan import absorber, example, optimise_torsion
from cardan.io import loads
from cardan.methods import Evolution
from cardan.questions.torsion.optimise.modal_excitation import NodeRule
from cardan.units import rpm

from .kit import ACCENT, INK, PALE, SERIES, bare, page

FEEDER = """
format = 1
[[joints]]
joint_angle_deg = 14
[[joints]]
joint_angle_deg = 14
plane_twist_deg = 25
[[shafts]]
number = 2
stiffness_Nm_per_rad = 5000
damping_Nms_per_rad = 2
inertia_kg_m2 = 0.02
[[stations]]
shaft = 3
inertia_kg_m2 = 0.8
[duty]
torque_Nm = 60
speed_range_rpm = [290, 570]
"""
"""The drive of the how-to."""


def ringed() -> Figure:
    """Draw what the ring on the flywheel of the power take-off shaft does to the torque."""
    found = absorber(example("pto-flywheel"), speeds=(200 * rpm, 600 * rpm))
    figure, axes = page(9.0, 4.2)
    speed = found.speed / rpm
    curves = (
        (found.before, PALE, "--", "without"),
        (found.closed, SERIES[0], "-.", "closed form of one mode"),
        (found.after, ACCENT, "-", "best on the whole drive"),
    )
    for curve, colour, dash, label in curves:
        axes.semilogy(speed, np.max(curve, axis=-1), color=colour, ls=dash, lw=2.0, label=label)
    axes.set_yticks([200, 500, 1000, 2000, 5000], ["200", "500", "1000", "2000", "5000"])
    axes.minorticks_off()
    axes.set_xlim(speed[0], speed[-1])
    axes.set_xlabel("input speed, rpm")
    axes.set_ylabel("alternating torque, ± N m")
    axes.legend(loc="upper right", labelcolor=INK)
    return figure


def calmed() -> Figure:
    """Draw torques as built and with the best yokes, and how the joints excite before and after."""
    found = optimise_torsion(loads(FEEDER), method=Evolution(size=12, rounds=15, runs=1))
    figure, axes = page(9.0, 6.4)
    axes.set_position([0.1, 0.55, 0.86, 0.42])
    speed = found.speed / rpm
    for curve, colour, dash, label in (
        (found.before, PALE, "--", "as built"),
        (found.after, ACCENT, "-", "best yokes"),
    ):
        axes.semilogy(speed, np.max(curve, axis=-1), color=colour, ls=dash, lw=2.0, label=label)
    axes.set_yticks([2, 10, 50, 200, 1000], ["2", "10", "50", "200", "1000"])
    axes.minorticks_off()
    axes.set_xlim(speed[0], speed[-1])
    axes.set_xlabel("input speed, rpm")
    axes.set_ylabel("alternating torque, ± N m")
    axes.legend(loc="upper right", labelcolor=INK)
    rules = found.rules_before[0], found.rules_after[0]
    reach = float(np.max(np.abs(np.cumsum(rules[0].forced))))
    for k, (rule, title) in enumerate(zip(rules, ("as built", "best yokes"), strict=True)):
        side = figure.add_axes((0.1 + 0.45 * k, 0.0, 0.41, 0.36))
        bare(side)
        _pushes(side, rule, reach)
        side.set_title(f"excitations of the joints, {title}", color=INK, fontsize=11)
    return figure


def _pushes(axes: Axes, rule: NodeRule, reach: float) -> None:
    ends = np.concatenate([[0.0], np.cumsum(rule.forced)]) / reach
    looks = {"arrowstyle": "-|>", "mutation_scale": 16, "lw": 2.2, "shrinkA": 0, "shrinkB": 0}
    for k, (one, two) in enumerate(pairwise(ends)):
        shift = 0.03j * (1 - 2 * k)  # side by side where they lie on one another
        start, stop = one - shift, two - shift
        arrow = looks | {"color": SERIES[k]}
        axes.annotate("", (stop.real, stop.imag), (start.real, start.imag), arrowprops=arrow)
        middle = 0.5 * (start + stop) - 0.12j * (1 - 2 * k)
        axes.text(middle.real, middle.imag, str(k + 1), color=SERIES[k], ha="center", va="center")
    axes.plot([0.0, ends[-1].real], [0.0, ends[-1].imag], color=INK, ls="--", lw=1.2)
    axes.set_xlim(-0.4, 1.4)
    axes.set_ylim(-0.4, 1.2)
    axes.set_aspect("equal")


PICTURES = {"absorber-on-drive": ringed, "calm-running": calmed}
"""Name of the file -> function that draws it."""
