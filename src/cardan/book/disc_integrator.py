"""Disc and roller: a roller on a turning disc adds up its distance from the middle, and differentiates backwards."""

from __future__ import annotations

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def roller_speed(speed: ArrayLike, place: ArrayLike, radius: ArrayLike) -> Array:
    """Return the speed of the roller.

    Parameters
    ----------
    speed : array (...) [rad/s]
        ω_1 of the disc.
    place : array (...) [m]
        ρ of the roller from the middle of the disc, negative on the other side.
    radius : array (...) [m]
        r_2 > 0 of the roller.

    Returns
    -------
    array (...) [rad/s]
        ω_1 ρ/r_2, Litvin (7.4).

    Examples
    --------
    >>> print(roller_speed(10.0, 0.005, 0.02))
    2.5
    """
    omega, rho, size = floats(speed, place, radius)
    return omega * rho / size


def roller_turn(turn: ArrayLike, place: ArrayLike, radius: ArrayLike) -> Array:
    """Return how far the roller has turned, while it moved over the disc.

    Parameters
    ----------
    turn : array (..., p) [rad]
        φ_1 of the disc at some instants.
    place : array (..., p) [m]
        ρ there; between them ρ changes in proportion to φ_1.
    radius : array (...) [m]
        r_2 > 0.

    Returns
    -------
    array (..., p) [rad]
        φ_2 since the first instant.

    Notes
    -----
    ∫ρ dφ_1/r_2 from Litvin (7.4), by trapezoids, which are exact for such a movement.

    Examples
    --------
    >>> print(roller_turn([0.0, 20.0], [0.005, 0.010], 0.02))
    [0.  7.5]
    """
    phi, rho, size = floats(turn, place, radius)
    xp = namespace(phi, rho, size)
    steps = 0.5 * (rho[..., 1:] + rho[..., :-1]) * (phi[..., 1:] - phi[..., :-1]) / size[..., None]
    sums = xp.cumulative_sum(steps, axis=-1) if steps.shape[-1] else steps
    return xp.concat((0.0 * phi[..., :1] + 0.0 * rho[..., :1] + 0.0 * size[..., None], sums), axis=-1)


def differentiated(place: ArrayLike, radius: ArrayLike, input_scale: ArrayLike, output_scale: ArrayLike) -> Array:
    """Return the derivative that a differentiator shows while its two arrows are held together.

    place (...) [m]: ρ of the roller that holds them together; radius (...) [m]: r_2 > 0.
    input_scale, output_scale (...): m_φ1, m_φ4: turn of the disc for a unit of the variable u, and of the function's
    arrow for a unit of θ [rad].
    Returns (...): θ'(u) = (m_φ1/m_φ4) ρ/r_2, Litvin (7.5)-(7.7).
    """
    rho, size, one, other = floats(place, radius, input_scale, output_scale)
    return one / other * rho / size
