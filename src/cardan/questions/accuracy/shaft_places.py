"""How far do errors and tolerances inside the joints move the shafts behind them?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames

from . import places
from .accuracy import error_arrays, one_turn, way_names
from .own_laws import dimension, seats
from .pair_errors import pair_errors
from .tolerance import DIRECTIONS, ToleranceBand, WorstCase, spreads, stacked

NOTHING = 1e-12
"""Share of the length of a drive, and lean [rad], below which no shaft is moved."""

Ways = tuple[float, float, float]
"""Way of a shaft across itself at its joint and at its far end [m], and how far it leans [rad]."""


@dataclass(frozen=True, kw_only=True, slots=True)
class PlaceShare:
    """By how much one tolerance alone moves a shaft, at the worst place of a turn."""

    joint: int  # number of its joint, from 1
    key: str  # of the error; of a pair inside the joint its path there
    pair: str = ""  # what that pair is called
    dimension: str  # of the error, "" of a pure number
    tolerance: float  # ± in SI
    ways: Ways

    @property
    def field(self) -> str:
        """Path of the tolerance in the drive, ``joints[0].tolerance.offset``."""
        return f"joints[{self.joint - 1}].{'' if self.pair else 'tolerance.'}{self.key}"


@dataclass(frozen=True, kw_only=True, slots=True)
class ShaftPlace:
    """How far errors inside joints move a shaft, at the worst place of a turn."""

    shaft: int  # its number
    known: Ways  # by the known errors, exactly
    reach: Ways  # ± what the tolerances add to it, by the method
    worst: Ways  # ± the same in the worst case
    shares: tuple[PlaceShare, ...]  # every tolerance that moves it, the largest first

    @property
    def largest(self) -> Ways:
        """Known errors and tolerances together."""
        return tuple(one + other for one, other in zip(self.known, self.reach, strict=True))  # type: ignore[return-value]


def shaft_places(drive: Drive, band: ToleranceBand | None) -> tuple[ShaftPlace, ...]:
    """Return how far errors and tolerances move the shafts of a drive; those that none moves are left out.

    band: what the tolerances do to the output: tells how they add up.
    """
    names = [(*one, *ways) for one, ways in zip(seats(drive.joints), way_names(drive.joints), strict=True)]
    phi = one_turn() if band is None else band.angle
    errors = np.concatenate(error_arrays([joint.error for joint in drive.joints], drive.joints), axis=-1)
    off = places.of_errors(drive, names, errors)
    count = len(drive.joints)
    known = places.sizes_of(places.moved(drive, phi, off).ways) if off else np.zeros((count, 3))
    limits = np.zeros_like(errors)
    if band is not None:
        limits = np.concatenate(error_arrays(spreads(drive, None), drive.joints), axis=-1)
    parts: list[tuple[PlaceShare, Array]] = []  # without its ways, and these over a turn (n, 3, p, 3, v)
    if places.of_errors(drive, names, limits):
        given = [
            [name for name, limit in zip(row, limit_of, strict=True) if limit]
            for row, limit_of in zip(names, limits, strict=True)
        ]
        for (j, key), one in places.influences(drive, phi, given).items():
            limit = float(limits[j, names[j].index(key)])
            kind = dimension(drive.joints[j], key)
            share = PlaceShare(joint=j + 1, key=key, dimension=kind, tolerance=limit, ways=(0.0, 0.0, 0.0))
            parts.append((share, limit * one.ways[..., None]))
    for pair in pair_errors(drive, phi) if band is not None else ():
        if pair.ways is not None:
            alike = {name: getattr(pair, name) for name in ("joint", "key", "pair", "dimension", "tolerance")}
            parts.append((PlaceShare(**alike, ways=(0.0, 0.0, 0.0)), pair.tolerance * pair.ways))
    every = [part for _share, part in parts]
    worst = _together(drive, every, 1)
    reach = worst
    if band is not None and not isinstance(band.method, WorstCase):
        reach = band.places if band.places is not None else _together(drive, every, 2)
    found = []
    least = NOTHING * np.asarray([*[float(np.sum(geometry(drive).length))] * 2, 1.0])
    for i in (i for i in range(count) if not places.stays(drive, i + 1)):
        if np.any(known[i] > least) or np.any(worst[i] > least):
            rows = [replace(share, ways=_told(_largest(part[i]), least)) for share, part in parts]
            rows = sorted((one for one in rows if any(one.ways)), key=lambda one: (-one.ways[0], -one.ways[2]))
            own = [_told(ways[i], least) for ways in (known, reach, worst)]
            found.append(ShaftPlace(shaft=i + 2, known=own[0], reach=own[1], worst=own[2], shares=tuple(rows)))
    return tuple(found)


def _told(ways: Array, least: Array) -> Ways:
    """Return ways and lean, what is nothing but rounding as none."""
    start, far, lean = (float(one) for one in np.where(ways > least, ways, 0.0))
    return start, far, lean


def _largest(ways: Array) -> Array:
    """Return the largest of ways and lean (3, p, 3, v) by one error over the turn, in its worst direction, (3,)."""
    return np.asarray(np.max(np.linalg.norm(ways, ord=2, axis=(-2, -1)), axis=-1))


def _together(drive: Drive, parts: list[Array], power: int) -> Array:
    """Return the largest that ways (n, 3, p, 3, v) reach together, looked at from every side, array (n, 3).

    v: directions of an error that is a vector, as long at most as its tolerance; one of a number.
    """
    if not parts:
        return np.zeros((len(drive.joints), 3))
    rows = []
    side = np.arange(DIRECTIONS) * (np.pi / DIRECTIONS)
    for i, axis in enumerate(geometry(drive).axis[1:]):
        aside = frames.perpendicular(axis)
        ways = np.cos(side)[:, None] * aside + np.sin(side)[:, None] * frames.cross(axis, aside)
        seen = [frames.norm(np.einsum("sx,wpxv->wspv", ways, part[i])) for part in parts]
        rows.append([float(np.max(stacked(np.stack([one[w] for one in seen], axis=-1), power))) for w in range(3)])
    return np.asarray(rows)


def largest_way(found: tuple[ShaftPlace, ...]) -> float:
    """Return the largest way of a shaft across itself [m]."""
    return max((way for one in found for way in one.reach[:2]), default=0.0)


def alone(drive: Drive, share: PlaceShare) -> dict[int, Ways]:
    """Return by how much one error of the size of a tolerance moves each shaft, exactly."""
    off = [dict.fromkeys(keys, np.asarray(0.0)) if keys else {} for keys in places.placing(drive)]
    off[share.joint - 1][share.key] = np.asarray(share.tolerance)
    found = places.sizes_of(places.moved(drive, one_turn(), off).ways)
    return {i + 2: _told(one, np.zeros(3)) for i, one in enumerate(found)}


def still_joints(drive: Drive) -> Iterator[tuple[int, str]]:
    """Yield joints, from 1, with errors or tolerances inside that move no shaft, and why."""
    for number, joint in enumerate(drive.joints, start=1):
        if joint.tolerated and (why := places.unmoved(drive, number)):
            yield number, why
    names = [(*one, *ways) for one, ways in zip(seats(drive.joints), way_names(drive.joints), strict=True)]
    for number, joint in enumerate(drive.joints, start=1):
        for table in (joint.error, joint.tolerance):
            own = {key for key in names[number - 1] if key and key not in ("phase", "alpha4")}
            inner = own & set(joint.place_sizes if joint.single_cross else own)
            if table is not None and any(getattr(table, key, 0.0) for key in inner):
                if why := places.unmoved(drive, number):
                    yield number, why
                break
