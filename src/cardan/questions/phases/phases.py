"""Which yoke angles make a drive synchronous, or as even as it can be?"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import scipy

from cardan.drive.conditions import in_poses
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import pose_drives
from cardan.drive.fields.validity import wrong_count
from cardan.drive.models.kinematics_model import Chain, far_laws, lawless, nearly_turning_chain, wobble_problems
from cardan.drive.models.wobble import wobbling
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.maths.kernel import polygon
from cardan.maths.ties import foremost, foremost_of
from cardan.questions.motion.equivalence import SYNCHRONOUS as EVEN
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.texts import _

from . import own_laws
from .family import STRETCHED, Blocks, best_member, blocks, distinct
from .phasing import Phasing, joint_angle_of
from .setting import NEAREST, SYNCHRONOUS, Choice, Goal, LeastIntermediate, YokeSetting, settings, turned, with_yokes
from .spline_pitch import EVERY, TIE, best_pitched, on_teeth, steps
from .steering import columns


def phases(
    drive: Drive,
    *,
    fixed: Mapping[int, float] | None = None,
    goal: Goal = SYNCHRONOUS,
    poses: Mapping[str, Drive] | None = None,
    progress: Callable[[float], object] | None = None,
) -> Phasing:
    """Return the yoke angles that make a drive synchronous, or as even as it can be, with the proof.

    Parameters
    ----------
    drive : Drive
        The drive; shafts with ``yoke_fixed`` keep their yoke angles.
    fixed : mapping of int to float, optional
        Shaft number -> yoke angle to hold [rad].
    goal : Goal
        What to choose where synchronism leaves a choice.
    poses : mapping of str to Drive, optional
        The drive in several poses by name; those of the drive by default, with the drive as drawn where they leave it
        some of the time.
    progress : function, optional
        Called with the share done; answering "stop" ends the search over poses.

    Returns
    -------
    Phasing

    Raises
    ------
    InputError
        A steering column with a joint that turns by a law of its own; ``fixed`` names a shaft that has no yokes to
        set, or a value that is not finite; the goal has too many or too few weights; a pose has another number of
        joints.

    See Also
    --------
    layout, synchronous_yokes

    Notes
    -----
    A drive with joints that turn far from tan θ' = κ tan θ, or whose shafts wobble, is followed joint by joint, and the
    yokes are sought: without proof, and without a goal among equals.

    Exact: with L_i = -ln cos α_i the drive can be synchronous if and only if the largest L is no more than the sum of
    the others; joints of other kinds count as the Hooke joints that turn alike,
    within a microradian. Joints with held yokes between them
    count as one. Replaces the first-order Book (77)-(86).

    Examples
    --------
    >>> from cardan import Drive, phases
    >>> from cardan.units import deg
    >>> found = phases(Drive.from_angles([10 * deg, 15 * deg, 17 * deg]))
    >>> found.feasible, [s.speed_fluctuation < 1e-14 for s in found.settings]
    (True, [True, True])
    """
    if far_laws(drive) or wobbling(drive):
        return _by_laws(drive, _held(drive, fixed or {}), poses)
    whole = nearly_turning_chain(drive, _("yoke angles"))
    as_built = np.asarray(whole.yoke_angle)
    if goal.weights is not None:
        check(wrong_count("goal.weights", goal.weights, whole.joints - 1))
    held = _held(drive, fixed or {})
    start = as_built.copy()
    for number, angle in held.items():
        start[number - 2] = angle
    free = [k for k in range(whole.joints - 1) if k + 2 not in held]
    figure = blocks(whole, start, free)
    low, high = polygon.reach(figure.lengths)
    feasible = 2.0 * math.sinh(low) <= EVEN
    choice = Choice(chain=whole, as_built=as_built, weight=_weights(drive))
    rows = _optima(figure, choice, goal, family=low == 0.0 and len(free) > 2)
    teeth = _teeth(drive, free)
    pitched, refusal = _pitched(choice, start, teeth, [k for k in free if k not in teeth])
    names, drives, said = _poses(drive, poses)
    chains = [nearly_turning_chain(one, _("yoke angles")) for one in drives]
    share = _shares(said)
    suited = [whole, *chains][len(chains) + 1 - len(share) :]
    posed, complete = _posed(suited, share, start, free, rows, progress)
    if len(posed) and teeth:
        posed = np.concatenate((posed, best_on_teeth(stacked(suited), share, start, teeth, free, posed)))
    limiting = () if feasible else figure.joints[int(foremost(figure.lengths))]

    def evaluated(yokes: Array, labels: Sequence[str]) -> tuple[YokeSetting, ...]:
        return settings(whole, yokes, labels, as_built, chains) if len(labels) else ()

    present = evaluated(as_built[None], [_("as specified")])[0]
    return Phasing(
        as_built=present,
        feasible=feasible,
        speed_fluctuation_min=2.0 * math.sinh(low),
        speed_fluctuation_max=2.0 * math.sinh(high),
        joint_angle_min=joint_angle_of(low),
        joint_angle_max=joint_angle_of(high),
        free=tuple(k + 2 for k in free),
        fixed=tuple(sorted(held)),
        settings=evaluated(rows, [chr(ord("A") + k) for k in range(len(rows))]) if whole.joints > 1 else (),
        spline_settings=evaluated(pitched, _spline_labels(teeth, len(pitched))),
        spline_steps={k + 2: steps(z) for k, z in teeth.items()},
        spline_refusal=refusal,
        limiting_joint=foremost_of(limiting, lambda i: float(whole.joint_angle[i])) + 1 if limiting else None,
        limiting_joints=tuple(i + 1 for i in limiting),
        poses=names,
        pose_settings=evaluated(posed, _pose_labels(teeth, len(posed))),
        steering=columns(drive, whole, figure, present, teeth=teeth, poses=chains, posed=drives),
        complete=complete,
    )


def _by_laws(drive: Drive, held: Mapping[int, float], poses: Mapping[str, Drive] | None) -> Phasing:
    """Return what the yoke angles can do where joints turn by laws of their own or shafts wobble: no polygon tells."""
    if drive.steering is not None:
        text = _("yoke angles of a steering column")
        check([*(lawless(i, drive.joints[i], text) for i in far_laws(drive)), *wobble_problems(drive)])
    free = [shaft.number - 2 for shaft in drive.shafts[1:-1] if shaft.number not in held]
    teeth = _teeth(drive, free)
    names, drives, said = _poses(drive, poses)
    share = _shares(said)
    return own_laws.sought(
        drive,
        held=held,
        free=free,
        teeth=teeth,
        poses=dict(zip(names, drives, strict=True)),
        share=share,
        labels=(_pose_labels({}, 2), _spline_labels(teeth, PITCHED) if teeth else []),
    )


def _weights(drive: Drive) -> Array:
    return np.asarray([shaft.weight for shaft in drive.shafts[1:-1]], dtype=float)


def _held(drive: Drive, fixed: Mapping[int, float]) -> dict[int, float]:
    """Return shaft number -> held yoke angle, from the drive and from ``fixed``."""
    n = len(drive.joints)
    problems = []
    for number, angle in fixed.items():
        if not 2 <= number <= n:
            between = _("shafts 2 to {last} have").format(last=n) if n > 1 else _("this drive has no such shaft")
            problems.append(
                Problem(
                    f"fixed[{number}]",
                    _("shaft {number} has no two yokes to set; {between}").format(number=number, between=between),
                )
            )
        if not math.isfinite(angle):
            problems.append(Problem(f"fixed[{number}]", _("{angle} is not a finite angle").format(angle=angle)))
    check(problems)
    own = {shaft.number: shaft.yoke_angle for shaft in drive.shafts[1:-1] if shaft.yoke_fixed}
    return {**own, **{number: float(angle) for number, angle in fixed.items()}}


def _teeth(drive: Drive, free: Sequence[int]) -> dict[int, int]:
    """Return index of the free yoke angle -> spline teeth."""
    found = {}
    for k in free:
        spline = drive.shafts[k + 1].spline
        if spline is not None and spline.teeth is not None:
            found[k] = spline.teeth
    return found


def _pitched(choice: Choice, start: Array, teeth: Mapping[int, int], loose: Sequence[int]) -> tuple[Array, str]:
    if not teeth:
        return start[None][:0], ""
    try:
        return best_pitched(choice.chain, start, teeth, loose), ""
    except InputError as error:
        return start[None][:0], error.problems[0].message


def _pose_labels(teeth: Mapping[int, int], count: int) -> list[str]:
    plain = [_("least in the worst pose"), _("least mean of the poses")]
    spline = _spline_labels(teeth, 1)[0] if teeth else ""
    return [*plain, *(_("{spline}, {what}").format(spline=spline, what=one) for one in plain)][:count]


def _spline_labels(teeth: Mapping[int, int], count: int) -> list[str]:
    kinds = "/".join(str(z) for z in dict.fromkeys(teeth.values()))
    first = _("{teeth}-tooth splines").format(teeth=kinds)
    return [first, *(_("{name}, no. {rank}").format(name=first, rank=rank) for rank in range(2, count + 1))][:count]


def _poses(drive: Drive, poses: Mapping[str, Drive] | None) -> tuple[tuple[str, ...], list[Drive], list[float | None]]:
    """Return names and drives of the poses, and the shares: of the drive as drawn, then theirs."""
    if poses is None:
        given = list(zip((pose.name for pose in drive.poses), pose_drives(drive), strict=True))
        said = [one.share for one in in_poses(drive)]
    else:
        given = list(poses.items())
        shares = {pose.name: pose.share for pose in drive.poses}
        said = [0.0, *(shares.get(name) for name, _pose in given)]
    problems = [
        Problem(
            f"poses[{k}]",
            _("has {count} joints, the drive has {wanted}").format(count=len(one.joints), wanted=len(drive.joints)),
        )
        for k, (_name, one) in enumerate(given)
        if len(one.joints) != len(drive.joints)
    ]
    check(problems)
    return (tuple(name for name, _one in given), [one for _name, one in given], said)


def _shares(said: Sequence[float | None]) -> Array:
    """Return the shares of what the yokes are to suit: the drive as drawn where it has time, its poses; none without.

    said: shares of the drive as drawn and of its poses; those not said have what is left, each as much.
    """
    if len(said) < 2:
        return np.zeros(0)
    every = said[1:] if said[0] == 0.0 else said
    known = [share for share in every if share is not None]
    rest = max(0.0, 1.0 - sum(known)) / max(1, len(every) - len(known))
    weight = np.asarray([rest if share is None else share for share in every])
    even = np.ones(len(every)) / len(every)
    return weight / weight.sum() if weight.sum() > 0 else even


def _posed(
    chains: Sequence[Chain],
    share: Array,
    start: Array,
    free: Sequence[int],
    rows: Array,
    progress: Callable[[float], object] | None,
) -> tuple[Array, bool]:
    if not chains:
        return rows[:0], True
    known = np.concatenate([rows, *(blocks(pose, start, free).closed() for pose in chains)])
    worst, mean, complete = best_for_poses(stacked(chains), share, start, free, known, progress)
    return np.stack((worst, mean)), complete


def _optima(figure: Blocks, choice: Choice, goal: Goal, *, family: bool) -> Array:
    """Return the sets of yoke angles to show, best first: one, its mirror image, and the best by the other goal."""
    if not family:
        rows = figure.closed()
        return rows[np.argsort(np.round(goal.cost(choice, rows), 9), kind="stable")]
    rows = _least_intermediate(figure, choice, goal if isinstance(goal, LeastIntermediate) else SYNCHRONOUS)
    nearest = best_member(figure, choice, NEAREST if isinstance(goal, LeastIntermediate) else goal, rows)
    if isinstance(goal, LeastIntermediate):
        return _once([*rows, nearest])
    return _once([nearest, figure.mirrored(nearest), rows[0]])


def _least_intermediate(figure: Blocks, choice: Choice, goal: LeastIntermediate) -> Array:
    """Return the synchronous setting with the calmest intermediate shafts and its mirror image, array (2, n-1)."""
    if len(figure.sides) == choice.chain.joints:
        weight = choice.weight if goal.weights is None else np.asarray(goal.weights)
        rows = figure.closed(polygon.shortest_diagonals(figure.lengths, [*weight.tolist(), 0.0], 0.0))
        nearest = int(np.argmin(NEAREST.cost(choice, rows)))
        return rows[nearest - nearest % 2 : nearest - nearest % 2 + 2]
    best = best_member(figure, choice, goal, figure.closed())
    return np.stack((best, figure.mirrored(best)))


def _once(rows: Sequence[Array]) -> Array:
    """Return the rows without those that repeat an earlier one modulo π."""
    kept: list[Array] = []
    for row in rows:
        if all(np.abs(np.sin(row - other)).max() > STRETCHED for other in kept):
            kept.append(row)
    return np.stack(kept)


__all__ = ["NEAREST", "SYNCHRONOUS", "Phasing", "YokeSetting", "phases"]


# One set of yoke angles for several poses of a drive.
#
# A drive that is synchronous in one pose is not so in another. The yokes are the same in all: sought are those with the
# smallest speed fluctuation in the worst pose, and those with the smallest mean over the poses by their share of time.

TRIALS = 32
"""Angles of the yokes without teeth tried for each setting on teeth."""

SAMPLES = 2048
"""Settings looked at before the search."""

STARTS = 5
"""Best settings from which it starts."""

BLURS = (1e-3, 1e-5, 1e-8)
"""Rounding of the corner that δ has where it vanishes, share of the best δ looked at, in turn."""

OPTIONS: Any = {"maxiter": 200, "ftol": 1e-12}
"""For the search (SLSQP); its function values are of order one."""

PITCHED = 6
"""Settings on spline teeth that are told."""

Progress = Callable[[float], object]


def stacked(poses: Sequence[Chain]) -> Chain:
    """Return the drive in its poses as one batch (p, n)."""
    return Chain(
        joint_angle=np.stack([pose.joint_angle for pose in poses]),
        plane_twist=np.stack([pose.plane_twist for pose in poses]),
        yoke_angle=np.stack([pose.yoke_angle for pose in poses]),
        start_phase=np.stack([np.asarray(pose.start_phase) for pose in poses]),
    )


def speed_fluctuations(poses: Chain, yoke_angle: Array) -> Array:
    """Return δ of yoke settings (..., n-1) [rad] in every pose, array (..., p)."""
    return equivalent_joint(with_yokes(poses, _each(poses, yoke_angle))).speed_fluctuation


def _each(poses: Chain, yoke_angle: Array) -> Array:
    shape = (*yoke_angle.shape[:-1], poses.joint_angle.shape[0], yoke_angle.shape[-1])
    return np.broadcast_to(yoke_angle[..., None, :], shape)


def best_for_poses(
    poses: Chain, share: Array, yoke_angle: Array, free: Sequence[int], known: Array, progress: Progress | None = None
) -> tuple[Array, Array, bool]:
    """Return the settings with the least worst and with the least mean speed_fluctuation over the poses.

    poses (p, n): the drive in its poses; share (p,): shares of time, summing to one.
    yoke_angle (n-1,) [rad]: held and present yoke angles; free: indices of the free ones.
    known (s, n-1) [rad]: settings worth starting from, such as those that are synchronous in one pose.
    Returns worst, mean (n-1,) [rad]: yoke angles for the least worst and the least mean speed_fluctuation; complete:
    False when stopped.
    """
    if not free:
        return yoke_angle, yoke_angle, True
    rows = np.concatenate((yoke_angle[None], known, np.repeat(yoke_angle[None], SAMPLES, axis=0)))
    rows[-SAMPLES:, list(free)] = np.random.default_rng(len(free)).uniform(0.0, np.pi, (SAMPLES, len(free)))
    uneven = speed_fluctuations(poses, rows)
    answers: list[Array] = []
    total = 2 * STARTS
    for number, (judge, search) in enumerate(((_worst, _min_max), (_mean, _least_mean))):
        cost = judge(uneven, share)
        best, least = rows[int(np.argmin(cost))], float(np.min(cost))
        for k, start in enumerate(distinct(rows[np.argsort(cost, kind="stable")], STARTS)):
            if progress is not None and progress((number * STARTS + k) / total) == "stop":
                answers.append(best)
                return answers[0], answers[-1], False
            found = search(poses, share, start, list(free), max(least, 1e-9))
            value = float(judge(speed_fluctuations(poses, found), share))
            if value < least:
                best, least = found, value
        answers.append(best)
    return answers[0], answers[1], True


def best_on_teeth(
    poses: Chain, share: Array, yoke_angle: Array, teeth: Mapping[int, int], free: Sequence[int], found: Array
) -> Array:
    """Return the settings that splines allow with the least worst and the least mean speed_fluctuation over the poses.

    poses (p, n): the drive in its poses; share (p,): shares of time, summing to one.
    yoke_angle (n-1,) [rad]: present yoke angles, from which the teeth count.
    teeth: index 0 … n-2 of a yoke angle -> teeth of the spline there; free: indices of all that may be turned.
    found (2, n-1) [rad]: the best without teeth.
    Returns (2, n-1) [rad]: of all settings on teeth where they can be looked at one by one, see `on_teeth`; free yokes
    without teeth are turned anew for the best of them.
    """
    loose = [k for k in free if k not in teeth]
    random = np.random.default_rng(len(free))
    rows = []
    for judge, search, base in zip((_worst, _mean), (_min_max, _least_mean), found, strict=True):
        some = on_teeth(base, yoke_angle, teeth)
        if loose:
            count = max(1, min(TRIALS, EVERY // len(some)))
            trials = np.repeat(some[:, None], 1 + count, axis=1)
            trials[:, 1:, loose] = random.uniform(0.0, np.pi, (count, len(loose)))
            cost = judge(speed_fluctuations(poses, trials), share)
            some = np.take_along_axis(trials, np.argmin(cost, axis=1)[:, None, None], axis=1)[:, 0]
        cost = judge(speed_fluctuations(poses, some), share)
        if loose:
            near = np.argsort(cost, kind="stable")[: 2 * STARTS]
            least = max(float(cost[near[0]]), 1e-9)
            some = np.concatenate((some[near], [search(poses, share, one, loose, least) for one in some[near]]))
            cost = judge(speed_fluctuations(poses, some), share)
        away = np.sum(np.abs(np.sin(some - yoke_angle)), axis=-1)
        alike = np.flatnonzero(cost <= np.min(cost) + TIE)
        rows.append(some[alike[int(np.argmin(np.round(away[alike], 9)))]])
    return np.stack(rows)


def _worst(uneven: Array, share: Array) -> Array:
    return np.max(uneven, axis=-1)


def _mean(uneven: Array, share: Array) -> Array:
    return np.sum(share * uneven, axis=-1)


def _squares(poses: Chain, yoke_angle: Array, free: list[int]) -> tuple[Array, Array]:
    """Return |b|² of each pose (p,) and its derivatives by the free yokes (p, f); δ² = 16 |b|² (1 + |b|²)."""
    (_a, b), _da, db = turned(with_yokes(poses, _each(poses, yoke_angle)))
    return np.abs(b) ** 2, 2.0 * np.real(np.conj(b)[:, None] * db[:, free])


def _put(start: Array, free: list[int], x: Array) -> Array:
    moved = start.copy()
    moved[free] = x
    return moved


def _min_max(poses: Chain, share: Array, start: Array, free: list[int], scale: float) -> Array:
    """Minimise t with |b|² ≤ t in every pose."""
    unit = (0.25 * scale) ** 2

    def room(z: Array) -> Array:
        return z[-1] - _squares(poses, _put(start, free, z[:-1]), free)[0] / unit

    def room_slope(z: Array) -> Array:
        slope = _squares(poses, _put(start, free, z[:-1]), free)[1]
        return np.column_stack((-slope / unit, np.ones(len(slope))))

    top = float(np.max(_squares(poses, start, free)[0])) / unit
    pick = np.append(np.zeros(len(free)), 1.0)

    def top_of(z: Array) -> float:
        return float(z[-1])

    def rise(z: Array) -> Array:
        return pick

    kept: Any = {"type": "ineq", "fun": room, "jac": room_slope}
    found = scipy.optimize.minimize(
        top_of, np.append(start[free], top), jac=rise, method="SLSQP", constraints=kept, options=OPTIONS
    ).x
    return _put(start, free, found[:-1])


def _least_mean(poses: Chain, share: Array, start: Array, free: list[int], scale: float) -> Array:
    """Minimise Σ share δ with rounded corners."""
    near = start[free]
    for blur in BLURS:

        def mean(x: Array, blur: float = blur) -> tuple[float, Array]:
            square, slope = _squares(poses, _put(start, free, x), free)
            uneven = np.sqrt(16.0 * square * (1.0 + square) + (blur * scale) ** 2)
            each = share * 8.0 * (1.0 + 2.0 * square) / uneven
            return float(np.sum(share * uneven)) / scale, np.sum(each[:, None] * slope, axis=0) / scale

        near = scipy.optimize.minimize(mean, near, jac=True, method="SLSQP", options=OPTIONS).x
    return _put(start, free, near)
