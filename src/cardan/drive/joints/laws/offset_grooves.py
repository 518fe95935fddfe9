"""Balls between circular grooves whose centres stand off the joint: curved Weiss grooves, offset Rzeppa grooves.

The groove of shaft 1 is a circle in its meridian plane about a point of its axis at the distance c_1 from the joint's
centre O, that of shaft 2 likewise at c_2, both of one radius R. Then the centre of a ball is as far from one point as
from the other: the centres of all balls lie in one plane, and with c_1 = c_2 it is the bisecting plane.
"""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def _distance(joint_angle: Array, first: Array, second: Array) -> Array:
    """Return the distance between the groove centres."""
    xp = namespace(joint_angle, first, second)
    across, along = (first + second) * xp.cos(0.5 * joint_angle), (first - second) * xp.sin(0.5 * joint_angle)
    return xp.sqrt(across * across + along * along)


def plane_tilt(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return the tilt of the plane of the balls against the bisecting plane.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2), angle between the shafts.
    first, second : arrays (...) [m]
        c_1, c_2 > 0, distances of the groove centres from the centre of the joint, each on the side of its shaft.

    Returns
    -------
    array (...) [rad]
        η of `laws.tilted_plane`: arctan[(c_2 - c_1)/(c_1 + c_2) tan(α/2)]; the normal leans to the shaft whose
        groove stands farther off.

    Examples
    --------
    >>> from cardan.units import deg
    >>> print(plane_tilt(30 * deg, 3.0e-3, [3.0e-3, 3.3e-3]) / deg)
    [0.         0.73102499]
    """
    alpha, one, two = floats(joint_angle, first, second)
    xp = namespace(alpha, one, two)
    return xp.atan((two - one) / (one + two) * xp.tan(0.5 * alpha))


def plane_offset(joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike) -> Array:
    """Return the distance of the plane of the balls from the centre of the joint, positive towards shaft 1.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2).
    first, second : arrays (...) [m]
        c_1, c_2 > 0.

    Returns
    -------
    array (...) [m]
        (c_1² - c_2²)/(2 \\|c_1 e_1 - c_2 e_2\\|).

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> print(plane_offset(30 * deg, 3.0 * mm, 3.3 * mm) / mm)
    -0.15527878
    """
    alpha, one, two = floats(joint_angle, first, second)
    return 0.5 * (one - two) * ((one + two) / _distance(alpha, one, two))


def ball_centre(
    angle: ArrayLike, joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike, radius: ArrayLike
) -> tuple[Array, Array]:
    """Return where the centre of a ball is, in the meridian plane of shaft 1.

    Parameters
    ----------
    angle : array (...) [rad]
        φ_1, of the meridian plane from the inner side of the plane of the shafts.
    joint_angle : array (...) [rad]
        α in [0, π/2).
    first, second : arrays (...) [m]
        c_1, c_2 > 0.
    radius : array (...) [m]
        R, of both grooves.

    Returns
    -------
    along, out : arrays (...) [m]
        Distance from O along shaft 1, and from its axis; nan where the grooves do not meet.

    Notes
    -----
    (c_1 + c_2 cos α)(h - c_1) - c_2 sin α cos φ_1 r = -\\|c_1 e_1 - c_2 e_2\\|²/2 is the plane of the balls, and
    (h - c_1)² + r² = R² the groove; of the two points the one away from the axis.

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> along, out = ball_centre(50 * deg, 30 * deg, 3.0 * mm, 3.3 * mm, 30.0 * mm)
    >>> print(along / mm, out / mm)
    5.25496523 29.91513215
    """
    phi, alpha, one, two, size = floats(angle, joint_angle, first, second, radius)
    xp = namespace(phi, alpha, one, two, size)
    lean = two * xp.sin(alpha) * xp.cos(phi)
    rise = one + two * xp.cos(alpha)
    length = xp.sqrt(rise * rise + lean * lean)
    foot = 0.5 * _distance(alpha, one, two) ** 2 / length
    rest = (size - foot) * (size + foot)
    half = xp.sqrt(xp.where((rest > 0.0) & (size > 0.0), rest, xp.nan))
    out = (foot * lean + half * rise) / length
    meets = out > 0.0
    along = one - (foot * rise - half * lean) / length
    return xp.where(meets, along, xp.nan), xp.where(meets, out, xp.nan)


def deviation(
    angle: ArrayLike, joint_angle: ArrayLike, first: ArrayLike, second: ArrayLike, radius: ArrayLike
) -> Array:
    """Return how far shaft 2 runs ahead of shaft 1 with one ball, φ_2 - φ_1.

    Parameters
    ----------
    angle : array (...) [rad]
        φ_1, of the ball's meridian plane from the inner side of the plane of the shafts.
    joint_angle : array (...) [rad]
        α in [0, π/2).
    first, second : arrays (...) [m]
        c_1, c_2 > 0.
    radius : array (...) [m]
        R, of both grooves.

    Returns
    -------
    array (...) [rad]
        Exactly 0 where the offsets are equal; nan where the grooves do not meet.

    Notes
    -----
    The centre of the ball is s = δ (1 - sin(α/2) A·v/m)/cos(α/2) off the bisecting plane, towards shaft 1, with
    m = (c_1 + c_2)/2, δ = (c_1 - c_2)/2 and v the bisector of e_1 + e_2; then
    tan(φ_2 - φ_1) = -2 s sin(α/2) sin φ_1/[r (sin²φ_1 + cos α cos²φ_1) + h sin α cos φ_1].

    Examples
    --------
    >>> from cardan.units import deg, mm
    >>> print(deviation(50 * deg, 30 * deg, 3.0 * mm, [3.0 * mm, 3.3 * mm], 30.0 * mm) + 0.0)
    [ 0.         -0.00131156]
    """
    phi, alpha, one, two, size = floats(angle, joint_angle, first, second, radius)
    xp = namespace(phi, alpha, one, two, size)
    h, r = ball_centre(phi, alpha, one, two, size)
    sine, cosine = xp.sin(phi), xp.cos(phi)
    small, large = xp.sin(0.5 * alpha), xp.cos(0.5 * alpha)
    side = h * small + r * cosine * large
    off = (one - two) * (0.5 - small * side / (one + two)) / large
    rest = r * (sine * sine + xp.cos(alpha) * cosine * cosine) + h * xp.sin(alpha) * cosine
    return xp.atan2(-2.0 * off * small * sine, rest)
