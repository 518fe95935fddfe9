"""A mechanism: links joined by pairs, one of the links at rest."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar

from cardan.errors import Problem, check
from cardan.texts import _
from cardan.units import nearest, plain

from .pair import Pair, pair_problems

MAX_JOINTS = 400
"""More joints are refused: their ranks would take minutes."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Mechanism:
    """Links and the joints between them, in the position in which it is assembled, in SI.

    Links are those that the joints name. Two joints between the same links are allowed.

    Raises
    ------
    InputError
        With everything that is wrong, each with its path.

    Examples
    --------
    A door on its hinge:

    >>> hinge = Pair(id="hinge", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0))
    >>> Mechanism(frame="wall", joints=(hinge,)).links
    ('door',)
    """

    format: ClassVar[int] = 1

    name: str = plain("", doc="name of the mechanism")
    note: str = plain("", doc="what the reader should know")
    frame: str = plain(doc="the link at rest")
    input_link: str = plain("", doc="link that is driven")
    output_link: str = plain("", doc="link that is to move")
    joints: tuple[Pair, ...] = plain(doc="the joints")

    def __post_init__(self) -> None:
        check(problems(self))

    @property
    def links(self) -> tuple[str, ...]:
        """The moving links, in the order in which the joints name them."""
        every = dict.fromkeys(link for pair in self.joints for link in pair.links)
        return tuple(link for link in every if link != self.frame)

    @property
    def constraints(self) -> int:
        """Sum of the constraints of all joints, Σs."""
        return sum(pair.kind.constraints for pair in self.joints)

    @property
    def loops(self) -> int:
        """Number of independent loops, k = joints - moving links."""
        return len(self.joints) - len(self.links)

    @property
    def formula(self) -> int:
        """Mobility by counting, 6n - Σs (Somov and Malyshev)."""
        return 6 * len(self.links) - self.constraints

    def index(self, joint: str) -> int:
        """Return which of the joints has a name."""
        return [pair.id for pair in self.joints].index(joint)


def problems(mechanism: Mechanism) -> Iterator[Problem]:
    """Yield everything that is wrong with a mechanism."""
    joints = mechanism.joints
    if not joints:
        yield Problem("joints", _("empty: no link can move, so there is nothing to ask"), "empty")
        return
    if len(joints) > MAX_JOINTS:
        text = _("{n} joints given; the limit is {limit}").format(n=len(joints), limit=MAX_JOINTS)
        yield Problem("joints", text, "out_of_range")
        return
    seen: dict[str, int] = {}
    for k, pair in enumerate(joints):
        if pair.id in seen:
            text = _("{name} is the name of joint {number} already").format(
                name=repr(pair.id), number=seen[pair.id] + 1
            )
            yield Problem(f"joints[{k}].id", text, "inconsistent")
        seen.setdefault(pair.id, k)
        if not all(map(math.isfinite, pair.point)):
            yield Problem(f"joints[{k}].point", _("{value} is not finite").format(value=list(pair.point)), "not_finite")
        for problem in pair_problems(pair):
            yield Problem(f"joints[{k}].{problem.field}", problem.message, problem.code)
    held = joined_to(mechanism.frame, joints)
    loose = [link for link in mechanism.links if link not in held]
    if loose:
        text = _("nothing joins these links to the frame, {frame}: {links}")
        yield Problem("joints", text.format(frame=repr(mechanism.frame), links=", ".join(loose)), "inconsistent")
    known = mechanism.links
    for name in ("input_link", "output_link"):
        link = getattr(mechanism, name)
        if link and link not in known:
            yield Problem(name, _no_link(link, mechanism.frame, known), "inconsistent")


def _no_link(link: str, frame: str, known: tuple[str, ...]) -> str:
    if link == frame:
        return _("{link} is the frame; it does not move").format(link=repr(link))
    near = nearest(link, known)
    hint = _("; did you mean {near}?").format(near=near) if near else ""
    return _("no joint names a link {link}").format(link=repr(link)) + hint


def joined_to(link: str, joints: Iterable[Pair]) -> set[str]:
    """Return all links that joints connect with one, itself among them.

    >>> hinge = Pair(id="hinge", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0))
    >>> sorted(joined_to("wall", [hinge]))
    ['door', 'wall']
    """
    pairs = [pair.links for pair in joints]
    found = {link}
    while True:
        more = {other for pair in pairs if found & set(pair) for other in pair} - found
        if not more:
            return found
        found |= more
