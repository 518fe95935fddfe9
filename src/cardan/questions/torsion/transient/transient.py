"""How do torques and speeds of a drive run in time?"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import TypeAlias

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.questions.torsion.model.input_motion import InputMotion, Uniform
from cardan.questions.torsion.model.torsional_batch import leading, single
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.texts import _

from .adaptive import Task, march
from .fixed_steps import FixedStep, stepped
from .simulation import Extremes, Progress, Simulation

SAMPLES = 1001
"""Samples where none are asked for."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Adaptive:
    """Steps as long as their error allows, contacts located exactly.

    Parameters
    ----------
    rtol : float
        Error of speeds and of the work in one step, as a share.
    atol : float [rad, rad/s]
        Error of angles and of speeds in one step.
    stiff : bool, optional
        Whether to integrate implicitly; found from the fastest rate of the drive when not given. Coordinates without
        inertia always need it.
    """

    rtol: float = 1e-10
    atol: float = 1e-11
    stiff: bool | None = None

    def __post_init__(self) -> None:
        text = _("{given} given; more than 0 is needed")
        check(
            Problem(name, text.format(given=getattr(self, name)))
            for name in ("rtol", "atol")
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0.0)
        )


Method: TypeAlias = Adaptive | FixedStep


def simulate(
    model: TorsionalModel,
    *,
    span: float | tuple[float, float],
    times: int | ArrayLike = SAMPLES,
    angle: ArrayLike | None = None,
    speed: ArrayLike | None = None,
    method: Method | None = None,
    progress: Progress | None = None,
) -> Simulation:
    """Return the motion of a torsional model in time.

    Parameters
    ----------
    model : TorsionalModel
        One drive, or many (...).
    span : float or (float, float) [s]
        How long, or from when to when.
    times : int or array (t,) [s]
        How many samples evenly over the span, or when.
    angle : array (..., R) [rad], optional
        Angles of the coordinates at the start; 0 when not given. Of coordinates without inertia or damper they are
        where their balance is looked for.
    speed : float or array (..., R) [rad/s], optional
        Speeds of the coordinates at the start; that of the forced station when not given, else 0.
    method : Adaptive or FixedStep, optional
        How to integrate; FixedStep takes many drives at once.
    progress : function, optional
        Called with the share done; answering "stop" ends the simulation with what is done.

    Returns
    -------
    Simulation

    Raises
    ------
    InputError
        A span that does not go forward, samples outside it, initial values that do not fit.

    Notes
    -----
    (Σ J F'²) q̈ + (Σ J F' F'') q̇² = Σ F' τ for every coordinate, exact for any angles.

    Examples
    --------
    >>> from cardan.questions.torsion.model.torsional_model import torsional_line
    >>> line = torsional_line([[1.0], [0.0, 0.5]], stiffness=[[], [2000.0]], joint_angle=[0.35], input_speed=30.0)
    >>> found = simulate(line, span=0.2)
    >>> round(float(found.extremes.torque_high[0]), 2), bool(found.imbalance < 1e-9)
    (349.64, True)
    """
    begin, end = (float(one) for one in (span if isinstance(span, tuple) else (0.0, span)))
    way = Adaptive() if method is None else method
    samples = np.linspace(begin, end, times) if isinstance(times, int) else np.asarray(times, dtype=float)
    check(_span_problems(begin, end, samples))
    angle_error = leading(model)
    q, rate = _start(model, angle_error, begin, angle, speed)
    if isinstance(way, FixedStep):
        return stepped(model, way, span=(begin, end), times=samples, q=q, rate=rate, progress=progress)
    tasks = [
        Task(
            model=one,
            motion=_motion(one, begin, q[place]),
            tolerance=(way.rtol, way.atol),
            stiff=way.stiff,
            span=(begin, end),
            times=samples,
            q=q[place],
            rate=rate[place],
        )
        for k, place in enumerate(np.ndindex(angle_error))
        for one in [single(model, angle_error, k) if angle_error else model]
    ]
    found = [march(task, _part(progress, k, len(tasks))) for k, task in enumerate(tasks)]
    return found[0] if not angle_error else _together(found, angle_error)


def _span_problems(begin: float, end: float, samples: Array) -> Iterator[Problem]:
    if not (math.isfinite(begin) and math.isfinite(end) and end > begin):
        yield Problem("span", _("from {begin:.6g} s to {end:.6g} s is not a span of time").format(begin=begin, end=end))
    elif samples.ndim != 1 or not np.all(np.diff(samples) > 0.0):
        yield Problem("times", _("need to rise"))
    elif len(samples) and not (begin <= samples[0] and samples[-1] <= end):
        text = _("from {first:.6g} s to {last:.6g} s given; the span is from {begin:.6g} s to {end:.6g} s")
        yield Problem("times", text.format(first=samples[0], last=samples[-1], begin=begin, end=end))


def _start(
    model: TorsionalModel, outer: tuple[int, ...], begin: float, angle: ArrayLike | None, speed: ArrayLike | None
) -> tuple[Array, Array]:
    """Return angles and speeds of the coordinates at the start, arrays (..., R)."""
    shape = (*outer, model.coordinates)
    forced: Array = 0.0
    if model.input_motion is not None:
        forced = model.input_motion.at(np.asarray(begin))[1]
    elif model.input_speed is not None:
        forced = np.asarray(model.input_speed)[..., None]
    problems, found = [], []
    for name, value, default in (("angle", angle, 0.0), ("speed", speed, forced)):
        given = np.asarray(default if value is None else value, dtype=float)
        try:
            found.append(np.broadcast_to(given, shape).copy())
        except ValueError:
            text = _("{given} values given, {wanted} needed, one for each coordinate")
            problems.append(Problem(name, text.format(given=given.shape[-1], wanted=model.coordinates)))
            continue
        if not np.all(np.isfinite(given)):
            problems.append(Problem(name, _("{value} is not finite").format(value=given[~np.isfinite(given)].flat[0])))
    check(problems)
    if not model.free:
        found[1][..., :1] = forced
        if model.input_motion is not None:
            found[0][..., 0] = model.input_motion.at(np.asarray(begin))[0]
    return found[0], found[1]


def _motion(model: TorsionalModel, begin: float, q: Array) -> InputMotion | None:
    """Return what is forced on the first station of one drive."""
    if model.input_speed is None:
        return model.input_motion
    speed = float(model.input_speed)
    return Uniform(speed=speed, angle=float(q[0]) - speed * begin)


def _part(progress: Progress | None, k: int, count: int) -> Progress | None:
    """Return what tells the progress of one of several drives as that of all."""
    if progress is None or count == 1:
        return progress
    return lambda share: progress((k + share) / count)


def _together(found: list[Simulation], outer: tuple[int, ...]) -> Simulation:
    """Return simulations of single drives as one of many."""

    def stacked(parts: list[Array]) -> Array:
        return np.stack(parts).reshape(*outer, *np.shape(parts[0]))

    first = found[0]
    own = {
        one.name: stacked([getattr(single, one.name) for single in found])
        for one in fields(Simulation)
        if one.name not in ("times", "extremes", "steps", "method") and getattr(first, one.name) is not None
    }
    extremes = Extremes(
        **{one.name: stacked([getattr(single.extremes, one.name) for single in found]) for one in fields(Extremes)}
    )
    methods = sorted({single.method for single in found})
    return replace(
        first, **own, extremes=extremes, steps=sum(single.steps for single in found), method=", ".join(methods)
    )
