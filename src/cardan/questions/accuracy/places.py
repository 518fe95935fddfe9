"""Where the driven shafts of joints lie with errors inside the joints: off at the joint, at the far end, and leaning.

A shaft between two joints starts where its joint puts it and swivels in the next one; behind an end joint it swivels
where a ball or pivot of the joint's own holds it. What moves it is found by the loops closed with the errors, and to
first order by difference quotients of these.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.geometry import geometry
from cardan.drive.models.wobble import Course, course
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.texts import _

from .own_laws import LEAST, STEP, WEIGHTS

Off = Sequence[Mapping[str, Array]]

ROUNDING = 1e-13
"""Angle [rad] by which the output is ahead below which it is not."""

LENGTH = 0.1
"""Size [m] of which a share is the step of an error of length that belongs to no size."""


def placing(drive: Drive) -> tuple[tuple[str, ...], ...]:
    """Return the keys of the errors of each joint that move its driven shaft."""
    return tuple(() if stays(drive, number) else joint.placing() for number, joint in enumerate(drive.joints, start=1))


def stays(drive: Drive, number: int) -> str:
    """Return in a sentence why the driven shaft of a joint keeps its place whatever its joint does; "" if not."""
    across = sum(one.radial + one.tilt for one in drive.supports if one.shaft == number + 1)
    length = known_lengths(drive).get(number + 1)
    if across < 2 and drive.joints[number - 1].held(length) is not None:
        return ""
    if number < len(drive.joints) and across < 2:
        return _("the file does not say how long the shaft behind it is")
    return _(
        "bearings hold the shaft behind it; what is off takes up their play or loads them, as the misalignment tells"
    )


def unmoved(drive: Drive, number: int) -> str:
    """Return in a sentence why no error inside a joint moves a shaft; "" where one does."""
    joint = drive.joints[number - 1]
    if joint.tolerated and joint.free_ways:
        return _("its mechanism lets its shafts shift in their centre, and bearings hold them")
    return stays(drive, number) if joint.placing() or joint.tolerated else _(joint.stays)


@dataclass(frozen=True, eq=False, kw_only=True)
class Moved:
    """What errors do to where shafts lie, and to the angle of the output by that; arrays (..., p) or wider."""

    angle: Array  # (..., p) [rad]: by how much the output runs ahead
    # (..., n, 3, p, 3) [m, m, rad]: way of the shaft behind each joint across itself at the joint and at its far end,
    # and how far its direction leans
    ways: Array


def moved(drive: Drive, phi: Array, off: Off) -> Moved:
    """Return what errors do that move shafts, exactly.

    phi (p,) [rad]: input angles; off: errors of each joint by their key, arrays (...).
    """
    place = geometry(drive)
    shape = np.broadcast_shapes(*(np.shape(value) for one in off for value in one.values()))
    wide = [{key: np.asarray(value)[..., None] for key, value in one.items()} for one in off]
    made = course(drive, np.broadcast_to(phi, (*shape, *phi.shape)), place, off=wide)
    drawn = course(drive, phi, place)
    ahead = made.turned[-1] - drawn.turned[-1]
    ways = [_ways(made, drawn, i) for i in range(len(drive.joints))]
    ahead = (ahead + np.pi) % (2.0 * np.pi) - np.pi
    return Moved(angle=np.where(np.abs(ahead) < ROUNDING, 0.0, ahead), ways=np.stack(ways, axis=len(shape)))


def _ways(made: Course, drawn: Course, i: int) -> Array:
    """Return ways and lean of the shaft behind a joint, array (..., 3, p, 3)."""
    axis = drawn.axis[i + 1]
    start = made.start[i] - drawn.start[i]
    far = made.centre[i + 1] - drawn.centre[i + 1] if i + 1 < len(drawn.centre) else 0.0 * start
    across = [one - frames.dot(one, axis)[..., None] * axis for one in (start, far)]
    return np.stack((*across, made.axis[i + 1] - axis), axis=-3)


def influences(drive: Drive, phi: Array, names: Sequence[Container[str]]) -> dict[tuple[int, str], Moved]:
    """Return what each error that moves shafts does by one of it [SI], to first order: by joint, from 0, and key.

    names: of each joint the keys that are asked for.
    """
    found = {}
    for j, keys in enumerate(placing(drive)):
        joint = drive.joints[j]
        given = {key: size for key, size in joint.sizes().items() if size is not None}
        widest = max((abs(size) for size in given.values()), default=LENGTH)
        for key in (one for one in keys if one in names[j]):
            step = STEP * max(abs(given.get(key, widest)), LEAST * widest)
            each = np.asarray([place * step for place, _weight in WEIGHTS])
            off = {name: each if name == key else 0.0 * each for name in keys}
            one = moved(drive, phi, [off if k == j else {} for k in range(len(drive.joints))])
            weight = np.asarray([weight / step for _place, weight in WEIGHTS])
            found[j, key] = Moved(angle=np.tensordot(weight, one.angle, 1), ways=np.tensordot(weight, one.ways, 1))
    return found


def of_errors(drive: Drive, names: Sequence[Sequence[str]], errors: Array) -> Off:
    """Return those of errors (..., n, c), named by joint and seat, that move shafts; empty where none does."""
    rows = [
        {key: errors[..., j, list(names[j]).index(key)] for key in keys if key in names[j]}
        for j, keys in enumerate(placing(drive))
    ]
    return rows if any(np.any(value) for row in rows for value in row.values()) else ()


def sizes_of(ways: Array) -> Array:
    """Return the largest of ways and lean over the turn, array (..., n, 3), of `Moved.ways`."""
    return np.asarray(np.max(frames.norm(ways), axis=-1))
