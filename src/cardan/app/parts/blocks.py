"""Pages of the report as elements of the app: words and tables as they stand, figures as charts."""

from __future__ import annotations

import json
from array import array
from base64 import b64encode
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import nan
from typing import Any, TypeAlias

import nicegui.elements.plotly  # noqa: F401  registers the plotly.js that NiceGUI ships, as "nicegui-plotly"
from nicegui import ui
from nicegui.element import Element

from cardan.answers.palette import DARK
from cardan.figures.figure import Figure
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.report.block import Block, Cell, Listing, Page, Picture, Points, Table, Words
from cardan.texts import _

from .widgets import Live, escaped

Export: TypeAlias = Callable[[Figure | Page], object]  # what takes a figure or a page away from the app, into a file

BUTTONS = "(event) => { const one = event.target.closest('[data-do]'); if (one) emit(one.dataset.do); }"
"""Tells which button of a table was pressed."""


def words_html(block: Words) -> str:
    """Return a paragraph; with a tone a remark with its sign."""
    title = f"<h3>{escaped(block.title)}</h3>" if block.title else ""
    if block.tone == "plain":
        return f"{title}<p>{escaped(block.text)}</p>"
    sign = f'<span class="sign" aria-hidden="true">{block.sign}</span>'
    return f'{title}<p class="remark {block.tone}">{sign}{escaped(block.text)}</p>'


def points_html(block: Points) -> str:
    """Return a list of short remarks."""
    items = "".join(f"<li>{escaped(item)}</li>" for item in block.items)
    return f"<h3>{escaped(block.title)}</h3><ul>{items}</ul>"


def listing_html(block: Listing) -> str:
    """Return text as it stands in a file."""
    return f"<h3>{escaped(block.title)}</h3><pre>{escaped(block.text)}</pre>"


def cell_html(cell: Cell, *, left: bool, button: str = "") -> str:
    """Return a cell of a table: its tone as sign and colour, its number in full for whoever points at it.

    left: words, not a number; button: a button behind it, as HTML.
    """
    names = " ".join(filter(None, ["left" if left else "", "" if cell.tone == "plain" else cell.tone]))
    attributes = (f' class="{names}"' if names else "") + (f' title="{escaped(cell.full)}"' if cell.full else "")
    chip = f'<i class="chip" style="background:{escaped(cell.chip)}"></i>' if cell.chip else ""
    sign = f'<span class="sign" aria-hidden="true">{cell.sign}</span>' if cell.sign else ""
    return f"<td{attributes}>{chip}{sign}{escaped(cell.text)}{button}</td>"


def table_html(block: Table, buttons: Mapping[str, str] | None = None) -> str:
    """Return a table, its numbers to the right under headings with their units.

    buttons: first cell of a row, or heading of a column -> what its button says.
    """
    given = buttons or {}

    def button(name: str) -> str:
        if name not in given:
            return ""
        return f'<button type="button" class="apply" data-do="{escaped(name)}">{escaped(given[name])}</button>'

    heads = []
    for k, column in enumerate(block.columns):
        unit = f' <span class="unit">{escaped(column.unit)}</span>' if column.unit else ""
        side = ' class="left"' if column.left else ""
        heads.append(f'<th scope="col"{side}>{escaped(column.heading)}{unit}{button(column.heading) if k else ""}</th>')
    rows = []
    for row in block.rows:
        cells = [
            cell_html(cell, left=column.left, button=button(cell.text) if k == 0 else "")
            for k, (column, cell) in enumerate(zip(block.columns, row, strict=True))
        ]
        rows.append(f"<tr>{''.join(cells)}</tr>")
    title = f"<h3>{escaped(block.title)}</h3>" if block.title else ""
    note = f'<p class="small">{escaped(block.note)}</p>' if block.note else ""
    head, body = f"<thead><tr>{''.join(heads)}</tr></thead>", f"<tbody>{''.join(rows)}</tbody>"
    name = escaped(block.title or _("table"))
    table = f'<div class="wide" role="group" tabindex="0" aria-label="{name}"><table>{head}{body}</table></div>'
    return f"{title}{table}{note}"


