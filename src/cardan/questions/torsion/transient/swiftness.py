"""How fast a drive can move: its own rates, what excites it, how short its contacts are."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.questions.torsion.model.input_motion import InputMotion
from cardan.questions.torsion.model.torques import Asynchronous, Swinging
from cardan.questions.torsion.model.torsional_balance import Slopes, linearised
from cardan.questions.torsion.model.torsional_model import TorsionalModel

from .marching import held

FADED = 25.0
"""What is damped by e to this power is gone."""

ORDERS = 4.0
"""Order of the shaft up to which joints excite a drive noticeably."""

PLACES = 8
"""Positions of half a turn at which a drive is looked at."""


def own_rates(
    model: TorsionalModel, free: Array, q: Array, rate: Array, time: float, length: float
) -> tuple[Array, Array]:
    """Return the fastest rate of drives, and the fastest one that lives on.

    model: one drive, or many in one axis with torques ready for moments in a second one.
    free: coordinates that are not forced; all of them turn some inertia.
    q, rate (..., R) [rad, rad/s], time [s].
    length [s]: how long the drive is followed: what is damped away early counts by its share of that.
    Returns fastest, living (...) [rad/s]: largest |λ| of the linearised drive over half a turn, all elements in
    contact.
    """
    by = _turns(model, q, rate, time)
    count = len(free)
    inner = (..., free[:, None], free[None, :])
    share = 1.0 / by.mass[..., free, None]
    system = np.zeros((*by.mass.shape[:-1], 2 * count, 2 * count))
    system[..., :count, count:] = np.eye(count)
    system[..., count:, :count] = -share * by.stiffness[inner]
    system[..., count:, count:] = -share * by.damping[inner]
    values = np.linalg.eigvals(system)
    alive = 1.0 / np.maximum(1.0, -values.real * length / FADED)
    size = np.abs(values)
    return np.max(size, axis=(-2, -1), initial=0.0), np.max(size * alive, axis=(-2, -1), initial=0.0)


def _turns(model: TorsionalModel, q: Array, rate: Array, time: float) -> Slopes:
    """Return drives linearised over half a turn, all elements in contact."""
    places = q[..., None, :] + np.linspace(0.0, math.pi, PLACES, endpoint=False)[:, None]
    rates = np.broadcast_to(rate[..., None, :], places.shape)
    touching = replace(held(model, np.ones(len(model.elements))), rest=None)
    return linearised(touching, places, rates, np.zeros_like(places), np.full(places.shape[:-1], time))[1]


def forced_rate(model: TorsionalModel, motion: InputMotion | None, rate: Array, span: tuple[float, float]) -> Array:
    """Return how fast joints and torques excite drives, array (...) [rad/s]."""
    speed = np.max(np.abs(rate), axis=-1)
    if motion is not None:
        moments = [*span, *(time for time in motion.breaks if span[0] < time < span[1])]
        speed = np.maximum(speed, np.max(np.abs(motion.at(np.asarray(moments))[1])))
    order = ORDERS
    for torque in model.torques:
        if isinstance(torque.law, Asynchronous):
            speed = np.maximum(speed, np.max(np.abs(torque.law.synchronous_speed)))
        if isinstance(torque.law, Swinging):
            order = max(order, float(np.max(np.abs(torque.law.frequency))))
    return speed * order


def contact_period(model: TorsionalModel, free: Array, q: Array) -> Array:
    """Return the shortest period of an element with play in contact, array (...) [s]; infinite without play."""
    if not np.any(model.backlash > 0.0):
        return np.full(q.shape[:-1], math.inf)
    mass = np.min(_turns(model, q, np.zeros_like(q), 0.0).mass, axis=-2)
    forced = np.setdiff1d(np.arange(model.coordinates), free)
    mass[..., forced] = math.inf
    light = np.min(np.where(mass > 0.0, mass, math.inf), axis=-1, keepdims=True)
    mass = np.where(mass > 0.0, mass, light)
    rate = np.zeros(q.shape[:-1])
    for e, (a, b) in enumerate(model.elements):
        ends = sum(1.0 / mass[..., model.coordinate[k]] for k in (a, b))
        own = np.sqrt(model.stiffness[..., e] * ends)
        rate = np.maximum(rate, np.where(model.backlash[..., e] > 0.0, own, 0.0))
    with np.errstate(divide="ignore"):
        return 2.0 * math.pi / rate
