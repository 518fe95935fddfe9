"""How does a joint turn while its joint angle changes? Closed forms for shafts that stay in one plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.errors import JointAngleLimitError, Problem, check
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves import paths
from cardan.maths.curves.paths import Jet
from cardan.questions.motion.moving_chain import moving_axes
from cardan.texts import _
from cardan.units import deg


@dataclass(frozen=True, eq=False, kw_only=True)
class VaryingJointAngle:
    """Motion of the driven shaft of one or more joints with varying bends."""

    # joint_angle, joint_angle_rate, joint_angle_acceleration (...) or (..., n) [rad, rad/s, rad/s²]: α, α', α''
    joint_angle: Array
    joint_angle_rate: Array  # (...) or (..., n) [rad/s]
    joint_angle_acceleration: Array  # (...) or (..., n) [rad/s²]
    angle: Array  # (...) [rad]: φ_1 of the input shaft
    driven_speed: Array  # driven_speed, driven_acceleration (...) [rad/s, rad/s²]: ω and ε of the last shaft
    driven_acceleration: Array  # (...) [rad/s²]


def driven_motion(
    joint_angle: Jet, yoke_rotation: ArrayLike, *, speed: ArrayLike, acceleration: ArrayLike = 0.0
) -> tuple[Array, Array]:
    """Return speed and acceleration of the driven shaft of one joint while its joint angle changes, exactly.

    joint_angle (...) [rad, rad/s, rad/s²]: α, α', α''; the plane of the two shafts does not turn.
    yoke_rotation (...) [rad]: θ, angle of the driving yoke from that plane.
    speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1.
    Returns driven_speed, driven_acceleration (...) [rad/s, rad/s²].

    With c = cos α, s = sin α, D = 1 - s² cos²θ: ω_2 = (c ω_1 + ½ s sin 2θ α')/D, Book (97), and
    ε_2 = [c D ε_1 + ½ s D sin 2θ α'' - c s² sin 2θ ω_1² + 2 s (c² cos²θ - sin²θ) ω_1 α'
    + ½ c (1 + s² cos²θ) sin 2θ α'²]/D², Book (98) with the terms it drops.
    """
    xp = namespace(*joint_angle, yoke_rotation)
    alpha, rate, curve = (real(part, xp) for part in joint_angle)
    theta = real(yoke_rotation, xp)
    omega, epsilon = real(speed, xp), real(acceleration, xp)
    c, s = xp.cos(alpha), xp.sin(alpha)
    near, far = xp.cos(theta) ** 2, xp.sin(theta) ** 2
    double = xp.sin(2.0 * theta)
    d = 1.0 - s * s * near
    driven_speed = (c * omega + 0.5 * s * double * rate) / d
    driven_acceleration = (
        d * (c * epsilon + 0.5 * s * double * curve)
        - c * s * s * double * omega**2
        + 2.0 * s * (c * c * near - far) * omega * rate
        + 0.5 * c * (1.0 + s * s * near) * double * rate**2
    ) / d**2
    return driven_speed, driven_acceleration


def planar_chain(
    joint_angles: Jet,
    angle: ArrayLike,
    *,
    yoke_angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
    start_phase: float = 0.0,
) -> VaryingJointAngle:
    """Return speed and acceleration of the output of a planar drive while its joint angles change, exactly.

    joint_angles (..., n) [rad, rad/s, rad/s²]: bends of the joints, negative ones the other way: all of one sign is a
    W-arrangement (β = 0), signs in turn a Z-arrangement.
    angle (...) [rad]: φ_1; yoke_angle (n-1,) [rad]: γ_2 … γ_n; speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1.
    start_phase [rad]: ψ_1.
    The general method of `moving_axes` on axes that turn in one plane; input axis along x, plane normal y.
    """
    alpha, rate, curve = (np.asarray(part, dtype=float) for part in joint_angles)
    phi = np.asarray(angle, dtype=float)

    def summed(part: Array) -> Array:
        return np.concatenate((np.zeros((*part.shape[:-1], 1)), np.cumsum(part, axis=-1)), axis=-1)

    tilt, tilt_rate, tilt_curve = summed(alpha), summed(rate), summed(curve)
    cosine, sine, zero = np.cos(tilt), np.sin(tilt), np.zeros_like(tilt)
    along = np.stack((cosine, zero, -sine), axis=-1)
    across = np.stack((-sine, zero, -cosine), axis=-1)
    axes = (along, tilt_rate[..., None] * across, tilt_curve[..., None] * across - tilt_rate[..., None] ** 2 * along)
    theta = phi + start_phase
    arm = np.stack((np.zeros_like(theta), np.sin(theta), -np.cos(theta)), axis=-1)
    spins = moving_axes(axes, arm, yoke_angle=yoke_angle, speed=speed, acceleration=acceleration)
    return VaryingJointAngle(
        joint_angle=alpha,
        joint_angle_rate=rate,
        joint_angle_acceleration=curve,
        angle=phi,
        driven_speed=spins.spin[..., -1],
        driven_acceleration=spins.spin_acceleration[..., -1],
    )


def swinging_joint(
    times: ArrayLike,
    *,
    mean: float,
    amplitude: float,
    frequency: float,
    phase: float = 0.0,
    speed: float,
    acceleration: float = 0.0,
    start_phase: float = 0.0,
) -> VaryingJointAngle:
    """Return the motion of one joint whose joint angle oscillates harmonically, the plane of the shafts at rest.

    Parameters
    ----------
    times : array (t,) or float [s]
        Instants.
    mean, amplitude : float [rad]
        α(t) = mean + amplitude · sin(frequency · t + phase).
    frequency, phase : float [rad/s, rad]
        Of the swing.
    speed, acceleration : float [rad/s, rad/s²]
        ω_1 at time zero and ε_1; φ_1 = ω_1 t + ½ ε_1 t².
    start_phase : float [rad]
        ψ_1.

    Returns
    -------
    VaryingJointAngle

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = swinging_joint(0.0137, mean=12 * deg, amplitude=4 * deg, frequency=40.0, speed=150.0)
    >>> round(float(found.driven_speed), 6)
    147.140135
    """
    at = np.asarray(times, dtype=float)
    joint_angle = paths.plus(paths.resting(np.asarray(mean)), paths.swing(amplitude, frequency, phase, at))
    angle = speed * at + 0.5 * acceleration * at**2
    omega = speed + acceleration * at
    driven = driven_motion(joint_angle, angle + start_phase, speed=omega, acceleration=acceleration)
    return VaryingJointAngle(
        joint_angle=joint_angle[0],
        joint_angle_rate=joint_angle[1],
        joint_angle_acceleration=joint_angle[2],
        angle=angle,
        driven_speed=driven[0],
        driven_acceleration=driven[1],
    )


def swinging_chain(
    times: ArrayLike,
    *,
    mean: ArrayLike,
    amplitude: ArrayLike,
    frequency: float,
    phase: ArrayLike = 0.0,
    yoke_angle: ArrayLike,
    speed: float,
) -> VaryingJointAngle:
    """Return the output motion of a planar drive whose joint angles swing harmonically.

    Parameters
    ----------
    times : array (t,) or float [s]
        Instants.
    mean, amplitude : array (n,) [rad]
        α_i(t) = mean_i + amplitude_i · sin(frequency · t + phase_i); signs as in `planar_chain`.
    frequency : float [rad/s]
        Of the swing.
    phase : float or array (n,) [rad]
        A quarter turn makes the sine a cosine.
    yoke_angle : array (n-1,) [rad]
        γ_2 … γ_n.
    speed : float [rad/s]
        ω_1; φ_1 = ω_1 t.

    Returns
    -------
    VaryingJointAngle

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = swinging_chain(
    ...     0.0123, mean=[15 * deg, 12 * deg], amplitude=[5 * deg, 3 * deg], frequency=60.0, phase=[0.0, np.pi / 2],
    ...     yoke_angle=[0.0], speed=100.0,
    ... )
    >>> round(float(found.driven_speed), 6), round(float(found.driven_acceleration), 4)
    (98.92662, -547.0246)
    """
    at = np.asarray(times, dtype=float)
    middle = np.asarray(mean, dtype=float)
    size, shift = np.asarray(amplitude, dtype=float), np.broadcast_to(np.asarray(phase, dtype=float), middle.shape)
    joint_angles = paths.plus(paths.resting(middle), paths.swing(size, frequency, shift, at))
    return planar_chain(joint_angles, speed * at, yoke_angle=yoke_angle, speed=speed)


# How does a joint turn while its angle varies at random? The angle is normal and stationary, the plane at rest.

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
    return math.sqrt(paths.rate_variance(frequency, density))


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
        text = _("mean {mean:.4g}° and six standard deviations of {deviation:.4g}° reach 90°")
        message = text.format(mean=mean / deg, deviation=deviation / deg)
        raise JointAngleLimitError([*found, Problem("deviation", message)])
    return found
