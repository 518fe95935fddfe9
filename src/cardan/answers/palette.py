"""One colour for one thing, everywhere: shaft k looks the same in every curve, table and view.

After Okabe and Ito, told apart by readers with any colour vision; yellow and sky blue are darkened for thin lines on
white. Red is kept for a failed limit, so no shaft is red. After eight shafts the colours come again, dashed.
"""

from __future__ import annotations

SHAFTS = ("#3b4252", "#0072b2", "#d98a00", "#009e73", "#b5528b", "#3f9fd8", "#7a5230", "#8a8b00")

ROLES = {
    "ink": "#1c2330",
    "muted": "#6b7484",
    "faint": "#d5dae2",
    "grid": "#e7eaef",
    "paper": "#ffffff",
    "accent": "#1f4e8c",
    "cross": "#9aa3b2",
    "good": "#1b7f4b",
    "warning": "#b36b00",
    "failed": "#b3261e",
    "exact": "#1c2330",
    "first order": "#d98a00",
    "second order": "#0072b2",
}
"""Role -> colour, beside the shafts."""

SCALE = ("#eef3fa", "#b7cde7", "#6c9bcd", "#1f4e8c", "#0c2342")
"""From little to much: one hue, evenly darker, so that it prints in grey as well."""

DARK = {
    "#3b4252": "#b9c2d3",
    "#0072b2": "#4fa8e0",
    "#d98a00": "#f0ab3c",
    "#009e73": "#33c79b",
    "#b5528b": "#e089bb",
    "#3f9fd8": "#86ccf5",
    "#7a5230": "#c39a70",
    "#8a8b00": "#c9ca3a",
    "#1c2330": "#e6eaf1",
    "#6b7484": "#a3adbc",
    "#d5dae2": "#3a4351",
    "#e7eaef": "#2c3440",
    "#ffffff": "#1b212b",
    "#1f4e8c": "#8ab4f0",
    "#9aa3b2": "#8791a1",
    "#1b7f4b": "#5fd096",
    "#b36b00": "#f0b45a",
    "#b3261e": "#ff8a80",
}
"""Colour on white -> the same on a dark page: lighter, as far apart, still no red but for a failed limit."""

DASHES = ("solid", "dashed", "dotted", "dashdot")


def shaft(number: int) -> str:
    """Return the role of a shaft."""
    return f"shaft {number}"


def colour(role: str) -> str:
    """Return the colour of a role."""
    if role.startswith("scale "):
        return scale(float(role[6:]))
    if role.startswith("shaft "):
        return SHAFTS[(int(role[6:]) - 1) % len(SHAFTS)]
    return ROLES[role]


def scale(share: float) -> str:
    """Return the colour of a share between the least, 0, and the greatest, 1."""
    place = min(max(share, 0.0), 1.0) * (len(SCALE) - 1)
    low = min(int(place), len(SCALE) - 2)
    return mixed(SCALE[low], SCALE[low + 1], place - low)


def dash_of(number: int) -> str:
    """Return how the curve of a shaft is drawn: solid, dashed once the colours are used up."""
    return DASHES[(number - 1) // len(SHAFTS) % len(DASHES)]


def mixed(hexadecimal: str, other: str, share: float) -> str:
    """Return a colour mixed with a share of another one.

    >>> mixed("#000000", "#ffffff", 0.5)
    '#808080'
    """
    one = [int(hexadecimal[k : k + 2], 16) for k in (1, 3, 5)]
    two = [int(other[k : k + 2], 16) for k in (1, 3, 5)]
    return "#" + "".join(f"{round(a + (b - a) * share):02x}" for a, b in zip(one, two, strict=True))
