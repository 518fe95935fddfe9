"""Where do a hitch and an arm put the joints of a double joint? Closed forms of the geometry, one position or many."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.chain import Chain
from cardan.drive.geometry import geometry_from_points
from cardan.errors import BendLimitError, Problem, check
from cardan.maths import frames
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .equivalence import equivalent_joint


@dataclass(frozen=True, eq=False, kw_only=True)
class HitchPosition:
    """A double joint articulated about a pin on both end-shaft axes.

    Attributes
    ----------
    articulation : array (...) [rad]
        Δ, angle between the end shafts.
    bend : array (..., 2) [rad]
        α_1, α_2.
    length : array (...) [m]
        Distance of the joints.
    irregularity : array (...)
        δ of the output.
    """

    articulation: Array
    bend: Array
    length: Array
    irregularity: Array


def hitch(
    yaw: ArrayLike, pitch: ArrayLike = 0.0, *, before: float, behind: float, yoke_angle: float = 0.0
) -> HitchPosition:
    """Return bends, length and irregularity of a double joint articulated about a hitch pin.

    Parameters
    ----------
    yaw, pitch : array (...) [rad]
        Turn of the output side about the pin: about the vertical, and about the cross axis carried with it.
    before, behind : float [m]
        l_1, l_2: distances of joint 1 before the pin and joint 2 behind it, more than zero.
    yoke_angle : float [rad]
        γ_2.

    Returns
    -------
    HitchPosition

    Raises
    ------
    InputError
        A distance of zero or less.
    BendLimitError
        A joint bends 90 degrees or more; ``where`` is the mask (..., 2).

    Notes
    -----
    cos Δ = cos yaw cos pitch; tan α_1 = l_2 sin Δ/(l_1 + l_2 cos Δ), tan α_2 = l_1 sin Δ/(l_2 + l_1 cos Δ),
    L² = l_1² + l_2² + 2 l_1 l_2 cos Δ, β_2 = 0; Book Figs 56, 57. With γ_2 = 0 synchronous at every yaw and pitch
    exactly when l_1 = l_2, else δ = 2 sinh \\|ln(cos α_1/cos α_2)\\|.

    Examples
    --------
    >>> np.round(np.rad2deg(hitch(np.deg2rad(30.0), before=0.4, behind=0.6).bend), 4)
    array([18.0675, 11.9325])
    """
    check(
        Problem(name, _("{value} is not allowed; allowed is more than 0").format(value=f"{value:.6g}"))
        for name, value in (("before", before), ("behind", behind))
        if not value > 0.0
    )
    psi, chi = np.asarray(yaw, dtype=float), np.asarray(pitch, dtype=float)
    sine = np.hypot(np.sin(psi), np.cos(psi) * np.sin(chi))
    cosine = np.cos(psi) * np.cos(chi)
    bend = np.stack(
        (np.arctan2(behind * sine, before + behind * cosine), np.arctan2(before * sine, behind + before * cosine)),
        axis=-1,
    )
    if not np.all(bend < 0.5 * np.pi):
        raise BendLimitError(
            [Problem("yaw", _("the hitch bends a joint by 90° or more; a universal joint needs less"))],
            where=~(bend < 0.5 * np.pi),
        )
    return HitchPosition(
        articulation=np.arctan2(sine, cosine),
        bend=bend,
        length=np.sqrt(before**2 + behind**2 + 2.0 * before * behind * cosine),
        irregularity=_irregularity(bend, np.zeros((*sine.shape, 1)), yoke_angle),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class ArmPosition:
    """A double joint whose second joint and output axis swing on an arm.

    Attributes
    ----------
    centre : array (..., 3) [m]
        B_2.
    output_axis : array (..., 3)
        a_3, unit vector.
    bend : array (..., 2) [rad]
        α_1, α_2.
    plane_twist : array (..., 1) [rad]
        β_2.
    length : array (...) [m]
        Distance of the joints.
    irregularity : array (...)
        δ of the output.
    """

    centre: Array
    output_axis: Array
    bend: Array
    plane_twist: Array
    length: Array
    irregularity: Array


def arm(
    angle: ArrayLike,
    *,
    joint: ArrayLike,
    input_axis: ArrayLike,
    pivot: ArrayLike,
    axis: ArrayLike,
    centre: ArrayLike,
    output_axis: ArrayLike,
    yoke_angle: float = 0.0,
) -> ArmPosition:
    """Return bends, length and irregularity of a double joint whose output side swings on an arm.

    Parameters
    ----------
    angle : array (...) [rad]
        Turn of the arm from rest, by the right-hand rule.
    joint, input_axis : array (3,) [m, -]
        B_1 and the direction of the input shaft.
    pivot, axis : array (3,) [m, -]
        A point of the arm's axis and its direction.
    centre, output_axis : array (3,) [m, -]
        B_2 and the direction of the output shaft, both at rest; they turn together.
    yoke_angle : float [rad]
        γ_2.

    Returns
    -------
    ArmPosition

    Raises
    ------
    BendLimitError
        A joint bends 90 degrees or more.

    Examples
    --------
    >>> found = arm(
    ...     np.deg2rad(4.0), joint=[0, 0, 0], input_axis=[1, 0, 0], pivot=[0.2, 0, -0.1], axis=[0, 1, 0],
    ...     centre=[1.4, 0, -0.15], output_axis=[1, 0, -0.03],
    ... )
    >>> np.round(np.rad2deg(found.bend), 4), round(float(found.irregularity), 6)
    (array([9.5152, 3.7968]), 0.023313)
    """
    q = np.asarray(angle, dtype=float)
    first, here, rest = (np.asarray(point, dtype=float) for point in (joint, pivot, centre))
    along, pole, out = (frames.unit(np.asarray(part, dtype=float)) for part in (input_axis, axis, output_axis))
    moved = here + frames.rotate(rest - here, pole, q)
    direction = frames.rotate(out, pole, q)
    one = np.zeros_like(moved)
    points = np.stack((one + first - along, one + first, moved, moved + direction), axis=-2)
    place = geometry_from_points(points)
    return ArmPosition(
        centre=moved,
        output_axis=direction,
        bend=place.bend,
        plane_twist=place.plane_twist,
        length=place.length[..., 1],
        irregularity=_irregularity(place.bend, place.plane_twist, yoke_angle),
    )


def _irregularity(bend: Array, plane_twist: Array, yoke_angle: float) -> Array:
    chain = Chain(
        bend=bend,
        plane_twist=plane_twist,
        yoke_angle=np.full(plane_twist.shape, yoke_angle),
        start_phase=np.zeros(bend.shape[:-1]),
    )
    return equivalent_joint(chain).irregularity
