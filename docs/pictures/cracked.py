"""Pictures of cracked shafts."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.questions.bending.cracked_rotor import UNCRACKED, Crack, cracked_rotor

from .kit import ACCENT, INK, PALE, SERIES, page

MASS, STIFFNESS = 0.617, 18875.0
CRACK = Crack(loss_xi=0.1, loss_eta=0.02)


def orders() -> Figure:
    """Draw the orders of a cracked and a sound shaft over the speed."""
    figure, axes = page(9.0, 4.2)
    ratio = np.linspace(0.2, 1.2, 601)
    speed = ratio * np.sqrt(STIFFNESS / MASS)
    found = cracked_rotor(MASS, STIFFNESS, speed, crack=CRACK, damping_ratio=0.02, unbalance=4e-6)
    sound = cracked_rotor(MASS, STIFFNESS, speed, damping_ratio=0.02, unbalance=4e-6)
    for n, colour, label in (
        (1, SERIES[0], "once, forward"),
        (-1, SERIES[4], "once, backward"),
        (2, ACCENT, "twice"),
        (3, SERIES[1], "three times"),
    ):
        axes.semilogy(ratio, 1e6 * found.order_amplitude(n), color=colour, lw=1.8, label=label)
    axes.semilogy(ratio, 1e6 * sound.order_amplitude(1), color=PALE, ls="--", lw=1.5, label="sound shaft, once")
    axes.set_ylim(0.3, 2000.0)
    axes.set_xlim(0.2, 1.2)
    axes.set_yticks([1, 10, 100, 1000], ["1", "10", "100", "1000"])
    axes.minorticks_off()
    axes.set_xlabel(r"speed over the critical one, $\Omega/\omega_0$")
    axes.set_ylabel("amplitude [µm]")
    axes.legend(loc="upper left", labelcolor=INK, ncols=2)
    return figure


def orbits() -> Figure:
    """Draw the orbits of a sound and a cracked shaft at a third, a half and most of the critical speed."""
    figure, axes = page(9.0, 3.4, 1, 3)
    turn = np.linspace(0.0, 2.0 * np.pi, 721)
    for each, ratio, label in zip(axes, (1 / 3, 0.5, 0.9), ("a third", "half", "nine tenths"), strict=True):
        speed = ratio * np.sqrt(STIFFNESS / MASS)
        for crack, colour, width in ((UNCRACKED, PALE, 2.4), (CRACK, ACCENT, 1.6)):
            found = cracked_rotor(MASS, STIFFNESS, speed, crack=crack, damping_ratio=0.02, unbalance=4e-6)
            path = 1e6 * found.at(turn)
            each.plot(path.imag, path.real, color=colour, lw=width)
        each.invert_yaxis()
        each.set_aspect("equal", adjustable="datalim")
        each.set_title(f"{label} of $\\omega_0$", size=11)
        each.set_xlabel("sideways [µm]")
    axes[0].set_ylabel("down [µm]")
    return figure


PICTURES = {"cracked-orders": orders, "cracked-orbits": orbits}
"""Name of the file -> function that draws it."""
