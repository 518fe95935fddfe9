"""A drive whose joints were moved: what became of its joint angles, and how it looks now."""

from __future__ import annotations

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.drive.bodies.solids import solids
from cardan.figures.axes import axis, written
from cardan.figures.drive import views_figure
from cardan.figures.figure import Axis, Bars, Figure, Panel, Row
from cardan.figures.palette import shaft
from cardan.questions.phases.layout import Layout
from cardan.texts import _
from cardan.units import deg


def layout_figures(found: Layout) -> tuple[Figure, ...]:
    """Return the figures of a layout."""
    return (joint_angles_figure(found), views_figure(found.drive, solids(found.drive)))


def joint_angles_figure(found: Layout) -> Figure:
    """Return the joint angles before and after.

    found: a drive with its joints moved.
    """
    before, after = np.asarray(found.joint_angle_before) / deg, np.asarray(found.joint_angle) / deg
    number = np.arange(1, len(after) + 1)
    upright = axis(_("Joint angle"), "deg", [before, after], dimension="angle", include=(0.0,), least=1.0, count=4)
    ticks = tuple(float(k) for k in number)
    across = Axis(
        label=_("joint"), low=0.4, high=float(number[-1]) + 0.6, ticks=ticks, texts=written(ticks), grid=False
    )
    bars = (
        Bars(
            at=number - 0.2,
            size=before,
            texts=tuple(Quantity(float(b) * deg, "angle", decimals=1) for b in before),
            roles=("faint",),
            thick=0.36,
            label=_("as described"),
        ),
        Bars(
            at=number + 0.2,
            size=after,
            texts=tuple(Quantity(float(b) * deg, "angle", decimals=1) for b in after),
            roles=tuple(shaft(int(k) + 1) for k in number),
            thick=0.36,
            label=_("moved, in the colour of the driven shaft"),
        ),
    )
    return Figure(
        name="layout",
        title=_("Joint angles before and after the joints were moved"),
        sentence=say(_("The joints move by up to {way}."), way=Quantity(float(np.max(found.moved)), "length", 3)),
        source=_("cos α_max ≥ Π cos α of the other joints lets the yokes make a drive uniform; exact"),
        rows=(Row(panels=(Panel(series=bars, x=across, y=upright),), height=1.7),),
    )
