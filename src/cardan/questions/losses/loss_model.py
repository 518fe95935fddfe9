"""Powers of one drive at many speeds and torques: what enters, what leaves, what every part takes, over its turns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from typing import Protocol

import numpy as np

from cardan.drive.duty import Harmonic
from cardan.drive.models.kinematics_model import Chain
from cardan.formulas.friction import swings
from cardan.maths.arrays import Array, ArrayLike, namespace
from cardan.maths.curves.cycle_statistics import RESTS, mean_between
from cardan.questions.motion.motion import Motion, motion

from .chain_friction import kinks

LONGEST = 12
"""Turns over which torques that swing out of step with the turning are averaged at most."""

LOOK = 180
"""Places a turn at which the sign of the torques is looked up, to find where they turn about."""

HALVINGS = 46
"""Bisections of a degree or two: down to rounding."""

ROUNDS = 12
"""Rounds between the forces on the supports and the torques at most."""

SETTLED = 1e-13
"""Relative change of the friction in the supports at which the rounds end."""

HELD = 1e-5
"""As `RESTS` where supports rub: forces on them come near zero within a turn, and their heat is a small part."""


class Holding(Protocol):
    """How the supports answer to the couples of the crosses, at some positions."""

    def load(self, couple: Array, sense: Array) -> Array:
        """Return the forces on them for couples (..., n, p) and senses (...) of turning, array (..., k, p) [N]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Model:
    """What the powers of a drive depend on; speed and torque with any leading axes, the rest of one drive."""

    chain: Chain  # kinematics
    drag: Array  # (n,): κ of each joint; zero where it is not known
    inertia: Array  # inertia, resisting (n+1,) [kg m², N·m]: J_i and L_i
    resisting: Array  # (n+1,) [N·m]
    speed: Array  # speed, torque (...) [rad/s, N·m]: ω_1 and the mean of the torque
    torque: Array  # (...) [N·m]
    acceleration: float = 0.0  # [rad/s²]: ε_1
    torque_at: str = "output"  # ``output`` or ``input``
    harmonics: tuple[Harmonic, ...] = ()  # swinging parts of the torque, for a mean of ``torque_scale``
    torque_scale: float = 0.0  # [N·m]: torque to which the harmonics belong; zero when they do not grow with it
    rub: Array  # (k,) [m]: μ_b d_b/2 of each support
    on: Array  # (k,) of int: shaft of each support, counted from 0
    seal: Array  # (k,) [N·m]: friction torque of the seals of each support
    # from input angles (..., p) to how the supports answer there; None when none of them rubs
    holding: Callable[[Array], Holding] | None = None
    grip: Array  # grip, slide (n+1,) [1/m, m/s]: 2 μ/D and the mean sliding speed of the spline of each shaft
    slide: Array  # (n+1,) [m/s]
    # from the motion to what joints without a cross rub away over the power of their driving shafts (..., n, p), while
    # power flows forwards and backwards; None where none does
    rubbing: Callable[[Motion], tuple[Array, Array]] | None = None

    @property
    def halves(self) -> int:
        """After how many half turns of the input everything repeats: crosses stand alike after one."""
        if not self.harmonics:
            return 1 if self.rubbing is None else 2
        steps = [Fraction(one.order).limit_denominator(LONGEST).denominator for one in self.harmonics]
        return 2 * min(lcm(*steps), LONGEST)


@dataclass(frozen=True, eq=False, kw_only=True)
class Powers:
    """Powers [W]; over positions with a last axis (p,), as means without it."""

    # input, output (...): enters the input shaft, leaves the output shaft; negative where it goes the other way
    input: Array
    output: Array  # (...)
    input_torque: Array  # input_torque, output_torque (...) [N·m]: torques at the two ends
    output_torque: Array  # (...) [N·m]
    driving: Array  # driving, driven (..., n): rubbed away in the journals of the driving and of the driven yokes
    driven: Array  # (..., n)
    supports: Array  # (..., k): rubbed away in the bearings of the supports
    seals: Array  # (..., k): rubbed away under their seals
    splines: Array  # (..., n+1): rubbed away in the splines; it comes from what moves the drive, not from its turning
    resisting: Array  # resisting, storing (..., n+1): taken by resisting torques, and by inertia
    storing: Array  # (..., n+1)


