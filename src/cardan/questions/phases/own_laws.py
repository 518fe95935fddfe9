"""Yoke angles of a drive some of whose joints turn by laws of their own, or whose shafts wobble: sought, not closed.

A law that is no tan θ' = κ tan θ has orders besides the second; yokes that stand half a turn on turn otherwise, so that
yoke angles are told in (-π, π]. What the joints leave is seen at `PLACES` of a turn, joint behind joint, exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import numpy as np
import scipy

from cardan.drive.drive import Drive
from cardan.drive.joints.common.laws import waved
from cardan.drive.models.kinematics_model import given_chain
from cardan.drive.models.wobble import course, wobbling
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import peak
from cardan.questions.motion.equivalence import SYNCHRONOUS
from cardan.texts import _
from cardan.units import deg

from .phasing import Phasing, joint_angle_of
from .setting import YokeSetting
from .spline_pitch import EVERY, on_teeth, steps

PLACES = 360
"""Places of a turn at which the ratio of a shaft is looked at."""

SAMPLES = 256
"""Places of a turn by which the law of a joint is told, with all orders that a joint has."""

FOLLOWED, DENSE = 120, 720
"""Places of a turn at which wobbling shafts are followed, and at which their ratio is seen by its harmonics."""

BATCH = 128
"""Settings looked at at once."""

SIXTHS = np.arange(1, 6) * (np.pi / 3.0)
"""Turns by which what crosses and tripods make repeats."""

OPTIONS: Any = {"fatol": 1e-13, "maxiter": 400}
"""For the search (Nelder and Mead); the least fluctuation has corners, where slopes tell nothing."""


class Course(Protocol):
    """How a drive turns as drawn, whatever its yoke angles."""

    tried: ClassVar[int]  # settings looked at before the search, for each free yoke
    starts: ClassVar[int]  # best of them from which it starts
    near: ClassVar[float]  # [rad]: how near to the best it ends

    def fluctuation(self, yoke_angle: Array) -> Array:
        """Return δ of shafts 2 … n+1 for yoke angles (..., n-1) [rad], array (..., n)."""

    def initial_phases(self, yoke_angle: Array) -> Array:
        """Return ψ of every joint for yoke angles (n-1,) [rad], array (n,)."""


@dataclass(frozen=True, eq=False)
class LawCourse:
    """The laws of the joints of a drive as drawn, and how one stands against the next."""

    tried: ClassVar[int] = 256
    starts: ClassVar[int] = 6
    near: ClassVar[float] = 1e-9

    laws: tuple[Array, ...]  # leads of every joint at `SAMPLES` even places of a turn [rad]
    shift: Array  # (n-1,) [rad]: what is added from joint to joint, less the yoke angle
    start: float  # [rad]: where the mark of the first joint stands at the start

    def fluctuation(self, yoke_angle: Array) -> Array:
        """Return δ of shafts 2 … n+1 for yoke angles (..., n-1) [rad], array (..., n)."""
        rows = np.reshape(yoke_angle, (math.prod(yoke_angle.shape[:-1]), yoke_angle.shape[-1]))
        parts = [self._seen(rows[k : k + BATCH]) for k in range(0, max(len(rows), 1), BATCH)]
        return np.reshape(np.concatenate(parts), (*yoke_angle.shape[:-1], len(self.laws)))

    def initial_phases(self, yoke_angle: Array) -> Array:
        """Return ψ of every joint for yoke angles (n-1,) [rad], array (n,)."""
        psi = [self.start]
        for k, law in enumerate(self.laws[:-1]):
            psi.append(float(psi[-1] + waved(np.asarray(psi[-1]), law)[0] + self.shift[k] - yoke_angle[k]))
        return np.asarray(psi)

    def _seen(self, rows: Array) -> Array:
        theta = np.broadcast_to(np.arange(PLACES) * (2.0 * np.pi / PLACES), (len(rows), PLACES))
        ratio, found = np.ones((len(rows), PLACES)), []
        for k, law in enumerate(self.laws):
            lead, own, _slope = waved(theta, law)
            ratio = ratio * own
            found.append(peak(ratio, smooth=True) + peak(-ratio, smooth=True))
            if k + 1 < len(self.laws):
                theta = theta + lead + (self.shift[k] - rows[:, k])[:, None]
        return np.stack(found, axis=-1)


@dataclass(frozen=True, eq=False)
class WobblingCourse:
    """A drive whose shafts wobble, followed over a turn as its motion is."""

    tried: ClassVar[int] = 64  # a wobble changes little of what the yokes do, and each setting takes milliseconds
    starts: ClassVar[int] = 2
    near: ClassVar[float] = 1e-7

    drive: Drive

    def fluctuation(self, yoke_angle: Array) -> Array:
        """Return δ of shafts 2 … n+1 for yoke angles (..., n-1) [rad], array (..., n)."""
        if 0 in yoke_angle.shape[:-1]:
            return np.zeros((*yoke_angle.shape[:-1], len(self.drive.joints)))
        turn = np.arange(FOLLOWED) * (2.0 * np.pi / FOLLOWED)
        found = course(self.drive, np.broadcast_to(turn, (*yoke_angle.shape[:-1], FOLLOWED)), yokes=yoke_angle)
        wave = np.fft.rfft(np.unwrap(found.turned[1:] - turn, axis=-1))
        ratio = np.fft.irfft(1j * np.arange(wave.shape[-1]) * wave, DENSE, axis=-1) * (DENSE / FOLLOWED)
        return np.moveaxis(peak(ratio, smooth=True) + peak(-ratio, smooth=True), 0, -1)

    def initial_phases(self, yoke_angle: Array) -> Array:
        """Return ψ of every joint for yoke angles (n-1,) [rad], array (n,)."""
        found: Array = course(self.drive, np.zeros(1), yokes=yoke_angle).theta[:, 0]
        return found


def course_of(drive: Drive) -> Course:
    """Return how a drive turns as drawn, each joint by its own law."""
    if wobbling(drive):
        return WobblingCourse(drive)
    whole = given_chain(drive)
    theta = np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES)
    angles = np.asarray(whole.joint_angle)
    laws = [joint.deviation(theta, alpha)[0] for joint, alpha in zip(drive.joints, angles, strict=True)]
    quarter = np.asarray([0.5 * np.pi if joint.crossed else 0.0 for joint in drive.joints[:-1]])
    return LawCourse(tuple(laws), quarter - np.asarray(whole.plane_twist), float(whole.start_phase))


def whole_turn(angle: Array) -> Array:
    """Return yoke angles in (-π, π]."""
    return np.pi - np.remainder(np.pi - np.asarray(angle, dtype=float), 2.0 * np.pi)


Judge = Callable[[Array], Array]
"""What is to be least: of δ of the output in every pose (..., p)."""


@dataclass(frozen=True, eq=False)
class Search:
    """Settings of the free yokes of a drive, in one pose or several."""

    poses: Sequence[Course]
    start: Array  # (n-1,) [rad]: held and present yoke angles
    free: Sequence[int]

    def left(self, rows: Array) -> Array:
        """Return δ of the output for settings (..., n-1) [rad] in every pose, array (..., p)."""
        return np.stack([one.fluctuation(rows)[..., -1] for one in self.poses], axis=-1)

    def best(self, judge: Judge) -> Array:
        """Return the setting (n-1,) [rad] that a judge calls least; a tie goes to the one nearest to the present."""
        if not self.free:
            return self.start
        count = self.poses[0].tried * 2 ** math.ceil(math.log2(len(self.free)))
        tried = np.repeat(self.start[None], count + 1, axis=0)
        tried[1:, list(self.free)] += 2.0 * np.pi * scipy.stats.qmc.Sobol(len(self.free), rng=0).random(count)
        cost = judge(self.left(tried))
        near = tried[np.argsort(cost, kind="stable")[: self.poses[0].starts]]
        ends = [self._down(one, judge) for one in near]
        rows = np.stack([self.start, *near, *(like for one in ends for like in self._alike(one))])
        cost = judge(self.left(rows))
        away = np.sum(1.0 - np.cos(rows - self.start), axis=-1)
        least = np.flatnonzero(cost <= np.min(cost) + 1e-9)
        return whole_turn(rows[least[int(np.argmin(np.round(away[least], 6)))]])

    def _alike(self, row: Array) -> Iterator[Array]:
        """Yield a setting, and those with one yoke by sixths of a turn on, which often leave the same."""
        yield row
        for k in self.free:
            yield from (self._put(row, row[list(self.free)] + turn * (np.asarray(self.free) == k)) for turn in SIXTHS)

    def _down(self, start: Array, judge: Judge) -> Array:
        def cost(x: Array) -> float:
            return float(judge(self.left(self._put(start, x))))

        options = OPTIONS | {"xatol": self.poses[0].near}
        found = scipy.optimize.minimize(cost, start[list(self.free)], method="Nelder-Mead", options=options)
        return self._put(start, found.x)

    def _put(self, start: Array, x: Array) -> Array:
        moved = start.copy()
        moved[list(self.free)] = x
        return moved

    def on_splines(self, best: Array, teeth: Mapping[int, int], judge: Judge, count: int) -> Array:
        """Return the best settings that splines allow beside one without them, best first, array (s, n-1) [rad]."""
        rows = on_teeth(best, self.start, teeth)
        for k, z in teeth.items():
            if z % 2 == 0:  # half a turn is so many teeth, and another setting here
                rows = np.concatenate((rows, rows + np.pi * (np.arange(rows.shape[1]) == k)))
        cost = judge(self.left(rows))
        return whole_turn(rows[np.argsort(np.round(cost, 12), kind="stable")[:count]])


def growth(poses: Sequence[Course], yoke_angle: Array, error: float = deg) -> Array:
    """Return by how much δ grows at most in any pose when one yoke stands off, array (n-1,).

    yoke_angle (n-1,) [rad]; error [rad]: how far each yoke stands off, one at a time, to the worse side.
    """
    count = len(yoke_angle)
    off = error * np.concatenate((np.eye(count), -np.eye(count)))
    rows = np.concatenate((yoke_angle[None], yoke_angle + off))
    each = [_grown(one.fluctuation(rows)[:, -1], count) for one in poses]
    return np.max(each, axis=0)


def _grown(left: Array, count: int) -> Array:
    return np.max(np.reshape(left[1:], (2, count)), axis=0) - left[0]


def sought(
    drive: Drive,
    *,
    held: Mapping[int, float],
    free: Sequence[int],
    teeth: Mapping[int, int],
    poses: Mapping[str, Drive],
    share: Array,
    labels: tuple[Sequence[str], Sequence[str]],
) -> Phasing:
    """Return what the yoke angles of a drive can do, sought by the laws of its joints.

    held: shaft number -> yoke angle [rad]; free: indices of the others; teeth: index -> teeth of the spline there.
    poses: the drive in its poses; share (p,) or (p+1,): shares of their time, with that of the drive as drawn if any.
    labels: of the settings that suit the poses, and of those on splines.
    """
    as_built = np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float)
    start = as_built.copy()
    for number, angle in held.items():
        start[number - 2] = angle
    drawn, posed = course_of(drive), [course_of(one) for one in poses.values()]

    def told(yokes: Sequence[Array], names: Sequence[str]) -> tuple[YokeSetting, ...]:
        return tuple(
            _setting(drawn, posed, whole_turn(row), as_built, name) for row, name in zip(yokes, names, strict=True)
        )

    alone = Search([drawn], start, free)
    best = alone.best(_only)
    most = alone.best(lambda left: -_only(left))
    low, high = (float(drawn.fluctuation(one)[-1]) for one in (best, most))
    low = 0.0 if low < SYNCHRONOUS else low
    on_splines = alone.on_splines(best, teeth, _only, len(labels[1])) if teeth else start[None][:0]
    suited = Search([drawn, *posed][len(posed) + 1 - len(share) :], start, free)
    wanted: list[Judge] = [lambda left: np.max(left, axis=-1), lambda left: left @ share]
    every = math.prod(steps(z) for z in teeth.values()) <= EVERY
    return Phasing(
        as_built=told([as_built], [_("as specified")])[0],
        feasible=low == 0.0,
        speed_fluctuation_min=low,
        speed_fluctuation_max=high,
        joint_angle_min=joint_angle_of(math.asinh(0.5 * low)),
        joint_angle_max=joint_angle_of(math.asinh(0.5 * high)),
        free=tuple(k + 2 for k in free),
        fixed=tuple(sorted(held)),
        settings=told([best], ["A"]) if len(as_built) else (),
        spline_settings=told(list(on_splines), labels[1][: len(on_splines)]),
        spline_steps={k + 2: 2 * steps(z) if z % 2 == 0 else steps(z) for k, z in teeth.items()},
        spline_refusal="" if every else _("too many settings for all of them; those a tooth beside the best are told"),
        poses=tuple(poses),
        pose_settings=told([suited.best(one) for one in wanted], labels[0]) if poses else (),
        followed=True,
    )


def _only(left: Array) -> Array:
    return left[..., 0]


def _setting(drawn: Course, posed: Sequence[Course], yokes: Array, as_built: Array, label: str) -> YokeSetting:
    every = drawn.fluctuation(yokes)
    step = 1e-5
    off = step * np.eye(len(yokes))
    slope = (drawn.fluctuation(yokes + off)[:, -1] - drawn.fluctuation(yokes - off)[:, -1]) / (2.0 * step)
    return YokeSetting(
        label=label,
        yoke_angle=yokes,
        speed_fluctuation=float(every[-1]),
        shaft_speed_fluctuation=every,
        initial_phase=drawn.initial_phases(yokes),
        sensitivity=slope,
        one_off=growth([drawn, *posed], yokes),
        vertex=np.zeros(len(every) + 1, dtype=complex),
        change=whole_turn(yokes - as_built),
        pose_speed_fluctuation=np.asarray([float(one.fluctuation(yokes)[-1]) for one in posed]),
    )
