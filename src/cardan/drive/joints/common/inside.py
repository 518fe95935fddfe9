"""One measure of what else moves inside a joint: wobble, orbits, strokes, play, planes that are missed."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.texts import _


@dataclass(frozen=True, kw_only=True)
class Inside:
    """One measure of what moves inside a joint."""

    key: str  # short name, without unit
    meaning: str  # one sentence
    value: float  # in SI
    dimension: str | None = "angle"  # a key of `cardan.units.DIMENSIONS`; None for a pure number, or 1/m


def missed(tilt: float) -> Inside:
    """Return how far a plane of contact is from the one that halves the joint angle [rad]."""
    return Inside(key="plane_tilt", meaning=_("angle by which the plane of contact misses the middle"), value=tilt)
