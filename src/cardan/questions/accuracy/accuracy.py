"""What do the manufacturing errors of the joints do to the motion of the output?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain, given_chain, turning
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.kernel import loops
from cardan.questions.motion.motion import Motion, motion
from cardan.texts import _

TURNS = ("phase", "alpha1", "alpha2", "alpha3", "alpha4")
"""Errors of a joint that turn the output, in the order of the last axis of arrays."""

WAYS = ("s1", "a1", "a2", "a3", "a4")
"""Errors of a joint that shift the output along its axis, each in the seat of the one of `TURNS` that it is twin to."""

POSITIONS = 360
"""Positions of one turn over which errors are judged."""

T = TypeVar("T")

Errors: TypeAlias = Error | Sequence[Error | None] | None
"""Errors of every joint, of each, or those that the drive file gives."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TransmissionError:
    """What errors do to the output over the input angle; leading axes (...) are those of drives and errors.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    error : array (..., p) [rad]
        By how much the output runs ahead of that of the perfect drive, exactly; nan where a joint cannot be assembled.
    error_linear : array (..., p) [rad]
        The same to first order.
    shift : array (..., n, p) [m]
        Shift of the shaft behind each joint along its axis, where nothing but the joint holds it; exact.
    shift_linear : array (..., n, p) [m]
        The same to first order in the errors of angles.
    closes : array of bool (...)
        Whether every joint can be assembled at every position.
    """

    angle: Array
    error: Array
    error_linear: Array
    shift: Array
    shift_linear: Array
    closes: Array

    @property
    def output_shift(self) -> Array:
        """Shift of the output shaft, array (..., p) [m]."""
        return self.shift[..., -1, :]

    @property
    def course(self) -> Course:
        """Mean, orders and peak to peak of the error, if the angles are evenly spaced over one turn without its end."""
        return course(self.error)


@dataclass(frozen=True, eq=False, kw_only=True)
class Course:
    """What a curve over one turn of the input consists of; the axes (...) are those of the curves."""

    mean: Array  # (...): mean over the turn; of an output angle the part that setting the drive up once takes away
    first: Array  # first, second (...): amplitudes once and twice a turn
    second: Array  # (...)
    peak_to_peak: Array  # (...): largest less smallest value


def course(values: Array) -> Course:
    """Return mean, first two orders and peak to peak of curves over one turn.

    values (..., p): at p evenly spaced positions of one turn, the end of the turn left out.
    """
    xp = namespace(values)
    count = int(values.shape[-1])
    phi = xp.arange(count, dtype=xp.float64) * (2.0 * xp.pi / count)

    waves = xp.stack((xp.cos(phi), xp.sin(phi), xp.cos(2.0 * phi), xp.sin(2.0 * phi)), axis=-1)
    parts = xp.matmul(values, waves * (2.0 / count))
    return Course(
        mean=xp.mean(values, axis=-1),
        first=xp.hypot(parts[..., 0], parts[..., 1]),
        second=xp.hypot(parts[..., 2], parts[..., 3]),
        peak_to_peak=xp.max(values, axis=-1) - xp.min(values, axis=-1),
    )


def one_turn(count: int = POSITIONS) -> Array:
    """Return evenly spaced input angles of one turn without its end, array (count,) [rad]."""
    return np.arange(count) * (2.0 * np.pi / count)


def sensitivity(drive: Drive | Drives | Chain, angle: ArrayLike, *, located: Sequence[int] = ()) -> Array:
    """Return how the output of perfect joints feels each error, to first order.

    drive (...); angle (p,) [rad]: input angle φ_1 from the start position.
    located: numbers of the intermediate shafts that a bearing holds along their axis: shifts end there. Leave empty for
    angles.
    Returns (..., p, n, 5): derivative of the output angle by the `TURNS` of each joint; of the output shift by its
    `WAYS`.

    For joint j the row of φ_4 of `loops.influence`, with the sign of θ' = π/2 - φ_4, times the speed
    ratios of all joints behind it; the same numbers for shifts, because lengths are to angles as the dual parts of
    dual numbers.
    """
    moved = motion(drive, angle)
    xp = namespace(moved.joint_angle)
    own = -coefficients(moved)[..., 2, :]
    weight, rows = None, []
    for j in reversed(range(own.shape[-3])):
        row = own[..., j, :, :] if weight is None else weight[..., None] * own[..., j, :, :]
        rows.append(row)
        weight = row[..., 0] * (0.0 if j + 1 in located else 1.0)
    return xp.stack(rows[::-1], axis=-2)


def coefficients(moved: Motion) -> Array:
    """Return the influence coefficients of every joint, array (..., n, p, 3, 5), see `loops.influence`.

    A joint of another kind has no such errors of its own: it passes on angle and shift as it passes on the turn.
    """
    xp = namespace(moved.joint_angle)
    table = loops.influence(moved.joint_angle[..., None], moved.yoke_rotation)
    if all(moved.crossed):
        return table
    step = moved.shaft_ratio[..., 1:, :] / moved.shaft_ratio[..., :-1, :]
    place = np.zeros((3, 5))
    place[2, 0] = -1.0
    passing = step[..., None, None] * xp.asarray(place)
    return xp.where(xp.asarray(moved.crossed)[:, None, None, None], table, passing)


