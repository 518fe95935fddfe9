"""The equations of motion of one drive on plain numbers, made once for its structure: a tenth of the time of arrays."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import turned

from .torsional_model import TorsionalModel

Forces: TypeAlias = tuple[list[float], list[float], float]
"""Σ J F'² and Σ F' τ - Σ J F' F'' q̇² of every coordinate [kg m², N·m]; power brought less power lost [W]."""


def forces_of(model: TorsionalModel) -> Callable[[float, Sequence[float], Sequence[float]], Forces]:
    """Return the function that gives inertia and force of every coordinate at a time, angles and speeds.

    model: one drive without backlash: where it touches, elements `rest` at half of it.
    The power is Σ M Ḟ - Σ b (Ḟ_A - Ḟ_B)² - Σ b_g Ḟ²; that of a forced speed is not in it.

    >>> from cardan.questions.torsion.model.torsional_model import torsional_line
    >>> line = torsional_line([[2.0, 1.0]], stiffness=[[50.0]])
    >>> forces_of(line)(0.0, [0.0, 0.1], [0.0, 0.0])
    ([2.0, 1.0], [5.0, -5.0], 0.0)
    """
    stations = len(model.driven)
    owner, coordinate = model.owner, model.coordinate
    own_mass = [float(model.inertia[k]) for k in owner]
    ground = [float(one) for one in model.ground_damping]
    turned_by: list[list[tuple[int, float, float, float, float, float]]] = [[] for _r in owner]
    for k, (tau, c, s) in enumerate(laws(model)):
        if model.driven[k] is not None:
            ahead = float(turned.angle_error(c, s, tau))
            turned_by[coordinate[k]].append((k, float(tau), float(c), float(s), ahead, float(model.inertia[k])))
    groups = [(r, group) for r, group in enumerate(turned_by) if group]
    rest = np.zeros(len(model.elements)) if model.rest is None else model.rest
    elements = [
        (a, b, float(model.stiffness[e]), float(model.damping[e]), float(rest[e]))
        for e, (a, b) in enumerate(model.elements)
    ]
    torques = [(torque.station, torque.law.at) for torque in model.torques]
    cosine, sine, atan2 = math.cos, math.sin, math.atan2

    def forces(time: float, q: Sequence[float], rate: Sequence[float]) -> Forces:
        angle, speed, first = [0.0] * stations, [0.0] * stations, [1.0] * stations
        mass, force = own_mass.copy(), [0.0] * len(own_mass)
        for r, k in enumerate(owner):
            angle[k], speed[k] = q[r], rate[r]
        for r, group in groups:
            c2, s2, v = cosine(2.0 * q[r]), sine(2.0 * q[r]), rate[r]
            for k, tau, c, s, ahead, inertia in group:
                y = tau * (s2 * c + c2 * s)
                x = 1.0 - tau * (c2 * c - s2 * s)
                below = 1.0 / (x * x + y * y)
                f1 = (1.0 - tau * tau) * below
                angle[k], first[k], speed[k] = q[r] + atan2(y, x) - ahead, f1, f1 * v
                if inertia:
                    mass[r] += inertia * f1 * f1
                    force[r] += inertia * f1 * f1 * 4.0 * y * below * v * v
        power = 0.0
        acting = [0.0] * stations
        for k, b in enumerate(ground):
            if b:
                acting[k] = -b * speed[k]
                power += acting[k] * speed[k]
        for a, b, stiffness, damping, start in elements:
            twisting = speed[a] - speed[b]
            carried = stiffness * (angle[a] - angle[b] - start)
            if damping:
                drag = damping * twisting
                carried += drag
                power -= drag * twisting
            acting[a] -= carried
            acting[b] += carried
        for k, law in torques:
            value = float(law(time, angle[k], speed[k])[0])
            acting[k] += value
            power += value * speed[k]
        for k, r in enumerate(coordinate):
            force[r] += first[k] * acting[k]
        return mass, force, power

    return forces


def laws(model: TorsionalModel) -> list[tuple[Array, Array, Array]]:
    """Return τ, cos 2ψ and sin 2ψ of the one joint by which each station follows its coordinate, arrays (...)."""
    found: list[tuple[Array, Array, Array]] = []
    chains: list[tuple[int, ...]] = []
    for source in model.driven:
        chains.append(() if source is None else (*chains[source[0]], source[1]))
        if source is None:
            nothing = np.zeros(model.joint_angle.shape[:-1])
            found.append((nothing, nothing + 1.0, nothing))
        else:
            through = list(chains[-1])
            found.append(turned.equivalent(model.joint_angle[..., through], model.phase[..., through]))
    return found
