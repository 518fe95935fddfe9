"""Natural modes of a torsional model with all joints straight: frequencies, shapes, damping, what joints do to them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.drive.models.kinematics_model import NEGLIGIBLE
from cardan.maths.arrays import Array, ArrayLike

from .torsional_model import TorsionalModel

STILL = 1e-9
"""Singular values below this share of the largest are those of turning without twist."""

SWINGS = 5.0
"""Damping ratio of the dampers of elements up to which a mode counts: beyond, drag alone says how it comes to rest, as
that of a damper without spring, which only something soft holds in place."""


@dataclass(frozen=True, eq=False, kw_only=True)
class StraightModes:
    """Natural modes of a straight torsional line, the slowest first; turning without twist is left out.

    So is what dampers keep from swinging at all.
    """

    omega: Array  # (m,) [rad/s]
    shape: Array  # (m, N): angles of the stations, u, with Σ J u² = 1 [1/√(kg m²)]
    # (m,): ζ of dampers, structural damping, damping against the housing and machines whose torque changes with the
    # speed
    damping_ratio: Array
    # (m, n): κ of every joint: its u times Σ J u of all stations behind it; 0 in a node of the mode. For two masses it
    # is the κ of Mathieu's reduction.
    joint_weight: Array
    residual: Array  # (m,): what the balance of a mode misses, over its largest torque


def straight_modes(model: TorsionalModel, *, speed: float = 0.0) -> StraightModes:
    """Return the natural modes of a model, all joints straight and all backlash closed.

    model: one drive, without leading axes. Where its input speed is forced, the first station stands still.
    speed [rad/s]: at which torques are asked how they change with the speed.
    K = BᵀB with a row √c (…, 1, -1, …) for each element, so ω are the singular values of B M^(-1/2): they keep their
    digits where stiff elements stand beside soft ones. Coordinates without inertia follow the others statically.
    """
    first = 0 if model.free else 1
    rank = model.coordinates - first
    coordinate = np.asarray(model.coordinate) - first
    mass = np.zeros(rank)
    for r, inertia in zip(coordinate, model.inertia, strict=True):
        if r >= 0:
            mass[r] += inertia
    rows = np.zeros((len(model.elements), rank))
    for e, (a, b) in enumerate(model.elements):
        for station, sign in ((a, 1.0), (b, -1.0)):
            if coordinate[station] >= 0:
                rows[e, coordinate[station]] += sign * np.sqrt(model.stiffness[e])
    omega, vectors = _modes(rows, mass)
    held = np.zeros((len(omega), 1))  # the place of a station whose speed is forced
    shape = np.concatenate([vectors, held], axis=-1)[:, coordinate]
    largest = np.take_along_axis(shape, np.argmax(np.abs(shape), axis=-1)[:, None], axis=-1) if len(shape) else 1.0
    shape = shape * np.sign(largest)
    swings = np.sum(model.damping * _twists(model, shape) ** 2, axis=-1) <= 2.0 * SWINGS * omega
    omega, shape = omega[swings], shape[swings]
    return StraightModes(
        omega=omega,
        shape=shape,
        damping_ratio=_damping(model, omega, shape, speed),
        joint_weight=_weights(model, shape),
        residual=_residual(model, omega, shape),
    )


def _modes(rows: Array, mass: Array) -> tuple[Array, Array]:
    """Return ω (m,) and x (m, R) with x·M x = 1 of x(BᵀB - ω²M) = 0, without those of ω = 0."""
    heavy = mass > 0.0
    light = rows[:, ~heavy]
    own = rows[:, heavy]
    if light.size:
        base, _upper = np.linalg.qr(light)
        inner = own - base @ (base.T @ own)
    else:
        inner = own
    scale = np.sqrt(mass[heavy])
    if not inner.size:
        return np.zeros(0), np.zeros((0, len(mass)))
    _left, omega, right = np.linalg.svd(inner / scale, full_matrices=False)
    kept = omega > STILL * omega[0] if len(omega) and omega[0] > 0.0 else np.zeros(len(omega), dtype=bool)
    omega, right = omega[kept][::-1], right[kept][::-1]
    vectors = np.zeros((len(omega), len(mass)))
    vectors[:, heavy] = right / scale
    if light.size:
        vectors[:, ~heavy] = -np.linalg.lstsq(light, own @ vectors[:, heavy].T, rcond=None)[0].T
    return omega, vectors


def _twists(model: TorsionalModel, shape: Array) -> Array:
    heads, tails = [a for a, _b in model.elements], [b for _a, b in model.elements]
    return shape[:, heads] - shape[:, tails]


def _damping(model: TorsionalModel, omega: Array, shape: Array, speed: float) -> Array:
    """Return ζ of every mode from what a swing loses."""
    twist = _twists(model, shape)
    drag = np.asarray(model.ground_damping, dtype=float).copy()
    for torque in model.torques:
        drag[torque.station] -= float(torque.law.at(np.asarray(0.0), np.asarray(0.0), np.asarray(speed))[2])
    viscous = np.sum(model.damping * twist**2, axis=-1) + np.sum(drag * shape**2, axis=-1)
    return 0.5 * viscous / omega + 0.5 * np.sum(model.loss_factor * model.stiffness * twist**2, axis=-1) / omega**2


def _weights(model: TorsionalModel, shape: Array) -> Array:
    """Return κ of every joint in every mode, array (m, n)."""
    shaft = np.asarray(model.shaft)
    found = np.zeros((len(shape), model.joint_angle.shape[-1]))
    for station, source in enumerate(model.driven):
        if source is not None:
            driving, joint = source
            behind = shaft >= shaft[station]
            found[:, joint] = shape[:, driving] * np.sum((model.inertia * shape)[:, behind], axis=-1)
    return found


def _residual(model: TorsionalModel, omega: Array, shape: Array) -> Array:
    """Return what is left of the balance of every coordinate, over the largest torque of an element."""
    twist = _twists(model, shape)
    torque = model.stiffness * twist
    left = -(omega[:, None] ** 2) * model.inertia * shape
    for e, (a, b) in enumerate(model.elements):
        left[:, a] += torque[:, e]
        left[:, b] -= torque[:, e]
    whole = np.zeros((len(shape), model.coordinates))
    for station, r in enumerate(model.coordinate):
        whole[:, r] += left[:, station]
    forced = 0 if model.free else 1
    largest = np.max(np.abs(torque), axis=-1, initial=0.0)
    return np.max(np.abs(whole[:, forced:]), axis=-1, initial=0.0) / np.where(largest > 0.0, largest, 1.0)


def modulation(model: TorsionalModel, weight: Array, order: float = 2.0) -> Array:
    """Return by which share joints modulate the stiffness of every mode at an order of the turn, complex array (m,).

    weight (m, n): κ of the joints, `StraightModes.joint_weight`; order: ν, 2 of cross joints.
    q/a of Mathieu's equation y'' + (a - 2q cos νφ) y, y'' by νφ/2: ν Σ a_k κ_k e^(iνψ̄_k) with the wave a of each joint,
    see `joint_waves`; τ = tan²(α/2) of a cross at order 2, twice what the book gives, whose joints turn evenly.
    A mode is excited in its principal zone where its modulus exceeds 2ζ.
    """
    if not model.joint_angle.shape[-1]:
        return np.zeros(len(weight), dtype=complex)
    found: Array = order * (weight * joint_waves(model, order)) @ np.exp(1j * order * mean_phases(model))
    return found


def joint_waves(model: TorsionalModel, order: float) -> Array:
    """Return the wave of one order by which each joint of one drive leads, a of Im a e^(iνθ): array (n,) [rad].

    Complex where a joint turns by a law of its own. A cross has τ^p/p at ν = 2p, τ = tan²(α/2).
    """
    tau = np.tan(0.5 * model.joint_angle) ** 2
    half = round(0.5 * order)
    found: Array = tau**half / half if half and order == 2.0 * half else np.zeros_like(tau)
    own, place = model.own_laws, round(order)
    return found if own is None or place >= len(own) else found + 1j * own[place]


def mean_phases(model: TorsionalModel) -> Array:
    """Return ψ̄ of every joint of one drive, its phase less the lead at the start of those before it, (n,) [rad]."""
    lead = np.tan(0.5 * model.joint_angle) ** 2 * np.sin(2.0 * model.phase)
    if model.own_laws is not None:
        order = np.arange(1, len(model.own_laws))[:, None]
        lead = lead + np.sum((model.own_laws[1:] * np.exp(1j * order * model.phase)).real, axis=0)
    found: Array = model.phase - np.append(0.0, np.cumsum(lead)[:-1])
    return found


def joint_orders(model: TorsionalModel) -> tuple[float, ...]:
    """Return the orders of the turn at which joints swing by laws of their own; none where all swing by 2, 4, …."""
    own = model.own_laws
    if own is None:
        return ()
    there = np.any(own != 0.0, axis=(*range(own.ndim - 2), own.ndim - 1))
    return tuple(float(order) for order in np.flatnonzero(there) if order)


def changing_orders(model: TorsionalModel) -> tuple[float, ...]:
    """Return the orders at which joints change the speed, the main one first: 2 of crosses, and those of other laws."""
    main, own = main_order(model), joint_orders(model)
    crosses = (2.0,) if np.any(model.joint_angle > 0.0) else ()
    return (main, *(order for order in dict.fromkeys((*crosses, *own)) if order != main))


def base_order(model: TorsionalModel) -> float:
    """Return the order of which all those of the joints are multiples: 2 of crosses, 3 of a tripod that pivots."""
    own = model.own_laws
    if own is None:
        return 2.0
    size = np.max(np.abs(own), axis=(*range(own.ndim - 2), own.ndim - 1))
    there = [int(order) for order in np.flatnonzero(size > NEGLIGIBLE) if order]
    return float(math.gcd(*there, *([2] if np.any(model.joint_angle > 0.0) else ()))) or 2.0


def main_order(model: TorsionalModel) -> float:
    """Return the order at which the joints change the speed most, all of them together: 2 but for laws of their own."""
    own = model.own_laws
    if own is None:
        return 2.0
    each = np.zeros(max(own.shape[-2], 3))
    each[: own.shape[-2]] = np.max(np.sum(np.abs(own), axis=-1).reshape(-1, own.shape[-2]), axis=0)
    each[2] += np.max(np.sum(np.tan(0.5 * model.joint_angle) ** 2, axis=-1))
    pushing = np.arange(len(each)) * each
    return float(np.argmax(pushing)) if np.any(pushing) else 2.0


def meeting_speeds(model: TorsionalModel, order: float, pendulums: tuple[int, ...], speed: float) -> Array:
    """Return the speeds at which an order of the shaft meets the natural frequencies, rising, array (m,) [rad/s].

    model: one drive, all joints straight; order: swings in one turn of the input shaft, ν.
    pendulums: elements whose stiffness goes with the square of the speed; speed [rad/s]: at which the model is.
    K + Ω²K' of pendulums: K u = Ω² (ν²M - K') u.
    """
    if not pendulums:
        return straight_modes(model).omega / order
    turning = np.zeros(len(model.elements))
    turning[list(pendulums)] = model.stiffness[list(pendulums)] / speed**2
    fixed = np.where(turning > 0.0, 0.0, model.stiffness)
    first = 0 if model.free else 1
    plain, more = (_stiffness(model, one)[first:, first:] for one in (fixed, turning))
    mass = np.zeros(model.coordinates)
    np.add.at(mass, list(model.coordinate), model.inertia)
    values = np.asarray(scipy.linalg.eigvals(plain, order**2 * np.diag(mass[first:]) - more), dtype=complex)
    real = np.isfinite(values) & (np.abs(values.imag) < STILL * np.abs(values)) & (values.real > 0.0)
    squares = sorted(float(one) for one in values.real[real])
    found: Array = np.sqrt([one for one in squares if one > STILL**2 * squares[-1]])
    return found


def _stiffness(model: TorsionalModel, springs: Array) -> Array:
    found = np.zeros((model.coordinates, model.coordinates))
    for (one, two), spring in zip(model.elements, springs, strict=True):
        a, b = model.coordinate[one], model.coordinate[two]
        found[[a, b], [a, b]] += spring
        found[[a, b], [b, a]] -= spring
    return found


# Steady vibration of a torsional line with straight joints under a torque of one frequency: linear, at many speeds.


@dataclass(frozen=True, eq=False, kw_only=True)
class StraightWaves:
    """Vibration x e^(iωt) of a straight line."""

    angle: Array  # (..., N) [rad], complex: of every station
    torque: Array  # (..., E) [N·m], complex: of every element


def straight_waves(model: TorsionalModel, station: int, torque: ArrayLike, omega: ArrayLike) -> StraightWaves:
    """Return how a line vibrates under a harmonic torque on one station, all joints straight and all backlash closed.

    model (...): where its input speed is forced, the first station stands still; station: on which the torque acts.
    torque (...) [N·m], complex: its amplitude and phase; omega (...) [rad/s]: its frequency, not 0.
    Returns StraightWaves: not finite at a natural frequency without damping.
    (K + iωC - ω²M) x = f with complex stiffness c(1 + iη) + iωb of the elements and damping iωb_g against the housing.
    """
    w = np.asarray(omega, dtype=float)[..., None]
    carried = model.stiffness * (1.0 + 1j * model.loss_factor) + 1j * w * model.damping
    own = 1j * w * model.ground_damping - w**2 * model.inertia
    outer = np.broadcast_shapes(carried.shape[:-1], own.shape[:-1], np.shape(torque))
    rank, first = model.coordinates, 0 if model.free else 1
    matrix = np.zeros((*outer, rank, rank), dtype=complex)
    for k, r in enumerate(model.coordinate):
        matrix[..., r, r] += own[..., k]
    for e, (one, two) in enumerate(model.elements):
        a, b = model.coordinate[one], model.coordinate[two]
        for r, s, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            matrix[..., r, s] += sign * carried[..., e]
    load = np.zeros((*outer, rank, 1), dtype=complex)
    load[..., model.coordinate[station], 0] = torque
    moved = np.zeros((*outer, rank), dtype=complex)
    with np.errstate(all="ignore"):
        try:
            moved[..., first:] = np.linalg.solve(matrix[..., first:, first:], load[..., first:, :])[..., 0]
        except np.linalg.LinAlgError:
            moved[..., first:] = np.inf
    angle = moved[..., list(model.coordinate)]
    heads, tails = [a for a, _b in model.elements], [b for _a, b in model.elements]
    return StraightWaves(angle=angle, torque=carried * (angle[..., heads] - angle[..., tails]))
