"""What absorbers and dampers make of a resonance, and running up through one."""

from __future__ import annotations

import numpy as np

from cardan.answers.reader import significant
from cardan.figures.axes import axis, written
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import rpm

from .absorbers import AbsorberResponse, Variants
from .run_up import JointRunUp, RunUp

ACROSS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
"""Amplifications marked along the axis."""

LOOKS = {
    "none": ("muted", "dashed"),
    "undamped": ("first order", "dotted"),
    "viscous": ("second order", "dashdot"),
    "den_hartog": ("ink", "dashed"),
    "h_infinity": ("accent", "solid"),
}
"""Role and dash of each variant."""


def _names() -> dict[str, str]:
    return {
        "none": _("without absorber"),
        "undamped": _("absorber without damping"),
        "viscous": _("best viscous damper"),
        "den_hartog": _("absorber by fixed points"),
        "h_infinity": _("absorber with the smallest peak"),
    }


def variants_figure(found: Variants) -> Figure:
    """Return the amplification over the frequency with each absorber and damper."""
    best = float(np.min(found.peak))
    curves = []
    for kind, row in zip(found.kinds, found.amplification, strict=True):
        (role, dash), width = LOOKS[kind], 2.2 if kind == "h_infinity" else 1.4
        curves.append(Curve(x=found.beta, y=_open(row), label=_names()[kind], role=role, dash=dash, width=width))
    panel = Panel(
        series=(*curves, Rule(value=best, text=significant(best, 3))),
        x=_along(found.beta),
        y=_upright(found.amplification, best),
    )
    return Figure(
        name="absorber-variants",
        title=_("Absorbers and dampers of the same inertia"),
        sentence=_(
            "With {share} of the system's inertia an absorber leaves {best} times the static angle, a viscous damper "
            "{loose} times."
        ).format(
            share=significant(found.inertia_ratio, 3),
            best=significant(best, 3),
            loose=significant(float(found.peak[found.kinds.index("viscous")]), 3),
        ),
        source=_(
            "Kozhevnikov & Perfil'ev (1978), eq. 249–252; smallest peak by Nishihara and Asami; exact for one mode"
        ),
        rows=(Row(panels=(panel,), height=2.6),),
    )


def before_after_figure(found: AbsorberResponse) -> Figure:
    """Return the amplification with an absorber beside that without, and the twist of its spring."""
    size, bare = np.asarray(found.amplification), np.asarray(found.bare)
    twist = np.abs(np.asarray(found.twist))
    most = float(np.max(size[np.isfinite(size)], initial=0.0))
    upper = Panel(
        series=(
            Curve(x=found.beta, y=_open(bare), label=_("without absorber"), role="muted", dash="dashed", width=1.4),
            Curve(x=found.beta, y=_open(size), label=_("with absorber"), role="accent", width=2.0),
        ),
        x=_along(found.beta, named=False),
        y=_upright(np.stack((bare, size)), most),
    )
    lower = Panel(
        series=(Curve(x=found.beta, y=_open(twist), role="accent", width=1.4),),
        x=_along(found.beta),
        y=axis(_("Twist between absorber and system over the static angle"), "–", [twist], include=(0.0,), count=4),
    )
    undamped = not np.any(np.asarray(found.main)[np.isfinite(size)].imag)
    return Figure(
        name="absorber",
        title=_("Vibration before and after"),
        sentence=_(
            "Nothing damps the absorber: the vibration has no bound at {low} and {high} times the frequency."
        ).format(low=significant(float(found.natural[..., 0]), 3), high=significant(float(found.natural[..., 1]), 3))
        if undamped
        else _("With the absorber the amplitude stays below {most} times the static angle here.").format(
            most=significant(most, 3)
        ),
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 249, 252; exact for one mode"),
        rows=(Row(panels=(upper,), height=2.2), Row(panels=(lower,), height=1.3)),
    )


def _open(row: Array) -> Array:
    """Return a curve that breaks off where it is infinite."""
    return np.where(np.isfinite(row), row, np.nan)


def _along(beta: Array, *, named: bool = True) -> Axis:
    return axis(_("frequency over the system's own, β = ω/ω₀") if named else "", "", [beta], margin=0.0, count=8)


def _upright(rows: Array, peak: float) -> Axis:
    """Return the logarithmic axis of amplifications, from what is seen of them to well above the peak."""
    there = rows[np.isfinite(rows) & (rows > 0.0)]
    high = max(4.0 * peak if np.isfinite(peak) else 0.0, 10.0)
    low = max(float(np.min(there, initial=0.5)), high / 1000.0) * 0.9
    ticks = tuple(value for value in ACROSS if low <= value <= high)
    texts = tuple(written((value,))[0] if value >= 1.0 else f"{value:g}" for value in ticks)
    label = _("Amplitude over the static angle")
    return Axis(label=label, unit="–", low=low, high=high, ticks=ticks, texts=texts, log=True)


# Running up through a resonance: the swing over time, and the torque behind a joint over the speed.


def run_up_figure(found: RunUp) -> Figure:
    """Return the response over time, with the passing of the resonance and the peak."""
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
    """Return the torque behind a joint over the input speed, with the speed of order 2 and the peak."""
    speed, most = found.acceleration * np.asarray(found.time) / rpm, found.peak_torque
    panel = Panel(
        series=(
            Rule(value=found.order2_speed / rpm, upright=True, text=_("order 2 meets the natural frequency")),
            Curve(x=speed, y=found.torque, role="accent", width=1.0),
            Rule(value=most, role="muted", text=f"{significant(most, 3)} N·m"),
            Rule(value=-most, role="muted"),
        ),
        x=axis(_("input speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=axis(_("Torque in the driven shaft"), "N·m", [found.torque], mirrored=0.0, include=(most,), margin=0.12),
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


FIGURES = {
    AbsorberResponse: before_after_figure,
    Variants: variants_figure,
    RunUp: run_up_figure,
    JointRunUp: joint_run_up_figure,
}
"""Result -> what makes its figure."""
