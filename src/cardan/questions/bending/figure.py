"""How shafts whirl: critical speeds and what moves them, unbalance and cracks over the speed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.answers.answer import Tone
from cardan.answers.palette import DASHES, dash_of, shaft
from cardan.answers.quantity import Quantity, Say, numbered, say
from cardan.drive.drive import Drive
from cardan.figures.axes import axis, log_axis, steps, written
from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule, Series, Shape
from cardan.formulas.critical_speed import ARTICLE
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import mm, rpm

from .bending import CriticalSpeedMap, CriticalSpeeds, Part
from .cracked_run import CrackedRun
from .cracked_shafts import CrackedShafts
from .line_run import LineRun
from .line_whirl import LineWhirl
from .rotor import RotorResponse

SHOWN = 6
"""Modes with a picture of their own."""


def bending_figures(found: CriticalSpeeds) -> tuple[Figure, ...]:
    """Return the figures of critical speeds."""
    return (speeds_figure(found), shapes_figure(found))


def mode_name(part: Part, name: str = "") -> str:
    """Return what a mode is called, in words.

    name: name of that support or shaft.

    >>> mode_name(Part(kind="support", number=1), "centre"), mode_name(Part(kind="shaft", number=3, waves=2))
    ('bounce mode on support 1 (centre)', 'second bending mode, shaft 3')
    """
    which = numbered(part.number, name)
    if part.kind == "support":
        text = _("bounce mode on support {which}, sideways") if part.sideways else _("bounce mode on support {which}")
        return text.format(which=which)
    texts = {
        1: _("first bending mode, shaft {which}"),
        2: _("second bending mode, shaft {which}"),
        3: _("third bending mode, shaft {which}"),
    }
    text = texts.get(part.waves, _("bending mode with {n} half waves, shaft {which}"))
    return text.format(which=which, n=part.waves)


def speeds_figure(found: CriticalSpeeds) -> Figure:
    """Return the critical speeds beside the speeds of running."""
    count = min(len(found.actual), SHOWN)
    actual = np.asarray(found.actual[:count]) / rpm
    at = np.arange(count, 0, -1, dtype=float)
    series: list[Series] = []
    included = [0.0]
    if found.used is not None:
        high = found.used[1] / rpm
        least = ARTICLE if found.margin is None else found.margin.least
        included.append(least * high)
        series.append(_in_use(found.used, upright=True))
        text = say(_("{ratio} × the highest"), ratio=Quantity(least, trim=True))
        series.append(Rule(value=least * high, upright=True, text=text, role="muted"))
    series.append(
        Bars(
            at=at,
            size=actual,
            texts=tuple(Quantity(float(speed) * rpm, "angular_speed") for speed in actual),
            roles=tuple(_role(found, k) for k in range(count)),
            thick=0.42,
            lying=True,
        )
    )
    for k, (place, band) in enumerate(zip(at, np.asarray(found.half_band[:count]) / rpm, strict=True)):
        across = place + 0.33 * np.asarray([-1.0, -1.0, 1.0, 1.0])
        role = "warning" if found.half_crossed[k] else "cross"
        label = _("half-critical band") if k == 0 else ""
        series.append(Shape(x=band[[0, 1, 1, 0]], y=across, role=role, opacity=0.75, label=label))
    top = 1.12 * max(float(np.max(actual)), *included)
    ticks = steps(0.0, top, 8)
    names = tuple(f"{k + 1}: {mode_name(part)}" for k, part in enumerate(found.part[:count]))
    return Figure(
        name="critical-speeds",
        title=_("Bending critical speeds"),
        sentence="",
        source=_("Timoshenko beams with gyroscopic action, hinged at the joints; transfer matrices, exact"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(series),
                        x=Axis(
                            label=_("speed"),
                            unit="rpm",
                            dimension="angular_speed",
                            low=0.0,
                            high=top,
                            ticks=ticks,
                            texts=written(ticks),
                        ),
                        y=Axis(low=0.4, high=count + 1.3, ticks=tuple(at), texts=names, grid=False),
                        title=_("Critical speed of the real shafts"),
                    ),
                ),
                height=0.34 * count + 0.7,
            ),
        ),
    )


def _in_use(used: tuple[float, float], *, upright: bool) -> Series:
    """Return the speeds of running across a panel: a band, or a line for a single one."""
    low, high = (speed / rpm for speed in used)
    if low == high:
        return Rule(value=high, upright=upright, text=_("in use"), role="accent", dash="solid", width=1.4)
    return Band(low=low, high=high, upright=upright, text=_("in use"), role="accent", opacity=0.15)


def tone_of_mode(found: CriticalSpeeds, k: int) -> Tone:
    """Return how good a mode is: red where the drive runs at it or a limit is broken, amber where advice is."""
    if found.near[k] or found.half_near[k]:
        return "failed"
    if found.crossed[k]:
        return "warning" if found.part[k].kind == "support" else "failed"
    if k != found.deciding or found.margin is None:
        return "plain"
    return "failed" if found.margin.failed else "warning" if found.margin.violated else "good"


def _role(found: CriticalSpeeds, k: int) -> str:
    """Return the role of the bar of a mode."""
    tone = tone_of_mode(found, k)
    return tone if tone in ("failed", "warning") else "accent"


def shapes_figure(found: CriticalSpeeds) -> Figure:
    """Return the shapes in which the line whirls, with joints and supports."""
    count = min(len(found.speed), SHOWN)
    place = np.asarray(found.place) / mm
    across = axis(_("place along the line from joint 1"), "mm", [place], dimension="length", margin=0.04, count=8)
    rows = []
    for k in range(count):
        last = k == count - 1
        title = say(
            _("{number}: {speed} as computed, {part}"),
            number=k + 1,
            speed=Quantity(float(found.speed[k]), "angular_speed"),
            part=mode_name(found.part[k]),
        )
        panel = Panel(
            series=_shape(found, k, across.high - across.low),
            x=across if last else Axis(low=across.low, high=across.high, ticks=across.ticks, texts=()),
            y=Axis(low=-1.45, high=1.45, ticks=(), grid=False),
            title=title,
        )
        rows.append(Row(panels=(panel,), height=0.72))
    return Figure(
        name="mode-shapes",
        title=_("Shapes in which the shafts whirl"),
        sentence=_("Dots are joints, triangles what holds still, springs supports that give way; sizes are relative."),
        source=_("Finite elements of Timoshenko's beam; the line of shafts is drawn straight"),
        rows=tuple(rows),
    )


def _shape(found: CriticalSpeeds, k: int, width: float) -> tuple[Series, ...]:
    """Return one mode: a curve for each shaft, its joints and what holds it."""
    place, deflection = np.asarray(found.place) / mm, np.asarray(found.deflection[k])
    series: list[Series] = [Rule(value=0.0, dash="solid", role="faint", width=0.8)]

    def height(x: float) -> float:
        return float(np.interp(x, place, deflection))

    for number, x in enumerate(np.asarray(found.support_place) / mm, start=1):
        if math.isnan(x):
            continue
        if found.rigid[number - 1]:
            series.append(_triangle(x, height(x), width))
        else:
            series.append(replace(_spring(x, height(x), width), text=_("support {number}").format(number=number)))
            series.append(Note(text=str(number), x=x + 0.012 * width, y=-1.2, role="muted", size=7.0, side="left"))
    for number in found.held:
        x = float(found.joint_place[number - 1]) / mm
        series.append(_triangle(x, height(x), width))
    for number, (start, end) in enumerate(np.asarray(found.shaft_span) / mm, start=1):
        if math.isnan(start):
            continue
        inside = (place >= start - 1e-6) & (place <= end + 1e-6)
        series.append(
            Curve(
                x=place[inside],
                y=deflection[inside],
                role=shaft(number),
                dash=dash_of(number),
                width=2.4,
                label=_("shaft {number}").format(number=number) if k == 0 else "",
            )
        )
    joints = np.asarray([x for x in found.joint_place if not math.isnan(x)]) / mm
    heights = np.interp(joints, place, deflection)
    series.append(Curve(x=joints, y=heights, role="ink", width=0.0, marker=6.0, text=_("the joints")))
    return tuple(series)


def _triangle(x: float, y: float, width: float) -> Shape:
    half = 0.011 * width
    return Shape(x=np.asarray([x, x - half, x + half]), y=np.asarray([y - 0.08, y - 0.55, y - 0.55]), role="muted")


def _spring(x: float, y: float, width: float) -> Curve:
    """Return a zigzag from the ground to a place of the line."""
    turns = np.asarray([0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 0.0, 0.0])
    rise = np.asarray([0.0, 0.12, 0.2, 0.33, 0.46, 0.59, 0.72, 0.8, 0.88, 1.0])
    return Curve(x=x + 0.008 * width * turns, y=-1.3 + (y + 1.3) * rise, role="muted", width=1.1)


def speed_map_figures(found: CriticalSpeedMap) -> tuple[Figure, ...]:
    """Return the figures of a map of critical speeds."""
    return (speed_map_figure(found),)


def speed_map_figure(found: CriticalSpeedMap) -> Figure:
    """Return critical speeds over the stiffness of a support or the length of a shaft."""
    stiff = found.over == "stiffness"
    unit = 1e3 if stiff else mm
    value, speed = np.asarray(found.value) / unit, np.asarray(found.speed) / rpm
    order = np.argsort(value)
    series: list[Series] = []
    if found.used is not None:
        series.append(_in_use(found.used, upright=False))
    if found.drawn is not None:
        series.append(Rule(value=found.drawn / unit, upright=True, text=_("as it is"), role="muted"))
    for k in range(speed.shape[-1]):
        series.append(
            Curve(
                x=value[order],
                y=speed[order, k],
                role="accent",
                dash=DASHES[k % len(DASHES)],
                width=1.8,
                label=_("critical speed {number}").format(number=k + 1),
                marker=4.0 if value.size == 1 else 0.0,
            )
        )
    if stiff:
        along, unit_text = _("stiffness of support {number}").format(number=found.number), "N_per_mm"
    else:
        along, unit_text = _("length of shaft {number}").format(number=found.number), "mm"
    return Figure(
        name="critical-speed-map",
        title=_("What moves the critical speeds"),
        sentence=_map_sentence(found),
        source=_("Finite elements of Timoshenko's beam in whirl, all values at once; speeds as computed, without wear"),
        rows=(
            Row(
                panels=(
                    Panel(
                        series=tuple(series),
                        x=_decades(along, unit_text, value)
                        if stiff
                        else axis(along, unit_text, [value], dimension="length", count=8),
                        y=axis(_("Critical speed"), "rpm", [speed], dimension="angular_speed", include=(0.0,), count=6),
                    ),
                ),
                height=2.4,
            ),
        ),
    )


def _decades(label: str, unit: str, value: np.ndarray) -> Axis:
    """Return a logarithmic axis over positive values, marked at powers of ten or at 1, 2, 5 of them."""
    low, high = float(np.min(value)), float(np.max(value))
    if low == high:
        low, high = 0.5 * low, 2.0 * high
    return log_axis(label, unit, low, high, dimension="stiffness")


def _map_sentence(found: CriticalSpeedMap) -> Say:
    order = np.argsort(np.asarray(found.value))
    first = np.asarray(found.speed)[order, 0]
    one, other = (Quantity(float(speed), "angular_speed", 3) for speed in (first[0], first[-1]))
    text = _("As shaft {number} grows longer, the first critical speed goes from {one:bare} to {other}.")
    if found.over == "stiffness":
        text = _("As support {number} grows stiffer, the first critical speed goes from {one:bare} to {other}.")
    return say(text, number=found.number, one=one, other=other)


# How a shaft whirls with its unbalance and its crack: orders over the speed, the way of its centre, a run-up.

ORDERS = (1, 2, 3, -1)
"""Orders drawn, forward and backward."""

LOWEST = 1e-5
"""Share of the largest amplitude at which the axis ends."""

POINTS = 721
"""Points of an orbit."""

MICRO = 1e-6
"""Metres in a micrometre."""


def rotor_figures(found: RotorResponse) -> tuple[Figure, ...]:
    """Return the figures of a steady response."""
    return (response_figure(found), orbits_figure(found))


def order_name(order: float) -> str:
    """Return the name of an order of whirling.

    >>> order_name(2), order_name(-1)
    ('order 2', 'order 1 backward')
    """
    text = _("order {order}") if order >= 0 else _("order {order} backward")
    return text.format(order=f"{abs(order):g}")


def response_figure(found: RotorResponse) -> Figure:
    """Return the amplitudes of the orders over the speed, with the speeds of running and where whirling grows."""
    speed = found.steady.speed / rpm
    rows = {order: found.steady.order_amplitude(order) / MICRO for order in ORDERS}
    top = max(float(np.nanmax(row)) for row in rows.values()) or 1.0
    shown = {order: row for order, row in rows.items() if float(np.nanmax(row)) > LOWEST * top}
    series: list[Series] = []
    if found.used is not None:
        low, high = (one / rpm for one in found.used)
        if high > low:
            series.append(Band(low=low, high=high, upright=True, text=_("in use"), role="accent", opacity=0.08))
    series += [
        Band(low=low / rpm, high=high / rpm, upright=True, text=_("unstable"), role="failed", opacity=0.15)
        for low, high in found.unstable
        if high > low
    ]
    critical = found.rotor.critical / rpm
    names = ((1, _("critical")), (2, _("half")), (3, _("third")))
    series += [
        Rule(value=critical / n, upright=True, text=name, dash="dotted")
        for n, name in names
        if speed[0] < critical / n < speed[-1]
    ]
    series += [
        Curve(x=speed, y=np.maximum(row, LOWEST * top), role=shaft(k + 2), dash=DASHES[k], label=order_name(order))
        for k, (order, row) in enumerate(shown.items())
    ]
    panel = Panel(
        series=tuple(series),
        x=axis(_("speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=_rotor_decades(_("Amplitude amid the shaft"), list(shown.values()), LOWEST * top),
    )
    return Figure(
        name="rotor",
        title=_("Whirling of shaft {number} over the speed").format(number=found.rotor.shaft),
        sentence="",
        source=_("lowest mode of bending as one mass; orders of the cracked rotor, exact"),
        rows=(Row(panels=(panel,), height=2.6),),
    )


def line_figure(drive: Drive, found: LineWhirl) -> Figure:
    """Return the largest whirl of every shaft of the line over the speed, with the speeds of running."""
    speed, whirl = found.speed / rpm, found.whirl / MICRO
    names = {one.number: one.name for one in drive.shafts}
    rows = {int(number): np.max(whirl[:, found.shaft == number], axis=-1) for number in np.unique(found.shaft)}
    top = max(float(np.max(row)) for row in rows.values()) or 1.0
    series: list[Series] = []
    if found.used is not None and found.used[1] > found.used[0]:
        low, high = (one / rpm for one in found.used)
        series.append(Band(low=low, high=high, upright=True, text=_("in use"), role="accent", opacity=0.08))
    for k, (number, row) in enumerate(rows.items()):
        label = names.get(number) or _("shaft {number}").format(number=number)
        series.append(
            Curve(
                x=speed, y=np.maximum(row, LOWEST * top), role=shaft(number), dash=DASHES[k % len(DASHES)], label=label
            )
        )
    panel = Panel(
        series=tuple(series),
        x=axis(_("speed"), "rpm", [speed], dimension="angular_speed", margin=0.0, count=8),
        y=_rotor_decades(_("Largest whirl"), list(rows.values()), LOWEST * top),
    )
    return Figure(
        name="line",
        title=_("Whirl of the whole line over the speed"),
        sentence="",
        source=_("Timoshenko beams on damped supports; unbalances, secondary couples, weight and cracks"),
        rows=(Row(panels=(panel,), height=2.6),),
    )


def line_run_figure(drive: Drive, found: LineRun) -> Figure:
    """Return the whirl of the line over the speed, on the way and with each speed held."""
    on_the_way, held = np.max(found.whirl, axis=-1) / MICRO, np.max(found.steady.whirl, axis=-1) / MICRO
    ways = ((found.speed, on_the_way, _("on the way")), (found.steady.speed, held, _("each speed held")))
    panel = Panel(
        series=tuple(
            Curve(x=speed / rpm, y=row, role=role, dash=DASHES[k], label=label)
            for k, ((speed, row, label), role) in enumerate(zip(ways, ("accent", "muted"), strict=True))
        ),
        x=axis(_("speed"), "rpm", [speed / rpm for speed, *_rest in ways], dimension="angular_speed", count=8),
        y=axis(_("Largest whirl"), "um", [row for _speed, row, _label in ways], dimension="displacement"),
    )
    return Figure(
        name="line-run",
        title=_("Whirl of the whole line while its speed changes"),
        sentence="",
        source=_("motion in time of Timoshenko beams on damped supports"),
        rows=(Row(panels=(panel,), height=2.6),),
    )


def _rotor_decades(label: str, rows: list[Array], least: float) -> Axis:
    """Return a logarithmic axis of displacements."""
    low = max(min(float(np.nanmin(row)) for row in rows), least) / 1.2
    high = max(float(np.nanmax(row)) for row in rows) * 1.3
    return log_axis(label, "um", low, high, dimension="displacement")


def _way(z: Array, title: str, reach: float, *, role: str = "accent") -> Panel:
    """Return the way of a shaft's centre as one sees it against the power flow: sideways to the right, up upwards."""
    ticks = steps(-reach, reach, 4)

    def along(name: str) -> Axis:
        return Axis(
            label=name, unit="um", dimension="displacement", low=-reach, high=reach, ticks=ticks, texts=written(ticks)
        )

    curve = Curve(x=z.imag / MICRO, y=-z.real / MICRO, role=role, width=1.1)
    start = Curve(x=z.imag[:1] / MICRO, y=-z.real[:1] / MICRO, role="ink", width=0.0, marker=5.0)
    return Panel(series=(curve, start), x=along(_("sideways")), y=along(_("upwards")), title=title, equal=True)


