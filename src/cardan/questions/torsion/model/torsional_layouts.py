"""The equations of the torsional model as its solvers need them: many at once, plain numbers, lines."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import TypeAlias

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.kernel import composed_angle
from cardan.maths.periodic.harmonics import Linearised
from cardan.texts import _

from .inputs import (
    Asynchronous,
    Constant,
    Falling,
    History,
    Law,
    SpeedCourse,
    SpeedTable,
    Swinging,
    Uniform,
    base_period,
)
from .torsional_balance import joint_law, linearised, places, spring_torque
from .torsional_model import Torque, TorsionalModel
from .torsional_modes import joint_orders

ARRAYS = (
    "inertia",
    "stiffness",
    "damping",
    "backlash",
    "joint_angle",
    "phase",
    "ground_damping",
    "loss_factor",
    "rest",
    "sums",
    "coupling",
    "friction",
    "creep",
    "disturbed_damping",
)
"""Fields of a model whose last axis is stations, elements or joints."""

SHARED = frozenset({"speeds", "torques", "times", "frequency"})
"""Fields of laws that all drives share."""


def leading(model: TorsionalModel) -> tuple[int, ...]:
    """Return the leading axes of a model: those of its arrays, of its torques and of its speed, spread over each other.

    >>> from .torsional_model import torsional_line
    >>> leading(torsional_line([[1.0, 1.0]], stiffness=[[[5.0], [6.0]]], input_speed=[[1.0], [2.0], [3.0]]))
    (3, 2)
    """
    shapes = [np.shape(value)[:-1] for value in _arrays(model).values()]
    shapes += [np.shape(value) for torque in model.torques for value in _own(torque.law).values()]
    shapes += [] if model.input_speed is None else [np.shape(model.input_speed)]
    return np.broadcast_shapes(*shapes)


def _arrays(model: TorsionalModel) -> dict[str, Array]:
    return {name: getattr(model, name) for name in ARRAYS if getattr(model, name) is not None}


def _own(law: Law) -> dict[str, Array]:
    return {
        one.name: getattr(law, one.name)
        for one in fields(law)  # type: ignore[arg-type]
        if one.name not in SHARED
    }


def chosen(model: TorsionalModel, outer: tuple[int, ...], rows: Array, *, moments: bool = True) -> TorsionalModel:
    """Return some of the drives of a model in one leading axis.

    angle_error: leading axes that those of the model spread over.
    rows (b,) of int: which drives, counted through the axes.
    moments: make their torques ready for moments in a second axis.
    """
    place = np.unravel_index(rows, outer) if outer else ()

    def taken(values: Array, width: tuple[int, ...]) -> Array:
        whole = np.broadcast_to(np.asarray(values, dtype=float), (*outer, *width))
        return whole[place] if outer else np.broadcast_to(whole, (len(rows), *width))

    def taken_law(law: Law) -> Law:
        own = {name: taken(value, ()) for name, value in _own(law).items()}
        wide = {name: value[:, None] if moments else value for name, value in own.items()}
        return replace(law, **wide)  # type: ignore[type-var]

    parts = {name: taken(value, np.shape(value)[-1:]) for name, value in _arrays(model).items()}
    speed = None if model.input_speed is None else taken(model.input_speed, ())
    torques = tuple(Torque(station=torque.station, law=taken_law(torque.law)) for torque in model.torques)
    return replace(model, torques=torques, input_speed=speed, **parts)


def single(model: TorsionalModel, outer: tuple[int, ...], row: int) -> TorsionalModel:
    """Return one drive of a model by itself, without leading axes; rows are counted through the axes.

    >>> from .torsional_model import torsional_line
    >>> two = torsional_line([[1.0, 1.0]], stiffness=[[[5.0], [6.0]]])
    >>> single(two, (2,), 1).stiffness
    array([6.])
    """
    part = chosen(model, outer, np.asarray([row]), moments=False)

    def bare(law: Law) -> Law:
        return replace(law, **{name: value[0] for name, value in _own(law).items()})  # type: ignore[type-var]

    return replace(
        part,
        torques=tuple(Torque(station=torque.station, law=bare(torque.law)) for torque in part.torques),
        input_speed=None if part.input_speed is None else part.input_speed[0],
        **{name: value[0] for name, value in _arrays(part).items()},
    )


def period_of(model: TorsionalModel) -> float:
    """Return the shaft angle after which the drive and all its torques repeat: π, 2π or 4π."""
    orders = list(joint_orders(model))
    problems: list[Problem] = []
    for k, torque in enumerate(model.torques):
        order = torque.law.order
        if order is None:
            text = _("runs in time; steady running needs torques that repeat with the angle or follow the speed")
            problems.append(Problem(f"torques[{k}].kind", text))
        elif base_period((order,)) is None:
            text = _("order {order:g} does not repeat within two turns; steady running needs multiples of 0.5")
            problems.append(Problem(f"torques[{k}].order", text.format(order=order)))
        else:
            orders.append(order)
    check(problems)
    found = base_period(tuple(orders))
    assert found is not None
    return found


def repeating(model: TorsionalModel) -> tuple[TorsionalModel, tuple[int, ...]]:
    """Return a model without the torques whose orders no two turns hold a whole number of times, and which these are.

    Of stability what is left tells the truth to first order but where such an order meets a mode twice, or two modes,
    as a sum of them.
    """
    orders = [torque.law.order for torque in model.torques]
    loose = tuple(k for k, order in enumerate(orders) if order is not None and base_period((order,)) is None)
    return replace(model, torques=tuple(one for k, one in enumerate(model.torques) if k not in loose)), loose


WIDER = 500.0
"""By how much the band of dry friction is wider than it is where corners are quite round."""


class Turning:
    """The drives as oscillators: how far each coordinate is off even rotation; see `harmonics.Equation`.

    model (...); speed (B,) [rad/s]: of the input, or mean speed of free drives; period [rad]: shaft angle of a period.
    share (B,): bends are these shares of their own.
    rounding: radius of the corners of backlash over its half; elements then keep their damping amid it, and the band of
    dry friction is wider by `WIDER` of it. 0 by the equations.
    """

    def __init__(
        self,
        model: TorsionalModel,
        outer: tuple[int, ...],
        speed: Array,
        period: float,
        share: Array | None = None,
        rounding: float = 0.0,
    ) -> None:
        self.model, self.angle_error, self.speed, self.period = model, outer, speed, period
        self.share, self.rounding = share, rounding
        self.first = 0 if model.free else 1
        self.coordinates = model.coordinates - self.first
        self._taken: tuple[Array, TorsionalModel] | None = None

    @property
    def frequency(self) -> Array:
        """Rate of the phase of the period, array (B,) [rad/s]."""
        return self.speed * (2.0 * np.pi / self.period)

    def part(self, rows: Array) -> Turning:
        """Return some of the drives alone."""
        model = chosen(self.model, self.angle_error, rows, moments=False)
        share = None if self.share is None else self.share[rows]
        return Turning(model, (len(rows),), self.speed[rows], self.period, share)

    def drives(self, rows: Array) -> TorsionalModel:
        """Return the drives of some rows."""
        if self._taken is None or not np.array_equal(self._taken[0], rows):
            found = chosen(self.model, self.angle_error, rows)
            if self.share is not None:
                share = self.share[rows][:, None]
                own = None if found.sums is None else found.sums * share
                found = replace(found, joint_angle=found.joint_angle * share, sums=own)
            self._taken = (rows, found)
        return self._taken[1]

    def motion(self, rows: Array, phase: Array, x: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        """Return q, q̇ and q̈ of all coordinates, arrays (b, S, R), from what is off even rotation."""
        if self.first:
            x, v, a = (np.concatenate([np.zeros((*one.shape[:-1], 1)), one], axis=-1) for one in (x, v, a))
        even = (phase * (self.period / (2.0 * np.pi)))[..., :, None]
        return even + x, self.speed[rows][:, None, None] + v, a

    def __call__(self, rows: Array, phase: Array, x: Array, v: Array, a: Array) -> Linearised:
        """Return the balance of the coordinates that are not forced, and its slopes."""
        drives, motion = self.drives(rows), self.motion(rows, phase, x, v, a)
        left, slopes = linearised(_rounded(drives, motion[0], self.rounding) if self.rounding else drives, *motion)
        k = self.first
        return Linearised(
            balance=left[..., k:],
            mass=slopes.mass[..., k:],
            damping=slopes.damping[..., k:, k:],
            stiffness=slopes.stiffness[..., k:, k:],
        )


def _rounded(drives: TorsionalModel, q: Array, rounding: float) -> TorsionalModel:
    """Return drives without backlash whose elements have, at each of these moments, torque and slope of rounded ones.

    With h half the backlash and ε the radius the torque is c (x + ½√((x-h)² + ε²) - ½√((x+h)² + ε²)).
    """
    angle = places(drives, q).angle
    twist = angle[..., [a for a, _b in drives.elements]] - angle[..., [b for _a, b in drives.elements]]
    rest = 0.0 if drives.rest is None else drives.rest[:, None]
    half = 0.5 * drives.backlash[:, None]
    before, after = twist - rest - half, twist - rest + half
    near, far = np.hypot(before, rounding * half), np.hypot(after, rounding * half)
    near, far = np.where(near > 0.0, near, 1.0), np.where(far > 0.0, far, 1.0)
    over = np.where(half > 0.0, twist - rest + 0.5 * (near - far), twist - rest)
    slope = np.where(half > 0.0, 1.0 + 0.5 * (before / near - after / far), 1.0)
    return replace(
        drives,
        stiffness=drives.stiffness[:, None] * slope,
        backlash=np.zeros_like(drives.backlash),
        rest=twist - over / slope,
        creep=None if drives.creep is None else drives.creep * (1.0 + WIDER * rounding),
    )


# The equations of motion of one drive on plain numbers, made once for its structure: a tenth of the time of arrays.

Forces: TypeAlias = tuple[list[float], list[float], float]
"""Σ J F'² and Σ F' τ - Σ J F' F'' q̇² of every coordinate [kg m², N·m]; power brought less power lost [W]."""


