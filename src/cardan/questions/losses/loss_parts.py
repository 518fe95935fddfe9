"""Which losses of a drive can be counted, from what its file says, and which key the others need."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joints import Joint
from cardan.drive.models.dynamics_model import Train, place_of, train
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.forces.kinetostatics import KinematicState, inner_friction, sprung, standing
from cardan.questions.forces.reactions import (
    Frame,
    Load,
    forces_of,
    frame,
    pushes,
    right_side,
    shoves,
    solved,
    solved_each,
    weights,
)
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.joint_mechanism import check_turning, rubbed_share
from cardan.questions.motion.motion import Motion
from cardan.questions.seals import seal_torques
from cardan.texts import _

from .loss_model import Holding, Model


@dataclass(frozen=True, kw_only=True, slots=True)
class Uncounted:
    """A loss that could not be counted."""

    field: str  # path of the key to add
    message: str  # what is left out and why, in one sentence
    # which kind of part it is the loss of: ``joints``, ``supports`` or ``shafts``
    part: Literal["joints", "supports", "shafts"]
    number: int | None = None  # number of that part, from 1; None where it is all of them
    missing: bool = True  # whether nothing but the key is missing


@dataclass(frozen=True, eq=False, kw_only=True)
class Parts:
    """What of a drive is counted."""

    train: Train  # its machine half; without supports where they cannot be balanced
    rub: Array  # (k,) [m]: μ_b d_b/2 of each support
    seal: Array  # (k,) [N·m]: friction torque of its seals
    grip: Array  # (n+1,) [1/m]: thrust over torque of the spline of each shaft
    slide: Array  # (n+1,) [m/s]: its mean sliding speed


def counted(drive: Drive, duty: Duty) -> tuple[Parts, tuple[Uncounted, ...]]:
    """Return what can be counted, and what cannot; refuse a drive of which nothing can."""
    try:
        machine, short = train(drive, kinds=True), []
    except InputError as error:
        machine, short = (
            train(replace(drive, supports=()), kinds=True),
            [Uncounted(field=p.field, message=p.message, part="supports", missing=False) for p in error.problems],
        )
    rub, supports = _supports(drive, machine, short)
    seal = seal_torques(drive)
    slide, splines = _splines(drive)
    joints = list(_joints(drive))
    grip = np.zeros(len(drive.shafts))
    if machine.grip is not None:
        grip[list(machine.splines)] = machine.grip
    uncounted = (*joints, *supports, *splines)
    problems = []
    if duty.speed is None:
        problems.append(Problem("duty.speed", _("missing; a loss of power needs the input speed"), "missing"))
    elif duty.speed == 0.0:
        problems.append(
            Problem("duty.speed", _("at standstill the sense of friction is open; give the speed of running"))
        )
    if duty.torque is None:
        problems.append(Problem("duty.torque", _("missing; friction grows with the torque"), "missing"))
    if len(joints) == len(drive.joints) and not np.any(rub) and not np.any(seal) and not np.any(grip * slide):
        # what can be added is told; why a kind has none only where nothing can be
        problems += [Problem(one.field, one.message) for one in uncounted if one.missing or one.part == "supports"] or [
            Problem(one.field, one.message, "unknown_kind") for one in uncounted
        ]
    check(problems)
    return Parts(train=machine, rub=rub, seal=seal, grip=grip, slide=slide), uncounted


def _joints(drive: Drive) -> Iterator[Uncounted]:
    """Yield the joints whose friction is not known."""
    for i, joint in enumerate(drive.joints):
        why = joint.refusal("losses")
        if why:
            text = _("the power loss of joint {number} is not counted: {why}")
            message = text.format(number=i + 1, why=why)
            yield Uncounted(field=f"joints[{i}].kind", message=message, part="joints", number=i + 1, missing=False)
            continue
        sizes = joint.without(joint.rubbing)
        if joint.rubbing and joint.friction is not None and not sizes:
            continue
        if joint.rubbing:
            key = "friction" if joint.friction is None else sizes[0]
        elif joint.friction is None and joint.material_friction is None:
            key = "friction"
        elif joint.cross is None or joint.cross.span is None:
            key = "cross.span"
        elif joint.cross.journal is None:
            key = "cross.journal"
        else:
            continue
        text = _("missing; without it the power loss of joint {number} is not counted")
        message = text.format(number=i + 1)
        yield Uncounted(field=f"joints[{i}].{key}", message=message, part="joints", number=i + 1)


def _supports(drive: Drive, machine: Train, short: list[Uncounted]) -> tuple[Array, list[Uncounted]]:
    """Return μ_b d_b/2 of each support, zero where it is not counted, and those that are not."""
    rub = np.asarray([0.5 * (one.friction or 0.0) * (one.bore or 0.0) for one in drive.supports])
    text = _("missing; without it the power loss of support {number} is not counted")
    found = [
        Uncounted(field=f"supports[{k - 1}].friction", message=text.format(number=k), part="supports", number=k)
        for k, one in enumerate(drive.supports, 1)
        if one.friction is None
    ]
    if not drive.supports:
        message = _("missing; without them friction in bearings is not counted")
        found.append(Uncounted(field="supports", message=message, part="supports"))
    if not np.any(rub):
        return rub, found
    if not short:
        why = trouble(machine)
        text = _("{why}; friction in them is not counted")
        message = text.format(why=why)
        short = [Uncounted(field="supports", message=message, part="supports", missing=False)] if why else []
    return (np.zeros_like(rub), [*found, *short]) if short else (rub, found)


def _splines(drive: Drive) -> tuple[Array, list[Uncounted]]:
    """Return the mean sliding speed of every shaft, zero where it is not known, and splines that are not counted."""
    slide, found = np.zeros(len(drive.shafts)), []
    splined = [shaft for shaft in drive.shafts if shaft.spline is not None]
    for shaft in splined:
        if shaft.spline is not None and shaft.spline.friction is None:
            text = _("missing; without it the power loss in the spline of shaft {number} is not counted")
            field, message = f"shafts[{shaft.number - 1}].spline.friction", text.format(number=shaft.number)
            found.append(Uncounted(field=field, message=message, part="shafts", number=shaft.number))
    if not splined or len(found) == len(splined):
        return slide, found
    if not drive.movements:
        message = _("missing; the splines slide only while the drive moves")
        found.append(Uncounted(field="movements", message=message, part="shafts"))
        return slide, found
    moved = articulation(drive)
    lasts = float(moved.times[-1] - moved.times[0])
    for one in moved.splines:
        slide[one.shaft - 1] = one.slip_path / lasts if lasts else 0.0
    return slide, found


def model_of(drive: Drive, duty: Duty, parts: Parts) -> Model:
    """Return what the powers of a drive depend on, at the speed and torque of a duty."""
    n = len(drive.joints)
    none = np.zeros(n + 1)
    machine = parts.train
    drag = np.zeros(n) if machine.drag is None else machine.drag

    def holding(angle: Array) -> Holding:
        return response(machine, drag, angle, many=bool(drive.movements))

    return Model(
        chain=machine.chain,
        drag=drag,
        inertia=none if machine.inertia is None else machine.inertia,
        resisting=none if machine.resisting_torque is None else machine.resisting_torque,
        speed=np.asarray(duty.speed),
        torque=np.asarray(duty.torque),
        acceleration=duty.acceleration,
        torque_at=duty.torque_at,
        harmonics=duty.harmonics,
        torque_scale=duty.torque or 0.0,
        rub=parts.rub,
        seal=parts.seal,
        on=np.asarray([support.shaft - 1 for support in drive.supports], dtype=int),
        holding=holding if np.any(parts.rub) else None,
        grip=parts.grip,
        slide=parts.slide,
        rubbing=rubbing_of(drive.joints, many=bool(drive.movements)),
    )


def rubbing_of(joints: Sequence[Joint], *, many: bool) -> Callable[[Motion], tuple[Array, Array]] | None:
    """Return what joints without a cross rub away, see `Model`; None where none of them does.

    many: whether many joint angles are asked.
    """

    def rubbing(moved: Motion) -> tuple[Array, Array]:
        theta = np.asarray(moved.yoke_rotation)
        found = np.zeros((2, *theta.shape))
        for i, joint in enumerate(joints):
            if joint.rubs:
                alpha = float(np.asarray(moved.joint_angle)[..., i].flat[0])
                share = rubbed_share(joint, alpha, theta[..., i, :], many=many)
                check_turning(f"joints[{i}].friction", joint, alpha, theta[..., i, :], share[0])
                found[:, ..., i, :] = share
        return found[0], found[1]

    return rubbing if any(joint.rubs for joint in joints) else None


# What holds a drive while its journals rub: the forces on its supports, for the friction in them.


def trouble(train: Train) -> str:
    """Return why the forces on the supports are not determinate, in one sentence; empty where they are."""
    held = _held(train, np.zeros(1))[1]
    more = held.unknowns - held.equations
    if more > 0:
        return _("the supports hold the drive {count} times more than balance can tell apart").format(count=more)
    if more < 0:
        return _("the supports leave the drive {count} ways to give").format(count=-more)
    regular = solved(held, np.zeros((1, held.matrix.shape[-2])))[1]
    return "" if bool(np.all(regular)) else _("the supports hold the drive twice one way and not at all another way")


@dataclass(frozen=True, eq=False, kw_only=True)
class Response:
    """Forces on the supports per couple of each cross, at some positions."""

    weight: Array  # (..., p, k, 3) [N]: what weights put on the supports
    pull: Array  # (..., p, n, k, 3) [1/m]: forces per couple T_i of the crosses
    # (..., p, n, k, 3) [1/m]: forces per |T_i| by the friction of the journals, for an input that turns the positive
    # way
    rub: Array

    def load(self, couple: Array, sense: Array) -> Array:
        """Return \\|R_b\\| for couples (..., n, p) and senses (...) of turning, array (..., k, p) [N]."""
        turned = np.moveaxis(couple, -1, -2)[..., None, :]
        way = np.asarray(sense)[..., None, None, None]
        shape = *self.pull.shape[:-2], -1
        both = np.matmul(turned, np.reshape(self.pull, shape)) + way * np.matmul(
            np.abs(turned), np.reshape(self.rub, shape)
        )
        force = np.reshape(both, (*both.shape[:-2], *self.weight.shape[-2:])) + self.weight
        found: Array = np.moveaxis(frames.norm(force), -1, -2)
        return found


def response(train: Train, drag: Array, angle: Array, *, many: bool = False) -> Response:
    """Return the forces on the supports per couple of each cross.

    train: one drive, its supports determinate; drag (n,): κ of each joint; angle (..., p) [rad]: input angles; many:
    whether the same joints are asked at many joint angles.
    The couple T n ∓ κ|T| u ± κ|T| v of every cross bends its two shafts; what its part across them needs, and
    the weights, is in balance with the forces in the joints and supports. That balance is linear, so each part is
    solved for once; what rubs within a joint adds one part by T and one by |T|. Thrust of splines is left out: at rest
    lengthwise they need not push.
    """
    n = train.joints
    stand, held = _held(train, np.reshape(angle, -1))
    e, u, v = stand.axis, stand.driving_arm, stand.driven_arm
    slip = np.sign(frames.dot(u, e[..., 1:, :]))[..., None] * u - np.sign(frames.dot(v, e[..., :-1, :]))[..., None] * v
    normal = np.stack([stand.couple_way(i) for i in range(n)], axis=-2)
    if (
        train.chain.laws is not None
    ):  # those of other kinds count by their part about the driving shaft, see `torque_flow`
        along = frames.dot(normal, e[..., :-1, :])
        normal = normal / np.where(train.chain.laws.own, along, 1.0)[..., None]

    pushed = pushes(train, held, stand)

    def side(across: Array, loads: list[Load], shoved: Sequence[Array]) -> Array:
        return right_side(held, across, loads, np.zeros((*across.shape[:-2], len(train.splines))), shoved)

    def of_joint(i: int, couple: Array, torque: Array, force: Array | None) -> Array:
        """Return the known side for a couple of joint i alone, with the torque and force on its driven shaft."""
        forces = [force if k == i else None for k in range(n)]
        torques = torque[..., None] * (np.arange(n) == i)
        return side(_across(e, couple, i), [], shoves(train, held, stand, torques, forces, pushed))

    pull, rub = [], []
    for i in range(n):
        before, after, own = e[..., i, :], e[..., i + 1, :], normal[..., i, :]
        inside = inner_friction(train, stand, i, many=many)
        if inside is None:
            pull.append(of_joint(i, own, frames.dot(own, after), None))
            rub.append(of_joint(i, -drag[i] * slip[..., i, :], 0.0 * stand.speed[..., i], None))
            continue
        whole = own / frames.dot(own, after)[..., None] + inside.couple
        torque = 1.0 / frames.dot(whole, before)
        both = [torque[..., None] * whole, torque, torque[..., None] * inside.force]
        pull.append(of_joint(i, *(0.5 * (one[0] + one[1]) for one in both)))
        rub.append(of_joint(i, *(0.5 * (one[0] - one[1]) for one in both)))
    still, springs = np.zeros((angle.size, n + 1, 3)), [sprung(train, stand, i) for i in range(n)]
    for i, spring in enumerate(springs):
        if spring is not None:
            still = still + _across(e, spring[0], i)
    forces = [None if spring is None else spring[1] for spring in springs]
    always = shoves(train, held, stand, np.zeros((angle.size, n)), forces, pushed)
    sides = [side(still, weights(train, held, stand, None), always), *pull, *rub]
    found = [forces_of(held, one)[1] for one in solved_each(held, sides)]
    weight, *parts = (np.reshape(one, (*angle.shape, *one.shape[-2:])) for one in found)
    return Response(weight=weight, pull=np.stack(parts[:n], axis=-3), rub=np.stack(parts[n:], axis=-3))


def _held(train: Train, angle: Array) -> tuple[KinematicState, Frame]:
    """Return how the drive stands at input angles (p,), and how it is held."""
    place = place_of(train)
    stand = standing(train.chain, place.axis, place.normal, angle, speed=1.0)
    return stand, frame(train, stand, train.points[None])


def _across(axis: Array, couple: Array, i: int) -> Array:
    """Return what a couple (p, 3) of joint i alone leaves across each shaft, array (p, n+1, 3)."""
    whole = np.zeros((couple.shape[0], axis.shape[-2], 3))
    whole[:, i], whole[:, i + 1] = -couple, couple
    found: Array = whole - frames.dot(whole, axis)[..., None] * axis
    return found
