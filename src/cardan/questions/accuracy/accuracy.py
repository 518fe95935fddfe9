"""What do the manufacturing errors of the joints do to the motion of the output?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.joints import Joint
from cardan.drive.models.kinematics_model import Chain, given_chain
from cardan.drive.models.wobble import wobbling
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.kernel import loops
from cardan.questions.motion.motion import Motion, followed, motion
from cardan.texts import _

from . import own_laws, places
from .own_laws import TURNS, seats

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
    Returns (..., p, n, c): derivative of the output angle by the `own_laws.seats` of each joint, `TURNS` first; of the
    output shift by its `WAYS` in the first five.

    For joint j the row of φ_4 of `loops.influence`, with the sign of θ' = π/2 - φ_4, times the speed
    ratios of all joints behind it; the same numbers for shifts, because lengths are to angles as the dual parts of
    dual numbers. A size by which a shaft lies elsewhere adds what its joints then turn.
    """
    moved = still(drive, angle)
    xp = namespace(moved.joint_angle)
    own = _influences(drive, moved)
    weight, rows = None, []
    for j in reversed(range(own.shape[-3])):
        row = own[..., j, :, :] if weight is None else weight[..., None] * own[..., j, :, :]
        rows.append(row)
        weight = row[..., 0] * (0.0 if j + 1 in located else 1.0)
    table = xp.stack(rows[::-1], axis=-2)
    if isinstance(drive, Drive):
        names = seats(drive.joints)
        for (j, key), found in places.influences(drive, np.atleast_1d(np.asarray(angle, dtype=float)), names).items():
            table[..., j, names[j].index(key)] += found.angle
    return table


def still(drive: Drive | Drives | Chain, angle: ArrayLike) -> Motion:
    """Return how perfect joints turn at the joint angles as drawn, shafts that wobble as they lie in the mean."""
    if isinstance(drive, Drive) and wobbling(drive):
        return Motion(**followed(drive, np.atleast_1d(np.asarray(angle, dtype=float))))
    return motion(drive, angle)


def _influences(drive: Drive | Drives | Chain, moved: Motion) -> Array:
    """Return how the driven mark of every joint feels its own errors, array (..., n, p, c), the phase first."""
    own: Array = -coefficients(moved)[..., 2, :]
    if not isinstance(drive, Drive) or all(moved.crossed):
        return own
    count = len(seats(drive.joints)[0])
    found = np.concatenate((own, np.zeros((*own.shape[:-1], count - 5))), axis=-1)
    for j, joint in enumerate(drive.joints):
        if not joint.single_cross:
            found[j] = own_laws.influence(joint, float(moved.joint_angle[j]), moved.yoke_rotation[j], count)
    return found


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
    """Return the joint angles, planes and yokes of a drive to be walked along; see `own_kinds` on joints in them."""
    return given_chain(drive) if isinstance(drive, Drive) else kinematics(drive)


