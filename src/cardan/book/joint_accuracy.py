"""How do the tolerances of one joint move its cross and its driven shaft?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import loops
from cardan.questions.accuracy.accuracy import one_turn
from cardan.questions.accuracy.sampling import MonteCarlo, drawn
from cardan.texts import _

LEVELS = (0.0015, 0.025, 0.975, 0.9985)
"""Shares of the quantiles given: those around 99.7 % and around 95 %."""

DRAWS = MonteCarlo()
"""How errors are drawn where nothing else is said."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Stack:
    """What tolerances of one joint add up to; rows 2, 3, 4 are the arms of the cross and the driven shaft."""

    # worst_angle, worst_slide (..., 3) [rad], [m]: worst case Σ |C| t of φ_2, φ_3, φ_4 and of s_2, s_3, s_4
    worst_angle: Array
    worst_slide: Array  # (..., 3) [rad], [m]
    square_angle: Array  # square_angle, square_slide (..., 3) [rad], [m]: root of the sum of squares √Σ (C t)²
    square_slide: Array  # (..., 3) [rad], [m]
    share_angle: Array  # (..., 3, 4): share of each of α_1 … α_4 in the sum of squares; nan where there is none
    share_slide: Array  # (..., 3, 5): share of each of s_1, a_1 … a_4


