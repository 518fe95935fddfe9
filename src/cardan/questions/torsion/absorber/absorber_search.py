"""The search behind `absorber`: a drive with an absorber of any setting, run over a band of speeds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from math import log10

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.station import Absorber, Pendulum, Station
from cardan.drive.station import Absorber as Branch
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.questions.torsion.model.shaft_line import ShaftLine, shaft_line
from cardan.questions.torsion.model.torsional_layouts import chosen
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.questions.torsion.steady.alternating_torque import exactly_where_high, torque_swings
from cardan.texts import _
from cardan.units import nearest

from .band import Lines, lines

FREQUENCY = 2.0
"""Range of the natural frequency of an absorber in the search: closed form over and times this."""

DAMPING = 10.0
"""The same of its damping."""

ORDER = 1.4
"""The same of the order a pendulum is tuned to."""

COARSE = (0.3, 0.4, 0.5, 0.6, 0.7)
"""Places in these ranges from which the search takes the best to begin with; 0.5 is the closed form."""

LOST = 10.0
"""What a motion that was not found counts as, times the largest torque without absorber."""

DIGITS = 5
"""Digits of what is written into a drive: no absorber is made more accurately."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Setting:
    """How an absorber is set."""

    inertia: float  # [kg·m²]: J_a; of pendulums all m (R + l)² together
    stiffness: float  # [N·m/rad]: c_a; of a pendulum J_a Ω² R/l at the middle of the band
    damping: float  # [N·m·s/rad]: b
    arm: float | None = None  # [m]: l of a pendulum
    peak: float = float("nan")  # [N·m]: largest swing of a torque of the drive in the band, with it
    peak_speed: float = float("nan")  # [rad/s]: where
    peak_element: int = 0  # in which element, from 0 in `Absorber.elements`


def rounded(value: float) -> float:
    """Return a value with as many digits as can be made.

    >>> rounded(65306.12244), rounded(0.0)
    (65306.0, 0.0)
    """
    return 0.0 if value == 0.0 else round(value, DIGITS - 1 - int(np.floor(log10(abs(value)))))


@dataclass(frozen=True, eq=False, kw_only=True)
class Task:
    """A drive, what hangs on it, and the band it is judged in."""

    drive: Drive  # without
    host: Host  # where it hangs
    kind: str
    closed_form: Setting
    speed: Array  # (S,) [rad/s]: speeds of the search
    middle: float  # [rad/s]: speed at which trains are taken
    elements: Array  # elements that are judged, in the model
    radius: float  # [m]: of pendulums
    count: int  # of pendulums

    @property
    def ranges(self) -> tuple[float, ...]:
        """Range of every unknown: closed form over and times it."""
        return {"tuned": (FREQUENCY,), "viscous": (DAMPING,), "pendulum": (ORDER,)}.get(self.kind, (FREQUENCY, DAMPING))

    def setting(self, place: Array) -> Setting:
        """Return the setting at a place (v,) of the unit box; the closed form is its middle."""
        factors = [float(reach ** (2.0 * x - 1.0)) for reach, x in zip(self.ranges, place, strict=True)]
        base = self.closed_form
        if self.kind == "viscous":
            return replace(base, damping=rounded(base.damping * factors[0]))
        if self.kind == "pendulum":
            assert base.arm is not None
            arm = rounded(base.arm / factors[0] ** 2)
            return replace(base, arm=arm, stiffness=base.inertia * self.middle**2 * self.radius / arm)
        damping = rounded(base.damping * factors[1]) if len(factors) > 1 else 0.0
        return replace(base, stiffness=rounded(base.stiffness * factors[0] ** 2), damping=damping)

    def thing(self, setting: Setting) -> Branch | Pendulum:
        """Return what hangs on the station."""
        if setting.arm is None:
            return Branch(inertia=setting.inertia, stiffness=setting.stiffness, damping=setting.damping)
        mass = rounded(setting.inertia / (self.count * (self.radius + setting.arm) ** 2))
        return Pendulum(mass=mass, radius=self.radius, length=setting.arm, count=self.count)

    def with_it(self, setting: Setting) -> tuple[Drive, int]:
        """Return the drive with it, and the number of its `[[stations]]`."""
        return hung(self.drive, self.host, self.thing(setting))

    def line(self, setting: Setting) -> tuple[Lines, int]:
        """Return the drive with it as lines, and its element in the model."""
        drive, table = self.with_it(setting)
        found = lines([drive], self.middle)
        return found, len(found.elements) + branch_of(drive, table)


class Settings:
    """A drive with an absorber of any setting, run at any speeds. bare [N·m]: largest swing without."""

    def __init__(self, task: Task, bare: float) -> None:
        self.task, self.lost = task, LOST * bare
        self.line, self.element = task.line(task.closed_form)
        self._known: tuple[Array, TorsionalModel] | None = None

    @property
    def start(self) -> Array:
        """Places from which a search takes the best to begin with, the closed form amid them: array (D, v)."""
        return np.asarray(list(product(COARSE, repeat=len(self.task.ranges))))

    def swings(self, places: Array, speed: Array) -> Array:
        """Return the swings of the judged torques, array (D, S, E) [N·m]."""
        found = torque_swings(self._models(places, speed), np.tile(speed, len(places)))
        found = exactly_where_high(found, len(places), self.task.elements)
        swing = found.swing[:, self.task.elements]
        return np.where(np.isfinite(swing), swing, self.lost).reshape(len(places), len(speed), -1)

    def _models(self, places: Array, speed: Array) -> TorsionalModel:
        """Return the drives of places (D, v) at speeds (S,), in one axis (D·S,)."""
        width, count = len(speed), len(places)
        if self._known is None or not np.array_equal(self._known[0], speed):
            self._known = speed, self.line.at(speed[None])
        model = chosen(self._known[1], (width,), np.tile(np.arange(width), count), moments=False)
        reach, middle = np.asarray(self.task.ranges), self.task.closed_form
        factor = np.repeat(reach ** (2.0 * places - 1.0), width, axis=0)
        stiffness, damping = model.stiffness.copy(), model.damping.copy()
        if self.task.kind == "viscous":
            damping[:, self.element] *= factor[:, 0]
            stiffness[:, self.element] *= factor[:, 0]  # of what holds it
        else:
            stiffness[:, self.element] *= factor[:, 0] ** 2
        if len(reach) > 1:
            damping[:, self.element] = middle.damping * factor[:, 1]
        return replace(model, stiffness=stiffness, damping=damping, disturbed_damping=None)  # stability is not asked


