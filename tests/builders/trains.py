"""Random drives that their supports hold just enough, and their balance shaft by shaft in plain vectors."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.drive.models.dynamics_model import Train, train_of_points
from cardan.questions.forces.forces import Forces


def layout(n: int) -> tuple[tuple[int, tuple[str, ...]], ...]:
    """Return supports for n joints: 5 components on shaft 1, 4 at the end, 2 between."""
    first = [(0, ("radial", "axial")), (0, ("radial",))]
    last = [(1, ("radial",))] if n == 1 else [(n, ("radial",)), (n, ("radial",))]
    return tuple(first + [(k, ("radial",)) for k in range(1, n - 1)] + last)  # type: ignore[arg-type]


def trains(
    random: np.random.Generator,
    n: int,
    outer: tuple[int, ...] = (),
    *,
    heavy: bool = True,
    drag: float = 0.0,
    **parts: Any,
) -> Train:
    """Return random spatial drives with joint angles to about 25°, with or without inertia, weight and friction."""
    aside = random.uniform(-0.25, 0.25, (*outer, n + 1, 2))
    steps = np.concatenate((np.ones((*outer, n + 1, 1)), aside), axis=-1) * random.uniform(0.3, 1.0, (*outer, n + 1, 1))
    points = np.concatenate((np.zeros((*outer, 1, 3)), np.cumsum(steps, axis=-2)), axis=-2)
    length = np.linalg.norm(steps, axis=-1)
    shares = [0.2, 0.7] + [0.45] * (n - 2) + ([0.6] if n == 1 else [0.3, 0.8])
    held = layout(n)
    own: dict[str, Any] = {
        "bearings": held,
        "position": np.stack([length[..., s] * share for (s, _h), share in zip(held, shares, strict=True)], axis=-1),
        "span": np.full((*outer, n), 0.08),
    }
    if heavy:
        own |= {
            "inertia": random.uniform(0.0, 0.2, (*outer, n + 1)),
            "mass": random.uniform(0.0, 9.0, (*outer, n + 1)),
            "centre_of_mass": random.uniform(0.0, 1.0, (*outer, n + 1)),
            "cross_inertia": random.uniform(0.001, 0.003, (*outer, n, 3)),
            "cross_mass": random.uniform(0.0, 1.0, (*outer, n)),
            "resisting_torque": random.uniform(-5.0, 5.0, (*outer, n + 1)),
            "gravity": np.asarray([0.3, -0.2, -9.81]),
        }
    if drag:
        own["drag"] = random.uniform(0.0, drag, (*outer, n))
    yokes = random.uniform(-3.0, 3.0, (*outer, n - 1))
    return train_of_points(points, yoke_angle=yokes, start_phase=random.uniform(-3.0, 3.0, outer), **(own | parts))


def one(train: Train, index: int) -> Train:
    """Return one drive of a batch with one leading axis."""
    from dataclasses import fields, replace

    from cardan.drive.models.kinematics_model import Chain

    picked = {
        field.name: getattr(train, field.name)[index]
        for field in fields(train)
        if isinstance(getattr(train, field.name), np.ndarray) and field.name != "gravity"
    }
    whole = Chain(**{name: table[index] for name, table in vars(train.chain).items() if table is not None})
    return replace(train, chain=whole, **picked)


def shaft_rests(train: Train, found: Forces, output: np.ndarray) -> tuple[float, float]:
    """Return the largest sums of forces and of moments about its beginning on any shaft, each shaft by itself.

    In three dimensions and by plain sums: all forces with their places, couples of both crosses, driving and resisting
    torques, inertia about the axis. Crosses weigh on their driving shafts.
    """
    n, points, axes = train.joints, train.points, found.axis
    zero = np.zeros(3)
    force_rest = moment_rest = 0.0
    for s in range(n + 1):
        start = points[s]
        force, moment = np.zeros((found.angle.size, 3)), np.zeros((found.angle.size, 3))

        def pull(f: np.ndarray, at: np.ndarray) -> None:
            nonlocal force, moment
            force = force + f
            moment = moment + np.cross(at - start, f)  # noqa: B023

        if s:
            pull(found.joint_force[s - 1], points[s])
            moment = moment + found.driven_couple[s - 1]
        else:
            moment = moment + found.input_torque[:, None] * axes[0]
        if s < n:
            pull(-found.joint_force[s], points[s + 1])
            moment = moment - found.driving_couple[s]
        else:
            moment = moment - output[:, None] * axes[n]
        for k, (shaft, _holds) in enumerate(train.bearings):
            if shaft == s:
                pull(found.reaction[k], start + train.position[k] * axes[s, 0])
                moment = moment + found.support_couple[k]
        if train.mass is not None:
            pull(train.mass[s] * train.gravity + zero, start + train.centre_of_mass[s] * axes[s, 0])
        if train.cross_mass is not None and s < n:
            pull(train.cross_mass[s] * train.gravity + zero, points[s + 1])
        if train.resisting_torque is not None:
            moment = moment - train.resisting_torque[s] * axes[s]
        if train.inertia is not None:
            moment = moment - (train.inertia[s] * found.acceleration[s])[:, None] * axes[s]
        force_rest = max(force_rest, float(np.abs(force).max()))
        moment_rest = max(moment_rest, float(np.abs(moment).max()))
    return force_rest, moment_rest
