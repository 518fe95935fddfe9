"""What a drive carries: torques and secondary couples of its shafts, and what its supports take."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from cardan.analysis.forces import Forces
from cardan.analysis.reactions import Held
from cardan.drive.drive import Drive
from cardan.drive.geometry import geometry
from cardan.drive.solids import solids
from cardan.maths import frames
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import deg, mm

from .drive import MARGIN, WIDE, views_figure
from .figure import Axis, Curve, Figure, Note, Panel, Row, Rule, Series, axis, steps, written
from .palette import dash_of, shaft
from .projection import onto
from .turning import across, shaft_name, support_dashes, support_name
from .wording import significant

LONGEST = 0.6
"""Length of the largest force on the drawing of a drive [inch]."""

NOTHING = 1e-9
"""Share of the largest value below which a couple or a force is rounding."""

LEAST = 1e-9
"""Smallest range of an axis of forces or torques."""


def forces_figures(found: Forces) -> tuple[Figure, ...]:
    """Return the figures of the forces of one drive."""
    held = (reactions_figure(found),) if found.reaction is not None else ()
    return (torques_figure(found), *held)


def torques_figure(found: Forces) -> Figure:
    """Return the torque and the secondary couple of every shaft over the input angle, and the couples seen end on.

    Parameters
    ----------
    found : Forces
        Of one drive.
    """
    angle = np.asarray(found.angle) / deg
    torque, couple = np.asarray(found.shaft_torque), np.asarray(found.bending_couple)
    entering = np.asarray(found.input_torque)
    bent = int(np.argmax(np.max(couple, axis=-1))) + 1
    most = float(np.max(couple))
    if most <= NOTHING * float(np.max(np.abs(torque), initial=0.0)):
        sentence = _("The input takes {low} to {high} N·m; no joint bends, so no couple bends a shaft.")
    else:
        sentence = _(
            "The input takes {low} to {high} N·m; the secondary couple is largest on shaft {number}, {most} N·m at "
            "{angle}°."
        )
    return Figure(
        name="torques",
        title=_("Torque and secondary couple of every shaft"),
        sentence=sentence.format(
            low=significant(float(np.min(entering))),
            high=significant(float(np.max(entering))),
            number=bent,
            most=significant(most),
            angle=_degrees(float(angle[int(np.argmax(couple[bent - 1]))])),
        ),
        source=_(
            "Couples along the normals of the crosses balance the torques, K = T n; the rest bends the shafts, Book "
            "p. 129 ff., exact; paths below: tip of the couple seen along the power flow, dot at the start"
        ),
        rows=(
            _over_angle(angle, torque, _("Torque that enters each shaft"), "N·m", shafts=True),
            _over_angle(angle, couple, _("Secondary couple, size"), "N·m", named=True, base=True),
            *_hodographs(found),
        ),
    )


def _degrees(angle: float) -> str:
    return f"{round(angle, 1) + 0.0:g}"


def _over_angle(
    angle: Array,
    rows: Array,
    label: str,
    unit: str,
    *,
    shafts: bool = False,
    named: bool = False,
    base: bool = False,
) -> Row:
    curves = [
        Curve(
            x=angle,
            y=row,
            label=shaft_name(k, len(rows)) if shafts else "",
            role=shaft(k),
            dash=dash_of(k),
            width=2.0 if k == len(rows) else 1.3,
            marker=4.0 if len(angle) == 1 else 0.0,
        )
        for k, row in enumerate(rows, start=1)
    ]
    size = float(np.max(np.abs(rows), initial=0.0))
    upright = axis(label, unit, [rows], include=(0.0,) if base else (), least=max(0.02 * size, LEAST), count=4)
    return Row(panels=(Panel(series=tuple(curves), x=across(angle, named=named), y=upright),), height=1.35)


def _hodographs(found: Forces) -> Iterator[Row]:
    """Yield the paths of the couple vectors, each seen along its shaft, all to one scale."""
    vector = np.asarray(found.secondary_couple)
    reach = float(np.max(np.asarray(found.bending_couple)))
    if reach <= NOTHING * float(np.max(np.abs(np.asarray(found.shaft_torque)), initial=0.0)) or len(found.angle) < 3:
        return
    count = len(vector)
    wide = 4 if count > 3 else 3
    panels = [_hodograph(found, k, reach) for k in range(count)]
    for first in range(0, count, wide):
        some = panels[first : first + wide]
        some += [Panel(series=(), bare=True)] * (wide - len(some))
        yield Row(panels=tuple(some), height=1.6 if wide == 4 else 1.9)


def _hodograph(found: Forces, k: int, reach: float) -> Panel:
    vector, along = np.asarray(found.secondary_couple)[k], np.asarray(found.axis)[k]
    up = np.asarray([1.0, 0.0, 0.0]) if abs(float(along[0, 2])) > 0.99 else np.asarray([0.0, 0.0, 1.0])
    up = frames.unit(up - frames.dot(up, along)[:, None] * along)
    right = frames.cross(along, up)
    x, y = frames.dot(vector, right), frames.dot(vector, up)
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    series: list[Series] = []
    rings = steps(0.0, reach, 2)
    for ring, name in list(zip(rings, written(rings), strict=True))[1:]:
        series.append(Curve(x=ring * np.sin(turn), y=ring * np.cos(turn), role="faint", width=0.8))
        series.append(Note(text=name, x=0.7071 * ring, y=-0.7071 * ring, role="muted", size=6.6))
    middle = Curve(x=np.asarray([0.0]), y=np.asarray([0.0]), role="muted", width=0.0, marker=2.5)
    path = Curve(x=x, y=y, role=shaft(k + 1), dash=dash_of(k + 1), width=1.8)
    start = Curve(x=x[:1], y=y[:1], role=shaft(k + 1), width=0.0, marker=5.5)
    span = Axis(low=-1.15 * reach, high=1.15 * reach)
    title = _("shaft {number} [N·m]").format(number=k + 1)
    return Panel(series=(*series, middle, path, start), x=span, y=span, title=title, equal=True, bare=True)


def reactions_figure(found: Forces, drive: Drive | None = None) -> Figure:
    """Return what every support takes over the input angle, and on the drawing of the drive where it is given.

    Parameters
    ----------
    found : Forces
        Of one drive with supports.
    drive : Drive, optional
        The drive, to draw the forces on; standing still.
    """
    angle = np.asarray(found.angle) / deg
    size = np.stack([frames.norm(np.asarray(one.reaction)) for one in _senses(found)])
    sense, worst, when = (int(part) for part in np.unravel_index(int(np.argmax(size)), size.shape))
    top = float(np.max(size))
    axial = np.asarray(found.axial)
    pushed = bool(np.any(np.abs(axial) > NOTHING * max(top, LEAST)))
    views = _views(_senses(found)[sense], drive, when) if drive is not None and top > 0.0 else ()
    sentence = _("Support {number} on shaft {shaft} takes most, {most} N at {angle}°.")
    if views:
        sentence = _(
            "Support {number} on shaft {shaft} takes most, {most} N at {angle}°; the drawings show all forces on the "
            "shafts at that angle."
        )
    source = _("Balance of forces and moments of every shaft in one linear system; rigid shafts and crosses")
    if int(np.max(np.asarray(found.status))) == int(Held.INDETERMINATE):
        source = _("Balance of every shaft, shared by least energy among bearings and shafts that give way")
    rows = [
        Row(
            panels=(
                Panel(
                    series=tuple(_curves(found, angle, "radial", labelled=True)),
                    x=across(angle, named=not pushed),
                    y=_force_axis(_("Radial force"), [np.asarray(one.radial) for one in _senses(found)]),
                ),
            ),
            height=1.5,
        )
    ]
    if pushed:
        rows.append(
            Row(
                panels=(
                    Panel(
                        series=(
                            Rule(value=0.0, dash="solid", role="faint"),
                            *_curves(found, angle, "axial", labelled=False),
                        ),
                        x=across(angle, named=True),
                        y=_force_axis(
                            _("Axial force on the shaft, along the power flow positive"),
                            [np.asarray(one.axial) for one in _senses(found)],
                        ),
                    ),
                ),
                height=1.3,
            )
        )
    return Figure(
        name="reactions",
        title=_("What the supports take"),
        sentence=sentence.format(
            number=worst + 1,
            shaft=found.support_shaft[worst],
            most=significant(top),
            angle=_degrees(float(angle[when])),
        ),
        source=source,
        rows=(*views, *rows),
    )


def _senses(found: Forces) -> tuple[Forces, ...]:
    """Return the forces, and those with the splines sliding back where that differs."""
    return (found,) if found.reverse is None else (found, found.reverse)


def _force_axis(label: str, rows: list[Array]) -> Axis:
    return axis(label, "N", rows, include=(0.0,), least=LEAST, count=4)


def _curves(found: Forces, angle: Array, part: str, *, labelled: bool) -> Iterator[Series]:
    """Yield the forces of every support; thin beside it those while the splines slide back."""
    top = float(np.max(frames.norm(np.asarray(found.reaction))))
    for back, one in enumerate(_senses(found)):
        for k, (number, dash) in enumerate(zip(found.support_shaft, support_dashes(found.support_shaft), strict=True)):
            row = np.asarray(getattr(one, part))[k]
            known = np.asarray(getattr(found, part))[k]
            nothing = part == "axial" and float(np.max(np.abs(row))) <= NOTHING * max(top, LEAST)
            same = back and float(np.max(np.abs(row - known))) <= NOTHING * max(top, LEAST)
            if nothing or same:
                continue
            name = support_name(k + 1, number) if labelled and not back else ""
            yield Curve(
                x=angle,
                y=row,
                label=name or (_("thin: splines sliding back") if labelled and back else ""),
                role=shaft(number),
                dash=dash,
                width=0.7 if back else 1.6,
                marker=4.0 if len(angle) == 1 else 0.0,
            )


def _views(found: Forces, drive: Drive, when: int) -> tuple[Row, ...]:
    """Return side and plan view with the forces of all supports at one angle, to one scale."""
    place = geometry(drive)
    points = np.asarray(place.points)
    at = np.stack(
        [points[max(one.shaft - 1, 1)] + one.position * np.asarray(place.axis)[one.shaft - 1] for one in drive.supports]
    )
    force = np.asarray(found.reaction)[:, when]
    rows = views_figure(drive, solids(drive)).rows
    panels = [row.panels[0] for row in rows]
    inch = (panels[0].x.high - panels[0].x.low) / WIDE
    scale = LONGEST * inch / float(np.max(frames.norm(force)))
    tips = at / mm + scale * force
    seen = [np.concatenate((onto(panel.view, tips), onto(panel.view, at / mm))) for panel in panels if panel.view]
    room = 0.5 * MARGIN * inch
    left = min(panels[0].x.low, *(float(np.min(one[:, 0])) - room for one in seen))
    right = max(panels[0].x.high, *(float(np.max(one[:, 0])) + room for one in seen))
    scaled = (right - left) / WIDE
    made = []
    for panel, one in zip(panels, seen, strict=True):
        low = min(panel.y.low, float(np.min(one[:, 1])) - room)
        high = max(panel.y.high, float(np.max(one[:, 1])) + room)
        words = tuple(item for item in panel.series if not isinstance(item, Note))
        new = replace(
            panel,
            series=(*words, *_arrows(panel, at / mm, tips)),
            x=replace(panel.x, low=left, high=right),
            y=replace(panel.y, low=low, high=high),
        )
        made.append(Row(panels=(new,), height=(high - low) / scaled))
    return tuple(made)


def _arrows(panel: Panel, feet: Array, tips: Array) -> Iterator[Series]:
    assert panel.view is not None
    most = float(np.max(frames.norm(tips - feet)))
    for k, (foot, tip) in enumerate(zip(feet, tips, strict=True), start=1):
        way = onto(panel.view, tip - foot)[:2]
        long = float(np.hypot(*way))
        x, y, z = np.stack((foot, tip), axis=-1)
        if long > 0.0:
            yield Curve(x=x, y=y, z=z, role="paper", width=3.2)
            yield Curve(x=x, y=y, z=z, role="ink", width=1.4, arrow=True)
        yield Curve(x=x[:1], y=y[:1], z=z[:1], role="ink", width=0.0, marker=4.0)
        short = long <= 0.3 * most  # then the number stands behind the foot, not over the arrow
        right, up = (-1.4 if short else 1.0) * way / long if long > 0.0 else (0.0, -1.4)
        at = foot if short else tip
        yield Note(
            text=str(k),
            x=float(at[0]),
            y=float(at[1]),
            z=float(at[2]),
            shift=(6.0 * float(right), 6.0 * float(up)),
            bold=True,
            size=7.6,
        )
