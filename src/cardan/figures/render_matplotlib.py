"""Draws any figure with matplotlib: PNG, PDF."""

from __future__ import annotations

from collections.abc import Sequence
from typing import IO, Any, Literal, TypeAlias

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure as Canvas
from matplotlib.patheffects import withStroke
from matplotlib.ticker import NullLocator

from cardan.answers import palette

from .figure import Axis, Band, Bars, Cells, Curve, Figure, Mesh, Note, Panel, Rule, Series, Shape
from .page import LINE, Box, Entry, Label, Page, facets, labels, laid_out, onto, ranges

Format: TypeAlias = Literal["png", "pdf"]

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "pdf.fonttype": 42,
    "axes.unicode_minus": True,
    "path.simplify": True,
    "path.simplify_threshold": 0.2,
    "lines.solid_capstyle": "round",
    "lines.solid_joinstyle": "round",
}
_LINES: dict[str, Any] = {
    "solid": "-",
    "dashed": (0, (5, 2)),
    "dotted": (0, (1.2, 1.6)),
    "dashdot": (0, (7, 2, 1.3, 2)),
}
_SIDES = {"left": "left", "centre": "center", "right": "right"}
_LEVELS = {"top": "top", "middle": "center", "bottom": "bottom"}
OVER: dict[str, Any] = {"path_effects": [withStroke(linewidth=2.4, foreground="white")], "zorder": 6.0}
"""Words over lines: with a white rim, in front."""


def render(
    figures: Figure | Sequence[Figure], target: IO[bytes], format: Format, *, dpi: float = 160.0, words: bool = True
) -> None:
    """Draw figures, one below the other, in a PDF one a page.

    target: where the picture goes; format: kind of picture; dpi: dots per inch of a PNG.
    words: with title, sentence and source: in a file of its own.
    """
    several = (figures,) if isinstance(figures, Figure) else tuple(figures)
    pages = [laid_out(figure, words=words) for figure in several]
    with rc_context(STYLE):  # type: ignore[arg-type]
        if format == "pdf":
            _pdf(pages, several, target)
            return
        canvas = _canvas(max(p.width for p in pages), sum(p.height for p in pages))
        top = 0.0
        for page in pages:
            _draw(canvas, page, top)
            top += page.height
        canvas.savefig(target, format=format, dpi=dpi, metadata={"Software": "cardan"}, facecolor="white")


def _pdf(pages: Sequence[Page], figures: Sequence[Figure], target: IO[bytes]) -> None:
    metadata = {"Creator": "cardan", "Title": figures[0].title, "CreationDate": None}
    with PdfPages(target, metadata=metadata) as book:
        for page in pages:
            canvas = _canvas(page.width, page.height)
            _draw(canvas, page, 0.0)
            book.savefig(canvas)


def _canvas(width: float, height: float) -> Canvas:
    return Canvas(figsize=(width, height))


def _draw(canvas: Canvas, page: Page, down: float) -> None:
    """Draw a laid-out figure, its top ``down`` inches below that of the canvas."""
    wide, high = canvas.get_size_inches()

    def words(left: float, top: float, text: str, **how: Any) -> None:
        canvas.text(left / wide, 1.0 - (down + top) / high, text, va="top", **how)

    for k, line in enumerate(page.heading):
        words(0.1, 0.08 + 0.24 * k, line, fontsize=11.5, fontweight="bold", color=palette.colour("ink"))
    for k, line in enumerate(page.caption):
        words(0.1, page.caption_top + 0.165 * k, line, fontsize=8.2, color=palette.colour("muted"))
    for panel, box in page.panels:
        rectangle = (box.left / wide, 1.0 - (down + box.top + box.height) / high, box.width / wide, box.height / high)
        _panel(canvas.add_axes(rectangle), panel, box)
    if page.legend:
        _legend(canvas.add_axes((0.0, 1.0 - (down + page.height) / high, page.width / wide, page.height / high)), page)


def _legend(axes: Axes, page: Page) -> None:
    axes.set_xlim(0.0, page.width)
    axes.set_ylim(page.height, 0.0)
    axes.axis("off")
    for entry in page.legend:
        _sign(axes, entry)
        how: dict[str, Any] = {"fontsize": 8.2, "va": "center_baseline", "color": palette.colour("ink")}
        axes.text(entry.left + 0.34, entry.top, entry.item.label, **how)


