"""A mechanism: links joined by pairs, one of the links at rest, and the small motions that pairs leave."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.texts import _, mark
from cardan.units import nearest, plain, quantity

from .load import LinkMass, Load

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

    >>> from cardan.mechanisms import Mechanism, Pair
    >>> hinge = Pair(id="hinge", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0))
    >>> Mechanism(frame="wall", joints=(hinge,)).links
    ('door',)
    """

    format: ClassVar[int] = 1

    name: str = plain("", doc="name of the mechanism")
    note: str = plain("", doc="what the reader should know")
    frame: str = plain(doc="the link at rest")
    input_link: str = plain("", doc="link that is driven")
    input_joint: str = plain("", doc="joint that is driven, a hydraulic cylinder; that of input_link with the frame")
    output_link: str = plain("", doc="link that is to move")
    speed: float | None = quantity("angular_speed", None, doc="speed at which the input link turns, uniformly")
    input_range: tuple[float, float] | None = quantity(
        "angle", None, doc="angles of the input link from the position drawn between which it moves; a whole turn"
    )
    sliding_speed: float | None = quantity("speed", None, doc="speed at which an input link that slides moves")
    input_stroke: tuple[float, float] | None = quantity(
        "length", None, doc="paths of an input link that slides from the position drawn, between which it moves"
    )
    output_torque: float | None = quantity("torque", None, doc="torque that resists an output link that turns", low=0.0)
    output_force: float | None = quantity("force", None, doc="force that resists an output link that slides", low=0.0)
    gravity: Point = quantity("acceleration", (0.0, 0.0, 0.0), doc="acceleration of free fall [x, y, z]")
    rounding: float | None = quantity(
        "length",
        None,
        doc="how far points, and axes over the size, may be off as their numbers are rounded; the least changes that "
        "close all loops are made, and told",
        above=0.0,
    )
    joints: tuple[Pair, ...] = plain(doc="the joints")
    masses: tuple[LinkMass, ...] = plain((), doc="what the links weigh; the others count as without mass")
    loads: tuple[Load, ...] = plain((), doc="forces and torques on the links")

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

    @property
    def driving(self) -> Pair | None:
        """The pair of the input link that is driven along its axis: that named, or one with the frame, R before P."""
        ends = {self.frame, self.input_link}
        own = [one for one in self.joints if set(one.links) == ends]
        if self.input_joint:
            own = [one for one in self.joints if one.id == self.input_joint]
        return next((pair for kind in ("R", "P") for pair in own if pair.type == kind), None)

    @property
    def base(self) -> str:
        """The link against which the input link is driven: the frame, but where another joint is named."""
        return self.frame if self.driving is None else next(one for one in self.driving.links if one != self.input_link)

    @property
    def slides(self) -> bool:
        """Whether the input link slides: angles, torque and speed of the input are lengths, force and speed then."""
        return self.driving is not None and self.driving.type == "P"

    @property
    def pace(self) -> float | None:
        """Speed of the input link [rad/s, of one that slides m/s]."""
        return self.sliding_speed if self.slides else self.speed

    @property
    def travel(self) -> tuple[float, float] | None:
        """Between where the input link moves, from where it is drawn [rad or m]; None of a stroke that is not given."""
        return self.input_stroke if self.slides else self.input_range or (0.0, 2.0 * math.pi)


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
    for k, pair in enumerate(joints):
        if pair.carrier and pair.carrier not in (*known, mechanism.frame):
            yield Problem(f"joints[{k}].carrier", _no_link(pair.carrier, mechanism.frame, known), "inconsistent")
    if mechanism.rounding is not None:
        yield from _rounding_problems(mechanism)
    yield from _load_problems(mechanism, known)


def _rounding_problems(mechanism: Mechanism) -> Iterator[Problem]:
    """Yield why no changes of a mechanism close its loops all along the way of its input."""
    rolling = next((pair.id for pair in mechanism.joints if pair.kind.rolls), "")
    if mechanism.driving is None or mechanism.travel is None:
        text = _(
            "of no use here: an input link that turns, or slides over a stroke, in a pair of type R or P tells how the "
            "loops are to close"
        )
        yield Problem("rounding", text, "inconsistent")
    elif rolling:
        text = _(
            "of no use here: {pair} rolls, it holds a speed, not a place; where its links stand depends on the way "
            "that they came, so that no changes of pairs close loops at every place"
        )
        yield Problem("rounding", text.format(pair=repr(rolling)), "inconsistent")