def walked(drive: Drive | Drives | Chain) -> Chain:
    """Return the loops of a drive to be walked along; joints of other kinds as those that turn alike, or nearly so."""
    return turning(given_chain(drive), drive.joints, near=True) if isinstance(drive, Drive) else kinematics(drive)


def transmission_error(
    drive: Drive | Drives | Chain,
    angle: ArrayLike | None = None,
    *,
    turns: ArrayLike | None = None,
    ways: ArrayLike | None = None,
    errors: Errors = None,
    located: Sequence[int] | None = None,
) -> TransmissionError:
    """Return what given errors of the joints do to the output, exactly and to first order.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    angle : array (p,) [rad], optional
        Input angle φ_1 from the start position; one turn of 360 positions by default.
    turns : array (..., n, 5) [rad], optional
        Errors of each joint in the order of `TURNS`; of its axes so many that they broadcast with those of the drives.
    ways : array (..., n, 5) [m], optional
        Errors of each joint in the order of `WAYS`.
    errors : Error, or n of them, optional
        Errors by name instead; those of the drive where nothing is given. Those of joints of other kinds count as 0.
    located : sequence of int, optional
        Numbers of the shafts that a bearing holds along their axis, where shifts end; those with axial supports by
        default.

    Returns
    -------
    TransmissionError

    See Also
    --------
    tolerance, allocate

    Notes
    -----
    Each joint is the closed loop of `cardan.maths.kernel.loops` with α = (90°, 90°, 90°, α) and no lengths, plus its
    errors. The phase turns its driving yoke on; θ' = π/2 - φ_4. A shaft that floats passes the shift on,
    u_j = -s_4 with s_1 = u_{j-1} + its own. To first order Book (171), (180), chained. Joints of other kinds count as
    made true: they pass on angle and shift as they pass on the turn, one that slides no shift.

    Examples
    --------
    >>> from cardan import Drive, transmission_error
    >>> from cardan.parts import Error
    >>> from cardan.units import deg
    >>> skew = Error(alpha1=0.1 * deg)
    >>> found = transmission_error(Drive.from_angles([30 * deg]), [90 * deg], errors=skew)
    >>> (found.error / deg).round(6), (found.error_linear / deg).round(6)
    (array([0.05]), array([0.05]))
    """
    chain = walked(drive)
    xp = namespace(chain.joint_angle, turns, ways)
    phi = xp.asarray(one_turn()) if angle is None else real(angle, xp)
    phi = phi if phi.ndim else phi[None]
    held = located_shafts(drive) if located is None else tuple(located)
    turned, shifted = _given(drive, chain.joints, turns, ways, errors, xp)
    mu = chain.turn_before
    start = xp.cos(mu[..., :1] + phi), xp.sin(mu[..., :1] + phi)
    ideal, linear = walk(links(chain.joint_angle, None), mu, None, start, carry=((turned, ()), (shifted, held)))
    actual, exact = walk(links(chain.joint_angle, turned), mu, turned[..., 0], start, carry=((shifted, held),))
    error = ahead(actual, ideal)
    shape = (error + exact[-1][0]).shape

    def curves(rows: list[Array]) -> Array:
        return xp.stack([xp.broadcast_to(row, shape) for row in rows], axis=-2)

    error = xp.broadcast_to(error, shape)
    return TransmissionError(
        angle=phi,
        error=error,
        error_linear=xp.broadcast_to(linear[-1][0], shape),
        shift=curves([row[0] for row in exact]),
        shift_linear=curves([row[1] for row in linear]),
        closes=xp.all(xp.isfinite(error), axis=-1),
    )


def walk(
    given: tuple[Array, Array],
    mu: Array,
    phase: Array | None,
    start: tuple[Array, Array],
    *,
    carry: Sequence[tuple[Array, Sequence[int]]] = (),
) -> tuple[tuple[Array, Array], list[tuple[Array, ...]]]:
    """Walk along chains, joint by joint.

    given, two arrays (..., n, 4): cosines and sines of the angles of each joint's loop, see `links`.
    mu (..., n) [rad]: angle added before each joint; that before the first is part of ``start``.
    phase (..., n) [rad]: errors of the angle of the driving yokes; start, two arrays (..., p): cosine and sine of θ_1.
    carry, sequence of (array (..., n, 5), sequence of int): errors to be carried along through the coefficients, and
    the numbers of the shafts where they end.
    Returns tuple of two arrays (..., p): cosine and sine of the angle of the last driven yoke; list of n tuples of
    arrays (..., p): what has become of each of ``carry`` behind each joint.
    """
    cosine, sine = given
    xp = namespace(cosine, *start)
    direction, found = start, []
    carried = tuple(0.0 * start[0] for _errors in carry)
    for j in range(int(cosine.shape[-2])):
        if j:
            direction = _on(direction, mu[..., j, None], xp)
        if phase is not None:
            direction = _on(direction, phase[..., j, None], xp)
        row = cosine[..., j, None, :], sine[..., j, None, :]
        if not carry:
            direction = loops.followed(*row, *direction)
            continue
        along, across, table = loops.driven(*row, *direction)
        direction = along, across
        carried = tuple(
            _carried(table, 0.0 * before if j + 1 in ends else before, errors[..., j, None, :])
            for before, (errors, ends) in zip(carried, carry, strict=True)
        )
        found.append(carried)
    return direction, found


