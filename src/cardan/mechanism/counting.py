"""What counting alone tells of links and pairs: where they are held too much, and their structural groups."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cardan.errors import Problem, check, refuse
from cardan.texts import _

from .mechanism import Mechanism

# What counting alone tells of a graph of links and pairs: where it is held too much, and of which groups it is made.
#
# Geometry is left out: the numbers are those of a mechanism whose axes lie anyhow. Where the true ones differ, special
# geometry is at work.

Node: TypeAlias = tuple[object, ...]

MOST_SETS = 200_000
"""Connected sets of links looked at; a graph with more is left whole."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Join:
    """A pair of a graph: what it joins and how much it holds."""

    links: tuple[str, str]
    constraints: int


@dataclass(frozen=True, kw_only=True, slots=True)
class Removed:
    """A group of links taken away together, and the mobility it had: 6m - Σs."""

    links: tuple[str, ...]
    mobility: int


@dataclass(frozen=True, kw_only=True, slots=True)
class Partition:
    """What counting tells of a graph."""

    formula: int  # 6n - Σs
    redundant: int  # constraints that are too many whatever the geometry, if the input turns
    overconstrained: tuple[str, ...]  # links among which they are; the smallest set that has them all
    # groups of which the mechanism is made, from the output end on; None where the graph is too large to look at every
    # set
    groups: tuple[Removed, ...] | None
    # constraints between frame and input beyond the five that let it turn or slide; not counted in ``redundant``
    excess: int = 0

    @property
    def mobility(self) -> int:
        """Mobility by counting, redundancy seen: formula + redundant."""
        return self.formula + self.redundant


def joins(mechanism: Mechanism) -> tuple[Join, ...]:
    """Return the graph of a mechanism.

    An input link that is driven against another moving link counts as one with that, and its drive as one in the frame.
    """
    moving = mechanism.base != mechanism.frame
    merged = {mechanism.input_link: mechanism.base} if moving else {}
    found = []
    for pair in mechanism.joints:
        one, other = (merged.get(link, link) for link in pair.links)
        if one != other:
            found.append(Join(links=(one, other), constraints=pair.kind.constraints))
    if moving:
        found.append(Join(links=(mechanism.frame, mechanism.input_link), constraints=5))
    return tuple(found)


def partition(pairs: Sequence[Join], *, frame: str, input_link: str) -> Partition:
    """Return what counting alone tells.

    Parameters
    ----------
    pairs : sequence of Join
        Links and how many constraints s each pair imposes, 1 to 5.
    frame, input_link : str
        Two of the links; the input is assumed to turn as it is driven.

    Raises
    ------
    InputError
        An unknown link, a link that hangs on nothing, a pair that holds nothing or everything.

    Notes
    -----
    K = {frame, input}; over sets S of other links W_K(S) = 6|S| - Σs of the pairs inside S ∪ K, not wholly in K.
    q = -min(0, min W_K). The minimum is a closure problem (a pair brings s and needs both its links at 6 each), so one
    minimum cut finds it, and the smallest of all minimising sets with it. Groups: the removal procedure of Book p. 13.

    Examples
    --------
    >>> hooke = [("0", "1"), ("1", "2"), ("2", "3"), ("3", "0")]
    >>> found = partition([Join(links=ends, constraints=5) for ends in hooke], frame="0", input_link="1")
    >>> found.formula, found.redundant, found.overconstrained
    (-2, 3, ('2', '3'))
    """
    check(_problems(pairs, frame, input_link))
    every = dict.fromkeys(link for pair in pairs for link in pair.links)
    moving = [link for link in every if link != frame]
    fixed = {frame, input_link}
    others = [link for link in moving if link not in fixed]
    least, tight = _least(others, _weights(pairs, fixed), _between(pairs, set(others)))
    return Partition(
        formula=6 * len(moving) - sum(pair.constraints for pair in pairs),
        redundant=-least,
        overconstrained=tuple(sorted(tight)),
        groups=_groups(pairs, others, fixed),
        excess=max(0, sum(pair.constraints for pair in pairs if set(pair.links) == fixed) - 5),
    )


def _problems(pairs: Sequence[Join], frame: str, input_link: str) -> Iterator[Problem]:
    if not pairs:
        yield Problem("pairs", _("empty: no link can move"), "empty")
        return
    for k, pair in enumerate(pairs):
        if not 1 <= pair.constraints <= 5:
            text = _("{value} is not a number of constraints of a pair: 1 to {most}")
            yield Problem(f"pairs[{k}].constraints", text.format(value=pair.constraints, most=5), "out_of_range")
        if pair.links[0] == pair.links[1]:
            text = _("joins {link} with itself").format(link=pair.links[0])
            yield Problem(f"pairs[{k}].links", text, "inconsistent")
    links = {link for pair in pairs for link in pair.links}
    if frame not in links:
        yield Problem("frame", _("no pair names a link {link}").format(link=repr(frame)), "inconsistent")
    if input_link not in links or input_link == frame:
        text = _("{link} is the frame; it does not move") if input_link == frame else _("no pair names a link {link}")
        yield Problem("input_link", text.format(link=repr(input_link)), "inconsistent")
    held = _reached(frame, links, {frozenset(pair.links) for pair in pairs})
    if frame in links and held != links:
        text = _("nothing joins these links to the frame, {frame}: {links}")
        loose = ", ".join(sorted(links - held, key=numbered))
        yield Problem("pairs", text.format(frame=repr(frame), links=loose), "inconsistent")


