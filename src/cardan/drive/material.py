"""What a part is made of."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Material:
    """Material of a part; steel where nothing else is said, without strength until it is given."""

    grade: str = plain("", doc="name of the grade in the catalogue, or the user's own")
    density: float = quantity("density", 7850.0, doc="density", above=0.0)
    youngs: float = quantity("stress", 2.06e11, doc="Young's modulus", above=0.0)
    shear: float | None = quantity(
        "stress", None, doc="shear modulus; from Young's modulus and Poisson's ratio when not given", above=0.0
    )
    poisson: float = plain(0.3, doc="Poisson's ratio", low=0.0, below=0.5)
    yield_strength: float | None = quantity("stress", None, doc="yield strength or 0.2 % proof stress", above=0.0)
    ultimate_strength: float | None = quantity("stress", None, doc="tensile strength", above=0.0)
    hardness: float | None = plain(None, doc="Brinell hardness", above=0.0)

    @property
    def shear_modulus(self) -> float:
        """G [Pa]: as given, else E/(2(1+ν))."""
        return 0.5 * self.youngs / (1.0 + self.poisson) if self.shear is None else self.shear
