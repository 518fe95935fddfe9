"""What a figure shows, whoever draws it: panels, series, axes, units, marks, and one sentence on what to see.

A figure is made from a result by a function of its question and drawn by a renderer; it knows neither. Values are in
the units of their axes; texts may hold quantities, which `for_reader` writes in the units of whoever looks, so that
what a renderer gets holds words alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, TypeAlias

import numpy as np

from cardan.maths.arrays import Array
from cardan.units import label as printed
from cardan.units import spoken

Text: TypeAlias = Any
"""A `cardan.answers.quantity.Text` where a figure is made, a str where it is drawn."""

Dash: TypeAlias = str
Side: TypeAlias = Literal["left", "centre", "right"]
Level: TypeAlias = Literal["top", "middle", "bottom"]
Direction: TypeAlias = tuple[float, float, float]


@dataclass(frozen=True, eq=False, kw_only=True)
class Curve:
    """A line through points, in the plane or in space."""

    x: Array  # x, y, z (p,): its points; ``z`` only in a panel with a view
    y: Array  # (p,)
    z: Array | None = None  # (p,)
    label: Text = ""  # its entry in the legend; none when empty
    role: str = "ink"  # what it stands for, see `palette`
    width: float = 1.5  # in points; 0 draws markers alone
    dash: Dash = "solid"  # solid, dashed, dotted or dashdot
    marker: float = 0.0  # diameter of a dot at every point, in points
    arrow: bool = False  # put an arrowhead at its last point
    text: Text = ""  # what it is, for whoever points at it in a view that can be turned


@dataclass(frozen=True, eq=False, kw_only=True)
class Bars:
    """Bars from a base, upright or lying, each with the text at its end; they end from ``least`` to ``most``."""

    at: Array
    size: Array
    texts: Sequence[Text] = ()
    label: Text = ""
    roles: Sequence[str] = ("accent",)
    thick: float = 0.6
    base: float = 0.0
    lying: bool = False
    least: float = -math.inf
    most: float = math.inf

    @property
    def ends(self) -> Array:
        """Where the bars end."""
        found: Array = np.clip(np.asarray(self.size, dtype=float), self.least, self.most)
        return found


@dataclass(frozen=True, eq=False, kw_only=True)
class Shape:
    """A filled polygon."""

    x: Array
    y: Array
    role: str = "accent"
    opacity: float = 1.0
    outline: float = 0.0
    label: Text = ""


@dataclass(frozen=True, eq=False, kw_only=True)
class Mesh:
    """A solid's surface in space."""

    corners: Array  # (m, 3)
    faces: Sequence[Sequence[int]]  # faces, triangles: the same surface, as flat faces and as triangles
    triangles: Sequence[Sequence[int]]
    role: str = "muted"
    smooth: bool = False  # do not draw the edges of the faces
    shade: float = 0.0  # share of white mixed into the colour
    opacity: float = 1.0  # how much it hides of what is inside it, in a view that can be turned
    text: Text = ""  # what it is, for whoever points at it


@dataclass(frozen=True, eq=False, kw_only=True)
class Note:
    """A word at a point; ``shift`` moves it by points of print."""

    text: Text
    x: float
    y: float
    z: float | None = None
    role: str = "ink"
    side: Side = "centre"
    level: Level = "middle"
    size: float = 8.0
    shift: tuple[float, float] = (0.0, 0.0)
    bold: bool = False
    halo: bool = True


@dataclass(frozen=True, eq=False, kw_only=True)
class Rule:
    """A line across the panel at a value: a limit, a mean, an operating point."""

    value: float
    upright: bool = False
    text: Text = ""
    role: str = "muted"
    width: float = 0.9
    dash: Dash = "dashed"


@dataclass(frozen=True, eq=False, kw_only=True)
class Band:
    """The range between two values, shaded across the panel."""

    low: float
    high: float
    upright: bool = False
    text: Text = ""
    role: str = "accent"
    opacity: float = 0.12


@dataclass(frozen=True, eq=False, kw_only=True)
class Cells:
    """A grid of rectangles, each the darker the greater its value."""

    x: Array  # x, y (m + 1,), (k + 1,): edges of the columns and of the rows, rising
    y: Array  # (m + 1,), (k + 1,)
    values: Array  # (k, m): one for each cell; nan leaves it empty
    low: float  # low, high: values of the palest and of the darkest cell
    high: float

    @property
    def share(self) -> Array:
        """Where the values stand between palest and darkest, array (k, m)."""
        span = self.high - self.low
        found: Array = np.clip((self.values - self.low) / (span or 1.0), 0.0, 1.0)
        return found


Series: TypeAlias = Curve | Bars | Shape | Mesh | Note | Rule | Band | Cells


@dataclass(frozen=True, kw_only=True)
class Axis:
    """An axis with its range and the marks along it."""

    label: Text = ""  # what runs along it
    # in which unit it is given: a unit of its dimension, as in keys, or as it is printed where it has none
    unit: str = ""
    dimension: str = ""  # a key of `cardan.units.DIMENSIONS`, for what a reader may see in another unit
    low: float = 0.0  # low, high: its range
    high: float = 1.0
    ticks: tuple[float, ...] = ()  # marked values
    texts: tuple[Text, ...] = ()  # how they are written
    log: bool = False  # logarithmic
    grid: bool = True  # draw lines across the panel at the ticks
    # whether the texts at its ticks are nothing but the numbers; known once it is written for a reader
    numeric: bool = False
    # whether it is the input angle from the start position [°] that runs along it: a place on it is a position of the
    # drive
    turning: bool = False
    # whether it is the time of the drive's movements [s]
    timed: bool = False
    scale: float = 1.0  # how many of its units one of those is that it was made in

    @property
    def title(self) -> str:
        """Label with its unit in brackets."""
        return headed(self.label, self.unit, self.dimension)


