"""The pin coupling: each shaft carries a slanting pin, and the pins touch."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array, namespace
from cardan.maths.kernel import mobius
from cardan.maths.kernel.meshes import joined, placed, revolved
from cardan.texts import _, mark
from cardan.units import deg, quantity

from .common.drawn import about
from .common.inner import InnerPair, touching
from .common.inside import Inside
from .common.site import Site
from .common.stance import Stance
from .joint import REFUSALS, Joint, both_or_none
from .laws import pin_coupling


@dataclass(frozen=True, kw_only=True, slots=True)
class PinCoupling(Joint):
    """Pin coupling with straight pins: even where both pins are alike."""

    kind: ClassVar[str] = "pin_coupling"
    title: ClassVar[str] = mark("pin coupling")
    types: ClassVar[tuple[str, ...]] = ("pin_ball",)
    steepest: ClassVar[float] = 0.5 * math.pi
    refusals: ClassVar[Mapping[str, str]] = {
        **REFUSALS,
        "forces": mark("its pins touch beside the axes, so that its shafts take forces besides the couple"),
    }

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

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the identity for pins alike, nan where they do not reach round a turn; None for unlike pins."""
        one, other = self._slants
        if one != other or self.driving_distance != self.driven_distance:
            return None
        xp = namespace(joint_angle)
        low, high = pin_coupling.slant_range(joint_angle)
        a, b = mobius.turn(0.0 * joint_angle)
        return xp.where((low < one) & (one < high), a, xp.nan), b

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return the law of the contact of both pins; nan where they do not reach round a turn."""
        one, other = self._slants
        low, high = pin_coupling.slant_range(joint_angle)
        if not bool((low < min(one, other)) & (max(one, other) < high)):
            nothing = angle + math.nan
            return nothing, nothing, nothing
        if self.driving_distance is None or self.driven_distance is None:
            return 0.0 * angle, 1.0 + 0.0 * angle, 0.0 * angle
        found = pin_coupling.pin_contact(angle, joint_angle, self.driving_distance, self.driven_distance, one, other)
        return found.deviation, found.ratio, found.ratio_slope

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield which slants turn all round, and way and force of the contact where the distances are given."""
        low, high = (float(end) for end in pin_coupling.slant_range(joint_angle))
        text = _("slant above which pins turn all the way round at this joint angle")
        yield Inside(key="least_slant", meaning=text, value=low)
        yield Inside(key="most_slant", meaning=_("slant below which they do"), value=high)
        if self.driving_distance is None or self.driven_distance is None:
            return
        turn, distances = np.arange(360) * deg, (self.driving_distance, self.driven_distance)
        found = pin_coupling.pin_contact(turn, joint_angle, *distances, *self._slants)
        text = _("way of the contact along the driving pin")
        yield Inside(key="stroke", meaning=text, value=float(np.ptp(found.first)), dimension="length")
        text = _("largest contact force, without friction, for each N·m of torque, in N")
        yield Inside(key="force_N_per_Nm", meaning=text, value=float(np.max(found.force)), dimension=None)

    def inner(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the contact of its pins."""
        return touching(stance)

    def solid(self, site: Site) -> None:
        """Add its hubs, and the pins that lean toward each other and touch."""
        usual = 0.85 * site.size.radius
        slants, starts = self._slants, (self.driving_distance or usual, self.driven_distance or usual)
        count = 3 if slants[0] == slants[1] and starts[0] == starts[1] else 1
        for side, slant, start in zip(site.sides, slants, starts, strict=True):
            long = 1.12 * start / max(np.cos(slant) - np.sin(slant) * np.tan(0.5 * site.stance.joint_angle), 0.35)
            thin = 0.09 * start
            tip = [(long - thin, thin), (long - 0.3 * thin, 0.7 * thin), (long, 0.0)]
            pin = revolved([(0.0, 0.0), (0.0, thin), *tip], 14)
            lean = np.asarray([-np.cos(slant), np.sin(slant), 0.0])
            frame = np.stack((lean, np.asarray([-np.sin(slant), -np.cos(slant), 0.0]), np.asarray([0.0, 0.0, 1.0])))
            one = placed(pin, frame, (start, 0.0, 0.0))
            reach = max(side.reach, 1.12 * start)
            hub = revolved(
                [(0.72 * start, 0.0), (0.72 * start, 0.4 * start), (start, 0.55 * start), (1.06 * start, 0.55 * start),
                 (reach, side.body), (reach, 0.0)], 24,
            )  # fmt: skip
            made = joined(hub, *(about(one, j * 2.0 * np.pi / count) for j in range(count)))
            site.add_to(side, side.yoke, site.said(_("hub and pins of {joint}")), made)