def _sign(axes: Axes, entry: Entry) -> None:
    item, left, top = entry.item, entry.left, entry.top
    if isinstance(item, Curve):
        tint = palette.colour(item.role)
        if item.width:
            style = _LINES[item.dash]
            axes.plot([left, left + 0.26], [top, top], color=tint, linewidth=max(item.width, 1.3), linestyle=style)
        if item.marker:
            axes.plot([left + 0.13], [top], "o", color=tint, markersize=min(item.marker, 5.0))
        return
    role = item.roles[0] if isinstance(item, Bars) else item.role
    opacity = item.opacity if isinstance(item, Shape) else 1.0
    xs, ys = [left, left + 0.26, left + 0.26, left], [top - 0.045, top - 0.045, top + 0.045, top + 0.045]
    axes.fill(xs, ys, color=palette.colour(role), alpha=opacity, linewidth=0.0)


def _panel(axes: Axes, panel: Panel, box: Box) -> None:
    _frame(axes, panel, box)
    meshes = [item for item in panel.series if isinstance(item, Mesh)]
    if meshes and panel.view is not None:
        _solids(axes, panel, meshes)
    known = labels(panel, box)
    for order, item in enumerate(panel.series):
        _series(axes, panel, item, 3.0 + 0.01 * order)
        if isinstance(item, Rule | Band) and item.text:
            _rule_text(axes, item, known.get(order, Label()))
    if panel.heading:
        how: dict[str, Any] = {"fontweight": "bold", "va": "bottom", "ha": "left"}
        _word(axes, panel.heading, (0.0, 1.0), (0.0, 6.0), 8.4, "ink", xycoords="axes fraction", **how)


def _word(
    axes: Axes, text: str, at: tuple[Any, Any], shift: tuple[float, float], size: float, role: str, **how: Any
) -> None:
    """Write a word at a place, shifted by points."""
    tint = palette.colour(role)
    axes.annotate(text, at, xytext=shift, textcoords="offset points", fontsize=size, color=tint, **how)


def _frame(axes: Axes, panel: Panel, box: Box) -> None:
    x, y = ranges(panel, box)
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.set_facecolor("none")
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    if panel.bare:
        axes.axis("off")
        return
    axes.spines["bottom"].set_color(palette.colour("faint"))
    axes.spines["bottom"].set_linewidth(0.9)
    axes.set_axisbelow(True)
    for name, one in (("x", panel.x), ("y", panel.y)):
        _scale(axes, name, one)
    axes.tick_params(length=0, pad=3.0, labelsize=7.6, labelcolor=palette.colour("muted"))
    if panel.x.title:
        axes.set_xlabel(panel.x.title, fontsize=8.0, color=palette.colour("muted"), labelpad=2.0)


def _scale(axes: Axes, name: str, one: Axis) -> None:
    if one.log:
        (axes.set_xscale if name == "x" else axes.set_yscale)("log")
    scale = axes.xaxis if name == "x" else axes.yaxis
    scale.set_minor_locator(NullLocator())
    scale.set_ticks(list(one.ticks), list(one.texts) or [""] * len(one.ticks))
    if one.grid:
        scale.grid(True, color=palette.colour("grid"), linewidth=0.7)


def _flat(panel: Panel, x: Any, y: Any, z: Any) -> tuple[Any, Any]:
    """Return points on paper."""
    if panel.view is None or z is None:
        return x, y
    seen = onto(panel.view, np.stack(np.broadcast_arrays(x, y, z), axis=-1))
    return seen[..., 0], seen[..., 1]


def _solids(axes: Axes, panel: Panel, meshes: Sequence[Mesh]) -> None:
    found = facets(panel.view, meshes)  # type: ignore[arg-type]
    axes.add_collection(
        PolyCollection(
            [facet.corners for facet in found],
            facecolors=[facet.fill for facet in found],
            edgecolors=[facet.edge for facet in found],
            linewidths=0.35,
            zorder=2.5,
        )
    )


