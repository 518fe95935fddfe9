"""The body of a shaft: stretches of one cross section each, and the parts it carries."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from cardan.errors import Problem
from cardan.maths.linear.laminate import laminate_moduli
from cardan.texts import _
from cardan.units import mm

from .material import Material
from .profile_tube import ProfileSection, one_section
from .shaft import Shaft

FITS = 1e-3  # stretches may miss the length of their shaft by this share; they are stretched to fit


class Piece(NamedTuple):
    """A stretch of a shaft, in its place."""

    start: float
    """From the beginning of the shaft [m]."""
    length: float
    """[m]"""
    outer: float
    """[m]"""
    inner: float
    """[m]"""
    material: Material
    profile: ProfileSection | None = None
    """Of a tube that is not round; outer and inner diameter are then those of a round one that bows and weighs alike"""
    around: float | None = None
    """Its own outer diameter [m]."""

    @property
    def area(self) -> float:
        """Cross section [m²]."""
        return 0.25 * np.pi * (self.outer**2 - self.inner**2)

    @property
    def second_moment(self) -> float:
        """I [m⁴]."""
        return np.pi * (self.outer**4 - self.inner**4) / 64.0

    @property
    def polar_moment(self) -> float:
        """Of the section about the axis [m⁴]."""
        return 2.0 * self.second_moment if self.profile is None else float(self.profile.polar)

    @property
    def torsion_constant(self) -> float:
        """I_t [m⁴]."""
        return 2.0 * self.second_moment if self.profile is None else float(self.profile.torsion)

    @property
    def inertia(self) -> float:
        """About the axis [kg m²]."""
        return self.material.density * self.polar_moment * self.length

    @property
    def mass(self) -> float:
        """[kg]"""
        return self.material.density * self.area * self.length


def body_problems(shaft: Shaft, known: float | None, path: str) -> Iterator[Problem]:
    """Yield what contradicts itself in a stepped body.

    known [m]: distance of the joints at its ends; None where it is not known, and for an end shaft.
    """
    if shaft.segments and shaft.outer is not None:
        yield Problem(f"{path}.segments", _("outer describes the body already"))
    for k, one in enumerate(shaft.segments):
        if 0.0 < one.outer <= one.inner:
            yield Problem(f"{path}.segments[{k}].inner", _("is not less than the outer diameter"))
    whole, length = sum(one.length for one in shaft.segments), shaft.length if known is None else known
    if shaft.segments and length is not None and abs(whole - length) > FITS * length:
        text = _("their lengths add up to {whole:.6g} mm; the shaft is {length:.6g} mm long")
        yield Problem(f"{path}.segments", text.format(whole=whole / mm, length=length / mm))
    if shaft.wear_factor is not None and not shaft.has_body:
        yield Problem(f"{path}.wear_factor", _("belongs to a body: give its outer diameter or its segments"))


def body_length(shaft: Shaft, known: float | None) -> float | None:
    """Return how long the body of a shaft is [m]: between its joints, else as its stretches or itself say.

    known [m]: distance of the joints at its ends; None for an end shaft.
    """
    if known is not None:
        return known
    return sum(one.length for one in shaft.segments) if shaft.segments else shaft.length


def pieces(shaft: Shaft, length: float | None) -> tuple[Piece, ...]:
    """Return the stretches of a shaft from its beginning on, none where its body or its length is not known.

    length [m]: length of its body; stretches are drawn to fit it.
    """
    if length is None:
        return ()
    if shaft.outer is not None:
        if shaft.profile is not None and shaft.wall is not None:
            tube = one_section(shaft.outer, shaft.profile.inscribed, shaft.wall, shaft.profile.count)
            outer, inner = (float(one) for one in tube.round)
            return (Piece(0.0, length, outer, inner, body_material(shaft), tube, shaft.outer),)
        return (Piece(0.0, length, shaft.outer, inner_diameter(shaft), body_material(shaft)),)
    found: list[Piece] = []
    fit = length / sum(one.length for one in shaft.segments) if shaft.segments else 1.0
    for one in shaft.segments:
        start = found[-1].start + found[-1].length if found else 0.0
        found.append(Piece(start, fit * one.length, one.outer, one.inner, one.material or Material()))
    return tuple(found)


def body_material(shaft: Shaft) -> Material:
    """Return what a uniform body is made of; of a tube of fibre composite its moduli along the axis and in shear."""
    layup = shaft.layup
    if layup is None:
        return shaft.material or Material()
    thickness = [layup.ply_thickness] * len(layup.angles)
    along, _around, shear = laminate_moduli(layup.angles, thickness, layup.ply.stiffness)
    return Material(density=layup.ply.density, youngs=float(along), shear=float(shear))


def inner_diameter(shaft: Shaft) -> float:
    """Return the inner diameter of a uniform body [m]."""
    if shaft.outer is None or shaft.inner is not None:
        return shaft.inner or 0.0
    if shaft.layup is not None:
        return max(shaft.outer - 2.0 * shaft.layup.ply_thickness * len(shaft.layup.angles), 0.0)
    return shaft.outer - 2.0 * (shaft.wall or 0.5 * shaft.outer)


class Weight(NamedTuple):
    """What a shaft weighs; None where it is neither given nor follows from its body."""

    mass: float | None
    """[kg]"""
    inertia: float | None
    """About its axis [kg m²]."""
    across: float | None
    """About an axis across through its centre of mass [kg m²]."""
    centre: float | None
    """Place of the centre of mass from joint 1 on shaft 1, else from the joint before [m]."""


def weight(shaft: Shaft, length: float | None) -> Weight:
    """Return mass and inertia of a shaft: what is given, else those of its body; the parts it carries come on top.

    length [m].
    """
    mass, inertia, across, centre = _bare(shaft, length)
    if not shaft.masses:
        return Weight(mass, inertia, across, centre)
    parts = [(mass or 0.0, centre or 0.0, across or 0.0)]
    parts += [(one.mass, one.position, one.diametral_inertia) for one in shaft.masses]
    whole = sum(m for m, _place, _own in parts)
    middle = sum(m * place for m, place, _own in parts) / whole if whole else centre
    spread = sum(own + m * (place - (middle or 0.0)) ** 2 for m, place, own in parts)
    turning = (inertia or 0.0) + sum(one.polar_inertia for one in shaft.masses)
    return Weight(whole, turning, spread, None if mass and centre is None else middle)


def _bare(shaft: Shaft, length: float | None) -> Weight:
    """Return what a shaft weighs without the parts it carries."""
    mass = inertia = across = centre = None
    # On shaft 1 positions count from its end.
    origin = length if shaft.number == 1 and length is not None else 0.0
    body = pieces(shaft, length)
    if body:
        mass = sum(one.mass for one in body)
        middle = sum(one.mass * (one.start + 0.5 * one.length) for one in body) / mass
        square = [one.outer**2 + one.inner**2 for one in body]
        inertia = sum(one.inertia for one in body)
        across = sum(
            one.mass * (size / 16.0 + one.length**2 / 12.0 + (one.start + 0.5 * one.length - middle) ** 2)
            for one, size in zip(body, square, strict=True)
        )
        centre = middle - origin
    given = shaft.mass, shaft.inertia, shaft.transverse_inertia, shaft.centre_of_mass
    derived = mass, inertia, across, centre
    mass, inertia, across, centre = (two if one is None else one for one, two in zip(given, derived, strict=True))
    if mass and centre is None and length is not None:
        centre = 0.5 * length - origin
    return Weight(mass, inertia, across, centre)


class Compliance(NamedTuple):
    """How the stretches of a shaft give way, in order."""

    start: tuple[float, ...]
    """Where each begins, from the beginning of the shaft [m]; the first reaches beyond it."""
    bending: tuple[float, ...]
    """1/EI [1/(N m²)]; zero where the body is not given."""
    stretching: tuple[float, ...]
    """1/EA [1/N]; zero where the body is not given."""


def softness(shaft: Shaft, length: float | None) -> Compliance:
    """Return how a shaft gives way along its length.

    length [m]: length of its body; one without stretches needs none.
    """
    body = pieces(shaft, 1.0 if length is None and shaft.outer is not None else length)
    if not body:
        return Compliance((-np.inf,), (0.0,), (0.0,))
    youngs = [one.material.youngs for one in body]
    return Compliance(
        (-np.inf, *(one.start for one in body[1:])),
        tuple(1.0 / (e * one.second_moment) for e, one in zip(youngs, body, strict=True)),
        tuple(1.0 / (e * one.area) for e, one in zip(youngs, body, strict=True)),
    )
