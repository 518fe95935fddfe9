"""Many torsional models in one leading axis, and their steady running as an oscillator about even rotation."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import Linearised
from cardan.texts import _

from .torques import Law, base_period
from .torsional_balance import linearised, places
from .torsional_model import Torque, TorsionalModel

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
    orders: list[float] = []
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

    Of stability what is left tells the truth to first order: such a torque changes no coefficient in step with another.
    """
    orders = [torque.law.order for torque in model.torques]
    loose = tuple(k for k, order in enumerate(orders) if order is not None and base_period((order,)) is None)
    return replace(model, torques=tuple(one for k, one in enumerate(model.torques) if k not in loose)), loose


class Turning:
    """The drives as oscillators: how far each coordinate is off even rotation; see `harmonics.Equation`.

    model (...); speed (B,) [rad/s]: of the input, or mean speed of free drives; period [rad]: shaft angle of a period.
    share (B,): bends are these shares of their own.
    rounding: radius of the corners of backlash over its half; elements then keep their damping amid it. 0 by the
    equations.
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
                found = replace(found, joint_angle=found.joint_angle * self.share[rows][:, None])
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
    )
