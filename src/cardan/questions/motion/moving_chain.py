"""How does every shaft turn while the joint centres move?

Frozen formulas ask where the joints are; here it also counts how fast they move. Shaft i turns with the angular
velocity Ω_i = ω_i a_i + a_i × ȧ_i; its *spin* ω_i is the part about its own moving axis, so ∫ω_i dt is its angle in a
frame that follows the axis without twisting.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cardan.drive.joints import Joint
from cardan.drive.models.geometry import STRAIGHT
from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves import paths
from cardan.maths.curves.paths import Jet, Path
from cardan.maths.kernel import frames

chebyshev = later("numpy.polynomial.chebyshev")


@dataclass(frozen=True, eq=False, kw_only=True)
class Shafts:
    """Directions and lengths of the shafts between moving points, with their time derivatives."""

    axis: Array  # axis, axis_rate, axis_acceleration (..., n+1, 3) [-, 1/s, 1/s²]: a_i, ȧ_i, ä_i
    axis_rate: Array  # (..., n+1, 3) [1/s]
    axis_acceleration: Array  # (..., n+1, 3) [1/s²]
    length: Array  # length, length_rate, length_acceleration (..., n+1) [m, m/s, m/s²]: L_i, L̇_i, L̈_i
    length_rate: Array  # (..., n+1) [m/s]
    length_acceleration: Array  # (..., n+1) [m/s²]

    @property
    def joint_angle(self) -> Array:
        """α_i of every joint, array (..., n) [rad]."""
        return frames.angle_between(self.axis[..., :-1, :], self.axis[..., 1:, :])


@dataclass(frozen=True, eq=False, kw_only=True)
class Spins:
    """Exact motion of every shaft of a drive whose axes move; leading axes are those of the instants."""

    spin: Array  # (..., n+1) [rad/s]: ω_i, angular velocity of shaft i about its own axis
    spin_acceleration: Array  # (..., n+1) [rad/s²]: ε_i = dω_i/dt
    frozen_ratio: Array  # (..., n+1): ω_i/ω_1 if the centres stood still where they are
    driving_arm: Array  # (..., n, 3): u_i, cross arm in the driving yoke of joint i
    driven_arm: Array  # (..., n, 3): v_{i+1}, cross arm in the driven yoke, or mark of a joint without a cross
    way: Array  # (..., n, 3): direction of the couple that each joint passes on


def moving_shafts(points: Jet) -> Shafts:
    """Return directions and lengths of the shafts between moving points.

    points (..., n+2, 3) [m, m/s, m/s²]: positions, velocities and accelerations of B_0 … B_{n+1}.
    With Δ = B_i - B_{i-1} = L a: L̇ = a·Δ̇, ȧ = (Δ̇ - L̇ a)/L, L̈ = a·Δ̈ + L |ȧ|², ä = (Δ̈ - L̈ a - 2 L̇ ȧ)/L.
    """
    shaft, rate, acceleration = (part[..., 1:, :] - part[..., :-1, :] for part in points)
    length = frames.norm(shaft)
    a = shaft / length[..., None]
    slide = frames.dot(a, rate)
    swing = (rate - slide[..., None] * a) / length[..., None]
    slide_rate = frames.dot(a, acceleration) + length * frames.dot(swing, swing)
    swing_rate = (acceleration - slide_rate[..., None] * a - 2.0 * slide[..., None] * swing) / length[..., None]
    return Shafts(
        axis=a,
        axis_rate=swing,
        axis_acceleration=swing_rate,
        length=length,
        length_rate=slide,
        length_acceleration=slide_rate,
    )


def moving_axes(
    axes: Jet,
    first_arm: Array,
    *,
    yoke_angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
    kinds: Sequence[Joint] = (),
) -> Spins:
    """Return the exact spin of every shaft of a chain of joints of any kinds whose axes move.

    axes (..., n+1, 3): directions a_i of the shafts and their rates [1/s] and accelerations [1/s²].
    first_arm (..., 3): u_1, direction of the cross arm in the driving yoke of joint 1, at right angles to a_1.
    yoke_angle (..., n-1) [rad]: γ_2 … γ_n, from the driving to the driven yoke of a shaft.
    speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1 at these instants.
    kinds: the joints; crosses of Hooke joints when empty.

    The cross is rigid: the arms u_i and v_{i+1} stay at right angles, so with n = u_i × v_{i+1} the difference
    Ω_{i+1} - Ω_i has no part along n, which gives ω_{i+1}; its time derivative gives ε_{i+1}. Positions need u_1 and
    the axes at the instant alone, nothing is integrated; straight joints need no special case. Contains Book (97)-(99).
    An even joint holds the shafts against turning about n = a_i + a_{i+1} and carries its mark by the shortest turn
    from one axis to the other. Any other joint that turns by φ' = f(φ, α) holds them about the direction n of the
    couple that works on no motion it allows, `held_about`; the rate of that n is a central difference.
    """
    a, rate, curve = axes
    xp = namespace(a)
    gamma = real(yoke_angle, xp)
    u = first_arm
    one = xp.ones_like(frames.dot(u, u) + a[..., 0, 0])
    spin, gain = real(speed, xp) * one, real(acceleration, xp) * one
    ratio = one
    spins, gains, ratios = [spin], [gain], [ratio]
    driving: list[Array] = []
    driven: list[Array] = []
    ways: list[Array] = []
    tilt = frames.cross(a, rate)
    tilt_rate = frames.cross(a, curve)
    for i in range(a.shape[-2] - 1):
        here, there = a[..., i, :], a[..., i + 1, :]
        if i:
            u = frames.rotate(driven[-1], here, -gamma[..., i - 1])
        kind = kinds[i] if kinds else None
        even, cross = kind is not None and kind.even, kind is None or kind.single_cross
        v = _driven(u, here, there, even=even)
        n = here + there if even else frames.cross(u, v)
        if kind is not None and not even and not cross:
            n, v = held_about(kind, u, here, there)
        into, out = frames.dot(here, n), frames.dot(there, n)
        next_spin = (spin * into + frames.dot(tilt[..., i, :] - tilt[..., i + 1, :], n)) / out
        turn = spin[..., None] * here + tilt[..., i, :]
        next_turn = next_spin[..., None] * there + tilt[..., i + 1, :]
        if even:
            n_rate = rate[..., i, :] + rate[..., i + 1, :]
        elif kind is not None and not cross:
            moved = u, frames.cross(turn, u), here, rate[..., i, :], there, rate[..., i + 1, :]
            n_rate = _held_rate(kind, moved)
        else:
            n_rate = frames.cross(frames.cross(turn, u), v) + frames.cross(u, frames.cross(next_turn, v))
        swept = spin[..., None] * rate[..., i, :] - next_spin[..., None] * rate[..., i + 1, :]
        known = swept + tilt_rate[..., i, :] - tilt_rate[..., i + 1, :]
        gain = (gain * into + frames.dot(known, n) + frames.dot(n_rate, turn - next_turn)) / out
        spin, ratio = next_spin, ratio * into / out
        spins.append(spin)
        gains.append(gain)
        ratios.append(ratio)
        driving.append(xp.broadcast_to(u, (*one.shape, 3)))
        driven.append(v)
        ways.append(xp.broadcast_to(frames.unit(n), (*one.shape, 3)))
    return Spins(
        spin=xp.stack(spins, axis=-1),
        spin_acceleration=xp.stack(gains, axis=-1),
        frozen_ratio=xp.stack(ratios, axis=-1),
        driving_arm=xp.stack(driving, axis=-2),
        driven_arm=xp.stack(driven, axis=-2),
        way=xp.stack(ways, axis=-2),
    )


def _driven(arm: Array, before: Array, after: Array, *, even: bool) -> Array:
    """Return the driven arm of a cross, or the mark of an even joint after the shortest turn between its axes."""
    if not even:
        return frames.unit(frames.cross(after, arm))
    share = frames.dot(arm, after) / (1.0 + frames.dot(before, after))
    return arm - share[..., None] * (before + after)


SMALL = 1e-4
"""Turn [rad] over which the rate of a couple's direction is taken: a central difference, right to some 1e-8."""

