"""Torsional vibration in time: torques of the elements and speeds of the stations."""

from __future__ import annotations

import numpy as np

from cardan.answers.palette import DASHES
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row
from cardan.maths.ties import foremost
from cardan.questions.torsion.steady.figure import looks, worst_elements
from cardan.texts import _
from cardan.units import rpm

from .torsion_transient import Transient


def transient_figures(found: Transient) -> tuple[Figure, ...]:
    """Return the figure of a drive in time."""
    return (transient_figure(found),)


def transient_figure(found: Transient) -> Figure:
    """Return torques and speeds over time."""
    motion = found.motion
    names = found.train.elements
    ends = motion.extremes
    swing = np.nan_to_num(ends.torque_high - ends.torque_low)
    worst = worst_elements(swing)
    line = list(found.train.line)
    liveliest = int(foremost(np.nan_to_num(ends.speed_high - ends.speed_low)))
    drawn = list(dict.fromkeys([line[0], line[-1], liveliest]))
    stations = found.train.station_names
    torques = Panel(
        series=tuple(
            Curve(x=motion.times, y=motion.torque[:, e], role=role, dash=dash, width=1.0, label=names[e])
            for e, role, dash in looks(found.train, worst)
        ),
        x=axis("", "", [motion.times], margin=0.0, count=8),
        y=axis(_("Torque"), "Nm", [motion.torque[:, worst]], dimension="torque", count=5),
    )
    speeds = Panel(
        series=tuple(
            Curve(
                x=motion.times,
                y=motion.speed[:, k] / rpm,
                role="accent" if n else "ink",
                dash=DASHES[n % 4],
                width=1.0,
                label=stations[k],
            )
            for n, k in enumerate(drawn)
        ),
        x=axis(_("time"), "s", [motion.times], dimension="time", margin=0.0, count=8),
        y=axis(_("Speed"), "rpm", [motion.speed[:, drawn] / rpm], dimension="angular_speed", count=4),
    )
    return Figure(
        name="torsion-transient",
        title=_("Torques and speeds in time"),
        sentence="",
        source=_("exact equations of motion in steps of one length")
        if motion.method == "fixed steps"
        else _("exact equations of motion, steps held to their error"),
        rows=(Row(panels=(torques,), height=2.0), Row(panels=(speeds,), height=1.4)),
    )


FIGURES = {Transient: transient_figures}
"""Result -> what makes its figures."""