def highest(swing: Array, speed: Array, elements: Sequence[int] | Array) -> tuple[float, float, int]:
    """Return the largest of swings (S, E), its speed and its element; what was not found does not count."""
    judged = np.nan_to_num(swing[:, np.asarray(elements, dtype=int)], nan=-1.0)
    row, column = np.unravel_index(int(np.argmax(judged)), judged.shape)
    return float(judged[row, column]), float(speed[row]), int(np.asarray(elements)[column])


# Where an absorber can hang on a drive: every station of its torsional line, and the drive with something on one.


@dataclass(frozen=True, kw_only=True, slots=True)
class Host:
    """A station of the torsional line of a drive."""

    station: int  # its number in the model, from 0
    name: str
    shaft: int  # number of its shaft, from 1
    # the `[[stations]]` of the drive that can carry something there, from 0; None where a new one is needed
    table: int | None
    place: Station  # a station at that place with nothing on it: what a new table says


def hosts(drive: Drive, train: TorsionalTrain, *, pieces: int = 1) -> tuple[Host, ...]:
    """Return the stations on which something can hang, along the power flow. pieces: stretches of its bodies there."""
    found: list[Host] = []
    for shaft in drive.shafts:
        line = shaft_line(drive, shaft, pieces, [])
        start = len(found)
        for k in range(len(line.inertia)):
            held = line.held[k]
            bare = [j for j in held if drive.stations[j].absorber is None and drive.stations[j].pendulum is None]
            found.append(
                Host(
                    station=start + k,
                    name=train.model.names[start + k],
                    shaft=shaft.number,
                    table=bare[0] if bare else None,
                    place=_place(drive, train, shaft.number, line, k, start),
                )
            )
    return tuple(found)


def _place(drive: Drive, train: TorsionalTrain, shaft: int, line: ShaftLine, k: int, start: int) -> Station:
    """Return a new station at a place of a shaft."""
    if line.held[k]:
        there = drive.stations[line.held[k][0]]
        return Station(shaft=shaft, position=there.position, end=there.end)
    last = len(line.inertia) - 1
    if last == 0:
        return Station(shaft=shaft)
    if k in (0, last):
        return Station(shaft=shaft, end="end" if k else "start")
    first = train.position[start + (last if shaft == 1 else 0)]
    return Station(shaft=shaft, position=float(train.position[start + k] - first))


def host_named(found: tuple[Host, ...], wanted: str | int) -> Host:
    """Return the station of a name, or of a number from 1 along the power flow."""
    if isinstance(wanted, str) and wanted.isdigit():
        wanted = int(wanted)
    if isinstance(wanted, int):
        if 1 <= wanted <= len(found):
            return found[wanted - 1]
        text = _("station {given} given; the line has stations 1 to {count}")
        raise refuse("station", text.format(given=wanted, count=len(found)))
    for one in found:
        if one.name == wanted or wanted in one.name.split(", "):
            return one
    names = [one.name for one in found]
    near = nearest(wanted, names)
    text = _("there is no station {name}; the stations are {known}")
    message = text.format(name=repr(wanted), known=", ".join(f"{k} ({name})" for k, name in enumerate(names, 1)))
    raise refuse("station", message + (_("; the nearest is {near}").format(near=near) if near else ""))


def hung(drive: Drive, host: Host, thing: Absorber | Pendulum) -> tuple[Drive, int]:
    """Return a drive with an absorber or pendulums on a station, and the number of its `[[stations]]` from 0."""
    what = {"absorber": thing} if isinstance(thing, Absorber) else {"pendulum": thing}
    if host.table is not None:
        tables = list(drive.stations)
        tables[host.table] = replace(tables[host.table], **what)
        return replace(drive, stations=tuple(tables)), host.table
    place = host.place
    taken = any(one.shaft == place.shaft and one.position is None and one.end is None for one in drive.stations)
    if taken and place.position is None and place.end is None:
        text = _("{name} carries an absorber or pendulum already; choose another station")
        raise refuse("station", text.format(name=host.name))
    new = replace(place, name="", **what)
    return replace(drive, stations=(*drive.stations, new)), len(drive.stations)


def branch_of(drive: Drive, table: int, *, pieces: int = 1) -> int:
    """Return which of the absorbers and pendulums of a model, from 0, is that of a `[[stations]]`."""
    order = [
        j
        for shaft in drive.shafts
        for held in shaft_line(drive, shaft, pieces, []).held
        for j in held
        if drive.stations[j].absorber is not None or drive.stations[j].pendulum is not None
    ]
    return order.index(table)