BEND = 1e-5
"""Step [rad] of the joint angle in the difference quotient of a law."""

FEW = 4
"""Joint angles that a law without a map is asked for one by one; more of them by its waves."""

PLACES, NODES, LEAST = 256, 24, 1e-15
"""Angles and joint angles at which the waves of a law are taken; an amplitude [rad] below the last is rounding."""

ROUNDED = 0.05
"""Step [rad] to which the largest joint angle is rounded up, so that waves are used again."""

BENT = 1e-7
"""Sine of the joint angle below which a joint passes on its turn as a straight one."""


def held_about(kind: Joint, mark: Array, before: Array, after: Array) -> tuple[Array, Array]:
    """Return about which direction a joint holds its shafts together, and where its driven mark stands.

    mark (..., 3): its driving mark; before, after (..., 3): directions of its shafts.
    Returns n, v (..., 3): with N = unit(e × e'), i = f_φ: n = e + (1 - i cos α)/(i sin α) N × e - (f_α/i) N, at right
    angles to all that φ' = f(φ, α) lets the shafts turn against each other: i e' - e and N + f_α e'.
    """
    normal, aside, theta, alpha = seen(mark, before, after)
    beyond, bent = frames.cross(normal, after), np.sin(alpha)
    lead, ratio = (np.asarray(one) for one in law(kind, theta, alpha)[:2])
    low, high = np.maximum(alpha - BEND, 0.0), alpha + BEND
    swept = (law(kind, theta, high)[0] - law(kind, theta, low)[0]) / (high - low) / ratio
    lean = np.tan(0.5 * alpha) - np.where(bent > BENT, (ratio - 1.0) / (ratio * np.where(bent > BENT, bent, 1.0)), 0.0)
    turned = theta + lead + (0.5 * np.pi if kind.crossed else 0.0)
    mark = np.cos(turned)[..., None] * beyond + np.sin(turned)[..., None] * normal
    return before + lean[..., None] * aside - swept[..., None] * normal, mark


