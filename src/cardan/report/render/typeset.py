"""The report as a PDF: its content as data, set by Typst from ``templates/report.typ``.

The template never takes text for code: names and notes reach it as the strings of a JSON file, whatever stands in them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from cardan.figures.figure import Figure
from cardan.figures.render_svg import inline_svg
from cardan.later import later
from cardan.report.block import SIGNS, Block, Cell, Listing, Page, Points, Table, Tone, Words
from cardan.report.content import Content, Excerpt
from cardan.report.title_block import Head, Logo
from cardan.texts import _, language, mark

typst = later("typst", mark("an SVG logo in a workbook needs typst: pip install 'cardan[pdf]', or give a PNG"))
matplotlib = later("matplotlib")

TEMPLATE = Path(__file__).parent / "templates" / "report.typ"

FONTS = "'DejaVu Sans'"  # font of the words in figures: matplotlib brings it wherever cardan is installed
STANDARD: Final = "ua-1"  # the PDF can be read aloud: tagged, with words for every picture


ALONE: Final = b"""#set page(width: auto, height: auto, margin: 0pt, fill: none)
#image(bytes(json(bytes(sys.inputs.logo))), height: 2cm)"""  # a page that is nothing but a logo

UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\ufeff\ufffe\uffff]")
"""Marks of control, halves of characters and what is none."""


def written(content: Content) -> bytes:
    """Return a report as a PDF file."""
    return _set(as_data(content))


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
        }
    )


def _set(data: dict[str, Any]) -> bytes:
    """Return what the template makes of its data."""
    found, _warnings = (
        typst()
        .Compiler(
            TEMPLATE,
            root=TEMPLATE.parent,
            font_paths=[Path(matplotlib().get_data_path()) / "fonts" / "ttf"],
            sys_inputs={"report": json.dumps(_printable(data), ensure_ascii=False)},
        )
        .compile_with_warnings(format="pdf", pdf_standards=[STANDARD])
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
    return [_printable(value) for value in data] if isinstance(data, list) else data


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
    return {"kind": "picture", "drawing": inline_svg(figure, fonts=FONTS), **said}