def orbits_figure(found: RotorResponse) -> Figure:
    """Return the ways of the shaft's centre about its middle at a third, at half and near the critical speed."""
    critical = found.rotor.critical
    wanted = [(1.0 / 3.0, _("a third of the critical speed")), (0.5, _("half")), (0.9, _("nine tenths"))]
    turn = np.linspace(0.0, 2.0 * np.pi, POINTS)
    panels = []
    for share, name in wanted:
        k = int(np.argmin(np.abs(found.steady.speed - share * critical)))
        path = found.steady.at(turn)[k]
        path = path - np.mean(path[:-1])
        reach = 1.15 * float(np.nanmax(np.abs(path))) / MICRO or 1.0
        panels.append(_way(path, name, reach if math.isfinite(reach) else 1.0))
    return Figure(
        name="rotor-orbits",
        title=_("Way of the centre of shaft {number} in a turn").format(number=found.rotor.shaft),
        sentence=say(
            _("The shaft sags by {sag} and whirls about that; an inner loop is the mark of a crack."),
            sag=Quantity(found.rotor.sag, "displacement", 3),
        ),
        source=_("seen against the power flow; the dot is where the crack, or the driving yoke, looks down"),
        rows=(Row(panels=tuple(panels), height=2.4),),
        legend=False,
    )


