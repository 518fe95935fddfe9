"""What to let go so that a mechanism binds no more: the simplest changes of its bearings and pins, best first."""

from __future__ import annotations

import heapq
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import Literal, TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames, screws
from cardan.mechanism.constraints import Constraints, constraints
from cardan.mechanism.mechanism import LENGTHS, Mechanism, Pair, Point, Way, axes
from cardan.mechanism.rounding import exactly
from cardan.texts import _
from cardan.units import nearest

from .drive_mechanism import mechanism_of
from .finite_mobility import locks_at
from .mobility import TAKES_PART, JointHold, stresses

Gain: TypeAlias = Literal["slide", "align", "align_slide", "turn", "link", "drop"]

CHANGES: dict[str, tuple[tuple[str, Gain], ...]] = {
    "R": (("C", "slide"), ("S", "align"), ("SG", "align_slide"), ("RR", "link"), ("", "drop")),
    "C": (("SG", "align"), ("", "drop")),
    "S": (("SG", "slide"), ("", "drop")),
    "P": (("C", "turn"),),
    "U": (("S", "turn"),),
    "SG": (("", "drop"),),
}
"""Kind of pair -> kinds that leave more, and what they add; none: a bearing that is left out.

RR: a group in the place of the hinge, two hinges with a link between them, Book p. 78, link 11.
"""

TROUBLE: dict[Gain, float] = {"slide": 1.0, "align": 1.1, "align_slide": 1.6, "turn": 2.5, "link": 3.0, "drop": 2.0}
"""How much work each change is: a floating bearing is the cheapest, then a self-aligning one."""

FIRM = 1.5
"""Leaving out a bearing that holds more than two motions is so much more work beyond `TROUBLE`."""

PIN = 2.5
"""A change between two moving links is so many times the work of one at a bearing in the frame."""

DRIVEN = 1.5
"""A change at the bearing of the input link, which is to be driven, is so many times the work of one elsewhere."""

PLAIN = 12
"""Decimals of the direction of an added hinge; what is beyond is rounding."""

EXPANSIONS = 4000
"""Sets of changes looked at; in order of their cost, so that the first found are the best."""

MOST = 5
"""Repairs told of."""

