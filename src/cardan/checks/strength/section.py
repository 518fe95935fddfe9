"""The cross sections of the shafts of a design: sizes, material, and the paths that change them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.checks.design import Design
from cardan.drive.body import body_material
from cardan.drive.material import Material
from cardan.drive.profile_tube import ProfileSection, profile_section, stressed_bore
from cardan.formulas.shaft_strength import polar_moment
from cardan.maths.arrays import Array
from cardan.texts import _

STEEL = Material()


@dataclass(frozen=True, eq=False, kw_only=True)
class Section:
    """Cross section of a stretch of a shaft."""

    path: str  # of the stretch: that of the shaft, or of one of its segments
    outer: Array | float  # (...) [m]
    inner: Array | float  # (...) [m]
    length: Array | float | None  # (...) [m]: of the stretch; None where the drive does not say it
    design_variables: tuple[str, ...]  # paths that change its sizes
    number: int = 0  # of the stretch, from 1; 0 where the shaft is one
    # of a tube with a profile: its section, and the round tube that bears as much; outer and inner are then of a
    # round one that bows and weighs alike
    profile: ProfileSection | None = None
    bearing: tuple[Array, Array] | None = None

    @property
    def words(self) -> str:
        """What to add to the name of its shaft; nothing where the shaft is one stretch."""
        return _(", stretch {number}").format(number=self.number) if self.number else ""

    @property
    def polar(self) -> Array:
        """Polar moment of the section, array (...) [m⁴]."""
        return polar_moment(self.outer, self.inner) if self.profile is None else self.profile.polar

    @property
    def torsion(self) -> Array:
        """Constant of torsion, array (...) [m⁴]."""
        return polar_moment(self.outer, self.inner) if self.profile is None else self.profile.torsion

    @property
    def stressed(self) -> tuple[Array | float, Array | float]:
        """Outer and inner diameter of the round tube whose stresses are those of the section, arrays (...) [m]."""
        return (self.outer, self.inner) if self.bearing is None else self.bearing

    def of_material(self, name: str) -> str:
        """Return the path of a figure of its material."""
        return f"{self.path}.material.{name}"


def sections(design: Design, k: int) -> Iterator[Section]:
    """Yield the cross sections of a shaft, counted from 0; none where the drive does not say its body."""
    shaft, path = design.drive.shafts[k], f"shafts[{k}]"
    whole = design.length(k)
    for s, _segment in enumerate(shaft.segments):
        one = f"{path}.segments[{s}]"
        outer, inner, length = (design.value(f"{one}.{name}") for name in ("outer", "inner", "length"))
        design_variables = design.design_variables(f"{one}.outer")
        yield Section(
            path=one, outer=outer, inner=inner, length=length, design_variables=design_variables, number=s + 1
        )
    outer = design.value(f"{path}.outer")
    if outer is None:
        return
    inner, wall = design.value(f"{path}.inner"), design.value(f"{path}.wall")
    if shaft.profile is not None:
        inscribed = design.value(f"{path}.profile.inscribed")
        tube = profile_section(outer, inscribed, wall, shaft.profile.count)
        alike = tube.round
        yield Section(
            path=path,
            outer=alike[0],
            inner=alike[1],
            length=whole,
            design_variables=design.design_variables(f"{path}.outer", f"{path}.wall", f"{path}.profile.inscribed"),
            profile=tube,
            bearing=(np.asarray(outer, dtype=float) + 0.0 * tube.modulus, stressed_bore(outer, tube.modulus)),
        )
        return
    if shaft.layup is not None:
        thin = design.value(f"{path}.layup.ply_thickness")
        inside = outer - 2.0 * len(shaft.layup.angles) * thin
        design_variables = design.design_variables(f"{path}.outer", f"{path}.layup.ply_thickness")
    else:
        inside = inner if inner is not None else 0.0 if wall is None else outer - 2.0 * wall
        design_variables = design.design_variables(f"{path}.outer", f"{path}.wall")
    yield Section(path=path, outer=outer, inner=inside, length=whole, design_variables=design_variables)


def modulus(design: Design, section: Section, name: str) -> float | Array:
    """Return "youngs", "shear_modulus" or "density" of a stretch; those of steel where none is given."""
    if not section.number and design.value(f"{section.path}.layup") is not None:
        tube = body_material(design.value(section.path))
        return float(getattr(tube, name))
    path = f"{section.path}.material"
    if name != "shear_modulus":
        given = design.value(f"{path}.{name}")
        return getattr(STEEL, name) if given is None else given
    material = design.value(path) or STEEL
    shear = design.value(f"{path}.shear")
    return material.shear_modulus if shear is None else shear
