"""Forms in which a report is written, by the ending of its file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from cardan.errors import MissingExtraError, refuse
from cardan.later import later
from cardan.report.content import Content, Excerpt
from cardan.texts import _

from . import html

typeset, workbook = later("cardan.report.render.typeset"), later("cardan.report.render.workbook")


@dataclass(frozen=True, kw_only=True)
class Renderer:
    """A form of the report."""

    written: Callable[[Content], bytes]  # from what a report says to the bytes of its file
    excerpt: Callable[[Excerpt], bytes]  # the same of a single page
    interactive: Callable[[Content], bytes] | None = None  # the same with figures to point at, zoom and turn
    # library, extra: what has to be installed for it, and the extra of cardan that installs it; empty where nothing has
    library: str = ""
    extra: str = ""


HTML = Renderer(written=html.written, excerpt=html.excerpt, interactive=html.interactive)

RENDERERS: dict[str, Renderer] = {
    ".html": HTML,
    ".htm": HTML,
    ".pdf": Renderer(
        written=lambda content: typeset().written(content),
        excerpt=lambda excerpt: typeset().excerpt(excerpt),
        library="typst",
        extra="pdf",
    ),
    ".xlsx": Renderer(
        written=lambda content: workbook().written(content),
        excerpt=lambda excerpt: workbook().excerpt(excerpt),
        library="xlsxwriter",
        extra="xlsx",
    ),
}
"""Every form by the ending of its file."""


def renderer_for(path: Path, *, interactive: bool = False, field: str = "path") -> Callable[[Content], bytes]:
    """Return what writes a report into a file, before any work is done.

    interactive: with figures to point at, zoom and turn; field: what the user gave the path as.

    >>> renderer_for(Path("report.odt"))
    Traceback (most recent call last):
        ...
    cardan.errors.InputError: path: report.odt should end in one of .html, ...
    """
    renderer = form_of(path, field)
    if not interactive:
        return renderer.written
    if renderer.interactive is None:
        known = ", ".join(suffix for suffix, one in RENDERERS.items() if one.interactive)
        text = _("{path} cannot have figures to point at; only reports in {known} can")
        raise refuse(field, text.format(path=path, known=known))
    return renderer.interactive


def form_of(path: Path, field: str = "path") -> Renderer:
    """Return the form of a report that a file has by its ending."""
    renderer = RENDERERS.get(path.suffix.lower())
    if renderer is None:
        text = _("{path} should end in one of {known}").format(path=path, known=", ".join(RENDERERS))
        raise refuse(field, text)
    if renderer.library and find_spec(renderer.library) is None:
        text = _("{path} needs {library}: pip install 'cardan[{extra}]'")
        raise MissingExtraError(text.format(path=path, library=renderer.library, extra=renderer.extra))
    return renderer
