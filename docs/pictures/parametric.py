"""Pictures of parametric resonance: the chart of Mathieu's equation, and the zone of a drive with one joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from cardan.book.mathieu_drive import MathieuReduction, mathieu_reduction, steady_twist
from cardan.maths.periodic.mathieu import boundaries, damped_zone
from cardan.units import deg

from .kit import ACCENT, INK, SERIES, page


def chart() -> Figure:
    """Draw where Mathieu's equation is stable, the zones with damping in them, and the way of a drive through them."""
    figure, axes = page(9.5, 4.6)
    q = 5.0 * np.linspace(0.0, 1.0, 301) ** 2
    a, b = boundaries(q, 4)
    axes.fill_betweenx(q, -3.0, a[:, 0], color="#f3e3cd", lw=0)
    axes.plot(a[:, 0], q, color=INK, lw=1.2)
    for r in range(1, 5):
        axes.fill_betweenx(q, b[:, r - 1], a[:, r], color="#f3e3cd", lw=0)
        axes.plot(b[:, r - 1], q, color=INK, lw=1.2)
        axes.plot(a[:, r], q, color=INK, lw=1.2)
        lower, upper = damped_zone(q, 0.1, r)
        there = np.isfinite(lower)
        label = "edges with damping, n = 0.1" if r == 1 else None
        axes.plot(
            np.concatenate((lower[there][::-1], upper[there])),
            np.concatenate((q[there][::-1], q[there])),
            color="#b00020",
            lw=1.2,
            ls=(0, (4, 2)),
            label=label,
        )
    axes.plot([0.0, 17.0], [0.0, 0.22 * 17.0], color=ACCENT, lw=1.6, label="a drive, faster to the left")
    axes.set_xlim(-3.0, 17.0)
    axes.set_ylim(0.0, 5.0)
    axes.set_xlabel(r"$a = (\omega_e/\omega_1)^2$")
    axes.set_ylabel("$q$")
    axes.set_xticks([-2, 0, 1, 4, 9, 16])
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


def edge(drive: MathieuReduction, side: float) -> float:
    """Return where a leaves the principal zone of the exact drive, by secants from the edge that q says."""

    def over(a: float) -> float:
        return steady_twist(replace(drive, speed=drive.natural_frequency / np.sqrt(a))).half_trace + 1.0

    share = drive.q / drive.a
    one, two = (1.0 + side * by * share for by in (0.9, 1.0))
    high, low = over(one), over(two)
    for _round in range(6):
        one, two = two, two - low * (two - one) / (low - high)
        high, low = low, over(two)
        if abs(two - one) < 1e-7:
            break
    return two


def zone() -> Figure:
    """Draw the principal zone of a drive with one joint over its bend: exact, with the right q, with the book's."""
    figure, axes = page(9.0, 4.2)
    joint_angles = np.linspace(0.0, 30.0, 61)

    def drive(joint_angle: float) -> MathieuReduction:
        return mathieu_reduction(
            [joint_angle * deg], [0.0], [1000.0, 4000.0], first_inertia=1.0, last_inertia=0.4, speed=np.sqrt(2800.0)
        )

    slope = np.asarray([drive(joint_angle).q for joint_angle in joint_angles])
    for share, colour, label in ((1.0, "#d7ece8", "by q"), (0.5, "#e2e5e9", "by the book's q")):
        # on the way of a drive through the chart q = slope a
        low, high = (1.0 / (1.0 + side * share * slope) for side in (1.0, -1.0))
        axes.fill_betweenx(joint_angles, 1.0 / np.sqrt(high), 1.0 / np.sqrt(low), color=colour, lw=0, label=label)
    for joint_angle in (6.0, 12.0, 18.0, 24.0, 30.0):
        for side in (-1.0, 1.0):
            label = "exact drive" if joint_angle == 6.0 and side > 0 else None
            axes.plot(
                1.0 / np.sqrt(edge(drive(joint_angle), side)), joint_angle, "o", color=SERIES[1], ms=5, label=label
            )
    axes.set_xlabel(r"speed over the natural frequency, $\omega_1/\omega_e$")
    axes.set_ylabel("joint angle [°]")
    axes.set_ylim(0.0, 31.0)
    axes.legend(loc="lower right")
    return figure


PICTURES = {"mathieu-chart": chart, "principal-zone": zone}
"""Name of the file -> function that draws it."""
