"""SVG as matplotlib writes it, made fit for a page."""

from __future__ import annotations

import re
from html import escape

from .figure import Figure

FONTS = "'Inter', 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif"
"""Fonts of an SVG: that of the page it stands in, the widest one last, for which room is left."""


def tidied(text: str) -> str:
    """Return matplotlib's SVG made smaller, with the fonts of the page and rims round words over lines."""
    rim = 'style="paint-order: stroke; stroke: #fff; stroke-width: 2.4px; stroke-linejoin: round"'
    text = re.sub(r' id="halo\d+"', f" {rim}", text)
    text = re.sub(r"<[^>]*>", _short, text).replace("'DejaVu Sans'", FONTS)
    return re.sub(r">\s+<", "><", text)


def _short(tag: re.Match[str]) -> str:
    """Return a tag with two decimals in its numbers, a hundredth of a point; words between tags stay as they are."""
    return re.sub(r"(\d+\.\d{2})\d+", r"\1", tag[0])


def element(text: str, figure: Figure) -> str:
    """Return an SVG file as an element for a page: as wide as its place, with words for those who do not see it.

    Parameters
    ----------
    text : str
        The file, `tidied`.
    figure : Figure
        What it shows.
    """
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, count=1, flags=re.DOTALL)
    text = re.sub(r"<!--.*?-->\s*", "", text, flags=re.DOTALL)
    text = re.sub(r"<path d=\"[^\"]*\"\s*style=\"fill: #ffffff\"\s*/>", "", text, count=1)
    text = _own_names(text, figure.name)
    size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', text)
    box = f"0 0 {size[1]} {size[2]}" if size else "0 0 1 1"
    body = text[text.index(">") + 1 :]
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="{box}" '
        f'role="img" aria-label="{escape(f"{figure.title}. {figure.sentence}")}">{body}'
    )


def _own_names(text: str, name: str) -> str:
    """Keep only the ids that are referred to, with the figure's name before them: a page has many figures."""
    used = set(re.findall(r"url\(#([^)]+)\)", text)) | set(re.findall(r'href="#([^"]+)"', text))
    text = re.sub(r' id="([^"]+)"', lambda m: f' id="{name}-{m[1]}"' if m[1] in used else "", text)
    text = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", text)
    return re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', text)
