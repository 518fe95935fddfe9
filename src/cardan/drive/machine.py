"""What drives and loads a drive: engine, motor, load and other torques on its stations.

Each law of a torque is one class, with its name in `LAWS`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

from cardan.errors import Problem
from cardan.texts import _
from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class MachineTorque:
    """What every law of a torque has: where it acts."""

    kind: ClassVar[str]

    station: str = plain(
        "",
        doc="where it acts: the name of one of the `[[stations]]`, `input` or `output`; by default a motor acts on the "
        "input, a load on the output",
    )

    def problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in this law, each with its field; ranges are checked elsewhere."""
        yield from ()


@dataclass(frozen=True, kw_only=True, slots=True)
class ConstantTorque(MachineTorque):
    """The same torque at every speed and time."""

    kind: ClassVar[str] = "constant"

    torque: float = quantity("torque", doc="torque; a load is positive when it resists the rotation")


@dataclass(frozen=True, kw_only=True, slots=True)
class LinearTorque(MachineTorque):
    """Torque that changes with the speed on a straight line: a motor falls, a load rises."""

    kind: ClassVar[str] = "linear_speed"

    standstill: float = quantity("torque", doc="torque at standstill")
    slope: float = quantity(
        "turning_damping", doc="by how much a driving torque falls, and a load rises, with the speed"
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class SpeedTorque(MachineTorque):
    """Torque over the speed, straight between the points of a table and held beyond its ends."""

    kind: ClassVar[str] = "speed_table"

    speeds: tuple[float, ...] = quantity("angular_speed", doc="speeds of the table, rising")
    torques: tuple[float, ...] = quantity("torque", doc="torques at these speeds; a load is positive when it resists")

    def problems(self) -> Iterator[Problem]:
        """Yield what keeps the table from being one."""
        yield from table_problems("speeds", self.speeds, "torques", self.torques)


@dataclass(frozen=True, kw_only=True, slots=True)
class TorqueHistory(MachineTorque):
    """Measured or computed torque over time from a CSV file, straight between its rows and held beyond its ends.

    Attributes
    ----------
    times : tuple of float
        Times of the rows [s], read when the drive is loaded.
    torques : tuple of float
        Torque in each row [N·m].
    speeds : tuple of float
        Speed measured beside it [rad/s]; no torque follows from it.
    """

    kind: ClassVar[str] = "time_history"

    file: str = plain(doc="CSV file beside the drive file with the columns time_s and torque_Nm")
    times: tuple[float, ...] = ()
    torques: tuple[float, ...] = ()
    speeds: tuple[float, ...] = ()

    def problems(self) -> Iterator[Problem]:
        """Yield what is wrong with the rows of the file, once they are read."""
        if self.times or self.torques:
            for problem in table_problems("times", self.times, "torques", self.torques):
                yield Problem("file", problem.message)
            for problem in table_problems("times", self.times, "speeds", self.speeds) if self.speeds else ():
                yield Problem("file", problem.message)


@dataclass(frozen=True, kw_only=True, slots=True)
class AsynchronousMachine(MachineTorque):
    """Asynchronous machine after Kloss: it drives below its synchronous speed and brakes above it, at either end."""

    kind: ClassVar[str] = "asynchronous"

    synchronous_speed: float = quantity("angular_speed", doc="synchronous speed, not zero")
    pullout_torque: float = quantity("torque", doc="pull-out torque", above=0.0)
    pullout_slip: float = plain(doc="slip at the pull-out torque, as a share of the synchronous speed", above=0.0)

    def problems(self) -> Iterator[Problem]:
        """Yield a synchronous speed of zero."""
        if self.synchronous_speed == 0.0:
            yield Problem("synchronous_speed", _("is zero; such a machine would not turn"))


@dataclass(frozen=True, kw_only=True, slots=True)
class HarmonicTorque(MachineTorque):
    """Torque that alternates with the angle of the station it acts on, without a mean."""

    kind: ClassVar[str] = "harmonic"

    amplitude: float = quantity("torque", doc="amplitude", low=0.0)
    order: float = plain(doc="cycles in one turn of the station", above=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the sine at the start position")


LAWS: dict[str, type[MachineTorque]] = {
    law.kind: law
    for law in (ConstantTorque, LinearTorque, SpeedTorque, TorqueHistory, AsynchronousMachine, HarmonicTorque)
}
"""Value of the file key ``kind`` -> class."""


def table_problems(place: str, places: tuple[float, ...], name: str, values: tuple[float, ...]) -> Iterator[Problem]:
    """Yield what keeps two lists from being a table."""
    if not places:
        yield Problem(place, _("empty; a table has at least one row"))
    elif len(places) != len(values):
        text = _("{given} values given for {wanted} {places}")
        yield Problem(name, text.format(given=len(values), wanted=len(places), places=place))
    elif any(not math.isfinite(one) for one in (*places, *values)):
        yield Problem(place, _("holds something that is not a finite number"))
    elif any(two <= one for one, two in pairwise(places)):
        yield Problem(place, _("does not rise; each value must be above the one before"))


@dataclass(frozen=True, kw_only=True, slots=True)
class EngineHarmonic:
    """Part of an engine's torque that alternates with its crank."""

    order: float = plain(doc="cycles in one turn of the crank; a four-stroke engine has halves", above=0.0)
    torque: float = quantity("torque", doc="amplitude on the input shaft", low=0.0)
    phase: float = quantity("angle", 0.0, doc="phase of the sine at the start position")


@dataclass(frozen=True, kw_only=True, slots=True)
class Engine:
    """Piston engine on the input shaft: the harmonics of its torque as given, or from its crank drive.

    From the crank drive: bore, stroke and mean pressure of the gas, and the oscillating mass. Cylinders fire evenly
    spaced, cylinder 1 at its top dead centre in the start position.
    """

    mean_torque: float | None = quantity(
        "torque", None, doc="mean torque on the input shaft; from the mean pressure when that is given"
    )
    speed_ratio: float = plain(1.0, doc="speed of the engine over that of the input shaft", above=0.0)
    strokes: int = plain(4, doc="strokes of a working cycle: 2 or 4", low=2, high=4)
    cylinders: int | None = plain(None, doc="number of cylinders", low=1)
    harmonics: tuple[EngineHarmonic, ...] = plain((), doc="harmonics of the torque of the whole engine")
    bore: float | None = quantity("length", None, doc="diameter of a cylinder", above=0.0)
    stroke: float | None = quantity("length", None, doc="stroke of a piston, twice the crank radius", above=0.0)
    rod_ratio: float = plain(0.3, doc="crank radius over length of the connecting rod", above=0.0, below=1.0)
    piston_mass: float | None = quantity(
        "mass", None, doc="oscillating mass of a cylinder: piston, pin and a third of the connecting rod", low=0.0
    )
    mean_pressure: float | None = quantity("stress", None, doc="mean indicated pressure", low=0.0)
    compression_ratio: float = plain(10.0, doc="compression ratio", above=1.0)

    def problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in an engine, each with its field."""
        if self.strokes == 3:
            yield Problem("strokes", _("3 is neither 2 nor 4"))
        yield from self._harmonic_problems()
        crank = {"bore": self.bore, "stroke": self.stroke}
        parts = {"mean_pressure": self.mean_pressure, "piston_mass": self.piston_mass}
        given = [name for name, value in (crank | parts).items() if value is not None]
        if given and self.harmonics:
            yield Problem("harmonics", _("{name} gives the harmonics already").format(name=given[0]))
        needed = {"stroke": self.stroke, "cylinders": self.cylinders}
        if self.mean_pressure is not None:
            needed["bore"] = self.bore
        for name, value in needed.items() if given else ():
            if value is None:
                yield Problem(name, _("missing; the torque of the crank drive needs it"))
        if given and all(value is None for value in parts.values()):
            yield Problem("mean_pressure", _("missing; or piston_mass: what should turn the crank?"))
        if self.mean_pressure is None:
            unused = (("bore", self.bore is not None), ("compression_ratio", self.compression_ratio != 10.0))
            for name, there in unused:
                if there and self.piston_mass is not None:
                    yield Problem(name, _("counts only with mean_pressure, which is not given"))
        elif self.mean_torque is not None:
            yield Problem("mean_torque", _("mean_pressure gives it already"))
        if not given and self.rod_ratio != 0.3:
            yield Problem("rod_ratio", _("counts only with mean_pressure or piston_mass, which are not given"))
        if not given and not self.harmonics and self.cylinders is None and self.mean_torque is None:
            yield Problem("harmonics", _("missing; or mean_torque, or cylinders: nothing says what the engine does"))

    def _harmonic_problems(self) -> Iterator[Problem]:
        seen: set[float] = set()
        for k, one in enumerate(self.harmonics):
            step = self.strokes / 2.0
            if one.order in seen:
                yield Problem(f"harmonics[{k}].order", _("order {order:g} is given twice").format(order=one.order))
            seen.add(one.order)
            if math.isfinite(one.order) and abs(one.order * step - round(one.order * step)) > 1e-9:
                text = _("order {order:g} is none of a {strokes}-stroke engine; its orders are multiples of {least:g}")
                message = text.format(order=one.order, strokes=self.strokes, least=1.0 / step)
                yield Problem(f"harmonics[{k}].order", message)


@dataclass(frozen=True, kw_only=True, slots=True)
class RunUp:
    """Change of the input speed at a steady rate."""

    start: float = quantity("angular_speed", 0.0, doc="input speed before")
    end: float = quantity("angular_speed", doc="input speed after")
    duration: float = quantity("time", doc="how long it takes", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Event:
    """What happens again and again in the life asked for, each time with the same torques in time."""

    kind: str = plain(
        doc="`clutch`: a clutch at the input closes while the other side turns at the speed of the duty; `load_step`: "
        "the load at the output changes from the torque of the duty",
        choices=("clutch", "load_step"),
    )
    name: str = plain("", doc="what to call it")
    count: float = plain(doc="how often in the life asked for", above=0.0)
    torque: float = quantity(
        "torque",
        doc="of a clutch what it passes on while it slips, fully closed; of a load step the torque at the output after",
        low=0.0,
    )
    duration: float = quantity("time", 0.0, doc="time in which clutch or load get to this torque", low=0.0)
    start: float = quantity("angular_speed", 0.0, doc="speed of the drive before a clutch closes", low=0.0)
