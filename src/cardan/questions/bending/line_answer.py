"""What there is to say of the whirl of the whole line: where and when it is largest, by orders, what supports take."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table
from cardan.answers.quantity import Quantity, listed, say
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.yokes import yokes_estimated
from cardan.maths.arrays import Array
from cardan.texts import _

from .figure import line_figure, order_name
from .line_whirl import LineWhirl, largest_of_turn

__all__ = ["answer"]

CLOSE = 1e-3
"""What the basis may miss of all finite elements."""


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
    whirl = result.whirl
    numbers = [int(one) for one in np.unique(result.shaft)]
    most = [_where(result, np.max(whirl[:, result.shaft == number], axis=-1)) for number in numbers]
    names = {shaft.number: shaft.name for shaft in drive.shafts}
    return Table(
        name="shafts",
        title=_("Largest whirl of each shaft at the speeds in use"),
        columns=(
            Column(
                key="shaft",
                heading=_("shaft"),
                values=[f"{number} {names.get(number, '')}".strip() for number in numbers],
                left=True,
            ),
            Column(
                key="whirl", heading=_("whirl"), values=[one for one, _at in most], dimension="displacement", digits=3
            ),
            Column(key="speed", heading=_("at"), values=[at for _one, at in most], dimension="angular_speed"),
        ),
    )


def _orders(result: LineWhirl) -> Table:
    peaks = {n: result.peak(n) for n in sorted(result.order.tolist(), key=lambda n: (abs(n), n < 0)) if n}
    most = max(size for size, *_rest in peaks.values())
    shown = {n: peak for n, peak in peaks.items() if peak[0] > 1e-4 * most}
    return Table(
        name="orders",
        title=_("Orders of the input's turns"),
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
    taken = [path for path in result.assumed if path.endswith(".unbalance")]
    if taken:
        text = _("Shafts without a measured unbalance, {keys}, count with what their balance grade allows, amid them.")
        yield Remark(text=text.format(keys=", ".join(map(spelled, taken))))
    if "duty.torque" in result.assumed:
        yield Remark(text=_("Without a torque the secondary couples of the joints do not count; give duty.torque."))
    low, high = (float(one) for one in (np.min(result.damping_ratio), np.max(result.damping_ratio)))
    text = _("Damping ratio of the modes {low} to {high}, beside the dampers of the supports.")
    yield Remark(text=say(text, low=Quantity(low, "share", 2), high=Quantity(high, "share", 2)))
    soft = [number for number in result.support if drive.supports[number - 1].damping is None]
    if soft:
        text = _("Supports without `damping`, {which}, lose what rubber does; how high the bounce is depends on it.")
        yield Remark(text=say(text, which=listed(soft)))
    if result.cracked:
        text = _("Cracks breathe with the weight; whether the whirl is stable, `cardan rotor --shaft N` tells.")
        yield Remark(text=text)
    if result.residual > CLOSE:
        text = _("Check failed: modes and static shapes miss {rest} of the motion of all finite elements.")
        yield Remark(text=say(text, rest=Quantity(result.residual, digits=2)), tone="failed", alarm=True)
    else:
        yield Remark(text=_("Checked: modes and static shapes agree with all finite elements at the peak."))
    command = ("cardan", "rotor", FILE, "--line", "--plot", "line.svg")
    yield Remark(text=_("The line over the speed:"), command=command, tone="next")