ENDS = ("input", "output", "input_torque", "output_torque")
"""Fields of `Powers` that have no axis of parts."""


def moving(model: Model, angle: Array) -> Motion:
    """Return the motion at input angles (..., p), each case with its own."""
    flat = motion(model.chain, np.reshape(angle, -1))

    def spread(rows: Array) -> Array:
        return np.moveaxis(np.reshape(rows, (rows.shape[0], *angle.shape)), 0, -2)

    names = ("shaft_angle", "shaft_ratio", "shaft_slope", "yoke_rotation")
    return replace(flat, angle=angle, **{name: spread(getattr(flat, name)) for name in names})


def flowing(model: Model, moved: Motion) -> tuple[TorqueFlow, Array]:
    """Return the torques of all cases at their positions, and what the bearings of the supports rub (..., k, p) [N·m].

    The forces on the supports come from the torques and these from the friction in the supports: begun without it, the
    round is gone until it rests; each round gains the digits of one coefficient of friction.
    """
    omega = np.asarray(model.speed)[..., None, None]
    speeding = model.acceleration * moved.shaft_ratio + omega**2 * moved.shaft_slope
    ways = (model.on == np.arange(model.inertia.size)[:, None]).astype(float)
    own = model.resisting[:, None] + model.inertia[:, None] * speeding
    own = own + np.sign(omega) * np.matmul(ways, model.seal)[:, None]
    load = _load(model, moved)

    def flow(drawn: Array) -> TorqueFlow:
        return torque_flow(moved, model.drag, load, drawn=drawn, sense=sense, torque_at=model.torque_at, rubbed=rubbed)

    sense = np.sign(np.asarray(model.speed))
    rubbed = None if model.rubbing is None else model.rubbing(moved)
    found = flow(own)
    rubbing = np.zeros((*found.entering.shape[:-2], model.rub.size, found.entering.shape[-1]))
    if model.holding is None:
        return found, rubbing
    held = model.holding(moved.angle)
    for _round in range(ROUNDS):
        before, rubbing = rubbing, model.rub[:, None] * held.load(found.couple, sense)
        found = flow(own + np.sign(omega) * np.matmul(ways, rubbing))
        if not np.any(np.abs(rubbing - before) > SETTLED * np.max(rubbing, initial=0.0)):
            break
    return found, rubbing


def _load(model: Model, moved: Motion) -> Array:
    """Return the torque at its end over the positions, array (..., p) [N·m]."""
    end = moved.shaft_angle[..., -1 if model.torque_at == "output" else 0, :]
    mean = np.asarray(model.torque)[..., None]
    swing = sum(one.torque * np.cos(one.order * end + one.phase) for one in model.harmonics)
    grown = mean / model.torque_scale if model.torque_scale else 1.0
    return mean + grown * swing + 0.0 * end


def powers(model: Model, angle: Array) -> Powers:
    """Return the powers of all cases at positions (..., p)."""
    moved = moving(model, angle)
    flow, rubbing = flowing(model, moved)
    omega = np.asarray(model.speed)[..., None, None]
    speed = omega * moved.shaft_ratio
    speeding = model.acceleration * moved.shaft_ratio + omega**2 * moved.shaft_slope
    between = 0.5 * (np.abs(flow.entering) + np.abs(flow.leaving))
    return Powers(
        input=flow.entering[..., 0, :] * speed[..., 0, :],
        output=flow.leaving[..., -1, :] * speed[..., -1, :],
        input_torque=flow.entering[..., 0, :],
        output_torque=flow.leaving[..., -1, :],
        driving=np.abs(omega) * flow.driving_loss,
        driven=np.abs(omega) * flow.driven_loss,
        supports=rubbing * np.abs(speed[..., model.on, :]),
        seals=model.seal[:, None] * np.abs(speed[..., model.on, :]),
        splines=(model.grip * model.slide)[:, None] * between,
        resisting=model.resisting[:, None] * speed,
        storing=model.inertia[:, None] * speeding * speed,
    )


