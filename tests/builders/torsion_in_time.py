"""Torsional drives integrated in time by scipy, contacts located as events: the slow truth of steady running."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from cardan.questions.torsion.model.inputs import Asynchronous, Constant, Falling, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_balance import accelerations
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line


def drive(
    speed=48.0,
    *,
    free=False,
    order=None,
    backlash=0.0,
    load=50.0,
    damping=1.0,
    joint_angle=0.35,
    motor=False,
    table=False,
) -> TorsionalModel:
    """Return a drive of three shafts and two joints whose middle shaft has a station of its own."""
    torques = [
        Torque(station=6, law=Constant(value=-load)),
        Torque(station=6, law=Falling(standstill=0.0, slope=0.1)),
    ]
    if order is not None:
        torques.append(Torque(station=1, law=Swinging(amplitude=8.0, frequency=order, phase=0.4)))
    if motor:
        torques.append(
            Torque(station=0, law=Asynchronous(synchronous_speed=60.0, pullout_torque=150.0, pullout_slip=0.2))
        )
    if table:
        law = SpeedTable(speeds=np.asarray([0.0, 90.0]), torques=np.asarray([0.0, -9.0]))
        torques.append(Torque(station=5, law=law))
    return torsional_line(
        [[1.0, 0.02], [0.03, 0.3, 0.02], [0.03, 0.5]],
        stiffness=[[3000.0], [5000.0, 5000.0], [4000.0]],
        damping=[[damping], [damping, damping], [damping]],
        backlash=[[backlash], [0.0, 0.0], [0.0]],
        joint_angle=[joint_angle, 0.8 * joint_angle],
        phase=[0.0, 1.2],
        torques=torques,
        input_speed=None if free else speed,
    )


def flow(
    model: TorsionalModel, speed: float, duration: float, states: np.ndarray, times: np.ndarray | None = None
) -> np.ndarray:
    """Return states (..., 2u) of the u free coordinates, angles before speeds, after a time, or at times (..., 2u, t).

    Without backlash all states go in one integration.
    """
    flat = np.atleast_2d(np.asarray(states, dtype=float))
    if np.any(model.backlash > 0.0):
        found = np.stack([_by_contacts(model, speed, duration, one) for one in flat])
    else:
        alone = _alone(model, speed)[0] if len(flat) == 1 else None
        done = solve_ivp(
            alone or (lambda time, y: _rates(model, speed, time, y.reshape(flat.shape)).ravel()),
            (0.0, duration), flat.ravel(), method="DOP853", rtol=1e-11, atol=1e-12, t_eval=times,
        )  # fmt: skip
        found = done.y[:, -1].reshape(flat.shape) if times is None else done.y.reshape(*flat.shape, -1)
    return found if np.ndim(states) > 1 else found[0]


def _whole(model: TorsionalModel, speed: float, time: float, states: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    q, rate = np.split(states, 2, axis=-1)
    if model.free:
        return q, rate
    even = np.ones((len(states), 1))
    return np.concatenate([speed * time * even, q], axis=-1), np.concatenate([speed * even, rate], axis=-1)


def _rates(model: TorsionalModel, speed: float, time: float, states: np.ndarray) -> np.ndarray:
    q, rate = _whole(model, speed, time, states)
    first = 0 if model.free else 1
    return np.concatenate([rate[:, first:], accelerations(model, q, rate, time)[:, first:]], axis=-1)


def _plain(model: TorsionalModel) -> Callable[[list[float], list[float]], tuple[list[float], list[float]]]:
    """Return what gives angles of stations and accelerations of coordinates of one drive, on plain numbers.

    A tenth of the time of arrays; torques on it follow neither time nor tables.
    """
    driven, of = model.driven, model.coordinate
    inertia, ground = model.inertia.tolist(), model.ground_damping.tolist()
    joints = [(a, math.cos(a), math.sin(a) ** 2, math.tan(0.5 * a) ** 2) for a in model.joint_angle.tolist()]
    phases = model.phase.tolist()
    springs = list(
        zip(model.elements, model.stiffness.tolist(), model.damping.tolist(), model.backlash.tolist(), strict=True)
    )
    still = np.zeros(())

    def angle_error(theta: float, tau: float) -> float:
        return theta + math.atan2(tau * math.sin(2.0 * theta), 1.0 - tau * math.cos(2.0 * theta))

    def found(q: list[float], rate: list[float]) -> tuple[list[float], list[float]]:
        place: list[tuple[float, float, float]] = []
        for k, source in enumerate(driven):
            if source is None:
                place.append((q[of[k]], 1.0, 0.0))
                continue
            f, f1, f2 = place[source[0]]
            _joint_angle, cosine, square, tau = joints[source[1]]
            theta = f + phases[source[1]]
            below = 1.0 - square * math.cos(theta) ** 2
            t1 = cosine / below
            t2 = -cosine * square * math.sin(2.0 * theta) / below**2
            place.append((angle_error(theta, tau) - angle_error(phases[source[1]], tau), t1 * f1, t2 * f1**2 + t1 * f2))
        speed = [one[1] * rate[r] for one, r in zip(place, of, strict=True)]
        acting = [-b * v for b, v in zip(ground, speed, strict=True)]
        for (a, b), stiffness, damping, play in springs:
            twist = place[a][0] - place[b][0]
            over = twist - 0.5 * play if twist > 0.5 * play else twist + 0.5 * play if twist < -0.5 * play else 0.0
            torque = stiffness * over + (damping * (speed[a] - speed[b]) if over or not play else 0.0)
            acting[a] -= torque
            acting[b] += torque
        for one in model.torques:
            k = one.station
            acting[k] += float(one.law.at(still, np.asarray(place[k][0]), np.asarray(speed[k]))[0])
        mass, force = [0.0] * len(q), [0.0] * len(q)
        for k, (_angle, f1, f2) in enumerate(place):
            mass[of[k]] += inertia[k] * f1**2
            force[of[k]] += f1 * acting[k] - inertia[k] * f1 * f2 * rate[of[k]] ** 2
        return [one[0] for one in place], [f / m if m else 0.0 for f, m in zip(force, mass, strict=True)]

    return found


def _alone(model: TorsionalModel, speed: float) -> tuple[Callable[..., list[float]], Callable[..., list[float]]]:
    """Return rates of the state of one drive, and its angles, by time and state."""
    equations, free = _plain(model), model.free

    def whole(time: float, y: np.ndarray) -> tuple[list[float], list[float]]:
        numbers = y.tolist()
        q, rate = numbers[: len(numbers) // 2], numbers[len(numbers) // 2 :]
        return (q, rate) if free else ([speed * time, *q], [speed, *rate])

    def rates(time: float, y: np.ndarray) -> list[float]:
        q, rate = whole(time, y)
        return (rate if free else rate[1:]) + equations(q, rate)[1][0 if free else 1 :]

    return rates, lambda time, y: equations(*whole(time, y))[0]


def _by_contacts(model: TorsionalModel, speed: float, duration: float, state: np.ndarray) -> np.ndarray:
    rates, angles = _alone(model, speed)

    def gap(element: int, level: float) -> Callable[[float, np.ndarray], float]:
        def event(time: float, y: np.ndarray) -> float:
            angle = angles(time, y)
            a, b = model.elements[element]
            return angle[a] - angle[b] - level

        event.terminal = True  # type: ignore[attr-defined]
        return event

    half = 0.5 * model.backlash
    events = [gap(e, side * half[e]) for e in range(len(half)) if half[e] > 0.0 for side in (1.0, -1.0)]
    now, y = 0.0, state
    while True:
        done = solve_ivp(
            rates, (now, duration), y, method="DOP853", rtol=1e-10, atol=1e-12, events=events, max_step=duration / 20.0,
        )  # fmt: skip
        if done.status == 0:
            return done.y[:, -1]
        which = next(k for k, when in enumerate(done.t_events) if when.size)
        past = 1e-10  # over the contact, so that the event does not fire again
        now, y = float(done.t_events[which][0]), done.y_events[which][0]
        now, y = now + past, y + past * np.asarray(rates(now, y))
