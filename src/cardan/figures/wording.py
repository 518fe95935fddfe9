"""Numbers as people read them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cardan.answers.numbers import raised, significant


def percent(share: float, digits: int = 3) -> str:
    """Return a share in percent; what is nothing but rounding is 0."""
    if abs(share) < 1e-13:
        return "0 %"
    return f"{significant(100.0 * share, digits)} %"


def powers_of_ten(values: Sequence[float]) -> tuple[str, ...]:
    """Return powers of ten, in full where all of them are short.

    >>> powers_of_ten((0.01, 1.0)), powers_of_ten((1e-6, 1.0))
    (('0.01', '1'), ('10⁻⁶', '10⁰'))
    """
    powers = [round(math.log10(value)) for value in values]
    if all(-3 < power < 4 for power in powers):
        return tuple(f"{value:g}" for value in values)
    return tuple(f"10{raised(power)}" for power in powers)
