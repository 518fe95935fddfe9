"""Running up through a resonance: the swing over time, and the torque behind a joint over the speed."""

from __future__ import annotations

import numpy as np

from cardan.answers.numbers import significant
from cardan.figures.axes import axis
from cardan.figures.figure import Curve, Figure, Panel, Row, Rule
from cardan.formulas.joint_run_up import JointRunUp
from cardan.formulas.run_up import RunUp
from cardan.texts import _
from cardan.units import rpm


def run_up_figures(found: RunUp) -> tuple[Figure, ...]:
    """Return the figures of an oscillator's run-up."""
    return (run_up_figure(found),)


def joint_run_up_figures(found: JointRunUp) -> tuple[Figure, ...]:
    """Return the figures of a run-up behind a joint."""
    return (joint_run_up_figure(found),)


def run_up_figure(found: RunUp) -> Figure:
    """Return the response over time, with the passing of the resonance and the peak.

    found: of one run.
    """
    panel = Panel(
        series=(
            Rule(value=found.passing_time, upright=True, text=_("frequencies meet")),
            Curve(x=found.time, y=found.response, role="accent", width=1.0),
            Rule(value=found.peak, role="muted", text=significant(found.peak, 3)),
            Rule(value=-found.peak, role="muted"),
        ),
        x=axis(_("time"), "s", [found.time], dimension="time", margin=0.0, count=8),
        y=axis(
            _("Response over the static one"), "–", [found.response], mirrored=0.0, include=(found.peak,), margin=0.12
        ),
    )
    return Figure(
        name="run-up",
        title=_("Running up through the resonance"),
        sentence=_(
            "The peak of {peak} times the static angle comes at {time} s; running steadily it would be {steady}."
        ).format(
            peak=significant(found.peak, 3),
            time=significant(found.peak_time, 3),
            steady=significant(found.steady_peak, 3),
        ),
        source=_("exact, in complex error functions"),
        rows=(Row(panels=(panel,), height=2.2),),
        legend=False,
    )


def joint_run_up_figure(found: JointRunUp) -> Figure:
    """Return the torque behind a joint over the input speed, with the speed of order 2 and the peak.

    found: of one run.
    """
    speed = found.acceleration * np.asarray(found.time) / rpm
    panel = Panel(
        series=(
            Rule(value=found.order2_speed / rpm, upright=True, text=_("order 2 meets the natural frequency")),
            Curve(x=speed, y=found.torque, role="accent", width=1.0),
            Rule(value=found.peak_torque, role="muted", text=f"{significant(found.peak_torque, 3)} N·m"),
            Rule(value=-found.peak_torque, role="muted"),
        ),
        x=axis(_("input speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=axis(
            _("Torque in the driven shaft"),
            "N·m",
            [found.torque],
            mirrored=0.0,
            include=(found.peak_torque,),
            margin=0.12,
        ),
    )
    return Figure(
        name="joint-run-up",
        title=_("Torque behind the joint while running up"),
        sentence=_("The torque peaks at {peak} N·m at {speed} rpm, after passing the resonance at {at} rpm.").format(
            peak=significant(found.peak_torque, 3),
            speed=significant(found.peak_speed / rpm, 3),
            at=significant(found.order2_speed / rpm, 3),
        )
        if found.peak_speed > found.order2_speed
        else _("The torque peaks at {peak} N·m; the run ends before the resonance at {at} rpm is passed.").format(
            peak=significant(found.peak_torque, 3), at=significant(found.order2_speed / rpm, 3)
        ),
        source=_("impulse responses from step to step; exact joint"),
        rows=(Row(panels=(panel,), height=2.2),),
        legend=False,
    )
