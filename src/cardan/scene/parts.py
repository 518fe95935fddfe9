"""What a scene is made of, and the same as dicts and lists for a browser."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from typing import Any, Literal

import numpy as np

from cardan.answers import palette
from cardan.drive.bodies.build import Track
from cardan.maths.arrays import Array

DIGITS = 6
"""Significant digits of lengths, beside the size of the whole."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneBody:
    """A body of a scene; its corners lie in the frame of its track."""

    name: str  # unlike that of any other body
    part: str
    number: int  # of its shaft, joint or support
    path: str  # where the drive file speaks of it
    text: str  # what it is, in words
    track: int
    positions: Array  # (m, 3) [m]
    indices: Array  # (t, 3) of int: triangles, counter-clockwise seen from outside; corners at sharp edges are doubled
    smooth: bool  # whether normals are averaged over the triangles of a corner
    colour: str
    metal: bool
    utilisation: float | None = None  # largest share of a limit that it uses
    utilisation_colour: str = palette.ROLES["faint"]  # of that share


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneLine:
    """A line through points (m, 3) [m] of a track."""

    group: str
    points: Array
    colour: str
    dashed: bool = False
    width: float = 1.0
    track: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneArea:
    """A flat, transparent area of a track: corners (m, 3) [m] and triangles."""

    group: str
    positions: Array
    indices: Array
    colour: str
    opacity: float
    text: str = ""
    track: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneLabel:
    """A word at a place (3,) [m] of a track."""

    group: str
    text: str
    at: Array
    role: str
    track: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneArrow:
    """An arrow from a place (3,) or (p, 3) along a vector of the same shapes [m of drawing]; bent where it turns."""

    group: str
    text: str
    colour: str
    curl: bool
    start: Array
    vector: Array
    scale: float  # what a metre of drawing stands for, in `unit`
    unit: str  # as it is printed
    decimal: str  # sign between whole and part


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneCurve:
    """A line that moves: points (frames, m, 3) [m] of a track, drawn as a tube."""

    points: Array
    colour: str
    radius: float
    track: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneMode:
    """A mode shape: extra turns (frames, 4) of tracks, and curves that move."""

    name: str
    text: str
    kind: Literal["whirl", "torsion"]
    frames: int
    turns: dict[int, Array] = field(default_factory=dict)
    curves: tuple[SceneCurve, ...] = ()


@dataclass(frozen=True, kw_only=True)
class SceneGroup:
    """A switch: what is drawn round the bodies, and a sentence on it."""

    name: str
    title: str
    on: bool
    text: str = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Scene:
    """A drive in space over one turn of its input.

    Attributes
    ----------
    name : str
    centre : array (3,) [m]
        Middle of everything.
    size : float [m]
        From corner to corner.
    angle : array (p,) [rad]
        Input angle of each frame; the frame behind the last is the first one again.
    tracks : tuple of Track
        How bodies move; the first stands still.
    bodies, lines, areas, labels, arrows, modes, groups : tuples
    scale : tuple of (float, str, str)
        Utilisation, its colour, and what it means.
    missing : dict of str
        What cannot be shown -> which key would allow it.
    """

    name: str
    centre: Array
    size: float
    angle: Array
    tracks: tuple[Track, ...]
    bodies: tuple[SceneBody, ...]
    lines: tuple[SceneLine, ...]
    areas: tuple[SceneArea, ...]
    labels: tuple[SceneLabel, ...]
    arrows: tuple[SceneArrow, ...]
    modes: tuple[SceneMode, ...]
    groups: tuple[SceneGroup, ...]
    scale: tuple[tuple[float, str, str], ...] = ()
    missing: dict[str, str] = field(default_factory=dict)

    def described(self) -> dict[str, Any]:
        """Return the scene as dicts, lists, numbers and words, ready for JSON."""
        places = max(0, DIGITS - 1 - math.floor(math.log10(self.size)))
        return _described(self, places)


def _described(shown: Scene, places: int) -> dict[str, Any]:
    def flat(values: Array) -> list[float]:
        found: list[float] = (np.round(np.asarray(values, dtype=float), places) + 0.0).ravel().tolist()
        return found

    def turn(values: Array) -> list[float]:
        found: list[float] = (np.round(values, DIGITS) + 0.0).ravel().tolist()
        return found

    def told(part: Any, **changed: Any) -> dict[str, Any]:
        """Return the fields of a part: points as lengths, indices as numbers, all else as it is."""
        found: dict[str, Any] = {}
        for one in fields(part):
            value = getattr(part, one.name)
            kept = flat(value) if isinstance(value, np.ndarray) and one.name != "indices" else value
            found[one.name] = value.ravel().tolist() if one.name == "indices" else kept
        return found | changed

    return {
        "name": shown.name,
        "centre": flat(shown.centre),
        "size": float(f"{shown.size:.6g}"),
        "frames": len(shown.angle),
        "angle": turn(shown.angle),
        "tracks": [{"origin": flat(one.origin), "turn": turn(one.turn)} for one in shown.tracks],
        "bodies": [
            told(one, utilisation=None if one.utilisation is None else float(f"{one.utilisation:.4g}"))
            for one in shown.bodies
        ],
        "lines": [told(one) for one in shown.lines],
        "areas": [told(one) for one in shown.areas],
        "labels": [told(one) for one in shown.labels],
        "arrows": [
            {"from" if key == "start" else key: value for key, value in told(one).items()} for one in shown.arrows
        ],
        "modes": [
            {
                "name": one.name,
                "text": one.text,
                "kind": one.kind,
                "frames": one.frames,
                "turns": {str(track): turn(values) for track, values in one.turns.items()},
                "curves": [
                    {
                        "points": flat(curve.points),
                        "count": curve.points.shape[1],
                        "colour": curve.colour,
                        "radius": float(f"{curve.radius:.4g}"),
                        "track": curve.track,
                    }
                    for curve in one.curves
                ],
            }
            for one in shown.modes
        ],
        "groups": [told(one) for one in shown.groups],
        "scale": [{"value": value, "colour": colour, "text": text} for value, colour, text in shown.scale],
        "missing": dict(shown.missing),
    }
