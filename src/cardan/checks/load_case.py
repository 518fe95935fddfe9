"""A way in which a drive runs, and what that asks of its joints and shafts: torques and couples over a turn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from cardan.drive.duty import Harmonic
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius
from cardan.questions.forces.turn_loads import TurnLoads, turn_loads

BLOCK = 512
"""Drives looked at together: their positions fit the cache."""

MANY = 40
"""Places in half a turn at which each of more drives than this is looked at; a part in a million off at most."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Case:
    """Steady running at a torque and a speed, without masses and friction.

    Leading axes (...) are those of the drives.
    """

    chain: Chain  # kinematic half of the drives
    # loads that a torque of 1 at either end makes; ways of running that share their chain share them
    unit: dict[str, TurnLoads] = field(default_factory=dict)
    name: str = ""  # what to call it; empty for the duty itself
    torque: Array | float | None = None  # (...) [N·m]: size of the torque
    speed: Array | float | None = None  # (...) [rad/s]: size of the input speed
    held: bool = True  # whether it holds that speed, and it is not the middle of a range
    share: Array | float = 1.0  # (...): share of the whole time
    block: bool = False  # whether it is part of a duty cycle
    severity: float = 1.0  # its own factor for shocks over that of the duty
    torque_at: str = "output"  # at which end the torque is given
    harmonics: tuple[Harmonic, ...] = ()  # its swinging parts
    # (...) [N·m]: mean torque that the harmonics belong to, and with which they grow; zero where they do not
    scale: Array | float = 0.0

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
        torque = np.asarray(self.torque, dtype=float)
        if self.harmonics:
            return turn_loads(self.chain, torque, torque_at=self.torque_at, harmonics=self.harmonics, scale=self.scale)
        if self.torque_at not in self.unit:
            self.unit[self.torque_at] = _unit_loads(self.chain, self.torque_at)
        size = np.abs(torque)[..., None]
        return TurnLoads(**{name: size * values for name, values in vars(self.unit[self.torque_at]).items()})


def _unit_loads(chain: Chain, torque_at: str) -> TurnLoads:
    """Return the loads that a torque of 1 makes, of many drives block by block."""
    outer = chain.joint_angle.shape[:-1]
    if math.prod(outer) <= BLOCK:
        return turn_loads(chain, 1.0, torque_at=torque_at)
    parts = [vars(turn_loads(part, 1.0, torque_at=torque_at, look=MANY)) for _rows, part in blocks(chain)]
    whole = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    return TurnLoads(**{name: values.reshape(*outer, values.shape[-1]) for name, values in whole.items()})


def blocks(chain: Chain) -> Iterator[tuple[slice, Chain]]:
    """Yield the drives of a chain in blocks that fit the cache: their rows, and their chain.

    chain (..., n).
    """
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
