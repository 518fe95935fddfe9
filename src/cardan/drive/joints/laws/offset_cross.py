"""Cardan joint whose cross axes do not meet: the shaft turns by Hooke's law and wobbles twice a turn.

Pin 1 stands on shaft 1 at O, pin 2 at the distance e along the common perpendicular of both pins. The output shaft
meets pin 2 at Q and slides through a sphere S at |OS| = L; the joint angle α is the angle of shaft 1 with OS, whatever
the supports do. Pin 2 is always at right angles to OS, so that the turn about OS is that of a Hooke joint, exactly.
"""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace, unit_complex
from cardan.maths.kernel import mobius


def deviation(angle: ArrayLike, joint_angle: ArrayLike) -> Array:
    """Return how far the output yoke runs ahead of the input, φ2 - φ1; the law of the Hooke joint, for any offset.

    angle (...) [rad]: input angle φ1, of pin 1 from the plane of shaft 1 and OS.
    joint_angle (...) [rad]: bend α in [0, π/2).
    """
    phi, alpha = floats(angle, joint_angle)
    return mobius.angle_error(mobius.hooke(alpha), unit_complex(2.0 * phi))


def output_angle(angle: ArrayLike, joint_angle: ArrayLike) -> Array:
    """Return the output angle φ2 in (-π, π], arctan2(sin φ1, cos α cos φ1); see `deviation`."""
    phi, alpha = floats(angle, joint_angle)
    xp = namespace(phi, alpha)
    return xp.atan2(xp.sin(phi), xp.cos(alpha) * xp.cos(phi))


def _across(angle: Array, joint_angle: Array) -> tuple[Array, Array]:
    """Return what of the common perpendicular stands across and along OS, sin α |cos φ1| and the root of the rest."""
    xp = namespace(angle, joint_angle)
    across = xp.sin(joint_angle) * xp.abs(xp.cos(angle))
    return across, xp.sqrt(1.0 - across * across)


def tilt(angle: ArrayLike, joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike, side: ArrayLike = 1.0) -> Array:
    """Return the angle ε of the output shaft with OS, about pin 2.

    Parameters
    ----------
    angle : array (...) [rad]
        Input angle φ1.
    joint_angle : array (...) [rad]
        Bend α in [0, π/2).
    offset : array (...) [m]
        Distance e of the cross axes, not negative.
    reach : array (...) [m]
        Distance L of the support from pin 1, above e.
    side : array (...)
        +1 where pin 2 lies toward the support, -1 where it lies away from it.

    Returns
    -------
    array (...) [rad]

    Notes
    -----
    tan ε = e sin α |cos φ1|/(L - σ e √(1 - sin² α cos² φ1)), spec: joint with crossed axes; from the point
    Q = O + σ e c, c the common perpendicular of the pins, of which OS has √(1 - sin² α cos² φ1).

    Examples
    --------
    >>> import math
    >>> print(f"{tilt(0.0, math.radians(25), 0.02, 0.5):.9f}")
    0.017538820
    """
    phi, alpha, e, far, sign = floats(angle, joint_angle, offset, reach, side)
    across, along = _across(phi, alpha)
    return namespace(phi, alpha, e, far).atan2(e * across, far - sign * e * along)


def span(angle: ArrayLike, joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike, side: ArrayLike = 1.0) -> Array:
    """Return the length |QS| of the output shaft from pin 2 to its support; arguments as those of `tilt`.

    √(L² + e² - 2 L e σ √(1 - sin² α cos² φ1)).
    """
    phi, alpha, e, far, sign = floats(angle, joint_angle, offset, reach, side)
    across, along = _across(phi, alpha)
    return namespace(phi, alpha, e, far).sqrt((e * across) ** 2 + (far - sign * e * along) ** 2)


def wobble(joint_angle: ArrayLike, offset: ArrayLike, reach: ArrayLike) -> Array:
    """Return half the angle of the cone on which the output shaft wobbles, twice a turn, to first order in e/L.

    e sin α/(2L): Q runs on a circle of diameter e sin α, once in half a turn of the input.
    """
    alpha, e, far = floats(joint_angle, offset, reach)
    return 0.5 * e * namespace(alpha, e).sin(alpha) / far


def shaking_force(joint_angle: ArrayLike, offset: ArrayLike, mass: ArrayLike, speed: ArrayLike) -> Array:
    """Return the inertia force of a mass that runs with Q, at twice the speed of the shaft.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        Bend α.
    offset : array (...) [m]
        Distance e of the cross axes.
    mass : array (...) [kg]
        Mass at the joint.
    speed : array (...) [rad/s]
        Input speed ω.

    Returns
    -------
    array (...) [N]

    Notes
    -----
    m (e sin α/2) (2ω)², to first order in e/L.

    Examples
    --------
    >>> print(f"{shaking_force(0.4, 0.02, 1.5, 100.0):.1f}")
    233.7
    """
    alpha, e, m, omega = floats(joint_angle, offset, mass, speed)
    return 0.5 * m * e * namespace(alpha, e).sin(alpha) * (2.0 * omega) ** 2
