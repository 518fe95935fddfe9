"""The kinematic half of a drive: what motion needs to know, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.maths import mobius
from cardan.maths.arrays import Array, namespace

from .drive import Drive
from .geometry import geometry, given_angles


@dataclass(frozen=True, eq=False, kw_only=True)
class Chain:
    """Bends, plane twists and yoke angles of one drive (n,) or of many (..., n).

    Attributes
    ----------
    bend : array (..., n) [rad]
        α_1 … α_n.
    plane_twist : array (..., n-1) [rad]
        β_2 … β_n.
    yoke_angle : array (..., n-1) [rad]
        γ_2 … γ_n, from the driving to the driven yoke of a shaft.
    start_phase : array (...) [rad]
        ψ_1.
    """

    bend: Array
    plane_twist: Array
    yoke_angle: Array
    start_phase: Array

    @property
    def joints(self) -> int:
        """Number of joints n."""
        return int(self.bend.shape[-1])

    @property
    def turn_before(self) -> Array:
        """Angle μ_i added before joint i: μ_1 = ψ_1, μ_i = π/2 - γ_i - β_i; array (..., n) [rad]."""
        xp = namespace(self.bend)
        first = xp.broadcast_to(self.start_phase, self.bend.shape[:-1])[..., None]
        between = 0.5 * xp.pi - self.yoke_angle - self.plane_twist
        return xp.concat((first, xp.broadcast_to(between, (*self.bend.shape[:-1], self.joints - 1))), axis=-1)

    def products(self) -> list[mobius.Pair]:
        """Return the Möbius pairs of the first 1 … n joints, each from the input shaft on."""
        return mobius.partial_products(self.bend, self.turn_before)


def chain(drive: Drive) -> Chain:
    """Return the kinematic half of a drive.

    Examples
    --------
    >>> from cardan.units import deg
    >>> chain(Drive.from_angles([20 * deg, 20 * deg])).turn_before
    array([0.        , 1.57079633])
    """
    if drive.form == "angles":
        bend, twist = given_angles(drive)
        twist = twist[1:]
    else:
        place = geometry(drive)
        bend, twist = place.bend, place.plane_twist
    return Chain(
        bend=bend,
        plane_twist=twist,
        yoke_angle=np.asarray([shaft.yoke_angle for shaft in drive.shafts[1:-1]], dtype=float),
        start_phase=np.asarray(drive.input.start_phase, dtype=float),
    )
