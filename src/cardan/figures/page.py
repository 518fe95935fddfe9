"""Where everything stands on the page: the same for every renderer. Lengths in inches, from the top left."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.answers.palette import colour, mixed
from cardan.maths.arrays import Array

from .figure import Axis, Band, Bars, Curve, Figure, Mesh, Panel, Row, Rule, Shape, View

LETTER = 0.066
"""Width of an average letter of 8.5 pt."""

TICK_LETTER = 0.059
"""Width of an average letter of ticks and of the texts of bars."""

RULE_LETTER = 0.055
"""Width of an average letter beside a rule."""

GAP = 0.12
"""Free to the right of each panel."""

BROADER = 0.2
"""By how much a Cyrillic letter is wider than an average Latin one, in the usual fonts."""

LINE = 0.13
"""Height of a line of such words."""


@dataclass(frozen=True, kw_only=True)
class Box:
    """A rectangle on the page."""

    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Entry:
    """An entry of the legend and where its sign begins."""

    item: Curve | Bars | Shape
    left: float
    top: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Page:
    """A laid-out figure."""

    width: float  # width, height: size of the whole
    height: float
    panels: tuple[tuple[Panel, Box], ...]  # where the frames of the panels stand
    legend: tuple[Entry, ...]  # where the legend's entries begin
    # heading, caption: lines of the title, and of the sentence with its source; empty when the figure stands in a page
    # that has them
    heading: tuple[str, ...]
    caption: tuple[str, ...]
    caption_top: float  # where the caption begins


def laid_out(figure: Figure, *, words: bool) -> Page:
    """Return where the parts of a figure stand. words: draw title, sentence and source too: in a file of its own."""
    letters = int((figure.width - 0.2) / (0.87 * LETTER))
    heading = _lines(figure.title, 0.66 * letters) if words else ()
    top = 0.08 + 0.24 * len(heading)
    legend, top = _legend(figure, top)
    panels: list[tuple[Panel, Box]] = []
    rooms = _rooms(figure)
    ends = _ends(figure, rooms)
    for index, row in enumerate(figure.rows):
        above = 0.28 if any(panel.heading for panel in row.panels) else 0.06
        marked = any(not panel.bare and panel.x.texts for panel in row.panels)
        named = any(not panel.bare and panel.x.title for panel in row.panels)
        below = (0.24 if marked else 0.06) + (0.2 if named else 0.0)
        top += above
        boxes = _across(figure.width - ends[len(row.panels)], rooms[len(row.panels)], row, top)
        panels += zip(row.panels, boxes, strict=True)
        top += row.height + below + (0.06 if index + 1 < len(figure.rows) else 0.0)
    caption: tuple[str, ...] = ()
    place = top + 0.1
    if words:
        caption = (*_lines(figure.sentence, letters), *_lines(figure.source, letters))
        top = place + 0.165 * len(caption) + 0.06
    return Page(
        width=figure.width,
        height=top + 0.03,
        panels=tuple(panels),
        legend=legend,
        heading=heading,
        caption=caption,
        caption_top=place,
    )


def breadth(text: str) -> float:
    """Return how many average Latin letters are as wide as a text.

    >>> breadth("joint"), breadth("вал 2")
    (5.0, 5.6)
    """
    return len(text) + BROADER * sum("\u0400" <= letter <= "\u04ff" for letter in text)


def _lines(text: str, letters: float) -> tuple[str, ...]:
    """Return a text in lines as wide as so many average Latin letters."""
    return tuple(textwrap.wrap(text, int(letters * len(text) / breadth(text)))) if text else ()


def ranges(panel: Panel, box: Box) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the ranges of a panel's axes, widened about their middles where both have the same scale."""
    x, y = (panel.x.low, panel.x.high), (panel.y.low, panel.y.high)
    if not panel.equal:
        return x, y
    scale = min(box.width / (x[1] - x[0]), box.height / (y[1] - y[0]))

    def about(span: tuple[float, float], size: float) -> tuple[float, float]:
        middle, half = 0.5 * (span[0] + span[1]), 0.5 * size / scale
        return middle - half, middle + half

    return about(x, box.width), about(y, box.height)


def share(axis: Axis, low: float, high: float, values: Array) -> Array:
    """Return where values stand along an axis: 0 at ``low``, 1 at ``high``."""
    if not axis.log:
        return (values - low) / (high - low)
    first, last = np.log(low), np.log(high)
    found: Array = (np.log(np.maximum(values, 1e-300)) - first) / (last - first)
    return found


@dataclass(frozen=True, kw_only=True)
class Label:
    """Where the words of an upright rule or band stand."""

    line: int = 0  # in which line from the top of the frame, so that words side by side do not run into each other
    before: bool = False  # to the left of the rule, where the frame has no room to its right


def labels(panel: Panel, box: Box) -> dict[int, Label]:
    """Return where the words of upright rules and bands stand, by their place in the panel's series."""
    low, high = ranges(panel, box)[0]
    spans = []
    for k, item in enumerate(panel.series):
        if isinstance(item, Rule | Band) and item.upright and item.text:
            value = item.value if isinstance(item, Rule) else item.high
            at, wide = box.width * float(share(panel.x, low, high, np.asarray(value))), RULE_LETTER * breadth(item.text)
            before = at + wide > box.width + 0.1 and at > wide
            spans.append((at - wide if before else at, wide, k, before))
    found: dict[int, Label] = {}
    ends: list[float] = []
    for start, wide, k, before in sorted(spans):
        line = next((n for n, end in enumerate(ends) if end < start), len(ends))
        ends[line : line + 1] = [start + wide]
        found[k] = Label(line=line, before=before)
    return found


