"""What a link of a mechanism weighs, and what acts on it from outside."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import plain, quantity

ROUNDING = 1e-9
"""Share of the largest moment of inertia by which those of a body may miss each other."""

Vector = tuple[float, float, float]
NONE: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class LinkMass:
    """Mass and inertia of a link, where and as it is drawn."""

    link: str = plain(doc="the moving link")
    mass: float = quantity("mass", 0.0, doc="its mass", low=0.0)
    mass_centre: Vector = quantity("length", NONE, doc="its centre of mass [x, y, z]")
    inertia: Vector = quantity("inertia", NONE, doc="its moments of inertia about its centre of mass [Ixx, Iyy, Izz]")
    inertia_products: Vector = quantity(
        "inertia", NONE, doc="products of inertia, elements of its tensor: the negative integrals [Ixy, Ixz, Iyz]"
    )

    @property
    def tensor(self) -> Array:
        """Inertia about the centre of mass, array (3, 3) [kg·m²]."""
        (a, b, c), (ab, ac, bc) = self.inertia, self.inertia_products
        return np.asarray([[a, ab, ac], [ab, b, bc], [ac, bc, c]])

    def problems(self) -> Iterator[Problem]:
        """Yield why no body has such a mass and inertia, fields named from here on."""
        if not all(map(math.isfinite, self.mass_centre)):
            yield Problem("mass_centre", _("{value} is not finite").format(value=list(self.mass_centre)), "not_finite")
        if not np.all(np.isfinite(self.tensor)):
            yield Problem("inertia", _("{value} is not finite").format(value=list(self.inertia)), "not_finite")
            return
        least, middle, most = np.linalg.eigvalsh(self.tensor)
        if least < -ROUNDING * most or most > (least + middle) * (1.0 + ROUNDING):
            text = _("no body has these moments: none is below zero, and none above the sum of the others")
            yield Problem("inertia", text, "inconsistent")


@dataclass(frozen=True, kw_only=True, slots=True)
class Load:
    """Force and torque that act on a link from outside."""

    link: str = plain(doc="the moving link")
    force: Vector = quantity("force", NONE, doc="force on it [x, y, z]")
    point: Vector | None = quantity("length", None, doc="point of the link at which the force acts, as drawn [x, y, z]")
    torque: Vector = quantity("torque", NONE, doc="torque on it [x, y, z]")
    turns_with_link: bool = plain(False, doc="whether force and torque turn with the link; else they keep direction")

    def problems(self) -> Iterator[Problem]:
        """Yield what is wrong with it by itself, fields named from here on."""
        for name in ("force", "point", "torque"):
            value = getattr(self, name)
            if value is not None and not all(map(math.isfinite, value)):
                yield Problem(name, _("{value} is not finite").format(value=list(value)), "not_finite")
        if any(self.force) and self.point is None:
            yield Problem("point", _("missing: a force acts at a point"), "missing")
        if not any(self.force) and not any(self.torque):
            yield Problem("force", _("missing: neither force nor torque is given"), "missing")
