"""What was measured on the parts of a joint."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import quantity


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
