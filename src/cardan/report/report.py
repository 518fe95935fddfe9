"""Writes the report of a drive."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from cardan import __version__
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.laws import unmapped
from cardan.drive.solids import Solids
from cardan.errors import refuse
from cardan.figures import Figure
from cardan.figures.drive import space_figure
from cardan.files import write_text
from cardan.texts import _

from .balance import refused
from .block import Listing, Page, Picture, Points, Table, Words
from .followed import (
    Followed,
    asked_by_laws,
    changes_by_laws,
    figures_by_laws,
    judgement_by_laws,
    method_by_laws,
    turning_by_laws,
    warnings_by_laws,
    yokes_refused,
)
from .loaded import loaded
from .method import method
from .moving import moving
from .phasing import phasing
from .subject import Subject, asked
from .summary import changes, judgement, key_figures, warnings
from .turning import turning
from .understood import understood
from .verdicts import Judged, judged

SUFFIXES = (".html", ".htm")


def report(
    drive: Drive,
    duty: Duty | None,
    path: Path | str,
    *,
    source_text: str | None = None,
    interactive: bool = False,
    progress: Callable[[float], object] | None = None,
    known: Catalogue | None = None,
) -> Path:
    """Write the report of a drive as one HTML file that needs nothing else.

    Parameters
    ----------
    drive : Drive
        The drive.
    duty : Duty or None
        What it does; None takes the drive's own duty.
    path : path
        Where the report goes, ending in .html; written whole or not at all.
    source_text : str, optional
        Text of the drive file, shown in full at the end.
    interactive : bool
        Draw figures to point at, zoom and turn, at the price of some megabytes.
    progress : function, optional
        Called with the share done; answering "stop" leaves out what is still to be reckoned.
    known : Catalogue, optional
        Norms, types and sizes that it is judged by; the shipped ones when not given.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        The path does not end in .html or cannot be written.

    Examples
    --------
    >>> from tempfile import mkdtemp
    >>> from cardan.units import deg
    >>> report(Drive.from_angles([20 * deg, 20 * deg]), None, mkdtemp() + "/even.html").name
    'even.html'
    """
    place = Path(path)
    if place.suffix.lower() not in SUFFIXES:
        raise refuse("path", _("{path} should end in .html").format(path=place))
    text = page(drive, duty, source_text=source_text, interactive=interactive, progress=progress, known=known)
    write_text(place, text)
    return place


def page(
    drive: Drive,
    duty: Duty | None = None,
    *,
    source_text: str | None = None,
    interactive: bool = False,
    progress: Callable[[float], object] | None = None,
    known: Catalogue | None = None,
) -> str:
    """Return the report of a drive as the text of an HTML page; see `report`."""
    if unmapped(drive.joints):
        on_laws = replace(asked_by_laws(drive, duty), known=known)
        return _page_by_laws(on_laws, source_text=source_text, interactive=interactive, progress=progress)
    on = replace(asked(drive, duty, progress), known=known)
    pages: list[Page] = [understood(on), turning(on), phasing(on)]
    if on.moving is not None:
        pages.append(moving(on))
    if on.unmoved is not None:
        pages.append(refused("moving", _("While moving"), on.unmoved))
    pages += loaded(on)
    limits = judged(on) if on.complete else Judged()
    if limits.page is not None:
        pages.append(limits.page)
    pages.append(method(on, source_text))
    words = {
        "judgement": judgement(on, pages),
        "warnings": list(warnings(on, pages)),
        "figures": key_figures(on, pages),
        "changes": changes(on),
        "limits": limits,
    }
    return _rendered(drive, on.seen, pages, words, interactive=interactive, progress=progress)


def _page_by_laws(
    on: Followed,
    *,
    source_text: str | None,
    interactive: bool,
    progress: Callable[[float], object] | None,
) -> str:
    """Return the report of a drive with joints that turn by laws of their own."""
    alike = cast(Subject, on)  # what these pages ask for it has under the same names
    pages = [understood(alike), turning_by_laws(on), yokes_refused(on), *loaded(alike)]
    limits = judged(alike)
    if limits.page is not None:
        pages.append(limits.page)
    pages.append(method_by_laws(on, source_text))
    words = {
        "judgement": judgement_by_laws(on, pages),
        "warnings": list(warnings_by_laws(on, pages)),
        "figures": figures_by_laws(on, pages),
        "changes": changes_by_laws(on),
        "limits": limits,
    }
    return _rendered(on.drive, on.seen, pages, words, interactive=interactive, progress=progress)


def _rendered(
    drive: Drive,
    seen: Solids,
    pages: Sequence[Page],
    words: Mapping[str, object],
    *,
    interactive: bool,
    progress: Callable[[float], object] | None,
) -> str:
    def drawn(figure: Figure) -> str:
        if interactive:
            from cardan.figures.render_plotly import fragment

            return fragment(figure)
        from cardan.figures.render_svg import inline_svg

        return inline_svg(figure)

    text: str = _template().render(
        _=_,
        title=drive.name or _("Universal-joint drive"),
        note=drive.note,
        version=__version__,
        date=datetime.datetime.now(tz=datetime.UTC).date().isoformat(),
        sketch=space_figure(drive, seen, name="sketch"),
        pages=pages,
        drawn=drawn,
        kind=_kind,
        program=_program() if interactive else "",
        **words,
    )
    if progress is not None:
        progress(1.0)
    return text


def _program() -> str:
    from cardan.figures.render_plotly import program

    return program()


def _kind(block: object) -> str:
    """Return which macro of the template shows a block."""
    return {Table: "table", Words: "words", Points: "points", Listing: "listing", Picture: "picture"}[type(block)]


def _template() -> Any:
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    folder = Path(__file__).parent / "templates"
    world = Environment(
        loader=FileSystemLoader(folder),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return world.get_template("report.html")
