"""The drive in space, for an eye that moves: bodies with their motion over one turn, and what is drawn round them.

Lengths in m, turns in rad; a renderer only interpolates between frames and draws, it needs no kinematics.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from cardan.analysis.moving_points import moving_points
from cardan.catalogue.completion import filled
from cardan.checks.verdict import Verdict
from cardan.drive.bodies.assembly import FRAMES, assembled, turns
from cardan.drive.bodies.build import Build, Solid, Track
from cardan.drive.drive import Drive
from cardan.drive.geometry import geometry
from cardan.drive.paths import pose_drives
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from . import palette

DIGITS = 6
"""Significant digits of lengths, beside the size of the whole."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SceneBody:
    """A body of a scene; its corners lie in the frame of its track.

    Attributes
    ----------
    name : str
        Unlike that of any other body.
    part : str
        What it is.
    number : int
        Of its shaft, joint or support.
    path : str
        Where the drive file speaks of it.
    text : str
        What it is, in words.
    track : int
    positions : array (m, 3) [m]
    indices : int array (t, 3)
        Triangles, counter-clockwise seen from outside; corners at sharp edges are doubled.
    smooth : bool
        Whether normals are averaged over the triangles of a corner.
    colour : str
    metal : bool
    utilisation : float or None
        Largest share of a limit that it uses.
    utilisation_colour : str
        Of that share.
    """

    name: str
    part: str
    number: int
    path: str
    text: str
    track: int
    positions: Array
    indices: Array
    smooth: bool
    colour: str
    metal: bool
    utilisation: float | None = None
    utilisation_colour: str = palette.ROLES["faint"]


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


def scene(
    drive: Drive,
    *,
    verdicts: Sequence[Verdict] = (),
    pose: int | None = None,
    time: float | None = None,
    with_forces: bool = False,
    with_modes: bool = False,
    frames: int = FRAMES,
) -> Scene:
    """Return a drive in space over one turn of its input, with real proportions where its file gives them.

    Parameters
    ----------
    drive : Drive
        Any drive.
    verdicts : sequence of Verdict
        Of `check` on it; bodies are then coloured by how far they use their limits.
    pose : int, optional
        Index of the pose it stands in; as drawn when not given.
    time : float, optional [s]
        At which its movements have brought it; standing there it turns once.
    with_forces : bool
        Also arrows of forces and couples over the turn, where the drive says what they follow from.
    with_modes : bool
        Also the shapes in which it whirls and swings in torsion.
    frames : int
        Places of the turn, evenly by the input angle.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        A pose that is not there, a time that its movements do not know.

    Notes
    -----
    Every place is exact: shafts and crosses stand by their arm directions (spec: model and sign conventions), other
    kinds by their own law. Rigid parts keep their lengths in a pose; slip splines take up the difference.

    Examples
    --------
    >>> shown = scene(Drive.from_angles([0.2, 0.2]), frames=24)
    >>> len(shown.bodies), shown.angle.size, [group.name for group in shown.groups][:3]
    (15, 24, ['names', 'axes', 'planes'])
    """
    from .scene_lines import drawn_round
    from .scene_use import scale, used

    whole = _filled(drive)
    build = _built(whole, pose, time, frames)
    centre, size = _extent(build)
    lines, areas, labels, groups = drawn_round(build, size)
    missing = _stuck(whole, build)
    arrows: tuple[SceneArrow, ...] = ()
    modes: tuple[SceneMode, ...] = ()
    if with_forces:
        from .scene_loads import loads

        arrows, more, told = loads(whole, build, size)
        groups, missing = (*groups, *more), {**missing, **told}
    if with_modes:
        from .scene_modes import shapes

        modes, told = shapes(whole, build, size)
        missing = {**missing, **told}
    uses = used(verdicts)
    return Scene(
        name=drive.name,
        centre=centre,
        size=size,
        angle=np.arange(frames) * (2.0 * np.pi / frames),
        tracks=tuple(build.tracks),
        bodies=tuple(_body(solid, k, uses) for k, solid in enumerate(build.solids)),
        lines=lines,
        areas=areas,
        labels=labels,
        arrows=arrows,
        modes=modes,
        groups=groups,
        scale=scale() if verdicts else (),
        missing=missing,
    )


def _filled(drive: Drive) -> Drive:
    try:
        return filled(drive)
    except InputError:
        return drive


def _built(drive: Drive, pose: int | None, time: float | None, frames: int) -> Build:
    """Return the bodies of a drive in a pose, at a time of its movements, or as drawn."""
    stood = drive
    if pose is not None:
        if not 0 <= pose < len(drive.poses):
            text = _("there is no pose {number}; the drive has {count}")
            raise refuse("pose", text.format(number=pose, count=len(drive.poses)))
        stood = pose_drives(drive)[pose]
    drawn = geometry(drive)
    here = drawn if stood is drive else geometry(stood)
    points = None
    if time is not None and stood.movements:
        points = moving_points(here.points, stood.movements, [time])[0][0]
    same = len(drawn.length) == len(here.length)
    return assembled(stood, count=frames, points=points, drawn=drawn if same else None)


