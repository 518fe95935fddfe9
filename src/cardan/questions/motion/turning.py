"""How does a drive turn over the input angle, and how uniformly?"""

from __future__ import annotations

from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.maths.arrays import ArrayLike

from .motion import Motion, motion
from .swing import Evenness, each_shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class Turning:
    """What is known of the motion of one drive.

    Attributes
    ----------
    motion : Motion
        Every shaft at the input angles asked for.
    each : EquivalentJoint or Swing
        Extremes of shafts 2 … n+1 over a turn at uniform input.
    listed : Motion or None
        The same at the few positions that people read one by one, where somebody asked for them.
    """

    motion: Motion
    each: Evenness
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

    Parameters
    ----------
    drive : Drive
        Of joints of any kinds.
    angle : array (p,) [rad], optional
        Input angles from the start position; one turn in steps of a degree by default.
    speed : float, optional [rad/s]
        Input speed; that of the duty by default.
    listed : array (q,) [rad], optional
        Input angles that people want to read one by one.

    Returns
    -------
    Turning

    Examples
    --------
    >>> from cardan.units import deg
    >>> print(f"{turning(Drive.from_angles([20 * deg])).fluctuation:.6f}")
    0.124485
    """
    return Turning(
        motion=motion(drive, angle, speed=speed),
        each=each_shaft(drive),
        listed=None if listed is None else motion(drive, listed, speed=speed),
    )