def seen(mark: Array, before: Array, after: Array, plane: Array | None = None) -> tuple[Array, Array, Array, Array]:
    """Return how a joint sees its driving mark.

    mark, before, after (..., 3): the mark, and directions of both shafts; plane (..., 3): normal of the plane of a
    straight joint, any where it is not given.
    Returns N, N × e (..., 3), θ, α (...) [rad].
    """
    across = frames.cross(before, after)
    bent = frames.norm(across)
    plain = frames.perpendicular(before) if plane is None else plane
    normal = np.where((bent > BENT)[..., None], across / np.where(bent > BENT, bent, 1.0)[..., None], plain)
    normal = frames.unit(normal - frames.dot(normal, before)[..., None] * before)
    aside = frames.cross(normal, before)
    theta = np.arctan2(frames.dot(mark, normal), frames.dot(mark, aside))
    return normal, aside, theta, np.arctan2(bent, frames.dot(before, after))


def law(kind: Joint, theta: Array, alpha: Array) -> tuple[Array, Array]:
    """Return how far a joint leads and its ratio, for any angles (...) and joint angles (...)."""
    shape = np.broadcast_shapes(np.shape(theta), np.shape(alpha))
    if kind.has_map:
        return kind.deviation(np.broadcast_to(theta, shape), np.broadcast_to(alpha, shape))[:2]
    each, where = np.unique(alpha, return_inverse=True)
    if len(each) <= FEW:  # a law without a map takes one joint angle at a time
        theta, alpha = np.broadcast_to(theta, shape), np.broadcast_to(alpha, shape)
        found = np.empty((2, *shape))
        for one in each:
            found[:, alpha == one] = kind.deviation(theta[alpha == one], one)[:2]
        return found[0], found[1]
    high = float(np.ceil(each[-1] / ROUNDED) * ROUNDED)
    orders, waves = law_waves(kind, high)
    own = chebyshev().chebvander(2.0 * each / high - 1.0, len(waves) - 1) @ waves
    part = own[np.reshape(where, np.shape(alpha))]
    turn = part * np.exp(1j * np.asarray(theta)[..., None] * orders)
    return np.sum(turn, axis=-1).real, 1.0 + np.sum(1j * orders * turn, axis=-1).real


