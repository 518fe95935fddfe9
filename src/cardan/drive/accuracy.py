"""How far a joint departs from the ideal one: errors as made, tolerances as drawn, what was measured on its parts."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Error:
    """Manufacturing errors of a joint; the ideal joint has none.

    The joint is taken as a closed loop of four axes: 1 the driving shaft, 2 the driving journals, 3 the driven
    journals, 4 the driven shaft. The link j leads from axis j to the next one, the link 4 back to axis 1.
    """

    s1: float = quantity("length", 0.0, doc="offset of the driving journals along the driving shaft")
    a1: float = quantity("length", 0.0, doc="distance of the driving journals from the driving shaft")
    a2: float = quantity("length", 0.0, doc="distance of the driven from the driving journals")
    a3: float = quantity("length", 0.0, doc="distance of the driven shaft from the driven journals")
    a4: float = quantity("length", 0.0, doc="distance of the driving shaft from the driven shaft")
    alpha1: float = quantity("angle", 0.0, doc="error of the right angle between driving shaft and driving journals")
    alpha2: float = quantity("angle", 0.0, doc="error of the right angle of the cross")
    alpha3: float = quantity("angle", 0.0, doc="error of the right angle between driven journals and driven shaft")
    alpha4: float = quantity("angle", 0.0, doc="error of the joint angle")
    phase: float = quantity("angle", 0.0, doc="error of the angle of the driving yoke about its shaft")


@dataclass(frozen=True, kw_only=True, slots=True)
class Cost:
    """Relative cost of each tolerance of a joint: a tolerance t costs its weight over t."""

    s1: float = plain(1.0, doc="of the tolerance s1", above=0.0)
    a1: float = plain(1.0, doc="of the tolerance a1", above=0.0)
    a2: float = plain(1.0, doc="of the tolerance a2", above=0.0)
    a3: float = plain(1.0, doc="of the tolerance a3", above=0.0)
    a4: float = plain(1.0, doc="of the tolerance a4", above=0.0)
    alpha1: float = plain(1.0, doc="of the tolerance alpha1", above=0.0)
    alpha2: float = plain(1.0, doc="of the tolerance alpha2", above=0.0)
    alpha3: float = plain(1.0, doc="of the tolerance alpha3", above=0.0)
    alpha4: float = plain(1.0, doc="of the tolerance alpha4", above=0.0)
    phase: float = plain(1.0, doc="of the tolerance phase", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Tolerance:
    """Tolerances of a joint, each to both sides of the ideal: ±; names as those of its errors."""

    s1: float = quantity("length", 0.0, doc="± offset of the driving journals along the driving shaft", low=0.0)
    a1: float = quantity("length", 0.0, doc="± distance of the driving journals from the driving shaft", low=0.0)
    a2: float = quantity("length", 0.0, doc="± distance of the driven from the driving journals", low=0.0)
    a3: float = quantity("length", 0.0, doc="± distance of the driven shaft from the driven journals", low=0.0)
    a4: float = quantity("length", 0.0, doc="± distance of the driving shaft from the driven shaft", low=0.0)
    alpha1: float = quantity("angle", 0.0, doc="± right angle between driving shaft and driving journals", low=0.0)
    alpha2: float = quantity("angle", 0.0, doc="± right angle of the cross", low=0.0)
    alpha3: float = quantity("angle", 0.0, doc="± right angle between driven journals and driven shaft", low=0.0)
    alpha4: float = quantity("angle", 0.0, doc="± joint angle", low=0.0)
    phase: float = quantity("angle", 0.0, doc="± angle of the driving yoke about its shaft", low=0.0)
    distribution: str = plain(
        "normal",
        doc="how the errors are spread over the tolerance; normal has its 3 sigma there",
        choices=("normal", "uniform", "triangular"),
    )
    cost: Cost | None = plain(None, doc="relative cost of each tolerance, for allocation")


@dataclass(frozen=True, kw_only=True, slots=True)
class Inspection:
    """Deviations of the yokes and the cross of a joint, as measured; GOST 2752-74 limits them."""

    axis_offset: float | None = quantity(
        "length", None, doc="yoke: distance between the axis of its bearings and that of its hub", low=0.0
    )
    yoke_perpendicularity: float | None = quantity(
        "length", None, doc="yoke: bearing axis to hub axis, out of square on 100 mm", low=0.0
    )
    face_symmetry: float | None = quantity("length", None, doc="yoke: its end faces about the hub axis", low=0.0)
    half_height_difference: float | None = quantity(
        "length", None, doc="cross: difference of the halves of its height", low=0.0
    )
    cross_perpendicularity: float | None = quantity(
        "length", None, doc="cross: one axis to the other, out of square on 100 mm", low=0.0
    )
    coplanarity: float | None = quantity("length", None, doc="cross: its journals out of one plane", low=0.0)
    coaxiality: float | None = quantity("length", None, doc="cross: opposite journals out of one axis", low=0.0)
