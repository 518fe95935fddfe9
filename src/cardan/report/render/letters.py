"""How wide words are in the letters of a spreadsheet, and how many lines they take in a column."""

from __future__ import annotations

import math

DIGIT = 507.0
"""Width of a digit in the usual letters of spreadsheets (Calibri), thousandths of their size; so are all below."""

BROADEST = 560.0
"""Width of a letter that is not listed, about: those of other alphabets, bold ones."""

SPARE = 1.05
"""What words may be wider than told: bold letters, other fonts."""

WIDTHS: dict[str, float] = {
    letter: width
    for width, letters in (
        (230.0, " ijlI'|.,:;\u00a0"),
        (180.0, "\u202f"),
        (310.0, '()[]{}f-!·‧°"²³⁻¹⁰⁴⁵⁶⁷⁸⁹₁₂₃₄₅₆₇₈₉'),
        (345.0, "rt"),
        (395.0, "csz/\\"),
        (430.0, "vxkyJL"),
        (480.0, "aegFEST?"),
        (DIGIT, "0123456789+−=<>≤≥±–_$#~"),
        (530.0, "bdhnopquBPRXKYZC"),
        (630.0, "ADGHNOQUV&"),
        (720.0, "w%@"),
        (860.0, "mMW—✓✖▲○→"),
    )
    for letter in letters
}


def breadth(text: str) -> float:
    """Return how many digits are as wide as a text.

    >>> breadth("100"), breadth("mm") > 3.0 > breadth("illi")
    (3.0, True)
    """
    return sum(WIDTHS.get(letter, BROADEST) for letter in text) / DIGIT


def lines(text: str, digits: float) -> int:
    """Return how many lines words take in a column as wide as so many digits.

    text: the words, which break at blanks; digits: width of the column.

    >>> lines("greatest acceleration [rad/s²]", 12.0), lines("", 12.0), lines("x" * 25, 12.0)
    (3, 1, 2)
    """
    room = max(digits, 1.0) / SPARE
    count = 0
    for part in text.splitlines() or [""]:
        count, filled = count + 1, 0.0
        for word in part.split(" "):
            wide = breadth(word)
            if filled and filled + breadth(" ") + wide > room:
                count, filled = count + 1, 0.0
            filled += wide + (breadth(" ") if filled else 0.0)
            if filled > room:  # it is cut where the column ends
                over = math.ceil(filled / room) - 1
                count, filled = count + over, filled - over * room
    return count
