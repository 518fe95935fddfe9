"""Which numbers a key may hold, and what to say of others."""

from __future__ import annotations

import math

from cardan.texts import _
from cardan.units import Key, factor, label, preferred

HUGE = 1e12
"""Numbers beyond this, in SI, are slips of the pen; their squares would leave the range of floating point numbers."""


def shown(value: float, key: Key, unit: str = "") -> str:
    """Return a value in SI as the user would write it, in the preferred unit or a given one."""
    if key.dimension is None:
        return f"{value:.6g}"
    unit = unit or preferred(key.dimension)
    text = label(unit)
    return f"{value / factor(key.dimension, unit):.6g}{'' if text == '°' else ' '}{text}"


def allowed(key: Key, unit: str = "", *, mirrored: bool = False) -> str:
    """Return the allowed range of a key in words. unit: unit of the words; the preferred one when empty."""
    low, above, high, below = key.low, key.above, key.high, key.below
    if mirrored:
        low, above, high, below = (0.0 - bound for bound in (high, below, low, above))
    parts = []
    if low > -math.inf:
        parts.append(_("at least {value}").format(value=shown(low, key, unit)))
    if above > -math.inf:
        parts.append(_("more than {value}").format(value=shown(above, key, unit)))
    if high < math.inf:
        parts.append(_("at most {value}").format(value=shown(high, key, unit)))
    if below < math.inf:
        parts.append(_("less than {value}").format(value=shown(below, key, unit)))
    return _(" and ").join(parts) or _("a finite number")


def in_range(key: Key, value: float) -> bool:
    """Tell whether a value in SI is allowed for a key, and no slip of the pen."""
    return key.allows(value) and abs(value) <= HUGE


def out_of_range(given: str, key: Key, value: float, unit: str = "", *, mirrored: bool = False) -> str:
    """Return what to say of a number that is not `in_range`, as it was given and as a value in SI."""
    if key.allows(value):
        return _("{value} is not allowed; no drive has such a number").format(value=given)
    return _("{value} is not allowed; allowed is {allowed}").format(
        value=given, allowed=allowed(key, unit, mirrored=mirrored)
    )


def range_code(key: Key, value: float) -> str:
    """Return the word of `cardan.errors.CODES` for a number in SI that is not `in_range`."""
    if not math.isfinite(value):
        return "not_finite"
    if key.above == 0.0 and value <= 0.0:
        return "not_positive"
    if key.low == 0.0 and value < 0.0 and key.high == key.below == math.inf:
        return "negative"
    return "out_of_range"
