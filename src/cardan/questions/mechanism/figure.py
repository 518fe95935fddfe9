"""A mechanism in space, its transfer functions, and what drives it and its pairs carry over the input angle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import say
from cardan.figures.axes import axis, steps, written
from cardan.figures.drive import SPACE
from cardan.figures.figure import Axis, Curve, Figure, Mesh, Note, Panel, Row, Rule, Series, View
from cardan.figures.page import onto
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _
from cardan.units import DIMENSIONS, mm

from .bodies import link_body
from .forces import MechanismForces
from .motion import LinkMotion, MechanismMotion
from .transfer import input_of

MOST = 8
"""Curves of one panel at most: those of the largest values."""

FLAT = 1e-9
"""Spread of axes, points over the size, below which a mechanism is planar."""


def motion_figures(found: MechanismMotion) -> tuple[Figure, ...]:
    """Return the figures of the motion of a mechanism."""
    return (space_figure(found), transfer_figure(found))


def view_of(mechanism: Mechanism) -> View:
    """Return how to look at a mechanism: a planar one along its axes, any other from the side and above."""
    normals = [pair.along for pair in mechanism.joints if pair.type == "R"]
    if normals and all(abs(abs(float(one @ normals[0])) - 1.0) < FLAT for one in normals[1:]) and len(normals) > 1:
        toward = normals[0] * math.copysign(1.0, float(normals[0][int(np.argmax(np.abs(normals[0])))]))
        right = np.asarray([1.0, 0.0, 0.0]) if abs(toward[0]) < 0.5 else np.asarray([0.0, 1.0, 0.0])
        right = frames.unit(right - (right @ toward) * toward)
        up = frames.cross(toward, right)
        return View(right=tuple(right.tolist()), up=tuple(up.tolist()), turnable=True)
    return SPACE


def space_figure(found: MechanismMotion) -> Figure:
    """Return the mechanism as drawn, with the ways of the points of its links."""
    mechanism, view = found.mechanism, view_of(found.mechanism)
    meshes = [_mesh(mechanism, link, k) for k, link in enumerate((mechanism.frame, *mechanism.links))]
    ways = [
        Curve(
            x=one.point[:, 0] / mm,
            y=one.point[:, 1] / mm,
            z=one.point[:, 2] / mm,
            role=shaft(k + 1),
            width=0.9,
            dash="dashed",
            text=one.link,
        )
        for k, one in enumerate(found.links)
        if one.moves
    ]
    spots = [one.point / mm for one in found.links if one.moves]
    flat = np.concatenate([onto(view, one)[:, :2] for one in [*(mesh.corners for mesh in meshes), *spots]])
    low, high = flat.min(axis=0), flat.max(axis=0)
    margin = 0.06 * float(np.max(high - low))
    inch = max(float(high[0] - low[0] + 2 * margin) / 6.75, float(high[1] - low[1] + 2 * margin) / 3.6)
    half, middle = 0.5 * 6.75 * inch, 0.5 * float(low[0] + high[0])
    x = _bare(middle - half, middle + half)
    y = _bare(float(low[1]) - margin, float(high[1]) + margin)
    series: tuple[Series, ...] = (*meshes, *ways, *_names(mechanism))
    return Figure(
        name="space",
        title=_("The mechanism in space"),
        sentence=_("As drawn; dashed the ways of points of the links."),
        source=_("Loops closed by Newton's method on all pairs at once"),
        rows=(
            Row(
                panels=(Panel(series=series, x=x, y=y, equal=True, bare=True, view=view),),
                height=max(1.3, (y.high - y.low) / inch),
            ),
        ),
        legend=False,
    )


def _bare(low: float, high: float) -> Axis:
    ticks = steps(low, high, 4)
    return Axis(low=low, high=high, ticks=ticks, texts=written(ticks))


def _mesh(mechanism: Mechanism, link: str, k: int) -> Mesh:
    body = link_body(mechanism, link)
    faces = body.indices.tolist()
    role = shaft(k) if k else "cross"
    return Mesh(corners=body.positions / mm, faces=faces, triangles=faces, role=role, smooth=True, text=link)


def _names(mechanism: Mechanism) -> Iterator[Note]:
    for k, link in enumerate(mechanism.links, start=1):
        at = np.mean([pair.point for pair in mechanism.joints if link in pair.links], axis=0) / mm
        x, y, z = (float(one) for one in at)
        yield Note(text=link, x=x, y=y, z=z, role=shaft(k), shift=(0.0, 7.0), level="bottom", size=7.4)


def transfer_figure(found: MechanismMotion) -> Figure:
    """Return what turns or slides, with its first and second transfer function, over the input."""
    by = input_of(found.mechanism)
    links = [found.output] if found.output is not None else list(found.links)
    turning, sliding = [one for one in links if one.turns], [one for one in links if one.moves]
    if found.output is not None and found.output.way != "screws":
        turning, sliding = (turning, []) if turning else ([], sliding)
    rows: list[Row] = []
    if turning:
        rows += _three(
            found,
            turning,
            [
                ([one.angle for one in turning], _("Angle φ"), "angle"),
                ([one.ratio for one in turning], _("Speed ratio ω/{sign}").format(sign=by.sign), by.ratio),
                (
                    [one.slope for one in turning],
                    _("Angular acceleration per input speed squared, ε/{sign}²").format(sign=by.sign),
                    by.slope,
                ),
            ],
        )
    if sliding:
        rows += _three(
            found,
            sliding,
            [
                ([one.path for one in sliding], _("Path s"), "length"),
                ([one.speed for one in sliding], _("Speed per input speed, v/{sign}").format(sign=by.sign), by.speed),
                (
                    [one.curve for one in sliding],
                    _("Acceleration per input speed squared, a/{sign}²").format(sign=by.sign),
                    by.curve,
                ),
            ],
        )
    return Figure(
        name="motion",
        title=_("Transfer functions over the input path")
        if found.mechanism.slides
        else _("Transfer functions over the input angle"),
        sentence=say(_("Of {link}."), link=found.output.link) if found.output is not None else "",
        source=_("Twists of the links from what all pairs hold, and their rates; exact at every position"),
        rows=tuple(rows),
        legend=len(links) > 1,
    )


def _three(
    found: MechanismMotion, links: Sequence[LinkMotion], panels: Sequence[tuple[list[Array], str, str]]
) -> list[Row]:
    by = input_of(found.mechanism)
    rows = []
    for k, (told, label, dimension) in enumerate(panels):
        unit, size = next(iter(DIMENSIONS[dimension].items())) if dimension else ("–", 1.0)
        values = [value / size for value in told]
        curves = [
            _curve(by.units(found.position), value, one.link, n)
            for n, (value, one) in enumerate(zip(values, links, strict=True), 1)
        ]
        if k == 1:  # rates that vary by less are drawn as a flat line
            still = 0.02 * float(np.nanmax(np.abs(values)))
        upright = axis(label, unit, values, dimension=dimension, least=max(1e-6, still if k else 0.0))
        panel = Panel(series=tuple(curves), x=by.axis(found.position, named=k == len(panels) - 1), y=upright)
        rows.append(Row(panels=(panel,), height=1.5))
    return rows


def _curve(angle: Array, values: Array, label: str, number: int) -> Curve:
    return Curve(x=angle, y=values, label=label, text=label, role=shaft(number), dash=dash_of(number))


def forces_figures(found: MechanismForces) -> tuple[Figure, ...]:
    """Return the figures of the forces in a mechanism."""
    return (forces_figure(found),)


def forces_figure(found: MechanismForces) -> Figure:
    """Return the torque that drives the mechanism and the force in every pair over the input angle.

    Of an input that slides the force that drives it, over its path.
    """
    by, slides = input_of(found.mechanism), found.mechanism.slides
    angle = by.units(found.position)
    drives = _("input force") if slides else _("input torque")
    torque = [Curve(x=angle, y=found.input_torque, role="ink", label=drives, width=1.8)]
    if not np.allclose(found.input_torque, found.still_torque, equal_nan=True):
        torque.append(Curve(x=angle, y=found.still_torque, role="muted", dash="dashed", label=_("without inertia")))
    largest = np.nanmax(found.force, axis=0)
    shown = sorted(np.argsort(-largest, kind="stable")[:MOST].tolist())
    pairs = [_curve(angle, found.force[:, k], found.mechanism.joints[k].id, n) for n, k in enumerate(shown, start=1)]
    panels = (
        Panel(
            series=(Rule(value=0.0, dash="solid", role="faint"), *torque),
            x=by.axis(found.position),
            y=axis(
                _("Input force") if slides else _("Input torque"),
                "N" if slides else "Nm",
                [one.y for one in torque],
                dimension=by.load,
                include=(0.0,),
                least=1e-6,
            ),
        ),
        Panel(
            series=tuple(pairs),
            x=by.axis(found.position, named=True),
            y=axis(
                _("Force in the pairs"), "N", [one.y for one in pairs], dimension="force", include=(0.0,), least=1e-6
            ),
        ),
    )
    return Figure(
        name="forces",
        title=_("Input force and forces in the pairs over the input path")
        if slides
        else _("Input torque and forces in the pairs over the input angle"),
        sentence="",
        source=_("Balance of every link, Newton and Euler; redundant constraints by least squares"),
        rows=tuple(Row(panels=(panel,), height=height) for panel, height in zip(panels, (1.5, 2.2), strict=True)),
    )


FIGURES = {MechanismMotion: motion_figures, MechanismForces: forces_figures}
"""Result -> what makes its figures."""
