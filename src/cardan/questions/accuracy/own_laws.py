"""What joints of kinds without a single cross do with errors: each by its own law, exactly and to first order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cardan.drive.joints import Joint
from cardan.maths.arrays import Array
from cardan.reading.fields import fields_of

TURNS = ("phase", "alpha1", "alpha2", "alpha3", "alpha4")
"""Errors of a joint that turn the output, in the order of the last axis of arrays; sizes of its kind follow them."""

STEP = 1e-3
"""Step of the difference quotients, of an angle [rad], or as a share of a size: what it leaves is of its 4th power."""

WEIGHTS = ((-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0))
"""Places and weights of a difference quotient that is exact up to powers of four."""

LEAST = 0.01
"""Share of the largest size by which a size about zero is stepped."""


def seats(joints: Sequence[Joint]) -> list[tuple[str, ...]]:
    """Return the names of the errors of each joint that turn the output, as many of each, "" for a seat left empty.

    >>> from cardan.joints import Hooke, Tracta
    >>> [row[-2:] for row in seats([Hooke(), Tracta(driving_distance=0.05, driven_distance=0.05)])]
    [('', ''), ('driving_distance', 'driven_distance')]
    """
    own = [tuple("" if size is None else name for name, size in joint.sizes().items()) for joint in joints]
    count = max((len(row) for row in own), default=0)
    cross = [TURNS if joint.single_cross else ("phase", "", "", "", "alpha4") for joint in joints]
    return [(*first, *row, *("",) * (count - len(row))) for first, row in zip(cross, own, strict=True)]


def table_of(joint: Joint, name: str = "tolerance") -> Any:
    """Return the class of the errors, tolerances or costs that a joint of its kind can have."""
    return fields_of(type(joint))[name].type if name != "cost" else fields_of(table_of(joint))[name].type


def dimension(joint: Joint, key: str) -> str:
    """Return the dimension of an error of a joint, "" of a pure number."""
    return fields_of(table_of(joint))[key].key.dimension or ""


def influence(joint: Joint, joint_angle: float, theta: Array, count: int) -> Array:
    """Return how the driven mark feels errors of the joint, to first order: array (..., count) [rad by each].

    theta (...) [rad]: angle of the driving mark; count: seats of arrays of errors.
    The phase as the turn itself, all else by difference quotients of the law.
    """
    found = np.zeros((*theta.shape, count))
    found[..., 0] = joint.deviation(theta.reshape(-1), np.asarray(joint_angle))[1].reshape(theta.shape)
    given = {name: size for name, size in joint.sizes().items() if size is not None}
    widest = max((abs(size) for size in given.values()), default=0.0)
    steps = {4: STEP}
    steps |= {
        5 + k: STEP * max(abs(given[name]), LEAST * widest)
        for k, name in enumerate(joint.sizes())
        if name in given and name in joint.law_sizes
    }
    for seat, step in steps.items():
        for place, weight in WEIGHTS:
            off = np.zeros(count)
            off[seat] = place * step
            found[..., seat] += weight / step * _one(joint, joint_angle, off, theta.reshape(-1))[0].reshape(theta.shape)
    return found


def turned(joint: Joint, joint_angle: float, errors: Array, theta: Array) -> tuple[Array, Array]:
    """Return how far the driven mark runs ahead of the driving one with errors, exactly, and its speed ratio.

    Returns arrays (..., p) [rad, 1].
    errors (..., c) [rad and SI]: in the order of `seats`; their phase is not looked at; theta (..., p) [rad].
    Errors that many drives share are asked for once; nan where the joint does not turn.
    """
    shape = np.broadcast_shapes(errors.shape[:-1], theta.shape[:-1])
    rows = np.broadcast_to(errors, (*shape, errors.shape[-1])).reshape(-1, errors.shape[-1])[:, 4:]
    angle = np.broadcast_to(theta, (*shape, theta.shape[-1]))
    flat = angle.reshape(-1, theta.shape[-1])
    unlike, which = np.unique(rows, axis=0, return_inverse=True)
    found = np.empty((2, *flat.shape))
    for k, row in enumerate(unlike):
        alike = slice(None) if len(unlike) == 1 else np.flatnonzero(which.reshape(-1) == k)
        some = flat[alike]
        whole = np.concatenate((np.zeros(4), row))
        found[:, alike] = _one(joint, joint_angle, whole, some.reshape(-1)).reshape(2, *some.shape)
    ahead, ratio = found.reshape(2, *angle.shape)
    return ahead, ratio


def _one(joint: Joint, joint_angle: float, errors: Array, theta: Array) -> Array:
    """Return how far the driven mark of a joint with errors (c,) runs ahead at angles (p,), with its ratio: (2, p)."""
    sizes = joint.sizes()
    off = dict(zip(sizes, errors[5 : 5 + len(sizes)].tolist(), strict=True))
    changed = {name: size + off[name] for name, size in sizes.items() if size is not None and off[name]}
    made = joint.sized(changed) if changed else joint
    with np.errstate(invalid="ignore", divide="ignore"):
        ahead, ratio, _slope = made.deviation(theta, np.asarray(joint_angle + float(errors[4])))
    return np.stack((ahead, ratio))
