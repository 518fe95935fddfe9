"""Figures: a library-neutral description made from a result, and renderers that draw any of them."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, cast

from cardan.answers.reader import reader
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.files import write_bytes
from cardan.later import later
from cardan.texts import _

from .figure import Figure
from .for_reader import for_reader

drives = later("cardan.figures.drive")
pages = later("cardan.figures.render_plotly")
vectors = later("cardan.figures.render_svg")
pixels = later("cardan.figures.render_matplotlib")
"""What draws pages to turn, vectors, and pixels or PDF: most commands draw nothing."""

FIGURES = {Drive: lambda drive: drives().drive_figures(drive)}
"""Sort of result -> what makes its figures; a folder of results has such a table in `figure` or `figures` beside it."""


SUFFIXES = (".svg", ".png", ".pdf", ".html")
"""Kinds of picture that `save` writes."""

__all__ = ["SUFFIXES", "Figure", "drawn", "for_result", "save"]


def for_result(result: Any) -> tuple[Figure, ...]:
    """Return the figures of a result.

    Parameters
    ----------
    result : object
        A drive, or the result of a question.

    Raises
    ------
    TypeError
        There is no figure for such a thing.

    Examples
    --------
    >>> from cardan import Drive
    >>> [figure.name for figure in for_result(Drive.from_angles([0.2, 0.2]))]
    ['views', 'space', 'yokes']
    """
    for kind in type(result).__mro__:
        made = _maker(kind)
        if made is not None:
            found = made(result)
            return (found,) if isinstance(found, Figure) else tuple(found)
    raise TypeError(f"no figure shows a {type(result).__name__}")


def _maker(kind: type) -> Callable[[Any], Figure | Iterable[Figure]] | None:
    """Return what makes the figures of a sort of result: in the folder that holds it, or in one above."""
    package = kind.__module__
    while "." in package:
        package = package.rpartition(".")[0]
        for name in (f"{package}.figure", f"{package}.figures"):
            found = getattr(import_module(name), "FIGURES", {}) if find_spec(name) is not None else {}
            if kind in found:
                return cast(Callable[[Any], Figure | Iterable[Figure]], found[kind])
    return None


def save(figures: Figure | Sequence[Figure], path: Path | str) -> Path:
    """Draw figures into a file, whole or not at all.

    Parameters
    ----------
    figures : Figure or sequence of Figure
        What to draw, from the top; in a PDF one a page.
    path : path
        Its suffix says how: .svg, .png, .pdf, or .html to turn and measure it in a browser.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        The suffix is none of these, or the file cannot be written.
    """
    place = Path(path)
    write_bytes(place, drawn(figures, place.suffix.lower(), str(path)))
    return place


def drawn(figures: Figure | Sequence[Figure], suffix: str, name: str = "") -> bytes:
    """Return the file of a picture of figures.

    Parameters
    ----------
    figures : Figure or sequence of Figure
        What to draw, from the top; in a PDF one a page.
    suffix : str
        One of `SUFFIXES`.
    name : str
        What messages call the file.

    Raises
    ------
    InputError
        The suffix is none of these.
    """
    if suffix not in SUFFIXES:
        known = ", ".join(SUFFIXES)
        raise refuse("path", _("{path} should end in one of {known}").format(path=name or suffix, known=known))
    given = (figures,) if isinstance(figures, Figure) else tuple(figures)
    several = tuple(for_reader(one, reader()) for one in given)
    if suffix == ".html":
        return str(pages().render(several)).encode("utf-8")
    if suffix == ".svg":
        return str(vectors().document(several)).encode("utf-8")
    stream = io.BytesIO()
    pixels().render(several, stream, suffix[1:])
    return stream.getvalue()
