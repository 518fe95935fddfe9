"""The drive as a drawing: side, plan and spatial views, and every intermediate shaft seen along the power flow.

Yokes stand where the drive file puts them at the start, so that a wrong sign is seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.solids import Solids, solids
from cardan.maths import frames
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import mm

from .figure import Axis, Curve, Figure, Mesh, Note, Panel, Row, Series, View, steps, written
from .palette import shaft as role_of
from .projection import onto
from .wording import fixed, half_turn

SIDE = View(right=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0))
PLAN = View(right=(1.0, 0.0, 0.0), up=(0.0, 1.0, 0.0))
_ACROSS = (math.cos(math.radians(-28.0)), math.sin(math.radians(-28.0)))
_TILT = math.radians(24.0)
SPACE = View(
    right=(_ACROSS[0], -_ACROSS[1], 0.0),
    up=(_ACROSS[1] * math.sin(_TILT), _ACROSS[0] * math.sin(_TILT), math.cos(_TILT)),
    turnable=True,
)
"""Seen from the right of the power flow, a little from behind and above."""

WIDE = 6.75
"""Width of a panel across the page [inch]."""


def drive_figures(drive: Drive) -> tuple[Figure, ...]:
    """Return all drawings of a drive."""
    seen = solids(drive)
    clocks = (yoke_figure(drive, seen),) if len(drive.joints) > 1 else ()
    return (views_figure(drive, seen), space_figure(drive, seen), *clocks)


def views_figure(drive: Drive, seen: Solids) -> Figure:
    """Return side and plan view, one above the other.

    Parameters
    ----------
    drive : Drive
        For its names.
    seen : Solids
        Its bodies.
    """
    side, plan = _view(drive, seen, SIDE, "z"), _view(drive, seen, PLAN, "y")
    wide = side.x.high - side.x.low
    return Figure(
        name="views",
        title=_("Side and plan view"),
        sentence=_(
            "Yokes stand at the start position, each in the colour of its shaft; yoke sizes are drawn in proportion, "
            "not to scale."
        ),
        source=_("Geometry: plain vectors through the joint centres, Book (87)–(89)"),
        rows=tuple(
            Row(panels=(panel,), height=min(3.4, max(0.85, WIDE * (panel.y.high - panel.y.low) / wide)))
            for panel in (side, plan)
        ),
        legend=False,
    )


def space_figure(drive: Drive, seen: Solids, *, name: str = "space") -> Figure:
    """Return the view in space.

    Parameters
    ----------
    drive : Drive
        For its names.
    seen : Solids
        Its bodies.
    name : str
        Name of the figure.
    """
    panel = _view(drive, seen, SPACE, "")
    wide, high = panel.x.high - panel.x.low, panel.y.high - panel.y.low
    return Figure(
        name=name,
        title=_("The drive in space"),
        sentence=_("Power flows from shaft 1 to shaft {last}; every joint joins the yokes of two colours.").format(
            last=len(drive.joints) + 1
        ),
        source=_("Geometry: plain vectors through the joint centres"),
        rows=(Row(panels=(panel,), height=min(4.2, max(1.3, 7.0 * high / wide))),),
        legend=False,
    )


def _view(drive: Drive, seen: Solids, view: View, upwards: str) -> Panel:
    meshes = tuple(
        Mesh(
            corners=body.corners / mm,
            faces=body.faces,
            triangles=body.triangles,
            role="cross" if body.part == "cross" else role_of(body.number),
            smooth=body.smooth,
            shade=0.45 if body.part == "tube" else 0.0,
            text=_body_text(body.part, body.number),
        )
        for body in seen.bodies
    )
    corners = np.concatenate([onto(view, mesh.corners) for mesh in meshes])
    (left, low), (right, high) = corners.min(axis=0)[:2], corners.max(axis=0)[:2]
    inch = max(right - left, 1e-9) / WIDE
    labels = 0.26 * inch
    low, high, left, right = low - 1.2 * labels, high + 1.2 * labels, left - 0.3 * labels, right + 0.3 * labels
    across = _axis("x", left, right, 8)
    upright = _axis(upwards or "z", low, high, 4)
    bare = not upwards
    series: list[Series] = [*meshes, *_labels(drive, seen, 72.0 * seen.radius / mm / inch)]
    if bare:
        series += _triad(view, np.asarray([left, low]), inch)
    title = {"z": _("Side view: z over x [mm]"), "y": _("Plan view: y over x [mm]")}.get(upwards, "")
    return Panel(series=tuple(series), x=across, y=upright, title=title, equal=True, bare=bare, view=view)


def _axis(label: str, low: float, high: float, count: int) -> Axis:
    ticks = steps(low, high, count)
    return Axis(label="", unit="", low=low, high=high, ticks=ticks, texts=written(ticks), grid=True)


def _body_text(part: str, number: int) -> str:
    texts = {
        "tube": _("shaft {number}"),
        "driving yoke": _("driving yoke of shaft {number}"),
        "driven yoke": _("driven yoke of shaft {number}"),
        "cross": _("cross of joint {number}"),
    }
    return texts[part].format(number=number)


def _labels(drive: Drive, seen: Solids, radius: float) -> Iterator[Note]:
    """Yield the numbers of joints above and of shafts below them; ``radius`` of a yoke in points of print."""
    stations = np.concatenate((seen.ends[:1], seen.centres, seen.ends[1:])) / mm
    away = 1.25 * radius + 3.0
    close = len(drive.joints) > 6
    for k, point in enumerate(stations[1:-1], start=1):
        text = str(k) if close else _("joint {number}").format(number=k)
        yield _note(text, point, "ink", away, "bottom")
    middles = 0.5 * (stations[1:] + stations[:-1])
    for k, point in enumerate(middles, start=1):
        text = str(k) if close else _("shaft {number}").format(number=k)
        yield _note(text, point, role_of(k), -away, "top", bold=True)


def _note(text: str, point: Array, role: str, up: float, level: str, *, bold: bool = False) -> Note:
    x, y, z = (float(value) for value in point)
    return Note(text=text, x=x, y=y, z=z, role=role, shift=(0.0, up), level=level, bold=bold, size=7.6)  # type: ignore[arg-type]


def _triad(view: View, corner: Array, inch: float) -> Iterator[Series]:
    """Yield the directions of x, y and z in the lower left corner."""
    frame = np.asarray([view.right, view.up])
    origin = corner + 0.42 * inch
    for name, direction in zip("xyz", np.eye(3), strict=True):
        tip = frame @ direction * 0.34 * inch
        start, end = origin, origin + tip
        yield Curve(
            x=np.asarray([start[0], end[0]]),
            y=np.asarray([start[1], end[1]]),
            role="muted",
            width=0.9,
            arrow=True,
        )
        away = tip / max(float(np.hypot(*tip)), 1e-12)
        yield Note(
            text=name, x=float(end[0]), y=float(end[1]), role="muted", size=7.4, shift=(5.0 * away[0], 5.0 * away[1])
        )


def yoke_figure(drive: Drive, seen: Solids) -> Figure:
    """Return every intermediate shaft seen along the power flow, its two yokes and the planes of its two joints.

    Parameters
    ----------
    drive : Drive
        For its yoke angles.
    seen : Solids
        Its bodies.
    """
    panels = [_clock(drive, seen, k) for k in range(2, len(drive.joints) + 1)]
    across = 4 if len(panels) > 4 else max(len(panels), 3)
    rows = []
    for first in range(0, len(panels), across):
        some = panels[first : first + across]
        some += [Panel(series=(), bare=True)] * (across - len(some))
        rows.append(Row(panels=tuple(some), height=1.75 if across == 4 else 2.1))
    return Figure(
        name="yokes",
        title=_("Yokes of the intermediate shafts at the start, seen along the power flow"),
        sentence=_(
            "The yoke angle γ runs from the driving yoke (broad) to the driven yoke (narrow) of the same shaft, the "
            "plane twist β from the plane of the joint before to that of the joint behind; clockwise is positive."
        ),
        source=_("v = unit(a × u) across each joint, v turned by −γ about a along each shaft; no approximation"),
        rows=tuple(rows),
    )


def _clock(drive: Drive, seen: Solids, number: int) -> Panel:
    place, i = seen.place, number - 1
    along = place.axis[i]
    up = np.asarray([0.0, 0.0, 1.0])
    if abs(float(along[2])) > 0.99:
        up = np.asarray([1.0, 0.0, 0.0])
    up = frames.unit(up - frames.dot(up, along) * along)

    def angle(direction: Array) -> float:
        return float(frames.angle_about(along, up, direction))

    role = role_of(number)
    driving, driven = angle(seen.arms.driving[i]), angle(seen.arms.driven[i - 1])
    before, behind = (angle(frames.cross(place.normal[k], along)) for k in (i - 1, i))
    gamma, beta = drive.shafts[i].yoke_angle, float(place.plane_twist[i - 1])
    series: list[Series] = [
        _arc(0.0, 2.0 * math.pi, 1.0, "faint", 0.9),
        _needle(before, 1.18, "muted", 0.9, "dotted", _("plane of the joint before")),
        _needle(behind, 1.18, "muted", 0.9, "dashed", _("plane of the joint behind")),
        _needle(driving, 0.86, "ink", 5.0, "solid", _("driving yoke, holds the joint behind"), empty=True),
        _needle(driven, 0.86, "ink", 1.6, "solid", _("driven yoke, holds the joint before"), empty=True, marker=4.0),
        _needle(driving, 0.86, role, 7.0, "solid"),
        _needle(driven, 0.86, "paper", 4.0, "solid"),
        _needle(driven, 0.86, role, 1.8, "solid", marker=5.0),
    ]
    if abs(gamma) > math.radians(4.0):
        series.append(_arc(driving, driving + gamma, 0.52, "ink", 1.0, arrow=True))
        series.append(_polar_note("γ", driving + 0.5 * gamma, 0.68, "ink"))
    if abs(beta) > math.radians(4.0):
        series.append(_arc(before, before + beta, 1.1, "muted", 0.9, arrow=True))
        series.append(_polar_note("β", before + 0.5 * beta, 1.26, "muted"))
    text = f"γ = {fixed(half_turn(math.degrees(gamma)))}°   β = {fixed(math.degrees(beta))}°"
    series.append(Note(text=text, x=0.0, y=-1.5, size=7.8))
    span = Axis(low=-1.5, high=1.5)
    name = drive.shafts[i].name
    title = _("shaft {number}").format(number=number) + (f" · {name[:22]}" if name else "")
    return Panel(series=tuple(series), x=span, y=Axis(low=-1.65, high=1.4), title=title, equal=True, bare=True)


def _polar(angle: Array | float, radius: float) -> tuple[Array, Array]:
    """Return points at angles from the top, clockwise: as seen along the power flow."""
    return radius * np.sin(angle), radius * np.cos(angle)


def _needle(
    angle: float,
    reach: float,
    role: str,
    width: float,
    dash: str,
    label: str = "",
    *,
    empty: bool = False,
    marker: float = 0.0,
) -> Curve:
    """Return a line across the clock; an empty one stands in the legend only."""
    x, y = _polar(np.asarray([angle, angle + math.pi]), reach)
    return Curve(
        x=x[:0] if empty else x,
        y=y[:0] if empty else y,
        role=role,
        width=width,
        dash=dash,
        label=label,
        marker=marker,
    )


def _arc(start: float, end: float, radius: float, role: str, width: float, *, arrow: bool = False) -> Curve:
    x, y = _polar(np.linspace(start, end, max(3, int(abs(end - start) / 0.06))), radius)
    return Curve(x=x, y=y, role=role, width=width, arrow=arrow)


def _polar_note(text: str, angle: float, radius: float, role: str) -> Note:
    x, y = _polar(angle, radius)
    return Note(text=text, x=float(x), y=float(y), role=role, size=8.0)