def joint_stack(joint_angle: ArrayLike, angle: ArrayLike, *, ways: ArrayLike, turns: ArrayLike) -> Stack:
    """Return worst case and root of the sum of squares of one joint's tolerances.

    Parameters
    ----------
    joint_angle, angle : array (...) [rad]
        α and φ_1 from the plane of the shafts.
    ways : array (..., 5) [m]
        Tolerances of s_1, a_1 … a_4.
    turns : array (..., 4) [rad]
        Tolerances of α_1 … α_4.

    Notes
    -----
    C from `cardan.maths.kernel.loops.influence`; Book (171), (180), pp. 186-190.

    Examples
    --------
    >>> stack = joint_stack(0.5, 0.0, ways=[1.0, 0.0, 0.0, 0.0, 0.0], turns=[0.0, 3.0, 4.0, 0.0])
    >>> stack.worst_angle.round(3), stack.worst_slide.round(3)
    (array([6.197, 0.   , 5.604]), array([0.546, 0.   , 1.139]))
    """
    xp = namespace(joint_angle, angle, ways, turns)
    table = loops.influence(joint_angle, angle)
    slides = xp.abs(table * real(ways, xp)[..., None, :])
    angles = xp.abs(table[..., 1:] * real(turns, xp)[..., None, :])

    def share(parts: Array) -> Array:
        total = xp.sum(parts * parts, axis=-1, keepdims=True)
        return parts * parts / xp.where(total > 0.0, total, xp.nan + total)

    return Stack(
        worst_angle=xp.sum(angles, axis=-1),
        worst_slide=xp.sum(slides, axis=-1),
        square_angle=xp.sqrt(xp.sum(angles * angles, axis=-1)),
        square_slide=xp.sqrt(xp.sum(slides * slides, axis=-1)),
        share_angle=share(angles),
        share_slide=share(slides),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class StackOverTurn:
    """The largest that tolerances of one joint add up to over a turn, at the driven shaft."""

    worst_angle: float  # worst_angle, square_angle [rad]: worst case and root of the sum of squares of φ_4
    square_angle: float  # [rad]
    worst_slide: float  # worst_slide, square_slide [m]: the same of s_4
    square_slide: float  # [m]
    # (4,) [rad]: what each of α_1 … α_4 may be if all have an equal share in a target of 1 rad of φ_4, by the sum of
    # squares
    equal_turns: Array
    # (5,) [m]: what each of s_1, a_1 … a_4 may be if all have an equal share in a target of 1 m of s_4
    equal_ways: Array


def stack_over_turn(joint_angle: float, *, ways: ArrayLike, turns: ArrayLike) -> StackOverTurn:
    """Return the largest stack of one joint's tolerances over a turn.

    Parameters
    ----------
    joint_angle : float [rad]
        α.
    ways : array (5,) [m]
        Tolerances of s_1, a_1 … a_4.
    turns : array (4,) [rad]
        Tolerances of α_1 … α_4.

    Notes
    -----
    Equal shares: target/(√N max \\|C\\|) for each of N tolerances.

    Examples
    --------
    >>> found = stack_over_turn(0.5, ways=np.zeros(5), turns=[0.1, 0.0, 0.0, 0.0])
    >>> round(found.worst_angle / 0.1, 6), round(float(np.sin(0.5)), 6)
    (0.479426, 0.479426)
    """
    places = one_turn()

    def curves(angle: Array) -> Array:
        stack = joint_stack(joint_angle, angle, ways=ways, turns=turns)
        rows = (stack.worst_angle, stack.square_angle, stack.worst_slide, stack.square_slide)
        return np.stack([row[..., 2] for row in rows])

    def sizes(angle: Array) -> Array:
        found: Array = np.abs(loops.influence(joint_angle, angle)[..., 2, :]).T
        return found

    largest = peaks(curves, places, curves(places))[1]
    most = peaks(sizes, places, sizes(places))[1]
    least = np.where(most > 0.0, most, np.nan)
    return StackOverTurn(
        worst_angle=float(largest[0]),
        square_angle=float(largest[1]),
        worst_slide=float(largest[2]),
        square_slide=float(largest[3]),
        equal_turns=1.0 / (2.0 * least[1:]),
        equal_ways=1.0 / (np.sqrt(5.0) * least),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class JointSample:
    """What errors drawn at random do to one joint; rows 2, 3, 4, [rad] for angles, [m] for slides."""

    # angle_mean, angle_deviation, slide_mean, slide_deviation (3,): mean and standard deviation of what the errors add
    # to φ_i and s_i
    angle_mean: Array
    angle_deviation: Array  # (3,)
    angle_levels: Array  # angle_levels, slide_levels (4, 3): their quantiles at the shares `LEVELS`
    slide_mean: Array  # (3,)
    slide_deviation: Array  # (3,)
    slide_levels: Array  # (4, 3)
    count: int  # samples that could be assembled
    lost: int  # samples that could not


def joint_samples(
    joint_angle: float,
    angle: float,
    *,
    ways: ArrayLike,
    turns: ArrayLike,
    distribution: str = "normal",
    method: MonteCarlo = DRAWS,
) -> JointSample:
    """Return what random errors within the tolerances of one joint do, by the exact loop.

    Parameters
    ----------
    joint_angle, angle : float [rad]
        α and φ_1 from the plane of the shafts.
    ways : array (5,) [m]
        Tolerances of s_1, a_1 … a_4.
    turns : array (4,) [rad]
        Tolerances of α_1 … α_4.
    distribution : str
        "normal" with σ a third of the tolerance, "uniform" or "triangular".
    method : MonteCarlo
        How many, which seed, which points.

    Raises
    ------
    InputError
        Of the errors drawn, none can be assembled.

    Examples
    --------
    >>> found = joint_samples(0.5, 0.0, ways=np.zeros(5), turns=[0.0, 0.003, 0.0, 0.0])
    >>> f"{found.angle_deviation[2] / 0.001:.3f}"
    '1.140'
    """
    limits = np.concatenate((np.asarray(ways, dtype=float), np.asarray(turns, dtype=float)))
    right = 0.5 * np.pi
    perfect = np.asarray([right, right, right, joint_angle])
    begin = loops.rccc(perfect, angle).angle
    found: list[Array] = []
    count = 0
    for errors in drawn(limits, [distribution] * 9, method.samples, seed=method.seed, points=method.points):
        loop = loops.rccc(perfect + errors[:, 5:], angle, length=errors[:, 1:5], slide=errors[:, 0])
        off = loop.angle - begin
        off = off - 2.0 * np.pi * np.round(off / (2.0 * np.pi))
        good = loop.status == int(loops.Status.CLOSED)
        found.append(np.concatenate((off, loop.slide), axis=-1)[good])
        count += len(errors)
    rows = np.concatenate(found)
    if len(rows) < 2:
        raise refuse("turns", _("none of {count} joints with such errors can be assembled").format(count=count))
    levels = np.quantile(rows, LEVELS, axis=0)
    mean, deviation = np.mean(rows, axis=0), np.std(rows, axis=0, ddof=1)
    return JointSample(
        angle_mean=mean[:3],
        angle_deviation=deviation[:3],
        angle_levels=levels[:, :3],
        slide_mean=mean[3:],
        slide_deviation=deviation[3:],
        slide_levels=levels[:, 3:],
        count=len(rows),
        lost=count - len(rows),
    )
