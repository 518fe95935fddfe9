"""What a moving drive is like at any instants: the one place where movement, frozen geometry and exact spins meet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.models.geometry import Geometry, geometry_from_points, polyline
from cardan.drive.models.kinematics_model import Chain, turning, unmapped
from cardan.drive.models.wobble import course, wobbling
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.extremes import peak
from cardan.maths.curves.paths import Jet, Path
from cardan.maths.kernel import frames
from cardan.texts import _

from .equivalence import equivalent_joint
from .moving_chain import MovingMotion, Shafts, Spins, moving_axes, moving_centres, moving_shafts


class Position(IntEnum):
    """What a drive is like at one instant."""

    FINE = 0
    STEEP = 1
    """A joint bends more than 45°; the numbers hold, but no real cross joint works there."""
    IMPOSSIBLE = 2
    """A joint bends 90° or more, or two centres meet; the numbers of this instant are nan."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Instants:
    """Everything known at some instants of a movement; nan where impossible. See `Articulation` for the fields."""

    times: Array
    points: Array
    shafts: Shafts
    joint_angle: Array
    plane_twist: Array
    shaft_speed_fluctuation: Array
    shaft_speed: Array | None
    shaft_acceleration: Array | None
    speed_range: tuple[Array, Array] | None
    acceleration_range: tuple[Array, Array] | None
    status: Array

    @property
    def unevenness(self) -> Array:
        """(ω_max - ω_min)/\\|ω_1\\| of the output over all yoke positions, array (t,)."""
        low, high = self._outputs
        return high - low

    @property
    def speed_error(self) -> Array:
        """Largest \\|ω_out/ω_1 - 1\\| over all yoke positions, array (t,)."""
        low, high = self._outputs
        result: Array = np.maximum(high - 1.0, 1.0 - low)
        return result

    @property
    def largest_acceleration(self) -> Array:
        """Largest \\|ε_out\\| over all yoke positions, array (t,) [rad/s²]."""
        if self.acceleration_range is None:
            return np.full(self.times.shape, np.nan)
        low, high = self.acceleration_range
        result: Array = np.maximum(np.abs(low[:, -1]), np.abs(high[:, -1]))
        return result

    @property
    def _outputs(self) -> tuple[Array, Array]:
        """Lowest and highest ω_out/ω_1, nan where the input stands."""
        if self.speed_range is None:
            return np.full(self.times.shape, np.nan), np.full(self.times.shape, np.nan)
        low, high = self.speed_range
        omega = np.where(high[:, 0] == 0.0, np.nan, high[:, 0])
        ends = low[:, -1] / omega, high[:, -1] / omega
        return np.minimum(*ends), np.maximum(*ends)


WOBBLED = 120
"""Places of a turn looked at where shafts wobble."""


