"""How one joint of any kind turns by itself: over a turn at one angle, over angles, and what else moves in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.catalogue import catalogue
from cardan.catalogue.rows import JointType
from cardan.drive.joints import JOINTS, Joint
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _
from cardan.units import deg

TURN = np.arange(721) * (0.5 * deg)
"""Angles of a turn [rad]."""

COARSE = np.arange(120) * (3.0 * deg)
"""Angles of a turn [rad] where many bends are asked at once; extremes then miss 0.1 % at most for order 2."""

EVEN = 1e-12
"""Leads [rad] and swings of the ratio below this are rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointTurn:
    """One joint over a turn at one joint angle.

    Attributes
    ----------
    joint : Joint
    joint_angle : float [rad]
        α.
    angle : array (p,) [rad]
        Angle of the driving side from the plane of the shafts.
    angle_error : array (p,) [rad]
        How far the driven side runs ahead.
    ratio : array (p,)
        Speed ratio.
    slope : array (p,) [1/rad]
        Its derivative: acceleration of the driven side over the square of a constant speed.
    """

    joint: Joint
    joint_angle: float
    angle: Array
    angle_error: Array
    ratio: Array
    slope: Array

    @property
    def error(self) -> float:
        """Half of what lies between the greatest lead and the greatest lag [rad]."""
        found = 0.5 * float(np.ptp(self.angle_error))
        return 0.0 if found < EVEN else found

    @property
    def speed_fluctuation(self) -> float:
        """Largest less smallest speed ratio."""
        found = float(np.ptp(self.ratio))
        return 0.0 if found < EVEN else found

    @property
    def acceleration(self) -> float:
        """Greatest acceleration of the driven side over the square of a constant speed."""
        return float(np.max(np.abs(self.slope))) if self.speed_fluctuation else 0.0

    @property
    def order(self) -> int:
        """How often a turn the driven side mostly runs ahead and back; 0 where it turns evenly."""
        if not self.error:
            return 0
        wave = np.abs(np.fft.rfft(self.angle_error[:-1]))
        return int(np.argmax(wave[1:])) + 1


@dataclass(frozen=True, eq=False, kw_only=True)
class JointAngles:
    """One joint over its joint angles.

    Attributes
    ----------
    joint : Joint
    joint_angle : array (m,) [rad]
        α; not a number in the others where the joint does not turn.
    error : array (m,) [rad]
        Half of what lies between the greatest lead and the greatest lag of a turn.
    speed_fluctuation : array (m,)
        Largest less smallest speed ratio.
    acceleration : array (m,)
        Greatest acceleration over the square of a constant speed.
    """

    joint: Joint
    joint_angle: Array
    error: Array
    speed_fluctuation: Array
    acceleration: Array


def joint_turn(joint: Joint, joint_angle: float, angle: ArrayLike | None = None) -> JointTurn:
    """Return how one joint of any kind turns at a joint angle.

    Parameters
    ----------
    joint : Joint
        A joint of any kind.
    joint_angle : float [rad]
        α in [0, π/2), whatever the joint itself says.
    angle : array (p,) [rad], optional
        Angles of the driving side from the plane of the shafts; a turn by default.

    Returns
    -------
    JointTurn

    Raises
    ------
    InputError
        The joint angle is 90 degrees or more, or the joint does not turn at it.

    See Also
    --------
    joint_over_angles, motion

    Examples
    --------
    >>> from cardan.joints import DoubleCardan, Hooke, joint_turn
    >>> from cardan.units import deg
    >>> for joint in (Hooke(), DoubleCardan(centring_ratio=0.5)):
    ...     found = joint_turn(joint, 30 * deg)
    ...     print(f"{found.error / deg:.4f}° {found.speed_fluctuation:.5f}, order {found.order}")
    4.1172° 0.28868, order 2
    0.1400° 0.00977, order 2
    """
    if not 0.0 <= joint_angle < 0.5 * math.pi:
        text = _("{value}° is not at least 0° and below 90°")
        raise refuse("joint_angle", text.format(value=f"{joint_angle / deg:.6g}"), "out_of_range")
    phi = np.asarray(TURN if angle is None else angle, dtype=float)
    law = _law(joint, joint_angle, phi)
    if not all(np.all(np.isfinite(one)) for one in law):
        raise refuse("joint_angle", joint.stuck(joint_angle), "out_of_range")
    return JointTurn(joint=joint, joint_angle=joint_angle, angle=phi, angle_error=law[0], ratio=law[1], slope=law[2])


def joint_over_angles(joint: Joint, joint_angles: ArrayLike | None = None) -> JointAngles:
    """Return how uneven one joint of any kind is over its joint angles.

    Parameters
    ----------
    joint : Joint
        A joint of any kind.
    joint_angles : array (m,) [rad], optional
        Joint angles α in [0, π/2); by default from 0 to the steepest its kind works at.

    Returns
    -------
    JointAngles
        arrays (m,).

    See Also
    --------
    joint_turn

    Examples
    --------
    >>> from cardan.joints import DoubleCardan, joint_over_angles
    >>> from cardan.units import deg
    >>> joint_over_angles(DoubleCardan(centring_ratio=0.5), [10 * deg, 30 * deg, 50 * deg]).speed_fluctuation
    array([0.00011651, 0.00977419, 0.08078532])
    """
    alpha = (
        np.linspace(0.0, min(joint.steepest, 75.0 * deg), 31)
        if joint_angles is None
        else np.asarray(joint_angles, dtype=float)
    )
    rows = []
    for joint_angle in alpha:
        law = _law(joint, float(joint_angle), COARSE)
        found = JointTurn(
            joint=joint, joint_angle=float(joint_angle), angle=COARSE, angle_error=law[0], ratio=law[1], slope=law[2]
        )
        turns = bool(np.all(np.isfinite(law[0])))
        rows.append((found.error, found.speed_fluctuation, found.acceleration) if turns else (math.nan,) * 3)
    error, speed_fluctuation, acceleration = np.asarray(rows, dtype=float).reshape(-1, 3).T
    return JointAngles(
        joint=joint, joint_angle=alpha, error=error, speed_fluctuation=speed_fluctuation, acceleration=acceleration
    )


def _law(joint: Joint, joint_angle: float, angle: Array) -> tuple[Array, Array, Array]:
    """Return lead, ratio and slope over angles, each (p,); not numbers where the joint does not turn."""
    with np.errstate(invalid="ignore", divide="ignore"):
        found = joint.deviation(angle, np.asarray(joint_angle))
    outer, ratio, slope = (np.broadcast_to(np.asarray(one, dtype=float), angle.shape) for one in found)
    return outer, ratio, slope


def types_of(kind: str) -> tuple[JointType, ...]:
    """Return the types of the shipped catalogue that turn by the law of a kind, a name of `JOINTS`."""
    rows = catalogue().rows(JointType)
    names = JOINTS[kind].types if kind in JOINTS else ()
    return tuple(rows[name] for name in names if name in rows)
