"""Numbers as people read them: significant digits, a true minus, thin groups of thousands, powers of ten."""

from __future__ import annotations

import math

from cardan.units import thousands

THIN = "\u202f"
"""Narrow blank within numbers."""


def significant(value: float, digits: int = 4) -> str:
    """Return a number with so many significant digits, a true minus and thin grouping.

    Returns: "–" for what is not a number, a power of ten for what is very small or large.
    """
    if not math.isfinite(value):
        return "–" if math.isnan(value) else "∞" if value > 0.0 else "−∞"
    if value == 0.0:
        return "0"
    size = math.floor(math.log10(abs(value)))
    if not -5 <= size < 9:
        mantissa, _sign, power = f"{value:.{digits - 1}e}".partition("e")
        return f"{mantissa}·10{raised(int(power))}".replace("-", "−")
    return thousands(value, max(0, digits - 1 - size)).replace("-", "−")


def fixed(value: float, decimals: int = 2) -> str:
    """Return a number with so many decimals, never "-0"."""
    if not math.isfinite(value):
        return significant(value)
    return f"{value:z,.{decimals}f}".replace(",", THIN).replace("-", "−")


def trimmed(text: str) -> str:
    """Return a number in words without zeros at the end of its decimals; whole numbers keep theirs.

    >>> trimmed("1\u202f500"), trimmed("0.2500"), trimmed("3.000"), trimmed("1.500·10⁻⁹")
    ('1\u202f500', '0.25', '3', '1.500·10⁻⁹')
    """
    return text.rstrip("0").rstrip(".") if "." in text and "·" not in text else text


def raised(number: int) -> str:
    """Return a whole number in raised digits.

    >>> raised(-12)
    '⁻¹²'
    """
    return str(number).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def half_turn(angle: float) -> float:
    """Return an angle [°] in (-90, 90]: yokes and planes are lines, not arrows.

    >>> half_turn(-90.0), half_turn(178.0)
    (90.0, -2.0)
    """
    return 90.0 - (90.0 - angle) % 180.0


def spreadsheet(value: float, digits: int = 4, decimals: int | None = None) -> str:
    """Return the number format of spreadsheets that shows as many digits as `significant` or `fixed`.

    >>> spreadsheet(0.125603), spreadsheet(123456.0), spreadsheet(1e-9, 2), spreadsheet(0.5, decimals=2)
    ('0.0000', '#,##0', '0.0E+00', '0.00')
    """
    if decimals is None:
        size = math.floor(math.log10(abs(value))) if value else 0
        if not -5 <= size < 9:
            return f"0{_point(digits - 1)}E+00"
        decimals = 0 if value == 0.0 else max(0, digits - 1 - size)
    return f"{'#,##0' if abs(value) >= 1000.0 else '0'}{_point(decimals)}"


def _point(decimals: int) -> str:
    return "." + "0" * decimals if decimals > 0 else ""
