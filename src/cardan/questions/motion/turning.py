"""How does a drive turn over the input angle, and how uniformly?"""

from __future__ import annotations

from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.maths.arrays import ArrayLike

from .motion import Motion, motion
from .swing import Evenness, each_shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class Turning:
    """What is known of the motion of one drive."""

    motion: Motion  # every shaft at the input angles asked for
    each: Evenness  # extremes of shafts 2 … n+1 over a turn at uniform input
    # the same at the few positions that people read one by one, where somebody asked for them
    listed: Motion | None = None

    @property
    def fluctuation(self) -> float:
        """Speed fluctuation δ of the output."""
        return float(self.each.speed_fluctuation[-1])


def turning(
    drive: Drive,
    angle: ArrayLike | None = None,
    *,
    speed: float | None = None,
    listed: ArrayLike | None = None,
) -> Turning:
    """Return how a drive turns, and how uniformly.

    drive: of joints of any kinds.
    angle (p,) [rad]: input angles from the start position; one turn in steps of a degree by default.
    speed [rad/s]: input speed; that of the duty by default.
    listed (q,) [rad]: input angles that people want to read one by one.
    """
    return Turning(
        motion=motion(drive, angle, speed=speed),
        each=each_shaft(drive),
        listed=None if listed is None else motion(drive, listed, speed=speed),
    )
