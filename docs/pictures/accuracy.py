"""The picture of crosses that move along their journals."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cardan import Drive
from cardan.drive.accuracy import Error
from cardan.questions.accuracy.accuracy import one_turn
from cardan.questions.accuracy.cross_play import cross_slides
from cardan.units import deg, mm

from .kit import DRIVEN, DRIVING, INK, page


def crosses() -> Figure:
    """Draw how the crosses of two joints move, the first with a yoke too far out and arms that miss each other."""
    drive = Drive.from_angles([20 * deg, 20 * deg])
    ways = cross_slides(drive, errors=[Error(s1=0.05 * mm, a2=0.05 * mm), None]) / (1e-3 * mm)
    figure, axes = page(9.0, 3.6)
    angle = np.append(one_turn(), 2 * np.pi) / deg
    for j, dash in enumerate(("-", "--")):
        for k, (colour, yoke) in enumerate(((DRIVING, "driving"), (DRIVEN, "driven"))):
            curve = np.append(ways[j, k], ways[j, k, 0])
            axes.plot(angle, curve, color=colour, ls=dash, lw=1.8, label=f"joint {j + 1}, {yoke} journals")
    axes.axhline(0.0, color=INK, lw=0.8)
    axes.set_xlim(0, 360)
    axes.set_xticks(range(0, 361, 60))
    axes.set_xlabel("input angle [°]")
    axes.set_ylabel("way of the cross [µm]")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    return figure


PICTURES = {"cross-play": crosses}
"""Name of the file -> function that draws it."""