def _load_problems(mechanism: Mechanism, known: tuple[str, ...]) -> Iterator[Problem]:
    for name in ("masses", "loads"):
        for k, one in enumerate(getattr(mechanism, name)):
            if one.link not in known:
                yield Problem(f"{name}[{k}].link", _no_link(one.link, mechanism.frame, known), "inconsistent")
            for problem in one.problems():
                yield Problem(f"{name}[{k}].{problem.field}", problem.message, problem.code)
    given = [one.link for one in mechanism.masses]
    for k, link in enumerate(given):
        if link in given[:k]:
            text = _("{link} has a mass already, masses[{number}]").format(link=repr(link), number=given.index(link))
            yield Problem(f"masses[{k}].link", text, "inconsistent")
    if not all(map(math.isfinite, mechanism.gravity)):
        yield Problem("gravity", _("{value} is not finite").format(value=list(mechanism.gravity)), "not_finite")
    for name in ("input_range", "input_stroke"):
        low, high = getattr(mechanism, name) or (0.0, 1.0)
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            text = _("{value}: the first end of a range must lie below the second")
            yield Problem(name, text.format(value=[low, high]), "inconsistent")
    if mechanism.input_joint:
        yield from _input_joint_problems(mechanism)
    turning, sliding = ("speed", "input_range"), ("sliding_speed", "input_stroke")
    for name in turning if mechanism.slides else sliding:
        if getattr(mechanism, name) is not None:
            text = _("of no use: {link} is driven along a pair of type P; it has sliding_speed and input_stroke")
            if not mechanism.slides:
                text = _(
                    "of no use: {link} is not driven along a pair of type P with the frame, {frame}, or input_joint"
                )
            said = text.format(link=repr(mechanism.input_link), frame=repr(mechanism.frame))
            yield Problem(name, said, "inconsistent")
    if mechanism.output_torque is not None and mechanism.output_force is not None:
        yield Problem(
            "output_force", _("the output either turns or slides: give it a torque or a force"), "inconsistent"
        )
    for name in ("output_torque", "output_force"):
        if getattr(mechanism, name) is not None and not mechanism.output_link:
            yield Problem("output_link", _("missing: {name} says what resists it").format(name=name), "missing")


def _input_joint_problems(mechanism: Mechanism) -> Iterator[Problem]:
    name, link = mechanism.input_joint, mechanism.input_link
    named = [pair for pair in mechanism.joints if pair.id == name]
    if not named:
        near = nearest(name, [pair.id for pair in mechanism.joints])
        hint = _("; did you mean {near}?").format(near=near) if near else ""
        yield Problem("input_joint", _("there is no joint {name}").format(name=repr(name)) + hint, "inconsistent")
    elif named[0].type not in ("R", "P"):
        text = _("{name} is of type {type}; one of type R or P can be driven")
        yield Problem("input_joint", text.format(name=repr(name), type=named[0].type), "inconsistent")
    elif link not in named[0].links:
        text = _("{name} does not join the input link, {link}")
        yield Problem("input_joint", text.format(name=repr(name), link=repr(link)), "inconsistent")


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


# Kinematic pairs: which small motions two links that touch leave each other.

Point: TypeAlias = tuple[float, float, float]

Way: TypeAlias = Literal["rot", "trans"]

SQUARE = 1e-3
"""Cosine up to which two directions that a file writes with a few digits count as square to each other."""

LENGTHS = (1e-100, 1e100)
"""A direction whose length lies beyond these would lose itself when it is squared."""