def forces_of(model: TorsionalModel) -> Callable[..., Forces]:
    """Return the function that gives inertia and force of every coordinate at a time, angles and speeds.

    model: one drive without backlash: where it touches, elements `rest` at half of it. With pendulums the function is
    told the acceleration that is forced on the first coordinate, if one is: theirs follows from that of their pivot,
    which is taken out of the equations beforehand.
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
    for k, (tau, c, s) in enumerate(laws(model) if model.sums is None else ()):
        if model.driven[k] is not None:
            ahead = float(composed_angle.angle_error(c, s, tau))
            turned_by[coordinate[k]].append((k, float(tau), float(c), float(s), ahead, float(model.inertia[k])))
    groups = [(r, group) for r, group in enumerate(turned_by) if group]
    by_law = [
        (k, source[0], coordinate[k], _law_of(model, source[1]), float(model.inertia[k]))
        for k, source in enumerate(model.driven)
        if source is not None and model.sums is not None
    ]
    rest = np.zeros(len(model.elements)) if model.rest is None else model.rest
    elements = [
        (a, b, float(model.stiffness[e]), float(model.damping[e]), float(rest[e]))
        for e, (a, b) in enumerate(model.elements)
    ]
    special = [
        (
            a,
            b,
            e,
            0.0 if model.friction is None else float(model.friction[e]),
            model.tables[e] if model.tables else None,
        )
        for e, (a, b) in enumerate(model.elements)
        if model.special
    ]
    torques = [(torque.station, torque.law.at) for torque in model.torques]
    bonds = [
        (h, p, coordinate[h], coordinate[p], float(g), float(model.inertia[p]))
        for (h, p), g in zip(model.hinges, () if model.coupling is None else model.coupling, strict=True)
    ]
    creep = [] if model.creep is None else [float(one) for one in model.creep]
    cosine, sine, atan2 = math.cos, math.sin, math.atan2

    def forces(time: float, q: Sequence[float], rate: Sequence[float], forced: float | None = None) -> Forces:
        angle, speed, first = [0.0] * stations, [0.0] * stations, [1.0] * stations
        second = [0.0] * stations
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
                second[k] = -f1 * 4.0 * y * below
                if inertia:
                    mass[r] += inertia * f1 * f1
                    force[r] += inertia * f1 * f1 * 4.0 * y * below * v * v
        for k, j, r, follow, inertia in by_law:
            angle[k], t1, t2 = follow(angle[j])
            first[k], second[k] = t1 * first[j], t2 * first[j] * first[j] + t1 * second[j]
            speed[k] = first[k] * rate[r]
            mass[r] += inertia * first[k] * first[k]
            force[r] -= inertia * first[k] * second[k] * rate[r] * rate[r]
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
        for a, b, e, friction, table in special:
            twisting = speed[a] - speed[b]
            drag = friction * min(max(twisting / creep[e], -1.0), 1.0) if friction else 0.0
            carried = drag if table is None else drag + spring_torque(table, angle[a] - angle[b])[0]
            power -= drag * twisting
            acting[a] -= carried
            acting[b] += carried
        for k, law in torques:
            value = float(law(time, angle[k], speed[k])[0])
            acting[k] += value
            power += value * speed[k]
        for k, r in enumerate(coordinate):
            force[r] += first[k] * acting[k]
        if bonds:
            swung = []
            for h, p, r, o, g, own in bonds:
                swing = angle[p] - angle[h]
                c, s, lever = g * cosine(swing), g * sine(swing), first[h]
                bent = second[h] * rate[r] * rate[r]
                drawn = force[o] - s * speed[h] * speed[h]
                force[r] += lever * (s * speed[p] * speed[p] + c * (c * bent - drawn) / own)
                mass[r] -= lever * lever * c * c / own
                swung.append((o, r, drawn - c * bent, c * lever))
            for o, r, drawn, pull in swung:
                force[o] = drawn - pull * (force[r] / mass[r] if r or forced is None else forced)
        return mass, force, power

    return forces


def _law_of(model: TorsionalModel, joint: int) -> Callable[[float], tuple[float, float, float]]:
    """Return the function that gives F, T' and T'' of a joint of one drive from the angle of its driving yoke."""
    assert model.own_laws is not None
    tau, phase = math.tan(0.5 * float(model.joint_angle[joint])) ** 2, float(model.phase[joint])
    waves = list(enumerate(model.own_laws[:, joint].tolist()))[::-1]
    start = float(joint_law(model.phase[joint], model.joint_angle[joint], model.own_laws[:, joint])[0])

    def turned_by(angle: float) -> tuple[float, float, float]:
        theta = angle + phase
        turn = complex(math.cos(theta), math.sin(theta))
        twice = turn * turn
        x, y = 1.0 - tau * twice.real, tau * twice.imag
        below = 1.0 / (x * x + y * y)
        t1 = (1.0 - tau * tau) * below
        value = first = second = 0j
        for k, wave in waves:
            value, first, second = value * turn + wave, first * turn + k * wave, second * turn + k * k * wave
        turned = theta + math.atan2(y, x) + value.real - start
        return turned, t1 - first.imag, -4.0 * t1 * y * below - second.real

    return turned_by


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
            found.append(composed_angle.equivalent(model.joint_angle[..., through], model.phase[..., through]))
    return found


