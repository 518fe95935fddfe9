"""How do several driven axles share a torque, and what happens to them without differentials?"""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


def cascade_ratios(share: ArrayLike) -> Array:
    """Return the ratios of a cascade of differentials that divides a torque as asked.

    Each differential takes one axle off and hands the rest on to the next; the last one serves two axles.

    Parameters
    ----------
    share : array (..., k)
        Shares of the torque, positive, of any sum; equal ones for axles that shall pull alike.

    Returns
    -------
    array (..., k-1)
        Ratio of each differential with its carrier held, in size: what it hands on over what its axle gets. For equal
        shares k - i, Book pp. 84-85.

    Examples
    --------
    >>> print(cascade_ratios([1.0, 1.0, 1.0]), cascade_ratios([0.4, 0.3, 0.3]))
    [2. 1.] [1.5 1. ]
    """
    (part,) = floats(share)
    xp = namespace(part)
    rest = xp.flip(xp.cumulative_sum(xp.flip(part, axis=-1), axis=-1), axis=-1)
    return rest[..., 1:] / part[..., :-1]


def cascade_shares(ratio: ArrayLike) -> Array:
    """Return how a cascade of differentials divides a torque among its axles.

    Parameters
    ----------
    ratio : array (..., k-1)
        Ratio of each differential with its carrier held, in size.

    Returns
    -------
    array (..., k)
        Shares, of sum 1: 1/(1 + i) of what comes goes to the axle of a differential, i/(1 + i) on.

    Examples
    --------
    >>> print(cascade_shares([2.0, 1.0]))
    [0.33333333 0.33333333 0.33333333]
    """
    (i,) = floats(ratio)
    xp = namespace(i)
    handed = xp.cumulative_prod(i / (1.0 + i), axis=-1) if i.shape[-1] else i
    whole = xp.ones((*i.shape[:-1], 1), dtype=i.dtype)
    come = xp.concat((whole, handed), axis=-1)
    return xp.concat((come[..., :-1] / (1.0 + i), come[..., -1:]), axis=-1)


@dataclass(frozen=True, eq=False, kw_only=True)
class WindUp:
    """What axles that are geared together do to one another on the road."""

    # (...) [rad/m]: twist between the axle with the smallest and the one with the largest wheels, for each metre
    # travelled
    rate: Array
    slip: Array  # (...): difference of their radii over the mean: the slip that takes the twist away again
    # (...) [N·m/m]: circulating torque gained on each metre, until a wheel slips; nan where the stiffness is not given
    torque_rate: Array
    distance: Array  # (...) [m]: after which a wheel slips; nan where grip or stiffness is not given


def wind_up(
    smallest: ArrayLike, largest: ArrayLike, *, stiffness: ArrayLike = float("nan"), grip: ArrayLike = float("nan")
) -> WindUp:
    """Return how axles without differentials wind one another up.

    Parameters
    ----------
    smallest, largest : arrays (...) [m]
        Smallest and largest rolling radius, positive.
    stiffness : array (...) [N·m/rad]
        Of the line between the two axles, as felt at the wheels.
    grip : array (...) [N·m]
        Torque at which the wheels of one axle slip: μ times load times radius.

    Returns
    -------
    WindUp

    Notes
    -----
    dθ/ds = 1/r_min - 1/r_max. The smaller wheels would turn faster; geared to the others they are held back and brake,
    while the larger ones push, and the torque between them grows at stiffness times dθ/ds.

    Examples
    --------
    >>> found = wind_up(0.520, 0.525, stiffness=20e3, grip=4e3)
    >>> print(found.rate, found.slip, found.torque_rate, found.distance)
    0.01831501 0.00956937 366.30036630 10.92
    """
    small, large, stiff, most = floats(smallest, largest, stiffness, grip)
    xp = namespace(small, large, stiff, most)
    rate = (large - small) / (large * small)
    torque_rate = stiff * rate
    return WindUp(
        rate=rate,
        slip=2.0 * (large - small) / (large + small),
        torque_rate=torque_rate,
        distance=xp.where(torque_rate > 0.0, most, xp.inf) / xp.where(torque_rate > 0.0, torque_rate, 1.0)
        + 0.0 * (stiff + most),
    )
