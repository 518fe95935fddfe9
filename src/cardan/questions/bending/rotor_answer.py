"""What there is to say of a whirling shaft: orders over the speed, run-up, both shafts beside a joint."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table
from cardan.answers.quantity import Quantity, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.wording import key_text
from cardan.errors import InputError
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import foremost_of
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, mark

from .answer import lacking as lacking_of_bending
from .cracked_run import CrackedRun
from .cracked_shafts import CrackedShafts
from .figure import ORDERS, joined_figure, order_name, rotor_figures, run_figure
from .line_whirl import whirl_in_use
from .rotor import Rotor, RotorResponse, rotor_response

__all__ = ["COLUMNS", "answer", "answer_of_joined", "answer_of_run", "ask", "lacking"]

ROUNDING = 1e-9
"""Share of the largest order below which one is none."""

BALANCE = 1e-6
"""What power and multipliers may miss of their balance."""

SHOWN = 12
"""Windows of a run that people are shown."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the whirl of a shaft: bodies, bearings, and an unbalance or a crack."""
    excited = any(shaft.crack or shaft.unbalance for shaft in drive.shafts)
    return (*lacking_of_bending(drive), *absent((excited, "shafts[1].unbalance", "shafts[1].crack")))


def ask(drive: Drive, **choices: Any) -> RotorResponse:
    """Return how a shaft whirls by itself and, where the file says enough, among all others on their supports."""
    found = rotor_response(drive, **choices)
    try:
        return replace(found, line=whirl_in_use(drive))
    except InputError:
        return found


def answer(drive: Drive, result: RotorResponse) -> Answer:
    """Return what there is to say of the steady whirl of a shaft over the speed."""
    used = result.used
    bad = [one for one in result.unstable if used and one[1] >= used[0] and one[0] <= used[1]]
    return Answer(
        name="rotor",
        title=_("Whirl of shaft {number}").format(number=result.rotor.shaft),
        sentence=_sentence(result),
        tone="failed" if bad else "plain",
        tables=(_peaks(result),),
        remarks=(*yokes_estimated(drive), *_remarks(result)),
        keys=tuple(_keys(result)),
        figures=lambda: rotor_figures(result) if _whirls(result) else (),
        facts={
            "rotor": _rotor(result.rotor),
            "unstable": Quantity([list(one) for one in result.unstable], "angular_speed"),
            "half_order": Quantity(result.steady.speed[result.steady.half_order], "angular_speed"),
            "behind_joint": None
            if result.behind is None
            else {"order": result.behind.order, "force_share": result.behind.size},
        },
        full=lambda: _response(result),
        code=1 if bad else 0,
    )


