"""Mode shapes in space: shafts that whirl, and shafts that swing in torsion, enlarged to be seen."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity
from cardan.answers.reader import reader
from cardan.drive.bodies.build import Build
from cardan.drive.drive import Drive
from cardan.drive.shapes.support import floor_frame
from cardan.errors import InputError
from cardan.figures import palette
from cardan.maths.arrays import Array
from cardan.questions.bending.bending import CriticalSpeeds, bending_speeds
from cardan.questions.bending.figures.bending import mode_name
from cardan.questions.torsion.model.torsion import TorsionModes, torsion_modes
from cardan.texts import _

from .loads import sentence
from .parts import SceneCurve, SceneMode

FRAMES = 48
"""Places of one swing."""

POINTS = 25
"""Places along a shaft."""

BOW = 0.045
"""Largest deflection over the size of the whole."""

SWING = math.radians(28.0)
"""Largest turn of a torsional mode."""

MOST = 5
"""Torsional modes shown."""


def shapes(drive: Drive, build: Build, size: float) -> tuple[tuple[SceneMode, ...], dict[str, str]]:
    """Return the mode shapes of a drive, and which keys would allow those that are missing.

    size [m].
    """
    modes: list[SceneMode] = []
    missing: dict[str, str] = {}
    try:
        modes += _whirls(bending_speeds(drive), build, size)
    except InputError as error:
        missing["whirl"] = sentence(error)
    try:
        modes += _torsions(torsion_modes(drive), build)
    except InputError as error:
        missing["torsion"] = sentence(error)
    if not modes:
        missing["modes"] = "; ".join(dict.fromkeys(missing.values()))
    return tuple(modes), missing


def _swing() -> Array:
    return np.arange(FRAMES) * (2.0 * np.pi / FRAMES)


def _whirls(found: CriticalSpeeds, build: Build, size: float) -> Iterator[SceneMode]:
    """Yield the shapes in which shafts whirl: every point of a shaft runs round its axis."""
    turn = _swing()
    gravity = np.asarray(build.drive.settings.gravity)
    for number, speed in enumerate(found.actual, start=1):
        curves = []
        for k, (first, last) in enumerate(found.shaft_span, start=1):
            if math.isnan(first) or not last > first:
                continue
            along = np.linspace(first, last, POINTS)
            off = BOW * size * np.interp(along, found.place, found.deflection[number - 1])
            _x, side, up = floor_frame(build.axis(k), gravity)
            start = build.centre(k - 2) if k > 1 else build.centre(0) - (last - first) * build.axis(1)
            share = (along - first) / (last - first)
            reach = float(build.place.length[k - 1]) if 1 < k <= build.count else float(last - first)
            axis = start + share[:, None] * reach * build.axis(k)
            way = np.cos(turn)[:, None] * up + np.sin(turn)[:, None] * side
            points = axis + off[:, None] * way[:, None, :]
            radius = 0.55 * build.body_radius(k)
            curves.append(SceneCurve(points=points, colour=palette.colour(f"shaft {k}"), radius=radius))
        said = Quantity(float(speed), "angular_speed").told(reader())
        text = _("critical speed {number}: {speed}").format(number=number, speed=said)
        yield SceneMode(
            name=text, text=mode_name(found.part[number - 1]), kind="whirl", frames=FRAMES, curves=tuple(curves)
        )


def _torsions(found: TorsionModes, build: Build) -> Iterator[SceneMode]:
    """Yield the shapes in which the drive swings in torsion: yokes and masses turn, lines along the shafts twist."""
    train, swing = found.train, np.sin(_swing())
    for number, (omega, shape) in enumerate(zip(found.omega[:MOST], found.shape[:MOST], strict=True), start=1):
        angle = dict(_ends(build, train.joints, shape))
        line = list(train.line)
        for k, own in build.free.items():
            angle[own] = k, float(shape[line[0] if k == 1 else line[-1]])
        for station, own in build.stations.items():
            k = build.drive.stations[station].shaft
            angle[own] = k, float(shape[line[0] if k == 1 else line[-1] if k > build.count else line[0]])
            place = _station_of(found, build, station)
            if place is not None:
                angle[own] = k, float(shape[place])
        turns = {track: _turn(build.axis(k), SWING * value * swing) for track, (k, value) in angle.items()}
        node = "; ".join(_node_texts(found, number - 1))
        said = Quantity(float(omega), "frequency", 3).told(reader())
        name = _("torsional mode {number}: {frequency}").format(number=number, frequency=said)
        yield SceneMode(
            name=name,
            text=node,
            kind="torsion",
            frames=FRAMES,
            turns=turns,
            curves=tuple(_lines(found, build, shape, swing)),
        )


def _ends(build: Build, joints: tuple[tuple[int, int], ...], shape: Array) -> Iterator[tuple[int, tuple[int, float]]]:
    """Yield the tracks at the joints with their shaft and how far they turn."""
    for i, (driving, driven) in enumerate(joints):
        yield build.ends[i + 1], (i + 1, float(shape[driving]))
        yield build.starts[i + 2], (i + 2, float(shape[driven]))


def _station_of(found: TorsionModes, build: Build, number: int) -> int | None:
    """Return the station of the model that carries a station of the file; None where it is not told apart."""
    name = build.drive.stations[number].name
    names = found.train.model.names
    hits = [k for k in found.train.line if name and names[k] == name]
    return hits[0] if len(hits) == 1 else None


def _node_texts(found: TorsionModes, mode: int) -> Iterator[str]:
    damping = float(found.damping_ratio[mode])
    names = found.train.model.names
    for node in found.nodes[mode][:3]:
        if node.before == node.behind:
            yield _("{place} stands still").format(place=names[node.before])
        else:
            yield _("stands still between {one} and {other}").format(one=names[node.before], other=names[node.behind])
    if damping > 0.0:
        yield _("damping ratio {ratio}").format(ratio=reader().number(damping, 2))


def _turn(axis: Array, angle: Array) -> Array:
    """Return turns about an axis as quaternions x y z w, array (p, 4)."""
    half = 0.5 * angle[:, None]
    return np.concatenate((np.sin(half) * axis, np.cos(half)), axis=-1)


def _lines(found: TorsionModes, build: Build, shape: Array, swing: Array) -> Iterator[SceneCurve]:
    """Yield lines along the shafts that twist with the mode, four round each."""
    train = found.train
    for k in range(2, build.count + 1):
        own = [s for s in train.line if train.model.shaft[s] == k - 1]
        if len(own) < 2:
            continue
        place = np.asarray(train.position)[own] - float(train.position[own[0]])
        whole = float(place[-1])
        if not whole > 0.0:
            continue
        length = float(build.place.length[k - 1])
        low, high = build.reach(k - 2, driving=False), length - build.reach(k - 1, driving=True)
        along = np.linspace(low, high, POINTS // 2)
        twist = np.interp(along / length, place / whole, shape[own] - shape[own[0]])
        angle = SWING * swing[:, None] * twist
        radius = 1.02 * build.body_radius(k)
        for quarter in range(4):
            at = angle + 0.5 * np.pi * quarter
            points = np.stack((np.broadcast_to(along, at.shape), radius * np.cos(at), radius * np.sin(at)), axis=-1)
            yield SceneCurve(
                points=points,
                colour=palette.ROLES["warning"],
                radius=0.05 * radius,
                track=build.starts[k],
            )