PARALLEL = 1e-6
"""Sine below which two directions count as parallel."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Kind:
    """A kind of pair, by the motions it leaves."""

    name: str  # in words
    # about what it lets turn: nothing, ``axis``, ``both`` axes, or ``all`` directions
    turns: Literal["", "axis", "both", "all"] = ""
    # along what it lets slide: nothing, ``axis``, or all directions ``across`` it
    slides: Literal["", "axis", "across"] = ""
    screw: bool = False  # whether turning and sliding are one motion
    rolls: bool = False  # whether it holds a speed, not a place: what touches rolls without slip along its axis

    @property
    def freedoms(self) -> int:
        """Number of relative freedoms f, the genus of the pair."""
        turning = {"": 0, "axis": 1, "both": 2, "all": 3}[self.turns]
        return turning + (0 if self.screw else {"": 0, "axis": 1, "across": 2}[self.slides])

    @property
    def constraints(self) -> int:
        """Number of constraints s = 6 - f."""
        return 6 - self.freedoms

    @property
    def needs_axis(self) -> bool:
        """Whether its freedoms have a direction."""
        return bool(self.slides) or self.turns in ("axis", "both")

    @property
    def needs_second(self) -> bool:
        """Whether its freedoms have a second direction."""
        return self.turns == "both"


PAIRS: dict[str, Kind] = {
    "R": Kind(name=mark("revolute"), turns="axis"),
    "P": Kind(name=mark("prismatic"), slides="axis"),
    "H": Kind(name=mark("helical"), turns="axis", slides="axis", screw=True),
    "C": Kind(name=mark("cylindrical"), turns="axis", slides="axis"),
    "U": Kind(name=mark("universal (two axes)"), turns="both"),
    "S": Kind(name=mark("spherical"), turns="all"),
    "E": Kind(name=mark("planar"), turns="axis", slides="across"),
    "SG": Kind(name=mark("sphere in cylinder"), turns="all", slides="axis"),
    "L4": Kind(name=mark("cylinder on plane"), turns="both", slides="across"),
    "PT": Kind(name=mark("point on plane"), turns="all", slides="across"),
    "RO": Kind(name=mark("rolling contact"), turns="all", slides="across", rolls=True),
}
"""Code -> kind of pair; spec structure, "Kinematic pairs", after tmm Table 1.

