"""The cross of a joint: its size and its mass."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from cardan.units import plain, quantity

from .material import Material

Inertias: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True, slots=True)
class Cross:
    """Cross that links the two yokes of a joint."""

    span: float | None = quantity("length", None, doc="distance between the middles of opposite bearings", above=0.0)
    journal: float | None = quantity("length", None, doc="diameter of the journals", above=0.0)
    journal_bore: float = quantity("length", 0.0, doc="diameter of the grease bore in the journals", low=0.0)
    journal_length: float | None = quantity("length", None, doc="length of a journal", above=0.0)
    bending_arm: float | None = quantity(
        "length",
        None,
        doc="from the middle of a bearing to the root of its journal; half the journal's length when not given",
        above=0.0,
    )
    material: Material | None = plain(None, doc="material")
    mass: float = quantity("mass", 0.0, doc="mass", low=0.0)
    inertia: Inertias = quantity(
        "inertia",
        (0.0, 0.0, 0.0),
        doc="moments of inertia [b, c, n] about the driving journals, the driven journals and the normal of the cross",
        low=0.0,
    )
    slides: bool | str = plain(
        False,
        doc="whether the cross slides freely along its journals: along both arms, along one, or not at all",
        choices=("driving", "driven"),
    )