def numbered(link: str) -> tuple[bool, int, str]:
    """Return by what links are sorted: numbers as such, before words.

    >>> sorted(["10", "2", "cross"], key=numbered)
    ['2', '10', 'cross']
    """
    return (not link.isdecimal(), int(link) if link.isdecimal() else 0, link)


def _weights(pairs: Iterable[Join], fixed: set[str]) -> dict[str, int]:
    """Return of each link what it adds alone: 6 less what holds it to the fixed links."""
    weight: dict[str, int] = {}
    for pair in pairs:
        for one, other in (pair.links, pair.links[::-1]):
            if one not in fixed:
                weight[one] = weight.get(one, 6) - (pair.constraints if other in fixed else 0)
    return weight


def _between(pairs: Iterable[Join], links: set[str]) -> list[Join]:
    return [pair for pair in pairs if set(pair.links) <= links]


def _least(links: Sequence[str], weight: dict[str, int], pairs: Sequence[Join]) -> tuple[int, set[str]]:
    """Return the least of Σ weight - Σ s inside over all sets of links, at most 0, and the smallest set that has it.

    A maximum closure: profits s of pairs and of links of negative weight, costs of the others. The links that the
    source still reaches when the flow is greatest are the smallest set.
    """
    source: Node = ("source",)
    sink: Node = ("sink",)
    room: dict[Node, dict[Node, float]] = {source: {}, sink: {}}

    def pipe(a: Node, b: Node, width: float) -> None:
        room.setdefault(a, {})
        room.setdefault(b, {})
        room[a][b] = room[a].get(b, 0.0) + width
        room[b].setdefault(a, 0.0)

    profit = 0
    for link in links:
        if weight[link] < 0:
            profit -= weight[link]
            pipe(source, ("link", link), -weight[link])
        elif weight[link] > 0:
            pipe(("link", link), sink, weight[link])
        room.setdefault(("link", link), {})
    for k, pair in enumerate(pairs):
        profit += pair.constraints
        pipe(source, ("pair", k), pair.constraints)
        for link in pair.links:
            pipe(("pair", k), ("link", link), float("inf"))
    flow = 0.0
    while True:
        behind = _spread(room, source)
        if sink not in behind:
            return round(flow) - profit, {str(node[1]) for node in behind if node[0] == "link"}
        steps: list[tuple[Node, Node]] = []
        node = sink
        while node != source:
            steps.append((behind[node], node))
            node = behind[node]
        width = min(room[a][b] for a, b in steps)
        for a, b in steps:
            room[a][b] -= width
            room[b][a] += width
        flow += width


def _spread(room: dict[Node, dict[Node, float]], source: Node) -> dict[Node, Node]:
    """Return what the source reaches where room is left, each with what it is reached from."""
    behind, front = {source: source}, [source]
    while front:
        here = front.pop(0)
        for there, width in room[here].items():
            if width > 0.0 and there not in behind:
                behind[there] = here
                front.append(there)
    return behind


def _groups(pairs: Sequence[Join], others: Sequence[str], fixed: set[str]) -> tuple[Removed, ...] | None:
    """Return the groups of the removal procedure, from the output end on; None where there are too many sets."""
    rest, left = list(pairs), sorted(others, key=numbered)
    found: list[Removed] = []
    while left:
        group = _next(rest, left)
        if group is None:
            return None
        found.append(Removed(links=tuple(sorted(group, key=numbered)), mobility=_count(rest, group)))
        left = [link for link in left if link not in group]
        rest = [pair for pair in rest if not set(pair.links) & group]
    return tuple(found)


def _next(pairs: Sequence[Join], left: Sequence[str]) -> frozenset[str] | None:
    """Return the next group: the smallest sound zero group, else the set that moves most, else all."""
    near: dict[str, set[str]] = {link: set() for link in left}
    for pair in pairs:
        a, b = pair.links
        if a in near and b in near:
            near[a].add(b)
            near[b].add(a)
    best: tuple[int, frozenset[str]] | None = None
    looked = 0
    layer = {frozenset([link]) for link in left}
    while layer:
        looked += len(layer)
        if looked > MOST_SETS:
            return None
        ranked = sorted(layer, key=lambda one: sorted(map(numbered, one), reverse=True), reverse=True)
        for one in ranked:
            if _count(pairs, one) == 0 and _sound(pairs, one):
                return one
        for one in ranked:
            count = _count(pairs, one)
            if count > 0 and (best is None or count > best[0]):
                best = count, one
        layer = {one | {more} for one in layer for link in one for more in near[link] - one}
    return best[1] if best else frozenset(left)