def _extent(build: Build) -> tuple[Array, float]:
    """Return middle and size of all bodies as they stand at the start."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for solid in build.solids:
        track = build.tracks[solid.track]
        origin = track.origin if track.origin.ndim == 1 else track.origin[0]
        span = float(np.max(np.abs(solid.surface.positions[:, 1:])))
        ends = solid.surface.positions[[int(np.argmin(solid.surface.positions[:, 0]))]]
        ends = np.concatenate((ends, solid.surface.positions[[int(np.argmax(solid.surface.positions[:, 0]))]]))
        ends[:, 1:] *= 0.0 if solid.track else 1.0
        there = origin + _turned(track.turn[0], ends)
        reach = span if solid.track else 0.0
        low, high = np.minimum(low, np.min(there, axis=0) - reach), np.maximum(high, np.max(there, axis=0) + reach)
        if not solid.track:
            low = np.minimum(low, np.min(solid.surface.positions, axis=0))
            high = np.maximum(high, np.max(solid.surface.positions, axis=0))
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _turned(q: Array, points: Array) -> Array:
    """Return points (m, 3) turned by a quaternion x y z w."""
    twice = 2.0 * np.cross(q[:3], points)
    turned: Array = points + q[3] * twice + np.cross(q[:3], twice)
    return turned


def _stuck(drive: Drive, build: Build) -> dict[str, str]:
    """Return that joints do not turn at their bend, where any does not."""
    own = {"pin_coupling", "clemens", "rzeppa", "weiss"}
    if not any(joint.kind in own for joint in drive.joints):
        return {}
    numbers = [str(i + 1) for i in turns(drive, build)]
    if not numbers:
        return {}
    text = _("joint {number} does not turn at its bend with these sizes; it is shown turning evenly")
    return {"motion": text.format(number=", ".join(numbers))}


def _body(solid: Solid, k: int, uses: Any) -> SceneBody:
    from .scene_use import use_colour

    found = uses(solid)
    text = solid.text if found is None else f"{solid.text}; {found[1]}"
    return SceneBody(
        name=f"{solid.part} {solid.number}-{k}",
        part=solid.part,
        number=solid.number,
        path=solid.path,
        text=text,
        track=solid.track,
        positions=solid.surface.positions,
        indices=solid.surface.indices,
        smooth=True,
        colour=palette.mixed(palette.colour(solid.role), "#ffffff", solid.shade),
        metal=solid.metal,
        utilisation=None if found is None else found[0],
        utilisation_colour=use_colour(None if found is None else found[0]),
    )


def _described(shown: Scene, places: int) -> dict[str, Any]:
    def flat(values: Array) -> list[float]:
        found: list[float] = (np.round(np.asarray(values, dtype=float), places) + 0.0).ravel().tolist()
        return found

    def turn(values: Array) -> list[float]:
        found: list[float] = (np.round(values, DIGITS) + 0.0).ravel().tolist()
        return found

    return {
        "name": shown.name,
        "centre": flat(shown.centre),
        "size": float(f"{shown.size:.6g}"),
        "frames": len(shown.angle),
        "angle": turn(shown.angle),
        "tracks": [{"origin": flat(one.origin), "turn": turn(one.turn)} for one in shown.tracks],
        "bodies": [
            {
                "name": one.name,
                "part": one.part,
                "number": one.number,
                "path": one.path,
                "text": one.text,
                "track": one.track,
                "positions": flat(one.positions),
                "indices": one.indices.ravel().tolist(),
                "smooth": one.smooth,
                "colour": one.colour,
                "metal": one.metal,
                "utilisation": None if one.utilisation is None else float(f"{one.utilisation:.4g}"),
                "utilisation_colour": one.utilisation_colour,
            }
            for one in shown.bodies
        ],
        "lines": [
            {
                "group": one.group,
                "points": flat(one.points),
                "colour": one.colour,
                "dashed": one.dashed,
                "width": one.width,
                "track": one.track,
            }
            for one in shown.lines
        ],
        "areas": [
            {
                "group": one.group,
                "positions": flat(one.positions),
                "indices": one.indices.ravel().tolist(),
                "colour": one.colour,
                "opacity": one.opacity,
                "text": one.text,
                "track": one.track,
            }
            for one in shown.areas
        ],
        "labels": [
            {"group": one.group, "text": one.text, "at": flat(one.at), "role": one.role, "track": one.track}
            for one in shown.labels
        ],
        "arrows": [
            {
                "group": one.group,
                "text": one.text,
                "colour": one.colour,
                "curl": one.curl,
                "from": flat(one.start),
                "vector": flat(one.vector),
            }
            for one in shown.arrows
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
        "groups": [{"name": one.name, "title": one.title, "on": one.on, "text": one.text} for one in shown.groups],
        "scale": [{"value": value, "colour": colour, "text": text} for value, colour, text in shown.scale],
        "missing": dict(shown.missing),
    }