def run_figure(number: int, found: CrackedRun) -> Figure:
    """Return the distance of the centre from its place over a change of speed, and its orders."""
    away = np.abs(found.deflection - found.static) / MICRO
    speed, order, size = found.orders()
    course = Panel(
        series=(Curve(x=found.speed / rpm, y=away, role="accent", width=0.7),),
        x=axis(_("speed"), "rpm", [found.speed / rpm], dimension="angular_speed", margin=0.0, count=8),
        y=axis(_("Distance from its place at rest"), "um", [away], dimension="displacement", include=(0.0,)),
    )
    curves = tuple(
        Curve(
            x=speed / rpm,
            y=np.abs(size[:, order == one])[:, 0] / MICRO,
            role=shaft(k + 2),
            dash=DASHES[k],
            label=order_name(one),
        )
        for k, one in enumerate(ORDERS)
    )
    orders = Panel(
        series=curves,
        x=axis(_("speed"), "rpm", [found.speed / rpm], dimension="angular_speed", margin=0.0, count=8),
        y=axis(
            _("Amplitudes of its orders"), "um", [one.y for one in curves], dimension="displacement", include=(0.0,)
        ),
    )
    return Figure(
        name="rotor-run",
        title=_("Shaft {number} while the speed changes").format(number=number),
        sentence="",
        source=_("motion in time of the lowest mode; orders fitted over four turns"),
        rows=(Row(panels=(course,), height=1.7), Row(panels=(orders,), height=1.7)),
    )


TURNS = 4  # of two shafts beside a joint that are drawn, the last ones


def joined_figure(numbers: tuple[int, int], found: CrackedShafts) -> Figure:
    """Return the ways of two shafts beside a joint over the last turns."""
    panels = []
    for k, number in enumerate(numbers):
        last = found.angle[:, k] > found.angle[-1, k] - 2.0 * math.pi * TURNS
        path = found.deflection[last, k]
        path = path - np.mean(path)
        reach = 1.15 * float(np.max(np.abs(path))) / MICRO or 1.0
        panels.append(_way(path, _("shaft {number}").format(number=number), reach, role=shaft(number)))
    text = _("The last {turns} turns.")
    return Figure(
        name="rotor-joined",
        title=_("Ways of the centres of shafts {one} and {two}").format(one=numbers[0], two=numbers[1]),
        sentence=text.format(turns=TURNS),
        source=_("motion in time of both lowest modes, joined by the exact joint"),
        rows=(Row(panels=tuple(panels), height=3.0),),
        legend=False,
    )
