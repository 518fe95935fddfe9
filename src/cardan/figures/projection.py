"""Space on paper: faces of solids seen from one side, the farther ones first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array

from .figure import Mesh, View
from .palette import colour, mixed

LIGHT = np.asarray([0.35, 0.5, 0.79])
"""Direction of the light in the eye's frame: right, up, toward the eye."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Facet:
    """A face on paper."""

    corners: Array  # (m, 2)
    fill: str  # fill, edge: colours
    edge: str


def onto(view: View, points: Array) -> Array:
    """Return points (..., 3) as seen: right, up, toward the eye; array (..., 3)."""
    frame = np.asarray([view.right, view.up, view.toward])
    return np.asarray(points, dtype=float) @ frame.T


def facets(view: View, meshes: Sequence[Mesh]) -> list[Facet]:
    """Return the faces turned to the eye, the farthest first."""
    found: list[tuple[float, Facet]] = []
    for mesh in meshes:
        seen = onto(view, mesh.corners)
        size = float(np.max(np.ptp(seen, axis=0))) or 1.0
        base = mixed(colour(mesh.role), "#ffffff", mesh.shade)
        for face in mesh.faces:
            corners = seen[list(face)]
            normal = _normal(corners)
            length = float(np.linalg.norm(normal))
            if normal[2] <= 1e-6 * length or length <= 1e-12 * size * size:
                continue
            shine = float(LIGHT @ normal) / length
            fill = mixed(base, "#ffffff", 0.35 * max(0.0, shine)) if shine > 0.0 else mixed(base, "#000000", 0.12)
            edge = fill if mesh.smooth else mixed(base, "#10141c", 0.45)
            depth = float(np.mean(corners[:, 2]))
            found.append((depth, Facet(corners=corners[:, :2], fill=fill, edge=edge)))
    return [facet for _depth, facet in sorted(found, key=lambda pair: pair[0])]


def _normal(corners: Array) -> Array:
    """Return twice the area vector of a flat polygon; right for concave ones too."""
    after = np.roll(corners, -1, axis=0)
    return np.sum(np.cross(corners, after), axis=0)