def mean_powers(model: Model) -> Powers:
    """Return the means of the powers over the turns after which everything repeats.

    Integrated between the angles at which a cross stops in a yoke or a torque turns about; there friction jumps.
    """
    count = model.halves
    period = count * np.pi
    outer = np.broadcast_shapes(np.shape(model.speed), np.shape(model.torque))
    places = np.ravel(kinks(model.chain)[:, None] + np.pi * np.arange(count))
    turning = (
        _reversals(model, outer, period)
        if model.harmonics or any(map(np.any, (model.inertia, model.resisting, model.seal)))
        else None
    )
    if turning is not None:
        places = np.concatenate((np.broadcast_to(places, (*outer, places.size)), turning), axis=-1)
    names = tuple(Powers.__dataclass_fields__)
    widths: list[int] = []

    def rows(angle: Array) -> Array:
        found = powers(model, angle)
        parts = [getattr(found, name) for name in names]
        parts = [part[..., None, :] if name in ENDS else part for name, part in zip(names, parts, strict=True)]
        widths[:] = [part.shape[-2] for part in parts]
        return np.concatenate([np.broadcast_to(part, (*outer, *part.shape[-2:])) for part in parts], axis=-2)

    rests = RESTS if model.holding is None else HELD
    mean = mean_between(rows, places, period=period, rests=rests)
    parts = np.split(mean, np.cumsum(widths)[:-1], axis=-1)
    whole = {name: part[..., 0] if name in ENDS else part for name, part in zip(names, parts, strict=True)}
    return Powers(**whole)


def _reversals(model: Model, outer: tuple[int, ...], period: float) -> Array | None:
    """Return where the couple of any joint passes through zero, array (..., m), padded with zeros; None if nowhere."""
    grid = np.linspace(0.0, period, round(LOOK * period / np.pi) + 1)

    def couple(angle: Array) -> Array:
        without = replace(model, holding=None)
        found = flowing(without, moving(model, angle))[0].couple
        return np.broadcast_to(found, (*outer, *found.shape[-2:]))

    value = couple(grid)
    passed = np.reshape(value[..., :-1] * value[..., 1:] < 0.0, (*outer, -1))
    most = int(np.max(np.sum(passed, axis=-1), initial=0))
    if not most:
        return None
    order = np.argsort(~passed, axis=-1, kind="stable")[..., :most]
    real = np.take_along_axis(passed, order, axis=-1)
    joint, cell = np.divmod(order, grid.size - 1)
    low, high = grid[cell], grid[cell + 1]
    start = np.take_along_axis(np.reshape(value[..., :-1], (*outer, -1)), order, axis=-1)
    for _half in range(HALVINGS):
        middle = 0.5 * (low + high)
        now = np.take_along_axis(couple(middle), joint[..., None, :], axis=-2)[..., 0, :]
        same = now * start > 0.0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    found: Array = np.where(real, 0.5 * (low + high), 0.0)
    return found


# Which torque passes each joint and shaft, friction in the journals counted? Pure arrays, in batches.


@dataclass(frozen=True, eq=False, kw_only=True)
class TorqueFlow:
    """Torques and powers of a drive over some positions; leading axes are those of the cases."""

    entering: Array  # (..., n+1, p) [N·m]: τ_i, torque that enters each shaft at its beginning
    # (..., n+1, p) [N·m]: torque that leaves it at its end; that of the output shaft is what the load gets
    leaving: Array
    couple: Array  # (..., n, p) [N·m]: T_i, couple of each cross about its own normal
    # driving_loss, driven_loss (..., n, p): power rubbed away in the journals of the driving and of the driven yoke,
    # per input speed [N·m]
    driving_loss: Array
    driven_loss: Array  # (..., n, p)


