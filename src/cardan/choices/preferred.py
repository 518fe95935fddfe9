"""Sizes that are made: preferred numbers, and steps of a drawing."""

from __future__ import annotations

import math

from cardan.errors import refuse
from cardan.texts import _

R20 = (1.0, 1.12, 1.25, 1.4, 1.6, 1.8, 2.0, 2.24, 2.5, 2.8, 3.15, 3.55, 4.0, 4.5, 5.0, 5.6, 6.3, 7.1, 8.0, 9.0)
"""Preferred numbers of ISO 3, series R20."""

SERIES = ("step", "R20", "R10", "R40")
"""What sizes can be rounded up to: steps of a drawing, or preferred numbers."""

SLACK = 1e-9
"""A size may be above a preferred one by this share: what is left of rounding."""

R40 = tuple(
    sorted(
        {
            *R20,
            1.06,
            1.18,
            1.32,
            1.5,
            1.7,
            1.9,
            2.12,
            2.36,
            2.65,
            3.0,
            3.35,
            3.75,
            4.25,
            4.75,
            5.3,
            6.0,
            6.7,
            7.5,
            8.5,
            9.5,
        }
    )
)

ROWS = {"R10": R20[::2], "R20": R20, "R40": R40}


def round_up(value: float, *, step: float, series: str = "step") -> float:
    """Return the smallest size that is made and no smaller than a value.

    value: above zero; step: step of the drawing, in the unit of the value; series: one of `SERIES`.
    """
    if series not in SERIES:
        names = ", ".join(SERIES)
        raise refuse("series", _("{value} is none of {choices}").format(value=repr(series), choices=names))
    if series == "step":
        digits = max(0, 3 - math.floor(math.log10(step)))
        return round(step * math.ceil(value / step * (1.0 - SLACK)), digits)
    decade = 10.0 ** math.floor(math.log10(value))
    row = (*ROWS[series], 10.0)
    return float(f"{decade * next(one for one in row if one * decade * (1.0 + SLACK) >= value):.6g}")
