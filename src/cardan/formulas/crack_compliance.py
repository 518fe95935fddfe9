"""How much softer in bending does a crack make a shaft where it is? By the energy that its growth would release."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

POINTS = 48
"""Gauss points over the width and over the depth of a crack."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrackCompliance:
    """Turn of a shaft at an open crack over the bending moment there [rad/(N·m)], arrays (...)."""

    along: Array  # bending in the crack's direction, about its edge
    across: Array  # bending across it


def crack_compliance(
    radius: ArrayLike, depth_ratio: ArrayLike, youngs: ArrayLike, *, inner: ArrayLike = 0.0, poisson: ArrayLike = 0.3
) -> CrackCompliance:
    """Return the local compliance of an open crack with a straight edge.

    radius (...) [m]: R of the shaft.
    depth_ratio (...): depth over R, from 0 to 1; in a tube below 1.6 and deep enough to go through the wall.
    youngs (...) [Pa]: E; inner (...) [m]: inner radius of a tube, 0 of a solid shaft; poisson (...): ν.
    Castigliano: c = 2(1-ν²)/E ∫∫ (K/M)² dA over the crack. Solid: strips of the height h' = 2√(R²-y²) across the edge,
    K = σ√(πa) F(a/h'), with F of a strip in bending for the moment about the edge and in tension for the other
    (A. D. Dimarogonas, S. A. Paipetis, Analytical Methods in Rotor Dynamics, 1983; H. Tada, The Stress Analysis of
    Cracks Handbook). Tube: through the wall over ±β, cos β = 1 - depth/R_m, K = σ√(πR_mβ) F_b(β, R_m/t), F_b of
    A. Zahoor, J. Pressure Vessel Technology 107 (1985), for 5 ≤ R_m/t ≤ 20 and taken at the nearer end beyond; across
    by the square of the stress there, ∫ sin²/∫ cos² over the crack.
    """
    r, ratio, e, bore, nu = np.broadcast_arrays(
        *(np.asarray(one, dtype=float) for one in (radius, depth_ratio, youngs, inner, poisson))
    )
    problems = []
    if not np.all((r > 0.0) & (e > 0.0) & (bore >= 0.0) & (bore < r)):
        problems.append(
            Problem("radius", _("radius and modulus need to be above 0, the inner radius below"), "not_positive")
        )
    if not np.all((ratio >= 0.0) & (ratio < DEEPEST)):
        problems.append(
            Problem("depth_ratio", _("needs to be at least 0 and below {most}").format(most=DEEPEST), "out_of_range")
        )
    check(problems)
    tube = bore > 0.0
    if np.any(~tube & (ratio > 1.0)):
        text = _("is more than 1: how a solid shaft gives way that is cracked beyond its middle is not known")
        check([Problem("depth_ratio", text, "out_of_range")])
    if np.any(tube & (ratio > 0.0) & (ratio * r < r - bore)):
        text = _("the crack of a tube goes through its wall, at least {least:.3g} of the radius deep")
        raise_at = float(np.max(np.where(tube, 1.0 - bore / r, 0.0)))
        check([Problem("depth_ratio", text.format(least=raise_at), "out_of_range")])
    solid = _solid(r, np.where(tube, 0.0, ratio), e, nu)
    round_tube = _tube(r, np.where(tube, bore, 0.5 * r), np.where(tube, ratio, 0.0), e)
    along, across = (np.where(tube, one, other) for one, other in zip(round_tube, solid, strict=True))
    return CrackCompliance(along=along, across=across)


DEEPEST = 1.6
"""Depth over the radius of a tube beyond which little of it is left; strips of a solid shaft are cut through from 1."""


def _solid(r: Array, ratio: Array, e: Array, nu: Array) -> tuple[Array, Array]:
    """Return both compliances of solid shafts, by Gauss points over the width of the crack and the depth there."""
    point, weight = np.polynomial.legendre.leggauss(POINTS)
    share = np.sqrt(np.maximum(ratio * (2.0 - ratio), 0.0))[..., None, None]
    # y = b sin(πs/2): the square-root ends of the strips become smooth.
    turn = 0.5 * np.pi * point
    y, dy = share * np.sin(turn)[:, None], share * (0.5 * np.pi * np.cos(turn) * weight)[:, None]
    half = np.sqrt(np.maximum(1.0 - y**2, 1e-300))
    deep = np.maximum(half - (1.0 - ratio[..., None, None]), 0.0)
    a, da = deep * 0.5 * (1.0 + point), 0.5 * deep * weight
    s = a / (2.0 * half)
    lam = np.maximum(0.5 * np.pi * s, 1e-12)
    common = np.sqrt(np.tan(lam) / lam) / np.cos(lam)
    bending = common * (0.923 + 0.199 * (1.0 - np.sin(lam)) ** 4)
    tension = common * (0.752 + 2.02 * s + 0.37 * (1.0 - np.sin(lam)) ** 3)
    scale = 2.0 * (1.0 - nu**2) / e * 16.0 / (np.pi * r**3)
    along = np.sum(half**2 * a * bending**2 * da * dy, axis=(-2, -1))
    across = np.sum(y**2 * a * tension**2 * da * dy, axis=(-2, -1))
    return scale * along, scale * across


def _tube(r: Array, bore: Array, ratio: Array, e: Array) -> tuple[Array, Array]:
    """Return both compliances of tubes cracked through the wall."""
    wall, mean = r - bore, 0.5 * (r + bore)
    slender = np.clip(mean / wall, 5.0, 20.0)
    a_t = np.where(slender <= 10.0, 0.125 * slender - 0.25, 0.4 * slender - 3.0) ** 0.25
    beta = np.arccos(np.clip(1.0 - ratio * r / mean, -1.0, 1.0))[..., None]
    point, weight = np.polynomial.legendre.leggauss(POINTS)
    b, db = 0.5 * beta * (1.0 + point), 0.5 * beta * weight
    part = b / np.pi
    shape = 1.0 + a_t[..., None] * (4.5967 * part**1.5 + 2.6422 * part**4.24)
    along = 4.0 / (e * np.pi * mean**2 * wall) * np.sum(b * shape**2 * db, axis=-1)
    width = np.maximum(beta[..., 0], 1e-12)
    aside = (width - np.sin(width) * np.cos(width)) / (width + np.sin(width) * np.cos(width))
    return along, along * aside
