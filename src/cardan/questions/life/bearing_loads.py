"""What the bearings of every joint go through in a turn: loads, swings and the damage of both, exactly."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.drive.conditions import LoadCase
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Joint
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.kinematics_model import Chain, as_given, turning
from cardan.errors import Problem, check
from cardan.formulas.joint_rating import POWER
from cardan.maths.arrays import Array
from cardan.maths.curves.cycle_statistics import mean_between
from cardan.maths.kernel import frames
from cardan.questions.losses.chain_friction import kinks
from cardan.questions.losses.loss_model import Model, flowing, moving
from cardan.questions.losses.loss_parts import rubbing_of
from cardan.questions.motion.joint_mechanism import joint_carried
from cardan.questions.motion.motion import Motion
from cardan.questions.torsion.steady.dynamic_torque import DynamicTorque
from cardan.texts import _

PLACES = 360
"""Places of a turn at which the bearings are looked at."""


@lru_cache(maxsize=512)
def bearing_damage(joint: Joint, joint_angle: float) -> tuple[Array, Array]:
    """Return what the bearings in a joint go through for a torque of 1 N·m on its driven shaft.

    joint: with the sizes of `Joint.rated`; joint_angle [rad].
    Returns the largest force on any of them over the torque, array (`PLACES`,) [1/m], and for the one that wears most
    on the driving and on the driven side |dδ/dφ| (F/T)^(10/3), array (2, `PLACES`) [1/m^(10/3)]: δ the angle by which
    it turns, φ that of the driving shaft, at even places θ of its driving mark. A journal carries F = |R|/2 + |M|/l of
    the reaction (M; R) in its pin, l the distance of both its bearings; a roller that runs by s turns by s/r.
    """
    angle = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    found = joint_carried(joint, joint_angle, angle, loads=True)
    forces, damages = [], []
    for k, pair in enumerate(found.pairs[: found.inner]):
        turn, couple = frames.norm(found.found.rate[:, k, :3]), frames.norm(found.found.reaction[:, k, :3])
        force = frames.norm(found.found.reaction[:, k, 3:])
        if pair.rolls > 0.0:
            turn = frames.norm(found.found.rate[:, k, 3:]) / pair.rolls
        elif np.isfinite(pair.spread):
            force = 0.5 * force + couple / pair.spread
        else:
            continue
        forces.append(force)
        damages.append(turn * force**POWER)
    half = max(len(damages) // 2, 1)
    worst = [max(side, key=lambda one: float(np.mean(one))) for side in (damages[:half], damages[-half:])]
    return np.max(forces, axis=0), np.stack(worst)


LOOK = 720
"""Places a turn at which the largest load is looked for."""

PHASES = 16
"""Phases of a torque that swings out of step over which a mean is taken."""

RESTS = 1e-10
"""Share by which a mean may still change when it rests; torques that turn about leave it a weak kink."""


@dataclass(frozen=True, eq=False, kw_only=True)
class BearingLoads:
    """Loads of the bearings of a drive in some parts of its duty cycle."""

    joint_angle: Array  # (b, n) [rad]: bend of each joint
    # (b, n) [N·m]: mean torque that enters each joint, over the turning of its driving shaft; with torsional vibration
    # the constant one that damages as much
    torque: Array
    couple: Array  # (b, n) [N·m]: largest couple of each cross; over the span it is the load of a journal
    # driving, driven (b, n) [(N·m)^(10/3)]: mean of |dδ/dφ_1| K^(10/3), δ the swing in the driving and in the driven
    # yoke, K the couple of the cross
    driving: Array
    driven: Array  # (b, n) [(N·m)^(10/3)]

    def of(self, joints: Sequence[int]) -> BearingLoads:
        """Return the loads of some of the joints, counted from 0."""
        return BearingLoads(**{name: values[:, list(joints)] for name, values in vars(self).items()})


def bearing_loads(
    drive: Drive,
    machine: Train,
    duty: Duty,
    parts: Sequence[LoadCase],
    *,
    drawn: Train | None = None,
    vibrating: Sequence[DynamicTorque | None] = (),
) -> BearingLoads:
    """Return what the bearings of a drive go through in each part of a duty cycle.

    machine: its machine half; duty: harmonics of the torque, acceleration, and at which end the torque is given.
    parts, sequence of LoadCase (b,): torque, speed and bend of each part.
    vibrating (b,): the torques of each part with torsional vibration; None, or none at all, where it is not counted.
    drawn: machine half for which these are, where it is another one: what vibration adds there is added here.
    Raises InputError: friction locks a joint.
    Torques go from the end where they are given through the drive, with the friction of the joints, inertia and
    resisting torques of the shafts where the drive gives them; the means by Gauss's rule between the angles at which
    a cross stops in a yoke.
    """
    found: list[BearingLoads | None] = [None] * len(parts)
    joint_angles = [part.joint_angle for part in parts]
    for joint_angle in dict.fromkeys(joint_angles):
        own = [k for k, one in enumerate(joint_angles) if one == joint_angle]
        chain = machine.chain if joint_angle is None else _bent(drive, machine.chain, joint_angle)
        model = _model(drive, machine, duty, chain, [parts[k] for k in own])
        still = model
        if drawn is not None and drawn is not machine:
            still = _model(drive, drawn, duty, drawn.chain if joint_angle is None else chain, [parts[k] for k in own])
        flow = _Flow(model, still, [vibrating[k] if vibrating else None for k in own])
        for k, one in zip(own, _inside(flow, drive.joints, _of_chain(flow)), strict=True):
            found[k] = one
    rows = [one for one in found if one is not None]
    return BearingLoads(
        **{name: np.stack([getattr(one, name) for one in rows]) for name in BearingLoads.__dataclass_fields__}
    )


def _bent(drive: Drive, chain: Chain, joint_angle: float) -> Chain:
    """Return a chain with all its joints at one joint angle [rad], its planes and yokes as they are."""
    own = as_given(chain, drive.joints)
    return turning(replace(own, joint_angle=np.full(len(drive.joints), joint_angle)), drive.joints, near=True)


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
        seal=np.zeros(0),
        grip=none,
        slide=none,
        rubbing=rubbing_of(drive.joints, many=bool(drive.movements)),
    )


class _Flow:
    """The torques of cases that share their joint angles, with what torsional vibration adds."""

    def __init__(self, model: Model, drawn: Model, vibrating: Sequence[DynamicTorque | None]) -> None:
        self.model, self.drawn, self.vibrating = model, drawn, vibrating
        halves = math.lcm(model.halves, *(round(one.orbit.period / np.pi) for one in vibrating if one is not None))
        self.period = halves * np.pi

    def at(self, angle: Array) -> tuple[Motion, Array, Array, Array]:
        """Return motion, couples and torques that enter each joint, and how far orders apart swing these (b, n, p)."""
        cases = self.model.torque.size
        moved = moving(self.model, np.broadcast_to(angle, (cases, *angle.shape)))
        flow = flowing(self.model, moved)[0]
        couple, entering = np.asarray(flow.couple), np.asarray(flow.leaving[..., :-1, :])
        beside = np.zeros_like(entering)
        if all(one is None for one in self.vibrating):
            return moved, couple, entering, beside
        without = entering
        if self.drawn is not self.model:
            other = moving(self.drawn, np.broadcast_to(angle, (cases, *angle.shape)))
            without = np.asarray(flowing(self.drawn, other)[0].leaving[..., :-1, :])
        lean = np.sqrt(1.0 + (np.tan(self.model.chain.joint_angle)[:, None] * np.sin(moved.yoke_rotation)) ** 2)
        more = np.zeros_like(entering)
        for k, one in enumerate(self.vibrating):
            if one is not None:
                more[k] = one.at_joints(angle)[0][0] - without[k]
                beside[k] = one.beside[0][:, None]
        return moved, couple + lean * more, entering + more, beside * lean


def _of_chain(flow: _Flow) -> list[BearingLoads]:
    """Return the loads of cases that share their joint angles, one by one."""
    model, period = flow.model, flow.period
    n, cases = model.chain.joints, model.torque.size
    places = np.ravel(kinks(model.chain)[:, None] + np.pi * np.arange(round(period / np.pi)))
    scale = _largest(flow)
    size = np.where(scale > 0.0, scale, 1.0)
    swung = np.asarray([one is not None for one in flow.vibrating])[:, None]

    def rows(angle: Array) -> Array:
        moved, couple, entering, beside = flow.at(angle)
        load, torque = (_mean_power(one / size[..., None], beside / size[..., None]) for one in (couple, entering))
        mean = entering * moved.shaft_ratio[..., :-1, :]
        # in a joint of another kind no cross swings
        parts = (
            np.nan_to_num(np.abs(moved.cross_driving_rate)) * load,
            np.nan_to_num(np.abs(moved.cross_driven_rate)) * load,
            np.where(swung[..., None], torque, mean),
        )
        return np.concatenate([np.broadcast_to(part, (cases, n, angle.shape[-1])) for part in parts], axis=-2)

    mean = mean_between(rows, places, period=period, rests=RESTS)
    driving, driven, torque = (mean[:, k * n : (k + 1) * n] for k in range(3))
    torque = np.where(swung, size * np.abs(torque) ** (1.0 / POWER), torque)
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


def _inside(flow: _Flow, joints: Sequence[Joint], loads: list[BearingLoads]) -> list[BearingLoads]:
    """Return loads with those of the bearings inside of joints: forces in place of couples over a span of 1 m."""
    chain = flow.model.chain
    own = [i for i, joint in enumerate(joints) if joint.rated and not joint.without(joint.rated)]
    if not own:
        return loads
    turns = round(flow.period / np.pi) / 2.0
    grid = np.arange(round(LOOK * turns) if turns.is_integer() else round(2.0 * LOOK * turns)) * (2.0 * np.pi / LOOK)
    moved, _couple, entering, beside = flow.at(grid)
    angles = chain.joint_angle if chain.laws is None else chain.laws.joint_angle
    step = moved.shaft_ratio[..., 1:, :] / moved.shaft_ratio[..., :-1, :]
    found = {name: np.stack([getattr(one, name) for one in loads]) for name in BearingLoads.__dataclass_fields__}
    for i in own:
        alpha = float(np.asarray(angles)[..., i].flat[0])
        force, damage = bearing_damage(joints[i], alpha)
        places = np.arange(force.size + 1) * (2.0 * np.pi / force.size)
        turn = np.remainder(moved.yoke_rotation[..., i, :], 2.0 * np.pi)
        most, *worn = (np.interp(turn, places, np.append(row, row[0])) for row in (force, *damage))
        torque, swing = (one[..., i, :] / step[..., i, :] for one in (entering, beside))
        found["joint_angle"][:, i] = alpha
        found["couple"][:, i] = np.max(most * (np.abs(torque) + swing), axis=-1)
        carried = _mean_power(torque, swing) * moved.shaft_ratio[..., i, :]
        found["driving"][:, i], found["driven"][:, i] = (np.mean(row * carried, axis=-1) for row in worn)
    return [BearingLoads(**{name: rows[k] for name, rows in found.items()}) for k in range(len(loads))]


def _mean_power(value: Array, beside: Array) -> Array:
    """Return |x|^(10/3) of values, the mean over the phases of what swings out of step about them."""
    if not np.any(beside):
        return np.abs(value) ** POWER
    phases = np.cos(np.pi * (np.arange(PHASES) + 0.5) / PHASES)
    found: Array = np.mean([np.abs(value + swing * beside) ** POWER for swing in phases], axis=0)
    return found


def _largest(flow: _Flow) -> Array:
    """Return the largest couple of each cross, array (b, n) [N·m]: at its kinks or near them, or else on a grid."""
    grid = np.linspace(0.0, flow.period, round(LOOK * flow.period / (2.0 * np.pi)) + 1)
    angle = np.sort(np.concatenate((grid, np.remainder(kinks(flow.model.chain), np.pi))))
    _moved, couple, _entering, beside = flow.at(angle)
    found: Array = np.max(np.abs(couple) + beside, axis=-1)
    return found
