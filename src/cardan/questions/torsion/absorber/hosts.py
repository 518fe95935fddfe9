"""Where an absorber can hang on a drive: every station of its torsional line, and the drive with something on one."""

from __future__ import annotations

from dataclasses import dataclass, replace

from cardan.drive.drive import Drive
from cardan.drive.station import Absorber, Pendulum, Station
from cardan.errors import refuse
from cardan.questions.torsion.model.shaft_line import ShaftLine, shaft_line
from cardan.questions.torsion.model.torsional_train import TorsionalTrain
from cardan.texts import _
from cardan.units import nearest


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
    """Return the stations on which something can hang, along the power flow.

    pieces: stretches of its bodies there.
    """
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
