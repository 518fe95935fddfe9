"""Torsional models as lines of numbers that fixed steps take through time."""

from __future__ import annotations

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.compiled import torsion_line as lines
from cardan.maths.kernel import turned
from cardan.texts import _

from .input_motion import SpeedCourse, Uniform
from .torques import Asynchronous, Constant, Falling, History, Law, SpeedTable, Swinging
from .torsional_model import TorsionalModel
from .torsional_rates import laws


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
        ahead=turned.angle_error(law[1], law[2], law[0]),
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
