"""Pictures of drives that move."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from .kit import ACCENT, DRIVEN, DRIVING, INK, PALE, SERIES, STEEL, arc, arrow, bare, note, page

Array = Any


def line_of(axes: Any, points: Array, **style: Any) -> None:
    """Draw a shaft line with joints at its inner points."""
    points = np.asarray(points)
    axes.plot(*points.T, **{"color": INK, "lw": 3.2, "zorder": 3, "solid_capstyle": "round"} | style)
    axes.plot(*points[1:-1].T, "o", ms=11, mfc="white", mec=style.get("color", INK), mew=2.2, zorder=4)


def movements() -> Figure:
    """Draw hitch, arm and parallel guidance."""
    figure, axes = page(10.5, 3.9, 1, 3)
    for each, title in zip(
        axes, ("hitch, from above", "arm, from the side", "parallel guidance, from behind"), strict=True
    ):
        bare(each)
        each.set_title(title, size=12.5)
    hitch, arm, parallel = axes
    yaw = np.deg2rad(38)
    way = np.array([np.cos(yaw), np.sin(yaw)])
    hitch.plot([-2.3, 0], [0, 0], color=PALE, lw=1, ls=(0, (5, 3)))
    hitch.plot(*np.array([0 * way, 2.3 * way]).T, color=PALE, lw=1, ls=(0, (5, 3)))
    line_of(hitch, [[-2.1, 0], [-1, 0], 1 * way, 2.1 * way])
    hitch.plot(0, 0, "o", ms=7, color=ACCENT, zorder=5)
    note(hitch, (0.12, -0.26), "$O$", color=ACCENT, size=15)
    arc(hitch, (0, 0), 1.5, 0, 38, color="#a3004f", lw=1.8)
    hitch.plot([0, 1.7], [0, 0], color=PALE, lw=0.8)
    note(hitch, (1.75, 0.5), r"$\Delta$", color="#a3004f", size=16)
    note(hitch, (-0.5, -0.22), "$l_1$", size=14)
    note(hitch, 0.62 * way + [0.16, -0.2], "$l_2$", size=14)
    pivot, rest = np.array([-0.3, -0.35]), np.array([2.0, -0.75])
    for turn, colour in ((0.0, INK), (-0.22, PALE), (0.22, PALE)):
        c, s = np.cos(turn), np.sin(turn)
        spin = np.array([[c, -s], [s, c]])
        joint, end = pivot + spin @ (rest - pivot), pivot + spin @ (np.add(rest, (0.9, -0.02)) - pivot)
        line_of(
            arm,
            [[-1.2, 0], [0, 0], joint, end],
            color=colour,
            lw=3.2 if colour == INK else 2,
            zorder=3 if colour == INK else 2,
        )
        arm.plot(*np.array([pivot, joint]).T, color=ACCENT, lw=1.6, alpha=1 if colour == INK else 0.35)
    t = np.linspace(-0.32, 0.32, 60) + np.arctan2(*(rest - pivot)[::-1])
    arm.plot(
        *(pivot[:, None] + np.linalg.norm(rest - pivot) * np.array([np.cos(t), np.sin(t)])), color=ACCENT, lw=1, ls=":"
    )
    arm.plot(*pivot, "^", ms=11, color=ACCENT, zorder=5)
    note(arm, np.add(pivot, (-0.1, -0.35)), "pivot", color=ACCENT, size=11)
    for lift, colour in ((0.0, INK), (0.62, PALE), (-0.62, PALE)):
        line_of(
            parallel,
            [[-0.9, 0], [0, 0], [2.0, lift], [2.9, lift]],
            color=colour,
            lw=3.2 if colour == INK else 2,
            zorder=3 if colour == INK else 2,
        )
    for low in (-0.28, 0.28):
        for lift in (0.0, 0.62, -0.62):
            parallel.plot(
                [0.35, 1.75], [low, low + 0.86 * lift], color=ACCENT, lw=1.4, alpha=0.9 if lift == 0 else 0.3, zorder=1
            )
        parallel.plot(0.35, low, "^", ms=8, color=ACCENT, zorder=5)
    arrow(parallel, (2.45, 0.15), (2.45, 0.52), color="#a3004f")
    arrow(parallel, (2.45, -0.15), (2.45, -0.52), color="#a3004f")
    for each in axes:
        each.margins(0.06, 0.3)
    return figure


def frozen() -> Figure:
    """Draw the speed of a joint whose joint angle changes fast, exact and with the joint angle frozen."""
    figure, axes = page(9.0, 3.6)
    alpha, rate = np.deg2rad(5), 0.1
    phi = np.linspace(0, 2 * np.pi, 721)
    c, s = np.cos(alpha), np.sin(alpha)
    below = 1 - (s * np.cos(phi)) ** 2
    still = c / below
    moving = (c + 0.5 * s * np.sin(2 * phi) * rate) / below
    axes.plot(np.rad2deg(phi), moving, color=SERIES[0], lw=2.2, label=r"exact, rate 0.1 $\omega_1$")
    axes.plot(np.rad2deg(phi), still, color=SERIES[1], lw=2.2, ls="--", label="bend frozen at 5°")
    axes.axhline(1, color=PALE, lw=0.8)
    axes.set_xlim(0, 360)
    axes.set_ylim(0.9925, 1.0095)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("input angle [°]")
    axes.set_ylabel(r"speed ratio $\omega_2/\omega_1$")
    axes.legend(loc="upper right", ncols=2)
    return figure


def spline() -> Figure:
    """Draw a spline with its engaged length and its gap."""
    figure, axes = page(9.0, 2.7)
    bare(axes)
    axes.fill([-3, 0.0, 0.0, -3], [-0.18, -0.18, 0.18, 0.18], color=STEEL, ec=INK)
    axes.fill([0.0, 2.2, 2.2, 0.0], [-0.26, -0.26, 0.26, 0.26], color="#aab4bd", ec=INK, zorder=2)
    for k in range(6):
        y = -0.26 + 0.52 * (k + 0.5) / 6
        axes.plot([0, 2.2], [y, y], color=INK, lw=0.5, zorder=2)
    for sign in (1, -1):
        axes.fill(
            [0.7, 3.1, 3.1, 0.7],
            [sign * 0.27, sign * 0.27, sign * 0.46, sign * 0.46],
            color="#7b8794",
            ec=INK,
            zorder=3,
        )
    axes.fill([3.1, 3.4, 3.4, 3.1], [-0.46, -0.46, 0.46, 0.46], color="#7b8794", ec=INK, zorder=3)
    axes.fill([3.4, 5.6, 5.6, 3.4], [-0.18, -0.18, 0.18, 0.18], color=STEEL, ec=INK)
    for x in (-3, 5.6):
        axes.plot(x, 0, "o", ms=14, mfc="white", mec=INK, mew=2, zorder=5)
        axes.plot([x, x], [-0.3, -1.15], color=PALE, lw=0.8)
    for x in (0.7, 2.2, 3.1):
        axes.plot([x, x], [0.5, 1.0], color=PALE, lw=0.8)
    for a, b, y, words, colour in (
        (0.7, 2.2, 0.9, "engaged", DRIVEN),
        (2.2, 3.1, 0.9, "gap", DRIVING),
        (-3, 5.6, -1.05, "$L$", INK),
    ):
        arrow(axes, (a, y), (b, y), head="<|-|>", color=colour, lw=1.3)
        note(axes, ((a + b) / 2, y + 0.2), words, color=colour, size=13)
    axes.set_ylim(-1.25, 1.3)
    return figure


PICTURES = {"movements": movements, "frozen": frozen, "spline": spline}
