"""A way in which a drive runs, and what that asks of its joints and shafts: torques and couples over a turn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

import numpy as np

from cardan.drive.conditions import LoadCase, under
from cardan.drive.drive import Drive
from cardan.drive.duty import Harmonic
from cardan.drive.models.kinematics_model import Chain, given_chain, turning
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.questions.forces.turn_loads import TurnLoads, case_loads, largest_loads, sprung, turn_loads
from cardan.questions.motion.motion import motion
from cardan.questions.torsion.model.torsion import torsion_modes
from cardan.questions.torsion.steady.dynamic_torque import DynamicTorque, dynamic_torque

BLOCK = 512
"""Drives looked at together: their positions fit the cache."""

MANY = 40
"""Places in half a turn at which each of more drives than this is looked at; a part in a million off at most."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Vibration:
    """What torsional vibration makes of the loads of one drive in one way of running."""

    speed: Array  # (s,) [rad/s]: speeds in use at which it was looked at
    low: Array  # low, high (s, n+1) [N·m]: least and largest torque of every shaft, counted along the mean torque
    high: Array
    more: TurnLoads  # largest loads at any of these speeds less those without vibration
    without: Array  # (n+1,) [N·m]: largest torque of every shaft without vibration

    @property
    def growth(self) -> Array:
        """Largest torque over that without vibration, array (s, n+1); inf where there is none, nan without either."""
        size = np.maximum(np.abs(self.low), np.abs(self.high))
        with np.errstate(divide="ignore", invalid="ignore"):
            found: Array = size / self.without
        return found


RANGE, AROUND = 41, (-0.02, -0.006, -0.002, 0.0, 0.002, 0.006, 0.02)
"""Speeds at which a range of speeds is looked at, and further ones about every resonance, as shares of its speed."""

CLOSER, ROUNDS = 3, 3
"""Further speeds on either side of the largest torque, and how often they are put ever closer to it."""

SLOWEST = 0.05
"""Share of its upper end below which a range of speeds is not looked at."""


@lru_cache(maxsize=256)
def vibration(drive: Drive, case: LoadCase) -> Vibration | None:
    """Return what torsional vibration adds to the loads of a drive, without poses, in one way of running.

    None where the file does not tell it: no masses and stiffness, no speed, a torque that runs in time.
    At the speed of the duty backlash opens; over a range of speeds it counts as closed.
    """
    run = under(drive, case)
    if not has_torsion(run) or not (case.speed or run.duty.speed_range):
        return None
    try:
        found = [dynamic_torque(run, speed=[case.speed])] if case.speed else []
        if run.duty.speed_range is not None:
            found += _over_range(run, *run.duty.speed_range)
    except InputError:
        return None
    found = [one for one in found if np.any(one.found)]
    if not found:
        return None
    chain = turning(given_chain(run), run.joints, near=True)
    sign = -1.0 if (case.torque or 0.0) < 0.0 else 1.0
    without = case_loads(run, replace(case, joint_angle=None))
    loads = [_loads(chain, one) for one in found]
    low, high = (np.concatenate([getattr(one, name)[one.found] for one in found]) for name in ("low", "high"))
    ends = (low, high) if sign > 0.0 else (-high, -low)
    most = {name: np.max([getattr(one, name) for one in loads], axis=0) for name in vars(without)}
    most |= {"low": np.min(ends[0], axis=0), "high": np.max(ends[1], axis=0)}
    return Vibration(
        speed=np.concatenate([one.speed[one.found] for one in found]),
        low=ends[0],
        high=ends[1],
        more=TurnLoads(**{name: values - getattr(without, name) for name, values in most.items()}),
        without=without.torque,
    )


def _loads(chain: Chain, found: DynamicTorque) -> TurnLoads:
    """Return the largest loads of a drive that vibrates, over all its speeds."""
    entering, leaving = (one[found.found] for one in found.at_joints(found.angle))
    beside = found.beside[found.found][..., None]
    own = largest_loads(
        chain,
        motion(chain, found.angle),
        np.abs(entering) + beside,
        np.abs(leaving) + beside,
        low=found.low[found.found],
        high=found.high[found.found],
    )
    return TurnLoads(**{name: np.max(values, axis=0) for name, values in vars(own).items()})


