"""Fatigue of a shaft under swinging torque and the bending that turns with it: Marin's factors and Goodman's line."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

from cardan.maths.arrays import Array, ArrayLike, floats, namespace
from cardan.units import mm

from .shaft_strength import torsion_modulus

MPA = 1e6

FINISHES = {
    "ground": (1.58, -0.085),
    "machined": (4.51, -0.265),
    "hot_rolled": (57.7, -0.718),
    "forged": (272.0, -0.995),
}
"""Surface factor k_a = a S_ut^b, S_ut in MPa: Shigley, table 6-2."""

RELIABILITIES = {0.5: 1.0, 0.9: 0.897, 0.95: 0.868, 0.99: 0.814, 0.999: 0.753, 0.9999: 0.702, 0.99999: 0.659}
"""Reliability factor k_e: Shigley, table 6-5."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Fatigue:
    """Fatigue of a shaft, arrays (...)."""

    endurance: Array  # (...) [Pa]: S_e, fatigue limit of the part
    alternating: Array  # alternating, mean (...) [Pa]: equivalent stresses by von Mises
    mean: Array  # (...) [Pa]
    safety: Array  # (...): against fatigue, by Goodman
    yield_safety: Array  # (...): against yielding in the first cycle
    # (...): life; infinite where the safety is 1 and more, 0 where the mean stress alone breaks the shaft
    cycles: Array


def reliability_factor(reliability: float) -> float:
    """Return k_e, straight over the normal quantile between the values of the table.

    reliability: share of parts that last, from 0.5 to 0.99999.

    >>> reliability_factor(0.99), round(reliability_factor(0.98), 3)
    (0.814, 0.836)
    """
    if reliability in RELIABILITIES:
        return RELIABILITIES[reliability]
    places = [NormalDist().inv_cdf(share) for share in RELIABILITIES]
    factors = list(RELIABILITIES.values())
    at = NormalDist().inv_cdf(reliability)
    right = next((k for k, place in enumerate(places) if place >= at), len(places) - 1)
    left = max(right - 1, 0)
    share = (at - places[left]) / (places[right] - places[left])
    return factors[left] + share * (factors[right] - factors[left])


def shaft_fatigue(
    *,
    mean_torque: ArrayLike,
    swinging_torque: ArrayLike,
    mean_bending: ArrayLike,
    swinging_bending: ArrayLike,
    outer: ArrayLike,
    inner: ArrayLike,
    ultimate: ArrayLike,
    yield_strength: ArrayLike,
    finish: str,
    bending_notch: ArrayLike = 1.0,
    torsion_notch: ArrayLike = 1.0,
    reliability: float = 0.9,
) -> Fatigue:
    """Return the fatigue of a round shaft; a secondary couple turns with the shaft and swings fully.

    Parameters
    ----------
    mean_torque, swinging_torque, mean_bending, swinging_bending : array (...) [N·m]
        T_m, T_a, M_m, M_a.
    outer, inner : array (...) [m]
    ultimate, yield_strength : array (...) [Pa]
        S_ut ≥ S_y.
    finish : str
        Key of `FINISHES`.
    bending_notch, torsion_notch : array (...)
        K_f and K_fs.
    reliability : float
        Share of parts that last.

    Notes
    -----
    S_e = k_a k_b k_e min(0.5 S_ut, 700 MPa); k_b = 1 below 2.79 mm, 1.24 d^-0.107 up to 51 mm, 1.51 d^-0.157 above.
    Goodman: n = 1/(σ_a/S_e + σ_m/S_ut). Below 1 the life is (σ_r/A)^(1/B), σ_r = σ_a/(1 - σ_m/S_ut),
    A = (0.9 S_ut)²/S_e, B = -⅓ lg(0.9 S_ut/S_e). Sources: Shigley, chapter 6.

    Examples
    --------
    >>> one = shaft_fatigue(mean_torque=2000.0, swinging_torque=600.0, mean_bending=0.0, swinging_bending=350.0,
    ...     outer=0.075, inner=0.070, ultimate=410e6, yield_strength=245e6, finish="hot_rolled",
    ...     bending_notch=1.3, torsion_notch=1.2)
    >>> round(float(one.safety), 4), round(float(one.cycles))
    (0.8186, 123411)
    """
    t_mean, t_swing, m_mean, m_swing = floats(mean_torque, swinging_torque, mean_bending, swinging_bending)
    outer, ultimate, strength, kf, kfs = floats(outer, ultimate, yield_strength, bending_notch, torsion_notch)
    xp = namespace(outer)
    modulus = torsion_modulus(outer, inner)
    scale, exponent = FINISHES[finish]
    wide = outer / mm
    size = xp.where(wide <= 51.0, 1.24 * wide**-0.107, 1.51 * wide**-0.157)
    size = xp.where(wide < 2.79, 1.0, size)
    surface = xp.minimum(scale * (ultimate / MPA) ** exponent, 0.0 * ultimate + 1.0)
    endurance = surface * size * reliability_factor(reliability) * xp.minimum(0.5 * ultimate, 0.0 * ultimate + 700e6)
    joint_angle_swing, joint_angle_mean = 2.0 * m_swing / modulus, 2.0 * m_mean / modulus
    twist_swing, twist_mean = t_swing / modulus, t_mean / modulus
    alternating = xp.sqrt((kf * joint_angle_swing) ** 2 + 3.0 * (kfs * twist_swing) ** 2)
    mean = xp.sqrt((kf * joint_angle_mean) ** 2 + 3.0 * (kfs * twist_mean) ** 2)
    use = alternating / endurance + mean / ultimate
    most = xp.sqrt(
        (kf * (xp.abs(joint_angle_mean) + joint_angle_swing)) ** 2
        + 3.0 * (kfs * (xp.abs(twist_mean) + twist_swing)) ** 2
    )
    level = 0.9 * ultimate / endurance
    rest = xp.where(mean < ultimate, 1.0 - mean / ultimate, 1.0)
    slope = -xp.log10(level) / 3.0
    reversed_stress = xp.where(alternating > 0.0, alternating, 1.0) / rest
    cycles = (reversed_stress / (level * 0.9 * ultimate)) ** (1.0 / slope)
    cycles = xp.where(use <= 1.0, math.inf, xp.where(mean >= ultimate, 0.0, cycles))
    unloaded = xp.where(use > 0.0, use, 1.0)
    stressed = xp.where(most > 0.0, most, 1.0)
    return Fatigue(
        endurance=endurance,
        alternating=alternating,
        mean=mean,
        safety=xp.where(use > 0.0, 1.0 / unloaded, math.inf),
        yield_safety=xp.where(most > 0.0, strength / stressed, math.inf),
        cycles=cycles,
    )
