"""Formats of a workbook, each made once."""

from __future__ import annotations

from typing import Any

from cardan.figures.palette import colour, mixed
from cardan.report.block import Tone

PALE = 0.86
"""Share of white in the colour behind a tone."""

CODE = "Consolas"
"""Font of text as it stands in a file."""


class Looks:
    """Formats by their properties, those of XlsxWriter.

    book: where they are made.
    """

    def __init__(self, book: Any) -> None:
        self._book = book
        self._made: dict[tuple[tuple[str, object], ...], Any] = {}

    def __call__(self, *, color: str = "", tone: Tone = "plain", **properties: Any) -> Any:
        """Return the format with these properties.

        color: role of the letters' colour, see `cardan.figures.palette`.
        tone: how good what it shows is: paper and letters have its colour; **properties: properties of XlsxWriter.
        """
        wanted = {"valign": "top", **properties}
        if color:
            wanted["font_color"] = colour(color)
        if tone != "plain":
            wanted |= {"bg_color": mixed(colour(tone), "#ffffff", PALE), "font_color": colour(tone)}
        key = tuple(sorted(wanted.items()))
        if key not in self._made:
            self._made[key] = self._book.add_format(wanted)
        return self._made[key]
