"""The report as a PDF: its content as data, set by Typst from ``templates/report.typ``.

The template never takes text for code: names and notes reach it as the strings of a JSON file, whatever stands in them.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from cardan.errors import Problem, check
from cardan.figures.figure import Bars, Figure, Panel, Row
from cardan.figures.page import LETTER, breadth, share
from cardan.figures.render_svg import inline_svg
from cardan.later import later
from cardan.reading.fields import fields_of
from cardan.report.block import SIGNS, Block, Cell, Listing, Page, Points, Table, Tone, Words
from cardan.report.content import Content, Excerpt
from cardan.report.look import PAPER, Colours, Look
from cardan.report.title_block import Head, Logo
from cardan.texts import _, language, mark

typst = later("typst", mark("an SVG logo in a workbook needs typst: pip install 'cardan[pdf]', or give a PNG"))
matplotlib = later("matplotlib")

TEMPLATE = Path(__file__).parent / "templates" / "report.typ"

FONTS = "'DejaVu Sans'"  # font of the words in figures: matplotlib brings it wherever cardan is installed
NARROW = 4.6  # width [inch] of a figure that is drawn for half of the paper
WIDE = 8.2  # width [inch] of a figure with its panels side by side
LOWER = 0.62  # height of curves on paper over that on a screen
USUAL = Look()
FULL = 2.0 / 3.0  # share of the last page that is filled where nothing has to be drawn closer
READ: Final = 8  # pages that a client reads of a shaft in two pieces
CLOSER = (1.0, 0.94, 0.88, 0.82)  # shares of their height that pictures and gaps keep, one after the other
STANDARD: Final = "ua-1"  # the PDF can be read aloud: tagged, with words for every picture


ALONE: Final = b"""#set page(width: auto, height: auto, margin: 0pt, fill: none)
#image(bytes(json(bytes(sys.inputs.logo))), height: 2cm)"""  # a page that is nothing but a logo

UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufeff\ufffe\uffff]")
"""Marks of control, halves of characters and what is none."""


def written(content: Content) -> bytes:
    """Return a report as a PDF file."""
    return _set(as_data(content), content.look)


def excerpt(part: Excerpt) -> bytes:
    """Return a page of a report as a PDF file."""
    return _set(
        {
            "language": language(),
            "words": _words(part.kind),
            "title": part.title.strip() or part.page.title,
            "note": part.note,
            "version": part.version,
            "date": part.date,
            "judgement": None,
            "pages": [_page(part.page)],
            "look": _look(USUAL),
        }
    )


def compiler(data: dict[str, Any], look: Look = USUAL) -> Any:
    """Return what sets a report, as PDF or in pictures of its pages; data: as of `as_data`.

    What would end on a page of which more than a third stays blank, or on one page more than a client reads, is drawn
    closer until it ends on the page before, where that can be.
    """
    made = _compiler(data, look, CLOSER[0])
    pages, share = _end(made)
    for tight in CLOSER[1:] if pages > 1 and (share < FULL or pages == READ + 1) else ():
        closer = _compiler(data, look, tight)
        if _end(closer)[0] < pages:
            return closer
    return made


def _end(made: Any) -> tuple[int, float]:
    """Return on which page a report ends, and how much of that page it fills."""
    (end,) = json.loads(made.query("<end>", field="value"))
    return int(end["page"]), float(end["share"])


def _compiler(data: dict[str, Any], look: Look, tight: float) -> Any:
    """Return what sets a report whose pictures and gaps keep a share of their height."""
    return typst().Compiler(
        TEMPLATE,
        root=TEMPLATE.parent,
        font_paths=[Path(matplotlib().get_data_path()) / "fonts" / "ttf", *([look.fonts] if look.fonts else [])],
        sys_inputs={"report": json.dumps(_printable(data), ensure_ascii=False), "tight": str(tight)},
    )


