"""What the bearings of every joint go through in a turn: loads, swings and the damage of both, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.conditions import LoadCase
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import Problem, check
from cardan.formulas.joint_rating import POWER
from cardan.maths.arrays import Array
from cardan.maths.curves.cycle_statistics import mean_between
from cardan.questions.losses.chain_friction import kinks
from cardan.questions.losses.loss_model import Model, flowing, moving
from cardan.texts import _

LOOK = 720
"""Places a turn at which the largest load is looked for."""

RESTS = 1e-10
"""Share by which a mean may still change when it rests; torques that turn about leave it a weak kink."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BearingLoads:
    """Loads of the bearings of a drive in some parts of its duty cycle."""

    joint_angle: Array  # (b, n) [rad]: bend of each joint
    torque: Array  # (b, n) [N·m]: mean torque that enters each joint, over the turning of its driving shaft
    couple: Array  # (b, n) [N·m]: largest couple of each cross; over the span it is the load of a journal
    # driving, driven (b, n) [(N·m)^(10/3)]: mean of |dδ/dφ_1| K^(10/3), δ the swing in the driving and in the driven
    # yoke, K the couple of the cross
    driving: Array
    driven: Array  # (b, n) [(N·m)^(10/3)]


def bearing_loads(drive: Drive, machine: Train, duty: Duty, parts: Sequence[LoadCase]) -> BearingLoads:
    """Return what the bearings of a drive go through in each part of a duty cycle.

    machine: its machine half; duty: harmonics of the torque, acceleration, and at which end the torque is given.
    parts, sequence of LoadCase (b,): torque, speed and bend of each part.
    Raises InputError: friction locks a joint.
    Torques go from the end where they are given through the drive, with the friction of the journals, inertia and
    resisting torques of the shafts where the drive gives them; the means by Gauss's rule between the angles at which
    a cross stops in a yoke.
    """
    found: list[BearingLoads | None] = [None] * len(parts)
    joint_angles = [part.joint_angle for part in parts]
    for joint_angle in dict.fromkeys(joint_angles):
        own = [k for k, one in enumerate(joint_angles) if one == joint_angle]
        chain = (
            machine.chain
            if joint_angle is None
            else replace(machine.chain, joint_angle=np.full(len(drive.joints), joint_angle))
        )
        model = _model(drive, machine, duty, chain, [parts[k] for k in own])
        for k, one in zip(own, _of_chain(model), strict=True):
            found[k] = one
    rows = [one for one in found if one is not None]
    return BearingLoads(
        **{name: np.stack([getattr(one, name) for one in rows]) for name in BearingLoads.__dataclass_fields__}
    )


def _model(drive: Drive, machine: Train, duty: Duty, chain: Chain, parts: Sequence[LoadCase]) -> Model:
    """Return what the torques depend on, one case for each part."""
    n = len(drive.joints)
    none = np.zeros(n + 1)
    drag = np.zeros(n) if machine.drag is None else machine.drag
    text = _("friction locks joint {number}: over the journals it reaches {share:.3g} of what turns it")
    hold = drag * np.tan(chain.joint_angle)
    check(
        Problem(f"joints[{i}].friction", text.format(number=i + 1, share=float(hold[i])))
        for i in np.flatnonzero(hold >= 1.0)
    )
    return Model(
        chain=chain,
        drag=drag,
        inertia=none if machine.inertia is None else machine.inertia,
        resisting=none if machine.resisting_torque is None else machine.resisting_torque,
        speed=np.asarray([part.speed or 0.0 for part in parts]),
        torque=np.asarray([part.torque or 0.0 for part in parts]),
        acceleration=duty.acceleration,
        torque_at=duty.torque_at,
        harmonics=duty.harmonics,
        torque_scale=duty.torque or 0.0,
        rub=np.zeros(0),
        on=np.zeros(0, dtype=int),
        grip=none,
        slide=none,
    )


def _of_chain(model: Model) -> list[BearingLoads]:
    """Return the loads of cases that share their joint angles, one by one."""
    n, cases = model.chain.joints, model.torque.size
    period = 2.0 * np.pi * model.turns if model.harmonics else np.pi
    places = np.ravel(kinks(model.chain)[:, None] + np.pi * np.arange(round(period / np.pi)))
    scale = _largest(model, period)
    size = np.where(scale > 0.0, scale, 1.0)

    def rows(angle: Array) -> Array:
        moved = moving(model, np.broadcast_to(angle, (cases, *angle.shape)))
        flow = flowing(model, moved)[0]
        load = np.abs(flow.couple / size[..., None]) ** POWER
        parts = (
            np.abs(moved.cross_driving_rate) * load,
            np.abs(moved.cross_driven_rate) * load,
            flow.leaving[..., :-1, :] * moved.shaft_ratio[..., :-1, :],
        )
        return np.concatenate([np.broadcast_to(part, (cases, n, angle.shape[-1])) for part in parts], axis=-2)

    mean = mean_between(rows, places, period=period, rests=RESTS)
    driving, driven, torque = (mean[:, k * n : (k + 1) * n] for k in range(3))
    joint_angle = np.asarray(model.chain.joint_angle, dtype=float)
    return [
        BearingLoads(
            joint_angle=joint_angle,
            torque=torque[k],
            couple=scale[k],
            driving=driving[k] * size[k] ** POWER,
            driven=driven[k] * size[k] ** POWER,
        )
        for k in range(cases)
    ]


def _largest(model: Model, period: float) -> Array:
    """Return the largest couple of each cross, array (b, n) [N·m]: at its kinks or near them, or else on a grid."""
    grid = np.linspace(0.0, period, round(LOOK * period / (2.0 * np.pi)) + 1)
    angle = np.sort(np.concatenate((grid, np.remainder(kinks(model.chain), np.pi))))
    cases = np.broadcast_to(angle, (model.torque.size, angle.size))
    found: Array = np.max(np.abs(flowing(model, moving(model, cases))[0].couple), axis=-1)
    return found
