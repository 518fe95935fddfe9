"""Forms in which a report is written, by the ending of its file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from cardan.errors import MissingExtraError, refuse
from cardan.report.content import Content, Excerpt
from cardan.texts import _

from . import html, typeset, workbook


@dataclass(frozen=True, kw_only=True)
class Renderer:
    """A form of the report.

    Parameters
    ----------
    written : function
        From what a report says to the bytes of its file.
    excerpt : function
        The same of a single page.
    interactive : function, optional
        The same with figures to point at, zoom and turn.
    library, extra : str
        What has to be installed for it, and the extra of cardan that installs it; empty where nothing has.
    """

    written: Callable[[Content], bytes]
    excerpt: Callable[[Excerpt], bytes]
    interactive: Callable[[Content], bytes] | None = None
    library: str = ""
    extra: str = ""


HTML = Renderer(written=html.written, excerpt=html.excerpt, interactive=html.interactive)

RENDERERS: dict[str, Renderer] = {
    ".html": HTML,
    ".htm": HTML,
    ".pdf": Renderer(written=typeset.written, excerpt=typeset.excerpt, library="typst", extra="pdf"),
    ".xlsx": Renderer(written=workbook.written, excerpt=workbook.excerpt, library="xlsxwriter", extra="xlsx"),
}
"""Every form by the ending of its file."""


def renderer_for(path: Path, *, interactive: bool = False, field: str = "path") -> Callable[[Content], bytes]:
    """Return what writes a report into a file, before any work is done.

    Parameters
    ----------
    path : path
        The file.
    interactive : bool
        With figures to point at, zoom and turn.
    field : str
        What the user gave the path as.

    Raises
    ------
    InputError
        No report ends so, or none of that form has figures to point at.
    MissingExtraError
        What writes it is not installed.

    Examples
    --------
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
    """Return the form of a report that a file has by its ending.

    Parameters
    ----------
    path : path
        The file.
    field : str
        What the user gave it as.

    Raises
    ------
    InputError
        No report ends so.
    MissingExtraError
        What writes it is not installed.
    """
    renderer = RENDERERS.get(path.suffix.lower())
    if renderer is None:
        text = _("{path} should end in one of {known}").format(path=path, known=", ".join(RENDERERS))
        raise refuse(field, text)
    if renderer.library and find_spec(renderer.library) is None:
        text = _("{path} needs {library}: pip install 'cardan[{extra}]'")
        raise MissingExtraError(text.format(path=path, library=renderer.library, extra=renderer.extra))
    return renderer
