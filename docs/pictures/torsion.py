"""Pictures of torsional vibration: a joint in the node of a mode, and what yoke angles do to a torque."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from cardan.drive.drive import Drive
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.units import rpm

from .kit import ACCENT, INK, PALE, SERIES, page


def node() -> Figure:
    """Draw the mode of the unstable stand and of the cured one, each with its joint."""
    from cardan.io import example

    figure, axes = page(9.0, 3.6, 1, 2, sharey=True)
    words = ("grows at 1340 rpm", "dies out at 1340 rpm")
    for each, name, text in zip(axes, ("unstable-drive", "cured-drive"), words, strict=True):
        found = torsion_modes(example(name))
        line = list(found.train.line)
        place, shape = found.train.position[line], found.shape[0, line]
        driving, _driven = found.train.joints[0]
        each.axhline(0.0, color=PALE, lw=0.8)
        each.plot(place, shape, color=SERIES[0], lw=3, solid_capstyle="round")
        each.plot(place[[0, -1]], shape[[0, -1]], "s", color=INK, ms=9)
        at = found.train.position[driving], found.shape[0, driving]
        each.plot(*at, "o", color=ACCENT, ms=9)
        each.annotate("joint", at, (12, -14), textcoords="offset points", color=ACCENT, size=11)
        each.plot(found.nodes[0][0].position, 0.0, "x", color=INK, ms=8, mew=1.5)
        each.annotate("node", (found.nodes[0][0].position, 0.0), (-30, 8), textcoords="offset points", size=11)
        each.set_title(f"κ = {abs(found.joint_weight[0, 0]):.2f}: {text}", size=11, loc="left")
        each.set_xticks([])
        each.set_yticks([])
        each.set_ylim(-0.75, 1.2)
        each.spines[["left", "bottom"]].set_visible(False)
    return figure


def yokes() -> Figure:
    """Draw how far the torque of the truck unit swings, with its yokes in line and set to cancel each other."""
    from cardan.io import example

    drive, even = example("truck-power-unit"), example("truck-exact-yokes")
    shafts = tuple(
        replace(one, yoke_angle=other.yoke_angle) if 1 < one.number < 5 else one
        for one, other in zip(drive.shafts, even.shafts, strict=True)
    )
    speed = np.linspace(200.0, 1000.0, 161)
    figure, axes = page(9.0, 3.8)
    for k, (each, label) in enumerate(((drive, "yokes in line"), (replace(drive, shafts=shafts), "exact yoke angles"))):
        axes.semilogy(speed, _swing(each, speed), color=SERIES[k], lw=2, label=label)
    axes.axhline(400.0, color=PALE, lw=1, ls="--")
    axes.text(990.0, 440.0, "mean torque", size=10, ha="right", color=INK)
    axes.axvline(860.0, color=ACCENT, lw=1, ls="--")
    axes.text(868.0, 6.0, "runs", size=10, color=ACCENT)
    axes.set_xlabel("input speed [rpm]")
    axes.set_ylabel("swing of the torque [± N·m]")
    axes.set_xlim(200.0, 1000.0)
    axes.legend(frameon=False, loc="upper right")
    return figure


def _swing(drive: Drive, speed: np.ndarray) -> np.ndarray:
    _train, model = loaded_model(drive, drive.duty, speed * rpm)
    found = periodic_response(parted(model)[0], speed=speed * rpm)
    return 0.5 * np.max(found.peak_to_peak, axis=-1)


PICTURES = {"torsion-node": node, "torsion-yokes": yokes}
