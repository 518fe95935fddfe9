"""Do the clearances of a drive stay closed over the turn, or does inertia make its joints rattle?"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Harmonic
from cardan.drive.models.dynamics_model import Train, place_of, train
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peak, peaks
from cardan.questions.motion.motion import motion

from .forces import Forces
from .kinetostatics import couples, standing
from .turn_loads import turns

COARSE = 361
"""Positions of a turn from which the least couples are sharpened."""

MANY, FEW = 360, 180
"""Positions of a period at which one drive and each of many are looked at; between them the extremes are found."""


@dataclass(frozen=True, eq=False, kw_only=True)
class GapClosure:
    """Whether the load keeps every joint pressed one way."""

    closed: bool  # whether every joint keeps the sign of its couple over the turn, whichever it is
    least_couple: Array  # (n,) [N·m]: smallest T_i over the turn
    least_angle: Array  # (n,) [rad]: input angle where it occurs
    load_needed: float  # [N·m]: least constant torque at the output that keeps all joints closed
    # (n,): share of the turn in which T_i is against the load: negative, or positive where the load is negative
    open_share: Array
    openings: tuple[Array, ...]  # [rad]: per joint, the input angles in [0, 2π) at which T_i changes its sign, rising


def gap_closure(train: Train, *, load: float, speed: float, acceleration: float = 0.0) -> GapClosure:
    """Return whether the clearances stay closed at a constant load.

    train: one drive with the inertias of its shafts; the inertia of its crosses and friction are left out.
    load [N·m]: torque that resists the output; negative where it resists turning the other way.
    speed, acceleration [rad/s, rad/s²]: ω_1, ε_1.
    Every T_i is linear in the load: T_i = T_i(inertia alone) + load · T_i(load 1 without inertia), so the load needed
    is the largest of -T_i(inertia)/T_i(1) over joints and angles. Book (122), M_2 > J_2 ε_max, is the case of a single
    joint. The inertia of shaft 1 never matters.
    """
    bare = replace(train, cross_inertia=None, drag=None)
    light = replace(bare, inertia=None, resisting_torque=None)
    place = place_of(train)

    def torques(angle: Array) -> tuple[Array, Array]:
        moved = standing(train.chain, place.axis, place.normal, angle, speed=speed, acceleration=acceleration)
        zero = np.zeros(angle.shape)
        heavy, unit = couples(bare, moved, zero), couples(light, moved, zero + 1.0)
        return heavy.driving_torque.T, unit.driving_torque.T

    def least(angle: Array) -> Array:
        heavy, unit = torques(angle)
        return -(heavy + load * unit)

    def against(angle: Array) -> Array:
        return -least(angle) if load < 0.0 else least(angle)

    def need(angle: Array) -> Array:
        heavy, unit = torques(angle)
        return -heavy / unit

    places = np.linspace(0.0, 2.0 * np.pi, COARSE)
    at, most = peaks(least, places, least(places))
    other, lowest = peaks(lambda angle: -least(angle), places, -least(places))
    _where, needs = peaks(need, places, need(places))
    extremes = np.stack((at, other), axis=-1)
    openings = tuple(_crossings(least, np.union1d(places, extremes[k]), k) for k in range(train.joints))
    return GapClosure(
        closed=bool(np.all((most < 0.0) | (lowest < 0.0))),
        least_couple=-most,
        least_angle=at,
        load_needed=float(np.max(needs)),
        open_share=np.asarray([_share(against, angles, k) for k, angles in enumerate(openings)]),
        openings=openings,
    )


def _crossings(function: Callable[[Array], Array], places: Array, k: int) -> Array:
    """Return where curve k changes its sign, by bisection to rounding."""
    values = function(places)[k]
    changes = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0.0)
    low, high = places[changes], places[changes + 1]
    rising = values[changes] < 0.0
    for _round in range(50 if changes.size else 0):
        middle = 0.5 * (low + high)
        before = (function(middle)[k] < 0.0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return 0.5 * (low + high)


def _share(function: Callable[[Array], Array], angles: Array, k: int) -> float:
    """Return the share of the turn in which curve k is positive."""
    edges = np.concatenate(([0.0], angles, [2.0 * np.pi]))
    middle = 0.5 * (edges[:-1] + edges[1:])
    above = function(middle)[k] > 0.0
    return float(np.sum(np.diff(edges)[above]) / (2.0 * np.pi))


def open_share(torque: Array, load: float) -> Array:
    """Return the share of the turn in which each joint is pressed against the load, array (n,).

    torque (n, p) [N·m]: torque of every joint at evenly spaced places of a whole turn, its end beside its beginning or
    not.
    load [N·m]: its sign tells which way the load presses.
    Straight between the places.

    >>> places = np.arange(360) * (2.0 * np.pi / 360)
    >>> open_share(np.stack((1.0 + 0.0 * places, 0.5 + np.cos(places))), 100.0).round(3)
    array([0.   , 0.333])
    """
    press = torque if load >= 0.0 else -torque
    one, other = press, np.roll(press, -1, axis=-1)
    low, high = np.minimum(one, other), np.maximum(one, other)
    span = np.where(high > low, high - low, 1.0)
    share = np.where(high <= 0.0, low < 0.0, np.clip(-low, 0.0, None) / span)
    found: Array = np.mean(share, axis=-1)
    return found


def least_load(
    chain: Chain,
    inertia: Array,
    speed: ArrayLike,
    *,
    torque_at: str = "output",
    harmonics: Sequence[Harmonic] = (),
    scale: ArrayLike = 1.0,
    backwards: bool = False,
) -> Array:
    """Return the least torque at one end that keeps each joint pressed one way over the turn, array (..., n) [N·m].

    chain (..., n): one drive or many; inertia (..., n) [kg m²]: J of shafts 2 … n+1; speed (...) [rad/s]: ω_1, uniform.
    torque_at: ``output`` or ``input``: where the torque is given and constant but for its harmonics.
    harmonics: its swinging parts, which stay while the mean grows; scale (...): by which they count.
    backwards: whether the torque presses the joints the other way.

    By power, P_j = J_j ε_j ω_j over ω_1: behind joint i the torque is (M r_{n+1} + Σ_{j>i} P_j)/r_{i+1} for a torque M
    at the output and (M - Σ_{j≤i} P_j)/r_{i+1} for one at the input, r the speed ratios; both must keep the sign of M.
    Of a single joint that is M_2 > J_2 ε_max, Kozhevnikov & Perfil'ev (1978), eq. 121, 122.
    """
    outer = np.broadcast_shapes(chain.joint_angle.shape[:-1], np.shape(speed), inertia.shape[:-1])
    period = 2.0 * np.pi * turns(harmonics) if harmonics else np.pi
    places = (FEW if math.prod(outer) > 1 else MANY) * (turns(harmonics) if harmonics else 1)
    angle = np.arange(places) * (period / places)
    turned = motion(chain, angle)
    ratio, slope = turned.shaft_ratio[..., 1:, :], turned.shaft_slope[..., 1:, :]
    power = inertia[..., None] * (np.asarray(speed) ** 2)[..., None, None] * ratio * slope
    if torque_at == "output":
        heavy = np.flip(np.cumsum(np.flip(power, axis=-2), axis=-2), axis=-2) / ratio[..., -1:, :]
        at = turned.output_angle
    else:
        before = np.zeros_like(power[..., :1, :])
        heavy = -np.concatenate((before, np.cumsum(power[..., :-1, :], axis=-2)), axis=-2)
        at = angle
    wave = sum((one.torque * np.cos(one.order * at + one.phase) for one in harmonics), np.zeros_like(at))
    found = heavy + (np.asarray(scale)[..., None] * wave)[..., None, :]
    return peak(found if backwards else -found)


@dataclass(frozen=True, eq=False, kw_only=True)
class Gaps:
    """Whether the load of a duty keeps the gaps of a drive closed."""

    open_share: Array  # (n,): share of the turn in which each joint is pressed against the load
    load_needed: float  # [N·m]: least mean torque, where the torque is given, that keeps all joints closed


def gaps(drive: Drive, found: Forces) -> Gaps | None:
    """Return whether the load of a drive keeps its gaps closed; None where no speed or no inertia counts.

    found: of the drive over a whole turn.
    """
    whole, torque = train(drive, kinds=True), drive.duty.torque
    if not drive.duty.speed or not torque or whole.inertia is None:
        return None
    needed = least_load(
        whole.chain,
        whole.inertia[1:],
        drive.duty.speed,
        torque_at=drive.duty.torque_at,
        harmonics=drive.duty.harmonics,
        backwards=torque < 0.0,
    )
    turned = found.angle[-1] - found.angle[0] > 2.0 * np.pi * turns(drive.duty.harmonics) - 1e-9
    press = found.joint_torque[:, :-1] if turned else found.joint_torque
    return Gaps(open_share=open_share(press, torque), load_needed=max(0.0, float(np.max(needed))))