In a rolling contact the points of both links that touch move equally fast along its axis; point and axis belong to a
third link, its carrier. It holds one force, as a point on a plane does, but no place: links roll as far as they like.
"""


@dataclass(frozen=True, kw_only=True, slots=True)
class Pair:
    """Two links that touch, where, and which motions that leaves.

    A groove or plane, and ``axis`` with it, belongs to the first link; a ball or cylinder, and ``point`` and ``axis2``
    with it, to the second. That matters only for motions that are not small.
    """

    id: str = plain(doc="name of the joint, its own")
    type: str = plain(doc="kind of pair", choices=tuple(PAIRS))
    links: tuple[str, str] = plain(
        doc="the two links it joins; a bore, groove or plane, and axis with it, belongs to the first, "
        "a ball to the second"
    )
    point: Point = quantity("length", doc="a point of its axis, its centre [x, y, z]")
    axis: Point | None = plain(None, doc="its axis, or the normal of its plane; any length [x, y, z]")
    axis2: Point | None = plain(None, doc="second axis of a universal pair, axis of the cylinder on a plane [x, y, z]")
    pitch: float | None = quantity("pitch", None, doc="lead of a helical pair, right-handed positive")
    carrier: str = plain("", doc="link with which the point of a rolling contact moves; the frame by default")
    traction: float | None = plain(None, doc="coefficient of friction of a rolling contact", above=0.0)
    pressing_force: float | None = quantity("force", None, doc="force that presses a rolling contact", above=0.0)
    friction: float | None = plain(
        None,
        doc="coefficient of friction of what turns or slides in it; in a joint of a drive instead of that of this",
        low=0.0,
    )
    diameter: float | None = quantity(
        "length", None, doc="diameter of its pin, ball or thread, at which it rubs", above=0.0
    )
    bearing_distance: float | None = quantity(
        "length", None, doc="distance of the two bearings of its pin, on which a couple across the pin rests", above=0.0
    )
    tolerance: float | None = quantity("length", None, doc="how far its second half may be off, any way", low=0.0)
    tolerance_turn: float | None = quantity(
        "angle", None, doc="how far its second half may be turned off, about any axis", low=0.0
    )
    misalignment: Point = quantity("length", (0.0, 0.0, 0.0), doc="how far its second half is off as built [x, y, z]")
    misalignment_turn: Point = quantity("angle", (0.0, 0.0, 0.0), doc="how far its second half is turned off [x, y, z]")

    @property
    def kind(self) -> Kind:
        """What is known of its kind."""
        return PAIRS[self.type]

    @property
    def rubs(self) -> bool:
        """Whether it is known how what turns in it rubs; what only slides rubs by its force alone."""
        pin = self.kind.turns != "axis" or self.bearing_distance is not None
        return not self.kind.turns or (self.diameter is not None and pin)

    @property
    def along(self) -> Array:
        """Unit vector of its axis; that of z where it has none."""
        return np.asarray([0.0, 0.0, 1.0]) if self.axis is None else frames.unit(np.asarray(self.axis, dtype=float))

    @property
    def freedoms(self) -> Array:
        """Motions of the second link against the first, about the origin, orthogonal where they can be; (f, 6)."""
        second = None if self.axis2 is None else frames.unit(np.asarray(self.axis2, dtype=float))
        return freedoms(self.kind, np.asarray(self.point, dtype=float), self.along, second, self.pitch or 0.0)


def freedoms(kind: Kind, point: Array, axis: Array, second: Array | None = None, pitch: float = 0.0) -> Array:
    """Return the freedoms of a pair as twists about the origin, array (f, 6).

    point (3,) [m]; axis, second (3,): unit vectors; pitch [m/rad]: how far a helical pair slides per radian.
    rot(a) at p is (a; p × a), tra(a) is (0; a). Sliding comes first: a groove or plane belongs to the first link, a
    ball or cylinder, and with it the point, to the second. Of two axes about which a pair turns each link has one.

    >>> freedoms(PAIRS["C"], np.zeros(3), np.asarray([1.0, 0, 0])) + 0.0
    array([[0., 0., 0., 1., 0., 0.],
           [1., 0., 0., 0., 0., 0.]])
    """
    aside = frames.perpendicular(axis)
    across = np.stack((aside, frames.cross(axis, aside)))
    about = {"": [], "axis": [axis], "both": [axis, second], "all": [axis, *across]}[kind.turns]
    ways = {"": [], "axis": [axis], "across": [*across]}[kind.slides]
    turning = [screws.rotation(way, point) for way in about]
    sliding = [screws.translation(way) for way in ways]
    if kind.screw:
        return np.stack([turning[0] + pitch * sliding[0]])
    return np.stack(sliding + turning)


def axes(pair: Pair) -> Array:
    """Return the axes in which a joint is told of: along its axis and two across it, array (3, 3)."""
    along = pair.along
    aside = frames.perpendicular(along)
    return np.stack((along, aside, frames.cross(along, aside)))


def pair_problems(pair: Pair) -> Iterator[Problem]:
    """Yield what is wrong with a joint by itself, fields named from the joint on."""
    kind = PAIRS.get(pair.type)
    if kind is None:
        return
    if len(set(pair.links)) < 2:
        yield Problem("links", _("joins {link} with itself").format(link=pair.links[0]), "inconsistent")
    sound = True
    for name, wanted in (("axis", kind.needs_axis), ("axis2", kind.needs_second)):
        value = getattr(pair, name)
        found = list(_axis_problems(name, value, wanted, kind))
        sound &= not found and value is not None
        yield from found
    if kind.needs_second and sound:
        yield from _angle_problems(pair)
    if kind.screw and pair.pitch is None:
        yield Problem("pitch", _("missing: a helical pair has a pitch"), "missing")
    if not kind.screw and pair.pitch is not None:
        yield Problem("pitch", _("of no use: only a helical pair (H) has a pitch"), "inconsistent")
    for name in ("carrier", "traction", "pressing_force"):
        if not kind.rolls and getattr(pair, name):
            yield Problem(name, _("of no use: only a rolling contact (RO) has one"), "inconsistent")
    if pair.friction and kind.rolls:
        yield Problem("friction", _("of no use: a rolling contact has its traction"), "inconsistent")
    elif pair.friction and kind.turns and pair.diameter is None:
        yield Problem("diameter", _("missing: what turns rubs at a diameter"), "missing")
    if kind.rolls and (pair.traction is None) != (pair.pressing_force is None):
        text = _("missing: whether a rolling contact slips takes traction and pressing_force")
        yield Problem("traction" if pair.traction is None else "pressing_force", text, "missing")


def _axis_problems(name: str, value: Point | None, wanted: bool, kind: Kind) -> Iterator[Problem]:
    if value is None:
        if wanted:
            yield Problem(name, _("missing: {kind} has a direction here").format(kind=_(kind.name)), "missing")
    elif name == "axis2" and not kind.needs_second:
        yield Problem(name, _("of no use: only U and L4 have a second axis"), "inconsistent")
    elif not all(map(math.isfinite, value)):
        yield Problem(name, _("{value} is not finite").format(value=list(value)), "not_finite")
    elif not LENGTHS[0] < math.hypot(*value) < LENGTHS[1]:
        yield Problem(name, _("{value} is not a direction").format(value=list(value)), "out_of_range")


def _angle_problems(pair: Pair) -> Iterator[Problem]:
    one, other = (frames.unit(np.asarray(way, dtype=float)) for way in (pair.axis, pair.axis2))
    if float(frames.norm(frames.cross(one, other))) < PARALLEL:
        yield Problem("axis2", _("parallel to axis; the two must differ in direction"), "inconsistent")
    elif pair.type == "L4" and abs(float(frames.dot(one, other))) > SQUARE:
        text = _("not square to axis: the cylinder has to lie on the plane whose normal is axis")
        yield Problem("axis2", text, "inconsistent")