def ahead(direction: tuple[Array, Array], other: tuple[Array, Array]) -> Array:
    """Return by which angle a direction is ahead of another, in [-π, π]."""
    xp = namespace(*direction)
    return xp.atan2(
        direction[1] * other[0] - direction[0] * other[1], direction[0] * other[0] + direction[1] * other[1]
    )


def links(joint_angle: Array, turned: Array | None) -> tuple[Array, Array]:
    """Return cosines and sines of α_1 … α_4 of each joint's loop, arrays (..., n, 4), perfect or with errors."""
    xp = namespace(joint_angle, turned)
    right = 0.5 * xp.pi + 0.0 * joint_angle
    alpha = xp.stack((right, right, right, joint_angle), axis=-1)
    alpha = alpha if turned is None else alpha + turned[..., 1:]
    return xp.cos(alpha), xp.sin(alpha)


def located_shafts(drive: Drive | Drives | Chain) -> tuple[int, ...]:
    """Return the numbers of the shafts at whose end a shift ends: held along their axis, or before what slides."""
    if not isinstance(drive, Drive):
        return ()
    sliding = {k for k, joint in enumerate(drive.joints, 1) if joint.slides}
    return tuple(sorted(sliding | {support.shaft for support in drive.supports if support.axial}))


def error_arrays(errors: Sequence[object | None]) -> tuple[Array, Array]:
    """Return errors, or tolerances, by name as arrays (n, 5): those that turn [rad], those that shift [m].

    >>> error_arrays([Error(alpha2=0.1, a4=0.2)])[0]
    array([[0. , 0. , 0.1, 0. , 0. ]])
    """
    turns, ways = (
        np.asarray([[0.0 if one is None else getattr(one, name) for name in names] for one in errors], dtype=float)
        for names in (TURNS, WAYS)
    )
    return turns, ways


def per_joint(name: str, given: T | Sequence[T | None], joints: int) -> list[T | None]:
    """Return one value for each joint, given one for all or as many as there are joints."""
    if not isinstance(given, Sequence):
        return [given] * joints
    if len(given) != joints:
        text = _("{given} values given, {wanted} needed")
        raise refuse(name, text.format(given=len(given), wanted=joints))
    return list(given)


def _given(
    drive: Drive | Drives | Chain,
    joints: int,
    turns: ArrayLike | None,
    ways: ArrayLike | None,
    errors: Errors,
    xp: Any,
) -> tuple[Array, Array]:
    if turns is not None or ways is not None:
        if errors is not None:
            raise refuse("errors", _("given beside turns or ways; give one of them"))
        arrays = [real(np.zeros((joints, 5)) if one is None else one, xp) for one in (turns, ways)]
        check(
            Problem(name, _("shape {shape} is not (..., {joints}, 5)").format(shape=tuple(one.shape), joints=joints))
            for name, one in zip(("turns", "ways"), arrays, strict=True)
            if tuple(one.shape[-2:]) != (joints, 5)
        )
        return arrays[0], arrays[1]
    turned, shifted = given_errors(drive, joints, errors)
    own = np.asarray([[one.single_cross] for one in drive.joints]) if isinstance(drive, Drive) else True
    turned, shifted = np.where(own, turned, 0.0), np.where(own, shifted, 0.0)
    return real(turned, xp), real(shifted, xp)


def given_errors(drive: Drive | Drives | Chain, joints: int, errors: Errors) -> tuple[Array, Array]:
    """Return errors by name, those of the drive where none are given, as `error_arrays` does."""
    if errors is not None:
        return error_arrays(per_joint("errors", errors, joints))
    return error_arrays([joint.error for joint in drive.joints] if isinstance(drive, Drive) else [None] * joints)


def _on(direction: tuple[Array, Array], angle: Array, xp: Any) -> tuple[Array, Array]:
    """Turn a direction on by an angle."""
    along, across = direction
    c, s = xp.cos(angle), xp.sin(angle)
    return along * c - across * s, along * s + across * c


def _carried(carried: Sequence[Array], before: Array, own: Array) -> Array:
    """Return what a joint makes of the error before it and its own, through its row of coefficients."""
    total = carried[0] * (before + own[..., 0])
    for k in range(1, 5):
        total = total + carried[k] * own[..., k]
    return total