def _set(data: dict[str, Any], look: Look = USUAL) -> bytes:
    """Return what the template makes of its data."""
    found, warned = compiler(data, look).compile_with_warnings(format="pdf", pdf_standards=[STANDARD])
    check(
        Problem(f"template: type.{key}", _("no font {name} is installed or in type.folder").format(name=repr(name)))
        for key, name in (("font", look.type.font), ("headings", look.type.headings))
        if name and any(name.lower() in str(one).lower() for one in warned)
    )
    assert isinstance(found, bytes)  # a single file, and no place was given to write it to
    return found


def as_data(content: Content) -> dict[str, Any]:
    """Return what a report says as data for the template."""
    return {
        "language": language(),
        "words": _words(content.kind),
        "title": content.title.strip() or _("Universal-joint drive"),
        "note": content.note,
        "version": content.version,
        "date": content.date,
        "head": _head(content.head),
        "judgement": _block(content.judgement),
        "warnings": [_block(one) for one in content.warnings],
        "sketch": _picture(content.sketch),
        "tables": [_block(one) for one in (content.lights, content.remedies, content.figures, content.changes) if one],
        "pages": [_page(page) for page in content.pages],
        "appendix": [_page(page) for page in content.appendix],
        "look": _look(content.look, content),
    }


def _look(look: Look, content: Content | None = None) -> dict[str, Any]:
    """Return a look, and the words at head and foot of the pages of a report, as data for the template."""
    width, height = PAPER[look.paper]
    lines = {} if content is None else {"head": content.words_for(look.head), "foot": content.words_for(look.foot)}
    return {
        "paper": look.paper,
        "width": width,
        "height": height,
        "colours": {name: getattr(look.colours, name) for name in fields_of(Colours)},
        "font": look.type.font,
        "headings": look.type.headings or look.type.font,
        "size": look.type.size_pt,
        **lines,
    }


def _head(head: Head) -> dict[str, Any]:
    logo = head.logo and {"form": head.logo.form, "bytes": list(head.logo.content), "alt": _("Logo")}
    return {"rows": [list(one) for one in head.rows], "units": head.units, "logo": logo}


def pixels_of(logo: Logo) -> bytes:
    """Return a logo as a PNG."""
    if logo.form == "png":
        return logo.content
    inputs = {"logo": json.dumps(list(logo.content))}
    found = typst().compile(ALONE, format="png", ppi=200, sys_inputs=inputs)
    assert isinstance(found, bytes)  # a single page, and no place was given to write it to
    return found


def _words(kind: str) -> dict[str, str]:
    """Return the words of the template itself."""
    first = kind or _("Drive report")
    return {"kicker": first, "summary": _("Summary"), "contents": _("Contents"), "appendix": _("Appendix")}


def _printable(data: Any) -> Any:
    """Return data whose texts hold nothing that no PDF may show: marks of control and halves of characters."""
    if isinstance(data, str):
        return UNPRINTABLE.sub("\ufffd", data)
    if isinstance(data, dict):
        return {name: _printable(value) for name, value in data.items()}
    return [_printable(value) for value in data] if isinstance(data, list | tuple) else data


def _page(page: Page) -> dict[str, Any]:
    return {"name": page.name, "title": page.title, "answer": page.answer, "blocks": list(map(_block, page.blocks))}


def _block(block: Block) -> dict[str, Any]:
    """Return a block with the name of its kind, which the template calls."""
    if isinstance(block, Table):
        columns = [{"heading": one.heading, "unit": one.unit, "left": one.left} for one in block.columns]
        rows = [_row(row) for row in block.rows]
        return {"kind": "table", "title": block.title, "columns": columns, "rows": rows, "note": block.note}
    if isinstance(block, Words):
        return {"kind": "words", "title": block.title, "text": block.text, **_toned(block.tone)}
    if isinstance(block, Points):
        return {"kind": "points", "title": block.title, "items": list(block.items)}
    if isinstance(block, Listing):
        return {"kind": "listing", "title": block.title, "text": block.text}
    return _picture(block.figure)


