"""Torque a vehicle's shaft must carry: what the engine brings, and what the wheels can pass to the road."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, floats, namespace


@dataclass(frozen=True, eq=False, kw_only=True)
class DesignTorque:
    """Torques at a shaft, arrays (...) [N·m]."""

    drive: Array  # (...): what the engine brings through the gears
    adhesion: Array | None  # (...): what the wheels can pass on; None where their load, radius or adhesion is not given
    design: Array  # (...): factor for jerks times the smaller one
    by_adhesion: Array  # (...) of bool: whether adhesion is the smaller one


def design_torque(
    engine_torque: ArrayLike,
    *,
    halfshaft: bool,
    gear_ratio: ArrayLike,
    axle_ratio: ArrayLike,
    efficiency: ArrayLike = 1.0,
    split_fraction: ArrayLike = 1.0,
    dynamic_factor: ArrayLike = 1.0,
    wheel_load: ArrayLike | None = None,
    friction: ArrayLike | None = None,
    wheel_radius: ArrayLike | None = None,
) -> DesignTorque:
    """Return the design torque of a propeller shaft or a half-shaft.

    Parameters
    ----------
    engine_torque : array (...) [N·m]
        M_e.
    halfshaft : bool
        Behind the axle's gear; else before it.
    gear_ratio, axle_ratio : array (...)
        i_g and i_0.
    efficiency, split_fraction, dynamic_factor : array (...)
        η, share of the torque that this shaft carries, k_d.
    wheel_load : array (...) [N], optional
        W on the wheels that this shaft drives.
    friction : array (...), optional
        μ of these wheels.
    wheel_radius : array (...) [m], optional
        r.

    Notes
    -----
    Propeller shaft: T = M_e i_g η split, limited by μ W r/i_0; half-shaft: T = M_e i_g i_0 η split, limited by μ W r.

    Examples
    --------
    >>> float(design_torque(162.0, halfshaft=True, gear_ratio=2.75, axle_ratio=4.25, split_fraction=0.5).design)
    946.6875
    """
    torque, gear, axle, efficiency, split, factor = floats(
        engine_torque, gear_ratio, axle_ratio, efficiency, split_fraction, dynamic_factor
    )
    xp = namespace(torque)
    drive = torque * gear * efficiency * split * (axle if halfshaft else 1.0)
    if wheel_load is None or friction is None or wheel_radius is None:
        return DesignTorque(drive=drive, adhesion=None, design=factor * drive, by_adhesion=drive != drive)
    load, grip, radius = floats(wheel_load, friction, wheel_radius)
    adhesion = grip * load * radius / (1.0 if halfshaft else axle)
    smaller = xp.minimum(drive, adhesion)
    return DesignTorque(drive=drive, adhesion=adhesion, design=factor * smaller, by_adhesion=adhesion < drive)


def wheel_load(torque: ArrayLike, friction: ArrayLike, wheel_radius: ArrayLike) -> Array:
    """Return the load on the wheels that a torque at them needs, T/(μ r) [N].

    Examples
    --------
    >>> round(float(wheel_load(946.6875, 0.6, 0.325)), 1)
    4854.8
    """
    torque, friction, wheel_radius = floats(torque, friction, wheel_radius)
    return torque / (friction * wheel_radius)
