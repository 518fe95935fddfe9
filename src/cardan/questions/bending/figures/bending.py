"""How the shafts whirl, at which speeds, and what would move these."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.answers.numbers import significant
from cardan.answers.quantity import Quantity, Say, numbered, say
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule, Series, Shape
from cardan.figures.palette import DASHES, dash_of, shaft
from cardan.formulas.critical_speed import ARTICLE
from cardan.questions.bending.bending import CriticalSpeeds, Part, Running
from cardan.questions.bending.speed_map import CriticalSpeedMap
from cardan.texts import _
from cardan.units import mm, rpm

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
        return _("bounce mode on support {which}").format(which=which)
    texts = {
        1: _("first bending mode, shaft {which}"),
        2: _("second bending mode, shaft {which}"),
        3: _("third bending mode, shaft {which}"),
    }
    text = texts.get(part.waves, _("bending mode with {n} half waves, shaft {which}"))
    return text.format(which=which, n=part.waves)


def speeds_figure(found: CriticalSpeeds) -> Figure:
    """Return the critical speeds beside the speeds of running.

    found: of one drive.
    """
    count = min(len(found.actual), SHOWN)
    actual = np.asarray(found.actual[:count]) / rpm
    at = np.arange(count, 0, -1, dtype=float)
    series: list[Series] = []
    included = [0.0]
    if found.used is not None:
        high = found.used[1] / rpm
        included.append(ARTICLE * high)
        series.append(_in_use(found.used, upright=True))
        series.append(Rule(value=ARTICLE * high, upright=True, text=_("1.6 × the highest"), role="muted"))
    series.append(
        Bars(
            at=at,
            size=actual,
            texts=tuple(Quantity(float(speed) * rpm, "angular_speed") for speed in actual),
            roles=tuple(_tone(found, k) for k in range(count)),
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


def _tone(found: CriticalSpeeds, k: int) -> str:
    """Return the role of the bar of a mode: red where the drive runs at it, amber where a rule is broken."""
    if found.near[k] or found.half_near[k]:
        return "failed"
    if found.crossed[k]:
        return "warning" if found.part[k].kind == "support" else "failed"
    if k == found.deciding and found.status == Running.BEYOND:
        return "failed"
    return "warning" if k == found.deciding and found.status == Running.CLOSE else "accent"


def shapes_figure(found: CriticalSpeeds) -> Figure:
    """Return the shapes in which the line whirls, with joints and supports.

    found: of one drive.
    """
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
        rows.append(Row(panels=(panel,), height=0.95))
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
    """Return critical speeds over the stiffness of a support or the length of a shaft.

    found: over one quantity.
    """
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
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    tens = [10.0**power for power in powers]
    ticks = [one for one in tens if low <= one <= high * (1.0 + 1e-9)]
    if len(ticks) < 4:
        ticks = [m * ten for ten in tens for m in (1.0, 2.0, 5.0) if low <= m * ten <= high * (1.0 + 1e-9)]
    texts = tuple(significant(one, 1) if one < 1.0 else written((one,))[0] for one in ticks)
    return Axis(
        label=label, unit=unit, dimension="stiffness", low=low, high=high, ticks=tuple(ticks), texts=texts, log=True
    )


def _map_sentence(found: CriticalSpeedMap) -> Say:
    order = np.argsort(np.asarray(found.value))
    first = np.asarray(found.speed)[order, 0]
    one, other = (Quantity(float(speed), "angular_speed", 3) for speed in (first[0], first[-1]))
    text = _("As shaft {number} grows longer, the first critical speed goes from {one:bare} to {other}.")
    if found.over == "stiffness":
        text = _("As support {number} grows stiffer, the first critical speed goes from {one:bare} to {other}.")
    return say(text, number=found.number, one=one, other=other)