def answer_of_run(drive: Drive, rotor: Rotor, result: CrackedRun) -> Answer:
    """Return what there is to say of a shaft while its speed changes."""
    speed, order, size = result.orders()
    size = _told(np.abs(size), rotor.sag + result.peak)
    shown = [k for k, number in enumerate(order) if number in ORDERS]

    def table(rows: slice, name: str = "") -> Table:
        columns = (
            Column(
                key=f"order_{order[k]:g}".replace("-", "minus_"),
                heading=f"{order[k]:g}×",
                values=size[rows, k],
                dimension="displacement",
                digits=3,
            )
            for k in shown
        )
        speeds = Column(key="speed", heading=_("speed"), values=speed[rows], dimension="angular_speed")
        return Table(name=name, columns=(speeds, *columns))

    text = _("from {start:bare} to {end} shaft {number} is displaced by up to {size}, at {speed}.")
    return Answer(
        name="rotor",
        title=_("Run-up of shaft {number}").format(number=rotor.shaft),
        sentence=_at_rest(rotor)
        if not result.peak
        else say(
            text,
            start=Quantity(float(result.speed[0]), "angular_speed", 3),
            end=Quantity(float(result.speed[-1]), "angular_speed", 3),
            number=rotor.shaft,
            size=Quantity(result.peak, "displacement", 3),
            speed=Quantity(result.peak_speed, "angular_speed", 3),
        ),
        tables=(table(slice(None, None, max(1, len(speed) // SHOWN))),),
        remarks=(*yokes_estimated(drive), *_shaft(rotor)),
        figures=lambda: (run_figure(rotor.shaft, result),) if result.peak else (),
        facts={
            "rotor": _rotor(rotor),
            "peak": Quantity(result.peak, "displacement"),
            "peak_at": Quantity(result.peak_speed, "angular_speed"),
        },
        full=lambda: table(slice(None), "orders"),
    )


def answer_of_joined(drive: Drive, first: Rotor, second: Rotor, result: CrackedShafts) -> Answer:
    """Return what there is to say of both shafts beside a joint."""
    fits = [result.orders(k, turns=8, reach=4) for k in (0, 1)]
    order = sorted((int(one) for one in fits[0][0]), key=lambda one: (abs(one), one < 0))
    found = [np.asarray([float(np.abs(size[own == one][0])) for one in order]) for own, size in fits]
    sizes = [_told(one, np.max(one, initial=0.0)).tolist() for one in found]
    table = Table(
        name="orders",
        columns=(
            Column(key="order", heading=_("order"), values=order),
            *(
                Column(
                    key=key,
                    heading=_("shaft {number}").format(number=shaft.shaft),
                    values=values,
                    dimension="displacement",
                    digits=3,
                )
                for key, shaft, values in zip(("first", "second"), (first, second), sizes, strict=True)
            ),
        ),
        note=_("Orders are of each shaft's own turns, over the last eight; order 0 is the sag under its weight."),
    )
    text = _("shafts {one} and {two} at {speed}, joint angle {angle}: largest 1st order {size}.")
    largest = max((row[order.index(1)] for row in sizes), default=0.0) if 1 in order else 0.0
    return Answer(
        name="rotor",
        title=_("Whirl of shafts {one} and {two}").format(one=first.shaft, two=second.shaft),
        sentence=say(
            text,
            one=first.shaft,
            two=second.shaft,
            speed=Quantity(result.speed, "angular_speed", 3),
            angle=Quantity(result.joint_angle, "angle", decimals=1),
            size=Quantity(largest, "displacement", 3),
        ),
        tables=(table,),
        remarks=(
            *yokes_estimated(drive),
            *_shaft(first),
            *_shaft(second),
            _checked(result.residual, _("the energy balance closes")),
        ),
        figures=lambda: (joined_figure((first.shaft, second.shaft), result),),
        facts={
            "speed": Quantity(result.speed, "angular_speed"),
            "first": _rotor(first),
            "second": _rotor(second),
            "residual": result.residual,
        },
    )


def _sentence(result: RotorResponse) -> Text:
    sizes = {order: result.peak(order) for order in ORDERS}
    known = {order: one for order, one in sizes.items() if math.isfinite(one[1])}
    if not known:
        return say(_("shaft {number} has no steady motion at these speeds."), number=result.rotor.shaft)
    order = foremost_of(known, lambda one: known[one][1])
    speed, size = known[order]
    if not size:
        return _at_rest(result.rotor)
    return say(
        _("shaft {number} by itself whirls most in {order}: {size} at {speed}, {share} of its own critical speed."),
        number=result.rotor.shaft,
        order=order_name(order),
        size=Quantity(size, "displacement", 3),
        speed=Quantity(speed, "angular_speed", 3),
        share=Quantity(speed / result.rotor.critical, decimals=2),
    )


def _at_rest(rotor: Rotor) -> Text:
    """Return that nothing makes a shaft whirl."""
    return say(_("shaft {number} by itself does not whirl: it has no unbalance in its mode."), number=rotor.shaft)


def _told(sizes: Array, scale: ArrayLike) -> Array:
    """Return amplitudes, 0 where they are rounding beside a size of the same motion."""
    return np.where(sizes <= ROUNDING * np.asarray(scale), 0.0, sizes)


def _peaks(result: RotorResponse) -> Table:
    """Return the orders with where they are largest."""
    peaks = [result.peak(order) for order in ORDERS]
    largest = max((size for _speed, size in peaks if math.isfinite(size)), default=0.0)
    sizes = _told(np.asarray([size for _speed, size in peaks]), largest).tolist()
    speeds = [speed if size > 0.0 else None for (speed, _size), size in zip(peaks, sizes, strict=True)]
    return Table(
        title=_("Orders at the speeds in use"),
        columns=(
            Column(key="order", heading=_("order"), values=[order_name(order) for order in ORDERS]),
            Column(
                key="amplitude",
                heading=_("largest amplitude"),
                values=sizes,
                dimension="displacement",
                digits=3,
            ),
            Column(key="speed", heading=_("at"), values=speeds, dimension="angular_speed"),
            Column(
                key="share",
                heading=_("over the critical speed"),
                values=[None if speed is None else speed / result.rotor.critical for speed in speeds],
                decimals=2,
            ),
        ),
    )


def _response(result: RotorResponse) -> Table:
    """Return all orders over all speeds."""
    steady = result.steady
    orders = [int(one) for one in steady.order if abs(one) <= 4]
    return Table(
        name="response",
        columns=(
            Column(key="speed", values=steady.speed, dimension="angular_speed"),
            *(
                Column(
                    key=f"order_{one}".replace("-", "minus_"),
                    values=steady.order_amplitude(one),
                    dimension="displacement",
                )
                for one in orders
            ),
            Column(key="spectral_radius", values=steady.spectral_radius),
            Column(key="stable", values=[bool(one) for one in steady.stable]),
        ),
    )


def _shaft(rotor: Rotor) -> Iterator[Remark]:
    """Yield what the shaft is modelled as."""
    text = _("Shaft {number} is modelled as {mass} on {stiffness}: critical at {speed}, sagging by {sag}.")
    yield Remark(
        text=say(
            text,
            number=rotor.shaft,
            mass=Quantity(rotor.mass, "mass", 3),
            stiffness=Quantity(rotor.stiffness, "stiffness", 3, unit="N_per_mm"),
            speed=Quantity(rotor.critical, "angular_speed"),
            sag=Quantity(rotor.sag, "displacement", 3),
        )
    )
    text = _("Its modal unbalance is {amount}.")
    if any(path.endswith(".unbalance") for path in rotor.assumed):
        text = _("Its modal unbalance is taken as {amount}, as much as its balance grade allows.")
    yield Remark(text=say(text, amount=Quantity(rotor.unbalance, "unbalance", 3)))
    if rotor.cracked:
        text = _("Its open crack takes {xi} of its stiffness along it and {eta} across it.")
        xi, eta = (Quantity(loss, "share", 3) for loss in rotor.crack.losses)
        yield Remark(text=say(text, xi=xi, eta=eta))
    else:
        how = key_text(f"shafts[{rotor.shaft - 1}].crack", "", _("; {key} in the file gives it one"))
        yield Remark(text=say(_("It has no crack{how}."), how=how))


def _remarks(result: RotorResponse) -> Iterator[Remark]:
    yield from _in_line(result)
    yield from _shaft(result.rotor)
    used, steady = result.used, result.steady
    for low, high in result.unstable:
        text = _("Warning: from {low:bare} to {high} the whirl is unstable, whatever the unbalance.")
        said = say(text, low=Quantity(low, "angular_speed"), high=Quantity(high, "angular_speed"))
        yield Remark(text=said, tone="failed", alarm=used is not None and high >= used[0] and low <= used[1])
    half = steady.speed[steady.half_order]
    if half.size:
        text = _("About {speed} it is unstable with half orders.")
        yield Remark(text=say(text, speed=Quantity(float(half[0]), "angular_speed")), tone="warning")
    if result.behind is not None:
        sizes = dict(zip(result.behind.order.tolist(), result.behind.size.tolist(), strict=True))
        text = _("The joints before it add {three} of its force at order 3 and {back} backward.")
        share = {"three": Quantity(sizes[3], "share", 2), "back": Quantity(sizes[-1], "share", 2)}
        yield Remark(text=say(text, **share))
    known = ~(np.isnan(steady.residual) | np.isnan(steady.vibration_share))
    if result.rotor.cracked and float(steady.vibration_share[known].max(initial=0.0)) > 1.0:
        text = _("At some speeds the vibration exceeds the sag: there the crack breathes otherwise than by weight.")
        yield Remark(text=text, tone="warning")
    yield _checked(float(steady.residual[known].max(initial=0.0)), _("power and multipliers agree"))
    if _whirls(result):
        command = ("cardan", "rotor", FILE, "--plot", "rotor.svg")
        yield Remark(text=_("Orders over the speed, and orbits:"), command=command, tone="next")
    text = _("This is one shaft in one mode; all shafts on their supports:")
    yield Remark(text=text, command=("cardan", "rotor", FILE, "--line"), tone="next")


def _in_line(result: RotorResponse) -> Iterator[Remark]:
    """Yield what the shaft does in the whole line, which is the answer for the drive."""
    if result.line is not None and result.rotor.shaft in result.line.shaft:
        size, speed, _place = result.line.peak(shaft=result.rotor.shaft)
        text = _("In the whole line, with all that shakes it and on its supports, it whirls by {size}, at {speed}.")
        whole = say(text, size=Quantity(size, "displacement", 3), speed=Quantity(speed, "angular_speed", 3))
        yield Remark(text=whole, tone="warning")


def _checked(residual: float, what: str) -> Remark:
    """Return the remark on a balance that closes, or does not."""
    if residual <= BALANCE:
        return Remark(text=_("Checked: {what} to rounding.").format(what=what), aside=True)
    text = _("Check failed: {what} to {rest} only.")
    return Remark(text=say(text, what=what, rest=Quantity(residual, digits=2)), tone="failed", alarm=True)


def _largest(result: RotorResponse) -> tuple[float, float] | None:
    """Return the speed [rad/s] and amplitude [m] of the order that is largest; None where none is known."""
    peaks = [one for one in map(result.peak, ORDERS) if math.isfinite(one[1])]
    return foremost_of(peaks, lambda one: one[1]) if peaks else None


def _whirls(result: RotorResponse) -> bool:
    """Tell whether a shaft whirls by itself, or cannot be told."""
    peak = _largest(result)
    return peak is None or peak[1] > 0.0


def _keys(result: RotorResponse) -> Iterator[KeyFigure]:
    peak = _largest(result)
    if peak is not None and _whirls(result) and result.line is None:  # else the line tells how far the shaft whirls
        speed, size = peak
        place = say(
            _("shaft {number}, at {speed}"), number=result.rotor.shaft, speed=Quantity(speed, "angular_speed", 3)
        )
        value = Quantity(size, "displacement", 3)
        yield KeyFigure(name="whirl", title=_("largest whirl amplitude of a shaft by itself"), place=place, value=value)


def _rotor(rotor: Rotor) -> dict[str, Any]:
    return {
        "shaft": rotor.shaft,
        "mass": Quantity(rotor.mass, "mass"),
        "stiffness": Quantity(rotor.stiffness, "stiffness"),
        "critical": Quantity(rotor.critical, "angular_speed"),
        "sag": Quantity(rotor.sag, "displacement"),
        "unbalance": Quantity(rotor.unbalance, "unbalance"),
        "unbalance_angle": Quantity(rotor.unbalance_angle, "angle"),
        "crack_losses": list(rotor.crack.losses),
        "crack_angle": Quantity(rotor.crack_angle, "angle"),
        "breathing": rotor.crack.breathing,
        "damping_ratio": rotor.damping_ratio,
        "assumed": [spelled(path) for path in rotor.assumed],
    }


def _column_values(found: RotorResponse) -> tuple[float, float, float]:
    speed, size = _largest(found) or (math.nan, math.nan)
    return (size, speed, float(len(found.unstable)))


COLUMNS = (
    SweepQuestion(
        name="whirl",
        doc=mark("largest whirl of a shaft by itself, with an unbalance or a crack, and in how many ranges it grows"),
        told=(
            OutputColumn.of("whirl_um", mark("largest whirl amplitude of an order, of a shaft by itself")),
            OutputColumn.of("whirl_speed_rpm", mark("speed at which it is so")),
            OutputColumn(name="unstable_ranges", text=mark("ranges of speed in which whirling grows by itself")),
        ),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of a whirling shaft."""