def _over_range(drive: Drive, low: float, high: float) -> list[DynamicTorque]:
    """Return the torques over a range of input speeds, closer where they are largest."""
    low = max(low, SLOWEST * high)
    met = [one.speed for one in torsion_modes(drive).crossings]
    near = np.asarray([speed * (1.0 + share) for speed in met for share in AROUND])
    speed = np.unique(np.append(np.linspace(low, high, RANGE), near[(near >= low) & (near <= high)]))
    found = [dynamic_torque(drive, speed=speed, closed=True)]
    for _round in range(ROUNDS):
        every = np.concatenate([one.speed for one in found])
        size = np.concatenate([np.nan_to_num(np.max(one.high - one.low, axis=-1), nan=-1.0) for one in found])
        order = np.argsort(every)
        every, size = every[order], size[order]
        k = int(np.argmax(size))
        sides = [every[far] for far in (k - 1, k + 1) if 0 <= far < every.size]
        more = np.concatenate([np.linspace(every[k], side, CLOSER + 2)[1:-1] for side in sides])
        found.append(dynamic_torque(drive, speed=more, closed=True))
    return found


@dataclass(frozen=True, eq=False, kw_only=True)
class Case:
    """Steady running at a torque and a speed, without friction, and without masses but for torsional vibration.

    Leading axes (...) are those of the drives.
    """

    chain: Chain  # kinematic half of the drives
    # loads that a torque of 1 at either end makes; ways of running that share their chain share them
    unit: dict[str, TurnLoads] = field(default_factory=dict)
    name: str = ""  # what to call it; empty for the duty itself
    torque: Array | float | None = None  # (...) [N·m]: size of the torque
    speed: Array | float | None = None  # (...) [rad/s]: size of the input speed
    # (...) [rad/s]: highest of the speeds at which it runs; None where it is one speed
    fastest: Array | float | None = None
    held: bool = True  # whether it holds that speed, and it is not the middle of a range
    share: Array | float = 1.0  # (...): share of the whole time
    block: bool = False  # whether it is part of a duty cycle
    severity: float = 1.0  # its own factor for shocks over that of the duty
    torque_at: str = "output"  # at which end the torque is given
    harmonics: tuple[Harmonic, ...] = ()  # its swinging parts
    # (...) [N·m]: mean torque that the harmonics belong to, and with which they grow; zero where they do not
    scale: Array | float = 0.0
    history: bool = False  # whether it is the peak of a measured torque
    # finds what torsional vibration adds
    vibrating: Callable[[], Vibration | None] = lambda: None

    @cached_property
    def vibration(self) -> Vibration | None:
        """What torsional vibration adds, of the drive that the others vary; None where the file does not tell it."""
        return self.vibrating()

    @cached_property
    def joint_angle(self) -> Array:
        """Joint angle of every joint, array (..., n) [rad]."""
        return self.chain.joint_angle if self.chain.laws is None else self.chain.laws.joint_angle

    def between(self, first: int, last: int) -> mobius.Pair:
        """Return the Möbius pair of the joints from ``first`` on, counted from 0, up to before ``last``."""
        part = mobius.partial_products(self.chain.joint_angle[..., first:last], self.chain.turn_before[..., first:last])
        return part[-1]

    @property
    def torque_range(self) -> tuple[Array, Array]:
        """Least and largest torque of every shaft over a turn, two arrays (..., n+1) [N·m]."""
        return self._loads.low, self._loads.high

    @property
    def mean_torque(self) -> Array:
        """Middle of the torque of every shaft over a turn without torsional vibration, array (..., n+1) [N·m]."""
        plain = self._without_vibration
        return 0.5 * (plain.low + plain.high)

    @property
    def shaft_torque(self) -> Array:
        """Largest size of the torque of every shaft over a turn, array (..., n+1) [N·m]."""
        return self._loads.torque

    @property
    def joint_torque(self) -> Array:
        """Largest torque over a turn on either side of every joint, array (..., n) [N·m]."""
        high = self._loads.torque
        found: Array = np.maximum(high[..., :-1], high[..., 1:])
        return found

    @property
    def couple(self) -> Array:
        """Largest couple across every cross over a turn, array (..., n) [N·m]; over the span it loads a journal."""
        return self._loads.couple

    @property
    def end_bending(self) -> Array:
        """Largest secondary couple at either end of every shaft, array (..., n+1) [N·m]."""
        return self._loads.bending

    @property
    def mises_moment(self) -> Array:
        """Largest √(4 M_b² + 3 T²) at either end of every shaft, array (..., n+1) [N·m]; von Mises over 1/W_t."""
        return self._loads.mises

    @property
    def end_moment(self) -> Array:
        """Largest √(T² + M_b²) at either end of every shaft, array (..., n+1) [N·m]: the couple of the cross there."""
        return self._loads.moment

    @cached_property
    def _loads(self) -> TurnLoads:
        """Largest loads over a turn."""
        plain, added = self._without_vibration, self.vibration
        if added is None:
            return plain
        found = {name: values + getattr(added.more, name) for name, values in vars(plain).items()}
        signed = {name: found.pop(name) for name in ("low", "high")}
        return TurnLoads(**signed, **{name: np.maximum(values, 0.0) for name, values in found.items()})

    @cached_property
    def _without_vibration(self) -> TurnLoads:
        torque = np.asarray(self.torque, dtype=float)
        if self.harmonics:
            return turn_loads(self.chain, torque, torque_at=self.torque_at, harmonics=self.harmonics, scale=self.scale)
        if self.torque_at not in self.unit:
            self.unit[self.torque_at] = _unit_loads(self.chain, self.torque_at)
        size = np.abs(torque)[..., None]
        found = TurnLoads(**{name: size * values for name, values in vars(self.unit[self.torque_at]).items()})
        return found if self.chain.laws is None else sprung(found, self.chain.laws)


