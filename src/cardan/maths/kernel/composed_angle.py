"""A driven yoke's angle by the coordinate that turns it, through any number of joints, from one pair of waves.

A chain of joints is kinematically one joint of speed fluctuation τ and phase ψ, so the angle F of every driven station
follows from sin 2q and cos 2q of its coordinate alone. Written on the array-API standard: one drive as plain numbers,
many as arrays or as lanes of a kernel.
"""

from __future__ import annotations

from cardan.maths.arrays import Array, namespace

from . import mobius


def equivalent(joint_angle: Array, phase: Array) -> tuple[Array, Array, Array]:
    """Return what joints in series come to: F_k = T(F_{k-1} + ψ_k; α_k) - T(ψ_k; α_k) from F_0 = q to the last.

    joint_angle, phase (..., m) [rad]: α_k and ψ_k of the joints.
    Returns tau, cosine, sine (...): τ and cos 2ψ, sin 2ψ of the one joint that turns like all of them.
    w → (w - τ)/(1 - τ w) at w = e^(2iθ); the zero of the product of the maps is e^(-2iψ) τ.
    """
    xp = namespace(joint_angle, phase)
    pair = mobius.compose(mobius.hooke(joint_angle[..., 0]), mobius.turn(phase[..., 0]))
    for k in range(1, joint_angle.shape[-1]):
        # Behind a joint angles count from its start again.
        begin = mobius.apply(pair, 1.0 + 0.0j)
        back = mobius.turn(-0.5 * xp.atan2(xp.imag(begin), xp.real(begin)))
        pair = mobius.compose(mobius.turn(phase[..., k]), mobius.compose(back, pair))
        pair = mobius.compose(mobius.hooke(joint_angle[..., k]), pair)
    a, b = pair
    tau = xp.abs(b) / xp.abs(a)
    straight = tau < 1e-300
    size = xp.where(straight, 1.0, xp.abs(a) * xp.abs(b))
    zero = -a * xp.conj(b) / size
    return tau, xp.where(straight, 1.0, xp.real(zero)), xp.where(straight, 0.0, xp.imag(zero))


def angle_error(cosine: Array, sine: Array, tau: Array) -> Array:
    """Return how far the driven side runs ahead at θ, cos 2θ and sin 2θ given: arg(1 - τ e^(-2iθ))."""
    xp = namespace(cosine, sine)
    return xp.atan2(tau * sine, 1.0 - tau * cosine)


def waves(cosine: Array, sine: Array, cosine_phase: Array, sine_phase: Array) -> tuple[Array, Array]:
    """Return cos 2θ and sin 2θ of θ = q + ψ."""
    return cosine * cosine_phase - sine * sine_phase, sine * cosine_phase + cosine * sine_phase


def slopes(cosine: Array, sine: Array, tau: Array) -> tuple[Array, Array, Array, Array]:
    """Return x, y of x + iy = 1 - τ e^(-2iθ) and F' = (1 - τ²)/(x² + y²), F'' = -4 y F'/(x² + y²)."""
    x, y = 1.0 - tau * cosine, tau * sine
    below = 1.0 / (x * x + y * y)
    first = (1.0 - tau * tau) * below
    return x, y, first, -4.0 * y * first * below
