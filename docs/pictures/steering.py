"""The picture of a steering column: its speed ratio from lock to lock."""

from __future__ import annotations

from matplotlib.figure import Figure

from cardan import phases
from cardan.io import example
from cardan.units import deg

from .kit import ACCENT, INK, PALE, page


def ratio() -> Figure:
    """Draw the ratio of the shipped column as drawn, and in its best setting."""
    figure, axes = page(9.0, 3.6)
    drawn, best = phases(example("steering-column")).steering[:2]
    for one, colour, dash, label in ((drawn, PALE, "--", "as drawn"), (best, ACCENT, "-", "setting S1")):
        axes.plot(one.angle / deg, one.ratio, color=colour, ls=dash, lw=2.0, label=label)
    axes.axvline(0.0, color=INK, lw=0.8)
    axes.set_xlim(-540, 540)
    axes.set_xticks(range(-540, 541, 180))
    axes.set_xlabel("turn of the wheel from straight ahead [°]")
    axes.set_ylabel("speed ratio, pinion to wheel")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


PICTURES = {"steering-ratio": ratio}
"""Name of the file -> function that draws it."""
