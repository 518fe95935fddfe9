"""What there is to say of the whirl of the whole line: where and when it is largest, by orders, while running up."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table
from cardan.answers.quantity import Joined, Quantity, Written, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.conditions import used_speeds
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.wording import key_text, part_number
from cardan.formulas.run_up import Progress
from cardan.maths.arrays import Array
from cardan.questions.assumed import yokes_estimated
from cardan.texts import _, mark

from .answer import lacking as lacking_of_bending
from .bending import wear_factors
from .figure import line_figure, line_run_figure, order_name
from .line_run import LineRun
from .line_whirl import LineWhirl, largest_of_turn, whirl_in_use

__all__ = ["COLUMNS", "answer", "answer_of_run", "ask", "lacking"]

CLOSE = 1e-3
"""What the basis may miss of all finite elements."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the whirl of its line: bodies, bearings, a speed, and what shakes it."""
    shaken = len(drive.joints) > 1 or drive.duty.torque is not None or any(one.unbalance for one in drive.shafts)
    return (
        *lacking_of_bending(drive),
        *absent(
            (used_speeds(drive.duty) is not None, "duty.speed_range", "duty.speed"),
            (shaken, "shafts[0].unbalance", "duty.torque"),
        ),
    )


def ask(drive: Drive, *, progress: Progress | None = None) -> LineWhirl | None:
    """Return how the whole line whirls over the speeds in use; None where nothing shakes it."""
    found = whirl_in_use(drive)
    if progress is not None:
        progress(1.0)
    return found if found.peak()[0] > 0.0 else None


def otherwise(_drive: Drive) -> str:
    """Return why there is nothing to tell."""
    return _("Nothing shakes the line: no unbalance, no couple of a joint, no weight across it.")


def answer(drive: Drive, result: LineWhirl) -> Answer:
    """Return what there is to say of the steady whirl of the whole line over the speed."""
    size, speed, place = result.peak()
    return Answer(
        name="line",
        title=_("Whirl of the whole line"),
        sentence=say(
            _("the line whirls most by {size}, at {speed}, {place} behind joint 1, mostly in {order}."),
            size=Quantity(size, "displacement", 3),
            speed=Quantity(speed, "angular_speed", 3),
            place=Quantity(place, "length", 3),
            order=order_name(_order(result, speed, place)),
        ),
        tables=(_parts(drive, result), _orders(result), *_supports(drive, result)),
        remarks=(*yokes_estimated(drive), *_remarks(drive, result)),
        keys=(
            KeyFigure(
                name="line_whirl",
                title=_("largest whirl of the line"),
                place=say(_("at {speed}"), speed=Quantity(speed, "angular_speed", 3)),
                value=Quantity(size, "displacement", 3),
                check="whirl_amplitude",
            ),
        ),
        figures=lambda: (line_figure(drive, result),),
        facts={
            "peak": Quantity(size, "displacement"),
            "peak_at": Quantity(speed, "angular_speed"),
            "peak_place": Quantity(place, "length"),
            "cracked": list(result.cracked),
            "residual": result.residual,
            "assumed": [spelled(path) for path in result.assumed],
        },
        full=lambda: _response(drive, result),
    )


def answer_of_run(drive: Drive, result: LineRun) -> Answer:
    """Return what there is to say of the line while its speed changes."""
    held, at, _place = result.steady.peak()
    text = _("from {start:bare} to {end} in {time} the line whirls up to {size}, at {speed}, {place} behind joint 1.")
    course = drive.duty.run_up
    assert course is not None
    return Answer(
        name="line",
        title=_("Run-up of the whole line"),
        sentence=say(
            text,
            start=Quantity(abs(course.start), "angular_speed", 3),
            end=Quantity(abs(course.end), "angular_speed", 3),
            time=Quantity(result.duration, "time", 3, trim=True),
            size=Quantity(result.peak, "displacement", 3),
            speed=Quantity(result.peak_speed, "angular_speed", 3),
            place=Quantity(result.peak_place, "length", 3),
        ),
        tables=(_run_parts(drive, result),),
        remarks=(*yokes_estimated(drive), *_run_remarks(drive, result)),
        figures=lambda: (line_run_figure(drive, result),),
        facts={
            "peak": Quantity(result.peak, "displacement"),
            "peak_at": Quantity(result.peak_speed, "angular_speed"),
            "peak_place": Quantity(result.peak_place, "length"),
            "steady_peak": Quantity(held, "displacement"),
            "steady_peak_at": Quantity(at, "angular_speed"),
            "share_of_steady": result.share,
        },
        full=lambda: Table(
            name="run",
            columns=(
                Column(key="time", values=result.time, dimension="time"),
                Column(key="speed", values=result.speed, dimension="angular_speed"),
                *(
                    Column(key=f"shaft_{number}", values=column, dimension="displacement")
                    for number, column in zip(result.shaft.tolist(), result.whirl.T, strict=True)
                ),
            ),
        ),
    )


