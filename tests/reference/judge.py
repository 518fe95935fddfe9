"""Judges a computed case: numbers within the case's tolerance, angles on the circle they live on, errors by field.

Written for these tests. A value passes when |computed - expected| <= atol + rtol |expected|.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any


def faults(case: dict[str, Any], result: dict[str, Any] | None) -> list[str]:
    """Return everything that is wrong with a result; nothing when the case passes."""
    if result is None:
        return ["no result"]
    expected = case["expected"]
    if "error_field" in expected:
        if "error" not in result:
            return [f"accepted, though {expected['error_field']} is bad"]
        named, wanted = result["error"]["field"], expected["error_field"]
        return [] if named == wanted else [f"names {named!r} instead of {wanted!r}"]
    if "error" in result:
        return [f"refused: {result['error']['message']}"]
    computed = result["computed"]
    return [
        fault
        for key, value in expected.items()
        if key not in NOTES
        for fault in (
            _minimisers(computed, value)
            if key == "gamma_deg_minimisers"
            else _first(computed, value)
            if key == "first_causes_include"
            else _compare(key, value, computed.get(key, MISSING), case["rtol"], case["atol"])
        )
    ]


MISSING = object()
NOTES = {"reason"}


def period(key: str) -> float:
    """Return after how many degrees an angle under this key repeats; infinite where it does not."""
    if key.endswith("_mod180_deg"):
        return 180.0
    unwrapped = re.match(r"phi|alpha|lead", key)
    return 360.0 if key.endswith("_deg") and not unwrapped else math.inf


def _compare(key: str, expected: Any, computed: Any, rtol: float, atol: float, where: str = "") -> Iterator[str]:
    place = f"{key}{where}"
    if computed is MISSING:
        yield f"{place} is missing"
    elif isinstance(expected, dict):
        if not isinstance(computed, dict):
            yield f"{place} is {computed!r}, not a table"
            return
        for name, one in expected.items():
            yield from _compare(name, one, computed.get(name, MISSING), rtol, atol, f" of {place}")
    elif isinstance(expected, list):
        if not isinstance(computed, list) or len(computed) != len(expected):
            yield f"{place} is {computed!r}, not {len(expected)} values"
            return
        for k, (one, other) in enumerate(zip(expected, computed, strict=True)):
            yield from _compare(key, one, other, rtol, atol, f"{where}[{k}]")
    elif isinstance(expected, bool | str) or expected is None:
        if computed is not expected and computed != expected:
            yield f"{place} is {computed!r}, not {expected!r}"
    elif isinstance(computed, bool) or not isinstance(computed, int | float):
        yield f"{place} is {computed!r}, not {expected!r}"
    else:
        off = computed - expected
        turn = period(key)
        if turn < math.inf:
            off = math.remainder(off, turn)
        if not abs(off) <= atol + rtol * abs(expected):
            yield f"{place} is {computed!r}, not {expected!r}"


def _minimisers(computed: dict[str, Any], allowed: list[list[float]]) -> Iterator[str]:
    """Accept any of several equally good sets of yoke angles, modulo half a turn, to the digits listed."""
    best = computed.get("gamma_deg", [])
    if not any(
        len(best) == len(one) and all(abs(math.remainder(x - y, 180.0)) < 1e-6 for x, y in zip(best, one, strict=True))
        for one in allowed
    ):
        yield f"gamma_deg is {best}, none of {allowed}"


def _first(computed: dict[str, Any], wanted: list[str]) -> Iterator[str]:
    """Want each of some causes among the first four."""
    first = computed.get("first_causes", [])[:4]
    missed = [one for one in wanted if one not in first]
    if missed:
        yield f"first_causes is {first}, without {missed}"
