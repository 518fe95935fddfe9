"""What a shaft is made of."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Material:
    """Material of a shaft; steel where nothing else is said."""

    density: float = quantity("density", 7850.0, doc="density", above=0.0)
    youngs: float = quantity("stress", 2.06e11, doc="Young's modulus", above=0.0)
