"""The look of a report: colours, type, paper, words at head and foot; a firm's own comes from a template file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from string import Formatter
from typing import Any

from cardan.errors import InputError, Problem, check, refuse
from cardan.io.text import parsed, text_of
from cardan.reading.fields import fields_of
from cardan.reading.tree import Form, read_table
from cardan.texts import _
from cardan.units import plain

from .title_block import Logo, picture_of

FORMAT = 1  # version of the template file
COLOUR = re.compile("#[0-9a-fA-F]{6}")
PAGES = ("page", "pages")  # placeholders of which each page has its own
FIELDS = ("title", "client", "project", "drawing_number", "revision", "author", "checked_by", "date", "version", *PAGES)
"""Placeholders of the words at head and foot."""

PAPER = {"a4": (210.0, 297.0), "us-letter": (215.9, 279.4)}
"""Width and height of paper [mm]."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Colours:
    """Colours, each as #rrggbb."""

    ink: str = plain("#1c2330", doc="colour of words")
    muted: str = plain("#5f6877", doc="colour of what is less important: units, sources, notes")
    line: str = plain("#cfd5de", doc="colour of the lines in tables")
    soft: str = plain("#f5f7fa", doc="colour behind the verdict, remarks and listings")
    accent: str = plain("#1f4e8c", doc="colour of numbers of parts and figures, and of links")

    def changed(self) -> dict[str, str]:
        """Return those that are not the usual ones, by their names."""
        usual = Colours()
        return {name: getattr(self, name) for name in fields_of(Colours) if getattr(self, name) != getattr(usual, name)}


@dataclass(frozen=True, kw_only=True, slots=True)
class Type:
    """Type of the words."""

    font: str = plain("", doc="font of the words")
    headings: str = plain("", doc="font of the headings; without it that of the words")
    folder: str = plain("", doc="folder with the files of these fonts, beside this file; without it installed ones")
    size_pt: float = plain(10.0, doc="size of the words on paper [pt]", low=7.0, high=14.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Line:
    """Words at the head or the foot of every page."""

    left: str = plain("", doc="words at the left")
    middle: str = plain("", doc="words in the middle")
    right: str = plain("", doc="words at the right")

    def parts(self) -> tuple[str, str, str]:
        """Return left, middle and right."""
        return self.left, self.middle, self.right


HEAD = Line(left="{title}", right="{page} / {pages}")


@dataclass(frozen=True, kw_only=True, slots=True)
class Look:
    """What a template says of the look of a report."""

    format: int = plain(FORMAT, doc="version of the template file", low=1, high=FORMAT)
    paper: str = plain("a4", doc="paper of the PDF", choices=tuple(PAPER))
    logo: str = plain("", doc="PNG or SVG file with the firm's logo, beside this file; where the drive names none")
    style: str = plain("", doc="style sheet (CSS) for reports in HTML, beside this file, behind the own one")
    colours: Colours = plain(Colours(), doc="colours")
    type: Type = plain(Type(), doc="type")
    head: Line = plain(HEAD, doc="words at the head of every page but the first")
    foot: Line = plain(Line(), doc="words at the foot of every page")

    # what the files hold that it names; filled in as it is read
    picture: Logo | None = None
    css: str = ""
    fonts: Path | None = None


def look_of(path: str | Path) -> Look:
    """Return the look that a template file describes, with the files that it names."""
    where = Path(path)
    text, form = text_of(where)
    read, problems = read_table(Look, parsed(text, form, str(where)), Form(spelled=lambda path, _root: path))
    check(Problem(f"{where}: {one.field}", one.message, one.code) for one in [*problems, *_wrong(read)])
    found: list[Problem] = []

    def held(name: str, key: str, read: Callable[[Path], Any]) -> Any:
        """Return what a file holds that the template names; None where it names none."""
        try:
            return read(where.parent / name) if name else None
        except InputError as error:
            found.extend(Problem(f"{where}: {key}", one.message, one.code) for one in error.problems)
            return None

    look: Look = replace(
        read,
        picture=held(read.logo, "logo", lambda file: picture_of(file, "logo")),
        css=held(read.style, "style", _css) or "",
        fonts=held(read.type.folder, "type.folder", _folder),
    )
    check(found)
    return look


def _wrong(look: Look) -> Iterator[Problem]:
    """Yield colours that are none, and placeholders that nobody knows."""
    for name in fields_of(Colours):
        value = getattr(look.colours, name)
        if not COLOUR.fullmatch(value):
            yield Problem(
                f"colours.{name}", _("{value} is not a colour; write it as #1f4e8c").format(value=repr(value))
            )
    for name, line in (("head", look.head), ("foot", look.foot)):
        for key in fields_of(Line):
            yield from _unknown(f"{name}.{key}", getattr(line, key))


def _unknown(key: str, words: str) -> Iterator[Problem]:
    """Yield what is wrong with words that hold placeholders."""
    try:
        found = list(Formatter().parse(words))
    except ValueError as error:
        yield Problem(key, _("{words} cannot be read: {why}").format(words=repr(words), why=error))
        return
    known = ", ".join(f"{{{one}}}" for one in FIELDS)
    for _text, name, form, how in found:
        if name is not None and (name not in FIELDS or form or how):
            text = _("{name} stands for nothing; known are {known}")
            yield Problem(key, text.format(name=f"{{{name}}}", known=known))


def _css(file: Path) -> str:
    """Return the text of a style sheet."""
    text, _form = text_of(file)
    if "</" in text:
        raise refuse(str(file), _("holds </, which a style sheet does not"))
    return text


def _folder(place: Path) -> Path:
    """Return a folder that there is."""
    if not place.is_dir():
        raise refuse(str(place), _("there is no such folder"))
    return place


def pieces(words: str, said: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Yield words at head or foot of a page in pieces: ``"words"`` with the text; ``"page"``, ``"pages"``, empty.

    >>> list(pieces("{title}: {page} of {pages}", {"title": "Drive"}))
    [('words', 'Drive'), ('words', ': '), ('page', ''), ('words', ' of '), ('pages', '')]
    """
    for text, name, _form, _how in Formatter().parse(words):
        if text:
            yield "words", text
        if name in PAGES:
            yield name, ""
        elif name is not None and said.get(name):
            yield "words", said[name]
