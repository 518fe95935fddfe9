"""The head of the report: whom it is for, who answers for it, the logo, and the units it is told in."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

from cardan.answers.reader import Reader
from cardan.drive.settings import TitleBlock
from cardan.errors import InputError, refuse
from cardan.files import Enclosed, folder_of, refusal
from cardan.later import later
from cardan.reading.fields import fields_of
from cardan.texts import _
from cardan.units import DIMENSIONS

pillow = later("PIL.Image")  # it comes with matplotlib

LOGO_BYTES = 5_000_000  # larger files are refused; no more of them is read
LOGO_PIXELS = 40_000_000  # so are pictures with more pixels
LOGO_SIZE = (1200, 600)  # pixels across and down that a logo is made smaller to
FIELD = "report.logo"


@dataclass(frozen=True, kw_only=True)
class Logo:
    """A picture in the head of the report."""

    content: bytes
    form: Literal["png", "svg"]

    @property
    def media_type(self) -> str:
        """What a browser calls it."""
        return "image/svg+xml" if self.form == "svg" else "image/png"


@dataclass(frozen=True, kw_only=True)
class Head:
    """What stands at the head of a report beside the name of the drive."""

    rows: tuple[tuple[str, str], ...] = ()  # what is told of client, drawing and author: its name, and what is given
    units: str = ""  # the units that the report uses, in a line
    logo: Logo | None = None
    given: Mapping[str, str] = field(default_factory=dict)  # the same rows by their keys


@dataclass(frozen=True, kw_only=True)
class Noting(Reader):
    """A reader of whom is noted in which units they were told something."""

    noted: set[tuple[str, str]] = field(default_factory=set, compare=False)  # dimension, unit as it is printed

    def label(self, dimension: str, usual: str = "") -> str:
        """Return the unit of a dimension as it is printed; nothing where there is none."""
        said = super().label(dimension, usual)
        if said:
            self.noted.add((dimension, said))
        return said

    def line(self) -> str:
        """Return in a line the units that were used, each once, in the order of their dimensions."""
        order = list(DIMENSIONS)
        used = dict.fromkeys(
            unit for _dimension, unit in sorted(self.noted, key=lambda one: (order.index(one[0]), one))
        )
        return _("Units: {units}").format(units=", ".join(used)) if used else ""


def noting(who: Reader) -> Noting:
    """Return a reader of a report, who writes no file, with the units and the decimal sign of another."""
    return Noting(units=who.units, decimal=who.decimal, keys="meaning")


def given(block: TitleBlock) -> dict[str, str]:
    """Return what a title block gives in words, by its keys."""
    words = {key: getattr(block, key).strip() for key in fields_of(TitleBlock) if key != "logo"}
    return {key: said for key, said in words.items() if said}


def rows(block: TitleBlock) -> Iterator[tuple[str, str]]:
    """Yield what a title block gives: its name, and the words."""
    names = {
        "client": _("Client"),
        "project": _("Project"),
        "drawing_number": _("Drawing number"),
        "revision": _("Revision"),
        "author": _("Author"),
        "checked_by": _("Checked by"),
        "date": _("Date"),
    }
    yield from ((names[key], said) for key, said in given(block).items())


def logo_of(head: TitleBlock, folder: str | Path | Enclosed = ".") -> Logo | None:
    """Return the logo of a report, None where it names none; folder: where the file is looked for."""
    name = head.logo
    return picture_of(folder_of(folder) / name, FIELD, name) if name else None


def picture_of(file: Path, field: str, name: str = "") -> Logo:
    """Return the logo in a file; field: what names it, name: as what."""
    name = name or file.name
    try:
        with file.open("rb") as stream:
            content = stream.read(LOGO_BYTES + 1)
    except (OSError, ValueError) as error:
        why = refusal(error) if isinstance(error, OSError) else str(error)
        raise refuse(field, _("{name} cannot be read: {why}").format(name=name, why=why)) from None
    if len(content) > LOGO_BYTES:
        text = _("{name} is larger than {limit} MB").format(name=name, limit=LOGO_BYTES // 10**6)
        raise refuse(field, text, "out_of_range")
    if content.startswith(b"\x89PNG\r\n\x1a\n"):
        return Logo(content=_small(field, name, content), form="png")
    if _is_svg(content):
        return Logo(content=content, form="svg")
    raise _unfit(field, name)


def _unfit(field: str, name: str) -> InputError:
    return refuse(field, _("{name} is not a picture in PNG or SVG").format(name=name))


def _small(field: str, name: str, content: bytes) -> bytes:
    """Return a PNG no larger than a head needs, read whole and written anew."""
    across, down = (int.from_bytes(content[start : start + 4], "big") for start in (16, 20))
    if across * down > LOGO_PIXELS:
        text = _("{name} has more than {limit} million pixels").format(name=name, limit=LOGO_PIXELS // 10**6)
        raise refuse(field, text, "out_of_range")
    try:
        picture = pillow().open(io.BytesIO(content), formats=("PNG",)).convert("RGBA")
    except (OSError, SyntaxError, ValueError):
        raise _unfit(field, name) from None
    picture.thumbnail(LOGO_SIZE)
    stream = io.BytesIO()
    picture.save(stream, "png")
    return stream.getvalue()


def _is_svg(content: bytes) -> bool:
    """Tell whether a text is a drawing in SVG that has a size."""
    try:
        root = ElementTree.fromstring(content)
        size = root.get("viewBox", "").replace(",", " ").split()[2:] or [
            root.get(one, "") for one in ("width", "height")
        ]
        sized = all(float(one.rstrip("%abcdefghijklmnopqrstuvwxyz")) > 0.0 for one in size)
    except (ElementTree.ParseError, ValueError):
        return False
    return root.tag == "{http://www.w3.org/2000/svg}svg" and len(size) == 2 and sized