def _rooms(figure: Figure) -> dict[int, list[float]]:
    """Return what ticks need to the left of each column, by the number of columns: frames below each other align."""
    rooms: dict[int, list[float]] = {}
    for row in figure.rows:
        known = rooms.setdefault(len(row.panels), [0.1] * len(row.panels))
        for k, panel in enumerate(row.panels):
            if not panel.bare:
                known[k] = max(known[k], 0.16 + 0.068 * max(map(len, panel.y.texts), default=0))
    return rooms


def _ends(figure: Figure, rooms: dict[int, list[float]]) -> dict[int, float]:
    """Return what words at the right end need beyond it, by the number of columns: a last tick, the text of a bar."""
    ends: dict[int, float] = {}
    for row in figure.rows:
        panel, count = row.panels[-1], len(row.panels)
        wide = _across(figure.width, rooms[count], row, 0.0)[-1].width
        need = [(reach - (1.0 - at) * wide - GAP) / max(at, 0.5) for at, reach in _words_at(panel)]
        ends[count] = max([ends.get(count, 0.0), *need])
    return ends


def _words_at(panel: Panel) -> Iterator[tuple[float, float]]:
    """Yield where words of a panel stand, as a share of its width, and how far they reach to the right from there."""
    if panel.bare or panel.equal or panel.view is not None:
        return
    low, high = panel.x.low, panel.x.high
    for tick, text in zip(panel.x.ticks, panel.x.texts, strict=False):
        yield float(share(panel.x, low, high, np.asarray(tick))), 0.03 + 0.5 * TICK_LETTER * breadth(text)
    for bars in panel.series:
        if isinstance(bars, Bars) and bars.lying:
            for end, text in zip(bars.ends, bars.texts, strict=False):
                yield float(share(panel.x, low, high, end)), 0.11 + TICK_LETTER * breadth(str(text))


def _across(width: float, room: Sequence[float], row: Row, top: float) -> list[Box]:
    """Return the frames of a row."""
    shares = row.widths or [1.0] * len(row.panels)
    free = width - GAP * len(row.panels) - 0.06 - sum(room)
    boxes, left = [], 0.06
    for part, need in zip(shares, room, strict=True):
        wide = free * part / sum(shares)
        boxes.append(Box(left=left + need, top=top, width=wide, height=row.height))
        left += need + wide + GAP
    return boxes


def _legend(figure: Figure, top: float) -> tuple[tuple[Entry, ...], float]:
    entries = figure.entries if figure.legend else ()
    placed, left, line = [], 0.1, top
    for item in entries:
        need = 0.36 + LETTER * breadth(item.label) + 0.12
        if left + need > figure.width and left > 0.1:
            left, line = 0.1, line + 0.19
        placed.append(Entry(item=item, left=left, top=line + 0.09))
        left += need
    return tuple(placed), (line + 0.19 if entries else top)


# Space on paper: faces of solids seen from one side, the farther ones first.

LIGHT = np.asarray([0.35, 0.5, 0.79])
"""Direction of the light in the eye's frame: right, up, toward the eye."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Facet:
    """A face on paper."""

    corners: Array  # (m, 2)
    fill: str  # fill, edge: colours
    edge: str


def onto(view: View, points: Array) -> Array:
    """Return points (..., 3) as seen: right, up, toward the eye; array (..., 3)."""
    frame = np.asarray([view.right, view.up, view.toward])
    return np.asarray(points, dtype=float) @ frame.T


def facets(view: View, meshes: Sequence[Mesh]) -> list[Facet]:
    """Return the faces turned to the eye, the farthest first."""
    found: list[tuple[float, Facet]] = []
    for mesh in meshes:
        seen = onto(view, mesh.corners)
        size = float(np.max(np.ptp(seen, axis=0))) or 1.0
        base = mixed(colour(mesh.role), "#ffffff", mesh.shade)
        for face in mesh.faces:
            corners = seen[list(face)]
            normal = _normal(corners)
            length = float(np.linalg.norm(normal))
            if normal[2] <= 1e-6 * length or length <= 1e-12 * size * size:
                continue
            shine = float(LIGHT @ normal) / length
            fill = mixed(base, "#ffffff", 0.35 * max(0.0, shine)) if shine > 0.0 else mixed(base, "#000000", 0.12)
            edge = fill if mesh.smooth else mixed(base, "#10141c", 0.45)
            depth = float(np.mean(corners[:, 2]))
            found.append((depth, Facet(corners=corners[:, :2], fill=fill, edge=edge)))
    return [facet for _depth, facet in sorted(found, key=lambda pair: pair[0])]


def _normal(corners: Array) -> Array:
    """Return twice the area vector of a flat polygon; right for concave ones too."""
    after = np.roll(corners, -1, axis=0)
    return np.sum(np.cross(corners, after), axis=0)
