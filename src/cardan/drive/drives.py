"""Many drives as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.errors import InputError, JointAngleLimitError, Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.kernel import frames
from cardan.reading.ranges import HUGE
from cardan.texts import _

from .drive import Drive
from .fields.validity import COINCIDENT
from .models.geometry import geometry_from_points
from .models.kinematics_model import Chain, refuse_kinds, turning_chain


@dataclass(frozen=True, eq=False, kw_only=True)
class Drives:
    """A batch of drives with free leading axes; every question takes it where it takes a `Drive`.

    Attributes
    ----------
    chain : Chain
        Their kinematic half, padded to the longest with straight joints (exactly the identity).
    joints : array of int (...)
        How many joints each drive has.
    """

    chain: Chain
    joints: Array

    @property
    def shape(self) -> tuple[int, ...]:
        """Leading axes of the batch."""
        return tuple(self.chain.joint_angle.shape[:-1])

    @classmethod
    def from_angles(
        cls,
        joint_angle: ArrayLike,
        *,
        plane_twist: ArrayLike | None = None,
        yoke_angle: ArrayLike | None = None,
        start_phase: ArrayLike = 0.0,
    ) -> Drives:
        """Return drives with given joint angles.

        Parameters
        ----------
        joint_angle : array (..., n) [rad]
            α, each in [0, π/2).
        plane_twist, yoke_angle : array (..., n-1) [rad], optional
            β and γ; zero when not given.
        start_phase : array (...) [rad]
            ψ_1.

        Raises
        ------
        JointAngleLimitError
            A joint angle outside [0, π/2) or not finite; ``where`` is the mask (..., n).
        InputError
            An array that does not fit the joint angles, or a value that is not finite.

        Examples
        --------
        >>> Drives.from_angles([[0.1, 0.2], [0.3, 0.3]]).shape
        (2,)
        """
        xp = namespace(joint_angle, plane_twist, yoke_angle, start_phase)
        alpha = real(joint_angle, xp)
        if not alpha.ndim or not alpha.shape[-1]:
            raise refuse(
                "joint_angle", _("a drive needs at least one joint; joint angles are a list, of one drive or of many")
            )
        fits = (alpha >= 0.0) & (alpha < 0.5 * xp.pi)
        if not bool(xp.all(fits)):
            raise JointAngleLimitError([Problem("joint_angle", _("a joint angle must lie in [0°, 90°)"))], where=~fits)
        between = (*alpha.shape[:-1], alpha.shape[-1] - 1)

        def rest(name: str, value: ArrayLike | None) -> Array:
            given = xp.zeros(between, dtype=xp.float64) if value is None else real(value, xp)
            if given.shape[-1:] != between[-1:]:
                raise refuse(
                    name, _("{given} values given, {wanted} needed").format(given=given.shape[-1], wanted=between[-1])
                )
            if not _fits(given.shape, between):
                raise refuse(name, _misfit(given.shape, between))
            _refuse_unreal(name, given)
            return xp.broadcast_to(given, between)

        start = real(start_phase, xp)
        if not _fits(start.shape, alpha.shape[:-1]):
            raise refuse("start_phase", _misfit(start.shape, alpha.shape[:-1]))
        _refuse_unreal("start_phase", start)
        whole = Chain(
            joint_angle=alpha,
            plane_twist=rest("plane_twist", plane_twist),
            yoke_angle=rest("yoke_angle", yoke_angle),
            start_phase=xp.broadcast_to(start, alpha.shape[:-1]),
        )
        return cls(chain=whole, joints=xp.full(alpha.shape[:-1], alpha.shape[-1]))

    @classmethod
    def from_points(
        cls, points: ArrayLike, *, yoke_angle: ArrayLike | None = None, start_phase: ArrayLike = 0.0
    ) -> Drives:
        """Return drives through points of their axes.

        Parameters
        ----------
        points : array (..., n+2, 3) [m]
            A point of the input axis, the n joint centres, a point of the output axis.
        yoke_angle : array (..., n-1) [rad], optional
            γ of shafts 2 to n; zero when not given.
        start_phase : array (...) [rad]
            ψ_1.

        Raises
        ------
        InputError
            Fewer than three points, a coordinate not finite, neighbours that coincide, or shafts at 90° or more;
            ``where`` is the mask of the drives concerned, in the last case of their joints (..., n).
        """
        xp = namespace(points, yoke_angle, start_phase)
        place = geometry_from_points(_sound(real(points, xp)))
        return cls.from_angles(
            place.joint_angle, plane_twist=place.plane_twist, yoke_angle=yoke_angle, start_phase=start_phase
        )


def _fits(shape: tuple[int, ...], wanted: tuple[int, ...]) -> bool:
    """Tell whether an array of one shape can be spread over another."""
    last = zip(reversed(shape), reversed(wanted), strict=False)
    return len(shape) <= len(wanted) and all(one in (1, many) for one, many in last)


def _refuse_unreal(name: str, value: Array) -> None:
    xp = namespace(value)
    real_ones = xp.isfinite(value)
    if not bool(xp.all(real_ones)):
        raise InputError([Problem(name, _("not every value is finite"))], where=~real_ones)


def _misfit(shape: tuple[int, ...], wanted: tuple[int, ...]) -> str:
    return _("shape {shape} does not fit the joint angles; {wanted} is needed").format(
        shape=tuple(shape), wanted=tuple(wanted)
    )


def _sound(points: Array) -> Array:
    """Refuse points that make no line of shafts."""
    xp = namespace(points)
    if points.ndim < 2 or points.shape[-1] != 3 or points.shape[-2] < 3:
        raise refuse("points", _("shape {shape} is not (..., n+2, 3)").format(shape=tuple(points.shape)))
    lost = xp.any(~(xp.abs(points) <= HUGE), axis=(-2, -1))
    if bool(xp.any(lost)):
        raise InputError(
            [Problem("points", _("not every coordinate is finite and below {most:g} m").format(most=HUGE))], where=lost
        )
    length = frames.norm(points[..., 1:, :] - points[..., :-1, :])
    double = xp.any(length <= COINCIDENT * xp.max(length, axis=-1, keepdims=True), axis=-1)
    if bool(xp.any(double)):
        raise InputError([Problem("points", _("neighbouring points coincide"))], where=double)
    return points


def stack(drives: Sequence[Drive], *, xp: Any = None) -> Drives:
    """Return single drives as one batch.

    Parameters
    ----------
    drives : sequence of Drive
        N drives; shorter ones are padded with straight joints, which change nothing.
    xp : array-API namespace, optional
        Library of the result, NumPy by default.

    Returns
    -------
    Drives (N,)

    See Also
    --------
    traces, extremes

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.sweeps import stack
    >>> stack([Drive.from_angles([0.1]), Drive.from_angles([0.1, 0.2])]).joints
    array([1, 2])
    """
    if not drives:
        check([Problem("drives", _("an empty list has nothing to stack"))])
    lib = np if xp is None else xp
    chains = [turning_chain(drive) for drive in drives]
    most = max(one.joints for one in chains)

    def padded(rows: list[Array], width: int, filler: float) -> Array:
        table = np.full((len(rows), width), filler)
        for row, values in zip(table, rows, strict=True):
            row[: len(values)] = values
        return lib.asarray(table)

    whole = Chain(
        joint_angle=padded([c.joint_angle for c in chains], most, 0.0),
        plane_twist=padded([c.plane_twist for c in chains], most - 1, 0.0),
        yoke_angle=padded([c.yoke_angle for c in chains], most - 1, 0.5 * np.pi),
        start_phase=lib.asarray([float(c.start_phase) for c in chains]),
    )
    return Drives(chain=whole, joints=lib.asarray([c.joints for c in chains]))


def kinematics(drive: Drive | Drives | Chain) -> Chain:
    """Return the kinematic half of one drive or many; joints of other kinds as the Hooke joints that turn alike."""
    if isinstance(drive, Chain):
        return drive
    return turning_chain(drive) if isinstance(drive, Drive) else drive.chain


def crosses(drive: Drive | Drives | Chain, question: str) -> Chain:
    """Return the kinematic half of drives for a question that is about the crosses of Hooke joints.

    drive (...); question: what is asked, in words.
    """
    if isinstance(drive, Drive):
        refuse_kinds(drive, question)
    whole = kinematics(drive)
    if whole.laws is not None:
        raise refuse("joints", _("{question}: answered for Hooke joints only").format(question=question))
    return whole
