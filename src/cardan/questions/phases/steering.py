"""A steering column: the yokes and the phase of the whole that give a wanted speed ratio straight ahead.

A drive turns like one joint, so its speed ratio is symmetric about straight ahead only where this is an extreme of the
ratio: the least, cos α, or the greatest, 1/cos α. The yoke angles set α; the position of the first yoke sets which of
the two stands straight ahead.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import Chain
from cardan.drive.settings import Steering
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import frames, mobius, polygon
from cardan.questions.motion.equivalence import SYNCHRONOUS
from cardan.texts import _

from .family import Blocks
from .setting import YokeSetting, settings, with_yokes, wrapped
from .spline_pitch import on_teeth

PLACES = 721
"""Turns of the wheel at which the speed ratio is drawn."""

NEAR = 1e-9
"""Speed ratios and fluctuations that differ by less than this are alike."""

LETTER = "S"
"""What settings of a steering column are called, with a number."""

SHOWN = 2
"""So many settings of each sort are told."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SteeringColumn:
    """How a steering column hands on the turn of its wheel, from lock to lock, in one setting."""

    setting: YokeSetting  # its yoke angles and the position of its first yoke
    angle: Array  # (p,) [rad]: turn of the wheel from straight ahead
    ratio: Array  # (p,): speed ratio of output to wheel there
    centre_ratio: float  # the same straight ahead
    least: float  # least, greatest: between which values it lies from lock to lock, exactly
    greatest: float
    asymmetry: float  # largest difference between turns of the wheel of one size to the left and to the right
    # pose_centre_ratio, pose_asymmetry (q,): the same in each pose, straight ahead being where the output stands as it
    # does in the drive as drawn
    pose_centre_ratio: Array
    pose_asymmetry: Array

    @property
    def ripple(self) -> float:
        """By how much the torque at the wheel changes from lock to lock under a steady one at the output, over it.

        Without friction the torques are as the speed ratio, T_wheel = i T_output.
        """
        return self.greatest - self.least


@dataclass(frozen=True, eq=False, kw_only=True)
class _Course:
    """i(φ) = 1/(C + S cos(2φ + ζ)) with C² - S² = 1."""

    level: float  # C = |a|² + |b|²
    swing: float  # S = 2 |a| |b|
    lean: float  # ζ [rad], 0 where straight ahead is the least ratio, π where it is the greatest

    @classmethod
    def of(cls, pair: mobius.Pair) -> _Course:
        """Return the course of a drive by its Möbius pair, the input angle counted from straight ahead."""
        a, b = pair
        lean = np.conj(b) * a
        return cls(level=float(abs(a) ** 2 + abs(b) ** 2), swing=2.0 * float(abs(lean)), lean=float(np.angle(lean)))

    def ratio(self, angle: Array) -> Array:
        found: Array = 1.0 / (self.level + self.swing * np.cos(2.0 * angle + self.lean))
        return found

    def bounds(self, lock: float) -> tuple[float, float]:
        """Return the least and the greatest ratio from lock to lock."""
        reach = min(lock, np.pi)
        turns = (np.arange(-4, 5) * np.pi - self.lean) / 2.0
        found = self.ratio(np.concatenate((turns[np.abs(turns) <= reach], [-lock, 0.0, lock])))
        return float(np.min(found)), float(np.max(found))

    def asymmetry(self, lock: float) -> float:
        reach = min(lock, 0.5 * np.pi)

        def difference(angle: Array) -> Array:
            near = np.clip(angle, 0.0, reach)
            return np.abs(self.ratio(near) - self.ratio(-near))[None]

        places = np.linspace(0.0, reach, 181)
        return float(peaks(difference, places, difference(places))[1][0])


