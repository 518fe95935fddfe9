"""Where the masses of a torsional line stand: the places along every shaft that turn by themselves."""

from __future__ import annotations

from dataclasses import dataclass

from .body import body_length
from .described import Described
from .shaft import Shaft

SAME = 1e-9  # places of a shaft nearer than this share of its length, or of a metre, are one


@dataclass(frozen=True, kw_only=True, slots=True)
class Place:
    """A place of a shaft that turns by itself."""

    # [m]: along the power flow from the joint before, on shaft 1 from joint 1; None where the drive does not say
    position: float | None
    stations: tuple[int, ...] = ()  # stations of the drive there, by their index


def has_torsion(drive: Described) -> bool:
    """Tell whether a drive file says enough of masses and stiffness to ask how the drive vibrates in torsion."""
    return bool(drive.stations) or any(shaft.stiffness is not None for shaft in drive.shafts)


def shaft_places(drive: Described, number: int, length: float | None) -> tuple[Place, ...]:
    """Return the places of a shaft along the power flow: its two ends with the stations between, or one if it is rigid.

    number: of the shaft, from 1; length [m]: its `line_length`.
    Stations without a place follow in the order of the file; on an end shaft the outermost of them is its free end.
    """
    own = [k for k, station in enumerate(drive.stations) if station.shaft == number]
    if not is_elastic(drive, number, length):
        return (Place(position=0.0, stations=tuple(own)),)
    placed = {k: drive.stations[k].position for k in own}
    begin, stop = (None if length is None else -length, 0.0) if number == 1 else (0.0, length)
    groups: dict[str, list[int]] = {"start": [], "end": []}
    between: list[tuple[float | None, list[int]]] = []
    for k in sorted(own, key=lambda k: (placed[k] is not None, placed[k] or 0.0)):
        at, end = placed[k], drive.stations[k].end
        near = SAME * (length or 1.0)
        if at is not None:
            end = "start" if begin is not None and at <= begin + near else end
            end = "end" if stop is not None and at >= stop - near and end is None else end
        if end in groups:  # no other word: validation judges it, and comes by here
            groups[end].append(k)
        elif at is not None and between and between[-1][0] is not None and at - between[-1][0] <= near:
            between[-1][1].append(k)
        else:
            between.append((at, [k]))
    if between and between[0][0] is None:  # without places of their own they reach to the free end of the drive
        if number == 1 and not groups["start"]:
            groups["start"] = between.pop(0)[1]
        elif number == len(drive.joints) + 1 and not groups["end"]:
            groups["end"] = between.pop()[1]
    return (
        Place(position=begin, stations=tuple(groups["start"])),
        *(Place(position=at, stations=tuple(here)) for at, here in between),
        Place(position=stop, stations=tuple(groups["end"])),
    )


def line_length(drive: Described, number: int, known: float | None) -> float | None:
    """Return the length of a shaft [m]: between its joints, else that of its body, else to its outermost station."""
    shaft = numbered(drive, number)
    length = known if shaft is None else body_length(shaft, known)
    if length is not None:
        return length
    places = [s.position for s in drive.stations if s.shaft == number and s.position is not None]
    return max((abs(one) for one in places), default=0.0) or None


def is_elastic(drive: Described, number: int, length: float | None) -> bool:
    """Tell whether a shaft can twist: it has a stiffness, a body of known length, or an element from a station."""
    shaft = numbered(drive, number)
    if shaft is not None and (shaft.stiffness is not None or (shaft.has_body and length is not None)):
        return True
    if shaft is not None and shaft.spline is not None and shaft.spline.stiffness is not None:
        return True
    return any(station.shaft == number and station.to_next is not None for station in drive.stations)


def numbered(drive: Described, number: int) -> Shaft | None:
    """Return the shaft of a number; None where the drive does not describe it."""
    return next((shaft for shaft in drive.shafts if shaft.number == number), None)
