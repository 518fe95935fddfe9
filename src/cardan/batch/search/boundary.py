"""Where limits begin to be broken: the boundary followed over two fields, cell by cell, without a whole grid."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cardan.batch.work import STATUS, Column
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .goals import Evaluator, Limit, Progress, StoppedError, answered, check_names, excess
from .optimise import Bounds, check_bounds

MOST = 2**24  # places of the finest grid at most: each has room for a number
ROUNDS = 30  # how often the place of a crossing is narrowed down, at most


@dataclass(frozen=True, eq=False, kw_only=True)
class Boundary:
    """The lines between where limits are kept and where one is broken, over two fields.

    Attributes
    ----------
    fields : tuple of two Column
        What runs across and upwards.
    limits : tuple of Limit
    bounds : tuple of (float, float)
        Box looked at, in the units of the fields.
    lines : tuple of array (p, 2)
        Points along each line; a closed one ends where it begins.
    places : array (n, 2)
        Corners of cells that were asked.
    excess : array (n,)
        How far the worst limit is passed there, a share of it; negative within, nan without an answer.
    evaluations : int
        Points asked in all.
    grid : int
        Points of a plain grid as fine as the finest cells.
    status : str
        "done" or "cancelled"; then lines are as fine as they got.
    """

    fields: tuple[Column, ...]
    limits: tuple[Limit, ...]
    bounds: tuple[tuple[float, float], ...]
    lines: tuple[Array, ...]
    places: Array
    excess: Array
    evaluations: int
    grid: int
    status: str = "done"

    @property
    def kept(self) -> Array:
        """Whether all limits are kept at the places, array of bool (n,)."""
        return self.excess <= 0.0


def boundary(
    ask: Evaluator,
    bounds: Bounds,
    limits: Sequence[Limit],
    *,
    coarse: tuple[int, int] = (16, 16),
    halvings: int = 4,
    accuracy: float = 0.01,
    progress: Progress | None = None,
) -> Boundary:
    """Return the lines over two fields at which limits begin to be broken.

    Parameters
    ----------
    ask : Evaluator
        What answers, over two fields.
    bounds : sequence of two (float, float)
        The box, in the units of the fields.
    limits : sequence of Limit
        What is to be kept; where there is no answer, it is broken.
    coarse : (int, int)
        Cells of the first grid across and upwards: an island smaller than a cell may be missed.
    halvings : int
        How often cells on the boundary are halved.
    accuracy : float
        Share of the finest cell to which crossings are found.
    progress : function, optional
        Told the share done; when it answers "stop", lines are as fine as they got.

    Returns
    -------
    Boundary

    Raises
    ------
    InputError
        Not two fields, no box, no limit, a column that is not there, a grid too fine.

    See Also
    --------
    evaluator, sweep

    Notes
    -----
    Cells whose corners differ are quartered; a line that leaves them is followed into the cells beside, however the
    first grid saw these. So the points asked grow with the length of the boundary, not with the area. Crossings are
    found by false position (Illinois), by halves next to points without an answer.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.batch.answering.asking import Formula
    >>> from cardan.sweeps import Limit, boundary
    >>> ask = Formula.of(["x", "y"], {"r": lambda x, y: (x * x + y * y) ** 0.5})
    >>> found = boundary(ask, [(-2.0, 2.0), (-2.0, 2.0)], [Limit(name="r", high=1.0)])
    >>> radius = np.hypot(*found.lines[0].T)
    >>> len(found.lines), bool(abs(radius - 1.0).max() < 1e-4), found.evaluations < found.grid / 10
    (1, True, True)
    """
    _check(ask, bounds, limits, coarse, halvings, accuracy)
    grid = _Grid(ask, bounds, limits, coarse, halvings, progress)
    status = "done"
    try:
        cells = grid.follow()
        crossings = grid.crossings(cells, accuracy)
    except StoppedError:
        status = "cancelled"
        cells = grid.cells
        crossings = grid.crossings(cells, math.inf)
    lines = tuple(grid.at(line) for line in _joined(grid, cells, crossings))
    i, j = np.nonzero(grid.known)
    return Boundary(
        fields=ask.points,
        limits=tuple(limits),
        bounds=tuple((float(low), float(high)) for low, high in bounds),
        lines=lines,
        places=grid.at(np.stack([i, j], axis=1).astype(float)),
        excess=grid.margin[i, j],
        evaluations=grid.count,
        grid=int(np.prod(grid.shape)),
        status=status,
    )


class _Grid:
    """The corners of the finest cells, of which few are asked; places are counted in these cells."""

    def __init__(
        self,
        ask: Evaluator,
        bounds: Bounds,
        limits: Sequence[Limit],
        coarse: tuple[int, int],
        halvings: int,
        progress: Progress | None,
    ) -> None:
        self.ask, self.limits, self.progress = ask, tuple(limits), progress
        self.names = list(dict.fromkeys(limit.name for limit in limits))
        self.halvings = halvings
        self.step = 1 << halvings
        self.shape = coarse[0] * self.step + 1, coarse[1] * self.step + 1
        self.low = np.asarray([low for low, _high in bounds], dtype=float)
        self.width = np.asarray([high - low for low, high in bounds], dtype=float)
        self.margin = np.full(self.shape, math.nan)
        self.known = np.zeros(self.shape, dtype=bool)
        self.count = 0
        self.done = 0.0
        self.cells = np.empty((0, 2), dtype=int)
        self.last = self.step

    def at(self, places: Array) -> Array:
        """Return the points (n, 2) of places, in the units of the fields."""
        found: Array = self.low + self.width * (places / (np.asarray(self.shape) - 1))
        return found

    def asked(self, places: Array, end: float) -> Array:
        """Return the excess at places (n, 2)."""
        rows = answered(self.ask, self.at(places), self.names, self.progress, begin=self.done, end=end)
        if rows is None:
            raise StoppedError
        self.count, self.done = self.count + len(places), end
        found = excess(self.limits, rows, len(places))
        return np.where(rows[STATUS] == 0, found, math.nan)

    def ask_at(self, corners: Array, end: float) -> None:
        """Ask at corners (n, 2) that are not known yet."""
        new = np.unique(corners[~self.known[corners[:, 0], corners[:, 1]]], axis=0)
        if len(new):
            self.margin[new[:, 0], new[:, 1]] = self.asked(new.astype(float), end)
            self.known[new[:, 0], new[:, 1]] = True

    def mixed(self, cells: Array, step: int) -> Array:
        """Return the cells (m, 2) of which some corners keep the limits and some do not."""
        inside = np.stack([self.kept(_moved(cells, a, b, step)) for a in (0, 1) for b in (0, 1)])
        found: Array = cells[np.any(inside, axis=0) & ~np.all(inside, axis=0)]
        return found

    def kept(self, corners: Array) -> Array:
        """Return whether limits are kept at corners (n, 2)."""
        found: Array = self.margin[corners[:, 0], corners[:, 1]] <= 0.0
        return found

    def follow(self) -> Array:
        """Return the finest cells on the boundary, by their lower left corners (m, 2)."""
        step = self.step
        spread = [np.arange(0, size - 1, step) for size in self.shape]
        cells = np.stack(np.meshgrid(*spread, indexing="ij"), axis=-1).reshape(-1, 2)
        for level in range(self.halvings + 1):
            end = (level + 1.0) / (self.halvings + 2.0)
            self.ask_at(_corners(cells, step), self.done + 0.7 * (end - self.done))
            self.cells = cells = self._grown(self.mixed(cells, step), step, end)
            self.last = step
            if level < self.halvings:
                step //= 2
                cells = _corners(cells, step)
        return cells

    def _grown(self, cells: Array, step: int, end: float) -> Array:
        """Return the cells and all that the line goes on into."""
        seen = {(i, j) for i, j in cells.tolist()}
        edge = cells
        while len(edge):
            beside = np.concatenate([_moved(edge, a, b, step) for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1))])
            pairs = (((1, 0), (1, 1)), ((0, 0), (0, 1)), ((0, 1), (1, 1)), ((0, 0), (1, 0)))
            crossed = np.concatenate(
                [self.kept(_moved(edge, *one, step)) != self.kept(_moved(edge, *other, step)) for one, other in pairs]
            )
            room = np.all((beside >= 0) & (beside + step < self.shape), axis=1)
            new = sorted({(i, j) for i, j in beside[crossed & room].tolist()} - seen)
            edge = np.asarray(new, dtype=int).reshape(-1, 2)
            seen.update(new)
            self.ask_at(_corners(edge, step), self.done + 0.9 * (end - self.done))
        return np.asarray(sorted(seen), dtype=int).reshape(-1, 2)

    def crossings(self, cells: Array, accuracy: float) -> dict[tuple[int, int, int], Array]:
        """Return where the line crosses the edges of cells: lower corner and direction -> place (2,)."""
        step = self.last
        sides = ((0, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1))
        every = [np.column_stack([_moved(cells, a, b, step), np.full(len(cells), way)]) for a, b, way in sides]
        edges = np.unique(np.concatenate(every), axis=0).reshape(-1, 3)
        start = edges[:, :2]
        stop = start + step * np.column_stack([edges[:, 2] == 0, edges[:, 2] == 1])
        differ = self.kept(start) != self.kept(stop)
        edges, start, stop = edges[differ], start[differ], stop[differ]
        swapped = ~self.kept(start)
        inner, outer = np.where(swapped[:, None], stop, start), np.where(swapped[:, None], start, stop)
        place = self._narrowed(inner.astype(float), outer.astype(float), accuracy)
        return {(i, j, way): place[k] for k, (i, j, way) in enumerate(edges.tolist())}

    def _narrowed(self, inner: Array, outer: Array, accuracy: float) -> Array:
        """Return where excess becomes positive between places (n, 2) within and without."""
        a, b = (self.margin[ends[:, 0].astype(int), ends[:, 1].astype(int)] for ends in (inner, outer))
        way = outer - inner
        low, high = np.zeros(len(inner)), np.ones(len(inner))  # shares of the way
        found = _between(low, high, a, b)
        live = np.arange(len(inner)) if math.isfinite(accuracy) else np.empty(0, dtype=int)
        for _round in range(ROUNDS):
            if not live.size:
                break
            here = found[live]
            value = self.asked(inner[live] + here[:, None] * way[live], 0.5 * (self.done + 1.0))
            inside = value <= 0.0
            low[live[inside]], high[live[~inside]] = here[inside], here[~inside]
            # Illinois: the end that stays counts half, so that both ends come nearer.
            b[live[inside]] *= 0.5
            a[live[~inside]] *= 0.5
            a[live[inside]], b[live[~inside]] = value[inside], value[~inside]
            found[live] = _between(low[live], high[live], a[live], b[live])
            near = (np.abs(found[live] - here) < accuracy) & (np.isfinite(value) | (high[live] - low[live] < accuracy))
            live = live[~near]
        return inner + found[:, None] * way


def _between(low: Array, high: Array, a: Array, b: Array) -> Array:
    """Return where a straight line from ``a`` at ``low`` to ``b`` at ``high`` is 0, or the middle without values."""
    with np.errstate(invalid="ignore", divide="ignore"):
        found = low + (high - low) * (a / (a - b))
    return np.where(np.isfinite(found), np.clip(found, low, high), 0.5 * (low + high))


def _moved(cells: Array, a: int, b: int, step: int) -> Array:
    """Return the corners so many steps to the right and above."""
    found: Array = cells + np.asarray([a * step, b * step])
    return found


def _corners(cells: Array, step: int) -> Array:
    found: Array = np.concatenate([_moved(cells, a, b, step) for a in (0, 1) for b in (0, 1)])
    return found


def _joined(grid: _Grid, cells: Array, crossings: dict[tuple[int, int, int], Array]) -> Iterator[Array]:
    """Yield the lines through the crossings of cells, as places (p, 2)."""
    beside: dict[tuple[int, int, int], list[tuple[int, int, int]]] = {edge: [] for edge in crossings}
    step = grid.last
    for i, j in cells.tolist():
        round_about = ((i, j, 0), (i + step, j, 1), (i, j + step, 0), (i, j, 1))  # below, right, above, left
        crossed = [edge for edge in round_about if edge in crossings]
        if len(crossed) == 4:
            # Two lines through one cell: they part the corners that differ from its middle.
            corner = grid.margin[i : i + step + 1 : step, j : j + step + 1 : step]
            first = bool(corner[0, 0] <= 0.0)
            together = (float(np.sum(corner)) <= 0.0) == first
            crossed = [crossed[k] for k in ((0, 1, 2, 3) if together else (0, 3, 1, 2))]
        for k in range(0, len(crossed) - 1, 2):
            beside[crossed[k]].append(crossed[k + 1])
            beside[crossed[k + 1]].append(crossed[k])
    left = set(beside)
    ends = sorted(edge for edge, near in beside.items() if len(near) < 2)
    for start in [*ends, *sorted(beside)]:
        if start not in left:
            continue
        line, here = [start], start
        left.discard(start)
        while (onward := next((edge for edge in beside[here] if edge in left), None)) is not None:
            line.append(onward)
            left.discard(onward)
            here = onward
        if len(line) > 2 and start in beside[here] and len(beside[start]) == 2:
            line.append(start)
        if len(line) > 1:
            yield np.stack([crossings[edge] for edge in line])


def _check(
    ask: Evaluator, bounds: Bounds, limits: Sequence[Limit], coarse: tuple[int, int], halvings: int, accuracy: float
) -> None:
    """Refuse what cannot be followed, all at once."""
    check_names(limits, ask.answers)
    problems = []
    if len(ask.points) != 2:
        text = _("a boundary lies over two fields; {given} vary")
        problems.append(Problem("vary", text.format(given=len(ask.points)), "inconsistent"))
    else:
        problems += check_bounds(ask, bounds)
    if not limits:
        problems.append(Problem("limits", _("without a limit there is no boundary"), "missing"))
    if min(coarse) < 1 or halvings < 0:
        text = _("{coarse} cells halved {halvings} times make no grid")
        problems.append(Problem("coarse", text.format(coarse=coarse, halvings=halvings), "out_of_range"))
    elif math.prod(size * 2**halvings + 1 for size in coarse) > MOST:
        text = _("the finest grid would have {count} places; {most} are allowed: halve cells less often")
        count = math.prod(size * 2**halvings + 1 for size in coarse)
        problems.append(Problem("halvings", text.format(count=count, most=MOST), "out_of_range"))
    if not 0.0 < accuracy <= 1.0:
        problems.append(Problem("accuracy", _("{given} is not between 0 and 1").format(given=accuracy), "out_of_range"))
    check(problems)