@lru_cache(maxsize=64)
def law_waves(kind: Joint, high: float) -> tuple[Array, Array]:
    """Return a law without a map as waves of its angle, for joint angles from 0 to ``high`` [rad].

    Returns orders (k,), and the coefficients of Chebyshev's polynomials for the complex amplitude of each (m, k) [rad].
    """
    nodes = chebyshev().chebpts1(NODES)
    theta = np.arange(PLACES) * (2.0 * np.pi / PLACES)
    with np.errstate(invalid="ignore", divide="ignore"):
        rows = np.stack([kind.deviation(theta, np.asarray(0.5 * high * (1.0 + one)))[0] for one in nodes])
    wave = np.fft.rfft(rows, axis=-1)[:, : PLACES // 2] / PLACES
    wave[:, 1:] *= 2.0
    orders = np.flatnonzero(~(np.max(np.abs(wave), axis=0) < LEAST))
    fit = np.linalg.inv(chebyshev().chebvander(nodes, NODES - 1))
    return orders, fit @ wave[:, orders]


def _held_rate(kind: Joint, moved: tuple[Array, ...]) -> Array:
    """Return the rate of `held_about`, from mark and directions of both shafts, each with its rate."""
    mark, mark_rate, before, before_rate, after, after_rate = moved
    pace = frames.norm(mark_rate) + frames.norm(before_rate) + frames.norm(after_rate)
    step = (SMALL / np.where(pace > 0.0, pace, 1.0))[..., None]
    ends = []
    for sign in (1.0, -1.0):
        here, there = frames.unit(before + sign * step * before_rate), frames.unit(after + sign * step * after_rate)
        turned = mark + sign * step * mark_rate
        turned = frames.unit(turned - frames.dot(turned, here)[..., None] * here)
        ends.append(held_about(kind, turned, here, there)[0])
    found: Array = (ends[0] - ends[1]) / (2.0 * step)
    return found


@dataclass(frozen=True, eq=False, kw_only=True)
class MovingMotion:
    """Motion of a drive over given instants of a movement."""

    times: Array  # (t,) [s]: instants
    points: Jet  # (t, n+2, 3) [m, m/s, m/s²]: B_0 … B_{n+1}, their velocities and accelerations
    shafts: Shafts  # directions and lengths
    spins: Spins  # spin of every shaft and the cross arms

    @property
    def axes(self) -> Jet:
        """a_i, ȧ_i, ä_i."""
        return self.shafts.axis, self.shafts.axis_rate, self.shafts.axis_acceleration


def moving_centres(
    path: Path,
    times: ArrayLike,
    *,
    yoke_angle: ArrayLike,
    speed: float,
    acceleration: float = 0.0,
    start_phase: float = 0.0,
    start: float = 0.0,
    normal: ArrayLike | None = None,
    kinds: Sequence[Joint] = (),
) -> MovingMotion:
    """Return the exact motion of a drive through moving points.

    path: times (t,) [s] -> Jet of the points (t, n+2, 3): positions [m], velocities, accelerations; times (t,) [s].
    yoke_angle (n-1,) [rad]: γ_2 … γ_n.
    speed, acceleration [rad/s, rad/s²]: spin ω_1 of the input shaft at `start`, and its constant acceleration ε_1.
    start_phase [rad]: ψ_1: angle of the driving yoke of joint 1 from the plane of that joint at `start`.
    start [s]: instant at which φ_1 = 0.
    normal (3,): normal of the plane of joint 1 to use where that joint is straight at `start`.
    kinds: the joints; crosses of Hooke joints when empty.

    θ_1 = ψ_1 + φ_1 counts from N × a_1 with N = unit(a_1 × a_2) at `start`. If a_1 itself moves, that direction is
    carried along without twisting, so that ω_1 is the spin; a machine body that carries the input shaft and itself
    turns with Ω_b adds Ω_b·a_1 to the speed measured against the body.
    """
    at = np.atleast_1d(np.asarray(times, dtype=float))
    points = path(at)
    shafts = moving_shafts(points)
    arm = _first_arm(path, at, shafts.axis[..., 0, :], start_phase, speed, acceleration, start, normal)
    spins = moving_axes(
        (shafts.axis, shafts.axis_rate, shafts.axis_acceleration),
        arm,
        yoke_angle=yoke_angle,
        speed=speed + acceleration * (at - start),
        acceleration=acceleration,
        kinds=kinds,
    )
    return MovingMotion(times=at, points=points, shafts=shafts, spins=spins)


def _first_arm(
    path: Path,
    at: Array,
    axis: Array,
    start_phase: float,
    speed: float,
    acceleration: float,
    start: float,
    normal: ArrayLike | None,
) -> Array:
    """Return u_1 (t, 3): the start direction carried along a_1 without twisting and turned by φ_1."""
    begin = moving_shafts(path(np.asarray([float(start)])))
    a, b = begin.axis[0, 0], begin.axis[0, 1]
    across = frames.cross(a, b)
    if frames.norm(across) <= STRAIGHT:
        kept = None if normal is None else np.asarray(normal, dtype=float)
        across = frames.perpendicular(a) if kept is None else kept - frames.dot(kept, a) * a
    zero = frames.cross(frames.unit(across), a)

    def direction(times: Array) -> tuple[Array, Array]:
        moved = moving_shafts(path(times))
        return moved.axis[..., 0, :], moved.axis_rate[..., 0, :]

    elapsed = at - start
    turned = start_phase + speed * elapsed + 0.5 * acceleration * elapsed**2
    carried = paths.shortest_arc(a, axis, zero)
    return frames.rotate(carried, axis, turned - paths.transport(direction, at, start))


def harmonic_points(points: ArrayLike, amplitude: ArrayLike, *, frequency: float, phase: ArrayLike = 0.0) -> Path:
    """Return the path of points that each swing along a line: P_k(t) = P_k + A_k sin(W t + phase_k).

    points (k, 3) [m]: middle positions; amplitude (k, 3) [m]; frequency [rad/s]: W; phase (k,) [rad].
    """
    rest = np.asarray(points, dtype=float)
    size = np.asarray(amplitude, dtype=float)
    shift = np.broadcast_to(np.asarray(phase, dtype=float), rest.shape[:-1])[..., None]

    def path(times: Array) -> Jet:
        return paths.plus(paths.resting(rest), paths.swing(size, frequency, np.broadcast_to(shift, rest.shape), times))

    return path