def _row(row: Sequence[Cell]) -> list[dict[str, Any]]:
    return [{"text": one.text, "chip": one.chip, "formula": one.formula, **_toned(one.tone)} for one in row]


def _toned(tone: Tone) -> dict[str, str]:
    return {"tone": tone, "sign": SIGNS[tone]}


def _picture(figure: Figure) -> dict[str, Any]:
    said = {"title": figure.title, "sentence": figure.sentence, "source": figure.source}
    slim = all(
        panel.view is None and (not panel.equal or len(row.panels) > 1) for row in figure.rows for panel in row.panels
    )
    narrow = inline_svg(_of_width(figure, NARROW), fonts=FONTS) if slim else ""
    return {"kind": "picture", "drawing": inline_svg(_wide(figure), fonts=FONTS), "narrow": narrow, **said}


def _wide(figure: Figure) -> Figure:
    """Return a figure for the whole width: two or three panels of curves over the same stand side by side."""
    panels = [row.panels[0] for row in figure.rows]
    single = all(len(row.panels) == 1 and _curves(row) for row in figure.rows)
    if not single or not 1 < len(panels) <= 3 or any(one.x.title not in ("", panels[-1].x.title) for one in panels):
        return _of_width(figure, figure.width)
    if any(LETTER * breadth(one.heading) > WIDE / len(panels) - 0.4 for one in panels):
        return _of_width(figure, figure.width)
    along, middle = panels[-1].x, len(panels) // 2  # what they run over is said once, below the middle
    bare = [replace(one, x=replace(one.x, label="", unit="", dimension="")) for one in panels]
    named = replace(along, ticks=panels[middle].x.ticks, texts=panels[middle].x.texts)
    bare[middle] = replace(bare[middle], x=named)
    row = replace(figure.rows[0], panels=tuple(bare), height=max(row.height for row in figure.rows))
    return replace(figure, width=WIDE, rows=(row,))


def _of_width(figure: Figure, width: float) -> Figure:
    """Return a figure of a width: curves lower than on a screen, what has one scale to both sides as high as wide."""
    rows = (
        replace(row, height=row.height * (LOWER if _curves(row) else _scale(row, width / figure.width)))
        for row in figure.rows
    )
    return replace(figure, width=width, rows=tuple(_roomy(row, width) for row in rows))


def _roomy(row: Row, width: float) -> Row:
    """Return a row for a width: fewer ticks where their words would touch, and room for the words behind lying bars."""
    return replace(row, panels=tuple(_with_room(one, width / len(row.panels)) for one in row.panels))


def _with_room(panel: Panel, width: float) -> Panel:
    frame = width - 0.4 - LETTER * max(map(breadth, panel.y.texts), default=0.0)
    x = panel.x
    lying = [one for one in panel.series if isinstance(one, Bars) and one.lying and one.texts]
    for one in lying if not x.log else ():
        words = min(0.5, (LETTER * max(map(len, one.texts)) + 0.1) / frame)
        x = replace(x, high=max(x.high, float(np.max(one.ends, initial=0.0)) / (1.0 - words)))
    if not x.numeric or len(x.ticks) < 2:
        return replace(panel, x=x)
    gap = frame * float(np.min(np.diff(share(x, x.low, x.high, np.asarray(x.ticks)))))
    step = math.ceil((LETTER * max(map(breadth, x.texts)) + 0.06) / gap)
    return replace(panel, x=replace(x, ticks=x.ticks[::step], texts=x.texts[::step]))


def _curves(row: Row) -> bool:
    """Tell whether a row holds nothing but curves that may be as high as one likes."""
    lying = (isinstance(one, Bars) and one.lying for panel in row.panels for one in panel.series)
    return not any(lying) and not any(panel.equal or panel.view for panel in row.panels)


def _scale(row: Row, part: float) -> float:
    """Return how much of its height a row keeps that gets this part of its width."""
    return part if all(panel.equal for panel in row.panels) else 1.0
