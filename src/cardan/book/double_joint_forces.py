"""Secondary couples of a double joint and the pair of forces with which its middle shaft loads its neighbours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.models.chain import Chain
from cardan.drive.models.geometry import geometry_from_points, points_from_angles
from cardan.drive.models.train import Train
from cardan.maths.arrays import Array, ArrayLike, real
from cardan.maths.curves.peaks import peaks
from cardan.maths.kernel import frames
from cardan.questions.forces.kinetostatics import Couples, Stand, couples, standing


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
) -> tuple[Stand, Couples]:
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
