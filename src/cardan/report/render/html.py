"""The report as one HTML page that needs nothing else."""

from __future__ import annotations

import base64
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from cardan.figures.figure import Figure
from cardan.figures.render_plotly import fragment
from cardan.figures.render_plotly import program as drawing
from cardan.figures.render_svg import inline_svg
from cardan.later import later
from cardan.report.block import Listing, Picture, Points, Table, Words
from cardan.report.content import Content, Excerpt
from cardan.report.look import Look
from cardan.report.title_block import Logo
from cardan.texts import _, language

jinja2 = later("jinja2")


def written(content: Content) -> bytes:
    """Return a report as an HTML file."""
    return text(content).encode()


def interactive(content: Content) -> bytes:
    """Return a report as an HTML file with figures to point at, zoom and turn."""
    return _page(content, fragment, drawing()).encode()


def text(content: Content) -> str:
    """Return a report as the text of an HTML page."""
    return _page(content, inline_svg, "")


def excerpt(part: Excerpt) -> bytes:
    """Return a page of a report as an HTML file."""
    return _page(part, inline_svg, "", "excerpt.html").encode()


def _page(said: Content | Excerpt, drawn: Callable[[Figure], str], program: str, name: str = "report.html") -> str:
    template = _template(name)
    page: str = template.render(
        _=_,
        language=language(),
        report=said,
        drawn=drawn,
        kind=_kind,
        pictured=_pictured,
        program=program,
        own=_own(said) if isinstance(said, Content) else "",
    )
    return page


def _own(said: Content) -> str:
    """Return the style sheet of a look of its own; nothing for the usual one."""
    look = said.look
    if look == Look():
        return ""
    rules = "".join(f"--{name}: {value}; " for name, value in look.colours.changed().items())
    parts = [f":root {{ {rules}}}"] if rules else []
    if look.type.font:
        parts.append(f"body {{ font-family: {_quoted(look.type.font)}, sans-serif; }}")
    if look.type.headings:
        parts.append(f"h1, h2, h3 {{ font-family: {_quoted(look.type.headings)}, sans-serif; }}")
    boxes = [
        f"@{edge}-{side} {{ content: {' '.join(map(_counted, pieces))}; font: 8pt sans-serif; color: var(--muted); }}"
        for edge, line in (("top", look.head), ("bottom", look.foot))
        for side, pieces in zip(("left", "center", "right"), said.words_for(line), strict=True)
        if pieces
    ]
    size = "letter" if look.paper == "us-letter" else "A4"
    return "\n".join([*parts, f"@page {{ size: {size}; {' '.join(boxes)} }}", look.css])


def _counted(piece: tuple[str, str]) -> str:
    """Return a piece of the words at head or foot in CSS."""
    kind, words = piece
    return _quoted(words) if kind == "words" else f"counter({kind})"


def _quoted(words: str) -> str:
    """Return words as a string of CSS, every letter that could end it by its number."""
    return '"' + "".join(one if one.isalnum() or one in " .,:-_()/" else f"\\{ord(one):x} " for one in words) + '"'


def _pictured(logo: Logo) -> str:
    """Return the address that holds a logo itself."""
    return f"data:{logo.media_type};base64,{base64.b64encode(logo.content).decode()}"


def _kind(block: object) -> str:
    """Return which macro of the template shows a block."""
    return {Table: "table", Words: "words", Points: "points", Listing: "listing", Picture: "picture"}[type(block)]


@cache
def _template(name: str) -> Any:
    """Return a template, read once: it takes the words, and so the language, as it is rendered."""
    folder = Path(__file__).parent / "templates"
    loader = jinja2().FileSystemLoader(folder)
    world = jinja2().Environment(
        loader=loader, autoescape=True, undefined=jinja2().StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return world.get_template(name)
