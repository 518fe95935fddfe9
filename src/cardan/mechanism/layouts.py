"""All ways to hold a chain of shafts just enough by bearings, splines and joints: found and counted by its graph."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import count

from .counting import Join
from .mechanism import PAIRS

# A layout is right by its graph where every set S of its parts moves in one way at least, 6|S| - Σs ≥ 1 over the pairs
# within S and to the frame, and the whole in just one. Let the input stand still: behind a joint or spline the next
# part moves in as many ways more as that leaves free, a bearing takes away as many as it holds. With d the ways left,
# the condition for a run of parts i to j is d_j ≥ d_(i-1) + f_i - 5, for one from the input on d_j ≥ 0, for the whole
# d = 0 at the end. So a part moves in five ways at most, d + f ≤ 5, as it turns with the input alone, and a bearing
# holds no more than there are, s ≤ d + f.

BEARINGS = ("SG", "S", "C", "R")
"""What holds a part of a shaft sideways, by its pair: one bearing, free to tilt (SG, S), or two in line (C, R); sliding
(SG, C) or located (S, R)."""

WAYS = 6
"""Ways in which a body moves."""

LOOSE = 5
"""Ways in which a part may move while the input stands still: all but turning with it."""

SPLINE = 1
"""Ways that a spline leaves free."""

COST = {"": 0, "SG": 1, "S": 1, "C": 2, "R": 2}
"""Bearings of which each is made."""


@dataclass(frozen=True, kw_only=True)
class Layout:
    """How a chain of shafts is held."""

    joints: tuple[int, ...]  # ways that each joint leaves free
    # of each shaft what holds it, by `BEARINGS`, "" for nothing: one part, or that up to its spline and that behind it
    shafts: tuple[tuple[str, ...], ...]

    @property
    def splines(self) -> int:
        """Number of its splines."""
        return sum(len(parts) - 1 for parts in self.shafts)

    @property
    def bearings(self) -> int:
        """Number of its bearings."""
        return sum(COST[one] for parts in self.shafts for one in parts)

    @property
    def parts(self) -> int:
        """Number of its bearings and splines."""
        return self.bearings + self.splines

    @property
    def mirrored(self) -> Layout | None:
        """The same driven from its other end; None where that is not held as an input is."""
        shafts = tuple(parts[::-1] for parts in self.shafts[::-1])
        return Layout(joints=self.joints[::-1], shafts=shafts) if shafts[0][0] == "R" else None

    @property
    def graph(self) -> tuple[Join, ...]:
        """Its links and pairs, as `cardan.mechanism.counting.partition` takes them: frame 0, input 1."""
        found, link = [Join(links=("0", "1"), constraints=PAIRS["R"].constraints)], 1
        for k, parts in enumerate(self.shafts):
            for place, bearing in enumerate(parts):
                if k or place:
                    free = SPLINE if place else self.joints[k - 1]
                    found.append(Join(links=(str(link), str(link + 1)), constraints=WAYS - free))
                    link += 1
                    if bearing:
                        found.append(Join(links=("0", str(link)), constraints=PAIRS[bearing].constraints))
        return tuple(found)


def layouts(joints: Sequence[Sequence[int]], *, splines: int | None = None) -> Iterator[Layout]:
    """Yield every layout that its graph holds just enough, those with the fewest parts first.

    Parameters
    ----------
    joints : sequence of sequences of int
        Of each joint the ways that it may leave free: 2 a joint that holds its centre, 3 one that slides too, 5 one
        that holds nothing but the torque.
    splines : int, optional
        Most splines; one in each shaft when not given.

    Notes
    -----
    The input is driven and held by R. See the comment above: the layouts are the paths of d from 0 to 0. By the least
    number of parts that each place of a path still needs, none is followed in vain.

    Examples
    --------
    A single joint: a bearing on the output that slides and tilts, or a located one with a spline on either shaft; two
    splines with one that holds more would slide in line, which the rank sees and the graph does not.

    >>> for one in layouts([[2]], splines=1):
    ...     print(one.shafts)
    (('R',), ('SG',))
    (('R', ''), ('S',))
    (('R',), ('', 'S'))
    """
    most = len(joints) + 1 if splines is None else splines
    least = _least(tuple(map(tuple, joints)))
    ticket = count()
    start = Layout(joints=(), shafts=(("R",),))
    heap = [(least(0, 0, True, most), next(ticket), start, 0)]
    while heap:
        _bound, _number, one, left = heapq.heappop(heap)
        k = len(one.joints)
        if k == len(joints) and not left:
            yield one
        for then, free in _steps(one, left, joints, most):
            rest = least(len(then.joints), free, len(then.shafts[-1]) == 1, most - then.splines)
            if rest is not None:
                heapq.heappush(heap, (then.parts + rest, next(ticket), then, free))


def _steps(one: Layout, left: int, joints: Sequence[Sequence[int]], most: int) -> Iterator[tuple[Layout, int]]:
    """Yield a layout with one part more, behind a spline or a joint, and the ways that are left."""
    if len(one.shafts[-1]) == 1 and one.splines < most:
        for bearing, free in _held(left + SPLINE):
            yield replace(one, shafts=(*one.shafts[:-1], (*one.shafts[-1], bearing))), free
    if len(one.joints) < len(joints):
        for ways in joints[len(one.joints)]:
            for bearing, free in _held(left + ways):
                yield Layout(joints=(*one.joints, ways), shafts=(*one.shafts, (bearing,))), free


def _held(ways: int) -> Iterator[tuple[str, int]]:
    """Yield what may hold a part that moves in so many ways, and how many are left."""
    if ways <= LOOSE:
        for bearing in ("", *BEARINGS):
            free = ways - (PAIRS[bearing].constraints if bearing else 0)
            if free >= 0:
                yield bearing, free


def _least(joints: tuple[tuple[int, ...], ...]) -> Callable[[int, int, bool, int], int | None]:
    """Return what tells the least number of parts that a path still needs; None where it leads nowhere."""

    @cache
    def least(done: int, left: int, whole: bool, splines: int) -> int | None:
        found = [0] if done == len(joints) and not left else []
        steps = [(0, one) for one in joints[done]] if done < len(joints) else []
        for spline, ways in [*steps, *([(1, SPLINE)] if whole and splines else [])]:
            for bearing, free in _held(left + ways):
                rest = least(done + 1 - spline, free, not spline, splines - spline)
                found += [] if rest is None else [spline + COST[bearing] + rest]
        return min(found, default=None)

    return least


def number_of_layouts(joints: Sequence[Sequence[int]], *, splines: int | None = None) -> int:
    """Return how many `layouts` there are, without finding them.

    >>> number_of_layouts([[2]]), len(list(layouts([[2]])))
    (5, 5)
    """

    @cache
    def paths(done: int, left: int, whole: bool, rest: int) -> int:
        found = int(done == len(joints) and not left)
        if done < len(joints):
            found += sum(paths(done + 1, free, True, rest) for one in joints[done] for _b, free in _held(left + one))
        if whole and rest:
            found += sum(paths(done, free, False, rest - 1) for _b, free in _held(left + SPLINE))
        return found

    return paths(0, 0, True, len(joints) + 1 if splines is None else splines)
