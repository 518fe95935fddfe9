"""What a moving drive is like at any instants: the one place where movement, frozen geometry and exact spins meet."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.chain import Chain, turning
from cardan.drive.models.geometry import Geometry, geometry_from_points
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.curves.paths import Path
from cardan.maths.kernel import frames
from cardan.texts import _

from .equivalence import equivalent_joint
from .moving_chain import MovingMotion, Shafts, moving_centres, moving_shafts
from .spin_range import acceleration_range, speed_range


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
        even = tuple(joint.even for joint in self.drive.joints)
        with np.errstate(invalid="ignore", divide="ignore"):
            shafts = moving_shafts(jet)
            motion = self._motion(times, gamma, self.speed) if yokes and self.speed is not None else None
            speeds, gains = None, None
            if self.speed is not None:
                axes = (shafts.axis, shafts.axis_rate, shafts.axis_acceleration)
                omega = self.speed + self.acceleration * (times - self.start)
                speeds = speed_range(axes, yoke_angle=gamma, speed=omega, even=even)
                gains = acceleration_range(
                    axes, yoke_angle=gamma, speed=omega, acceleration=self.acceleration, even=even
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
            shaft_speed_fluctuation=held(equivalent_joint(turning(chain, self.drive.joints)).shaft_speed_fluctuation),
            shaft_speed=None if motion is None else held(motion.spins.spin),
            shaft_acceleration=None if motion is None else held(motion.spins.spin_acceleration),
            speed_range=None if speeds is None else (held(speeds[0]), held(speeds[1])),
            acceleration_range=None if gains is None else (held(gains[0]), held(gains[1])),
            status=status,
        )

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
            even=tuple(joint.even for joint in self.drive.joints),
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