def _series(axes: Axes, panel: Panel, item: Series, order: float) -> None:
    if isinstance(item, Curve):
        _curve(axes, panel, item, order)
    elif isinstance(item, Note):
        _note(axes, panel, item)
    elif isinstance(item, Bars):
        _bars(axes, item, order)
    elif isinstance(item, Shape):
        tint = palette.colour(item.role)
        axes.fill(item.x, item.y, facecolor=tint, alpha=item.opacity, linewidth=0.0, zorder=order)
        if item.outline:
            axes.plot([*item.x, item.x[0]], [*item.y, item.y[0]], color=tint, linewidth=item.outline, zorder=order)
    elif isinstance(item, Cells):
        _cells(axes, item, order)
    elif isinstance(item, Rule):
        _rule(axes, item)
    elif isinstance(item, Band):
        span = axes.axvspan if item.upright else axes.axhspan
        span(item.low, item.high, color=palette.colour(item.role), alpha=item.opacity, linewidth=0.0, zorder=1.0)


def _curve(axes: Axes, panel: Panel, item: Curve, order: float) -> None:
    x, y = _flat(panel, item.x, item.y, item.z)
    tint = palette.colour(item.role)
    dash = _LINES[item.dash] if item.width else "none"
    dots: dict[str, Any] = {"marker": "o" if item.marker else "", "markersize": item.marker, "markeredgewidth": 0.0}
    axes.plot(x, y, color=tint, linewidth=item.width, linestyle=dash, zorder=order, **dots)
    if item.arrow and len(x) > 1:
        tip = {"arrowstyle": "-|>", "color": tint, "linewidth": item.width, "mutation_scale": 7.0}
        ends = (x[-1], y[-1]), (x[-2], y[-2])
        axes.annotate("", *ends, arrowprops={**tip, "shrinkA": 0, "shrinkB": 0}, zorder=order)


def _note(axes: Axes, panel: Panel, item: Note) -> None:
    x, y = _flat(panel, item.x, item.y, item.z)
    how: dict[str, Any] = {"fontweight": "bold" if item.bold else "normal", "annotation_clip": False}
    over = OVER if item.halo else {**OVER, "path_effects": []}
    sides = {"ha": _SIDES[item.side], "va": _LEVELS[item.level]}
    _word(axes, item.text, (float(x), float(y)), item.shift, item.size, item.role, **sides, **how, **over)


def _bars(axes: Axes, item: Bars, order: float) -> None:
    tints = [palette.colour(item.roles[k % len(item.roles)]) for k in range(len(item.at))]
    lengths = [size - item.base for size in item.ends]
    if item.lying:
        axes.barh(item.at, lengths, item.thick, left=item.base, color=tints, linewidth=0.0, zorder=order)
    else:
        axes.bar(item.at, lengths, item.thick, bottom=item.base, color=tints, linewidth=0.0, zorder=order)
    for at, size, text in zip(item.at, item.ends, item.texts, strict=False):
        place, shift = ((size, at), (4.0, 0.0)) if item.lying else ((at, size), (0.0, 2.5))
        sides = {"ha": "left", "va": "center"} if item.lying else {"ha": "center", "va": "bottom"}
        _word(axes, text, place, shift, 7.6, "ink", annotation_clip=False, **sides, **OVER)


def _cells(axes: Axes, item: Cells, order: float) -> None:
    shades = ListedColormap([palette.scale(k / 255.0) for k in range(256)])
    shares = np.ma.masked_invalid(item.share)
    axes.pcolormesh(item.x, item.y, shares, cmap=shades, vmin=0.0, vmax=1.0, zorder=order)


def _rule(axes: Axes, item: Rule) -> None:
    line = axes.axvline if item.upright else axes.axhline
    line(item.value, color=palette.colour(item.role), linewidth=item.width, linestyle=_LINES[item.dash], zorder=2.0)


def _rule_text(axes: Axes, item: Rule | Band, label: Label) -> None:
    value = item.value if isinstance(item, Rule) else item.high
    upright, away = item.upright, -3.0 if label.before else 3.0
    place, shift = (value, 1.0), (away, -1.0 - 72.0 * LINE * label.line)
    across = axes.get_xaxis_transform()
    if not upright:
        place, shift, across = (1.0, value), (-2.0, 2.0), axes.get_yaxis_transform()
    sides = {"ha": "left" if upright and not label.before else "right", "va": "top" if upright else "bottom"}
    _word(axes, item.text, place, shift, 7.4, item.role, xycoords=across, **sides, **OVER)
