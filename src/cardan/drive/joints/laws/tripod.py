"""The tripod joint: three rollers on a spider run in three straight tracks of a housing, parallel to its axis.

The tracks pierce the plane of the spider on an ellipse. Written as a complex number in that plane, x along its line of
greatest slope, track k is R_A e^(iφ_k) + R_B e^(-iφ_k), R_A, R_B = R (1/cos α ± 1)/2, and the three rollers meet on
lines 120° apart exactly for the angle ψ = φ and the centre P = -R_B e^(3iφ).
"""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def orbit_radius(joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return the radius of the circle that the centre of the spider runs round three times a turn.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2).
    radius : array (...) [m]
        R, distance of the tracks from the axis of the housing.

    Returns
    -------
    array (...) [m]
        R_B = R (1/cos α - 1)/2, without a difference of near numbers.

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> print(orbit_radius(20 * deg, 20 * mm) / mm)
    0.64177772
    """
    alpha, size = floats(joint_angle, radius)
    xp = namespace(alpha, size)
    return size * xp.sin(0.5 * alpha) ** 2 / xp.cos(alpha)


def spider_centre(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> tuple[Array, Array]:
    """Return the centre of the spider in its plane, from the axis of the housing.

    angle (...) [rad]: φ of the housing: of its first track from the line of greatest slope of the spider's plane.
    joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns x, y (...) [m]: along the line of greatest slope and across it: -R_B cos 3φ, -R_B sin 3φ.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    orbit = orbit_radius(alpha, size)
    return -orbit * xp.cos(3.0 * phi), -orbit * xp.sin(3.0 * phi)


def roller_reach(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return the distance of a roller from the centre of the spider, along its arm.

    angle (...) [rad]: φ of the roller's own track; joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns (...) [m]: R_A + 2 R_B cos 2φ: each roller slides 4 R_B on its arm, twice a turn.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    orbit = orbit_radius(alpha, size)
    return size + orbit + 2.0 * orbit * xp.cos(2.0 * phi)


def track_travel(angle: ArrayLike, joint_angle: ArrayLike, radius: ArrayLike) -> Array:
    """Return how far along its track a roller stands from the middle.

    angle (...) [rad]: φ of the roller's own track; joint_angle (...) [rad]: α in [0, π/2); radius (...) [m]: R.
    Returns (...) [m]: R tan α cos φ.
    """
    phi, alpha, size = floats(angle, joint_angle, radius)
    xp = namespace(phi, alpha, size)
    return size * xp.tan(alpha) * xp.cos(phi)


def shaft_tilt(joint_angle: ArrayLike, radius: ArrayLike, length: ArrayLike) -> Array:
    """Return by how much a shaft that ends in a fixed joint nutates as the spider orbits, for a long shaft.

    joint_angle (...) [rad]: α in [0, π/2).
    radius, length (...) [m]: R, and L from the spider to the other joint of its shaft.
    Returns (...) [rad]: R_B/L. The angle ψ = φ is exact for a shaft that keeps its direction; this tilt is what it
    leaves out.
    """
    alpha, size, far = floats(joint_angle, radius, length)
    return orbit_radius(alpha, size) / far
