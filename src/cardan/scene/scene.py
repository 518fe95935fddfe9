"""The drive in space, for an eye that moves: bodies with their motion over one turn, and what is drawn round them.

Lengths in m, turns in rad; a renderer only interpolates between frames and draws, it needs no kinematics.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cardan.answers.quantity import told
from cardan.answers.reader import reader
from cardan.catalogue.completion import filled
from cardan.checks.verdict import Verdict
from cardan.drive.bodies.assembly import FRAMES, assembled, turns
from cardan.drive.bodies.build import Build, Solid
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import pose_drives
from cardan.drive.models.geometry import geometry
from cardan.drive.models.laws import mixed
from cardan.errors import InputError, refuse
from cardan.figures import palette
from cardan.maths.arrays import Array
from cardan.questions.motion.moving_points import moving_points
from cardan.texts import _

from .lines import drawn_round
from .loads import loads
from .modes import shapes
from .parts import Scene, SceneArrow, SceneBody, SceneMode
from .utilisation import Use, scale, use_colour, used

__all__ = ["Scene", "scene"]


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

    See Also
    --------
    report

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
    whole = _filled(drive)
    build = _built(whole, pose, time, frames)
    centre, size = _extent(build)
    lines, areas, labels, groups = drawn_round(build, size)
    missing = _stuck(whole, build)
    arrows: tuple[SceneArrow, ...] = ()
    modes: tuple[SceneMode, ...] = ()
    if with_forces:
        arrows, more, told = loads(build.drive, build, size)
        groups, missing = (*groups, *more), {**missing, **told}
    if with_modes:
        modes, told = shapes(build.drive, build, size)
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
    if not any(joint.size for joint in drive.joints):
        return drive
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
    """Return middle and size of all bodies; those that turn count round their axis x."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for solid in build.solids:
        track, corners = build.tracks[solid.track], solid.surface.positions
        least, most = np.min(corners, axis=0), np.max(corners, axis=0)
        reach = 0.0
        if solid.track:
            reach = float(max(np.max(np.abs(least[1:])), np.max(np.abs(most[1:]))))
            origin = track.origin if track.origin.ndim == 1 else track.origin[0]
            x, y, z, w = track.turn[0]
            axis = np.asarray([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])
            ends = origin + least[0] * axis, origin + most[0] * axis
            least, most = np.minimum(*ends), np.maximum(*ends)
        low, high = np.minimum(low, least - reach), np.maximum(high, most + reach)
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _stuck(drive: Drive, build: Build) -> dict[str, str]:
    """Return that joints do not turn at their joint angle, where any does not."""
    if not mixed(drive.joints):
        return {}
    numbers = [str(i + 1) for i in turns(drive, build)]
    if not numbers:
        return {}
    text = _("joint {number} does not turn at its joint angle with these sizes; it is shown turning evenly")
    return {"motion": text.format(number=", ".join(numbers))}


def _body(solid: Solid, k: int, uses: Callable[[Solid], Use | None]) -> SceneBody:
    found = uses(solid)
    said = told(solid.text, reader())
    text = said if found is None else f"{said}; {found[1]}"
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
