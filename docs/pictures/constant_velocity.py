"""Pictures of joints of constant velocity: what holds the balls, and what happens where it misses."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.drive.joints import rzeppa, tripod
from cardan.drive.joints.common import laws
from cardan.formulas.joint_geometry import lever_choice
from cardan.units import deg

from .kit import ACCENT, DRIVEN, DRIVING, INK, PALE, SERIES, bare, note, page


def plane() -> Figure:
    """Draw two shafts, the bisecting plane between them and a ball in it."""
    figure, axes = page(8.0, 3.4)
    bare(axes)
    joint_angle = 36 * deg
    ways = np.array([1.0, 0.0]), np.array([-np.cos(joint_angle), np.sin(joint_angle)])
    for way, colour, name in zip(ways, (DRIVING, DRIVEN), ("shaft 1", "shaft 2"), strict=True):
        axes.plot(*np.outer(way, [0, 2.1]), color=colour, lw=4, solid_capstyle="round")
        axes.plot(*np.outer(way, [0, -0.5]), color=colour, lw=1, ls=(0, (8, 3, 2, 3)))
        note(axes, 2.35 * way, name, color=colour, size=12)
    half = np.array([np.sin(joint_angle / 2), np.cos(joint_angle / 2)])
    axes.plot(*np.outer(half, [-1.2, 1.35]), color=ACCENT, lw=2)
    tilted = np.array([np.sin(joint_angle / 2 + 9 * deg), np.cos(joint_angle / 2 + 9 * deg)])
    axes.plot(*np.outer(tilted, [-1.2, 1.35]), color=PALE, lw=1.5, ls="--")
    for side in (1, -1):
        axes.plot(*(side * half), "o", ms=17, mfc="white", mec=INK, mew=1.5, zorder=4)
    note(axes, 1.5 * half + [-0.6, 0.0], "bisecting plane", color=ACCENT, size=11)
    note(axes, 1.5 * tilted + [0.42, -0.15], r"missed by $\eta$", color=PALE, size=11)
    note(axes, (0.12, -0.2), "O", size=12)
    axes.set_xlim(-2.6, 2.7)
    axes.set_ylim(-1.35, 1.65)
    return figure


def demands() -> Figure:
    """Draw what each of six balls asks of the output, and their mean."""
    figure, axes = page(9.0, 3.6)
    phi = np.linspace(0, 2 * np.pi, 361)
    for k in range(3):
        each = laws.deviation(phi + k * np.pi / 3, 40 * deg, 0.5 * deg)
        axes.plot(phi / deg, each / deg, color=SERIES[k], lw=1.6, label=f"balls {k + 1} and {k + 4}")
    mean = laws.ball_demands(phi, 40 * deg, 0.5 * deg).mean
    axes.plot(phi / deg, mean / deg, color=INK, lw=2.6, label="all together")
    axes.set_xlim(0, 360)
    axes.set_xticks(range(0, 361, 60))
    axes.set_xlabel("input angle [°]")
    axes.set_ylabel("lead asked for [°]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4)
    return figure


def lever() -> Figure:
    """Draw the error of the cage over the joint angle for some lengths of the lever."""
    figure, axes = page(9.0, 3.8)
    joint_angle = np.linspace(0, 36, 181)
    best = lever_choice(0.35, 35 * deg).c
    lengths = ((0.72, "c/a = 0.72", 0), (0.70, "0.70", 0), (best, f"{best:.4f}, the best", 0.03), (0.65, "0.65", -0.05))
    for colour, (c, name, shift) in zip(SERIES, lengths, strict=False):
        error = rzeppa.plane_error(joint_angle * deg, 0.35, c) / deg
        axes.plot(joint_angle, error, color=colour, lw=2.6 if c == best else 1.6)
        axes.text(36.4, error[-1] + shift, name, color=colour, va="center", size=11)
    axes.axhline(0, color=PALE, lw=0.8)
    axes.set_xlim(0, 36)
    axes.set_xlabel("joint angle [°]")
    axes.set_ylabel("error of the cage [°]")
    return figure


def orbit() -> Figure:
    """Draw the plane of a tripod's spider: the ellipse of the tracks, the spider and the circle of its centre."""
    figure, axes = page(6.5, 4.6)
    bare(axes)
    joint_angle, turn = 40 * deg, np.linspace(0, 2 * np.pi, 361)
    axes.plot(np.cos(turn) / np.cos(joint_angle), np.sin(turn), color=PALE, lw=1.2)
    x, y = tripod.spider_centre(turn, joint_angle, 1.0)
    axes.plot(x, y, color=ACCENT, lw=1.8)
    phi = 25 * deg
    centre = np.array(tripod.spider_centre(phi, joint_angle, 1.0))
    for k in range(3):
        angle = phi + k * 120 * deg
        way = np.array([np.cos(angle), np.sin(angle)])
        axes.plot(*np.stack([centre, centre + 1.5 * way], axis=-1), color=DRIVEN, lw=4, solid_capstyle="round")
        axes.plot(
            np.cos(angle) / np.cos(joint_angle), np.sin(angle), "o", ms=20, mfc="white", mec=DRIVING, mew=2.5, zorder=4
        )
    axes.plot(*centre, "o", color=DRIVEN, ms=9, zorder=5)
    axes.plot(0, 0, "+", color=INK, ms=12, mew=1.5, zorder=6)
    note(axes, (1.42, 0.86), "tracks", color=PALE, size=11)
    note(axes, (0.62, -0.3), "orbit of the centre", color=ACCENT, size=11)
    axes.set_xlim(-1.75, 1.95)
    axes.set_ylim(-1.75, 1.15)
    return figure


PICTURES = {"bisecting-plane": plane, "ball-demands": demands, "lever-error": lever, "tripod-orbit": orbit}
