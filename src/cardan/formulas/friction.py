"""What does friction in one joint, in a spline and in branches take? Exact work of a turn, and rules beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from cardan.drive.models.dynamics_model import FIT
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.cycle_statistics import mean_between
from cardan.maths.kernel.elliptic import complete
from cardan.texts import _


class Turning(IntEnum):
    """Whether friction lets a drive turn."""

    FREE = 0
    LOCKED = 1


def reduced_friction(material: ArrayLike, *, fit: str = "new") -> Array:
    """Return the reduced coefficient of friction of plain journals from that of the materials.

    Parameters
    ----------
    material : array (...)
        μ_0, coefficient of friction of the materials.
    fit : str
        ``new``, evenly pressed over half of the journal, or ``run_in``, pressed as a cosine.

    Returns
    -------
    array (...)

    Notes
    -----
    Friction moment over load times radius: for an even pressure μ_0 ∫dφ/∫cos φ dφ = (π/2) μ_0, for a cosine
    μ_0 ∫cos φ dφ/∫cos² φ dφ = (4/π) μ_0. Not for needle bearings: there the maker's figure counts.

    Examples
    --------
    >>> print(reduced_friction(0.1), reduced_friction(0.1, fit="run_in"))
    0.15707963 0.12732395
    """
    if fit not in FIT:
        raise refuse("fit", _("{value} is none of {choices}").format(value=repr(fit), choices=", ".join(FIT)))
    return FIT[fit] * real(material, namespace(material))


SEAL = 7.69e-6 * 1e6 * 30.0 / math.pi
"""Friction torque of a lip seal over the square of the shaft's diameter [N/m]: 7.69e-6 W/(mm² rpm)."""


def seal_friction(diameter: ArrayLike) -> Array:
    """Return the friction torque of rotary shaft lip seals.

    Parameters
    ----------
    diameter : array (...) [m]
        d, of the shaft under the lip.

    Returns
    -------
    array (...) [N·m]

    Notes
    -----
    ISO/TR 14179-2: P = 7.69e-6 d² n in W, with d in mm and n in rpm, so that the torque is the same at every speed. A
    guide value for one run-in lip in oil: rubber, lubricant, temperature and a dust lip change it by half and more.

    Examples
    --------
    >>> from cardan.units import mm, rpm
    >>> torque = seal_friction(40 * mm)
    >>> print(f"{torque:.4f} N·m, {torque * 1500 * rpm:.2f} W")
    0.1175 N·m, 18.46 W
    """
    d = real(diameter, namespace(diameter))
    return SEAL * d * d


def swings(sine: Array, cosine: Array, joint_angle: Array) -> tuple[Array, Array]:
    """Return how steeply a joint leans on its journals: tan of the cross's angle from both of its shafts.

    sine, cosine (...): sin θ, cos θ of the joint angle, or any common multiple of both; joint_angle (...) [rad]: α.
    Returns driving, driven (...): tan α |sin θ| on the side of the driving shaft, |sin α cos θ|/√(1 - sin²α cos²θ) on
    that of the driven. κ times them is the share of the torque that the friction of the driven yoke's pins takes from
    the driving shaft, and that of the driving yoke's pins from the driven shaft.
    """
    xp = namespace(sine, cosine, joint_angle)
    c = xp.cos(joint_angle)
    size = xp.sqrt(sine * sine + cosine * cosine)
    rest = xp.sqrt(sine * sine + (c * cosine) ** 2)
    return xp.tan(joint_angle) * xp.abs(sine) / size, xp.sin(joint_angle) * xp.abs(cosine) / rest


@dataclass(frozen=True, eq=False, kw_only=True)
class JointFriction:
    """What friction takes in single joints over a turn; leading axes are those of joint angles and coefficients."""

    # (...): A_2/M, work of a turn in all four journals over the constant torque, friction not acting on itself
    pin_work: Array
    # driving_pin_work, driven_pin_work (...): its two parts: journals in the driving and in the driven yoke
    driving_pin_work: Array
    driven_pin_work: Array  # (...)
    bearing_work: Array  # (...): (A_1 + A_3)/M, work of a turn in the shafts' bearings
    first_order: Array  # (...): η with both works
    small_angle: Array  # (...): η of Book (137), journals alone
    exact: Array  # (...): η of the journals alone, friction acting on itself; nan where the joint locks
    mean_pin_load: Array  # (...): mean load of a journal in the plane of the cross, times span over torque
    status: Array  # (...) of int: `Turning`