def _unit_loads(chain: Chain, torque_at: str) -> TurnLoads:
    """Return the loads that a torque of 1 makes, of many drives block by block."""
    if chain.laws is not None:
        chain = replace(chain, laws=replace(chain.laws, spring=0.0 * chain.laws.spring))
    outer = chain.joint_angle.shape[:-1]
    if math.prod(outer) <= BLOCK:
        return turn_loads(chain, 1.0, torque_at=torque_at)
    parts = [vars(turn_loads(part, 1.0, torque_at=torque_at, look=MANY)) for _rows, part in blocks(chain)]
    whole = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return TurnLoads(**{name: values.reshape(*outer, values.shape[-1]) for name, values in whole.items()})


def blocks(chain: Chain) -> Iterator[tuple[slice, Chain]]:
    """Yield the drives of a chain in blocks that fit the cache: their rows, and their chain. chain (..., n)."""
    outer, joints = chain.joint_angle.shape[:-1], chain.joints
    count = math.prod(outer)
    flat = {
        "joint_angle": np.broadcast_to(chain.joint_angle, (*outer, joints)).reshape(count, joints),
        "plane_twist": np.broadcast_to(chain.plane_twist, (*outer, joints - 1)).reshape(count, joints - 1),
        "yoke_angle": np.broadcast_to(chain.yoke_angle, (*outer, joints - 1)).reshape(count, joints - 1),
        "start_phase": np.broadcast_to(chain.start_phase, outer).reshape(count),
    }
    laws = chain.laws
    tables = {} if laws is None else {k: v for k, v in vars(laws).items() if k != "own"}
    tables = {name: np.broadcast_to(value, (*outer, joints)).reshape(count, joints) for name, value in tables.items()}
    for start in range(0, count, BLOCK):
        rows = slice(start, start + BLOCK)
        own = None if laws is None else replace(laws, **{name: values[rows] for name, values in tables.items()})
        yield rows, replace(chain, laws=own, **{name: values[rows] for name, values in flat.items()})


def largest(values: Sequence[Array | float]) -> Array:
    """Return the largest of arrays (...), place by place."""
    found: Array = np.max(np.stack(np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in values))), axis=0)
    return found
