"""A shaft: the yokes at its ends, its length, its spline."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Spline:
    """Sliding spline of an intermediate shaft: length compensation, and the steps in which its yokes can be set."""

    teeth: int | None = plain(None, doc="number of teeth; the yoke angle can be set in steps of 360°/teeth", low=1)
    engaged: float | None = quantity("length", None, doc="engaged length in the drawn position", above=0.0)
    gap: float | None = quantity("length", None, doc="way left to bottoming in the drawn position", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Shaft:
    """Shaft number 1 (input) to n+1 (output) of an n-joint drive."""

    number: int = plain(doc="1 is the input shaft, n+1 the output shaft", low=1)
    name: str = plain("", doc="name of the shaft, for tables and pictures")
    length: float | None = quantity("length", None, doc="length between the joint centres at its ends", above=0.0)
    side_slope: float | None = quantity(
        "angle",
        None,
        doc="slope in side view, positive when rising along the power flow",
        above=-1.57,
        below=1.57,
    )
    plan_slope: float | None = quantity(
        "angle",
        None,
        doc="slope in plan view, positive to the left of the power flow",
        above=-1.57,
        below=1.57,
    )
    yoke_angle: float = quantity(
        "angle",
        0.0,
        doc="angle from the driving yoke to the driven yoke of this shaft, about its axis along the power flow",
        mirror="yoke_lead",
    )
    yoke_fixed: bool = plain(False, doc="true excludes this yoke angle from synthesis")
    weight: float = plain(1.0, doc="weight of this shaft's irregularity as a secondary goal of synthesis", low=0.0)
    spline: Spline | None = plain(None, doc="sliding spline of the shaft")