def joint_friction(
    joint_angle: ArrayLike, drag: ArrayLike, *, bearing_drag: ArrayLike = 0.0, torque_at: str = "output"
) -> JointFriction:
    """Return what friction takes in single joints over a turn, exactly.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2).
    drag : array (...)
        κ = μ d_c/d of the journals: reduced coefficient times diameter over span.
    bearing_drag : array (...)
        μ_1 d_1/a_1, the same of the bearings of each shaft, a_1 their distance; both shafts alike.
    torque_at : str
        Where the torque is constant, ``output`` or ``input``.

    Returns
    -------
    JointFriction

    Notes
    -----
    Book (128)-(137), restored by integration. With Λ = tan α + artanh(sin α): A_2 = 4 κ M Λ whichever torque is
    constant, A_1 + A_3 = 4 (μ_1 d_1/a_1) M Λ; η = 1/(1 + A/(2π M)) at constant output torque, 1 - A/(2π M) at constant
    input torque. Mean journal load (2/π) K(sin²α) or (2/π) E(sin²α)/cos α. A joint locks where κ tan α ≥ 1.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = joint_friction(30 * deg, 0.02)
    >>> print(found.exact, found.first_order, found.small_angle)
    0.985753829 0.985857835 0.986666667
    """
    xp = namespace(joint_angle, drag, bearing_drag)
    alpha, kappa, bearings = (real(one, xp) for one in (joint_angle, drag, bearing_drag))
    alpha, kappa, bearings = xp.broadcast_arrays(alpha, kappa, bearings)
    tangent, logarithm = xp.tan(alpha), xp.atanh(xp.sin(alpha))
    first, second = complete(alpha)
    if torque_at == "output":
        driving, driven = 4.0 * kappa * tangent, 4.0 * kappa * logarithm
        load = 2.0 / xp.pi * first
    else:
        driving, driven = 4.0 * kappa * logarithm, 4.0 * kappa * tangent
        load = 2.0 / xp.pi * second / xp.cos(alpha)
    shape = tangent + logarithm
    pins, held = 4.0 * kappa * shape, 4.0 * bearings * shape
    share = (pins + held) / (2.0 * xp.pi)
    locked = kappa * tangent >= 1.0
    return JointFriction(
        pin_work=pins,
        driving_pin_work=driving,
        driven_pin_work=driven,
        bearing_work=held,
        first_order=1.0 / (1.0 + share) if torque_at == "output" else 1.0 - share,
        small_angle=1.0 - 4.0 / xp.pi * kappa * alpha,
        exact=_exact(alpha, xp.where(locked, xp.full_like(kappa, xp.nan), kappa), torque_at),
        mean_pin_load=load,
        status=xp.astype(locked, xp.int64),
    )


def _exact(joint_angle: Array, drag: Array, torque_at: str) -> Array:
    """Return 2π/∮ i/η dφ at constant output torque, ∮ η dφ/2π at constant input torque, by what is lost of 1."""
    xp = namespace(joint_angle, drag)
    alpha, kappa, c = joint_angle[..., None], drag[..., None], xp.cos(joint_angle)[..., None]

    def lost(angle: Array) -> Array:
        sine, cosine = xp.sin(angle), xp.cos(angle)
        driving, driven = swings(sine, cosine, alpha)
        share = kappa * (driving + driven)
        if torque_at == "input":
            return (share / (1.0 + kappa * driving))[..., None, :]
        ratio = c / (sine * sine + (c * cosine) ** 2)
        return (ratio * share / (1.0 - kappa * driven))[..., None, :]

    kinks = xp.stack((0.0 * drag, 0.0 * drag + 0.5 * xp.pi), axis=-1)
    mean = mean_between(lost, kinks, period=xp.pi)[..., 0]
    return 1.0 - mean if torque_at == "input" else 1.0 / (1.0 + mean)


def spline_efficiency(
    friction: ArrayLike, stroke: ArrayLike, strokes: ArrayLike, diameter: ArrayLike, turns: ArrayLike
) -> Array:
    """Return the efficiency of a spline that slides under torque.

    Parameters
    ----------
    friction : array (...)
        μ of the teeth.
    stroke : array (...) [m]
        Mean way of one displacement, one way.
    strokes : array (...) [1/s]
        Displacements a second.
    diameter : array (...) [m]
        Mean diameter of the spline.
    turns : array (...) [1/s]
        Turns of the shaft a second.

    Returns
    -------
    array (...)
        Zero or less where friction would take all.

    Notes
    -----
    1 - μ Δl N_l/(π D N): friction force 2μM/D times the way slid, over the work of the torque; Book (138), restored.

    Examples
    --------
    >>> print(spline_efficiency(0.1, 0.03, 2.0, 0.05, 20.0))
    0.99809014
    """
    xp = namespace(friction, stroke, strokes, diameter, turns)
    mu, way, often, wide, fast = (real(one, xp) for one in (friction, stroke, strokes, diameter, turns))
    return 1.0 - mu * way * often / (xp.pi * wide * fast)


def branch_efficiency(work: ArrayLike, efficiency: ArrayLike, *, given: str = "useful") -> Array:
    """Return the efficiency of parallel branches.

    Parameters
    ----------
    work : array (..., branches) [J]
        Work of each branch, in any one unit.
    efficiency : array (..., branches)
        η of each branch.
    given : str
        Which work: ``useful``, at the outputs, or ``input``.

    Returns
    -------
    array (...)

    Notes
    -----
    Σ A/Σ (A/η) with useful works, Book (140); Σ A η/Σ A with input works.

    Examples
    --------
    >>> print(branch_efficiency([1000.0, 3000.0], [0.95, 0.9]))
    0.912
    """
    xp = namespace(work, efficiency)
    share, eta = real(work, xp), real(efficiency, xp)
    if given == "input":
        return xp.sum(share * eta, axis=-1) / xp.sum(share, axis=-1)
    return xp.sum(share, axis=-1) / xp.sum(share / eta, axis=-1)