# Torsional models as lines of numbers that fixed steps take through time.


def line_of(model: TorsionalModel, drives: int, start: float = 0.0) -> lines.Line:
    """Return drives in one leading axis as a line to be stepped.

    model, TorsionalModel (b,) or (); drives: b; start [s]: where times are counted from.
    """

    def last(values: Array) -> Array:
        return np.ascontiguousarray(np.broadcast_to(values, (drives, values.shape[-1])).T.astype(float))

    inertia, ground = last(model.inertia), last(model.ground_damping)
    owners = list(model.owner)
    followers = [k for k, source in enumerate(model.driven) if source is not None]
    place = {k: p for p, k in enumerate([*owners, *followers])}
    found = laws(model)
    law = [
        np.stack([np.broadcast_to(found[k][i], (drives,)) for k in followers]) if followers else np.zeros((0, drives))
        for i in range(3)
    ]
    check(_problems(model, inertia))
    return lines.Line(
        mass=inertia[owners],
        ground=ground[[*owners, *followers]],
        turning=tuple(model.coordinate[k] for k in followers),
        tau=law[0],
        cosine=law[1],
        sine=law[2],
        ahead=composed_angle.angle_error(law[1], law[2], law[0]),
        inertia=inertia[followers],
        ends=tuple((place[a], place[b]) for a, b in model.elements),
        stiffness=last(model.stiffness),
        damping=last(model.damping),
        rest=np.zeros((len(model.elements), drives)) if model.rest is None else last(model.rest),
        half=0.5 * last(model.backlash),
        loads=tuple(_load(torque.law, place[torque.station], drives, start) for torque in model.torques),
        forced=not model.free,
    )


