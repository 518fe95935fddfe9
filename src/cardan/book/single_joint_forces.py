"""Forces of one joint between two shafts in closed form, without masses: cross that slides, cross that is located."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.kernel.elliptic import complete


@dataclass(frozen=True, eq=False, kw_only=True)
class SingleJointForces:
    """Sizes of torques and forces of one joint at constant torque of the driven shaft."""

    ratio: Array  # (...): ω_2/ω_1
    driving_torque: Array  # (...) [N·m]: M_1
    journal: Array  # (...) [N]: load of each journal in the plane of the cross, by the torque
    # driving_across, driving_along (...) [N]: its parts across and in the plane of the driving yoke
    driving_across: Array
    driving_along: Array  # (...) [N]
    driven_across: Array  # driven_across, driven_along (...) [N]: its parts across and in the plane of the driven yoke
    driven_along: Array  # (...) [N]
    driving_couple: Array  # driving_couple, driven_couple (...) [N·m]: secondary couples on shafts 1 and 2
    driven_couple: Array  # (...) [N·m]
    near: Array  # near, far (...) [N]: radial load of the bearings of shaft 1 near to and far from the joint
    far: Array  # (...) [N]
    axial: Array  # (...) [N]: axial load of shaft 1
    driven_bearing: Array  # (...) [N]: radial load of each bearing of shaft 2, or of its only one


@dataclass(frozen=True, eq=False, kw_only=True)
class SingleJointPeaks:
    """Largest values over a turn, for a constant torque of one at the driven or at the driving shaft."""

    driving_couple: Array  # driving_couple, driven_couple (...): secondary couples over the constant torque
    driven_couple: Array  # (...)
    # journal, journal_mean (...): load of a journal times the span, over the constant torque: its largest and its mean
    journal: Array
    journal_mean: Array  # (...)


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossLoads:
    """Sizes of what the cross of one joint passes on, arrays (..., p), and their largest over a turn, arrays (...)."""

    journal: Array  # (..., p) [N]: load of each of the four journals
    # driving_couple, driven_couple (..., p) [N·m]: secondary couples on the driving and on the driven shaft
    driving_couple: Array
    driven_couple: Array  # (..., p) [N·m]
    journal_max: Array  # journal_max, driving_couple_max, driven_couple_max (...): largest over a turn
    driving_couple_max: Array  # (...)
    driven_couple_max: Array  # (...)


def cross_loads(
    joint_angle: ArrayLike, angle: ArrayLike, torque: ArrayLike, *, span: ArrayLike, torque_at: str = "input"
) -> CrossLoads:
    """Return the load of the journals and the secondary couples of one joint, the torque constant on either shaft.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α in [0, π/2).
    angle : array (p,) [rad]
        θ, angle of the driving yoke from the plane of the joint.
    torque : array (...) [N·m]
        Size of the constant torque.
    span : array (...) [m]
        d of the cross.
    torque_at : str
        Shaft on which the torque is constant, ``input`` or ``output``.

    Notes
    -----
    With s = √(1 + tan² α sin² θ) the cross passes the couple N = M_1 s = M_2/(cos α s), its journals carry N/d, and
    the couples are M_1 tan α \\|sin θ\\| and M_1 sin α \\|cos θ\\| s; M_2 = M_1 cos α s², Book (100), (114).

    Examples
    --------
    >>> import math
    >>> found = cross_loads(math.radians(12), [0.0, math.pi / 2], 2000.0, span=0.09)
    >>> print(found.journal.round(3), f"{found.driving_couple_max:.3f}")
    [22222.222 22718.68 ] 425.113
    """
    xp = namespace(joint_angle, angle, torque, span)
    alpha, theta, load, d = (real(x, xp) for x in (joint_angle, angle, torque, span))
    most = single_joint_peaks(alpha, torque_at=torque_at)
    whole = xp.abs(load)
    wide = alpha[..., None]
    sine, cosine = xp.abs(xp.sin(theta)), xp.abs(xp.cos(theta))
    s = xp.sqrt(1.0 + (xp.tan(wide) * sine) ** 2)
    first = whole[..., None] if torque_at == "input" else whole[..., None] / (xp.cos(wide) * s * s)
    return CrossLoads(
        journal=first * s / d[..., None],
        driving_couple=first * xp.tan(wide) * sine,
        driven_couple=first * xp.sin(wide) * cosine * s,
        journal_max=whole * most.journal / d,
        driving_couple_max=whole * most.driving_couple,
        driven_couple_max=whole * most.driven_couple,
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class CoupleFrames:
    """Secondary couple on the shaft whose torque is constant, as it and its housing feel it, arrays (...) [N·m]."""

    rotating: Array  # (...): amplitude in the shaft, once a turn and fully reversed
    standing: Array  # (...): constant part in the housing, square to the plane of the joint
    double: Array  # (...): size of the part in the housing that turns at twice the speed


def couple_frames(joint_angle: ArrayLike, torque: ArrayLike) -> CoupleFrames:
    """Return the secondary couple of one joint in the frame of its shaft and in that of the housing.

    joint_angle (...) [rad]: α in [0, π/2); torque (...) [N·m]: M, constant on this shaft.
    M tan α sin θ along the arm of the shaft's own yoke: fatigue counts order 1, bearings and structure feel order 2.
    """
    xp = namespace(joint_angle, torque)
    rotating = xp.abs(real(torque, xp)) * xp.tan(real(joint_angle, xp))
    return CoupleFrames(rotating=rotating, standing=0.5 * rotating, double=0.5 * rotating)


def single_joint_forces(
    joint_angle: ArrayLike,
    angle: ArrayLike,
    torque: ArrayLike,
    *,
    span: ArrayLike,
    bearing_span: ArrayLike,
    overhang: ArrayLike,
    reach: ArrayLike,
    located: bool,
) -> SingleJointForces:
    """Return torques, journal loads and reactions of a single joint.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α.
    angle : array (...) [rad]
        θ, angle of the driving yoke from the plane of the joint.
    torque : array (...) [N·m]
        M_2, resisting the driven shaft.
    span : array (...) [m]
        d of the cross.
    bearing_span, overhang : arrays (...) [m]
        Distance of the bearings of shaft 1, and of the joint from the nearer one.
    reach : array (...) [m]
        Distance of the bearings of shaft 2; with a located cross, of its only bearing from the joint.
    located : bool
        Whether the cross is located along its journals and holds shaft 2 in the joint centre (Book Fig 67b), or
        slides along them (Fig 67a).

    Notes
    -----
    With t = tan α and w = √(1 + t² sin² θ): M_1 = M_2/(cos α w²) (100), load of a journal M_2/(d w cos α) (105), its
    parts (101)-(104), bearings of the sliding cross (106), (107), of the located one (108). Its force along v has the
    part M_2 t \\|cos θ\\|/(b_2 w²) across shaft 1 and M_2 t² \\|sin θ cos θ\\|/(b_2 w²) along it, as v is inclined to
    the plane across shaft 1 by arctan(t sin θ); Book (109)-(112) take α for that angle.

    Examples
    --------
    >>> import math
    >>> found = single_joint_forces(
    ...     math.pi / 6, math.radians(37), 1000.0, span=0.1, bearing_span=0.3, overhang=0.08, reach=0.4, located=True
    ... )
    >>> print(f"{found.near:.3f} {found.axial:.3f}")
    1766.737 357.380
    """
    xp = namespace(joint_angle, angle, torque, span, bearing_span, overhang, reach)
    alpha, theta, load, d, a, c, b = (
        real(x, xp) for x in (joint_angle, angle, torque, span, bearing_span, overhang, reach)
    )
    load = xp.abs(load)
    cosine, t = xp.cos(alpha), xp.tan(alpha)
    sin, cos = xp.abs(xp.sin(theta)), xp.abs(xp.cos(theta))
    w = xp.sqrt(1.0 + (t * sin) ** 2)
    ratio = 1.0 / (cosine * w * w)
    first, second = load * t * sin * ratio, load * t * cos / w
    radial, axial = first / a, 0.0 * first
    near = far = radial
    if located:
        pull = second / b
        side, axial = pull / w, pull * t * sin / w
        near = xp.sqrt(radial**2 + (side * (a + c) / a) ** 2)
        far = xp.sqrt(radial**2 + (side * c / a) ** 2)
    return SingleJointForces(
        ratio=ratio + 0.0 * load,
        driving_torque=load * ratio,
        journal=load / (d * w * cosine),
        driving_across=load * ratio / d,
        driving_along=first / d,
        driven_across=load / d + 0.0 * ratio,
        driven_along=second / d,
        driving_couple=first,
        driven_couple=second,
        near=near,
        far=far,
        axial=axial,
        driven_bearing=second / b,
    )


def single_joint_peaks(joint_angle: ArrayLike, *, torque_at: str = "output") -> SingleJointPeaks:
    """Return the largest secondary couples and journal loads over a turn, per unit of the constant torque.

    joint_angle (...) [rad]: α in [0, π/2); torque_at: where the torque is constant, ``output`` or ``input``.
    One couple peaks at tan α, the other at sin α up to 45° and at 1/(2 cos α) beyond. Mean journal load (2/π) K(m) at
    constant M_2, (2/π) E(m)/cos α at constant M_1, m = sin² α.
    """
    xp = namespace(joint_angle)
    alpha = real(joint_angle, xp)
    cosine = xp.cos(alpha)
    steep = xp.where(alpha > 0.25 * xp.pi, 0.5 / cosine, xp.sin(alpha))
    tangent = xp.tan(alpha)
    first, second = complete(alpha)
    at_input = torque_at == "input"
    return SingleJointPeaks(
        driving_couple=tangent if at_input else steep,
        driven_couple=steep if at_input else tangent,
        journal=1.0 / cosine,
        journal_mean=2.0 / xp.pi * (second / cosine if at_input else first),
    )