def _run_parts(drive: Drive, result: LineRun) -> Table:
    """Return the largest whirl of each shaft on the way and with the speed held."""
    most = [(float(column.max()), float(result.speed[int(column.argmax())])) for column in result.whirl.T]
    held = [result.steady.peak(shaft=int(number)) for number in result.shaft]
    return Table(
        name="shafts",
        title=_("Largest whirl of each shaft on the way, and with each speed held"),
        columns=(
            _shaft_column(drive, result.shaft.tolist()),
            Column(
                key="whirl",
                heading=_("on the way"),
                values=[size for size, _speed in most],
                dimension="displacement",
                digits=3,
            ),
            Column(key="speed", heading=_("at"), values=[speed for _size, speed in most], dimension="angular_speed"),
            Column(
                key="steady", heading=_("held"), values=[one[0] for one in held], dimension="displacement", digits=3
            ),
            Column(key="steady_speed", heading=_("at"), values=[one[1] for one in held], dimension="angular_speed"),
        ),
    )


def _run_remarks(drive: Drive, result: LineRun) -> Iterator[Remark]:
    held, at, _place = result.steady.peak()
    text = _("That is {share} of the {held} that builds up where {speed} is held.")
    share, most = Quantity(result.share, "share", 2), Quantity(held, "displacement", 3)
    yield Remark(text=say(text, share=share, held=most, speed=Quantity(at, "angular_speed", 3)))
    if result.cracked:
        text = _(
            "Cracks do not count on the way, shafts {which}; cardan rotor --run-up follows one shaft with its crack."
        )
        yield Remark(text=say(text, which=listed(list(result.cracked))), tone="warning")
    if result.cancelled:
        yield Remark(text=_("Stopped before its end."), tone="warning")
    yield from _assumptions(drive, result.steady)
    command = ("cardan", "rotor", FILE, "--line", "--run-up", "--plot", "run.svg")
    yield Remark(text=_("The line over the speed:"), command=command, tone="next")


def _shaft_column(drive: Drive, numbers: list[int]) -> Column:
    """Return the column that names shafts."""
    names = {shaft.number: shaft.name for shaft in drive.shafts}
    values = [f"{number} {names.get(number, '')}".strip() for number in numbers]
    return Column(key="shaft", heading=_("shaft"), values=values, left=True)


def _order(result: LineWhirl, speed: float, place: float) -> int:
    """Return the order that moves most at a speed and place."""
    k, p = int(np.argmin(np.abs(result.speed - speed))), int(np.argmin(np.abs(result.place - place)))
    size = np.where(result.order == 0, -1.0, np.abs(result.deflection[k, :, p]))
    return int(result.order[int(np.argmax(size))])


def _where(result: LineWhirl, values: Array) -> tuple[float, float]:
    """Return the largest of values (k,) within the speeds in use, and the speed [rad/s]."""
    k = int(np.argmax(np.where(result.within, values, -1.0)))
    return float(values[k]), float(result.speed[k])


def _parts(drive: Drive, result: LineWhirl) -> Table:
    numbers = [int(one) for one in np.unique(result.shaft)]
    most = [result.peak(shaft=number) for number in numbers]
    return Table(
        name="shafts",
        title=_("Largest whirl of each shaft at the speeds in use"),
        columns=(
            _shaft_column(drive, numbers),
            Column(
                key="whirl", heading=_("whirl"), values=[one[0] for one in most], dimension="displacement", digits=3
            ),
            Column(key="speed", heading=_("at"), values=[one[1] for one in most], dimension="angular_speed"),
            Column(key="place", heading=_("behind joint 1"), values=[one[2] for one in most], dimension="length"),
        ),
    )


def _orders(result: LineWhirl) -> Table:
    peaks = {n: result.peak(n) for n in sorted(result.order.tolist(), key=lambda n: (abs(n), n < 0)) if n}
    most = max(size for size, *_rest in peaks.values())
    shown = {n: peak for n, peak in peaks.items() if peak[0] > 1e-4 * most}
    return Table(
        name="orders",
        title=_("Orders of the input's turns"),
        aside=True,
        columns=(
            Column(key="order", heading=_("order"), values=[order_name(n) for n in shown], left=True),
            Column(
                key="amplitude",
                heading=_("largest amplitude"),
                values=[peak[0] for peak in shown.values()],
                dimension="displacement",
                digits=3,
            ),
            Column(
                key="speed", heading=_("at"), values=[peak[1] for peak in shown.values()], dimension="angular_speed"
            ),
            Column(
                key="place",
                heading=_("behind joint 1"),
                values=[peak[2] for peak in shown.values()],
                dimension="length",
            ),
        ),
    )