def _problems(model: TorsionalModel, inertia: Array) -> list[Problem]:
    problems = []
    if model.sums is not None:
        problems.append(
            Problem("joints", _("joints that turn by a law of their own have no fixed steps; use Adaptive"))
        )
    if model.special:
        problems.append(
            Problem("elements", _("springs with tables and dry friction have no fixed steps; use Adaptive"))
        )
    if model.hinges:
        problems.append(Problem("hinges", _("pendulums with their own angle have no fixed steps; use Adaptive")))
    for r, k in enumerate(model.owner):
        group = [i for i, own in enumerate(model.coordinate) if own == r]
        if (model.free or r) and np.any(np.sum(inertia[group], axis=0) <= 0.0):
            text = _("without inertia it has no fixed steps; use Adaptive")
            problems.append(Problem(f"inertia[{k}]", text))
    for i, torque in enumerate(model.torques):
        if not isinstance(torque.law, Constant | Swinging | Falling | SpeedTable | History | Asynchronous):
            text = _("a torque of this kind has no fixed steps; use Adaptive")
            problems.append(Problem(f"torques[{i}].law", text))
    if not isinstance(model.input_motion, Uniform | SpeedCourse | None):
        problems.append(Problem("input_motion", _("a motion of this kind has no fixed steps; use Adaptive")))
    return problems


