"""How does a joint turn while its angle varies at random? The angle is normal and stationary, the plane at rest."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.errors import JointAngleLimitError, Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves import spectra
from cardan.maths.curves.paths import Jet, plus
from cardan.texts import _
from cardan.units import deg

NODES = 64
"""Gauss-Hermite nodes of the expectations."""

REACH = 6.0
"""Standard deviations that must stay below 90°."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RandomSpeed:
    """Speed of the driven shaft at given joint angles, over all that chance may bring."""

    mean: Array  # (...) [rad/s]: expectation of ω_2
    deviation: Array  # (...) [rad/s]: standard deviation of ω_2
    small: Array  # (...) [rad/s]: standard deviation to first order in that of the joint angle, for comparison


def random_joint_angle(
    yoke_rotation: ArrayLike, *, mean: float, deviation: float, rate_deviation: float, speed: float, nodes: int = NODES
) -> RandomSpeed:
    """Return mean and standard deviation of the driven speed of a joint with a random bend.

    Parameters
    ----------
    yoke_rotation : array (...) [rad]
        θ, angle of the driving yoke from the plane of the shafts.
    mean, deviation : float [rad]
        Mean ᾱ and standard deviation σ_α of the bend.
    rate_deviation : float [rad/s]
        Standard deviation σ_α' of the rate of the joint angle, see `rate_deviation`.
    speed : float [rad/s]
        ω_1.
    nodes : int
        Gauss-Hermite nodes, at least 40.

    Returns
    -------
    RandomSpeed

    Raises
    ------
    InputError
        A deviation below zero, or a joint angle that reaches 90° within six standard deviations.

    Notes
    -----
    Stationary and normal, so bend and rate at one instant are independent. With A = c/D, B = ½ s sin 2θ/D,
    D = 1 - s² cos²θ: E ω_2 = ω_1 E A, Var ω_2 = ω_1² Var A + σ_α'² E B². Small deviations:
    σ² ≈ (ω_1 σ_α ∂A/∂α)² + (B σ_α')² with ∂A/∂α = s [(1 + c²) cos²θ - 1]/D².

    Examples
    --------
    >>> found = random_joint_angle(30 * deg, mean=10 * deg, deviation=1.5 * deg, rate_deviation=0.5, speed=100.0)
    >>> round(float(found.mean), 6), round(float(found.deviation), 6)
    (100.7763, 0.231621)
    """
    check(_problems(mean, deviation, rate_deviation, nodes))
    theta = np.asarray(yoke_rotation, dtype=float)
    at, weight = np.polynomial.hermite_e.hermegauss(nodes)
    weight = weight / math.sqrt(2.0 * math.pi)
    transfer, rate_transfer = _transfer(mean + deviation * at, theta[..., None])
    average = transfer @ weight
    spread = (transfer - average[..., None]) ** 2 @ weight
    variance = speed**2 * spread + rate_deviation**2 * (rate_transfer**2 @ weight)
    c, s = math.cos(mean), math.sin(mean)
    near = np.cos(theta) ** 2
    slope = s * ((1.0 + c * c) * near - 1.0) / (1.0 - s * s * near) ** 2
    here = _transfer(np.asarray(mean), theta)[1]
    return RandomSpeed(
        mean=speed * average,
        deviation=np.sqrt(variance),
        small=np.hypot(speed * slope * deviation, here * rate_deviation),
    )


def rate_deviation(frequency: ArrayLike, density: ArrayLike) -> float:
    """Return the standard deviation of the rate of a process with a one-sided spectrum, √∫Ω² S dΩ.

    frequency (m,) [rad/s]: corners of the spectrum, rising.
    density (m,) [unit²·s/rad]: one-sided density there, linear between.
    """
    return math.sqrt(spectra.rate_variance(frequency, density))


def sideband_gain(mean: float) -> float:
    """Return κ = tan(ᾱ/2)/cos²(ᾱ/2), the amplitude by which the lead of a joint grows with its bend.

    κ = dτ/dα with the lead τ sin 2θ + …, τ = tan²(α/2); about ᾱ/2 for small bends.
    """
    half = 0.5 * mean
    return math.tan(half) / math.cos(half) ** 2


def sidebands(at: ArrayLike, *, mean: float, frequency: ArrayLike, density: ArrayLike, speed: float) -> Array:
    """Return the two-sided spectrum of the random part of the driven angle φ_2.

    at (...) [rad/s]: frequencies, of either sign; mean [rad]: ᾱ.
    frequency (m,) [rad/s]: corners of the one-sided spectrum of the joint angle, rising; density (m,) [rad²·s/rad].
    speed [rad/s]: ω_1.
    Returns (...) [rad²·s/rad].
    S(Ω) = κ²/4 [S_α(Ω - 2ω_1) + S_α(Ω + 2ω_1)] with the two-sided S_α, the start phase being uniform; variance
    κ² σ_α²/2. To first order in the deviation of the joint angle; the higher orders 4ω_1 … are smaller by τ.
    """
    omega = np.asarray(at, dtype=float)
    both = spectra.two_sided(frequency, density, omega - 2.0 * speed) + spectra.two_sided(
        frequency, density, omega + 2.0 * speed
    )
    result: Array = 0.25 * sideband_gain(mean) ** 2 * both
    return result


def random_joint_angle_path(
    times: ArrayLike, *, mean: float, frequency: ArrayLike, density: ArrayLike, seed: int, components: int | None = None
) -> Jet:
    """Return one sample path of a random bend: α, α', α'' arrays (t,) [rad, rad/s, rad/s²].

    times (t,) [s]; mean [rad]: ᾱ; frequency (m,) [rad/s]: corners of the one-sided spectrum, rising.
    density (m,) [rad²·s/rad]: the spectrum there; seed: the same seed gives the same path.
    components: number of cosines; enough not to repeat within the times by default.
    """
    at = np.atleast_1d(np.asarray(times, dtype=float))
    count = components or spectra.enough_components(frequency, float(at[-1] - at[0]))
    path = spectra.sample_path(frequency, density, at, seed=seed, components=count)
    return plus((np.full(at.shape, mean), np.zeros(at.shape), np.zeros(at.shape)), path)


def _transfer(joint_angle: Array, theta: Array) -> tuple[Array, Array]:
    """Return A and B of ω_2 = A ω_1 + B α', Book (97)."""
    c, s = np.cos(joint_angle), np.sin(joint_angle)
    d = 1.0 - (s * np.cos(theta)) ** 2
    return c / d, 0.5 * s * np.sin(2.0 * theta) / d


def _problems(mean: float, deviation: float, rate: float, nodes: int) -> list[Problem]:
    found = []
    for name, value in (("deviation", deviation), ("rate_deviation", rate)):
        if not (math.isfinite(value) and value >= 0.0):
            found.append(Problem(name, _("{value} is not allowed; allowed is at least 0").format(value=f"{value:.6g}")))
    if nodes < 40:
        found.append(Problem("nodes", _("{nodes} nodes are too few; at least 40").format(nodes=nodes)))
    if not abs(mean) + REACH * abs(deviation) < 0.5 * math.pi:
        raise JointAngleLimitError(
            [
                *found,
                Problem(
                    "deviation",
                    _("mean {mean:.4g}° and six standard deviations of {deviation:.4g}° reach 90°").format(
                        mean=mean / deg, deviation=deviation / deg
                    ),
                ),
            ]
        )
    return found