def block_html(block: Block, buttons: Mapping[str, str] | None = None) -> str:
    """Return any block but a picture."""
    if isinstance(block, Table):
        return table_html(block, buttons)
    if isinstance(block, Words):
        return words_html(block)
    if isinstance(block, Points):
        return points_html(block)
    assert isinstance(block, Listing)
    return listing_html(block)


def drawn_in_space(figure: Figure) -> bool:
    """Return whether a figure is a drawing, with nothing to measure: it needs no chart."""
    return any(panel.view is not None for panel in figure.panels)


class Drawing:
    """A figure as it is printed."""

    def __init__(self, figure: Figure) -> None:
        self.element = Live(inline_svg(figure)).classes("drawing")

    def show(self, figure: Figure) -> None:
        """Show another figure in its place."""
        self.element.show(inline_svg(figure))


class Text:
    """Words or a table on the page."""

    def __init__(self, block: Block, buttons: Mapping[str, str], pressed: Callable[[str], object]) -> None:
        self.element = Live(block_html(block, buttons)).classes("block")
        self.element.on("click", lambda event: pressed(str(event.args)), js_handler=BUTTONS)

    def fits(self, block: Block) -> bool:
        """Whether a block can be shown in its place."""
        return not isinstance(block, Picture)

    def show(self, block: Block, buttons: Mapping[str, str]) -> None:
        """Show another block in its place."""
        self.element.show(block_html(block, buttons))


class Drawn:
    """A figure on the page, with its title, its sentence, and a button to take it along."""

    def __init__(self, block: Picture, export: Export | None) -> None:
        self.figure = block.figure
        with ui.element("figure").classes("block") as self.element:
            with ui.element("div").classes("heading"):
                self.title = Live(escaped(self.figure.title), tag="h3").classes("title")
                if export is not None:
                    button = ui.button(icon="download", on_click=lambda: export(self.figure))
                    button.props(f'flat dense round size=sm aria-label="{_("save this figure")}"').props(
                        'data-mark="save-figure"'
                    )
            self.picture = Drawing(self.figure) if drawn_in_space(self.figure) else Chart(self.figure)
            with ui.element("figcaption"):
                self.sentence = Live(escaped(self.figure.sentence))
                self.source = Live(escaped(self.figure.source)).classes("small")

    def fits(self, block: Block) -> bool:
        """Whether a block can be shown in its place: another state of the same figure."""
        return isinstance(block, Picture) and block.figure.name == self.figure.name

    def show(self, block: Block, _buttons: Mapping[str, str]) -> None:
        """Show another state of the figure."""
        assert isinstance(block, Picture)
        self.figure = block.figure
        self.picture.show(self.figure)
        self.title.say(self.figure.title)
        self.sentence.say(self.figure.sentence)
        self.source.say(self.figure.source)


class PageView:
    """A page of the report in the app; another state of it takes its place without a flicker.

    export: takes a figure or the page along; no buttons for it when not given.
    """

    def __init__(self, export: Export | None = None, pressed: Callable[[str], object] = lambda name: None) -> None:
        self._export = export
        self._pressed = pressed
        self.page: Page | None = None
        self._parts: list[Text | Drawn] = []
        with ui.element("article").classes("answer") as self.element:
            with ui.element("div").classes("heading"):
                self._answer = Live().classes("said").props("role=status").props('data-mark="answer"')
                if export is not None:
                    self._button = ui.button(icon="download", on_click=self._take)
                    self._button.props(f'flat dense round size=sm aria-label="{_("save this page")}"').props(
                        'data-mark="save-page"'
                    )
                    self._button.set_visibility(False)
            self._blocks = ui.element("div").classes("blocks")

    def show(self, page: Page, buttons: Mapping[str, str] | None = None) -> None:
        """Show a page, or another state of it.

        buttons: name -> what a button beside it says, in the first table that has such names.
        """
        self.page = page
        if self._export is not None:
            self._button.set_visibility(True)
        self._answer.say(page.answer)
        given = _placed(page.blocks, buttons or {})
        same = 0
        while same < min(len(self._parts), len(page.blocks)) and self._parts[same].fits(page.blocks[same]):
            self._parts[same].show(page.blocks[same], given[same])
            same += 1
        for part in self._parts[same:]:
            part.element.delete()
        del self._parts[same:]
        with self._blocks:
            for block, names in zip(page.blocks[same:], given[same:], strict=True):
                made = Drawn(block, self._export) if isinstance(block, Picture) else Text(block, names, self._pressed)
                self._parts.append(made)

    def _take(self) -> None:
        if self.page is not None and self._export is not None:
            self._export(self.page)