def _load(law: Law, place: int, drives: int, start: float) -> lines.Load:
    def numbers(*values: Array) -> Array:
        return np.stack([np.broadcast_to(np.asarray(one, dtype=float), (drives,)) for one in values])

    if isinstance(law, Constant):
        return lines.Load(kind=lines.CONSTANT, place=place, numbers=numbers(law.value))
    if isinstance(law, Swinging):
        return lines.Load(kind=lines.SWINGING, place=place, numbers=numbers(law.amplitude, law.frequency, law.phase))
    if isinstance(law, Falling):
        return lines.Load(kind=lines.FALLING, place=place, numbers=numbers(law.standstill, law.slope))
    if isinstance(law, Asynchronous):
        own = (1.0 / np.asarray(law.synchronous_speed), law.pullout_torque, law.pullout_slip)
        return lines.Load(kind=lines.KLOSS, place=place, numbers=numbers(*own))
    if isinstance(law, History):
        return lines.Load(
            kind=lines.HISTORY,
            place=place,
            numbers=np.zeros((0, drives)),
            times=np.asarray(law.times, dtype=float) - start,
            values=np.asarray(law.torques, dtype=float),
        )
    assert isinstance(law, SpeedTable)
    speeds, torques = np.asarray(law.speeds, dtype=float), np.asarray(law.torques, dtype=float)
    slope = np.concatenate(([0.0], np.diff(torques) / np.diff(speeds), [0.0]))
    points = [one for pair in zip(speeds, np.diff(slope), strict=True) for one in pair]
    return lines.Load(kind=lines.SPEEDS, place=place, numbers=numbers(torques[0], *points))