def torque_flow(
    moved: Motion,
    drag: Array,
    torque: Array,
    *,
    drawn: Array | None = None,
    sense: ArrayLike = 1.0,
    torque_at: str = "output",
    rubbed: tuple[Array, Array] | None = None,
) -> TorqueFlow:
    """Return the torque that passes each joint and shaft, friction of the journals acting on itself.

    moved: motion of the drive at positions (p,), of one drive (n, p) or of many (..., n, p).
    drag (..., n): κ_i = μ d_c/d of each joint, κ tan α < 1.
    torque (..., p) [N·m]: torque of the load at the output, positive when it resists positive turning, or driving
    torque at the input.
    drawn (..., n+1, p) [N·m]: what each shaft takes for itself: inertia, resisting torques, friction of its bearings.
    sense (...): 1 or -1: sign of the input speed; torque_at: where ``torque`` is given, ``output`` or ``input``.
    rubbed, two arrays (..., n, p): what joints without a cross rub away, see `Model`.

    The cross gives its driven yoke the couple K = T n - κ|T| sgn(p) u + κ|T| sgn(q̇) v, whose parts about
    the two shafts are T cos θ_1 (1 ± κ tan θ_1) and T cos θ_2 (1 ∓ κ tan θ_2), upper signs where power flows
    forwards; from the end where the torque is given to the other, joint by joint.
    """
    xp = namespace(moved.joint_angle, drag, torque)
    lean_driving, lean_driven = swings(
        xp.sin(moved.yoke_rotation), xp.cos(moved.yoke_rotation), moved.joint_angle[..., None]
    )
    cos_driving, cos_driven = (1.0 / xp.sqrt(1.0 + lean * lean) for lean in (lean_driving, lean_driven))
    if moved.crossed and not all(moved.crossed):  # couples of other kinds count by their part about the driving shaft
        cross = xp.asarray(moved.crossed)[:, None]
        step = moved.shaft_ratio[..., 1:, :] / moved.shaft_ratio[..., :-1, :]
        cos_driving, cos_driven = xp.where(cross, cos_driving, 1.0), xp.where(cross, cos_driven, 1.0 / step)
    driving, driven = drag[..., None] * lean_driving, drag[..., None] * lean_driven
    way = sense if isinstance(sense, float | int) else xp.asarray(sense)[..., None]
    own = xp.zeros_like(moved.shaft_ratio) if drawn is None else drawn
    n = moved.yoke_rotation.shape[-2]
    shares: dict[int, Array] = {}

    def lost(i: int, flow: Array) -> Array:
        """Return by which share friction on the driven side of joint i lessens or raises its torque."""
        shares[i] = driven[..., i, :]
        if rubbed is not None:
            shares[i] = shares[i] + xp.where(flow < 0.0, rubbed[1][..., i, :], rubbed[0][..., i, :])
        return shares[i]

    entering, leaving, couples = [], [], []
    if torque_at == "output":
        leaving.append(torque)
        for i in range(n, -1, -1):
            entering.append(leaving[-1] + own[..., i, :])
            if i:
                flow = way * xp.sign(entering[-1])
                couple = entering[-1] / (cos_driven[..., i - 1, :] * (1.0 - flow * lost(i - 1, flow)))
                couples.append(couple)
                leaving.append(couple * cos_driving[..., i - 1, :] * (1.0 + flow * driving[..., i - 1, :]))
        entering, leaving, couples = entering[::-1], leaving[::-1], couples[::-1]
    else:
        entering.append(torque)
        for i in range(n + 1):
            leaving.append(entering[-1] - own[..., i, :])
            if i < n:
                flow = way * xp.sign(leaving[-1])
                couple = leaving[-1] / (cos_driving[..., i, :] * (1.0 + flow * driving[..., i, :]))
                couples.append(couple)
                entering.append(couple * cos_driven[..., i, :] * (1.0 - flow * lost(i, flow)))
    cross = _stacked(couples, xp)
    load = xp.abs(cross)
    return TorqueFlow(
        entering=_stacked(entering, xp),
        leaving=_stacked(leaving, xp),
        couple=cross,
        driving_loss=load * cos_driven * _stacked([shares[i] for i in range(n)], xp) * moved.shaft_ratio[..., 1:, :],
        driven_loss=load * cos_driving * driving * moved.shaft_ratio[..., :-1, :],
    )


def _stacked(rows: list[Array], xp: object) -> Array:
    return xp.stack(xp.broadcast_arrays(*rows), axis=-2)  # type: ignore[attr-defined]
