"""Tube of fibre composite: its moduli, mass and the torque at which it buckles."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.drive.shaft import Layup
from cardan.maths.linear.laminate import PlyStiffness, laminate_moduli


@dataclass(frozen=True, kw_only=True)
class CompositeTube:
    """Figures of a thin tube of composite."""

    along: float  # along, around, shear [Pa]: E_x along the axis, E_y around it, G_xy
    around: float  # [Pa]
    shear: float  # [Pa]
    thickness: float  # [m]: of the wall
    mass_per_length: float  # [kg/m]
    buckling_torque: float  # [N·m]: torque at which the wall buckles


def composite_tube(layup: Layup, mean_diameter: float) -> CompositeTube:
    """Return the figures of a tube of composite.

    Parameters
    ----------
    layup : Layup
    mean_diameter : float [m]
        Of the middle of the wall.

    Notes
    -----
    T_b = 2π r² t·0.272 (E_x E_y³)^(1/4) (t/r)^(3/2); 0.272 is a figure of the literature, the classical one of an
    isotropic tube is 0.253. Only stiffness: no ply strength is checked.

    Examples
    --------
    >>> from cardan.drive.shaft import Ply
    >>> ply = Ply(along=135e9, across=10e9, shear=5e9, poisson=0.3)
    >>> layup = Layup(angles=(0.0, math.pi / 4, -math.pi / 4, math.pi / 2), ply_thickness=0.0005, ply=ply)
    >>> round(composite_tube(layup, 0.09).buckling_torque, 1)
    3398.4
    """
    plies = len(layup.angles)
    thickness = plies * layup.ply_thickness
    stiff = PlyStiffness(layup.ply.along, layup.ply.across, layup.ply.shear, layup.ply.poisson)
    along, around, shear = laminate_moduli(layup.angles, [layup.ply_thickness] * plies, stiff)
    radius = 0.5 * mean_diameter
    buckling = 2.0 * math.pi * radius**2 * thickness * 0.272 * (along * around**3) ** 0.25 * (thickness / radius) ** 1.5
    return CompositeTube(
        along=float(along),
        around=float(around),
        shear=float(shear),
        thickness=thickness,
        mass_per_length=2.0 * math.pi * radius * thickness * layup.ply.density,
        buckling_torque=float(buckling),
    )