def _supports(drive: Drive, result: LineWhirl) -> Iterator[Table]:
    if result.support:
        force = largest_of_turn(result.order, result.support_force)
        most = [_where(result, force[:, k]) for k in range(len(result.support))]
        mean = np.abs(result.support_force[0, result.order == 0][0])
        yield Table(
            name="supports",
            title=_("Force on the supports that give way"),
            columns=(
                Column(
                    key="support",
                    heading=_("support"),
                    values=[f"{number} {drive.supports[number - 1].name}".strip() for number in result.support],
                    left=True,
                ),
                Column(key="mean", heading=_("mean"), values=mean.tolist(), dimension="force", digits=3),
                Column(
                    key="alternating",
                    heading=_("alternating"),
                    values=[one for one, _at in most],
                    dimension="force",
                    digits=3,
                ),
                Column(key="speed", heading=_("at"), values=[at for _one, at in most], dimension="angular_speed"),
            ),
        )


def _response(drive: Drive, result: LineWhirl) -> Table:
    whirl = result.whirl
    force = largest_of_turn(result.order, result.support_force)
    return Table(
        name="response",
        columns=(
            Column(key="speed", values=result.speed, dimension="angular_speed"),
            *(
                Column(
                    key=f"shaft_{number}",
                    values=np.max(whirl[:, result.shaft == number], axis=-1),
                    dimension="displacement",
                )
                for number in np.unique(result.shaft).tolist()
            ),
            *(
                Column(key=f"support_{number}_force", values=force[:, k], dimension="force")
                for k, number in enumerate(result.support)
            ),
        ),
    )


def _remarks(drive: Drive, result: LineWhirl) -> Iterator[Remark]:
    yield from _assumptions(drive, result)
    if result.cracked:
        text = _("Cracks breathe with the weight; whether the whirl is stable, cardan rotor --shaft N tells.")
        yield Remark(text=text)
    if result.beside_weight > 1.0:
        text = _(
            "At some speeds other moments at a crack exceed that of the weight: there it breathes otherwise than by "
            "weight."
        )
        yield Remark(text=text, tone="warning", code="beside_weight")
    if result.residual > CLOSE:
        text = _("Check failed: modes and static shapes miss {rest} of the motion of all finite elements.")
        yield Remark(text=say(text, rest=Quantity(result.residual, digits=2)), tone="failed", alarm=True)
    else:
        text = _("Checked: modes and static shapes agree with all finite elements at the peak.")
        yield Remark(text=text, aside=True)
    command = ("cardan", "rotor", FILE, "--line", "--plot", "line.svg")
    yield Remark(text=_("The line over the speed:"), command=command, tone="next")


def _assumptions(drive: Drive, result: LineWhirl) -> Iterator[Remark]:
    """Yield what the drive does not say and the answer takes."""
    taken = [path for path in result.assumed if path.endswith(".unbalance")]
    if taken:
        text = _(
            "Shafts without a measured unbalance, {keys}, count with what their balance grade allows, in the middle."
        )
        shaft = _("shaft {number}")
        keys = [key_text(path, shaft.format(number=part_number(path))) for path in taken]
        yield Remark(text=say(text, keys=Joined(keys)))
    if "duty.torque" in result.assumed:
        text = _("Without a torque the secondary couples of the joints do not count; give {key}.")
        yield Remark(text=say(text, key=Written("duty.torque", _("a torque of the duty"))))
    if result.worn:
        factors = wear_factors(drive)
        text = _("Splines have play: a shaft with one counts with k_n² of its bending stiffness, {factors}.")
        said = [
            say(_("k_n = {factor} for shaft {number}"), number=n, factor=Quantity(factors[n - 1], digits=2))
            for n in result.worn
        ]
        yield Remark(text=say(text, factors=Joined(said)))
    low, high = (float(one) for one in (np.min(result.damping_ratio), np.max(result.damping_ratio)))
    text = _("Damping ratio of the modes {low} to {high}, beside the dampers of the supports.")
    if high - low < 0.01 * high:
        text = _("Damping ratio of the modes {high}, beside the dampers of the supports.")
    yield Remark(text=say(text, low=Quantity(low, "share", 2), high=Quantity(high, "share", 2)))
    soft = [number for number in result.support if drive.supports[number - 1].damping is None]
    if soft:
        text = _(
            "Supports without a damping of their own, {which}, are damped as rubber is; the height of the bounce "
            "depends on it."
        )
        yield Remark(text=say(text, which=listed(soft)))


def _column_values(found: LineWhirl) -> tuple[float, float, float, float]:
    force = largest_of_turn(found.order, found.support_force)[found.within]
    return (*found.peak(), float(np.max(force, initial=0.0)))


COLUMNS = (
    SweepQuestion(
        name="line_whirl",
        doc=mark("largest whirl of the whole line at the speeds in use, where and at which speed, and on its supports"),
        told=(
            OutputColumn.of("line_whirl_um", mark("largest whirl of the line")),
            OutputColumn.of("line_whirl_speed_rpm", mark("speed at which the line whirls most")),
            OutputColumn.of("line_whirl_place_mm", mark("place behind joint 1 at which the line whirls most")),
            OutputColumn.of("line_support_force_N", mark("largest alternating force on a support that gives way")),
        ),
        of_result=_column_values,
    ),
)
"""What a sweep may ask of the whirling line."""
