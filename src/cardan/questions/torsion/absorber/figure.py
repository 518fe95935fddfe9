"""Before and after over a band of speeds: what an absorber does to the alternating torque of a drive."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import axis, log_axis
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import deg, rpm

from .absorber import Absorber

DECADES = 3.0
"""Most decades of a logarithmic axis; what is smaller is cut off."""

LEAST = 1e-12
"""Torques below this share of the largest are zero."""


def absorber_figures(found: Absorber) -> tuple[Figure, ...]:
    """Return the figures of an absorber on a drive."""
    return (absorber_figure(found),)


def absorber_figure(found: Absorber) -> Figure:
    """Return the largest alternating torque over the speed without an absorber, by its closed form and at its best."""
    speed = found.speed / rpm
    judged = list(found.judged)
    curves = [np.max(one[:, judged], axis=-1) for one in (found.before, found.closed, found.after)]
    marks: list[Series] = []
    if found.tuned_speed is not None:
        marks.append(Rule(value=found.tuned_speed / rpm, upright=True, text=_("tuned to this speed"), role="accent"))
    meeting = found.omega / found.order / rpm
    if speed[0] < meeting < speed[-1] and found.tuned_speed is None:
        text = say(_("order {order} excites mode {mode}"), order=Quantity(found.order, trim=True), mode=found.mode)
        marks.append(Rule(value=meeting, upright=True, text=text))
    upper = Panel(
        series=(
            *marks,
            Curve(x=speed, y=curves[0], label=_("without"), role="muted", dash="dashed", width=1.4),
            Curve(
                x=speed, y=curves[1], label=_("closed form of one mode"), role="second order", dash="dashdot", width=1.2
            ),
            Curve(x=speed, y=curves[2], label=_("best setting"), role="accent", width=2.2),
            *unstable(speed, curves[2], found.unstable_after / rpm),
        ),
        x=axis("", "", [speed], margin=0.0, count=8),
        y=logarithmic(_("Largest alternating torque ±"), curves),
    )
    twist = found.twist / deg
    name = _("Twist of the absorber against its station ±")
    if found.kind == "pendulum":
        name = _("Angle of the pendulums ±")
    lower = Panel(
        series=(Curve(x=speed, y=twist, role="accent", width=1.4),),
        x=axis(_("input speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=axis(name, "deg", [twist[np.isfinite(twist)]], dimension="angle", include=(0.0,), count=4),
    )
    return Figure(
        name="absorber-on-drive",
        title=_("Before and after: {what} on {station}").format(what=kinds()[found.kind], station=found.host.name),
        sentence="",
        source=_("periodic solution of the exact equations of motion with the absorber as a station"),
        rows=(Row(panels=(upper,), height=2.4), Row(panels=(lower,), height=1.2)),
    )


def kinds() -> dict[str, str]:
    """Return what the kinds of absorbers are called, in the language spoken."""
    return {
        "h_infinity": _("an absorber"),
        "den_hartog": _("an absorber"),
        "viscous": _("a viscous damper"),
        "tuned": _("an absorber without damping"),
        "pendulum": _("pendulums"),
    }


def unstable(speed: Array, curve: Array, at: Array) -> Iterator[Curve]:
    """Yield marks where the motion of a curve is unstable. speed, curve (s,); at (k,): speeds of unstable motions."""
    if len(at):
        rows = [int(np.argmin(np.abs(speed - one))) for one in at]
        yield Curve(x=speed[rows], y=curve[rows], label=_("unstable"), role="failed", width=0.0, marker=4.0)


def logarithmic(label: str, curves: Sequence[Array]) -> Axis:
    """Return the logarithmic axis of torques.

    curves [N·m]: what it is to hold; what is more than three decades below the largest is cut off.
    """
    every = np.concatenate([np.asarray(one, dtype=float).ravel() for one in curves])
    every = every[np.isfinite(every)]
    high = float(np.max(every, initial=0.0)) or 1.0
    every = every[every > LEAST * high]
    low = max(float(np.min(every, initial=high)), high * 10.0**-DECADES)
    return log_axis(label, "Nm", low / 1.25, high * 1.35, dimension="torque")


FIGURES = {Absorber: absorber_figures}
"""Result -> what makes its figures."""