@dataclass(frozen=True, eq=False)
class Question:
    """A drive, how its points move and how fast it turns: ask it for any instants."""

    drive: Drive
    place: Geometry
    path: Path
    speed: float | None
    acceleration: float
    start: float

    def answer(self, times: Array, *, yokes: bool = True) -> Instants:
        """Return everything at the instants (t,) [s]; without ``yokes`` all but the speeds of these very instants."""
        jet = self.path(times)
        points = np.asarray(jet[0])
        if points.shape != (times.size, *self.place.points.shape):
            raise refuse(
                "movement",
                _("the movement gives points of shape {given}; {wanted} needed").format(
                    given=points.shape, wanted=(times.size, *self.place.points.shape)
                ),
            )
        gamma = np.asarray([shaft.yoke_angle for shaft in self.drive.shafts[1:-1]], dtype=float)
        impossible = _impossible(points)
        frozen = geometry_from_points(np.where(impossible[:, None, None], _straight(points), points))
        chain = Chain(
            joint_angle=frozen.joint_angle,
            plane_twist=frozen.plane_twist,
            yoke_angle=gamma,
            start_phase=np.asarray(self.drive.input.start_phase),
        )
        kinds = self.drive.joints
        with np.errstate(invalid="ignore", divide="ignore"):
            shafts = moving_shafts(jet)
            motion = self._motion(times, gamma, self.speed) if yokes and self.speed is not None else None
            speeds, gains = None, None
            if self.speed is not None:
                axes = (shafts.axis, shafts.axis_rate, shafts.axis_acceleration)
                omega = self.speed + self.acceleration * (times - self.start)
                speeds = speed_range(axes, yoke_angle=gamma, speed=omega, kinds=kinds)
                gains = acceleration_range(
                    axes, yoke_angle=gamma, speed=omega, acceleration=self.acceleration, kinds=kinds
                )
        steep = np.any(frozen.joint_angle > [joint.steepest for joint in self.drive.joints], axis=-1)
        status = np.where(impossible, Position.IMPOSSIBLE, np.where(steep, Position.STEEP, Position.FINE))

        def held(table: Array) -> Array:
            return np.where(impossible.reshape(-1, *([1] * (table.ndim - 1))), np.nan, table)

        return Instants(
            times=times,
            points=points,
            shafts=shafts,
            joint_angle=held(frozen.joint_angle),
            plane_twist=held(np.unwrap(frozen.plane_twist, axis=0)),
            shaft_speed_fluctuation=held(self._fluctuation(chain, shafts.axis, frozen.points)),
            shaft_speed=None if motion is None else held(motion.spins.spin),
            shaft_acceleration=None if motion is None else held(motion.spins.spin_acceleration),
            speed_range=None if speeds is None else (held(speeds[0]), held(speeds[1])),
            acceleration_range=None if gains is None else (held(gains[0]), held(gains[1])),
            status=status,
        )

    def _fluctuation(self, chain: Chain, axis: Array, points: Array) -> Array:
        """Return δ of every shaft behind a joint with the axes at rest where they are, array (t, n)."""
        joints = self.drive.joints
        if wobbling(self.drive):
            return np.stack([self._wobbled(polyline(one)) for one in points])
        if not unmapped(joints):
            return np.asarray(equivalent_joint(turning(chain, joints)).shaft_speed_fluctuation)
        still = np.zeros_like(axis)
        low, high = speed_range((axis, still, still), yoke_angle=chain.yoke_angle, speed=1.0, kinds=joints)
        return np.asarray(high - low)[..., 1:]

    def _wobbled(self, place: Geometry) -> Array:
        """Return δ of every shaft behind a joint where shafts wobble, array (n,)."""
        turn = np.arange(WOBBLED) * (2.0 * np.pi / WOBBLED)
        ahead = np.fft.rfft(np.unwrap(course(self.drive, turn, place).turned[1:] - turn, axis=-1))
        rate = np.fft.irfft(1j * np.arange(ahead.shape[-1]) * ahead, WOBBLED)
        return peak(rate) + peak(-rate)

    def _motion(self, times: Array, gamma: Array, speed: float) -> MovingMotion:
        return moving_centres(
            self.path,
            times,
            yoke_angle=gamma,
            speed=speed,
            acceleration=self.acceleration,
            start_phase=self.drive.input.start_phase,
            start=self.start,
            normal=self.place.normal[0],
            kinds=self.drive.joints,
        )


def _impossible(points: Array) -> Array:
    """Tell at which instants a joint bends 90° or more, or neighbouring points meet; array of bool (t,)."""
    shaft = points[:, 1:] - points[:, :-1]
    length = frames.norm(shaft)
    meets = np.any(length <= 1e-9 * np.max(length, axis=-1, keepdims=True), axis=-1)
    safe = shaft / np.where(length > 0.0, length, 1.0)[..., None]
    beyond = np.any(frames.dot(safe[:, :-1], safe[:, 1:]) <= 1e-15, axis=-1)
    result: Array = meets | beyond
    return result


