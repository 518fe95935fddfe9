"""Lives of a duty cycle put together: the rule of Palmgren and Miner, the torque that damages as much."""

from __future__ import annotations

from cardan.formulas.joint_rating import POWER, lasting
from cardan.maths.arrays import Array, ArrayLike, floats, namespace

WHOLE = 1e-4
"""The shares of a duty cycle make up the whole time within this, 0.01 %."""


def combined_life(life: ArrayLike, share: ArrayLike) -> Array:
    """Return the life in a duty cycle of several parts, Book (268): 100/Σ(N_i/L_i).

    life (..., k) [s]: L_i, life if the part ran all the time; infinite where nothing is damaged.
    share (..., k): N_i, share of the time; made to add up to 1.
    Returns (...) [s]: infinite where no part damages; nan where one is unknown.
    """
    lives, shares = floats(life, share)
    xp = namespace(lives)
    rate = xp.sum(shares / lives, axis=-1) / xp.sum(shares, axis=-1)
    return lasting(1.0, rate) + 0.0 * rate


def damage_shares(life: ArrayLike, share: ArrayLike) -> Array:
    """Return which share of the damage each part of a duty cycle does, array (..., k); zeros where nothing is damaged.

    life (..., k) [s]: L_i; share (..., k): N_i.
    """
    lives, shares = floats(life, share)
    xp = namespace(lives)
    rate = shares / lives
    whole = xp.sum(rate, axis=-1)[..., None]
    return rate / xp.where(whole > 0.0, whole, 0.0 * whole + 1.0)


def equivalent_torque(
    torque: ArrayLike, share: ArrayLike, *, speed: ArrayLike = 1.0, joint_angle: ArrayLike = 1.0, power: float = POWER
) -> Array:
    """Return the constant torque that damages bearings as much as a duty cycle, at its mean of speed times joint angle.

    torque (..., k) [N·m]: M_i; share (..., k): N_i, shares of the time.
    speed, joint_angle (..., k): n_i and α_i, or 1 where they are the same in all parts; power: exponent of the life.
    M = [Σ N_i n_i α_i M_i^p/Σ N_i n_i α_i]^(1/p).
    """
    load, shares, n, alpha = floats(torque, share, speed, joint_angle)
    xp = namespace(load)
    weight = shares * xp.abs(n) * alpha + 0.0 * load
    whole = xp.sum(weight, axis=-1)
    mean = xp.sum(weight * xp.abs(load) ** power, axis=-1) / xp.where(whole > 0.0, whole, 0.0 * whole + 1.0)
    return mean ** (1.0 / power)
