"""A station: a mass that turns with a shaft, beside those of the shaft itself, and what may hang on it."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from cardan.errors import Problem
from cardan.texts import _
from cardan.units import plain, quantity

from .machine import table_problems


@dataclass(frozen=True, kw_only=True, slots=True)
class ToNext:
    """Element from a station to the next one of its shaft."""

    stiffness: float | None = quantity("turning_stiffness", None, doc="torsional stiffness", above=0.0)
    damping: float | None = quantity("turning_damping", None, doc="torsional damping", low=0.0)
    loss_factor: float | None = plain(None, doc="structural damping η, in place of that of the shaft", low=0.0)
    backlash: float = quantity("angle", 0.0, doc="whole angular play", low=0.0)
    twists: tuple[float, ...] = quantity(
        "angle", (), doc="twists of a spring whose stiffness changes, rising; straight on beyond the ends"
    )
    torques: tuple[float, ...] = quantity("torque", (), doc="torques at these twists, rising")
    friction: float = quantity(
        "torque", 0.0, doc="dry friction beside the spring, half the width of its hysteresis", low=0.0
    )

    def problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in it, each with its field."""
        if not self.twists and not self.torques:
            return
        if self.stiffness is not None:
            yield Problem("stiffness", _("twists and torques give it already"))
        if self.backlash:
            yield Problem("backlash", _("twists and torques hold it: write a part with next to no torque"))
        yield from table_problems("twists", self.twists, "torques", self.torques)
        if len(self.twists) < 2:
            yield Problem("twists", _("at least two are needed"))
        elif any(two <= one for one, two in pairwise(self.torques)):
            yield Problem("torques", _("do not rise; a spring that gives way holds nothing"))

    def tangent(self, torque: float) -> float:
        """Return the stiffness of the table at a torque [N·m/rad]."""
        k = min(max(bisect_right(self.torques, torque) - 1, 0), len(self.torques) - 2)
        return (self.torques[k + 1] - self.torques[k]) / (self.twists[k + 1] - self.twists[k])


@dataclass(frozen=True, kw_only=True, slots=True)
class Absorber:
    """Mass on a spring that takes vibration of one frequency from its station; without a spring a viscous damper."""

    inertia: float = quantity("inertia", doc="inertia of its mass", above=0.0)
    stiffness: float = quantity(
        "turning_stiffness", 0.0, doc="torsional stiffness of its spring; a viscous damper has none", low=0.0
    )
    damping: float = quantity("turning_damping", 0.0, doc="torsional damping between it and its station", low=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Pendulum:
    """Pendulums in the turning field of forces: tuned to one order at every speed."""

    mass: float = quantity("mass", doc="mass of one pendulum", above=0.0)
    radius: float = quantity("length", doc="distance of its pivot from the axis of the shaft", above=0.0)
    length: float = quantity("length", doc="distance of its centre of mass from its pivot", above=0.0)
    count: int = plain(1, doc="how many of them", low=1)
    stop_angle: float | None = quantity(
        "angle",
        None,
        doc="angle to either side at which one meets its stop; it oscillates freely when not given",
        above=0.0,
    )
    stop_stiffness: float | None = quantity(
        "turning_stiffness", None, doc="stiffness of the stop of one pendulum, about its pivot", above=0.0
    )
    stop_damping: float = quantity(
        "turning_damping", 0.0, doc="damping of the stop of one pendulum, while it touches", low=0.0
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Station:
    """Mass that turns with a shaft, for torsional vibration; beside those of the shaft's own body and masses."""

    name: str = plain("", doc="name of the station, for torques, tables and pictures")
    shaft: int = plain(doc="number of the shaft it turns with", low=1)
    position: float | None = quantity(
        "length",
        None,
        doc="place along the power flow from the joint before; on shaft 1 from joint 1, so zero or negative there",
    )
    end: str | None = plain(
        None,
        doc="at which end of the shaft it is; stations with neither end nor position lie between the ends, as they "
        "follow in the file",
        choices=("start", "end"),
    )
    inertia: float = quantity("inertia", 0.0, doc="moment of inertia about the axis of the shaft", low=0.0)
    ground_damping: float = quantity("turning_damping", 0.0, doc="damping against the housing", low=0.0)
    to_next: ToNext | None = plain(None, doc="element to the next station of the shaft, in place of the shaft's own")
    absorber: Absorber | None = plain(None, doc="absorber on the station")
    pendulum: Pendulum | None = plain(None, doc="pendulums on the station")
