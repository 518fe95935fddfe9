"""What a joint is inside: its links and pairs, as a mechanism has them.

A kind yields its `InnerPair`s for a `Stance`; whoever builds a mechanism puts them between the shafts of a drive.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.texts import mark

# Where a joint stands: its centre, its shafts and its marks, as bodies and inner mechanisms need them.


@dataclass(frozen=True, eq=False, kw_only=True)
class Stance:
    """A joint in space, at one place of a turn or at many (...); where shafts wobble, all but its length are many."""

    centre: Array  # (3,) [m]: where its shafts meet
    before: Array  # before, after (3,): directions of the driving and the driven shaft, both along the power flow
    after: Array  # (3,)
    normal: Array  # (3,): normal of the plane of both
    joint_angle: float | Array  # [rad]: angle between them
    drawn_angle: float | None = None  # [rad]: the same as drawn, where errors move the shafts
    # driving, driven (..., 3): directions of its marks: the arms of its cross in the driving and the driven yoke, where
    # it has one
    driving: Array
    driven: Array  # (..., 3)
    length: float  # [m]: length of the driven shaft

    @property
    def theta(self) -> Array:
        """Angle of the driving mark from the plane of the shafts, array (...) [rad]."""
        across = frames.cross(self.normal, self.before)
        found: Array = np.arctan2(frames.dot(self.driving, self.normal), frames.dot(self.driving, across))
        return found

    @property
    def middle(self) -> Array:
        """Normal of the plane that halves the joint angle, array (3,)."""
        return frames.unit(self.before + self.after)

    def halving(self, turn: Array) -> Array:
        """Return the direction in the halving plane whose meridian stands at an angle (...) [rad], array (..., 3)."""
        across = frames.cross(self.normal, self.middle)
        chi = np.arctan2(np.sin(turn) * np.cos(0.5 * self.joint_angle), np.cos(turn))
        found: Array = np.cos(chi)[..., None] * across + np.sin(chi)[..., None] * self.normal
        return found


DRIVING, DRIVEN = "driving", "driven"  # links that every joint has: its shafts
FRAME = "frame"  # what holds the shafts
ARM = 0.1  # distance of a point of contact from the axis over the length of the shaft behind; any but nought would do


@dataclass(frozen=True, kw_only=True)
class Contact:
    """What touches in a pair as Hertz has it: sums of the curvatures of both bodies in their principal planes [1/m].

    Arrays (...) where they change as the joint turns.
    """

    across: float | Array  # across the way on which it runs; hollow bodies count as negative
    along: float | Array


@dataclass(frozen=True, eq=False, kw_only=True)
class Tolerated:
    """How far the second half of a pair may be off as built: in any direction, so each is the length of a vector."""

    name: str  # what its file calls the pair
    field: str  # path of the pair in the joint
    shift: float  # [m]
    turn: float  # [rad]
    axes: Array  # (..., 3, 3): turn of its second link, with which what is off goes, from where its file draws it


@dataclass(frozen=True, eq=False, kw_only=True)
class InnerPair:
    """A pair inside a joint, where it stands: at one place of a turn or, with leading axes (...), at many."""

    # what it is called, marked for translation, with the place {number} for the number of its joint, and {count} for
    # which of several alike it is
    name: str
    type: str  # kind of pair, a name of `cardan.mechanism.mechanism.PAIRS`
    links: tuple[str, str]  # `DRIVING`, `DRIVEN` or the name of an inner link, like ``name``
    point: Array  # (3,) [m]
    axis: Array  # (3,)
    second: Array | None = None  # (3,): second axis, of kinds that have two
    count: int = 1  # which of several pairs and links alike, from 1
    repeats: bool = False  # whether it holds what others alike hold already, but for play or give
    rubs: bool = False  # whether it rubs where the joint has a coefficient of friction
    friction: float | None = None  # its own coefficient of friction, else that of the joint
    lever: float = 0.0  # [m]: at which what turns in it rubs
    spread: float = math.inf  # [m]: between its two bearings, where it has two
    contact: Contact | None = None  # what touches in it, where its sizes are given
    area: float = 0.0  # [m²]: of one of its bearings, seen along the load; 0 where it is not given
    # [m]: how fast it slides over the speed of the driving shaft, told by its kind where its links leave that open
    slip: float | Array = 0.0
    rolls: float = 0.0  # [m]: radius at which what slides in it rolls on its bearing
    told: bool = True  # whether what it carries is told, of pairs by which a joint is `Joint.loaded`
    tolerated: Tolerated | None = None  # how far it may be off, where its kind has that of its pairs


def bending(stance: Stance) -> Iterator[InnerPair]:
    """Yield a joint that turns about two axes of the plane that halves its joint angle, and holds the rest."""
    name = mark("joint {number}")
    yield _bending(name, (DRIVING, DRIVEN), stance)


def sliding(stance: Stance) -> Iterator[InnerPair]:
    """Yield a joint that bends and also lets its shafts slide along each other."""
    part = mark("middle of joint {number}")
    slide = mark("slide of joint {number}")
    yield InnerPair(name=slide, type="P", links=(DRIVING, part), point=stance.centre, axis=stance.before)
    yield _bending(mark("joint {number}"), (part, DRIVEN), stance)


def _bending(name: str, links: tuple[str, str], stance: Stance) -> InnerPair:
    second = frames.cross(stance.middle, stance.normal)
    return InnerPair(name=name, type="U", links=links, point=stance.centre, axis=stance.normal, second=second)


def centred(name: str, stance: Stance) -> InnerPair:
    """Return what holds the centre of a joint and leaves all turns free."""
    return InnerPair(name=name, type="S", links=(DRIVING, DRIVEN), point=stance.centre, axis=stance.before)


def touching(stance: Stance) -> Iterator[InnerPair]:
    """Yield a joint that holds nothing but the torque: shafts that touch at one point beside the axis."""
    point = stance.centre + ARM * stance.length * stance.driven
    axis = frames.cross(stance.after, stance.driven)
    yield InnerPair(name=mark("contact of joint {number}"), type="PT", links=(DRIVING, DRIVEN), point=point, axis=axis)


def carried(stance: Stance, *, loose: bool = False, slides: bool = False) -> Iterator[InnerPair]:
    """Yield what holds both shafts of a joint as a drive does.

    loose: the driven shaft in a fixed bearing; else it keeps its direction only, as the joint holds its centre.
    slides: it is held along its axis too.
    """
    yield InnerPair(name="driving bearing", type="R", links=(FRAME, DRIVING), point=stance.centre, axis=stance.before)
    if loose:
        yield InnerPair(name="driven bearing", type="R", links=(FRAME, DRIVEN), point=stance.centre, axis=stance.after)
        return
    at, axis, guide = stance.centre, stance.after, FRAME if slides else "guide"
    if not slides:
        yield InnerPair(name="driven guide", type="P", links=(FRAME, guide), point=at, axis=axis)
    yield InnerPair(name="driven face", type="E", links=(guide, DRIVEN), point=at, axis=axis)


def guided(stance: Stance, held: Array) -> Iterator[InnerPair]:
    """Yield what holds both shafts of a joint that holds its driven shaft in some directions alone, (..., k, 3).

    It stands in a bearing that can shift along each of them.
    """
    yield InnerPair(name="driving bearing", type="R", links=(FRAME, DRIVING), point=stance.centre, axis=stance.before)
    link = FRAME
    for k in range(held.shape[-2]):
        guide = f"guide {k + 1}"
        yield InnerPair(name="driven guide", type="P", links=(link, guide), point=stance.centre, axis=held[..., k, :])
        link = guide
    yield InnerPair(name="driven bearing", type="R", links=(link, DRIVEN), point=stance.centre, axis=stance.after)


def crossed(
    stance: Stance, *, slides: bool | str = False, offset: float = 0.0, journal: float = 0.0, span: float = math.inf
) -> Iterator[InnerPair]:
    """Yield both pins of a cross.

    slides: which of its journals slide in their bearings: all, none, or "driving" or "driven".
    offset [m]: distance of both pins, along their common perpendicular.
    journal, span [m]: diameter of the journals, and between the middles of opposite bearings, for their friction.
    """
    link = mark("cross {number}")
    aside = frames.cross(stance.driving, stance.driven)
    rows = (
        (mark("driving pin of joint {number}"), (DRIVING, link), DRIVING, stance.driving),
        (mark("driven pin of joint {number}"), (link, DRIVEN), DRIVEN, stance.driven),
    )
    for k, (name, links, side, axis) in enumerate(rows):
        kind = "C" if slides is True or slides == side else "R"
        at = stance.centre + k * offset * aside
        sizes = 0.5 * journal, span
        yield InnerPair(
            name=name, type=kind, links=links, point=at, axis=axis, rubs=True, lever=sizes[0], spread=sizes[1]
        )
