"""What eight drives with joints do at one moment: formulas of the balance of torques and of its slopes.

As in `model.torsional_balance`, one station, element or torque at a time. Angles are held as what they are
ahead of the even rotation φ. Written on the array-API standard; a kernel applies them to registers.
"""

from __future__ import annotations

from typing import Any

from .approximations import argument_right, cosine, sine, within_half_turn


def joint(
    ahead: Any, f1: Any, f2: Any, f3: Any, psi: Any, start: Any, tau: Any, cos: Any, square: Any, phi: Any
) -> tuple[Any, Any, Any, Any]:
    """Return angle ahead of φ and its three derivatives of a driven yoke, from those of its driving yoke.

    ``psi`` and ``start`` are the phase of the joint and the lead of the driven yoke there, ``tau`` tan²(α/2), ``cos``
    and ``square`` cos α and sin²α.
    """
    turn = within_half_turn(ahead + psi + phi)
    s, c = sine(turn), cosine(turn)
    s2, c2 = 2.0 * s * c, 1.0 - 2.0 * s * s
    angle_error = argument_right(tau * s2, 1.0 - tau * c2)
    below = 1.0 / (1.0 - square * c * c)
    t1 = cos * below
    bent = square * below
    t2 = -(t1 * bent * s2)
    t3 = 2.0 * t1 * bent * (bent * s2 * s2 - c2)
    return (
        ahead + angle_error - start,
        t1 * f1,
        t2 * f1 * f1 + t1 * f2,
        t3 * f1 * f1 * f1 + 3.0 * t2 * f1 * f2 + t1 * f3,
    )


def element(
    ahead_a: Any, ahead_b: Any, speed_a: Any, speed_b: Any, rest: Any, c: Any, b: Any, on_a: Any, on_b: Any
) -> tuple[Any, Any]:
    """Return the torques on both stations of an element with its own added."""
    torque = c * (ahead_a - ahead_b - rest) + b * (speed_a - speed_b)
    return on_a - torque, on_b + torque


def speed(f1: Any, rate: Any, ground: Any) -> tuple[Any, Any]:
    """Return the speed of a station, and the torque of its damping to the ground."""
    found = f1 * rate
    return found, -(ground * found)


def constant(on: Any, value: Any) -> tuple[Any]:
    """Return the torque on a station with a constant one added."""
    return (on + value,)


def falling(on: Any, across: Any, turning: Any, standstill: Any, slope: Any) -> tuple[Any, Any]:
    """Return torque and slope by speed with those of M0 - slope·Ḟ added."""
    return on + (standstill - slope * turning), across - slope


def swinging(on: Any, along: Any, ahead: Any, amplitude: Any, phase: Any, half_order: Any, phi: Any) -> tuple[Any, Any]:
    """Return torque and slope by angle with those of a sin(order·F + phase) added."""
    half = within_half_turn(half_order * (ahead + phi) + 0.5 * phase)
    s, c = sine(half), cosine(half)
    return on + amplitude * (2.0 * s * c), along + 2.0 * half_order * amplitude * (1.0 - 2.0 * s * s)


def asynchronous(
    on: Any, across: Any, turning: Any, synchronous: Any, pullout: Any, joint_angle: Any
) -> tuple[Any, Any]:
    """Return torque and slope by speed with those of Kloss's formula added; ``joint_angle`` is the pull-out slip."""
    slip = 1.0 - turning / synchronous
    size = slip * slip + joint_angle * joint_angle
    scale = 2.0 * pullout * joint_angle / size
    return on + scale * slip, across - scale * (joint_angle * joint_angle - slip * slip) / (size * synchronous)


def gather(
    mass: Any,
    left: Any,
    damping: Any,
    stiffness: Any,
    inertia: Any,
    f1: Any,
    f2: Any,
    f3: Any,
    on: Any,
    along: Any,
    across: Any,
    ground: Any,
    rate: Any,
    joint_angle: Any,
) -> tuple[Any, Any, Any, Any]:
    """Return mass, balance, damping and stiffness of a coordinate with those of one station added."""
    heavy, drag = inertia * f1, ground - across
    swing = heavy * f2 * rate
    return (
        mass + heavy * f1,
        left + heavy * f1 * joint_angle + swing * rate - f1 * on,
        damping + 2.0 * swing + f1 * f1 * drag,
        stiffness
        + 2.0 * heavy * f2 * joint_angle
        + inertia * (f2 * f2 + f1 * f3) * rate * rate
        - f2 * on
        + f1 * f2 * rate * drag
        - f1 * f1 * along,
    )


def couple(
    damping: Any, stiffness: Any, first: Any, other: Any, other_joint_angle: Any, rate: Any, c: Any, b: Any, sign: Any
) -> tuple[Any, Any]:
    """Return damping and stiffness between two coordinates with those of an element added; ``sign`` is -1 across it."""
    lever = sign * first
    return damping + b * lever * other, stiffness + lever * (c * other + b * other_joint_angle * rate)
