"""How fields vary: grids, lists, lists of tables, and designs drawn from distributions.

A sweep is the product of its axes, the first one slowest. Nothing is made before it is asked for: the values at a point
follow from its number alone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np
import scipy

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .distributions import METHODS, Distribution, correlated, uniforms

MOST = 10**12  # more points than this are refused: at ten million a second they would take a day
WIDEST = 1000  # fields that a design draws at most
LISTED = 1_000_000  # longest list of values; what is longer is a grid or a design
Value: TypeAlias = float | int | bool | str  # one value of a field, in the unit of its path


class Axis(Protocol):
    """Some fields that vary together over so many places."""

    @property
    def name(self) -> str:
        """What groups of results are called by."""

    @property
    def fields(self) -> tuple[str, ...]:
        """What varies: paths with units, and facts."""

    @property
    def facts(self) -> tuple[str, ...]:
        """Those that are no field of the drive but said of a row: its name, a price."""

    @property
    def size(self) -> int:
        """How many places there are."""

    def values(self, index: Array) -> dict[str, Array]:
        """Return the values of each field at places ``index`` (k,), arrays (k,)."""

    def told(self) -> dict[str, Any]:
        """Return the axis as the table of a plan file."""


@dataclass(frozen=True, kw_only=True)
class GridAxis:
    """Evenly spaced values of a field, both ends among them.

    Parameters
    ----------
    field : str
        Path with unit: ``joints[1].centre_mm[2]``.
    start, stop : float
        First and last value, in the path's unit.
    count : int
        How many; 1 has the first alone.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import GridAxis
    >>> GridAxis(field="duty.speed_rpm", start=1000, stop=2000, count=3).values(np.arange(3))
    {'duty.speed_rpm': array([1000., 1500., 2000.])}
    """

    field: str
    start: float
    stop: float
    count: int

    def __post_init__(self) -> None:
        check(
            Problem(f"{self.field}: {name}", _("{value} is not a finite number").format(value=value))
            for name, value in (("from", self.start), ("to", self.stop))
            if not math.isfinite(value)
        )
        if self.count < 1:
            text = _("{given} given; at least one is needed")
            check([Problem(f"{self.field}: count", text.format(given=self.count))])
        if not math.isfinite(self.stop - self.start):
            check([Problem(f"{self.field}: to", _("is too far from the first value"))])

    @property
    def name(self) -> str:
        """The path."""
        return self.field

    @property
    def fields(self) -> tuple[str, ...]:
        """The path alone."""
        return (self.field,)

    @property
    def facts(self) -> tuple[str, ...]:
        """None."""
        return ()

    @property
    def size(self) -> int:
        """How many values there are."""
        return self.count

    def values(self, index: Array) -> dict[str, Array]:
        """Return the values at places ``index`` (k,), arrays (k,)."""
        if self.count == 1:
            return {self.field: np.full(len(index), float(self.start))}
        step = (self.stop - self.start) / (self.count - 1)
        found = self.start + step * index
        found[index == self.count - 1] = self.stop
        return {self.field: found}

    def told(self) -> dict[str, Any]:
        """Return the axis as the table of a plan file."""
        return {"key": self.field, "from": self.start, "to": self.stop, "count": self.count}


@dataclass(frozen=True, kw_only=True)
class TableAxis:
    """Rows of values: each row gives every field its value.

    Parameters
    ----------
    fields : tuple of str
        Paths with units, and facts.
    rows : tuple of tuple
        One value for each field.
    name : str
        What groups of results are called by; the first field when empty.
    facts : tuple of str
        Those of the fields that are no field of the drive but said of a row: its name, a price.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import TableAxis
    >>> two = TableAxis(fields=("shafts[1].outer_mm", "shafts[1].wall_mm"), rows=((60.0, 2.0), (70.0, 1.5)))
    >>> two.size, two.values(np.asarray([1]))["shafts[1].wall_mm"]
    (2, array([1.5]))
    """

    fields: tuple[str, ...]
    rows: tuple[tuple[Value, ...], ...]
    name: str = ""
    facts: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", self.name or (self.fields[0] if self.fields else ""))
        problems = []
        if not self.rows or not self.fields:
            problems.append(Problem(self.name, _("an empty list has no values to vary over")))
        if len(self.rows) > LISTED:
            text = _("{count} rows given; the limit of a list is {limit}")
            problems.append(Problem(self.name, text.format(count=len(self.rows), limit=LISTED)))
        for k, row in enumerate(self.rows):
            if len(row) != len(self.fields):
                text = _("{given} values given, {wanted} needed")
                problems.append(Problem(f"{self.name}[{k}]", text.format(given=len(row), wanted=len(self.fields))))
            problems += [
                Problem(f"{self.name}[{k}]", _("{value} is not a number, flag or word").format(value=repr(one)[:40]))
                for one in row
                if not _holds(one)
            ]
        check(problems)

    @property
    def size(self) -> int:
        """How many rows there are."""
        return len(self.rows)

    @cached_property
    def _columns(self) -> dict[str, Array]:
        return {one: column(values) for one, values in zip(self.fields, zip(*self.rows, strict=True), strict=True)}

    def values(self, index: Array) -> dict[str, Array]:
        """Return the values at places ``index`` (k,), arrays (k,)."""
        return {one: values[index] for one, values in self._columns.items()}

    def told(self) -> dict[str, Any]:
        """Return the axis as the table of a plan file."""
        if len(self.fields) == 1 and self.name == self.fields[0]:
            return {"key": self.fields[0], "values": [row[0] for row in self.rows]}
        rows = [dict(zip(self.fields, row, strict=True)) for row in self.rows]
        return {"name": self.name, "rows": rows} | ({"facts": list(self.facts)} if self.facts else {})


@dataclass(frozen=True, kw_only=True)
class SampledAxis:
    """Points drawn from distributions: at random, or spread evenly by a quasi-random sequence.

    Parameters
    ----------
    distributions : mapping of str to Distribution
        Path with unit -> how its values are distributed.
    count : int
        How many points.
    seed : int
        The same seed draws the same points, whatever part of them is asked for.
    method : {"random", "sobol", "halton", "lhs"}
        Independent draws; Sobol' points, best in powers of two; Halton points; a Latin hypercube.
    correlations : tuple of (str, str, float)
        Correlation of the normal scores of two fields; pairs not named are independent.
    name : str

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.sweeps import SampledAxis, Uniform
    >>> drawn = SampledAxis(distributions={"joints[0].joint_angle_deg": Uniform(low=0, high=20)}, count=8, method="lhs")
    >>> sorted((drawn.values(np.arange(8))["joints[0].joint_angle_deg"] // 2.5).tolist())
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
    """

    distributions: Mapping[str, Distribution]
    count: int
    seed: int = 0
    method: Literal["random", "sobol", "halton", "lhs"] = "random"
    correlations: tuple[tuple[str, str, float], ...] = ()
    name: str = "draw"
    _factor: Any = field(init=False, repr=False, compare=False, default=None)

    def __post_init__(self) -> None:
        problems = []
        if self.method not in METHODS:
            text = _("{value} is none of {choices}")
            problems.append(Problem("design", text.format(value=repr(self.method), choices=", ".join(METHODS))))
        if not self.distributions:
            problems.append(Problem("fields", _("an empty list has no values to vary over")))
        if self.count < 1:
            problems.append(Problem("count", _("{given} given; at least one is needed").format(given=self.count)))
        if len(self.distributions) > WIDEST:
            text = _("{count} fields given; the limit of a design is {limit}")
            problems.append(Problem("fields", text.format(count=len(self.distributions), limit=WIDEST)))
        if self.method == "sobol" and self.count > 2**30:
            problems.append(Problem("count", _("Sobol' points end at 2^30; take random ones")))
        if not 0 <= self.seed < 2**63:
            problems.append(Problem("seed", _("{value} does not lie between 0 and 2^63").format(value=self.seed)))
        check(problems)
        object.__setattr__(self, "_factor", correlated(tuple(self.distributions), self.correlations))

    @property
    def fields(self) -> tuple[str, ...]:
        """The paths."""
        return tuple(self.distributions)

    @property
    def facts(self) -> tuple[str, ...]:
        """None."""
        return ()

    @property
    def size(self) -> int:
        """How many points there are."""
        return self.count

    def values(self, index: Array) -> dict[str, Array]:
        """Return the values at places ``index`` (k,), arrays (k,); drawn over the runs that the places make up."""
        share = self._shares(index)
        if self._factor is not None:
            # Term by term: how a product of matrices rounds depends on how many rows it has.
            scores: Array = scipy.special.ndtri(share).T
            mixed = [sum(weight * score for weight, score in zip(row, scores, strict=True)) for row in self._factor]
            share = scipy.special.ndtr(np.stack(mixed, axis=-1))
        return {path: one.at(share[:, k]) for k, (path, one) in enumerate(self.distributions.items())}

    def _shares(self, index: Array) -> Array:
        """Return shares in (0, 1) of places, array (k, fields); each is drawn once however often it is asked for."""
        if not len(index):
            return np.empty((0, len(self.distributions)))
        if index[-1] - index[0] == len(index) - 1 and np.all(np.diff(index) == 1):
            return self._run(int(index[0]), int(index[-1]) + 1)
        places, back = np.unique(index, return_inverse=True)
        cuts = np.flatnonzero(np.diff(places) != 1) + 1
        ends = [0, *cuts.tolist(), len(places)]
        parts = [self._run(int(places[a]), int(places[b - 1]) + 1) for a, b in pairwise(ends)]
        return np.concatenate(parts)[back]

    def _run(self, start: int, stop: int) -> Array:
        return uniforms(self.method, len(self.distributions), self.seed, start, stop, self.count)

    def told(self) -> dict[str, Any]:
        """Return the axis as the table of a plan file."""
        fields = [{"key": path, **one.told()} for path, one in self.distributions.items()]
        told = {"design": self.method, "name": self.name, "count": self.count, "seed": self.seed, "fields": fields}
        return told | ({"correlations": [list(one) for one in self.correlations]} if self.correlations else {})


@dataclass(frozen=True, kw_only=True)
class Points:
    """All points of a sweep: the product of its axes, the first one slowest."""

    axes: tuple[Axis, ...]  # None of them: one point, the drive as it is

    def __post_init__(self) -> None:
        seen: set[str] = set()
        problems = []
        for axis in self.axes:
            for one in (*axis.fields, *([] if axis.name in axis.fields else [axis.name])):
                if one in seen:
                    problems.append(Problem(one, _("varies twice")))
                seen.add(one)
        if self.size > MOST:
            text = _("the sweep has {count:.3g} points; the limit is {limit:.0e}")
            problems.append(Problem("vary", text.format(count=float(min(self.size, 10**300)), limit=float(MOST))))
        check(problems)

    @property
    def size(self) -> int:
        """How many points there are."""
        return math.prod(axis.size for axis in self.axes)

    @property
    def fields(self) -> tuple[str, ...]:
        """What varies, in the order of the axes."""
        return tuple(one for axis in self.axes for one in axis.fields)

    def places(self, start: int, stop: int) -> list[Array]:
        """Return the place on each axis of points ``start`` to ``stop``, one array for each axis."""
        number = np.arange(start, stop, dtype=np.int64)
        found: list[Array] = []
        for axis in reversed(self.axes):
            number, place = np.divmod(number, axis.size)
            found.append(place)
        return found[::-1]

    def values(self, start: int, stop: int) -> dict[str, Array]:
        """Return the values of every field at points ``start`` to ``stop``, in the units of their paths."""
        found: dict[str, Array] = {}
        for axis, place in zip(self.axes, self.places(start, stop), strict=True):
            found.update(axis.values(place))
        return found


def _holds(value: object) -> bool:
    """Tell whether a column can hold a value."""
    return isinstance(value, str | float) or (isinstance(value, int) and abs(value) < 2**1000)


def column(values: Sequence[Value]) -> Array:
    """Return values of one field as an array: numbers as floats, words and flags as they are."""
    kinds = {bool if isinstance(one, bool) else str if isinstance(one, str) else float for one in values}
    if kinds == {float}:
        return np.asarray(values, dtype=float)
    if kinds == {bool}:
        return np.asarray(values, dtype=bool)
    return np.asarray([str(one) for one in values])
