"""The report as one HTML page that needs nothing else."""

from __future__ import annotations

import base64
from collections.abc import Callable
from pathlib import Path
from typing import Any

from cardan.figures.figure import Figure
from cardan.figures.render_plotly import fragment
from cardan.figures.render_plotly import program as drawing
from cardan.figures.render_svg import inline_svg
from cardan.later import later
from cardan.report.block import Listing, Picture, Points, Table, Words
from cardan.report.content import Content, Excerpt
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
        _=_, language=language(), report=said, drawn=drawn, kind=_kind, pictured=_pictured, program=program
    )
    return page


def _pictured(logo: Logo) -> str:
    """Return the address that holds a logo itself."""
    return f"data:{logo.media_type};base64,{base64.b64encode(logo.content).decode()}"


def _kind(block: object) -> str:
    """Return which macro of the template shows a block."""
    return {Table: "table", Words: "words", Points: "points", Listing: "listing", Picture: "picture"}[type(block)]


def _template(name: str) -> Any:
    folder = Path(__file__).parent / "templates"
    loader = jinja2().FileSystemLoader(folder)
    world = jinja2().Environment(
        loader=loader, autoescape=True, undefined=jinja2().StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    return world.get_template(name)
