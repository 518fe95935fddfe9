"""Structural groups: chains of links that hold themselves just enough, or impose so many constraints; enumerated."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cardan.errors import refuse
from cardan.texts import _

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
