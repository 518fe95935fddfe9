"""How far do errors and tolerances inside the joints move the shafts behind them?"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames

from . import places
from .accuracy import error_arrays, one_turn, way_names
from .own_laws import dimension, seats
from .tolerance import DIRECTIONS, ToleranceBand, WorstCase, spreads, stacked

NOTHING = 1e-12
"""Share of the length of a drive, and lean [rad], below which no shaft is moved."""

Ways = tuple[float, float, float]
"""Way of a shaft across itself at its joint and at its far end [m], and how far it leans [rad]."""


@dataclass(frozen=True, kw_only=True, slots=True)
class PlaceShare:
    """By how much one tolerance alone moves a shaft, at the worst place of a turn."""

    joint: int  # number of its joint, from 1
    key: str
    dimension: str  # of the error, "" of a pure number
    tolerance: float  # ± in SI
    ways: Ways

    @property
    def field(self) -> str:
        """Path of the tolerance in the drive, ``joints[0].tolerance.offset``."""
        return f"joints[{self.joint - 1}].tolerance.{self.key}"


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
    parts = {}
    if places.of_errors(drive, names, limits):
        given = [
            [name for name, limit in zip(row, limit_of, strict=True) if limit]
            for row, limit_of in zip(names, limits, strict=True)
        ]
        for (j, key), one in places.influences(drive, phi, given).items():
            parts[j, key] = limits[j, names[j].index(key)] * one.ways
    worst = _together(drive, list(parts.values()), 1)
    reach = worst
    if band is not None and not isinstance(band.method, WorstCase):
        reach = band.places if band.places is not None else _together(drive, list(parts.values()), 2)
    found = []
    least = NOTHING * np.asarray([*[float(np.sum(geometry(drive).length))] * 2, 1.0])
    for i in (i for i in range(count) if not places.stays(drive, i + 1)):
        if np.any(known[i] > least) or np.any(worst[i] > least):
            rows = [
                PlaceShare(
                    joint=j + 1,
                    key=key,
                    dimension=dimension(drive.joints[j], key),
                    tolerance=float(limits[j, names[j].index(key)]),
                    ways=_told(places.sizes_of(part)[i], least),
                )
                for (j, key), part in parts.items()
            ]
            rows = sorted((one for one in rows if any(one.ways)), key=lambda one: (-one.ways[0], -one.ways[2]))
            own = [_told(ways[i], least) for ways in (known, reach, worst)]
            found.append(ShaftPlace(shaft=i + 2, known=own[0], reach=own[1], worst=own[2], shares=tuple(rows)))
    return tuple(found)


def _told(ways: Array, least: Array) -> Ways:
    """Return ways and lean, what is nothing but rounding as none."""
    start, far, lean = (float(one) for one in np.where(ways > least, ways, 0.0))
    return start, far, lean


def _together(drive: Drive, parts: list[Array], power: int) -> Array:
    """Return the largest that ways (n, 3, p, 3) reach together, looked at from every side, array (n, 3)."""
    if not parts:
        return np.zeros((len(drive.joints), 3))
    rows = []
    side = np.arange(DIRECTIONS) * (np.pi / DIRECTIONS)
    for i, axis in enumerate(geometry(drive).axis[1:]):
        aside = frames.perpendicular(axis)
        ways = np.cos(side)[:, None] * aside + np.sin(side)[:, None] * frames.cross(axis, aside)
        seen = np.stack([part[i] for part in parts], axis=-1)  # (3, p, 3, d)
        rows.append([max(float(np.max(stacked(ways @ at, power))) for at in one) for one in seen])
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
    names = [(*one, *ways) for one, ways in zip(seats(drive.joints), way_names(drive.joints), strict=True)]
    for number, joint in enumerate(drive.joints, start=1):
        for table in (joint.error, joint.tolerance):
            own = {key for key in names[number - 1] if key and key not in ("phase", "alpha4")}
            inner = own & set(joint.place_sizes if joint.single_cross else own)
            if table is not None and any(getattr(table, key, 0.0) for key in inner):
                if why := places.unmoved(drive, number):
                    yield number, why
                break