def own_kinds(drive: Drive | Drives | Chain) -> tuple[Joint | None, ...]:
    """Return the joints of one drive that turn by a law of their own, None for each that is a loop of four axes.

    Of a batch there are none: in its chain joints of other kinds stand as the cross joints that turn alike.
    """
    if not isinstance(drive, Drive):
        return ()
    return tuple(None if joint.single_cross else joint for joint in drive.joints)


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
        Errors of each joint in the order of `TURNS`, those of the sizes of its kind after them where a joint has any;
        of its axes so many that they broadcast with those of the drives.
    ways : array (..., n, 5) [m], optional
        Errors of each joint in the order of `WAYS`.
    errors : Error, or n of them, optional
        Errors by name instead; those of the drive where nothing is given.
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
    u_j = -s_4 with s_1 = u_{j-1} + its own. To first order Book (171), (180), chained. Joints of other kinds turn by
    their law with their joint angle, the place of their driving mark and the sizes that it follows off by the errors;
    they pass on a shift as they pass on the turn, one that slides none. A size by which a shaft lies elsewhere adds
    what the joints turn as they then stand.

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
    chain, own = walked(drive), own_kinds(drive)
    xp = namespace(chain.joint_angle, turns, ways)
    phi = xp.asarray(one_turn()) if angle is None else real(angle, xp)
    phi = phi if phi.ndim else phi[None]
    held = located_shafts(drive) if located is None else tuple(located)
    turned, shifted = _given(drive, chain.joints, turns, ways, errors, xp)
    mu = chain.turn_before
    start = xp.cos(mu[..., :1] + phi), xp.sin(mu[..., :1] + phi)
    ideal, linear = walk(chain, None, start, own=own, carry=((turned, ()), (shifted, held)))
    actual, exact = walk(chain, turned, start, own=own, carry=((shifted, held),))
    error, more = ahead(actual, ideal), linear[-1][0]
    if isinstance(drive, Drive):
        names = seats(drive.joints)
        if off := places.of_errors(drive, names, turned):
            error = error + places.moved(drive, phi, off).angle
            for (j, key), found in places.influences(drive, phi, names).items():
                more = more + turned[..., j, names[j].index(key), None] * found.angle
    shape = (error + exact[-1][0]).shape

    def curves(rows: list[Array]) -> Array:
        return xp.stack([xp.broadcast_to(row, shape) for row in rows], axis=-2)

    error = xp.broadcast_to(error, shape)
    return TransmissionError(
        angle=phi,
        error=error,
        error_linear=xp.broadcast_to(more, shape),
        shift=curves([row[0] for row in exact]),
        shift_linear=curves([row[1] for row in linear]),
        closes=xp.all(xp.isfinite(error), axis=-1),
    )


def walk(
    chain: Chain,
    errors: Array | None,
    start: tuple[Array, Array],
    *,
    own: Sequence[Joint | None] = (),
    carry: Sequence[tuple[Array, Sequence[int]]] = (),
) -> tuple[tuple[Array, Array], list[tuple[Array, ...]]]:
    """Walk along chains, joint by joint.

    errors (..., n, c): of the joints as they are, in the order of `own_laws.seats`; None for perfect ones.
    start, two arrays (..., p): cosine and sine of θ_1; own: joints that turn by a law of their own, see `own_kinds`.
    carry, sequence of (array (..., n, c), sequence of int): errors to be carried along through the coefficients, and
    the numbers of the shafts where they end; of joints as they are those of length alone, to which no law of its own
    adds anything.
    Returns tuple of two arrays (..., p): cosine and sine of the angle of the last driven yoke; list of n tuples of
    arrays (..., p): what has become of each of ``carry`` behind each joint.
    """
    cosine, sine = links(chain.joint_angle, errors)
    xp, mu = namespace(cosine, *start), chain.turn_before
    direction, found = start, []
    carried = tuple(0.0 * start[0] for _errors in carry)
    for j in range(chain.joints):
        if j:
            direction = _on(direction, mu[..., j, None], xp)
        if errors is not None:
            direction = _on(direction, errors[..., j, 0, None], xp)
        joint, row = own[j] if own else None, (cosine[..., j, None, :], sine[..., j, None, :])
        if joint is not None:
            off = errors[..., j, :] if errors is not None else np.zeros(len(seats([joint])[0]))
            first = carry[0][0].shape[-1] if carry and errors is None else 1
            direction, table = _by_its_law(joint, float(chain.joint_angle[j]), off, direction, first)
        elif carry:
            along, across, table = loops.driven(*row, *direction)
            direction = along, across
        else:
            direction, table = loops.followed(*row, *direction), ()
        carried = tuple(
            _carried(table, 0.0 * before if j + 1 in ends else before, given[..., j, None, :])
            for before, (given, ends) in zip(carried, carry, strict=True)
        )
        found.append(carried)
    return direction, found