def _count(pairs: Iterable[Join], group: frozenset[str]) -> int:
    """Return 6m - Σs over the pairs that touch a group."""
    return 6 * len(group) - sum(pair.constraints for pair in pairs if group & set(pair.links))


def _sound(pairs: Sequence[Join], group: frozenset[str]) -> bool:
    """Tell whether no part of a group is held too much by what is outside the group and itself."""
    outside = {link for pair in pairs for link in pair.links} - group
    weight = _weights([pair for pair in pairs if group & set(pair.links)], outside)
    links = sorted(group)
    return _least(links, {link: weight.get(link, 6) for link in links}, _between(pairs, set(group)))[0] == 0


def _reached(start: str, links: set[str], ends: set[frozenset[str]]) -> set[str]:
    found, front = {start}, [start]
    while front:
        here = front.pop()
        for pair in ends:
            if here in pair:
                more = pair - found
                found |= more
                front += more
    return found & links


# Structural groups: chains of links that hold themselves just enough, or impose so many constraints; enumerated.

GroupKind: TypeAlias = Literal["zero", "minus", "plus"]

MOST = 5
"""A pair holds one to five of the six motions."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Group:
    """A chain of links with the pairs between and at both ends of them."""

    constraints: tuple[int, ...]  # s of each pair, along the chain

    @property
    def links(self) -> int:
        """Number of links m, one less than pairs."""
        return len(self.constraints) - 1

    @property
    def mobility(self) -> int:
        """What the group adds to the mobility of what it is joined to, W = 6m - Σs."""
        return 6 * self.links - sum(self.constraints)

    @property
    def kind(self) -> GroupKind:
        """Whether it adds nothing, takes motions or gives some."""
        return "zero" if self.mobility == 0 else "minus" if self.mobility < 0 else "plus"

    @property
    def net(self) -> int:
        """Constraints that it imposes, those of the pair it may stand for: -W."""
        return -self.mobility


def group(constraints: Sequence[int]) -> Group:
    """Return a chain by its string of constraints, as 5-4-3.

    constraints: s of each pair, 1 to 5; at least two pairs.
    Book (2): a zero group has 6m = Σs, a minus-s group 6m - Σs = -s.
    """
    if len(constraints) < 2:
        text = _("{count} pairs given; a group has at least one link and two pairs")
        raise refuse("constraints", text.format(count=len(constraints)), "out_of_range")
    for k, one in enumerate(constraints):
        if not 1 <= one <= MOST:
            text = _("{value} is not a number of constraints of a pair: 1 to {most}")
            raise refuse(f"constraints[{k}]", text.format(value=one, most=MOST), "out_of_range")
    return Group(constraints=tuple(int(one) for one in constraints))


def zero_groups(links: int) -> tuple[Group, ...]:
    """Return all zero groups that are simple chains of so many links, each once, in descending order.

    Parameters
    ----------
    links : int
        m, at least 1; beyond 5 there are none.

    Notes
    -----
    Book Table 2, restored by enumeration: chains of m + 1 pairs with Σf = 6. A chain read from its other end is the
    same; of both strings the larger one counts.

    Examples
    --------
    >>> ["".join(map(str, one.constraints)) for one in zero_groups(2)]
    ['552', '543', '534', '525', '453', '444']
    """
    return _chains(links, 6)


def minus_groups(constraints: int, links: int) -> tuple[Group, ...]:
    """Return all chains of so many links that impose so many constraints; see `zero_groups`.

    Notes
    -----
    Book Table 3, restored by enumeration: chains of m + 1 pairs with Σf = 6 - s.

    Examples
    --------
    >>> ["".join(map(str, one.constraints)) for one in minus_groups(1, 2)]
    ['553', '544', '535', '454']
    """
    return _chains(links, 6 - constraints)


def _chains(links: int, freedoms: int) -> tuple[Group, ...]:
    """Return chains of pairs whose freedoms add up to a number, each once up to reversal."""
    strings = {tuple(6 - f for f in parts) for parts in _parts(freedoms, links + 1)}
    kept = {max(string, string[::-1]) for string in strings}
    return tuple(Group(constraints=string) for string in sorted(kept, reverse=True))


def _parts(total: int, count: int) -> Iterator[tuple[int, ...]]:
    """Yield all ways to write a number as so many summands of 1 to 5, order counting."""
    if count == 0:
        if total == 0:
            yield ()
        return
    for first in range(1, min(MOST, total - count + 1) + 1):
        for rest in _parts(total - first, count - 1):
            yield (first, *rest)
