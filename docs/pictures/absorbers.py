"""Pictures of absorbers and of running up."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan.formulas.absorbers import absorber_variants
from cardan.formulas.run_up import run_up

from .kit import ACCENT, INK, PALE, SERIES, page


def variants() -> Figure:
    """Draw what absorbers and dampers of a tenth of the inertia leave of a resonance."""
    found = absorber_variants(0.1, np.linspace(0.4, 1.6, 1501))
    figure, axes = page(9.0, 4.2)
    looks = {
        "none": (PALE, "--", "nothing"),
        "undamped": (SERIES[1], ":", "absorber without damping"),
        "viscous": (SERIES[0], "-.", "best viscous damper"),
        "h_infinity": (ACCENT, "-", "best absorber"),
    }
    for kind, row in zip(found.kinds, found.amplification, strict=True):
        if kind in looks:
            colour, dash, label = looks[kind]
            axes.semilogy(found.beta, np.minimum(row, 1e3), color=colour, ls=dash, lw=2.0, label=label)
    axes.set_ylim(0.3, 40.0)
    axes.set_xlim(0.4, 1.6)
    axes.set_yticks([0.5, 1, 2, 5, 10, 20], ["0.5", "1", "2", "5", "10", "20"])
    axes.minorticks_off()
    axes.set_xlabel(r"frequency over the system's own, $\beta$")
    axes.set_ylabel("amplitude over static angle")
    axes.legend(loc="upper left", labelcolor=INK)
    return figure


def passing() -> Figure:
    """Draw the swing while the frequency of the force rises through the natural one, slowly and four times as fast."""
    figure, axes = page(9.0, 4.2, 2, 1, sharex=True, sharey=True)
    for each, rate in zip(axes, (2.0, 8.0), strict=True):
        found = run_up(20.0, 0.02, rate, 40.0 / rate, time=np.linspace(0.0, 40.0 / rate, 6001))
        each.plot(rate * found.time / 20.0, found.response, color=ACCENT, lw=0.8)
        each.axvline(1.0, color=PALE, lw=1)
        each.axhline(found.peak, color=PALE, lw=1, ls="--")
        each.text(0.02, found.peak, f"peak {found.peak:.1f}", color=INK, va="bottom", size=10)
        each.text(1.98, -14.0, f"$a_s$ = {rate:g} rad/s²", color=INK, ha="right", size=10)
        each.set_xlim(0.0, 2.0)
        each.set_ylim(-18.0, 18.0)
        each.set_ylabel("$y$")
    axes[-1].set_xlabel(r"frequency of the force over the natural one, $a_s t/\omega_0$")
    return figure


PICTURES = {"absorber-variants": variants, "run-up": passing}
"""Name of the file -> function that draws it."""
