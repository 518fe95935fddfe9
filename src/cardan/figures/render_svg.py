"""Draws any figure as SVG: words stay words, and every length is a whole number of hundredths of a point."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from html import escape
from typing import Any

import numpy as np

from cardan.answers import palette
from cardan.maths.arrays import Array

from .figure import Axis, Band, Bars, Cells, Curve, Figure, Mesh, Note, Panel, Rule, Series, Shape
from .page import LETTER, LINE, Box, Entry, Label, Page, breadth, facets, labels, laid_out, onto, ranges, share

FONTS = "'Inter', 'Segoe UI', 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif"
"""Fonts of the words: that of the page they stand in, the widest one last, for which room is left."""

INCH, POINT = 7200.0, 100.0
BOLD = 1.1  # how much wider than other letters those of headings are
"""Inch and point in the unit of the drawing."""

FAR = 1e6
"""Nothing is drawn farther away than this; a viewer works with some seven digits."""

RIM = "paint-order:stroke;stroke:#fff;stroke-width:240px;stroke-linejoin:round"
"""Style of words over lines."""

DASHES = {"dashed": (5.0, 2.0), "dotted": (1.2, 1.6), "dashdot": (7.0, 2.0, 1.3, 2.0)}
"""Strokes and gaps of a line over its width."""

ANCHORS = {"left": "", "centre": ' text-anchor="middle"', "right": ' text-anchor="end"'}

LEVELS = {"top": 0.76, "middle": 0.26, "bottom": -0.24, "line": 0.38}
"""How far below its place the line of a word stands, over its size; ``line`` has capitals in the middle."""

SHADES = 48
"""Colours that cells are drawn in."""

HEAD = (2.8, 1.4)
"""Length and half width of an arrowhead [pt]."""

Line = Callable[[Array], Array]


def inline_svg(figure: Figure, *, fonts: str = FONTS) -> str:
    """Return a figure as an SVG element for a page, without its title and sentence.

    fonts: fonts of its words, the first that there is.
    """
    page = laid_out(figure, words=False)
    label = escape(figure.spoken)
    head = f'{_head(page.width, page.height, fonts)} role="img" aria-label="{label}"'
    return f"<svg {head}>{_drawn(page, figure.name)}</svg>"


def document(figures: Sequence[Figure]) -> str:
    """Return figures with their titles and sentences as an SVG file, one below the other."""
    pages = [laid_out(figure, words=True) for figure in figures]
    width, height = max(page.width for page in pages), sum(page.height for page in pages)
    parts, top = [], 0.0
    for k, (page, figure) in enumerate(zip(pages, figures, strict=True)):
        parts.append(f'<g transform="translate(0 {_of(INCH * top)})">{_drawn(page, f"{figure.name}-{k}")}</g>')
        top += page.height
    size = f'width="{72.0 * width:.2f}pt" height="{72.0 * height:.2f}pt"'
    paper = f'<rect width="{_of(INCH * width)}" height="{_of(INCH * height)}" fill="#fff"/>'
    start = '<?xml version="1.0" encoding="utf-8"?>\n'
    return f"{start}<svg {size} {_head(width, height)}>{paper}{''.join(parts)}</svg>\n"


def _head(width: float, height: float, fonts: str = FONTS) -> str:
    box = f"0 0 {_of(INCH * width)} {_of(INCH * height)}"
    return f'xmlns="http://www.w3.org/2000/svg" viewBox="{box}" font-family="{fonts}"'


def _of(length: float) -> str:
    return str(round(length))


def _drawn(page: Page, name: str) -> str:
    """Return everything on a page; ids begin with a name."""
    parts = []
    for k, line in enumerate(page.heading):
        parts.append(_word(line, 0.1 * INCH, (0.08 + 0.24 * k) * INCH, 11.5, "ink", level="top", bold=True))
    for k, line in enumerate(page.caption):
        parts.append(_word(line, 0.1 * INCH, (page.caption_top + 0.165 * k) * INCH, 8.2, "muted", level="top"))
    for k, (panel, box) in enumerate(page.panels):
        parts += _Plot(panel, box, f"{name}-{k}").parts()
    for entry in page.legend:
        parts += _entry(entry)
    return "".join(parts)


def _word(
    text: str,
    x: float,
    y: float,
    size: float,
    role: str,
    *,
    side: str = "left",
    level: str = "middle",
    bold: bool = False,
    rim: bool = False,
) -> str:
    """Return a word; its lines one below the other."""
    lines = text.replace("  ", "\u00a0\u00a0").split("\n")  # a viewer draws blanks in a row as one
    step = 1.2 * size * POINT
    above = {"top": 0.0, "bottom": 1.0}.get(level, 0.5) * step * (len(lines) - 1)
    how = f'font-size="{_of(size * POINT)}" fill="{palette.colour(role)}"{ANCHORS[side]}'
    how += ' font-weight="bold"' * bold + f' style="{RIM}"' * rim
    first = y - above + LEVELS[level] * size * POINT
    return "".join(
        f'<text x="{_of(x)}" y="{_of(first + k * step)}" {how}>{escape(line)}</text>' for k, line in enumerate(lines)
    )


def _pen(role: str, width: float, dash: str = "solid") -> str:
    """Return the attributes of a line."""
    pen = f'fill="none" stroke="{palette.colour(role)}" stroke-width="{_of(width * POINT)}"'
    if dash == "solid":
        return pen + ' stroke-linecap="round" stroke-linejoin="round"'
    gaps = " ".join(_of(one * width * POINT) for one in DASHES[dash])
    return f'{pen} stroke-dasharray="{gaps}"'


def _course(x: Array, y: Array) -> str:
    """Return the path through points, interrupted where one is not known."""
    known = np.isfinite(x) & np.isfinite(y)
    places = np.where(known[:, None], np.clip(np.stack((x, y), axis=-1), -FAR, FAR), 0.0).round().astype(int)
    path: list[str] = []
    for run in np.split(np.arange(len(known)), np.flatnonzero(np.diff(known)) + 1):
        if not len(run) or not known[run[0]]:
            continue
        first, steps = places[run[0]], np.diff(places[run], axis=0)
        moved = steps[np.any(steps != 0, axis=-1)]
        path.append(f"M{first[0]} {first[1]}l" + " ".join(map(str, moved.ravel().tolist() or (0, 0))))
    return "".join(path)


def _polygon(x: Array, y: Array, how: str) -> str:
    return f'<path d="{_course(x, y)}z" {how}/>'


def _rectangle(x: float, y: float, width: float, height: float, how: str) -> str:
    """Return a rectangle; sizes below nought reach the other way."""
    left, top = min(x, x + width), min(y, y + height)
    return f'<rect x="{_of(left)}" y="{_of(top)}" width="{_of(abs(width))}" height="{_of(abs(height))}" {how}/>'


def _entry(entry: Entry) -> Iterator[str]:
    """Yield the sign and the words of an entry of the legend."""
    item, left, top = entry.item, entry.left * INCH, entry.top * INCH
    wide = 0.26 * INCH
    if isinstance(item, Curve):
        if item.width:
            yield f'<path d="M{_of(left)} {_of(top)}h{_of(wide)}" {_pen(item.role, max(item.width, 1.3), item.dash)}/>'
        if item.marker:
            yield _dots(np.asarray([left + 0.5 * wide]), np.asarray([top]), item.role, min(item.marker, 5.0))
    else:
        role = item.roles[0] if isinstance(item, Bars) else item.role
        seen = f' fill-opacity="{item.opacity:g}"' if isinstance(item, Shape) else ""
        how = f'fill="{palette.colour(role)}"{seen}'
        yield _rectangle(left, top - 0.045 * INCH, wide, 0.09 * INCH, how)
    yield _word(item.label, left + 0.34 * INCH, top, 8.2, "ink", level="line")


def _dots(x: Array, y: Array, role: str, size: float) -> str:
    """Return dots: strokes of hardly any length with round ends."""
    known = np.isfinite(x) & np.isfinite(y) & (np.abs(x) < FAR) & (np.abs(y) < FAR)
    path = "".join(f"M{_of(a)} {_of(b)}h1" for a, b in zip(x[known].tolist(), y[known].tolist(), strict=True))
    return f'<path d="{path}" {_pen(role, size)}/>'


class _Plot:
    """One panel in its frame."""

    def __init__(self, panel: Panel, box: Box, name: str) -> None:
        self.panel, self.name = panel, name
        self.left, self.top = INCH * box.left, INCH * box.top
        self.width, self.height = INCH * box.width, INCH * box.height
        x, y = ranges(panel, box)
        self.x = _scale(panel.x, *x, self.left, self.width)
        self.y = _scale(panel.y, *y, self.top + self.height, -self.height)
        self.labels = labels(panel, box)

    def parts(self) -> list[str]:
        """Return what is drawn, from the back: grid, bands, rules, solids, series, words."""
        behind: list[str] = []
        front: list[str] = []
        words: list[str] = []
        for kind in (Band, Rule):
            for k, item in enumerate(self.panel.series):
                if isinstance(item, kind):
                    behind.append(self._line(item))
                    words += self._line_text(item, self.labels.get(k, Label()))
        meshes = [item for item in self.panel.series if isinstance(item, Mesh)]
        if meshes and self.panel.view is not None:
            behind += self._solids(meshes)
        for item in self.panel.series:
            front += self._series(item)
            words += self._words(item)
        clip = f"{self.name}-frame"
        inside = _rectangle(self.left, self.top, self.width, self.height, "")
        drawn = "".join(behind + front)
        if drawn:
            drawn = f'<clipPath id="{clip}">{inside}</clipPath><g clip-path="url(#{clip})">{drawn}</g>'
        return [*self._frame(), drawn, *self._heads(), *words]

    def _frame(self) -> Iterator[str]:
        """Yield grid, line at the bottom, ticks and titles."""
        panel, bottom = self.panel, self.top + self.height
        if panel.heading:
            over = BOLD * LETTER * breadth(panel.heading) * INCH > self.width  # it goes on to the left, over the names
            place = self.left + (self.width if over else 0.0), self.top - 6.0 * POINT
            side = "right" if over else "left"
            yield _word(panel.heading, *place, 8.4, "ink", side=side, level="bottom", bold=True)
        if panel.bare:
            return
        for text, at in _ticks(panel.x, self.x, self.left, self.width):
            if panel.x.grid:
                yield f'<path d="M{_of(at)} {_of(self.top)}v{_of(self.height)}" {_pen("grid", 0.7)}/>'
            yield _word(text, at, bottom + 3.0 * POINT, 7.6, "muted", side="centre", level="top")
        for text, at in _ticks(panel.y, self.y, bottom, -self.height):
            if panel.y.grid:
                yield f'<path d="M{_of(self.left)} {_of(at)}h{_of(self.width)}" {_pen("grid", 0.7)}/>'
            yield _word(text, self.left - 3.0 * POINT, at, 7.6, "muted", side="right", level="line")
        yield f'<path d="M{_of(self.left)} {_of(bottom)}h{_of(self.width)}" {_pen("faint", 0.9)}/>'
        if panel.x.title:
            down = (5.0 + (7.6 if panel.x.texts else 0.0)) * POINT
            middle = self.left + 0.5 * self.width
            yield _word(panel.x.title, middle, bottom + down, 8.0, "muted", side="centre", level="top")

    def _flat(self, item: Curve | Note) -> tuple[Array, Array]:
        """Return points on paper, in the unit of the drawing."""
        x, y, z = item.x, item.y, item.z
        if self.panel.view is not None and z is not None:
            seen = onto(self.panel.view, np.stack(np.broadcast_arrays(x, y, z), axis=-1))
            x, y = seen[..., 0], seen[..., 1]
        return self.x(np.asarray(x, dtype=float)), self.y(np.asarray(y, dtype=float))

    def _solids(self, meshes: Sequence[Mesh]) -> Iterator[str]:
        for facet in facets(self.panel.view, meshes):  # type: ignore[arg-type]
            how = f'fill="{facet.fill}" stroke="{facet.edge}" stroke-width="35"'
            yield _polygon(self.x(facet.corners[:, 0]), self.y(facet.corners[:, 1]), how)

    def _series(self, item: Series) -> Iterator[str]:
        """Yield what is drawn of a series within the frame."""
        if isinstance(item, Curve):
            x, y = self._flat(item)
            if item.width:
                yield f'<path d="{_course(x, y)}" {_pen(item.role, item.width, item.dash)}/>'
            if item.marker:
                yield _dots(x, y, item.role, item.marker)
        elif isinstance(item, Shape):
            x, y = self.x(np.asarray(item.x, dtype=float)), self.y(np.asarray(item.y, dtype=float))
            yield _polygon(x, y, f'fill="{palette.colour(item.role)}" fill-opacity="{item.opacity:g}"')
            if item.outline:
                yield _polygon(x, y, _pen(item.role, item.outline))
        elif isinstance(item, Cells):
            yield from self._cells(item)
        elif isinstance(item, Bars):
            for k, (at, size) in enumerate(zip(item.at, item.ends, strict=True)):
                how = f'fill="{palette.colour(item.roles[k % len(item.roles)])}"'
                along, across = (self.x, self.y) if item.lying else (self.y, self.x)
                start, stop = _one(along, item.base), _one(along, size)
                edge, other = _one(across, at - 0.5 * item.thick), _one(across, at + 0.5 * item.thick)
                if item.lying:
                    yield _rectangle(start, edge, stop - start, other - edge, how)
                else:
                    yield _rectangle(edge, start, other - edge, stop - start, how)

    def _cells(self, item: Cells) -> Iterator[str]:
        """Yield one path for each shade; cells of one shade side by side are one rectangle."""
        x, y = (
            line(np.asarray(edges, dtype=float)).round().astype(int)
            for line, edges in ((self.x, item.x), (self.y, item.y))
        )
        shade = np.where(np.isfinite(item.values), np.rint(np.nan_to_num(item.share) * (SHADES - 1)), -1).astype(int)
        paths: dict[int, list[str]] = {}
        for k, row in enumerate(shade):
            ends = np.flatnonzero(np.diff(row)) + 1
            for first, last in zip([0, *ends], [*ends, len(row)], strict=True):
                if row[first] >= 0:
                    wide, high = x[last] - x[first], y[k + 1] - y[k]
                    paths.setdefault(int(row[first]), []).append(f"M{x[first]} {y[k]}h{wide}v{high}h{-wide}z")
        for place, parts in sorted(paths.items()):
            tint = palette.scale(place / (SHADES - 1))
            yield f'<path d="{"".join(parts)}" fill="{tint}" shape-rendering="crispEdges"/>'

    def _line(self, item: Band | Rule) -> str:
        along = self.x if item.upright else self.y
        if isinstance(item, Rule):
            at = _of(_one(along, item.value))
            path = f"M{at} {_of(self.top)}v{_of(self.height)}"
            if not item.upright:
                path = f"M{_of(self.left)} {at}h{_of(self.width)}"
            return f'<path d="{path}" {_pen(item.role, item.width, item.dash)}/>'
        low, high = _one(along, item.low), _one(along, item.high)
        how = f'fill="{palette.colour(item.role)}" fill-opacity="{item.opacity:g}"'
        if item.upright:
            return _rectangle(low, self.top, high - low, self.height, how)
        return _rectangle(self.left, high, self.width, low - high, how)

    def _line_text(self, item: Band | Rule, label: Label) -> Iterator[str]:
        value = item.value if isinstance(item, Rule) else item.high
        if item.text and item.upright:
            x, y = _one(self.x, value), self.top + POINT + label.line * LINE * INCH
            side, away = ("right", -3.0) if label.before else ("left", 3.0)
            yield _word(item.text, x + away * POINT, y, 7.4, item.role, side=side, level="top", rim=True)
        elif item.text:
            x, y = self.left + self.width - 2.0 * POINT, _one(self.y, value) - 2.0 * POINT
            yield _word(item.text, x, y, 7.4, item.role, side="right", level="bottom", rim=True)

    def _words(self, item: Series) -> Iterator[str]:
        """Yield the words of a series; they may stand out of the frame."""
        if isinstance(item, Note):
            x, y = (float(one) for one in self._flat(item))
            place = x + item.shift[0] * POINT, y - item.shift[1] * POINT
            how: dict[str, Any] = {"side": item.side, "level": item.level, "bold": item.bold, "rim": item.halo}
            yield _word(item.text, *place, item.size, item.role, **how)
        elif isinstance(item, Bars):
            for at, size, text in zip(item.at, item.ends, item.texts, strict=False):
                place, how = (_one(self.x, size) + 4.0 * POINT, _one(self.y, at)), {"level": "line"}
                if not item.lying:
                    place = _one(self.x, at), _one(self.y, size) - 2.5 * POINT
                    how = {"side": "centre", "level": "bottom"}
                yield _word(text, *place, 7.6, "ink", rim=True, **how)

    def _heads(self) -> Iterator[str]:
        """Yield arrowheads; one beyond the frame is left out."""
        for item in self.panel.series:
            if not isinstance(item, Curve) or not item.arrow or len(item.x) < 2:
                continue
            x, y = self._flat(item)
            tip = np.asarray([x[-1], y[-1]])
            way = tip - [x[-2], y[-2]]
            length = float(np.hypot(*way))
            right, down = tip[0] - self.left, tip[1] - self.top
            if not length or not (0.0 <= right <= self.width and 0.0 <= down <= self.height):
                continue
            back = POINT * HEAD[0] * way / length
            side = POINT * HEAD[1] * np.asarray([-way[1], way[0]]) / length
            corners = np.stack((tip, tip - back + side, tip - back - side))
            yield _polygon(corners[:, 0], corners[:, 1], f'fill="{palette.colour(item.role)}"')


def _scale(axis: Axis, low: float, high: float, start: float, length: float) -> Line:
    """Return where values of an axis stand: ``low`` at the start, ``high`` a length farther."""
    return lambda values: start + length * share(axis, low, high, values)


def _one(line: Line, value: float) -> float:
    return float(np.clip(line(np.asarray(value, dtype=float)), -FAR, FAR))


def _ticks(axis: Axis, line: Line, start: float, length: float) -> Iterator[tuple[str, float]]:
    """Yield words and place of every tick within the range."""
    for value, text in zip(axis.ticks, axis.texts or [""] * len(axis.ticks), strict=True):
        at = _one(line, value)
        if -1e-6 <= (at - start) / length <= 1.0 + 1e-6:
            yield text, at
