"""Forces of one joint and of two in closed form, without masses, and what a rubbing spline does to them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.geometry import geometry_from_points, points_from_angles
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import frames
from cardan.maths.kernel.elliptic import complete
from cardan.questions.forces.kinetostatics import Couples, KinematicState, couples, standing


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


# Secondary couples of a double joint and the pair of forces with which its middle shaft loads its neighbours.


@dataclass(frozen=True, eq=False, kw_only=True)
class DoubleJointForces:
    """Couples and forces of a double joint at constant torque of its last shaft; axes (...) drives, then positions."""

    driving_torque: Array  # (..., p) [N·m]: M_1
    first_couple: Array  # (..., p) [N·m]: secondary couple on shaft 1
    # middle_first, middle_second (..., p) [N·m]: secondary couples on shaft 2, of joint 1 and of joint 2
    middle_first: Array
    middle_second: Array  # (..., p) [N·m]
    last_couple: Array  # (..., p) [N·m]: secondary couple on shaft 3
    middle_couple: Array  # (..., p) [N·m]: resultant on shaft 2
    # (..., p, 3) [N]: force N of joint 2 on shaft 2, and the opposite of joint 1, that balance the resultant
    pair: Array
    along_arm: Array  # along_arm, across_arm (..., p) [N]: size of its parts along and across the driven arm on shaft 2
    across_arm: Array  # (..., p) [N]
    first_axial: Array  # first_axial, last_axial (..., p) [N]: axial loads of shafts 1 and 3
    last_axial: Array  # (..., p) [N]

    @property
    def pair_force(self) -> Array:
        """Size of the pair of forces, array (..., p) [N]."""
        return frames.norm(self.pair)


def double_joint_forces(
    first: ArrayLike,
    second: ArrayLike,
    angle: ArrayLike,
    *,
    plane_twist: ArrayLike = 0.0,
    yoke_angle: ArrayLike = 0.0,
    torque: ArrayLike,
    length: ArrayLike,
) -> DoubleJointForces:
    """Return secondary couples and joint forces of a double joint, without masses.

    Parameters
    ----------
    first, second : float or array (...) [rad]
        Bends α_1 and α_2.
    angle : array (p,) [rad]
        θ_1, angle of the first driving yoke from the plane of joint 1.
    plane_twist, yoke_angle : float or array (...) [rad]
        β_2 and γ_2.
    torque : float or array (...) [N·m]
        M_3.
    length : float or array (...) [m]
        l_2.

    Notes
    -----
    Shafts 1 and 3 are located and a spline without friction lets shaft 2 slide, Book Fig 70. M_1 ω_1 = M_3 ω_3 (113);
    the couples on shaft 2 (114) add as vectors, (115) with their signs; N = S_2/l_2; axial loads are its parts along
    the end shafts, where Book (119) takes \\|N\\| sin α.

    Examples
    --------
    In the V arrangement the couples on the middle shaft add up, in the Z arrangement they cancel:

    >>> from cardan.units import deg
    >>> both = double_joint_forces(20 * deg, 20 * deg, [0.0], plane_twist=[0.0, np.pi], torque=100.0, length=0.7)
    >>> np.round(both.middle_couple[:, 0], 6)
    array([68.404029,  0.      ])
    """
    moved, found = _state(first, second, angle, plane_twist, yoke_angle, torque)
    e, back = moved.axis[..., 1, :], moved.driven_arm[..., 0, :]
    far = real(length, np)
    far = far[..., None] if far.ndim else far
    couple = found.secondary[..., 1, :]
    pair = frames.cross(e + 0.0 * couple, couple) / far[..., None]
    along = np.abs(frames.dot(pair, back))
    across = np.abs(frames.dot(pair, frames.cross(e + 0.0 * back, back)))

    def aside(vector: Array) -> Array:
        return frames.norm(vector - frames.dot(vector, e)[..., None] * e)

    return DoubleJointForces(
        driving_torque=found.shaft_torque[..., 0],
        first_couple=frames.norm(found.secondary[..., 0, :]),
        middle_first=aside(found.driven[..., 0, :]),
        middle_second=aside(found.driving[..., 1, :]),
        last_couple=frames.norm(found.secondary[..., 2, :]),
        middle_couple=frames.norm(couple),
        pair=pair,
        along_arm=along,
        across_arm=across,
        first_axial=np.abs(frames.dot(pair, moved.axis[..., 0, :])),
        last_axial=np.abs(frames.dot(pair, moved.axis[..., 2, :])),
    )


def largest_middle_couple(
    first: float, second: float, *, plane_twist: float = 0.0, yoke_angle: float = 0.0, torque: float
) -> tuple[float, float]:
    """Return the largest couple on the middle shaft over a turn [N·m], and the angle θ_1 at which it occurs [rad].

    Examples
    --------
    >>> from cardan.units import deg
    >>> most, at = largest_middle_couple(55 * deg, 55 * deg, torque=50.0)
    >>> print(f"{most * np.cos(55 * deg):.9f}")
    50.000000000
    """

    def squares(angle: Array) -> Array:
        _moved, found = _state(first, second, angle, plane_twist, yoke_angle, torque)
        couple = found.secondary[..., 1, :]
        return frames.dot(couple, couple)[None]

    places = np.linspace(0.0, np.pi, 181)
    at, most = peaks(squares, places, squares(places))
    return float(np.sqrt(most[0])), float(at[0])


def _state(
    first: ArrayLike,
    second: ArrayLike,
    angle: ArrayLike,
    plane_twist: ArrayLike,
    yoke_angle: ArrayLike,
    torque: ArrayLike,
) -> tuple[KinematicState, Couples]:
    one, two, twist, gamma = (real(x, np) for x in (first, second, plane_twist, yoke_angle))
    one, two, twist, gamma = np.broadcast_arrays(one, two, twist, gamma)
    joint_angle = np.stack((one, two), axis=-1)
    lengths = np.ones((*joint_angle.shape[:-1], 3))
    points = points_from_angles(joint_angle, twist[..., None], lengths)
    chain = Chain(
        joint_angle=joint_angle,
        plane_twist=twist[..., None],
        yoke_angle=gamma[..., None],
        start_phase=np.zeros(one.shape),
    )
    place = geometry_from_points(points)
    train = Train(points=points, chain=chain)
    phi = np.atleast_1d(real(angle, np))
    # Joint 1 bends about y; where it is straight its points do not say so.
    level = np.broadcast_to([[0.0, 1.0, 0.0]], (*one.shape, 1, 3))
    moved = standing(chain, place.axis, level, phi, speed=1.0)
    load = real(torque, np)
    load = load[..., None] if load.ndim else load
    return moved, couples(train, moved, load + np.zeros((*one.shape, phi.size)))


# What the friction of a sliding spline does to the joint beside it.


@dataclass(frozen=True, eq=False, kw_only=True)
class SplineThrust:
    """Friction thrust of a spline and its parts in the joint."""

    thrust: Array  # (...) [N]: T along the splined shaft
    axial: Array  # axial, radial (...) [N]: parts along and across the other shaft
    radial: Array  # (...) [N]
    # along_driving_arm, along_driven_arm, along_normal (...) [N]: parts along u, v and the normal of the cross
    along_driving_arm: Array
    along_driven_arm: Array  # (...) [N]
    along_normal: Array  # (...) [N]


def spline_thrust(joint_angle: ArrayLike, angle: ArrayLike, torque: ArrayLike, grip: ArrayLike) -> SplineThrust:
    """Return the friction thrust of the spline of the driven shaft, and what of it goes where.

    Parameters
    ----------
    joint_angle : array (...) [rad]
        α.
    angle : array (...) [rad]
        θ, angle of the driving yoke from the plane of the joint.
    torque : array (...) [N·m]
        M at the spline.
    grip : array (...) [1/m]
        2 μ/d, see `cardan.drive.models.dynamics_model.spline_grip`.

    Notes
    -----
    T = 2 μ M/d, Book (123). e_2·u = sin α cos θ (Book (124), first line); e_2·v = 0, so the driven journals carry no
    thrust (its second line, T sin α sin θ, is wrong); e_2·n = √(1 - sin² α cos² θ).

    Examples
    --------
    >>> import math
    >>> found = spline_thrust(math.radians(25), math.radians(40), 800.0, 2 * 0.12 / 0.06)
    >>> print(f"{found.thrust:.3f} {found.along_driving_arm:.3f}")
    3200.000 1035.982
    """
    xp = namespace(joint_angle, angle, torque, grip)
    alpha, theta, moment, over = (real(x, xp) for x in (joint_angle, angle, torque, grip))
    push = over * xp.abs(moment)
    sine = xp.sin(alpha)
    along = sine * xp.cos(theta)
    return SplineThrust(
        thrust=push + 0.0 * along,
        axial=push * xp.cos(alpha) + 0.0 * along,
        radial=push * sine + 0.0 * along,
        along_driving_arm=push * along,
        along_driven_arm=0.0 * push * along,
        along_normal=push * xp.sqrt(1.0 - along * along),
    )