def columns(
    drive: Drive,
    chain: Chain,
    figure: Blocks,
    as_built: YokeSetting,
    *,
    teeth: Mapping[int, int],
    poses: Sequence[Chain] = (),
    posed: Sequence[Drive] = (),
) -> tuple[SteeringColumn, ...]:
    """Return a steering column as specified, and in the settings that are symmetric and nearest to the wanted ratio.

    drive: with what it is to do as a steering column; chain: its joints as Hooke joints; figure: the polygon of its
    free yokes; teeth: index 0 … n-2 of a yoke angle -> teeth of the spline there; poses, posed: the drive in its poses.
    The wanted ratio i is that of a joint with L = -ln cos α = |ln i|, brought into what the yokes reach. Of settings
    alike the one most symmetric in the poses comes first, then the one with the least fluctuation of the shafts
    between, then the one nearest to the present.
    """
    wanted = drive.steering
    if wanted is None:
        return ()
    low, high = polygon.reach(figure.lengths)
    end = float(np.clip(abs(math.log(wanted.centre_ratio)), low, high))
    weight = [shaft.weight for shaft in drive.shafts[1:-1]]
    whole = len(figure.sides) == chain.joints > 1
    aims = polygon.shortest_diagonals(figure.lengths, [*weight, 0.0], end) if whole else None
    rows = figure.closed(aims, end=end)
    lags = [_lag(drive, one) for one in posed]

    def column(label: str, yokes: Array, turn: float) -> SteeringColumn:
        there = replace(chain, start_phase=chain.start_phase + turn)
        if label:
            made = settings(there, yokes[None], [label], as_built.yoke_angle, poses)[0]
            made = replace(made, start_phase=float(wrapped(np.asarray(drive.input.start_phase + turn))))
        else:
            made = as_built
        pair = with_yokes(there, yokes).products()[-1]
        each = [
            _Course.of(_ahead(pair, with_yokes(pose, yokes).products()[-1], lag))
            for pose, lag in zip(poses, lags, strict=True)
        ]
        return _column(made, wanted.lock, _Course.of(pair), each)

    def ranked(rows: Array, name: str) -> Iterator[SteeringColumn]:
        some = [
            (yokes, turn)
            for yokes in rows
            for turn in _turns(wanted, _Course.of(with_yokes(chain, yokes).products()[-1]))
        ]
        every = [(column(name, yokes, turn), turn) for yokes, turn in some]

        def rank(k: int) -> tuple[float, ...]:
            one, turn = every[k]
            between = float(np.sum(weight * one.setting.shaft_speed_fluctuation[:-1]))
            off = max(abs(one.centre_ratio - wanted.centre_ratio), one.asymmetry)
            grades = (off, float(np.max(one.pose_asymmetry, initial=0.0)), between)
            return *(round(grade / NEAR) for grade in grades), float(np.sum(one.setting.change**2)) + turn**2

        for k, place in enumerate(sorted(range(len(every)), key=rank)[:SHOWN]):
            one = every[place][0]
            label = f"{name}{k + 1}" if name == LETTER else f"{name}, {k + 1}"
            yield replace(one, setting=replace(one.setting, label=label))

    found = [column("", as_built.yoke_angle, 0.0), *ranked(rows, LETTER)]
    if teeth:
        grid = on_teeth(found[1].setting.yoke_angle, as_built.yoke_angle, teeth)
        length = mobius.length(with_yokes(chain, grid).products()[-1])
        near = np.argsort(np.round(np.abs(length - end) / NEAR), kind="stable")[: 2 * SHOWN]
        found += ranked(grid[near], _("{letter} on teeth").format(letter=LETTER))
    return tuple(found)


def _lag(drawn: Drive, posed: Drive) -> float:
    """Return by which angle [rad] the plane of the last joint turns about the output axis from a drive to its pose."""
    here, there = geometry(drawn), geometry(posed)
    axis, other, normal = here.axis[-1], there.axis[-1], here.normal[-1]
    hinge, turn = np.cross(axis, other), float(frames.angle_between(axis, other))
    carried = frames.rotate(normal, frames.unit(hinge), np.asarray(turn)) if turn > 0.0 else normal
    return float(frames.angle_about(other, carried, there.normal[-1]))


def _ahead(drawn: mobius.Pair, pose: mobius.Pair, lag: float) -> mobius.Pair:
    """Return the pair of a drive in a pose, its input counted from where its output stands as it does as drawn."""
    out = mobius.apply(drawn, np.asarray(1.0 + 0.0j)) * np.exp(-2j * lag)
    start = mobius.apply(mobius.inverse(pose), out)
    return mobius.compose(pose, mobius.turn(0.5 * np.angle(start)))


def _turns(wanted: Steering, course: _Course) -> Iterator[float]:
    """Yield by which angles [rad] the first yoke is to be turned on so that the ratio is symmetric."""
    if course.swing < SYNCHRONOUS:
        yield 0.0
        return
    for lean, there in ((0.0, wanted.centre_ratio <= 1.0), (math.pi, wanted.centre_ratio >= 1.0)):
        if there:
            yield float(wrapped(np.asarray(0.5 * (lean - course.lean))))


def _column(setting: YokeSetting, lock: float, course: _Course, posed: Sequence[_Course]) -> SteeringColumn:
    angle = np.linspace(-lock, lock, PLACES)
    least, greatest = course.bounds(lock)
    return SteeringColumn(
        setting=setting,
        angle=angle,
        ratio=course.ratio(angle),
        centre_ratio=float(course.ratio(np.asarray(0.0))),
        least=least,
        greatest=greatest,
        asymmetry=course.asymmetry(lock),
        pose_centre_ratio=np.asarray([float(one.ratio(np.asarray(0.0))) for one in posed]),
        pose_asymmetry=np.asarray([one.asymmetry(lock) for one in posed]),
    )
