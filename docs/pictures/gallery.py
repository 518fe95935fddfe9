"""Pictures of the shipped examples."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from cardan import Drive
from cardan.drive.models.geometry import geometry

from .conventions import solids
from .kit import Scene, bare, page


def portrait(drive: Drive) -> Figure:
    """Draw a drive in space, its ends shortened to what is worth seeing."""
    points = geometry(drive).points.copy()
    inner = np.linalg.norm(np.diff(points[1:-1], axis=0), axis=-1)
    reach = float(inner.mean()) if len(inner) else 1.0
    axis = geometry(drive).axis
    points[0] = points[1] - 0.45 * reach * axis[0]
    points[-1] = points[-2] + 0.45 * reach * axis[-1]
    size = 0.3 * float(min(inner)) / reach if len(inner) else 0.3
    shown = Drive.from_points(
        points / reach,
        yoke_angles=[shaft.yoke_angle for shaft in drive.shafts[1:-1]],
        start_phase=drive.input.start_phase,
    )
    figure, axes = page(8.0, 3.0)
    bare(axes)
    scene = Scene(swing=20, rise=22)
    solids(scene, shown, size=max(size, 0.16), radius=0.03)
    span = np.ptp([scene.flat(point)[0] for point in points / reach])
    scene.draw(axes, 1600 / (span + 0.4))
    return figure


def _drawer(name: str) -> Callable[[], Figure]:
    def draw() -> Figure:
        from cardan.io import example

        return portrait(example(name))

    return draw


def _names() -> list[str]:
    from cardan.io import example_names

    return list(example_names())


PICTURES = {f"example-{name}": _drawer(name) for name in _names()}
