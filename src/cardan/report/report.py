"""Writes the report of a drive."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from cardan.answers.reader import Reader, reading
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.files import Enclosed, write_bytes

from .content import content
from .look import look_of
from .render.html import text
from .render.renderer import renderer_for


def report(
    drive: Drive,
    duty: Duty | None,
    path: Path | str,
    *,
    source_text: str | None = None,
    full: bool = False,
    interactive: bool = False,
    progress: Callable[[float], object] | None = None,
    known: Catalogue | None = None,
    units: Mapping[str, str] | None = None,
    decimal: str = "",
    folder: str | Path | Enclosed = ".",
    template: str | Path | None = None,
) -> Path:
    """Write the report of a drive as one file that needs nothing else.

    Parameters
    ----------
    drive : Drive
        The drive.
    duty : Duty or None
        What it does; None takes the drive's own duty.
    path : path
        Where the report goes; its ending chooses the form, see `cardan.report.render.renderer.RENDERERS`. Written
        whole or not at all.
    source_text : str, optional
        Text of the drive file, shown in the appendix.
    full : bool
        With the appendix: phase polygon, classical approximations, method and evidence, and the drive file.
    interactive : bool
        Draw figures to point at, zoom and turn, at the price of some megabytes; only in HTML.
    progress : function, optional
        Called with the share done; answering "stop" leaves out what is still to be calculated.
    known : Catalogue, optional
        Norms, types and sizes that it is judged by; the shipped ones when not given.
    units : mapping of str to str, optional
        Dimension -> unit that it is told in, as in the keys of a drive file: ``{"length": "in"}``.
    decimal : str
        Sign between whole and part, ``"."`` or ``","``, by default that of the language; workbooks show numbers as the
        spreadsheet is set.
    folder : str, Path or Enclosed
        Where the logo that the drive names is looked for.
    template : path, optional
        File with a firm's own look: colours, type, paper, logo, words at the head and foot of every page.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        The path does not end like a report or cannot be written, its form has no figures to point at, there is no such
        unit, the logo is no picture, or something in the template is not known.
    MissingExtraError
        What writes that form is not installed.

    See Also
    --------
    check, scene

    Examples
    --------
    >>> from tempfile import mkdtemp
    >>> from cardan import Drive, report
    >>> from cardan.units import deg
    >>> report(Drive.from_angles([20 * deg, 20 * deg]), None, mkdtemp() + "/even.html").name
    'even.html'
    """
    place = Path(path)
    written = renderer_for(place, interactive=interactive)
    who = Reader(units=units or {}, decimal=decimal)  # refuses what is no unit before any work is done
    look = None if template is None else look_of(template)
    with reading(who):
        said = content(
            drive, duty, source_text=source_text, full=full, progress=progress, known=known, folder=folder, look=look
        )
        write_bytes(place, written(said))
    if progress is not None:
        progress(1.0)
    return place


def page(
    drive: Drive,
    duty: Duty | None = None,
    *,
    source_text: str | None = None,
    full: bool = False,
    progress: Callable[[float], object] | None = None,
    known: Catalogue | None = None,
) -> str:
    """Return the report of a drive as the text of an HTML page; see `report`."""
    said = text(content(drive, duty, source_text=source_text, full=full, progress=progress, known=known))
    if progress is not None:
        progress(1.0)
    return said