def _straight(points: Array) -> Array:
    """Return a harmless row of points that stands in for impossible ones."""
    count = points.shape[1]
    return np.stack((np.arange(count, dtype=float), np.zeros(count), np.zeros(count)), axis=-1)


# Between which values do speed and acceleration of a moving drive lie, whatever the yoke positions?
#
# The shafts turn many times while the centres hardly move, so at every instant of a movement each yoke position
# will occur. A moving chain is a Möbius map that changes in time. Over the input angle θ, with Q = ω_1/ω_i of the
# frozen drive, ω_i Q is of the same form q_0 + q_1 cos 2θ + q_2 sin 2θ as Q itself, and ε_i Q² has the order 4θ
# besides: a few angles fix them, and with them their extremes.

SAMPLES = 64
"""Yoke positions among which the largest acceleration is looked for before Newton's steps."""

PLACES = 60
"""Positions of a turn looked at where a joint turns by a law without a Möbius map."""


def speed_range(
    axes: Jet, *, yoke_angle: ArrayLike, speed: ArrayLike, kinds: Sequence[Joint] = ()
) -> tuple[Array, Array]:
    """Return the lowest and highest spin of every shaft over all yoke positions, at each instant, exactly.

    axes (..., n+1, 3): directions of the shafts and their rates [1/s]; accelerations do not matter.
    yoke_angle (n-1,) [rad]: γ_2 … γ_n; speed (...) [rad/s]: ω_1.
    kinds: the joints; crosses of Hooke joints when empty.
    Returns low, high (..., n+1) [rad/s].
    Three angles fix N = ω_i Q and Q; the extremes λ of N/Q are where N - λ Q touches zero:
    λ² - 2⟨N,Q⟩λ + ⟨N,N⟩ = 0 with ⟨x,y⟩ = x_0 y_0 - x_1 y_1 - x_2 y_2 and ⟨Q,Q⟩ = 1. Where a joint has no Möbius map
    the extremes are those of `PLACES` positions of a turn.
    """
    xp = namespace(axes[0])
    if unmapped(kinds):
        spin = np.asarray(_around(axes, yoke_angle, speed, 0.0, PLACES, kinds, period=2.0 * np.pi)[0].spin)
        return np.min(spin, axis=-2), np.max(spin, axis=-2)
    found, theta = _around(axes, yoke_angle, speed, 0.0, 3, kinds)
    lower = 1.0 / found.frozen_ratio
    upper = found.spin * lower
    parts = xp.stack((xp.full((3,), 1.0 / 3.0), xp.cos(2.0 * theta) / 1.5, xp.sin(2.0 * theta) / 1.5))
    q, n = parts @ lower, parts @ upper
    sign = xp.asarray([1.0, -1.0, -1.0])[:, None]
    middle = xp.sum(sign * n * q, axis=-2)
    # ⟨N,Q⟩² - ⟨N,N⟩ written as the squared distance of N from its part along Q: no difference of near numbers.
    rest = n - middle[..., None, :] * q
    spread = xp.sqrt(xp.maximum(-xp.sum(sign * rest * rest, axis=-2), 0.0 * middle))
    return middle - spread, middle + spread


