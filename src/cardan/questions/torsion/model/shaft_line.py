"""Stations and elements of one shaft: from its body, its own stiffness and inertia, and the stations on it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from cardan.answers.quantity import Quantity, Say, say, told
from cardan.answers.reader import USUAL
from cardan.drive.body import Piece, body_length, pieces
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.shaft import Shaft
from cardan.drive.station import ToNext
from cardan.drive.torsional_layout import Place, line_length, shaft_places
from cardan.errors import Problem
from cardan.texts import _

NEAR = 1e-9
"""Places nearer than this share of a shaft are one."""


@dataclass(frozen=True, kw_only=True)
class ShaftLine:
    """Stations and elements of a shaft along the power flow."""

    inertia: list[float]  # inertia, ground_damping [kg m², N·m·s/rad]: of its stations
    ground_damping: list[float]  # [N·m·s/rad]
    stiffness: list[float]  # stiffness, damping, backlash, loss_factor: of the elements between them
    damping: list[float]
    backlash: list[float]
    loss_factor: list[float]
    springs: list[ToNext | None]  # of the elements that have a table or dry friction
    share: list[float]  # where the stations are, over the length of the shaft
    names: list[str]
    # list of N (float) [m]: where on the shaft the stations are that only part its body, as a file counts there; None
    # for all others
    cuts: list[float | None]
    held: list[tuple[int, ...]]  # stations of the drive at each, by their index
    assumed: list[str]  # paths of what the drive does not say

    def stations(self, start: int) -> Iterator[tuple[int, int]]:
        """Yield every station of the drive on this shaft with its number in a model where the shaft begins."""
        for k, held in enumerate(self.held):
            for station in held:
                yield station, start + k


def shaft_line(drive: Drive, shaft: Shaft, count: int, problems: list[Problem]) -> ShaftLine:
    """Return stations and elements of a shaft.

    shaft: one of its shafts; count: stretches into which its body is divided between two stations.
    problems: takes up what is missing.
    """
    length = line_length(drive, shaft.number, known_lengths(drive).get(shaft.number))
    places = shaft_places(drive, shaft.number, length)
    if len(places) == 1:
        return _rigid(drive, shaft, places[0], length)
    return _Elastic(drive, shaft, places, length, count, problems).line()


def _rigid(drive: Drive, shaft: Shaft, place: Place, length: float | None) -> ShaftLine:
    body = sum(_turning(one) for one in pieces(shaft, length))
    own = body if shaft.inertia is None else shaft.inertia
    own += sum(one.polar_inertia for one in shaft.masses)
    stations = [drive.stations[k] for k in place.stations]
    path = f"shafts[{shaft.number - 1}]"
    assumed = [f"{path}.stiffness"]
    if not own and not any(station.inertia for station in stations):
        assumed.append(f"{path}.inertia")
    named = [station.name for station in stations if station.name]
    name = ", ".join(named) or shaft.name or _("shaft {number}").format(number=shaft.number)
    at_joint = 1.0 if shaft.number == 1 else 0.0
    return ShaftLine(
        inertia=[own + sum(station.inertia for station in stations)],
        ground_damping=[sum(station.ground_damping for station in stations)],
        stiffness=[],
        damping=[],
        backlash=[],
        loss_factor=[],
        springs=[],
        share=[at_joint],
        names=[name],
        cuts=[None],
        held=[place.stations],
        assumed=assumed,
    )


def cut_name(shaft: int, place: float) -> Say:
    """Return what a station is called that only parts the body of a shaft, at a place [m] as a file counts there."""
    return say(_("shaft {number} at {place}"), number=shaft, place=Quantity(place, "length", trim=True))


def _turning(piece: Piece) -> float:
    """Return the inertia of a stretch about its axis [kg m²]."""
    return piece.inertia


class _Elastic:
    """A shaft that twists: its places with what lies between, from the beginning of the shaft on."""

    def __init__(
        self,
        drive: Drive,
        shaft: Shaft,
        places: Sequence[Place],
        length: float | None,
        count: int,
        problems: list[Problem],
    ) -> None:
        self.drive, self.shaft, self.places, self.length = drive, shaft, places, length
        self.path = f"shafts[{shaft.number - 1}]"
        self.problems = problems
        self.body = pieces(shaft, body_length(shaft, length))
        origin = (length or 0.0) if shaft.number == 1 else 0.0
        known = [place.position for place in places]
        self.at = [None if one is None or length is None else one + origin for one in known]
        self.lumps = [(one.position + origin, one.polar_inertia) for one in shaft.masses if one.polar_inertia]
        self.cuts = [self._cuts(k, count) for k in range(len(places) - 1)]
        self.spline = self._spline_element()

    def _cuts(self, k: int, count: int) -> list[float]:
        """Return the places within an element at which its body is divided, as shares of its length."""
        begin, end = self.at[k], self.at[k + 1]
        if begin is None or end is None or not (self.body or self.shaft.stiffness):
            return []
        inner = {begin + (end - begin) * j / count for j in range(1, count)} if self.body else set()
        inner |= {at for at, _inertia in self.lumps}
        near = NEAR * float(self.length or 1.0)
        return [(at - begin) / (end - begin) for at in sorted(inner) if begin + near < at < end - near]

    def line(self) -> ShaftLine:
        """Return stations and elements."""
        springs = [self._stiffness(k) for k in range(len(self.cuts))]
        whole = 1.0 / sum(1.0 / one for one in springs) if all(springs) else 0.0
        stiffness: list[float] = []
        damping: list[float] = []
        backlash: list[float] = []
        loss: list[float] = []
        bent: list[ToNext | None] = []
        for k, spring in enumerate(springs):
            leading = self._leading(k)
            damper = (self.shaft.damping or 0.0) * spring / whole if whole else 0.0
            damper = damper if leading is None or leading.damping is None else leading.damping
            eta = self.shaft.loss_factor if leading is None or leading.loss_factor is None else leading.loss_factor
            shares = self._shares(k)
            stiffness += [spring / share for share in shares]
            damping += [damper / share for share in shares]
            loss += [eta or 0.0] * len(shares)
            own = leading if leading is not None and (leading.twists or leading.friction) else None
            if own is not None and len(shares) > 1:
                field = f"stations[{self.places[k].stations[0]}].to_next"
                text = _("masses part it; a spring with a table or friction is one element")
                self.problems.append(Problem(field, text))
            bent += [own, *[None] * (len(shares) - 1)]
            play = [0.0 if leading is None else leading.backlash, *[0.0] * (len(shares) - 1)]
            if self.shaft.spline is not None and self.spline[0] == k:
                play[self.spline[1]] += self.shaft.spline.backlash
            backlash += play
        share, names, cuts, held = self._stations()
        inertia = self._inertia(share, held)
        return ShaftLine(
            inertia=inertia,
            ground_damping=[sum(self.drive.stations[j].ground_damping for j in here) for here in held],
            stiffness=stiffness,
            damping=damping,
            backlash=backlash,
            loss_factor=loss,
            springs=bent,
            share=share,
            names=names,
            cuts=cuts,
            held=held,
            assumed=self._assumed(inertia, any(damping) or any(loss)),
        )

    def _leading(self, k: int) -> ToNext | None:
        """Return what the stations of a place say of the element behind it."""
        given = [self.drive.stations[j].to_next for j in self.places[k].stations]
        return next((one for one in given if one is not None), None)

    def _compliance(self, begin: float, end: float) -> float:
        """Return 1/c of the body between two places [rad/(N m)]."""
        found = 0.0
        for one in self.body:
            reach = min(end, one.start + one.length) - max(begin, one.start)
            if reach > 0.0:
                found += reach / (one.material.shear_modulus * one.torsion_constant)
        return found

    def _spline_element(self) -> tuple[int, int]:
        """Return element and stretch of it in which the spline sits, if there is one."""
        place = self.shaft.spline.position if self.shaft.spline is not None else None
        at = 0.5 * float(self.length or 0.0) if place is None else place
        for k, cuts in enumerate(self.cuts):
            begin, end = self.at[k], self.at[k + 1]
            if begin is None or end is None:
                break
            if at < end or k == len(self.cuts) - 1:
                return k, sum(at >= begin + cut * (end - begin) for cut in cuts)
        return 0, 0

    def _teeth(self, k: int) -> float:
        """Return 1/c of the spline, if it is in an element and not rigid [rad/(N m)]."""
        given = None if self.shaft.spline is None else self.shaft.spline.stiffness
        return 0.0 if given is None or self.spline[0] != k else 1.0 / given

    def _stiffness(self, k: int) -> float:
        """Return the stiffness of an element, 0 where the drive does not say it [N·m/rad]."""
        leading = self._leading(k)
        if leading is not None and leading.stiffness is not None:
            return leading.stiffness
        if leading is not None and leading.twists:
            return leading.tangent(self.drive.duty.torque or 0.0)
        begin, end = self.at[k], self.at[k + 1]
        known = begin is not None and end is not None
        if self.shaft.stiffness is not None:
            if len(self.cuts) == 1:
                return self.shaft.stiffness
            if known:
                return self.shaft.stiffness / self._part(float(begin or 0.0), float(end or 0.0))
        elif self.shaft.has_body and known:
            return 1.0 / (self._compliance(float(begin or 0.0), float(end or 0.0)) + self._teeth(k))
        elif self._teeth(k):
            return 1.0 / self._teeth(k)
        stations, last = self.places[k].stations, len(self.places) - 1
        field = f"stations[{stations[0]}].to_next.stiffness" if stations else f"{self.path}.stiffness"
        text = _("missing; nothing says how stiff the shaft is from {one} to {two}")
        names = [self._name(j, self.places[j], last) for j in (k, k + 1)]
        found = Problem(field, text.format(one=names[0], two=names[1]))
        if found not in self.problems:
            self.problems.append(found)
        return 0.0

    def _part(self, begin: float, end: float) -> float:
        """Return the share of a stretch in the twist of the whole shaft."""
        length = float(self.length or 1.0)
        if not self.body:
            return (end - begin) / length
        return self._compliance(begin, end) / self._compliance(0.0, length)

    def _shares(self, k: int) -> list[float]:
        """Return the shares of the stretches of an element in its twist."""
        if not self.cuts[k]:
            return [1.0]
        begin, end = float(self.at[k] or 0.0), float(self.at[k + 1] or 0.0)
        bounds = [begin, *(begin + cut * (end - begin) for cut in self.cuts[k]), end]
        soft = [self._part(one, two) for one, two in pairwise(bounds)]
        teeth = self._teeth(k)
        if teeth and self.body:
            soft[self.spline[1]] += teeth / self._compliance(0.0, float(self.length or 1.0))
        return [one / math.fsum(soft) for one in soft]

    def _stations(self) -> tuple[list[float], list[str], list[float | None], list[tuple[int, ...]]]:
        """Return place, name, cut of the body and stations of the drive at every station of the shaft."""
        shares: list[float] = []
        names: list[str] = []
        cuts: list[float | None] = []
        held: list[tuple[int, ...]] = []
        last = len(self.places) - 1
        for k, place in enumerate(self.places):
            at = self.at[k]
            shares.append(k / last if at is None or not self.length else at / self.length)
            names.append(self._name(k, place, last))
            cuts.append(None)
            held.append(place.stations)
            for cut in self.cuts[k] if k < last else ():
                begin, end = float(self.at[k] or 0.0), float(self.at[k + 1] or 0.0)
                inner = begin + cut * (end - begin)
                shares.append(inner / float(self.length or 1.0))
                origin = float(self.length or 0.0) if self.shaft.number == 1 else 0.0
                cuts.append(inner - origin)
                names.append(told(cut_name(self.shaft.number, inner - origin), USUAL))
                held.append(())
        return shares, names, cuts, held

    def _name(self, k: int, place: Place, last: int) -> str:
        named = [self.drive.stations[j].name for j in place.stations if self.drive.stations[j].name]
        if named:
            return ", ".join(named)
        number, joints = self.shaft.number, len(self.drive.joints)
        if k == 0:
            return _("input end") if number == 1 else _("joint {number}, driven yoke").format(number=number - 1)
        if k == last:
            return _("output end") if number > joints else _("joint {number}, driving yoke").format(number=number)
        return _("shaft {number}, station {station}").format(number=number, station=k + 1)

    def _inertia(self, share: list[float], held: list[tuple[int, ...]]) -> list[float]:
        """Return the inertia of every station: half of each stretch at either end, and what stands there."""
        found = [sum(self.drive.stations[j].inertia for j in here) for here in held]
        length = self.length
        placed = length is not None and all(at is not None for at in self.at)
        if placed and length is not None:
            parts = [self._between(one * length, two * length) for one, two in pairwise(share)]
        else:
            parts = []
        own = self.shaft.inertia
        whole = math.fsum(parts)
        if own is not None and placed:
            reach = [two - one for one, two in pairwise(share)]
            parts = [own * (part / whole if whole else by) for part, by in zip(parts, reach, strict=True)]
        elif own is not None:  # nothing says where it is: half at each end
            found[0] += 0.5 * own
            found[-1] += 0.5 * own
        for k, part in enumerate(parts):
            found[k] += 0.5 * part
            found[k + 1] += 0.5 * part
        for at, inertia in self.lumps:
            near = [abs(one * (length or 0.0) - at) for one in share] if placed else []
            end = len(found) - 1 if self.shaft.number == 1 else 0
            found[near.index(min(near)) if near else end] += inertia
        return found

    def _between(self, begin: float, end: float) -> float:
        """Return the inertia of the body between two places [kg m²]."""
        found = 0.0
        for one in self.body:
            reach = min(end, one.start + one.length) - max(begin, one.start)
            if reach > 0.0:
                found += _turning(one) * reach / one.length
        return found

    def _assumed(self, inertia: list[float], damped: bool) -> list[str]:
        found = []
        if not any(inertia):
            found.append(f"{self.path}.inertia")
        if self.shaft.outer is not None and self.shaft.material is None and self.shaft.stiffness is None:
            found.append(f"{self.path}.material")
        if not damped:
            found.append(f"{self.path}.damping")
        return found
