"""What the friction of a sliding spline does to the joint beside it."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, namespace, real


@dataclass(frozen=True, eq=False, kw_only=True)
class SplineThrust:
    """Friction thrust of a spline and its parts in the joint."""

    thrust: Array  # (...) [N]: T along the splined shaft
    axial: Array  # axial, radial (...) [N]: parts along and across the other shaft
    radial: Array  # (...) [N]
    # along_driving_arm, along_driven_arm, along_normal (...) [N]: parts along u, v and the normal of the cross
    along_driving_arm: Array
    along_driven_arm: Array  # (...) [N]
    along_normal: Array  # (...) [N]


def spline_thrust(joint_angle: ArrayLike, angle: ArrayLike, torque: ArrayLike, grip: ArrayLike) -> SplineThrust:
    """Return the friction thrust of the spline of the driven shaft, and what of it goes where.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α.
    angle : array (...) [rad]
        θ, angle of the driving yoke from the plane of the joint.
    torque : array (...) [N·m]
        M at the spline.
    grip : array (...) [1/m]
        2 μ/d, see `cardan.drive.models.train.spline_grip`.

    Notes
    -----
    T = 2 μ M/d, Book (123). e_2·u = sin α cos θ (Book (124), first line); e_2·v = 0, so the driven journals carry no
    thrust (its second line, T sin α sin θ, is wrong); e_2·n = √(1 - sin² α cos² θ).

    Examples
    --------
    >>> import math
    >>> found = spline_thrust(math.radians(25), math.radians(40), 800.0, 2 * 0.12 / 0.06)
    >>> print(f"{found.thrust:.3f} {found.along_driving_arm:.3f}")
    3200.000 1035.982
    """
    xp = namespace(joint_angle, angle, torque, grip)
    alpha, theta, moment, over = (real(x, xp) for x in (joint_angle, angle, torque, grip))
    push = over * xp.abs(moment)
    sine = xp.sin(alpha)
    along = sine * xp.cos(theta)
    return SplineThrust(
        thrust=push + 0.0 * along,
        axial=push * xp.cos(alpha) + 0.0 * along,
        radial=push * sine + 0.0 * along,
        along_driving_arm=push * along,
        along_driven_arm=0.0 * push * along,
        along_normal=push * xp.sqrt(1.0 - along * along),
    )
