"""Pictures of bending critical speeds."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.questions.bending.bending import bending_speeds, critical_speed_map
from cardan.units import mm, rpm

from .kit import ACCENT, INK, PALE, SERIES, page


def shapes() -> Figure:
    """Draw how a shaft in two pieces bounces on its rubber, and how its rear piece bows."""
    from cardan.io import example

    drive = example("two-piece-rubber-bearing")
    found = bending_speeds(drive, modes=2)
    figure, axes = page(9.0, 3.6, 2, 1, sharex=True)
    place, joints = found.place / mm, found.joint_place / mm
    words = ("the centre bearing bounces", "the rear piece bows")
    for each, shape, speed, text in zip(axes, found.deflection, found.speed / rpm, words, strict=True):
        each.axhline(0.0, color=PALE, lw=0.8)
        for k, (start, end) in enumerate(found.shaft_span[1:3] / mm):
            inside = (place >= start - 1e-6) & (place <= end + 1e-6)
            each.plot(place[inside], shape[inside], color=SERIES[k], lw=3, solid_capstyle="round")
        x = float(found.support_place[0]) / mm
        top = float(np.interp(x, place, shape))
        zigzag = np.asarray([0, 0, 1, -1, 1, -1, 1, -1, 0, 0]) * 14.0
        rise = np.asarray([0, 0.12, 0.2, 0.33, 0.46, 0.59, 0.72, 0.8, 0.88, 1.0])
        each.plot(x + zigzag, -1.3 + (top + 1.3) * rise, color=INK, lw=1)
        each.plot(joints, np.interp(joints, place, shape), "o", color=INK, ms=6)
        for end in joints[[0, -1]]:
            each.plot([end, end - 22, end + 22, end], [-0.12, -0.62, -0.62, -0.12], color=INK, lw=1)
        each.set_ylim(-1.4, 1.4)
        each.set_yticks([])
        each.spines["left"].set_visible(False)
        each.set_title(f"{speed:.0f} rpm: {text}", size=11, loc="left")
    axes[-1].set_xlabel("along the line [mm]")
    return figure


def stiffness() -> Figure:
    """Draw the lowest critical speeds over the stiffness of the centre bearing."""
    from cardan.io import example

    found = critical_speed_map(example("two-piece-rubber-bearing"), np.geomspace(1e4, 1e9, 81), modes=2)
    figure, axes = page(9.0, 3.8)
    for k, label in enumerate(("first", "second")):
        axes.semilogx(found.value / 1e3, found.speed[:, k] / rpm, color=SERIES[k], lw=2, label=label)
    assert found.used is not None
    assert found.drawn is not None
    axes.axhspan(*(speed / rpm for speed in found.used), color=ACCENT, alpha=0.12, lw=0)
    axes.text(12.0, found.used[1] / rpm + 150, "speeds in use", color=ACCENT, size=10)
    axes.axvline(found.drawn / 1e3, color=PALE, ls="--", lw=1)
    axes.text(1.06 * found.drawn / 1e3, 400, "rubber", color=INK, size=10)
    axes.text(9e5, 400, "rolling bearing in a stiff housing", color=INK, size=10, ha="right")
    axes.set_xlim(10.0, 1e6)
    axes.set_ylim(0.0, 14000.0)
    axes.set_xlabel("stiffness of the centre bearing [N/mm]")
    axes.set_ylabel("critical speed [rpm]")
    axes.legend(loc="upper left", labelcolor=INK)
    return figure


PICTURES = {"bending-shapes": shapes, "bending-stiffness": stiffness}
"""Name of the file -> function that draws it."""
