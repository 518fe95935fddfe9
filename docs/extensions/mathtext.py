"""Formulas as inline SVG: set by matplotlib's mathtext while the pages are built, so that a reader needs no network.

Registers the Sphinx math renderer ``mathtext``. A block may have several lines, each ended by two backslashes; an ``&``
in every line aligns them. Outlines are filled with the colour of the text around them, light or dark.
"""

from __future__ import annotations

import html
import re
from functools import cache
from typing import Any

from docutils import nodes
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextPath, TextToPath
from sphinx.application import Sphinx
from sphinx.errors import SphinxError

EM = 10.0
"""Font size in which outlines are computed; everything is then scaled to the em of the page."""

SCALE = 1.15
LETTERS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C", Path.CLOSEPOLY: "Z"}


@cache
def outline(latex: str) -> tuple[str, float, float, float]:
    """Return SVG path data (y downwards), width, ascent and descent of one line, in points at size `EM`."""
    latex = " ".join(latex.split())
    text = re.sub(r"\\(mathbf|mathrm|mathcal)(?: (\w)|(\\[A-Za-z]+))", r"\\\1{\2\3}", latex)
    text = re.sub(r"([\w})])\\(sin|cos|tan|sinh|cosh|ln)\b", r"\1\\,\\\2", text)
    text = "$" + text.replace(r"\lvert", "|").replace(r"\rvert", "|") + "$"
    font = FontProperties(family="STIXGeneral", math_fontfamily="stix", size=EM)
    try:
        glyphs = TextPath((0.0, 0.0), text, size=EM, prop=font)
        width, height, descent = TextToPath().get_text_width_height_descent(text, font, ismath=True)
    except ValueError as error:
        raise SphinxError(f"formula cannot be set: {latex!r}\n{error}") from error
    parts = []
    for corners, code in glyphs.iter_segments(curves=True, simplify=False):
        parts.append(LETTERS[code] + ("" if code == Path.CLOSEPOLY else " ".join(f"{v:.2f}" for v in _flip(corners))))
    return "".join(parts), width, height - descent, descent


def _flip(corners: Any) -> list[float]:
    return [-v if i % 2 else v for i, v in enumerate(corners)]


def svg(rows: list[list[str]], latex: str, *, display: bool) -> str:
    """Return rows of aligned cells as one inline SVG whose first baseline is the text's when it stands in a line."""
    cells = [[outline(cell) if cell.strip() else ("", 0.0, 0.0, 0.0) for cell in row] for row in rows]
    columns = max(len(row) for row in cells)
    widths = [max((row[c][1] for row in cells if c < len(row)), default=0.0) for c in range(columns)]
    y, parts, descent = 0.0, [], 0.0
    top = max(cell[2] for cell in cells[0])
    for number, row in enumerate(cells):
        ascent = max(cell[2] for cell in row)
        y += (descent + ascent + 0.55 * EM) if number else 0.0
        descent = max(cell[3] for cell in row)
        x = 0.0
        for c, (data, width, _up, _down) in enumerate(row):
            shift = widths[c] - width if c == 0 and columns > 1 else 0.0
            parts.append(f'<path transform="translate({x + shift:.2f} {y:.2f})" d="{data}"/>')
            x += widths[c] + (0.28 * EM if c + 1 < columns else 0.0)
    width, height = sum(widths) + 0.28 * EM * (columns - 1), top + y + descent
    em = SCALE / EM
    style = "" if display else f"vertical-align:{-(y + descent) * em:.3f}em"
    return (
        f'<svg class="formula" role="img" aria-label="{html.escape(latex)}" style="{style}" '
        f'width="{(width + 0.6) * em:.3f}em" height="{height * em:.3f}em" '
        f'viewBox="-0.3 {-top:.2f} {width + 0.6:.2f} {height:.2f}">{"".join(parts)}</svg>'
    )


def inline(self: Any, node: nodes.math) -> None:
    """Write a formula that stands in a line of text."""
    latex = node.astext().replace("\n", " ")
    self.body.append(svg([[latex]], latex, display=False))
    raise nodes.SkipNode


def block(self: Any, node: nodes.math_block) -> None:
    """Write a formula that stands by itself."""
    latex = node.astext().strip()
    rows = [line.replace(r"\frac", r"\dfrac").split("&") for line in re.split(r"\\\\\s*\n", latex)]
    self.body.append(f'<div class="formula">{svg(rows, latex, display=True)}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer."""
    app.add_html_math_renderer("mathtext", inline_renderers=(inline, None), block_renderers=(block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