def acceleration_range(
    axes: Jet, *, yoke_angle: ArrayLike, speed: ArrayLike, acceleration: ArrayLike = 0.0, kinds: Sequence[Joint] = ()
) -> tuple[Array, Array]:
    """Return the lowest and highest spin acceleration of every shaft over all yoke positions, at each instant.

    axes (..., n+1, 3): directions of the shafts, their rates [1/s] and accelerations [1/s²].
    yoke_angle (n-1,) [rad]: γ_2 … γ_n; speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1.
    kinds: the joints; crosses of Hooke joints when empty.
    Returns low, high (..., n+1) [rad/s²].
    P = ε_i Q² has orders 0, 2 and 4 of θ: five angles fix it. The extremes of P/Q², found among `SAMPLES` yoke
    positions, are sharpened by Newton's steps on P'Q - 2PQ' = 0, down to rounding.
    """
    if unmapped(kinds):
        gain = _around(axes, yoke_angle, speed, acceleration, PLACES, kinds, period=2.0 * np.pi)[0].spin_acceleration
        return np.min(np.asarray(gain), axis=-2), np.max(np.asarray(gain), axis=-2)
    found, theta = _around(axes, yoke_angle, speed, acceleration, 5, kinds)
    order = np.asarray([0.0, 2.0, 2.0, 4.0, 4.0])[:, None]
    basis = _waves(theta, 5)
    weights = np.where(order == 0.0, 0.2, 0.4)
    lower = 1.0 / np.asarray(found.frozen_ratio)
    p = (weights * basis) @ (np.asarray(found.spin_acceleration) * lower**2)
    q = (weights * basis)[:3] @ lower
    at = np.linspace(0.0, np.pi, SAMPLES, endpoint=False)
    table = np.einsum("ks,...ki->s...i", _waves(at, 5), p) / np.einsum("ks,...ki->s...i", _waves(at, 3), q) ** 2
    ends = []
    for sign in (-1.0, 1.0):
        start = at[np.argmax(sign * table, axis=0)]
        sharp = _value(p, q, _sharpened(p, q, start))
        ends.append(sign * np.maximum(sign * sharp, np.max(sign * table, axis=0)))
    return ends[0], ends[1]


def _around(
    axes: Jet,
    yoke_angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike,
    count: int,
    kinds: Sequence[Joint],
    *,
    period: float = np.pi,
) -> tuple[Spins, Array]:
    """Return the spins (..., count, n+1) at equal steps of a period of the input, and its angles (count,)."""
    a = axes[0]
    xp = namespace(a)
    theta = xp.arange(count, dtype=xp.float64) * (period / count)
    arms = frames.rotate(frames.perpendicular(a[..., 0, :])[..., None, :], a[..., 0, None, :], theta)
    one = xp.ones_like(a[..., 0, 0])
    found = moving_axes(
        tuple(part[..., None, :, :] for part in axes),
        arms,
        yoke_angle=yoke_angle,
        speed=(real(speed, xp) * one)[..., None],
        acceleration=(real(acceleration, xp) * one)[..., None],
        kinds=kinds,
    )
    return found, theta


def _waves(theta: Array, count: int, order: int = 0) -> Array:
    """Return 1, cos 2θ, sin 2θ, cos 4θ, sin 4θ, the first ``count``, or a derivative by θ; array (count, ...)."""
    rows = [np.ones_like(theta) if order == 0 else np.zeros_like(theta)]
    for k in (2.0, 4.0):
        shift = 0.5 * np.pi * order
        rows += [k**order * np.cos(k * theta + shift), k**order * np.sin(k * theta + shift)]
    return np.stack(rows[:count])


def _sum(parts: Array, theta: Array, order: int = 0) -> Array:
    """Return the sum of waves with coefficients (..., k, n) at angles (..., n), or its derivative."""
    result: Array = np.einsum("k...,...k->...", _waves(theta, parts.shape[-2], order), np.swapaxes(parts, -1, -2))
    return result


def _value(p: Array, q: Array, theta: Array) -> Array:
    return _sum(p, theta) / _sum(q, theta) ** 2


def _sharpened(p: Array, q: Array, theta: Array) -> Array:
    """Return extremes of P/Q² near given angles, by Newton's steps no longer than that of the samples."""
    reach = np.pi / SAMPLES
    for _step in range(4):
        p0, p1, p2 = (_sum(p, theta, order) for order in range(3))
        q0, q1, q2 = (_sum(q, theta, order) for order in range(3))
        slope = p1 * q0 - 2.0 * p0 * q1
        curve = p2 * q0 - p1 * q1 - 2.0 * p0 * q2
        step = np.divide(-slope, curve, out=np.zeros_like(slope), where=curve != 0.0)
        theta = theta + np.clip(step, -reach, reach)
    return theta