TRIED = 12
"""Repairs that are made to see whether the mechanism turns with them."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Change:
    """Another kind of pair in the place of a joint."""

    joint: str  # name of the joint
    links: tuple[str, str]  # what it joins
    bearing: bool  # whether one of them is the frame
    before: str  # before, after: kinds of pair; ``after`` is empty where the bearing is left out
    after: str
    gain: Gain  # what it adds
    freedoms: int  # how many freedoms that are
    axis: Point | None = None  # of the hinge between an added link and the second one of ``links``


@dataclass(frozen=True, kw_only=True, slots=True)
class Repair:
    """Changes that take redundant constraints away and let nothing loose.

    Attributes
    ----------
    changes : tuple of Change
        All to be made.
    before, after : int
        Redundant constraints without and with them; the mobility stays.
    trouble : float
        How much work it is, see `TROUBLE`.
    """

    changes: tuple[Change, ...]
    before: int
    after: int
    trouble: float


def repairs(thing: Drive | Mechanism, *, most: int = MOST, links: bool = True) -> tuple[Repair, ...]:
    """Return changes after which a mechanism is held just enough, the simplest first.

    Parameters
    ----------
    thing : Drive or Mechanism
    most : int
        So many at most.
    links : bool
        Whether links may be added to a mechanism.

    Returns
    -------
    tuple of Repair
        Empty where nothing is redundant, or where no change of a bearing or pin helps. Where none takes all redundant
        constraints away, those that take most.

    Raises
    ------
    InputError
        A drive that is no mechanism yet, see `cardan.questions.mobility.mobility.mobility`.

    See Also
    --------
    release, mobility

    Notes
    -----
    A freedom that is added takes one redundant constraint away if it does work on a state of stress; several do if the
    works they do on all states are linearly independent. So no rank of the mechanism is needed, only of a table of q
    rows. Sets of changes are tried in order of `TROUBLE`, each joint changed once.

    Examples
    --------
    >>> from cardan.mechanisms import Mechanism, Pair, repairs
    >>> hooke = [
    ...     Pair(id="A", type="R", links=("0", "1"), point=(-0.3, 0.0, 0.0), axis=(1.0, 0.0, 0.0)),
    ...     Pair(id="B", type="R", links=("1", "2"), point=(0.0, 0.0, 0.0), axis=(0.0, 1.0, 0.0)),
    ...     Pair(id="C", type="R", links=("2", "3"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0)),
    ...     Pair(id="D", type="R", links=("3", "0"), point=(0.3, 0.1, 0.0), axis=(0.3, 0.1, 0.0)),
    ... ]
    >>> best = repairs(Mechanism(frame="0", joints=tuple(hooke)))[0]
    >>> [(one.joint, one.after) for one in best.changes], best.after
    ([('A', 'SG')], 0)
    """
    if not isinstance(thing, Mechanism):
        thing, links = mechanism_of(thing), False
    thing = exactly(thing)
    system = constraints(thing)
    stress = stresses(system)
    redundant = len(stress)
    options = [option for j, pair in enumerate(thing.joints) for option in _options(thing, system, stress, j, pair)]
    options = [one for one in options if links or one.change.gain != "link"]
    if not redundant or not options:
        return ()
    found = [
        Repair(
            changes=tuple(options[k].change for k in chosen),
            before=redundant,
            after=redundant - sum(options[k].change.freedoms for k in chosen),
            trouble=cost,
        )
        for cost, chosen in _search(options, redundant, most)
    ]
    least = min((one.after for one in found), default=redundant)
    return tuple(sorted((one for one in found if one.after == least), key=lambda one: one.trouble))


def working(mechanism: Mechanism, *, most: int = MOST, links: bool = True) -> tuple[Repair, ...]:
    """Return those `repairs` with which a mechanism turns all round, the simplest first.

    Each is made, and the loops of what comes out are followed over a turn of the input; where no input is named that
    could be turned, what holds in the position given has to do.
    """
    found: list[Repair] = []
    for one in repairs(mechanism, most=TRIED, links=links):
        if not mechanism.input_link or _turns(repaired(mechanism, one)):
            found.append(one)
        if len(found) == most:
            break
    return tuple(found)


def _turns(mechanism: Mechanism) -> bool:
    """Tell whether the input of a mechanism turns all round."""
    try:
        return locks_at(mechanism) is None
    except InputError:  # nothing is left by which it could be driven
        return False


def repaired(mechanism: Mechanism, repair: Repair) -> Mechanism:
    """Return a mechanism with the changes of a repair made."""
    kinds = {change.joint: change.after for change in repair.changes}
    hinged = {change.joint: change.axis for change in repair.changes if change.gain == "link"}
    taken = {pair.id for pair in mechanism.joints} | {*mechanism.links, mechanism.frame}
    joints = []
    for pair in mechanism.joints:
        kind = kinds.get(pair.id, pair.type)
        if not kind:
            continue
        if pair.id in hinged:
            new = next(f"{pair.id} {k}" for k in count(2) if f"{pair.id} {k}" not in taken)
            joints.append(replace(pair, links=(pair.links[0], new)))
            joints.append(Pair(id=new, type="R", links=(new, pair.links[1]), point=pair.point, axis=hinged[pair.id]))
            continue
        joints.append(replace(pair, type=kind, axis2=None if kind != pair.type else pair.axis2))
    return replace(mechanism, joints=tuple(joints))


def advice(change: Change, mechanism: Mechanism) -> str:
    """Return a change as a sentence."""
    if change.bearing:
        link = next(link for link in change.links if link != mechanism.frame)
        where = change.joint
        if not re.search(rf"\b{re.escape(link)}\b", where):
            where = _("the bearing of {link}, {joint},").format(link=link, joint=change.joint)
        text = {
            "slide": _("let {where} float along its axis"),
            "align": _("make {where} self-aligning"),
            "align_slide": _("make {where} self-aligning and axially free"),
            "turn": _("let {where} turn about its axis too"),
            "link": _("add a link at {joint}, hinged to {other} about {axis} too"),
            "drop": _("omit {joint}"),
        }[change.gain]
        return text.format(where=where, joint=change.joint, other=change.links[1], axis=_direction(change))
    text = {
        "slide": _("let {joint}, between {one} and {other}, slide along its axis"),
        "align": _("make {joint}, between {one} and {other}, a ball joint"),
        "align_slide": _("make {joint}, between {one} and {other}, a ball that slides along its axis"),
        "turn": _("let {joint}, between {one} and {other}, turn one way more"),
        "link": _("add a link at {joint}, between {one} and {other}, hinged to {other} about {axis} too"),
    }[change.gain]
    return text.format(joint=change.joint, one=change.links[0], other=change.links[1], axis=_direction(change))


def _direction(change: Change) -> str:
    """Return the axis of an added hinge as a file writes it."""
    return "[{}]".format(", ".join(f"{one:.3g}" for one in change.axis or ()))


def strain(hold: JointHold) -> str:
    """Return what errors of the parts can load a joint with, in words; empty where nothing.

    >>> from .mobility import mobility
    >>> upper = Pair(id="upper", type="R", links=("wall", "door"), point=(0.0, 0.0, 2.0), axis=(0.0, 0.0, 1.0))
    >>> lower = Pair(id="lower", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.2), axis=(0.0, 0.0, 1.0))
    >>> strain(mobility(Mechanism(frame="wall", joints=(upper, lower))).joints[0])
    'force along and across its axis, couple across it'
    """
    along, *across = (word == "strained" for word in hold.sliding)
    about, *tilting = (word == "strained" for word in hold.turning)
    force = {
        (True, True): _("force along and across its axis"),
        (True, False): _("force along its axis"),
        (False, True): _("force across its axis"),
        (False, False): "",
    }[along, any(across)]
    couple = {
        (True, True): _("couple about and across it"),
        (True, False): _("couple about it"),
        (False, True): _("couple across it"),
        (False, False): "",
    }[about, any(tilting)]
    return ", ".join(part for part in (force, couple) if part)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Option:
    """A change and the work of its freedoms on the states of stress, array (freedoms, q)."""

    change: Change
    joint: int
    work: Array
    cost: float


def _options(mechanism: Mechanism, system: Constraints, stress: Array, j: int, pair: Pair) -> Iterator[_Option]:
    """Yield the changes of a joint that are sound by themselves."""
    bearing = mechanism.frame in pair.links
    for after, gain in CHANGES.get(pair.type, ()):
        if pair.axis is None or (gain == "drop" and not bearing):
            continue
        if gain == "link" and bearing and mechanism.input_link in pair.links:
            continue  # the bearing of the input tells about which axis it turns
        added = _added(pair, gain, system)
        work, axis = added @ stress[:, j].T, None
        if gain == "link":  # one hinge, about the direction across the pin that does most work
            best = np.linalg.svd(work)[0][:, 0]
            axis = tuple((np.round(best @ axes(pair)[1:], PLAIN) + 0.0).tolist())
            added, work = best[None] @ added, best[None] @ work
        if _rank(work) < len(added):
            continue
        change = Change(
            joint=pair.id,
            links=pair.links,
            bearing=bearing,
            before=pair.type,
            after=after,
            gain=gain,
            freedoms=len(added),
            axis=axis,
        )
        place = 1.0 if gain == "link" else PIN if not bearing else DRIVEN if mechanism.input_link in pair.links else 1.0
        trouble = TROUBLE[gain] + (FIRM if gain == "drop" and len(added) > 2 else 0.0)
        yield _Option(change=change, joint=j, work=work, cost=trouble * place)


def _added(pair: Pair, gain: Gain, system: Constraints) -> Array:
    """Return the freedoms that a change adds, orthogonal to each other, about the middle."""
    point, along = system.place(pair.point), pair.along
    slide = screws.translation(along)[None]
    if gain == "slide":
        return slide
    if gain == "turn":
        about = along
        if pair.axis2 is not None:
            about = frames.unit(frames.cross(along, np.asarray(pair.axis2, dtype=float)))
        return screws.rotation(about, point)[None]
    across = axes(pair)[1:]
    tilts = screws.rotation(across, point)
    if gain == "drop":
        held = {"SG": (), "S": (slide,), "C": (tilts,), "R": (slide, tilts)}[pair.type]
        return np.concatenate((screws.translation(across), *held))
    return tilts if gain in ("align", "link") else np.concatenate((tilts, slide))


def _rank(work: Array) -> Array:
    """Return how many freedoms do work apart from each other, of tables (..., freedoms, q), array (...) of int."""
    found: Array = np.sum(np.linalg.svd(work, compute_uv=False) > TAKES_PART, axis=-1)
    return found


def _search(options: Sequence[_Option], redundant: int, most: int) -> list[tuple[float, tuple[int, ...]]]:
    """Return sound sets of options that take all redundant constraints away, cheapest first; else those that take most.

    Best first by cost so far and the least that the rest can cost; options are added in the order of joints.
    """
    rate = min(one.cost / one.change.freedoms for one in options)
    ticket = count()
    heap: list[tuple[float, int, float, tuple[int, ...], int]] = [(redundant * rate, next(ticket), 0.0, (), redundant)]
    whole: list[tuple[float, tuple[int, ...]]] = []
    partial: tuple[int, list[tuple[float, tuple[int, ...]]]] = (redundant, [])
    for _round in range(EXPANSIONS):
        if not heap or len(whole) >= most:
            break
        _bound, _number, cost, chosen, left = heapq.heappop(heap)
        if left == 0:
            whole.append((cost, chosen))
            continue
        if chosen and left <= partial[0]:
            kept = partial[1] if left == partial[0] else []
            partial = left, [*kept, (cost, chosen)][:most]
        after = options[chosen[-1]].joint if chosen else -1
        fit = [k for k, one in enumerate(options) if one.joint > after and one.change.freedoms <= left]
        for k in fit if not chosen else _sound(options, chosen, fit):
            spent, rest = cost + options[k].cost, left - options[k].change.freedoms
            heapq.heappush(heap, (spent + rest * rate, next(ticket), spent, (*chosen, k), rest))
    return whole or _greedy(options, redundant, partial)


def _sound(options: Sequence[_Option], chosen: tuple[int, ...], others: Sequence[int]) -> list[int]:
    """Return those of other options whose freedoms do work apart from each other and from those chosen, in order."""
    own = np.concatenate([options[k].work for k in chosen])
    found: list[int] = []
    for size in {options[k].change.freedoms for k in others}:
        alike = [k for k in others if options[k].change.freedoms == size]
        work = np.stack([np.concatenate((own, options[k].work)) for k in alike])
        found += [k for k, rank in zip(alike, _rank(work), strict=True) if rank == len(own) + size]
    return sorted(found)


def _greedy(
    options: Sequence[_Option], redundant: int, partial: tuple[int, list[tuple[float, tuple[int, ...]]]]
) -> list[tuple[float, tuple[int, ...]]]:
    """Return the best of what the search found in part and of what taking the cheapest sound option each time finds."""
    left = redundant
    chosen: list[int] = []
    ranked = sorted(range(len(options)), key=lambda k: options[k].cost / options[k].change.freedoms)
    for k in ranked:
        option = options[k]
        if option.change.freedoms > left or any(options[other].joint == option.joint for other in chosen):
            continue
        table = np.concatenate([options[other].work for other in (*chosen, k)])
        if _rank(table) == len(table):
            chosen.append(k)
            left -= option.change.freedoms
    cost = sum(options[k].cost for k in chosen)
    return [(cost, tuple(sorted(chosen)))] if chosen and left < partial[0] else partial[1]


# Which joint must be freed, and in which direction, so that a mechanism is no longer held too much?


@dataclass(frozen=True, kw_only=True, slots=True)
class Release:
    """What one more freedom at a joint does.

    Attributes
    ----------
    joint : str
        Name of the joint.
    way : "rot" or "trans"
        Whether it may turn or slide.
    redundant : int
        Change of the redundant constraints q.
    mobility : int
        Change of the mobility W.
    """

    joint: str
    way: Way
    redundant: int
    mobility: int

    @property
    def verdict(self) -> Literal["remedy", "spoil", "free"]:
        """Whether it takes a redundant constraint away, lets something loose, or was free before."""
        return "remedy" if self.redundant < 0 else "spoil" if self.mobility > 0 else "free"


def release(mechanism: Mechanism, joint: str, way: Way, axis: ArrayLike) -> Release:
    """Return what one more freedom at a joint does to a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
    joint : str
        Name of the joint.
    way : "rot" or "trans"
        Whether it may turn about the axis through its point, or slide along it.
    axis : array (3,)
        Direction, of any length.

    Returns
    -------
    Release

    Raises
    ------
    InputError
        No such joint or way, or no direction.

    See Also
    --------
    repairs, mobility

    Notes
    -----
    Either the freedom takes part in a state of stress, then q falls by one, or it does not, then W rises by one; what
    the joint could do before changes nothing. Ranks are taken anew.

    Examples
    --------
    >>> from cardan.mechanisms import Mechanism, Pair, release
    >>> hinge = Pair(id="upper", type="R", links=("wall", "door"), point=(0.0, 0.0, 2.0), axis=(0.0, 0.0, 1.0))
    >>> lower = Pair(id="lower", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.2), axis=(0.0, 0.0, 1.0))
    >>> release(Mechanism(frame="wall", joints=(hinge, lower)), "upper", "trans", [0.0, 0.0, 1.0]).verdict
    'remedy'
    """
    names = [pair.id for pair in mechanism.joints]
    if joint not in names:
        near = nearest(joint, names)
        hint = _("; did you mean {near}?").format(near=near) if near else ""
        raise refuse("joint", _("there is no joint {name}").format(name=repr(joint)) + hint, "inconsistent")
    if way not in ("rot", "trans"):
        raise refuse("way", _("{value} is none of {choices}").format(value=repr(way), choices="rot, trans"))
    direction = np.asarray(axis, dtype=float)
    if direction.shape != (3,) or not LENGTHS[0] < math.hypot(*direction) < LENGTHS[1]:
        raise refuse("axis", _("{value} is not a direction").format(value=direction.tolist()), "out_of_range")
    system = constraints(mechanism)
    number = names.index(joint)
    unit = frames.unit(direction)
    point = system.place(mechanism.joints[number].point)
    twist = screws.rotation(unit, point) if way == "rot" else screws.translation(unit)
    after = system.with_freedom(number, twist[None])
    (before_w, before_q), (after_w, after_q) = (_numbers(one.matrix()) for one in (system, after))
    return Release(joint=joint, way=way, redundant=after_q - before_q, mobility=after_w - before_w)


def _numbers(matrix: np.ndarray) -> tuple[int, int]:
    """Return mobility and redundant constraints of a matrix of constraints."""
    rank = screws.rank(matrix).value
    return matrix.shape[1] - rank, matrix.shape[0] - rank
