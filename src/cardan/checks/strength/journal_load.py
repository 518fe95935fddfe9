"""The load that a cross puts on its journals, and through them on needles and yokes."""

from __future__ import annotations

from cardan.checks.design import Design
from cardan.maths.arrays import Array


def journal_load(design: Design, i: int) -> tuple[Array, str]:
    """Return the largest load of the journals of a joint, shocks counted (...) [N], and what decides it in a sentence.

    design: under torque, and with the span of this joint's cross; i: joint, counted from 0.
    """
    couple, note = design.most(lambda case: case.couple[..., i])
    return couple * design.shock / design.value(f"joints[{i}].cross.span"), note
