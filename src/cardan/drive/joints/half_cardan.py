"""Half-cardans: couplings without swing axes, rigid or elastic."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.units import plain, quantity

from .joint import CROSS_ONLY, Joint
from .laws import shared_turn


@dataclass(frozen=True, kw_only=True, slots=True)
class HalfCardan(Joint):
    """Rigid half-cardan, a square bell or a gear: the pair of faces that carries turns as a Hooke joint."""

    kind: ClassVar[str] = "half_cardan"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    crossed: ClassVar[bool] = True
    steepest: ClassVar[float] = math.radians(5.0)

    pairs: int = plain(2, doc="pairs of opposite faces or teeth; between two of them there must be play", low=1)

    def pair(self, bend: Array) -> mobius.Pair:
        """Return the map of one pair of faces, that of a Hooke joint."""
        return mobius.hooke(bend)


@dataclass(frozen=True, kw_only=True, slots=True)
class ElasticHalfCardan(Joint):
    """Elastic half-cardan, of rubber or with a disc: even in the mean of its links, and soft against turning."""

    kind: ClassVar[str] = "elastic_half_cardan"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = math.radians(10.0)

    pairs: int | None = plain(
        None, doc="pairs of opposite links that share the torque; without it the joint counts as even", low=2
    )
    stiffness: float | None = quantity("turning_stiffness", None, doc="stiffness against turning", above=0.0)
    damping: float = quantity("turning_damping", 0.0, doc="damping against turning", low=0.0)

    def pair(self, bend: Array) -> mobius.Pair | None:
        """Return the identity, None where the links are counted."""
        return mobius.turn(0.0 * bend) if self.pairs is None else None

    def deviation(self, angle: Array, bend: Array) -> tuple[Array, Array, Array]:
        """Return the mean of what the pairs of links ask for; `cardan.drive.joints.laws.half_cardan`."""
        if self.pairs is None:
            return mobius.course(mobius.turn(0.0 * bend), unit_complex(2.0 * angle))
        tau = mobius.tau(mobius.hooke(bend))
        return shared_turn.course(angle, tau, self.pairs)
