"""The kinematic half of a drive: what motion needs to know, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.errors import check
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.texts import _

from .geometry import geometry, given_angles
from .laws import NEGLIGIBLE, Laws, alike, lawless, left_over, mixed, refuse_kinds


@dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    """Joint angles, plane twists and yoke angles of one drive of Hooke joints (n,) or of many (..., n).

    Joints of other kinds stand in it as the Hooke joints that turn alike, see `cardan.drive.models.laws`.
    """

    joint_angle: Array  # (..., n) [rad]: α_1 … α_n
    plane_twist: Array  # (..., n-1) [rad]: β_2 … β_n
    yoke_angle: Array  # (..., n-1) [rad]: γ_2 … γ_n, from the driving to the driven yoke of a shaft
    start_phase: Array  # (...) [rad]: ψ_1
    laws: Laws | None = None  # the joints as they are, where any is of another kind

    @property
    def joints(self) -> int:
        """Number of joints n."""
        return int(self.joint_angle.shape[-1])

    @property
    def turn_before(self) -> Array:
        """Angle μ_i added before joint i: μ_1 = ψ_1, μ_i = π/2 - γ_i - β_i; array (..., n) [rad]."""
        xp = namespace(self.joint_angle)
        first = xp.broadcast_to(self.start_phase, self.joint_angle.shape[:-1])[..., None]
        between = 0.5 * xp.pi - self.yoke_angle - self.plane_twist
        return xp.concat((first, xp.broadcast_to(between, (*self.joint_angle.shape[:-1], self.joints - 1))), axis=-1)

    def products(self) -> list[mobius.Pair]:
        """Return the Möbius pairs of the first 1 … n joints, each from the input shaft on."""
        return mobius.partial_products(self.joint_angle, self.turn_before)


def chain(drive: Drive) -> Chain:
    """Return the kinematic half of a drive of Hooke joints.

    Raises
    ------
    InputError
        A joint of another kind: who takes the Hooke joints that turn alike asks `turning_chain`.

    Examples
    --------
    >>> from cardan.units import deg
    >>> chain(Drive.from_angles([20 * deg, 20 * deg])).turn_before
    array([0.        , 1.57079633])
    """
    if mixed(drive.joints):
        refuse_kinds(drive, _("this question"))
    return given_chain(drive)


def turning_chain(drive: Drive) -> Chain:
    """Return the Hooke joints that turn like the joints of a drive, those of other kinds among them.

    Raises InputError: the motion of a joint is no Möbius map, or it does not turn at its bend.
    """
    return turning(given_chain(drive), drive.joints)


def turning(whole: Chain, joints: Sequence[Joint], *, near: bool = False) -> Chain:
    """Return the Hooke joints that turn like joints of any kind with the joint angles and planes of a chain.

    whole (..., n): bends and plane twists as they are.
    near: take a joint without a Möbius map by the nearest one: good enough for loads, not for motion.
    """
    if not mixed(joints):
        return whole
    joint_angle, twist, start, laws = alike(joints, whole.joint_angle, whole.plane_twist, near=near)
    return Chain(
        joint_angle=joint_angle,
        plane_twist=twist,
        yoke_angle=whole.yoke_angle,
        start_phase=whole.start_phase + start,
        laws=laws,
    )


def nearly_turning_chain(drive: Drive, question: str) -> Chain:
    """Return the Hooke joints that turn like the joints of a drive, but for angles that nobody can measure.

    question: what is asked, in words.
    """
    given = given_chain(drive)
    left = [
        left_over(joint, joint_angle)
        for joint, joint_angle in zip(drive.joints, given.joint_angle.tolist(), strict=True)
    ]
    check(lawless(i, drive.joints[i], question) for i, rest in enumerate(left) if rest > NEGLIGIBLE)
    return turning(given, drive.joints, near=True)


def as_hooke(drive: Drive) -> Drive:
    """Return a drive of Hooke joints that turns like a drive, itself where it has no other joints.

    Raises InputError: the motion of a joint is no Möbius map, or it does not turn at its bend.

    >>> from cardan.drive.joints import ConstantVelocity, Hooke
    >>> pair = Drive(joints=(Hooke(joint_angle=0.3), ConstantVelocity(joint_angle=0.4)))
    >>> [joint.joint_angle for joint in as_hooke(pair).joints]
    [0.3, 0.0]
    """
    if not mixed(drive.joints):
        return drive
    whole = turning_chain(drive)
    return Drive.from_angles(
        np.asarray(whole.joint_angle).tolist(),
        plane_twists=np.asarray(whole.plane_twist).tolist(),
        yoke_angles=np.asarray(whole.yoke_angle).tolist(),
        start_phase=float(whole.start_phase),
        name=drive.name,
    )


def given_chain(drive: Drive) -> Chain:
    """Return bends, planes and yokes of a drive as they are, whatever the kinds of its joints."""
    if drive.form == "angles":
        joint_angle, twist = given_angles(drive)
        twist = twist[1:]
    else:
        place = geometry(drive)
        joint_angle, twist = place.joint_angle, place.plane_twist
    return Chain(
        joint_angle=joint_angle,
        plane_twist=twist,
        yoke_angle=np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float),
        start_phase=np.asarray(drive.input.start_phase, dtype=float),
    )
