"""The drive as a drawing: side, plan and spatial views, and every intermediate shaft seen along the power flow.

Yokes stand where the drive file puts them at the start, so that a wrong sign is seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.answers.palette import shaft as role_of
from cardan.answers.reader import fixed, half_turn
from cardan.catalogue.completion import sized
from cardan.drive.bodies.solids import Solids, solids
from cardan.drive.drive import Drive
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.texts import _
from cardan.units import mm

from .axes import steps, written
from .figure import Axis, Curve, Figure, Mesh, Note, Panel, Row, Series, View
from .page import onto

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

MARGIN = 0.34
"""Room for words around a view [inch]."""


def drive_figures(drive: Drive) -> tuple[Figure, ...]:
    """Return all drawings of a drive."""
    seen = solids(sized(drive))
    clocks = (yoke_figure(drive, seen),) if len(drive.joints) > 1 else ()
    return (views_figure(drive, seen), space_figure(drive, seen), *clocks)


def views_figure(drive: Drive, seen: Solids) -> Figure:
    """Return side and plan view, one above the other, to the same scale."""
    meshes = _meshes(seen)
    sheets = [_sheet(SIDE, meshes, 3.4), _sheet(PLAN, meshes, 3.4)]
    inch = max(sheet.inch for sheet in sheets)
    titles = (_("Side view: z over x [mm]"), _("Plan view: y over x [mm]"))
    return Figure(
        name="views",
        title=_("Side and plan view"),
        sentence=_(
            "Yokes stand at the start position, each in the colour of its shaft, to scale where the file gives sizes."
        ),
        source=_("Geometry: plain vectors through the joint centres, Kozhevnikov & Perfil'ev (1978), eq. 87–89"),
        rows=tuple(
            Row(panels=(_view(drive, seen, meshes, sheet, inch, title),), height=max(0.85, sheet.height(inch)))
            for sheet, title in zip(sheets, titles, strict=True)
        ),
        legend=False,
    )


def space_figure(drive: Drive, seen: Solids, *, name: str = "space", named: bool = True) -> Figure:
    """Return the view in space.

    named: with the numbers of joints and shafts and the directions of x, y and z; not for a picture so small that
    nobody could read them.
    """
    meshes = _meshes(seen)
    sheet = _sheet(SPACE, meshes, 3.6)
    return Figure(
        name=name,
        title=_("The drive in space"),
        sentence=_("Power flows from shaft 1 to shaft {last}; every joint joins the yokes of two colours.").format(
            last=len(drive.joints) + 1
        ),
        source=_("Geometry: plain vectors through the joint centres"),
        rows=(
            Row(
                panels=(_view(drive, seen, meshes, sheet, sheet.inch, "", named=named),),
                height=max(1.3, sheet.height(sheet.inch)),
            ),
        ),
        legend=False,
    )


@dataclass(frozen=True, kw_only=True)
class _Sheet:
    """What a view covers on paper [mm], and how many mm an inch of print shows at most."""

    view: View
    left: float
    right: float
    low: float
    high: float
    inch: float

    def height(self, inch: float) -> float:
        """Return the height of the panel [inch]."""
        return (self.high - self.low) / inch + 2.0 * MARGIN


def _sheet(view: View, meshes: Sequence[Mesh], tallest: float) -> _Sheet:
    corners = np.concatenate([onto(view, mesh.corners) for mesh in meshes])
    (left, low), (right, high) = (tuple(map(float, edge[:2])) for edge in (corners.min(axis=0), corners.max(axis=0)))
    inch = max((right - left) / (WIDE - 0.5 * MARGIN), (high - low) / (tallest - 2.0 * MARGIN))
    return _Sheet(view=view, left=left, right=right, low=low, high=high, inch=inch)


def _meshes(seen: Solids) -> tuple[Mesh, ...]:
    return tuple(
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


def _view(
    drive: Drive, seen: Solids, meshes: Sequence[Mesh], sheet: _Sheet, inch: float, title: str, *, named: bool = True
) -> Panel:
    """Return a panel; one without a title has no frame either, but the directions of x, y and z."""
    middle, half = 0.5 * (sheet.left + sheet.right), 0.5 * WIDE * inch
    low, high = sheet.low - MARGIN * inch, sheet.high + MARGIN * inch
    series: list[Series] = list(meshes)
    if named:
        series += _labels(drive, seen, sheet.view, 72.0 / inch)
    if named and not title:
        series += _triad(sheet.view, np.asarray([sheet.left, low]), inch)
    x, y = _axis(middle - half, middle + half, 8), _axis(low, high, 4)
    return Panel(series=tuple(series), x=x, y=y, title=title, equal=True, bare=not title, view=sheet.view)


def _axis(low: float, high: float, count: int) -> Axis:
    ticks = steps(low, high, count)
    return Axis(low=low, high=high, ticks=ticks, texts=written(ticks))


def _body_text(part: str, number: int) -> str:
    texts = {
        "tube": _("shaft {number}"),
        "driving yoke": _("driving yoke of shaft {number}"),
        "driven yoke": _("driven yoke of shaft {number}"),
        "cross": _("cross of joint {number}"),
    }
    return texts[part].format(number=number)


def _labels(drive: Drive, seen: Solids, view: View, print_size: float) -> Iterator[Note]:
    """Yield the numbers of joints above and of shafts below them, square to the shafts; ``print_size`` in points/mm."""
    stations = np.concatenate((seen.ends[:1], seen.centres, seen.ends[1:])) / mm
    radius = seen.radius / mm * print_size
    ways = np.diff(onto(view, stations)[:, :2], axis=0)
    close = len(drive.joints) > 6
    taken: list[Array] = []
    for k, point in enumerate(stations[1:-1]):
        text = str(k + 1) if close else _("joint {number}").format(number=k + 1)
        at = onto(view, point)[:2] * print_size
        shift = _free(taken, at, _square(ways[k] + ways[k + 1]), 1.15 * radius + 4.0, text)
        yield _beside(text, point, shift, "ink")
    for k, point in enumerate(0.5 * (stations[1:] + stations[:-1]), start=1):
        text = str(k) if close else _("shaft {number}").format(number=k)
        room = float(np.hypot(*ways[k - 1])) * print_size - 2.8 * radius
        away = 0.45 * radius + 4.0 if room > 5.0 * len(text) else 1.15 * radius + 4.0
        at = onto(view, point)[:2] * print_size
        yield _beside(text, point, _free(taken, at, -_square(ways[k - 1]), away, text), role_of(k), bold=True)


def _free(taken: list[Array], at: Array, toward: Array, away: float, text: str) -> Array:
    """Return the shift [points] that puts a word beside a point, farther out where another word stands already."""
    size = np.asarray([5.0 * len(text), 9.0])
    for step in range(6):
        shift = (away + 10.0 * step) * toward
        middle = at + shift + 0.5 * size * np.round(toward)
        if not any(bool(np.all(np.abs(middle - other[:2]) < 0.5 * (size + other[2:]))) for other in taken):
            break
    taken.append(np.concatenate((middle, size)))
    return np.asarray(shift)


def _square(way: Array) -> Array:
    """Return the direction on paper square to a way, upwards."""
    size = float(np.hypot(*way))
    across = np.asarray([-way[1], way[0]]) / size if size > 0.0 else np.asarray([0.0, 1.0])
    return across if across[1] >= 0.0 else -across


def _beside(text: str, point: Array, shift: Array, role: str, *, bold: bool = False) -> Note:
    x, y, z = (float(value) for value in point)
    right, up = (float(value) for value in shift / max(float(np.hypot(*shift)), 1e-9))
    return Note(
        text=text,
        x=x,
        y=y,
        z=z,
        role=role,
        shift=(float(shift[0]), float(shift[1])),
        side="left" if right > 0.35 else "right" if right < -0.35 else "centre",
        level="bottom" if up > 0.35 else "top" if up < -0.35 else "middle",
        bold=bold,
        size=7.6,
    )


def _triad(view: View, corner: Array, inch: float) -> Iterator[Series]:
    """Yield the directions of x, y and z in the lower left corner."""
    frame = np.asarray([view.right, view.up])
    origin = corner + 0.42 * inch
    for name, direction in zip("xyz", np.eye(3), strict=True):
        tip = frame @ direction * 0.34 * inch
        start, end = origin, origin + tip
        x, y = np.stack((start, end), axis=-1)
        yield Curve(x=x, y=y, role="muted", width=0.9, arrow=True)
        away = tip / max(float(np.hypot(*tip)), 1e-12)
        shift = (5.0 * away[0], 5.0 * away[1])
        yield Note(text=name, x=float(x[1]), y=float(y[1]), role="muted", size=7.4, shift=shift)


def yoke_figure(drive: Drive, seen: Solids) -> Figure:
    """Return every intermediate shaft seen along the power flow, its two yokes and the planes of its two joints.

    drive: for its yoke angles.
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
        x=x[:0] if empty else x, y=y[:0] if empty else y, role=role, width=width, dash=dash, label=label, marker=marker
    )


def _arc(start: float, end: float, radius: float, role: str, width: float, *, arrow: bool = False) -> Curve:
    x, y = _polar(np.linspace(start, end, max(3, int(abs(end - start) / 0.06))), radius)
    return Curve(x=x, y=y, role=role, width=width, arrow=arrow)


def _polar_note(text: str, angle: float, radius: float, role: str) -> Note:
    x, y = _polar(angle, radius)
    return Note(text=text, x=float(x), y=float(y), role=role, size=8.0)
