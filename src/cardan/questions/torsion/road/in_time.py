"""A drive whose joint angles change while it vibrates, followed in time where no instant counts as standing.

The equations of motion with the joint angles α(t) and phases ψ(t) of every instant. What the joints add by the rates of
these themselves is of the order of the rate of the movement over the speed, and left out.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from cardan.drive.models.geometry import geometry_from_points
from cardan.drive.movement import Table
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import tops
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_points import moving_points
from cardan.questions.torsion.model.joint_bends import Bends
from cardan.questions.torsion.model.torsional_balance import accelerations, element_torques, gathered
from cardan.questions.torsion.model.torsional_layouts import period_of
from cardan.questions.torsion.model.torsional_model import flat_sums
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.texts import _
from cardan.units import thousands

from .places import Places, Standing, sign_changes

integrate, interpolate = later("scipy.integrate"), later("scipy.interpolate")

Progress: TypeAlias = Callable[[float], object]
"""Told the share done; may answer "stop"."""

SETTLED = 7.0
"""Times over which the slowest mode that lags behind dies out, before what is followed counts."""

EACH, MOST = 14.0, 30_000.0
"""Evaluations in a period of the fastest vibration, about, and in all."""

ACCURATE = 1e-7
"""Error of a step, as a share of angles and speeds."""

SAMPLES = 60
"""Samples in half a turn."""

TURNED = 8.0
"""Times the speed at which the joints excite at least."""


def hindered(standing: Standing, omega: Array, span: float, before: float) -> str:
    """Return why a drive is not followed in time over a span after a stretch before it [s]; empty where it is.

    omega (m,) [rad/s]: natural frequencies.
    """
    model = standing.model
    if model.free:
        return _("torques turn its input freely")
    if standing.loose:
        return _("a torque does not repeat within two turns")
    if model.rubs:
        return _("its dry friction sticks and slips")
    if np.any(gathered(model, model.inertia)[1:] <= 0.0):
        return _("a part of the line has no inertia")
    fastest = max(float(np.max(omega, initial=0.0)), TURNED * abs(standing.speed))
    work = EACH * (span + before) * fastest / (2.0 * math.pi)
    if work > MOST:
        return _("it would take about {count} evaluations").format(count=thousands(round(work, -4)))
    return ""


def follow(standing: Standing, times: Array, before: float, *, progress: Progress | None = None) -> Places:
    """Return the torques of a drive along its movement by integration in time, one place for each period of its joints.

    times (t,) [s]: instants of the movement, close enough for splines; before [s]: what is followed ahead of them, from
    the periodic motion of its first instant; nothing ahead of a table, which begins with its first row.
    progress: when it answers "stop", what is not done has no motion.
    """
    drive, model, speed = standing.drive, standing.model, standing.speed
    begin, end = float(times[0]), float(times[-1])
    if any(isinstance(one, Table) for one in drive.movements):
        before = 0.0
    step = (end - begin) / (len(times) - 1)
    nodes = np.concatenate([begin - step * np.arange(math.ceil(before / step), 0, -1), times])
    course = _Course(standing, nodes)
    start = float(nodes[0])
    held = replace(model, **course.one(start))
    steady = periodic_response(held, speed=speed)
    q, rate = (one[0, 0] for one in steady.orbit.of(np.asarray([0]), [speed * start])[:2])
    free = len(q) - 1

    def slopes(time: float, state: Array) -> Array:
        held = replace(model, **course.one(time))
        whole = np.concatenate([[speed * time], state[:free]])
        rates = np.concatenate([[speed], state[free:]])
        return np.concatenate([state[free:], accelerations(held, whole, rates, time)[1:]])

    duration = period_of(model) / abs(speed)
    count = SAMPLES * round(period_of(model) / math.pi)
    periods = max(1, math.floor((end - begin) / duration))
    at = begin + np.arange(periods * count + 1) * (duration / count)
    state = np.concatenate([q[1:], rate[1:]])
    parts, now, stopped = [], start, False
    for first in range(0, len(at), count * max(1, periods // 20)):
        some = at[first : first + count * max(1, periods // 20)]
        done = integrate().solve_ivp(
            slopes, (now, some[-1]), state, method="DOP853", t_eval=some, rtol=ACCURATE,
            atol=ACCURATE * np.concatenate([np.full(free, 1e-3), np.full(free, 1e-3 * abs(speed))]),
        )  # fmt: skip
        parts.append(done.y)
        now, state = float(some[-1]), done.y[:, -1]
        stopped = progress is not None and progress((now - start) / (at[-1] - start)) == "stop"
        if stopped or not done.success:
            break
    states = np.concatenate(parts, axis=-1)
    states = np.pad(states, ((0, 0), (0, len(at) - states.shape[-1])), constant_values=np.nan).T
    moved = replace(model, **course.at(at))
    turned = np.concatenate([(speed * at)[:, None], states[:, :free]], axis=-1)
    rates = np.concatenate([np.full((len(at), 1), speed), states[:, free:]], axis=-1)
    torque = element_torques(moved, turned, rates, at).T
    windows = np.stack([torque[:, k * count : (k + 1) * count + 1] for k in range(periods)])
    middle = at[: periods * count : count] + 0.5 * duration
    return Places(
        share=np.full(periods, 1.0 / periods),
        points=moving_points(standing.base, drive.movements, middle)[0],
        joint_angle=course.at(middle)["joint_angle"],
        low=-np.max(tops(-windows), axis=-1),
        high=np.max(tops(windows), axis=-1),
        mean=np.mean(windows[..., :-1], axis=-1),
        reversals=sign_changes(windows) / duration,
        times=middle,
    )


class _Course:
    """How joints turn over the time, by splines through tan²(α/2) e^(2iψ): smooth where a joint is straight.

    And through c_k e^(ikψ) of what they turn beside.
    """

    def __init__(self, standing: Standing, times: Array) -> None:
        points = moving_points(standing.base, standing.drive.movements, times)[0]
        turns, _possible = standing.turned(points, -_plane(points))
        phase = turns["phase"]
        value = (np.tan(0.5 * turns["joint_angle"]) ** 2 * np.exp(2j * phase))[:, None]
        own = replace(standing.model, **turns).own_laws
        if own is not None:
            value = np.concatenate([value, own * _turn(own, phase)], axis=-2)
        self.spline = interpolate().CubicSpline(times, np.stack([value.real, value.imag], axis=-1))

    def at(self, times: Array) -> Bends:
        """Return how the joints turn at instants (t,)."""
        found = self.spline(times)
        whole = found[..., 0] + 1j * found[..., 1]
        value, own = whole[:, 0], whole[:, 1:]
        phase = 0.5 * np.angle(value)
        return Bends(
            joint_angle=2.0 * np.arctan(np.sqrt(np.abs(value))),
            phase=phase,
            sums=flat_sums(own * _turn(own, -phase)) if own.shape[1] else None,
        )

    def one(self, time: float) -> Bends:
        """Return how they turn at one instant, without axis of time."""
        found = self.at(np.asarray([time]))
        sums = found["sums"]
        return Bends(
            joint_angle=found["joint_angle"][0], phase=found["phase"][0], sums=None if sums is None else sums[0]
        )


def _turn(own: Array, phase: Array) -> Array:
    """Return e^(ikψ) beside the sums (t, K, n) of joints at phases (t, n), array (t, K, n)."""
    found: Array = np.exp(1j * np.arange(own.shape[-2])[:, None] * phase[:, None])
    return found


def _plane(points: Array) -> Array:
    """Return by how much the plane of the first joint has turned about its driving shaft, array (t,) [rad].

    points (t, n+2, 3) [m]: over the time. Where the joint is straight, half a turn more or less is the same.
    """
    along = points[:, 1] - points[:, 0]
    along = along / frames.norm(along)[:, None]
    normal = geometry_from_points(points).normal[:, 0]
    first = normal[0] - frames.dot(normal[0], along)[:, None] * along
    found: Array = np.arctan2(frames.dot(frames.cross(first, normal), along), frames.dot(first, normal))
    return found
