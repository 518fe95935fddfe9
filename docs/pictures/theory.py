"""Pictures of the theory: the joint as a map of the circle, the drive as a polygon."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cardan import Drive, equivalent_joint, motion
from cardan.maths.kernel import mobius
from cardan.units import deg

from .kit import ACCENT, INK, PALE, SERIES, bare, note, page

Array = Any

TRUCK = {
    "joint_angles": [11.5 * deg, (15 + 20 / 60) * deg, 15 * deg, 16.5 * deg],
    "plane_twists": [(1 + 54 / 60) * deg, -(22 + 56 / 60) * deg, (49 + 59 / 60) * deg],
}
"""Printed angles of the four-joint truck power unit, Book section on synthesis."""


def truck(*yokes: float) -> Drive:
    """Return the truck drive with yoke angles in radians."""
    return Drive.from_angles(**TRUCK, yoke_angles=yokes)


def circle_map() -> Figure:
    """Draw equal steps of the input and what a joint makes of them."""
    figure, axes = page(9.5, 4.6, 1, 2)
    pair = mobius.hooke(np.asarray(45 * deg))
    w = np.exp(2j * np.linspace(0, np.pi, 48, endpoint=False))
    for each, points, title in zip(
        axes,
        (w, mobius.apply(pair, w)),
        (r"driving yoke: $w = e^{2i\theta}$", r"driven yoke: $w' = (w-\tau)/(1-\tau w)$"),
        strict=True,
    ):
        bare(each)
        t = np.linspace(0, 2 * np.pi, 300)
        each.plot(np.cos(t), np.sin(t), color=PALE, lw=1)
        for k, z in enumerate(points):
            each.plot([0, z.real], [0, z.imag], color=ACCENT, lw=0.5, alpha=0.35)
            each.plot(
                z.real,
                z.imag,
                "o",
                ms=6.5 if k % 12 == 0 else 4,
                color="#d55e00" if k % 12 == 0 else SERIES[0],
                zorder=3,
            )
        each.set_title(title, size=15)
        for angle, words in ((0, "θ = 0°"), (90, "45°"), (180, "90°"), (270, "135°")):
            if each is axes[0]:
                note(each, 1.2 * np.array([np.cos(np.deg2rad(angle)), np.sin(np.deg2rad(angle))]), words, size=10)
        each.set_xlim(-1.45, 1.45)
        each.set_ylim(-1.3, 1.3)
    note(axes[1], (-1.12, -1.22), "slow here", color=SERIES[0], size=11)
    note(axes[1], (1.12, -1.22), "fast here", color=SERIES[0], size=11)
    return figure


def kernel() -> Figure:
    """Draw the speed ratio of single joints."""
    figure, axes = page(9.0, 3.8)
    phi = np.linspace(0, 2 * np.pi, 721)
    for colour, joint_angle in zip(SERIES, (10, 20, 30, 40), strict=False):
        ratio = motion(Drive.from_angles([joint_angle * deg]), phi).ratio
        axes.plot(np.rad2deg(phi), ratio, color=colour, lw=2)
        axes.text(364, ratio[-1], f"{joint_angle}°", color=colour, va="center", size=12)
    axes.axhline(1, color=PALE, lw=0.8)
    axes.set_xlim(0, 360)
    axes.set_xticks(range(0, 361, 45))
    axes.set_xlabel("input angle [°]")
    axes.set_ylabel(r"speed ratio $\omega_2/\omega_1$")
    return figure


def geodesic(a: complex, b: complex, count: int = 60) -> Array:
    """Return points of the straight line of the hyperbolic plane between two points of the unit disk."""
    moved = (b - a) / (1 - np.conj(a) * b)
    t = np.linspace(0, 1, count)
    reach = np.tanh(t * np.arctanh(abs(moved))) * np.exp(1j * np.angle(moved))
    return (reach + a) / (1 + np.conj(a) * reach)


def walk(axes: Any, vertex: Array, title: str, limit: float, shift: complex = 0.0) -> None:
    """Draw a phase polygon."""
    bare(axes)
    for radius in np.arange(0.01, 2 * limit, 0.01):
        t = np.linspace(0, 2 * np.pi, 200)
        axes.plot(radius * np.cos(t), radius * np.sin(t), color="#e8ebee", lw=0.7, zorder=0)
    for k, (a, b) in enumerate(pairwise(vertex)):
        line = geodesic(a, b)
        axes.plot(line.real, line.imag, color=SERIES[k], lw=3, zorder=3, solid_capstyle="round")
        middle = line[30]
        way = 1j * (b - a) / abs(b - a)
        out = way if ((middle - vertex.mean()) * np.conj(way)).real > 0 else -way
        note(
            axes,
            [(middle + 0.09 * limit * out).real, (middle + 0.09 * limit * out).imag],
            f"{k + 1}",
            color=SERIES[k],
            size=13,
        )
    gap = geodesic(vertex[-1], vertex[0])
    if abs(vertex[-1]) > 1e-9:
        axes.plot(gap.real, gap.imag, color="#b00020", lw=1.6, ls=(0, (4, 3)), zorder=2)
    axes.plot(vertex.real, vertex.imag, "o", color=INK, ms=4.5, zorder=4)
    axes.plot(0, 0, "o", color="white", mec=INK, ms=8, zorder=5)
    axes.set_title(title, size=12)
    axes.set_xlim(shift.real - limit, shift.real + limit)
    axes.set_ylim(shift.imag - limit, shift.imag + limit)


def polygon() -> Figure:
    """Draw the phase polygon of the truck drive as built and closed."""
    from cardan import phases

    figure, axes = page(10.5, 4.4, 1, 3)
    found = phases(truck(0, 0, 0), fixed={2: 90 * deg})
    built = equivalent_joint(truck(0, 0, 0))
    settings = found.settings[:2]
    cases = [(built.vertex, f"as built: gap = {100 * float(built.speed_fluctuation):.1f} % speed fluctuation")]
    cases += [
        (setting.vertex, "closed: γ = " + ", ".join(f"{np.rad2deg(g):.1f}°" for g in setting.yoke_angle))
        for setting in settings
    ]
    for each, (vertex, title) in zip(axes, cases, strict=True):
        vertex = np.asarray(vertex)
        middle = (vertex.real.max() + vertex.real.min()) / 2 + 1j * (vertex.imag.max() + vertex.imag.min()) / 2
        walk(each, vertex, title, 0.024, middle)
    return figure


def triangle() -> Figure:
    """Draw what three bends can and cannot close."""
    figure, axes = page(9.5, 2.6, 1, 2)
    for each, joint_angles in zip(axes, ((10, 15, 17), (10, 10, 25)), strict=True):
        lengths = -np.log(np.cos(np.deg2rad(joint_angles)))
        longest = int(np.argmax(lengths))
        each.barh([1], [lengths[longest]], color=SERIES[1], height=0.5)
        x = 0.0
        for k, length in enumerate(lengths):
            if k != longest:
                each.barh([0], [length], left=x, color=(SERIES[0], SERIES[5])[int(x > 0)], height=0.5)
                note(each, (x + length / 2, 0), f"{joint_angles[k]}°", halo=False, color="white", size=11)
                x += length
        note(each, (lengths[longest] / 2, 1), f"{joint_angles[longest]}°", halo=False, color="white", size=11)
        verdict = "closes: exactly even" if x >= lengths[longest] else "cannot close"
        each.set_title(f"joint angles {', '.join(f'{b}°' for b in joint_angles)}: {verdict}", size=12)
        each.set_yticks([0, 1], ["the others", "the longest"])
        each.set_xlabel(r"$L = -\ln\cos\alpha$")
    return figure


def errors() -> Figure:
    """Draw how far the classical series are from the exact speed fluctuation of one joint."""
    figure, axes = page(9.0, 3.6)
    alpha = np.linspace(0.5, 45, 200)
    exact = np.sin(np.deg2rad(alpha)) * np.tan(np.deg2rad(alpha))
    first = np.deg2rad(alpha) ** 2
    axes.plot(alpha, 100 * exact, color=SERIES[0], lw=2.2, label=r"exact: $\sin\alpha\,\tan\alpha$")
    axes.plot(alpha, 100 * first, color=SERIES[1], lw=2.2, ls="--", label=r"first order: $\alpha^2$")
    axes.set_xlabel("joint angle [°]")
    axes.set_ylabel("speed fluctuation [%]")
    axes.set_xlim(0, 45)
    axes.set_ylim(0, 72)
    axes.legend(loc="upper left")
    return figure


PICTURES = {
    "circle-map": circle_map,
    "kernel": kernel,
    "polygon": polygon,
    "triangle": triangle,
    "classical-error": errors,
}
