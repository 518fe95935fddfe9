"""A mechanism in space, for an eye that moves: its links with their motion over the range of the input."""

from __future__ import annotations

import numpy as np

from cardan.answers import palette
from cardan.drive.bodies.build import Track
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.kernel.meshes import quaternions
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.turning import grid
from cardan.questions.mechanism.bodies import link_body
from cardan.questions.mechanism.motion import MechanismMotion, mechanism_motion
from cardan.units import deg

from .parts import Scene, SceneBody

STEP = 5.0 * deg
"""Step of the input from one frame to the next."""

BACK = 1e-6
"""What a mechanism may miss after its range, lengths over the size, to go on; else it goes back the way it came."""


def mechanism_scene(mechanism: Mechanism) -> Scene:
    """Return a mechanism in space over the range of its input.

    One that does not stand as at the start after it goes to and fro. Raises InputError as `mechanism_motion` does.

    >>> from cardan.mechanisms import example_mechanism
    >>> shown = mechanism_scene(example_mechanism("crank-slider"))
    >>> len(shown.bodies), len(shown.tracks), shown.angle.size
    (4, 4, 72)
    """
    found = mechanism_motion(mechanism, grid(mechanism, STEP))
    poses, angle = found.turned.displacement, found.position
    if mechanism.slides:  # frames are told by an angle: the stroke is one turn
        angle = np.linspace(0.0, 2.0 * np.pi, len(angle))
    size = found.turned.placed.size
    if np.max(np.abs(poses[-1] - poses[0]) / np.asarray([1.0, 1.0, 1.0, size])) < BACK:
        poses, angle = poses[:-1], angle[:-1]
    else:
        poses, angle = (np.concatenate((one, one[-2:0:-1])) for one in (poses, angle))
    still = Track(origin=np.zeros(3), turn=np.asarray([[0.0, 0.0, 0.0, 1.0]]))
    moving = [
        Track(origin=one[:, :3, 3], turn=quaternions(np.swapaxes(one[:, :3, :3], -1, -2)))
        for one in np.swapaxes(poses, 0, 1)
    ]
    bodies = tuple(_body(mechanism, link, k) for k, link in enumerate((mechanism.frame, *mechanism.links)))
    low, high = _box(found, bodies)
    return Scene(
        name=mechanism.name,
        centre=0.5 * (low + high),
        size=float(frames.norm(high - low)),
        angle=angle,
        tracks=(still, *moving),
        bodies=bodies,
        lines=(),
        areas=(),
        labels=(),
        arrows=(),
        modes=(),
        groups=(),
    )


def _body(mechanism: Mechanism, link: str, k: int) -> SceneBody:
    body = link_body(mechanism, link)
    return SceneBody(
        name=f"{k} {link}",
        part="link",
        number=k,
        path="frame" if k == 0 else "joints",
        text=link,
        track=k,
        positions=body.positions,
        indices=body.indices,
        smooth=True,
        colour=palette.colour(palette.shaft(k) if k else "cross"),
        metal=True,
    )


def _box(found: MechanismMotion, bodies: tuple[SceneBody, ...]) -> tuple[Array, Array]:
    """Return the corners of a box round all that the bodies reach."""
    every = [bodies[0].positions]
    for k, body in enumerate(bodies[1:]):
        poses = found.turned.displacement[:, k]
        every.append((poses[:, None, :3, :3] @ body.positions[..., None])[..., 0] + poses[:, None, :3, 3])
    rows = np.concatenate([np.reshape(one, (-1, 3)) for one in every])
    return rows.min(axis=0), rows.max(axis=0)
