"""Pictures of centred double joints and pin couplings."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.drive.joints import double_cardan, pin_coupling
from cardan.formulas.joint_geometry import best_centring
from cardan.units import deg

from .kit import ACCENT, DRIVEN, DRIVING, INK, PALE, SERIES, arc, bare, note, page


def triangle() -> Figure:
    """Draw the triangle of both joint centres and the crossing of the outer axes."""
    figure, axes = page(8.5, 3.2)
    bare(axes)
    joint_angle, share = 40 * deg, 0.46
    x = float(double_cardan.slide(joint_angle, share))
    first, crossing = np.array([-share, 0.0]), np.zeros(2)
    way = np.array([np.cos(joint_angle), np.sin(joint_angle)])
    third = x * way
    axes.plot(*np.stack([np.add(first, [-0.75, 0]), first], -1), color=DRIVING, lw=5, solid_capstyle="round")
    axes.plot(*np.stack([third, third + 0.75 * way], -1), color=DRIVEN, lw=5, solid_capstyle="round")
    axes.plot(*np.stack([first, crossing], -1), color=DRIVING, lw=2.2)
    axes.plot(*np.stack([crossing, third], -1), color=DRIVEN, lw=1.2, ls=(0, (6, 3)))
    axes.plot(*np.stack([crossing, 0.55 * np.array([1.0, 0.0])], -1), color=PALE, lw=1, ls=(0, (8, 3, 2, 3)))
    axes.plot(*np.stack([first, third], -1), color=INK, lw=4, solid_capstyle="round")
    for place in (first, third):
        axes.plot(*place, "o", ms=11, mfc="white", mec=INK, mew=2, zorder=5)
    axes.plot(*crossing, "o", ms=13, color=ACCENT, zorder=5)
    arc(axes, crossing, 0.36, 0, joint_angle / deg, color=PALE, lw=1)
    note(axes, (0.44, 0.15), r"$\alpha$", size=14)
    one, other = (float(part) / deg for part in double_cardan.split(joint_angle, share))
    arc(axes, first, 0.34, 0, one, color=PALE, lw=1)
    note(axes, np.add(first, [0.42, 0.08]), r"$\alpha_{12}$", size=13)
    arc(axes, third, 0.3, one, other, color=PALE, lw=1)
    note(axes, np.add(third, [0.38, 0.22]), r"$\alpha_{23}$", size=13)
    note(axes, 0.5 * np.add(first, [0, -0.1]), r"$\lambda l$", size=13, color=DRIVING)
    note(axes, 0.5 * np.add(third, [0.1, -0.05]), "$x$", size=13, color=DRIVEN)
    note(axes, 0.5 * (first + third) + [-0.06, 0.11], "$l$", size=13)
    note(axes, np.add(first, [-0.02, 0.15]), "$O_1$", size=12)
    note(axes, np.add(third, [-0.02, 0.16]), "$O_3$", size=12)
    note(axes, (0.02, -0.14), "ball", size=11, color=ACCENT)
    axes.set_xlim(-1.3, 1.35)
    axes.set_ylim(-0.25, 0.95)
    return figure


def speed_fluctuation() -> Figure:
    """Draw the speed fluctuation of a ball in the middle and of the best ones for two ranges."""
    figure, axes = page(9.0, 3.6)
    joint_angles = np.linspace(0.0, 42.0, 211)
    choices = [(0.5, "ball in the middle")]
    choices += [(best_centring(most * deg).share, f"best to {most}°") for most in (30, 40)]
    for colour, (share, name) in zip(SERIES, choices, strict=False):
        left = 100 * np.abs(double_cardan.unevenness(*double_cardan.split(joint_angles * deg, share)))
        axes.plot(joint_angles, left, color=colour, lw=2, label=rf"{name}, $\lambda$ = {share:.4f}")
    axes.set_xlim(0, 42)
    axes.set_ylim(0, 1.5)
    axes.set_xlabel("joint angle [°]")
    axes.set_ylabel("speed fluctuation [%]")
    axes.legend(loc="upper left")
    return figure


def pin_lead() -> Figure:
    """Draw the lead of unlike pins over a turn."""
    figure, axes = page(9.0, 3.4)
    phi = np.linspace(0, 2 * np.pi, 361)
    joint_angle, slant, a = 30 * deg, 35 * deg, 0.04
    for colour, shift in zip(SERIES, (1e-3, 6e-3), strict=False):
        found = pin_coupling.pin_contact(phi, joint_angle, a + shift, a - shift, slant, slant)
        off = pin_coupling.missed_by_pins(phi, joint_angle, shift, slant)
        along = pin_coupling.along_alike(phi, joint_angle, a, slant)
        first = pin_coupling.missed_plane(phi, joint_angle, off, along * np.sin(slant))
        axes.plot(phi / deg, found.deviation / deg, color=colour, lw=2, label=f"±{1e3 * shift:g} mm of 40 mm")
        axes.plot(phi / deg, first / deg, color=colour, lw=1.2, ls=(0, (2, 2)), label="to first order")
    axes.axhline(0, color=PALE, lw=0.8)
    axes.set_xlim(0, 360)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("input angle from the inner side of the joint angle [°]")
    axes.set_ylabel("output ahead [°]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


PICTURES = {"centring-triangle": triangle, "centring-fluctuation": speed_fluctuation, "pin-lead": pin_lead}