def headed(title: Text, unit: str, dimension: str = "") -> str:
    """Return words with a unit in brackets behind them."""
    shown = printed(unit) if dimension else spoken(unit)
    return f"{title} [{shown}]" if shown else f"{title}"


@dataclass(frozen=True, kw_only=True)
class View:
    """How a panel looks at space: what runs to the right and what runs up on paper.

    ``turnable`` views are drawn as a scene the reader can turn, where the renderer can.
    """

    right: Direction
    up: Direction
    turnable: bool = False

    @property
    def toward(self) -> Direction:
        """Direction from the drive to the eye."""
        a, b = self.right, self.up
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@dataclass(frozen=True, eq=False, kw_only=True)
class Panel:
    """One pair of axes with what is drawn in it."""

    series: tuple[Series, ...]  # from the back to the front
    x: Axis = field(default_factory=Axis)  # x, y: its axes; in a view they run along `View.right` and `View.up`
    y: Axis = field(default_factory=Axis)
    title: Text = ""  # its heading; the title of the upright axis when empty
    dimension: str = ""  # dimension, unit: of what its numbers are, where no axis says so; stands behind the title
    unit: str = ""
    equal: bool = False  # one unit is as long to the right as upwards
    bare: bool = False  # no frame, ticks or grid
    view: View | None = None  # looks at space

    @property
    def heading(self) -> str:
        """What stands above the panel."""
        return headed(self.title, self.unit, self.dimension) if self.title else self.y.title


@dataclass(frozen=True, eq=False, kw_only=True)
class Row:
    """Panels side by side, all of one height [inch of print]; ``widths`` are relative."""

    panels: tuple[Panel, ...]
    height: float = 1.7
    widths: tuple[float, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class Figure:
    """A whole figure.

    Parameters
    ----------
    name : str
        Short name for files and links: ``motion``.
    title : str
        Heading.
    sentence : str
        The one sentence under it that says what to see; empty where title and axes say it all.
    source : str
        Which equation the values come from.
    rows : tuple of Row
        Its panels, from the top.
    legend : bool
        List the labelled series above the panels.
    width : float
        Width of the print [inch].
    aside : bool
        Whether a report shows it with ``--full`` alone.
    """

    name: str
    title: Text
    sentence: Text
    source: Text
    rows: tuple[Row, ...]
    legend: bool = True
    width: float = 7.4
    aside: bool = False

    @property
    def panels(self) -> tuple[Panel, ...]:
        """All panels, row by row."""
        return tuple(panel for row in self.rows for panel in row.panels)

    @property
    def spoken(self) -> str:
        """What it is, for who hears the page: title and sentence, where it has one, of a figure made for a reader."""
        return f"{self.title}. {self.sentence}" if self.sentence else f"{self.title}."

    @property
    def entries(self) -> tuple[Curve | Bars | Shape, ...]:
        """Labelled series for the legend, each label once."""
        seen: dict[Text, Curve | Bars | Shape] = {}
        for panel in self.panels:
            for item in panel.series:
                if isinstance(item, Curve | Bars | Shape) and item.label:
                    seen.setdefault(item.label, item)
        return tuple(seen.values())


# What the curves of a panel are called by the legend of their figure.


def called(figure: Figure, panel: Panel) -> Panel:
    """Return a panel whose curves have the names that the legend of the figure gives their looks.

    A figure lists each curve once, above its panels; a panel that stands alone has to name its curves itself. A curve
    that has only the colour of one in the legend keeps to have no label and says in its text what it belongs to.
    panel: one of its panels.

    >>> import numpy as np
    >>> from .figure import Row
    >>> looks = {"x": np.arange(2.0), "y": np.arange(2.0), "role": "shaft 2"}
    >>> first, second = Panel(series=(Curve(label="tube", **looks),)), Panel(series=(Curve(**looks),))
    >>> rows = tuple(Row(panels=(panel,)) for panel in (first, second))
    >>> figure = Figure(name="f", title="", sentence="", source="", rows=rows)
    >>> called(figure, second).series[0].label
    'tube'
    """
    entries = [one for one in reversed(figure.entries) if isinstance(one, Curve)] if figure.legend else []
    alike = {(one.role, one.dash, one.width): one.label for one in entries}
    similar = {(one.role, one.dash): one.label for one in entries if one.width}
    akin = {one.role: one.label for one in entries}

    def named(one: Curve) -> Curve:
        if one.label:
            return one
        label = alike.get((one.role, one.dash, one.width), "")
        if not label and one.width and not one.marker and np.size(one.x) > 2:
            label = similar.get((one.role, one.dash), "")
        return replace(one, label=label, text=one.text or label or akin.get(one.role, ""))

    return replace(panel, series=tuple(named(one) if isinstance(one, Curve) else one for one in panel.series))