def _by_its_law(
    joint: Joint,
    joint_angle: float,
    errors: Array,
    direction: tuple[Array, Array],
    count: int,
) -> tuple[tuple[Array, Array], tuple[Array, ...]]:
    """Return the driven mark of a joint that turns by its law, as a cross would stand there, and some coefficients."""
    theta = np.atan2(direction[1], direction[0])
    lead, ratio = own_laws.turned(joint, joint_angle, errors, theta)
    table = (ratio,) if count == 1 else np.moveaxis(own_laws.influence(joint, joint_angle, theta, count), -1, 0)
    return _on(direction, lead - (0.0 if joint.crossed else 0.5 * np.pi), np), tuple(table)


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
    alpha = alpha if turned is None else alpha + turned[..., 1:5]
    return xp.cos(alpha), xp.sin(alpha)


def located_shafts(drive: Drive | Drives | Chain) -> tuple[int, ...]:
    """Return the numbers of the shafts at whose end a shift ends: held along their axis, or before what slides."""
    if not isinstance(drive, Drive):
        return ()
    sliding = {k for k, joint in enumerate(drive.joints, 1) if joint.slides}
    return tuple(sorted(sliding | {support.shaft for support in drive.supports if support.axial}))


def error_arrays(errors: Sequence[object | None], joints: Sequence[Joint] = ()) -> tuple[Array, Array]:
    """Return errors, or tolerances, by name as arrays: those that turn (n, c), those that shift (n, 5) [rad, and SI].

    joints: those that they belong to; cross joints where they are not given.

    >>> error_arrays([Error(alpha2=0.1, a4=0.2)])[0]
    array([[0. , 0. , 0.1, 0. , 0. ]])
    """
    names = seats(joints) if joints else [TURNS] * len(errors)
    ways = way_names(joints) if joints else [WAYS] * len(errors)
    turned, shifted = (
        np.asarray(
            [[getattr(one, name, 0.0) if name else 0.0 for name in row] for one, row in zip(errors, rows, strict=True)],
            dtype=float,
        )
        for rows in (names, ways)
    )
    return turned, shifted


def way_names(joints: Sequence[Joint]) -> list[tuple[str, ...]]:
    """Return the names of the errors of each joint that shift the output, "" where a joint of its kind has none."""
    return [WAYS if joint.single_cross else ("",) * len(WAYS) for joint in joints]


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
        wide = len(seats(drive.joints)[0]) if isinstance(drive, Drive) else 5
        if wide > 5 and tuple(arrays[0].shape[-2:]) == (joints, wide):
            return arrays[0], _of_crosses(drive, arrays[1])
        check(
            Problem(name, _("shape {shape} is not (..., {joints}, 5)").format(shape=tuple(one.shape), joints=joints))
            for name, one in zip(("turns", "ways"), arrays, strict=True)
            if tuple(one.shape[-2:]) != (joints, 5)
        )
        return arrays[0], _of_crosses(drive, arrays[1])
    turned, shifted = given_errors(drive, joints, errors)
    return real(turned, xp), real(shifted, xp)


def _of_crosses(drive: Drive | Drives | Chain, ways: Array) -> Array:
    """Return errors of length with those of joints without a single cross left out."""
    own = own_kinds(drive)
    return np.where(np.asarray([[one is None] for one in own]), ways, 0.0) if any(own) else ways


def given_errors(drive: Drive | Drives | Chain, joints: int, errors: Errors) -> tuple[Array, Array]:
    """Return errors by name, those of the drive where none are given, as `error_arrays` does."""
    given = [None] * joints if errors is None else per_joint("errors", errors, joints)
    if not isinstance(drive, Drive):
        return error_arrays(given)
    return error_arrays([joint.error for joint in drive.joints] if errors is None else given, drive.joints)


def _on(direction: tuple[Array, Array], angle: Array, xp: Any) -> tuple[Array, Array]:
    """Turn a direction on by an angle."""
    along, across = direction
    c, s = xp.cos(angle), xp.sin(angle)
    return along * c - across * s, along * s + across * c


def _carried(carried: Sequence[Array], before: Array, own: Array) -> Array:
    """Return what a joint makes of the error before it and its own, through its row of coefficients."""
    total = carried[0] * (before + own[..., 0])
    for k in range(1, min(len(carried), own.shape[-1])):
        total = total + carried[k] * own[..., k]
    return total
