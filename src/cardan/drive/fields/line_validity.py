"""What a drive must satisfy to be a torsional line: its stations, its play and damping, and the torques on it."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.drive.described import Described
from cardan.drive.line import is_elastic, line_length, shaft_places
from cardan.drive.machine import MachineTorque
from cardan.drive.shaft import Shaft
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import mm, nearest

from .parts import ROUNDING, known_lengths, place_problems

ENDS = ("input", "output")
"""Words for the two ends of a drive; no station may be called so."""


def line_problems(drive: Described) -> Iterator[Problem]:
    """Yield what contradicts itself in the stations and torques of a drive, and keys that nothing can use in it."""
    lengths = _lengths(drive)
    yield from _station_problems(drive, lengths)
    for shaft in drive.shafts:
        if shaft.number <= len(drive.joints) + 1:
            yield from _twist_problems(drive, shaft, lengths)
    for i, joint in enumerate(drive.joints):
        if joint.backlash and not any(is_elastic(drive, k, lengths.get(k)) for k in (i + 1, i + 2)):
            text = _("shafts {one} and {two} are rigid; play counts beside a shaft that twists")
            yield Problem(f"joints[{i}].backlash", text.format(one=i + 1, two=i + 2))
    yield from _torque_problems(drive)


def _lengths(drive: Described) -> dict[int, float]:
    """Return the lengths of the shafts by their number, of end shafts too, as far as the drive says them [m]."""
    known = known_lengths(drive)
    found = {k: line_length(drive, k, known.get(k)) for k in range(1, len(drive.joints) + 2)}
    return {k: length for k, length in found.items() if length is not None}


def _station_problems(drive: Described, lengths: dict[int, float]) -> Iterator[Problem]:
    names: set[str] = set()
    known = known_lengths(drive)
    for k, station in enumerate(drive.stations):
        path = f"stations[{k}]"
        yield from place_problems(station.shaft, station.position, len(drive.joints), known, path)
        length = lengths.get(station.shaft)
        reach = 0.0 if station.shaft in known or length is None else abs(station.position or 0.0)
        if length is not None and reach > length * (1.0 + ROUNDING):
            text = _("is beyond the end of shaft {number}, which is {length:.6g} mm long")
            yield Problem(f"{path}.position", text.format(number=station.shaft, length=length / mm))
        if station.position is not None and station.end is not None:
            yield Problem(f"{path}.position", _("end says where it is already"))
        if station.absorber is not None and station.pendulum is not None:
            yield Problem(f"{path}.pendulum", _("an absorber is there already; put it on a station of its own"))
        if station.absorber is not None and not (station.absorber.stiffness or station.absorber.damping):
            text = _("missing; or damping, for a damper without spring: nothing holds the mass")
            yield Problem(f"{path}.absorber.stiffness", text)
        if station.name in names or station.name in ENDS:
            text = _("{name} names an end of the drive") if station.name in ENDS else _("{name} names two stations")
            yield Problem(f"{path}.name", text.format(name=repr(station.name)))
        names |= {station.name} - {""}
    for number in range(1, len(drive.joints) + 2):
        own = [(k, one) for k, one in enumerate(drive.stations) if one.shaft == number]
        loose = [k for k, one in own if one.end is None and one.position is None]
        placed = any(one.position is not None for _k, one in own)
        for k in loose if placed else ():
            text = _("missing; other stations of shaft {number} have theirs")
            yield Problem(f"stations[{k}].position", text.format(number=number))
        if not (loose and placed):
            yield from _order_problems(drive, number, lengths.get(number))


def _order_problems(drive: Described, number: int, length: float | None) -> Iterator[Problem]:
    """Yield elements that lead nowhere, and two of them from one place."""
    for place in (places := shaft_places(drive, number, length)):
        leading = [k for k in place.stations if drive.stations[k].to_next is not None]
        for k in leading if place is places[-1] else leading[1:]:
            text = _("there is no further station on shaft {number}")
            other = _("the element to the next station is given at another station of this place")
            message = text.format(number=number) if place is places[-1] else other
            yield Problem(f"stations[{k}].to_next", message)


def _twist_problems(drive: Described, shaft: Shaft, lengths: dict[int, float]) -> Iterator[Problem]:
    path = f"shafts[{shaft.number - 1}]"
    spline = shaft.spline
    if spline is not None and spline.stiffness is not None and shaft.stiffness is not None:
        yield Problem(f"{path}.spline.stiffness", _("the stiffness of the shaft includes it already"))
    if is_elastic(drive, shaft.number, lengths.get(shaft.number)):
        return
    text = _("the shaft is rigid; give its stiffness, or a body of known length")
    for name, there in (
        ("damping", shaft.damping is not None),
        ("loss_factor", shaft.loss_factor is not None),
        ("spline.backlash", spline is not None and spline.backlash > 0.0),
    ):
        if there:
            yield Problem(f"{path}.{name}", text)


def _torque_problems(drive: Described) -> Iterator[Problem]:
    duty = drive.duty
    known = (*ENDS, *(station.name for station in drive.stations if station.name))
    given: list[tuple[str, MachineTorque]] = [
        (f"duty.{name}", one) for name, one in (("motor", duty.motor), ("load", duty.load)) if one is not None
    ]
    given += [(f"duty.torques[{k}]", one) for k, one in enumerate(duty.torques)]
    for path, one in given:
        for problem in one.problems():
            yield Problem(f"{path}.{problem.field}", problem.message)
        if one.station and one.station not in known:
            near = nearest(one.station, known)
            text = _("there is no station {name}; the stations are {known}")
            message = text.format(name=repr(one.station), known=", ".join(known))
            yield Problem(f"{path}.station", message + (_("; the nearest is {near}").format(near=near) if near else ""))
        elif not one.station and path.startswith("duty.torques"):
            yield Problem(f"{path}.station", _("missing; one of {known}").format(known=", ".join(known)))
    if duty.engine is not None:
        for problem in duty.engine.problems():
            yield Problem(f"duty.engine.{problem.field}", problem.message)
    if duty.input == "uniform":
        driving = [name for name in ("engine", "motor") if getattr(duty, name) is not None]
        driving += [f"torques[{k}]" for k, one in enumerate(duty.torques) if one.station == "input"]
        for name in driving:
            text = _('the input turns evenly whatever acts on it; write input = "free", or leave this out')
            yield Problem(f"duty.{name}", text)
    if duty.run_up is not None and duty.run_up.start == duty.run_up.end:
        yield Problem("duty.run_up.end", _("is the speed before; a run-up needs two"))
