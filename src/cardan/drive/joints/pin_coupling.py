"""The pin coupling: each shaft carries a slanting pin, and the pins touch."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.texts import _
from cardan.units import quantity

from .joint import CROSS_ONLY, Joint, both_or_none
from .laws import pin_coupling


@dataclass(frozen=True, kw_only=True, slots=True)
class PinCoupling(Joint):
    """Pin coupling with straight pins: even where both pins are alike."""

    kind: ClassVar[str] = "pin_coupling"
    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    steepest: ClassVar[float] = 0.5 * math.pi

    driving_slant: float = quantity(
        "angle", math.pi / 4, doc="angle of the driving pin with its shaft's axis", above=0.0, below=math.pi / 2
    )
    driven_slant: float | None = quantity(
        "angle", None, doc="that of the driven pin; as the driving one when not given", above=0.0, below=math.pi / 2
    )
    driving_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the start of the driving pin on its shaft's axis", above=0.0
    )
    driven_distance: float | None = quantity(
        "length", None, doc="from the joint centre to the start of the driven pin on its shaft's axis", above=0.0
    )

    def own_problems(self) -> Iterator[Problem]:
        """Yield a distance that stands alone, and distances that unlike pins need."""
        yield from both_or_none(self, "driving_distance", "driven_distance")
        if self._slants[0] != self._slants[1] and self.driving_distance is None and self.driven_distance is None:
            yield from (
                Problem(name, _("missing; pins with unlike slants need it"), "missing")
                for name in ("driving_distance", "driven_distance")
            )

    @property
    def _slants(self) -> tuple[float, float]:
        return self.driving_slant, self.driving_slant if self.driven_slant is None else self.driven_slant

    def pair(self, bend: Array) -> mobius.Pair | None:
        """Return the identity for pins alike, nan where they do not reach round a turn; None for unlike pins."""
        one, other = self._slants
        if one != other or self.driving_distance != self.driven_distance:
            return None
        xp = namespace(bend)
        low, high = pin_coupling.slant_range(bend)
        a, b = mobius.turn(0.0 * bend)
        return xp.where((low < one) & (one < high), a, xp.nan), b

    def deviation(self, angle: Array, bend: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both pins; nan where they do not reach round a turn."""
        one, other = self._slants
        low, high = pin_coupling.slant_range(bend)
        if not bool((low < min(one, other)) & (max(one, other) < high)):
            nothing = angle + math.nan
            return nothing, nothing, nothing
        if self.driving_distance is None or self.driven_distance is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        found = pin_coupling.pin_contact(angle, bend, self.driving_distance, self.driven_distance, one, other)
        return found.deviation, found.ratio, found.ratio_slope