def _placed(blocks: Sequence[Block], buttons: Mapping[str, str]) -> list[Mapping[str, str]]:
    """Return the buttons of every block: all of them stand in the first table that has rows or columns so called."""
    given: list[Mapping[str, str]] = [{} for _block in blocks]
    for k, block in enumerate(blocks):
        if isinstance(block, Table) and any(
            name in buttons
            for name in (*(row[0].text for row in block.rows), *(one.heading for one in block.columns[1:]))
        ):
            given[k] = buttons
            break
    return given


# A figure as a chart to point at and to zoom, updated in place.


class Chart(Element, component="chart.js", esm={"cardan-charts": "charts"}):
    """A figure that can be pointed at.

    Curves over the input angle show where the drive stands: the window's event ``cardan-angle`` with ``detail.angle``
    [rad] moves their cursor, and pressing on them sends ``cardan-go-to``. The server has no part in it.
    """

    def __init__(self, figure: Figure) -> None:
        super().__init__()
        # Within a tuple NiceGUI does not watch every number of it, which takes longer than the motion of the drive.
        self._props.update(dark=DARK, words=_buttons(), label=figure.spoken, spec=(described(figure),))

    def show(self, figure: Figure) -> None:
        """Show another figure in its place; what the user zoomed stays zoomed."""
        spec, label = described(figure), figure.spoken
        change = changed(self._props["spec"][0], spec)
        if not change and label == self._props["label"]:
            return
        with self._props.suspend_updates():
            self._props.update(spec=(spec,), label=label)
        self.run_method("change", json.dumps({"label": label, **change}, ensure_ascii=False, separators=(",", ":")))


def _buttons() -> dict[str, str]:
    """Return what the buttons of a chart say, by the words of plotly."""
    return {
        "Zoom": _("zoom"),
        "Pan": _("move"),
        "Zoom in": _("zoom in"),
        "Zoom out": _("zoom out"),
        "Reset axes": _("show all of it"),
    }


def changed(before: Mapping[str, Any], after: Mapping[str, Any]) -> dict[str, Any]:
    """Return what turns a described figure into another one.

    before, after: as `cardan.figures.render_plotly.described` gives them.
    Returns: ``heights``: place of a curve -> its values as base 64 of their bytes, where nothing but these differs in
    the data; else ``data``. ``layout`` where that differs.
    """
    change: dict[str, Any] = {} if before["layout"] == after["layout"] else {"layout": after["layout"]}
    old, new = before["data"], after["data"]
    if len(old) == len(new) and all(_same_but_height(*pair) for pair in zip(old, new, strict=True)):
        heights = {k: _bytes(now["y"]) for k, now in enumerate(new) if now != old[k]}
        return change | ({"heights": heights} if heights else {})
    return change | {"data": new}


def _same_but_height(old: Mapping[str, Any], new: Mapping[str, Any]) -> bool:
    """Return whether two traces are the same curve but for its values."""
    return old == new or (new.get("mode") == "lines" and {**old, "y": ()} == {**new, "y": ()})


def _bytes(values: Iterable[float | None]) -> str:
    """Return numbers as they are in a machine, the missing ones as NaN: shorter than as text, and sooner read."""
    return b64encode(array("d", (nan if value is None else value for value in values)).tobytes()).decode()
