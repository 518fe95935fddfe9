"""What a shaft of a design weighs against turning faster."""

from __future__ import annotations

import numpy as np

from cardan.checks.design import Design
from cardan.checks.strength.section import modulus, sections
from cardan.maths.arrays import Array


def shaft_inertia(design: Design, k: int) -> Array | None:
    """Return J of a shaft, counted from 0, with the parts it carries (...) [kg m²]; None where the drive says neither.

    Of a body ρ π/32 (D⁴ - d⁴) l.
    """
    parts = sum(lump.polar_inertia for lump in design.drive.shafts[k].masses)
    given = design.value(f"shafts[{k}].inertia")
    body = list(sections(design, k))
    if given is None and body and all(one.length is not None for one in body):
        given = sum(np.asarray(modulus(design, one, "density")) * one.polar * one.length for one in body)
    if given is None and not parts:
        return None
    found: Array = np.asarray(0.0 if given is None else given, dtype=float) + parts
    return found
