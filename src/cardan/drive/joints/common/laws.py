"""Laws of motion that several kinds of joints share."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array, ArrayLike, complex_of, floats, namespace, unit_complex
from cardan.maths.kernel import frames, mobius
from cardan.texts import _
from cardan.units import mm

# Joints whose balls or tongue lie in one plane: exactly even where it halves the angle of the shafts, else nearly.
#
# A ball in the plane through the centre turns both shafts as one Hooke joint would. Let the normal of the plane stand
# at p = α/2 + η to shaft 1 and at q = α/2 - η to shaft 2. The ball's angles about the shafts, from the plane of the
# shafts, obey tan φ_2 = κ tan φ_1 with κ = cos p/cos q: the map of the circle with τ = -tan(α/2) tan η.


def _corners(joint_angle: Array, tilt: Array) -> tuple[Array, Array]:
    """Return cos p and cos q, nan where the plane holds a shaft, so that nothing turns."""
    xp = namespace(joint_angle, tilt)
    first, second = xp.cos(0.5 * joint_angle + tilt), xp.cos(0.5 * joint_angle - tilt)
    turns = (first > 0.0) & (second > 0.0)
    return xp.where(turns, first, xp.nan), xp.where(turns, second, xp.nan)


def tau(joint_angle: ArrayLike, tilt: ArrayLike) -> Array:
    """Return τ = -tan(α/2) tan η: tan²(α_eq/2) of the Hooke joint that turns alike, with a sign.

    joint_angle (...) [rad]: α in [0, π/2), angle between the shafts.
    tilt (...) [rad]: η: the normal of the plane stands at α/2 + η to shaft 1.
    Returns (...): positive where the driven shaft runs ahead first; nan where the plane holds a shaft, α/2 + |η| ≥
    90°.
    """
    alpha, eta = floats(joint_angle, tilt)
    xp = namespace(alpha, eta)
    first, _second = _corners(alpha, eta)
    found = -xp.tan(0.5 * alpha) * xp.tan(eta)
    return xp.where(xp.isnan(first), xp.nan, found)


def pair(joint_angle: ArrayLike, tilt: ArrayLike) -> mobius.Pair:
    """Return the map of the circle of one ball, its angle counted from the plane of the shafts.

    joint_angle (...) [rad]: α in [0, π/2); tilt (...) [rad]: η.
    Returns (...): nan where the plane holds a shaft.
    (cos(α/2) cos η, sin(α/2) sin η)/√(cos(α/2 + η) cos(α/2 - η)): the identity where either angle is 0.
    """
    alpha, eta = floats(joint_angle, tilt)
    xp = namespace(alpha, eta)
    first, second = _corners(alpha, eta)
    root = xp.sqrt(first * second)
    one = xp.cos(0.5 * alpha) * xp.cos(eta) / root
    other = xp.sin(0.5 * alpha) * xp.sin(eta) / root
    return xp.astype(one, xp.complex128), xp.astype(other, xp.complex128)


def deviation(angle: ArrayLike, joint_angle: ArrayLike, tilt: ArrayLike) -> Array:
    """Return how far shaft 2 runs ahead of shaft 1 with one ball, φ_2 - φ_1.

    angle (...) [rad]: φ_1, from the plane of the shafts; joint_angle (...) [rad]: α in [0, π/2); tilt (...) [rad]: η.
    Returns (...) [rad]: nan where the plane holds a shaft.
    arctan(τ sin 2φ_1/(1 - τ cos 2φ_1)), exact and right to the last digits for the smallest tilt.
    """
    phi, alpha, eta = floats(angle, joint_angle, tilt)
    xp = namespace(phi, alpha, eta)
    t = tau(alpha, eta)
    return xp.atan2(t * xp.sin(2.0 * phi), 1.0 - t * xp.cos(2.0 * phi)) + 0.0


def speed_fluctuation(joint_angle: ArrayLike, tilt: ArrayLike) -> Array:
    """Return δ = |κ - 1/κ| of one ball: largest less smallest speed ratio.

    joint_angle (...) [rad]: α in [0, π/2); tilt (...) [rad]: η.
    Returns (...): about 4 η tan(α/2); nan where the plane holds a shaft.
    sin α |sin 2η|/(cos(α/2 + η) cos(α/2 - η)), without a difference of near numbers.

    >>> from cardan.units import deg
    >>> print(speed_fluctuation(40 * deg, 0.5 * deg))
    0.01270540
    """
    alpha, eta = floats(joint_angle, tilt)
    xp = namespace(alpha, eta)
    first, second = _corners(alpha, eta)
    return xp.sin(alpha) * xp.abs(xp.sin(2.0 * eta)) / (first * second)


@dataclass(frozen=True, eq=False, kw_only=True)
class BallDemands:
    """What the balls of a joint ask of shaft 2 at one angle of shaft 1, φ_2 - φ_1 of each ball."""

    mean: Array  # (...) [rad]: what the output does, as all balls pull alike
    spread: Array  # (...) [rad]: largest less smallest; play or the give of the contacts takes it
    largest: Array  # (...) [rad]: largest in size


def ball_demands(angle: ArrayLike, joint_angle: ArrayLike, tilt: ArrayLike, count: int = 6) -> BallDemands:
    """Return what balls at equal angles in a plane that misses the bisecting one ask of shaft 2.

    angle (...) [rad]: φ_1 of the first ball, from the plane of the shafts; joint_angle (...) [rad]: α in [0, π/2).
    tilt (...) [rad]: η; count: n balls.
    A ball asks for Σ_k (τ^k/k) sin 2kφ; of the mean over N balls only the orders that N divides are left:
    (1/m) arctan(τ^m sin 2mφ/(1 - τ^m cos 2mφ)), m = N/2 for even N, N for odd N. Six balls leave τ³/3 of order 6.
    """
    phi, alpha, eta = floats(angle, joint_angle, tilt)
    xp = namespace(phi, alpha, eta)
    order = count // 2 if count % 2 == 0 else count
    power = tau(alpha, eta) ** order
    turn = 2.0 * order * phi
    mean = xp.atan2(power * xp.sin(turn), 1.0 - power * xp.cos(turn)) / order
    step = xp.arange(count, dtype=xp.float64) * (2.0 * xp.pi / count)
    each = deviation(phi[..., None] + step, alpha[..., None], eta[..., None])
    return BallDemands(
        mean=mean + 0.0, spread=xp.max(each, axis=-1) - xp.min(each, axis=-1), largest=xp.max(xp.abs(each), axis=-1)
    )


# Joints of two profiles that touch: the contact pushes along their common normal.


def contact_push(height: Array, out: Array, angle: Array, joint_angle: Array, slopes: tuple[Array, Array]) -> Array:
    """Return the force of a contact on the driven shaft over the torque of this, without friction.

    height, out (...) [m]: where it stands, along the driving shaft away from the joint and off its axis.
    angle, joint_angle (...) [rad]: θ of its meridian plane from that of the shafts, and α.
    slopes: directions of the driving and of the driven profile there, (..., 2): along their own shaft away from the
    joint, and off its axis.
    Returns (..., 3) [1/m]: F along the driving shaft e, N × e and N: along the normal n of both profiles, and
    (r × F)·e' = 1: F = n/((r × n)·e').
    """
    c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(joint_angle), np.sin(joint_angle)
    none = 0.0 * (c + ca + height)
    back, way = np.stack((none - 1.0, none, none), -1), np.stack((none, none + c, none + s), -1)
    after = np.stack((none + ca, none + sa, none), -1)
    place = height[..., None] * back + out[..., None] * way
    beyond = frames.unit(place - frames.dot(place, after)[..., None] * after)
    one, other = slopes
    first = one[..., :1] * back + one[..., 1:] * way
    second = other[..., :1] * after + other[..., 1:] * beyond
    normal = frames.cross(first, second)
    found: Array = normal / frames.dot(frames.cross(place, normal), after)[..., None]
    return found


TURN = 720
"""Places of a turn at which a contact is looked for."""

CLOSER = 4
"""How often the place where two profiles are nearest is looked at twenty times as closely."""

LEAP = 0.02
"""Turn [rad] of the driven shaft from one such place to the next that its speed does not tell: the contact leaps."""


def reached(course: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
    """Return a law of motion, not a number where the driven shaft would turn back.

    Touching profiles push on and on: where the ratio is negative the contact has passed a dead centre, through which
    nothing drives it.
    """
    xp = namespace(*course)
    back = course[1] <= 0.0
    one, two, three = (xp.where(back, xp.nan, part) for part in course)
    return one, two, three


def lost_contact(
    contact: Callable[[Array], tuple[Array, Array, Array]], missed: Callable[[Array], Array], joint_angle: float
) -> str:
    """Return in a sentence where a contact is lost within a turn, and by how much; "" where it goes round.

    contact: its law at angles (p,) [rad] of the driving mark; missed: by how much both profiles miss each other there,
    (p,) [m].
    """
    theta = np.arange(TURN) * (2.0 * np.pi / TURN)
    with np.errstate(invalid="ignore", divide="ignore"):
        lead, ratio, _slope = (np.asarray(one) for one in contact(theta))
    apart = ~np.isfinite(lead)
    if np.any(apart):
        gaps = missed(theta[apart])
        k = int(np.argmax(gaps))
        text = _(
            "with its driving mark {angle:.4g}° from the plane of the shafts both sides miss each other by {gap:.3g} mm"
        )
        return text.format(angle=math.degrees(theta[apart][k]), gap=gaps[k] / mm)
    step = np.diff(lead, append=lead[:1])
    leap = np.abs((step + np.pi) % (2.0 * np.pi) - np.pi - 0.5 * (ratio + np.roll(ratio, -1) - 2.0) * theta[1])
    k = int(np.argmax(leap))
    if leap[k] < LEAP and np.all(ratio > 0.0):
        return ""
    text = _(
        "with its driving mark {angle:.4g}° from the plane of the shafts the contact leaps: the driven shaft would "
        "have to turn by {leap:.3g}° at once"
    )
    far = math.degrees(abs((step[k] + np.pi) % (2.0 * np.pi) - np.pi))
    return text.format(angle=math.degrees(theta[k]), leap=far)


def nearest(far: Callable[[Array], Array], places: Array) -> Array:
    """Return the least distances (p,) of a profile: far of places (p, m) along it, looked at ever more closely."""
    found = far(places[None])
    places = np.broadcast_to(places, found.shape)
    for _round in range(CLOSER):
        k = np.clip(np.argmin(found, axis=-1), 1, places.shape[-1] - 2)[:, None]
        low, high = (np.take_along_axis(places, k + side, axis=-1) for side in (-1, 1))
        places = low + (high - low) * np.linspace(0.0, 1.0, 41)
        found = far(places)
    return np.asarray(np.min(found, axis=-1))


def beside(height: Array, out: Array, angle: Array, joint_angle: float) -> tuple[Array, Array]:
    """Return where a point of the driving shaft stands in the meridian plane of the driven one, along and off it [m].

    height, out (...) [m], angle (...) [rad]: as of `contact_push`.
    """
    c, s, ca, sa = np.cos(angle), np.sin(angle), math.cos(joint_angle), math.sin(joint_angle)
    return out * c * sa - height * ca, np.hypot(height * sa + out * c * ca, out * s)


# Joints whose links share the torque: each link would turn as a Hooke joint, all together turn by the mean of them.


def course(angle: Array, tau: Array, places: int) -> tuple[Array, Array, Array]:
    """Return how far links at equal angles run ahead together, with two derivatives.

    angle (...) [rad]: θ of the first link, from the plane of the shafts.
    tau (...): τ of the map of a single link, tan θ' = (1 + τ)/(1 - τ) tan θ.
    places: how many different places the links take within half a turn.
    Returns angle_error, ratio, slope (...) [rad, 1, 1/rad]: T - θ, T' and T''.
    A link asks for Σ τ^k sin(2kθ)/k; of the mean over N places only the orders that N divides are left,
    -arg(1 - τ^N e^(2iNθ))/N: the lead of one joint with τ^N, N times as fast and N times smaller.

    One place is a Hooke joint:

    >>> import numpy as np
    >>> angle_error, ratio, _slope = course(np.asarray(0.5), np.tan(0.2) ** 2, 1)
    >>> print(f"{angle_error:.9f} {np.tan(0.5 + angle_error) / np.tan(0.5) * np.cos(0.4):.9f} {ratio:.6f}")
    0.035347562 1.000000000 1.042857
    """
    xp = namespace(angle, tau)
    power = xp.asarray(tau, dtype=xp.float64) ** places
    root = xp.sqrt(1.0 - power * power)
    pair = complex_of(1.0 / root, xp), complex_of(-power / root, xp)
    angle_error, ratio, slope = mobius.course(pair, unit_complex(2.0 * places * angle))
    return angle_error / places, ratio, places * slope


def places(links: int) -> int:
    """Return how many different places links at equal angles take within half a turn: two opposite ones take one."""
    return links // 2 if links % 2 == 0 else links


# A law of motion known point by point: its derivatives by its harmonics.

NOISE = 1e-15  # harmonics below this [rad] are rounding; their derivatives would grow with the order


FADED = 1e-13
"""Harmonics [rad] of the upper half of the orders below which a law is told by its places."""


def faded(samples: Array) -> bool:
    """Tell whether leads at even places (p,) [rad] tell all harmonics of a law."""
    count = len(samples)
    upper = np.abs(np.fft.rfft(samples))[count // 4 :] * (2.0 / count)
    return bool(np.max(upper) < FADED)


def waved(angle: Array, samples: Array) -> tuple[Array, Array, Array]:
    """Return a smooth law of period 2π with two derivatives, given by its leads at even places of a turn.

    angle (...) [rad]: θ; samples (p,) [rad]: T - θ.
    Returns angle_error, ratio, slope (...) [rad, 1, 1/rad]: T - θ, T' and T''; nan where the law has none.
    """
    theta = np.asarray(angle, dtype=float)
    if not np.all(np.isfinite(samples)):
        nothing = theta + np.nan
        return nothing, nothing, nothing
    wave = np.fft.rfft(samples) / len(samples)
    wave[1:] *= 2.0
    orders = np.flatnonzero(np.abs(wave[: len(samples) // 2]) > NOISE)
    turn = np.exp(1j * theta[..., None] * orders)
    parts = wave[orders]
    return ((turn @ parts).real, 1.0 + (turn @ (1j * orders * parts)).real, (turn @ (-(orders**2) * parts)).real)
