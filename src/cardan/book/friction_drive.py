"""Friction drives: how hard two smooth wheels must be pressed together, and at which ratio they turn."""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def least_press(torque: ArrayLike, radius: ArrayLike, friction: ArrayLike) -> Array:
    """Return the normal force below which the wheels slip.

    Parameters
    ----------
    torque : array (...) [N·m]
        M on the wheel.
    radius : array (...) [m]
        r of this wheel, positive.
    friction : array (...)
        f_0 > 0 of rest.

    Returns
    -------
    array (...) [N]
        M/(f_0 r), Litvin (7.1).

    Examples
    --------
    >>> print(least_press(0.5, 0.02, 0.15))
    166.66666667
    """
    moment, size, f = floats(torque, radius, friction)
    return moment / (f * size)


def press(torque: ArrayLike, radius: ArrayLike, friction: ArrayLike, safety: ArrayLike = 2.5) -> Array:
    """Return the normal force with which to press the wheels together.

    Parameters
    ----------
    torque : array (...) [N·m]
        M on the wheel.
    radius : array (...) [m]
        r of this wheel, positive.
    friction : array (...)
        f_0 > 0 of rest.
    safety : array (...)
        k, usually 2 to 3: coefficients of friction scatter that much.

    Returns
    -------
    array (...) [N]
        k M/(f_0 r), Litvin (7.2).

    Examples
    --------
    >>> print(press(0.5, 0.02, 0.15))
    416.66666667
    """
    (k,) = floats(safety)
    return k * least_press(torque, radius, friction)


def speed_ratio(driving_radius: ArrayLike, driven_radius: ArrayLike) -> Array:
    """Return ω_1/ω_2 of two cylindrical wheels without slip, in size.

    Parameters
    ----------
    driving_radius, driven_radius : arrays (...) [m]
        r_1, r_2 > 0.

    Returns
    -------
    array (...)
        r_2/r_1, Litvin (7.3); outside contact turns the sense about.

    Examples
    --------
    >>> print(speed_ratio(0.02, 0.05))
    2.5
    """
    one, two = floats(driving_radius, driven_radius)
    return two / one


def cone_ratio(driving_angle: ArrayLike, driven_angle: ArrayLike) -> Array:
    """Return ω_1/ω_2 of two cones with a common apex, in size.

    driving_angle, driven_angle (...) [rad]: δ_1, δ_2, between axis and generatrix of each cone.
    Returns (...): sin δ_2/sin δ_1, Litvin (7.3).
    """
    one, two = floats(driving_angle, driven_angle)
    xp = namespace(one, two)
    return xp.sin(two) / xp.sin(one)
