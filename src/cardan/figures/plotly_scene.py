"""A panel that looks at space as a scene of plotly's, which the reader can turn."""

from __future__ import annotations

from html import escape
from typing import Any, TypeAlias

import numpy as np

from cardan.maths.arrays import Array

from . import palette
from .figure import Curve, Mesh, Note, Panel, Series
from .page import Box
from .projection import onto

Spec: TypeAlias = dict[str, Any]

SCENE = 0.58
"""Share of a scene's height that a side of 1 of its box takes, seen without perspective."""

HEAD = (0.028, 0.4)
"""Length of an arrowhead: share of the scene's size, and of the arrow at most."""

SLIM = 0.36
"""Radius of an arrowhead over its length."""

CORNERS = 12
"""Corners of the foot of an arrowhead."""


def scene(panel: Panel, box: Box, across: list[float], upright: list[float]) -> Spec:
    """Return the layout of a scene: where it stands, how it is looked at.

    panel: with a view; box: where it stands on the page; across, upright: the same as shares of the page.
    """
    assert panel.view is not None
    hidden = {"visible": False}
    return {
        "domain": {"x": across, "y": upright},
        "xaxis": hidden,
        "yaxis": hidden,
        "zaxis": hidden,
        "aspectmode": "manual",
        "aspectratio": _proportions(panel, box),
        "camera": {
            "projection": {"type": "orthographic"},
            "eye": dict(zip("xyz", (1.1 * v for v in panel.view.toward), strict=True)),
            "up": {"x": 0.0, "y": 0.0, "z": 1.0},
        },
        "annotations": [],
    }


def reach(panel: Panel) -> float:
    """Return the size of what stands in a scene, corner to corner."""
    found = _corners(panel)
    return float(np.linalg.norm(np.ptp(found, axis=0))) if len(found) else 1.0


def in_space(item: Series, name: str, reach: float) -> tuple[list[Spec], list[Spec]]:
    """Return the traces and the annotations of a series in space.

    item: what to draw; what is flat is left out.
    name: name of the scene; reach: size of the scene.
    """
    if isinstance(item, Mesh):
        tint = palette.mixed(palette.colour(item.role), "#ffffff", item.shade)
        return [_surface(item.corners, item.triangles, tint, name, item)], []
    if isinstance(item, Note) and item.z is not None:
        return [], [_word(item)]
    if isinstance(item, Curve) and item.z is not None:
        return _line(item, name, reach), []
    return [], []


def _surface(corners: Array, triangles: Any, tint: str, name: str, item: Mesh | None = None) -> Spec:
    i, j, k = np.asarray(triangles).T
    x, y, z = np.asarray(corners, dtype=float).T
    made: Spec = {
        "type": "mesh3d",
        "x": _list(x),
        "y": _list(y),
        "z": _list(z),
        "i": i.tolist(),
        "j": j.tolist(),
        "k": k.tolist(),
        "color": tint,
        "flatshading": item is not None and not item.smooth,
        "lighting": {"ambient": 0.75, "diffuse": 0.55, "specular": 0.05},
        "scene": name,
    }
    if item is None:
        return {**made, "hoverinfo": "skip"}
    if item.opacity < 1.0:
        made["opacity"] = item.opacity
    return {**made, "text": item.text, "hoverinfo": "text"}


def _word(item: Note) -> Spec:
    return {
        "text": f"<b>{escape(item.text)}</b>" if item.bold else escape(item.text),
        "x": item.x,
        "y": item.y,
        "z": item.z,
        "showarrow": False,
        "xshift": item.shift[0] * 1.5,
        "yshift": item.shift[1] * 1.5,
        "font": {"color": palette.colour(item.role), "size": 12},
        "bgcolor": "rgba(255,255,255,0.6)",
    }


def _line(item: Curve, name: str, reach: float) -> list[Spec]:
    x, y, z = np.broadcast_arrays(item.x, item.y, np.asarray(item.z))
    tint = palette.colour(item.role)
    mode = "lines+markers" if item.width and item.marker else "markers" if item.marker else "lines"
    made: list[Spec] = [
        {
            "type": "scatter3d",
            "mode": mode,
            "x": _list(x),
            "y": _list(y),
            "z": _list(z),
            "line": {"color": tint, "width": 2.0 * item.width},
            "marker": {"color": tint, "size": item.marker},
            **({"text": item.text, "hoverinfo": "text"} if item.text else {"hoverinfo": "skip"}),
            "showlegend": False,
            "scene": name,
        }
    ]
    points = np.stack((x, y, z), axis=-1).astype(float)
    if item.arrow and len(points) > 1 and np.any(points[-1] != points[-2]):
        corners, triangles = _head(points[-2], points[-1], reach)
        made.append(_surface(corners, triangles, tint, name))
    return made


def _head(start: Array, tip: Array, reach: float) -> tuple[Array, Array]:
    """Return corners and triangles of the cone at the tip of an arrow."""
    way = tip - start
    long = float(np.linalg.norm(way))
    along = way / long
    size = min(HEAD[0] * reach, HEAD[1] * long)
    other = np.eye(3)[int(np.argmin(np.abs(along)))]
    right = np.cross(along, other)
    right /= np.linalg.norm(right)
    turn = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)[:, None]
    foot = tip - size * along
    ring = foot + SLIM * size * (np.cos(turn) * right + np.sin(turn) * np.cross(along, right))
    one = np.arange(CORNERS)
    two = (one + 1) % CORNERS
    apex, middle = np.full(CORNERS, CORNERS), np.full(CORNERS, CORNERS + 1)
    triangles = np.concatenate((np.stack((one, two, apex), axis=-1), np.stack((two, one, middle), axis=-1)))
    return np.concatenate((ring, tip[None], foot[None])), triangles


def _corners(panel: Panel) -> Array:
    """Return all points in space, array (m, 3)."""
    found = [np.asarray(item.corners) for item in panel.series if isinstance(item, Mesh)]
    for item in panel.series:
        if isinstance(item, Curve) and item.z is not None:
            found.append(np.stack(np.broadcast_arrays(item.x, item.y, item.z), axis=-1))
    return np.concatenate(found) if found else np.zeros((0, 3))


def _proportions(panel: Panel, box: Box) -> Spec:
    """Return the sides of the box around all that stands in it, as large as fills the panel when seen from `View`."""
    corners = _corners(panel)
    if not len(corners) or panel.view is None:
        return {"x": 1.0, "y": 1.0, "z": 1.0}
    sides, seen = np.ptp(corners, axis=0), np.ptp(onto(panel.view, corners), axis=0)
    scale = min(0.9 * box.width / box.height / float(seen[0]), 0.72 / float(seen[1])) / SCENE
    return dict(zip("xyz", (max(float(side) * scale, 1e-3) for side in sides), strict=True))


def _list(values: Any) -> list[float]:
    return [float(value) for value in np.asarray(values, dtype=float)]
