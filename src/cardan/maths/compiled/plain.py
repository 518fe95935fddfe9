"""What the kernels compute, as array expressions: their reference, and what serves where numba is missing."""

from __future__ import annotations

from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius


def traces(pair: mobius.Pair, angle: Array, speed: Array, acceleration: Array, w: Array) -> tuple[Array, Array, Array]:
    """Return output angle, speed ratio and output acceleration of chains over the input angle.

    pair (...): Möbius pair of each chain; angle (p,) [rad]: input angle φ; speed (...) [rad/s]: ω_1.
    acceleration (...) [rad/s²]: ε_1; w (p,), complex: e^(2iφ), shared by all chains.
    Returns output_angle, ratio, acceleration (..., p).
    """
    a, b = (part[..., None] for part in pair)
    begin = mobius.angle_error((a, b), 1.0 + 0.0 * w[:1])
    angle_error, ratio, slope = mobius.course((a, b), w)
    return angle + (angle_error - begin), ratio, acceleration[..., None] * ratio + speed[..., None] ** 2 * slope


def extremes(pair: mobius.Pair) -> tuple[Array, Array, Array, Array, Array, Array]:
    """Return what a chain reaches over a turn, without positions.

    pair (...): Möbius pair of each chain.
    Returns speed_fluctuation, tau, joint_angle, phase, ratio_max, max_acceleration (...): δ, τ, α_eq [rad], ψ_eq in
    [0, π] [rad], i_max, max |ε|/ω_1².
    δ = 4 |a||b|, τ = |b|/|a|, α_eq = 2 atan √τ, i_max = (|a| + |b|)² = 1/c. The acceleration is
    that of Book Table 4 with sin² α_eq = δ c, which loses nothing for small joint angles, nor, by 1-x and 1-k x without
    differences, for steep ones.
    """
    a, b = pair
    xp = namespace(a)
    far, near = xp.abs(a), xp.abs(b)
    speed_fluctuation = 4.0 * far * near
    tau = near / far
    ratio_max = (far + near) ** 2
    phase = mobius.phase(pair)
    c = 1.0 / ratio_max
    square = speed_fluctuation * c
    size = 1.0 + c * c
    k = square / size
    root = xp.sqrt(1.0 + 8.0 * k * k)
    x, short = 4.0 * k / (1.0 + root), 4.0 * c * c / (size * (1.0 + 2.0 * k + root))
    steepest = 4.0 * c * square * xp.sqrt(short * (1.0 + x)) / (2.0 * c * c + size * k * short) ** 2
    return (
        speed_fluctuation,
        tau,
        2.0 * xp.atan(xp.sqrt(tau)),
        xp.where(phase < 0.0, phase + xp.pi, phase),
        ratio_max,
        steepest,
    )
