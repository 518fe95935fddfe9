"""What a kind of joint is: the protocol that everything outside of this folder asks, never the type of a joint.

A kind is one file with one class. Its fields and its law must stand there; all else has a default that fits most:

===================  ==============================================================================================
what                 by default
===================  ==============================================================================================
``kind``             none: the value of the file key
fields               those of every joint but for `CROSS_ONLY`, see ``foreign``
``pair``             None: its law is no Möbius map
``deviation``        what follows from ``pair``; a kind without a map gives it
``title``            ``kind`` with blanks
``steepest``         45°, the joint angle above which no real joint of the kind works
``slides``           no: its shafts cannot slide along each other
``crossed``          no: its marks lie on one line when it is straight
``single_cross``     no: what holds for the cross of a Hooke joint alone does not hold for it
``fixed``            no: it may pass on forces besides a couple
``centred``          no: what it passes on needs no housing that centres its shafts
``loose``            no: it holds its shafts in its centre, but for sliding
``twist_spring``     none: it does not give under torque
``many_angles``      no: its law is asked at one joint angle after the other
``law_sizes``        none: its law follows none of its sizes, so that errors of them do nothing to it
``place_sizes``      none: its driven shaft stays where it is, whatever its sizes
``placing``          those of ``place_sizes`` that it gives
``stays``            it holds both shafts in one centre
``stuck``            its kind and the joint angle at which it does not turn
``inside``           nothing else moves in it
``rubbing``          no: what rubs in it is not counted
``mechanism``        pins of a cross, a contact, a slide or two axes in the bisecting plane, as the marks above say
``centring``         nothing holds its centre beside its mechanism
``repeated``         0: no parts alike hold the same
``fitting``          itself: all its parts fit at once
``loaded``           nothing: no load in it is told
``rated``            no keys: no bearing in it has a life
``pressed``          no keys: no contact in it is judged
``strained``         nothing: nothing in it is strained but by the torque
``carried``          a driven shaft that keeps its direction, of a loose joint one in a bearing
``free_ways``        one, along its driving shaft, where it slides; all three where it is loose
``freed``            which these are
``push``             no force goes with its couple
``bend_spring``      nought: nothing in it holds against the joint angle
``sprung``           no force goes with its stiffness
``shaft_behind``     the driven shaft turns about its axis and does not wobble
``wobbles``          no: the driven shaft keeps its place while it turns
``head``             the driven shaft starts at the joint centre
``held``             it is held where its next joint is
``ball``             none: no ball of its own holds its driven shaft
``solid``            yokes with a cross, else a bell with balls
``span``             from its cross or its rating
``types``            no rows of the catalogue
``refusals``         a sentence for each question that needs more than the kind gives, `REFUSALS`
``own_problems``     nothing contradicts itself
===================  ==============================================================================================
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from types import MappingProxyType
from typing import Any, ClassVar, TypeAlias

import numpy as np

from cardan.drive.accuracy import Error, Inspection, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.joint_parts import Needles, Rating, Yoke
from cardan.errors import Problem
from cardan.later import later
from cardan.maths.arrays import Array, unit_complex
from cardan.maths.kernel import mobius
from cardan.texts import _, mark
from cardan.units import KEY, Key, plain, quantity

from .common import departures, inner
from .common.inner import InnerPair, Stance

drawn = later("cardan.drive.joints.common.site")
"""Bodies of a joint, for those who draw one."""

Point: TypeAlias = tuple[float, float, float]
Box: TypeAlias = tuple[tuple[float, float], tuple[float, float], tuple[float, float]]

CROSS_ONLY = frozenset(("friction", "material_friction", "fit", "cross", "needles", "yoke", "inspection"))
"""Fields that only a joint with one cross can use."""


TOGETHER = 64  # joint angles at which a law is asked at once
PLACES = 120  # places in a turn at which a law is looked at for its second order, and more where these do not tell it
MOST = 64 * PLACES  # most of them
TOLD = 1e-9  # harmonics [rad] of the upper half of the orders below which more places change the second by rounding


REFUSALS: Mapping[str, str] = MappingProxyType(
    {
        "forces": mark("it does not hold both shafts at its centre, so that they take forces besides its couple"),
        "losses": mark("what rubs in it is not the journals of a cross"),
        "life": mark("it has no rolling bearings, and ISO 281 tells nothing of parts that slide or give"),
        "sizing": mark("the rows of the catalogue are of cross joints"),
        "cross": mark("only the law of a cross joint is taken here"),
        "tolerance": mark("its law follows none of its sizes"),
    }
)
"""Question -> why a joint that is no cross joint does not answer it, marked for translation."""


EXACT: Mapping[str, Any] = MappingProxyType({})
"""Errors of a joint made as drawn."""


SHIFTS = ("shift_along", "shift_aside", "shift_normal")
"""Ways in which pairs that are off shift the start of a driven shaft: along the driving one, across it, and normal."""


FREE = mark("it holds nothing of its shafts but the turn: their bearings keep them, and only the contact moves")
"""Why sizes of a joint with a contact move no shaft."""


NO_BEARING = mark("its balls slide as they roll in their grooves, for which ISO 281 has no life")
"""Why a joint with balls has no life by ISO 281."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Joint:
    """A joint and its place, in one of three forms: its centre, or its joint angle and plane, or neither (slopes).

    A kind says how it turns by `pair`, or by `deviation` where its map of the circle is no Möbius map. Its marks are a
    line on the driving side and one on the driven side, from which yoke angles count: the yokes of a cross joint.
    """

    kind: ClassVar[str]

    title: ClassVar[str] = ""
    """What the kind is called in words, marked for translation."""

    beside: ClassVar[str] = "hooke"
    """Kind that is worth comparing with."""

    types: ClassVar[tuple[str, ...]] = ()
    """Rows of the catalogue's types of joints that turn by its law."""

    any_type: ClassVar[bool] = False
    """Whether it stands for joints of any type, as what turns ideally does."""

    foreign: ClassVar[frozenset[str]] = CROSS_ONLY
    """Fields of every joint that mean nothing in one of this kind."""

    crossed: ClassVar[bool] = False
    """Whether its marks are the arms of one cross, a quarter turn apart; else they lie on one line when straight."""

    single_cross: ClassVar[bool] = False
    """Whether it is one cross whose arms meet, as Hooke's: all other joints are told by such a one that turns alike."""

    fixed: ClassVar[bool] = False
    """Whether it passes on one couple and forces in its centre only, so that forces follow from statics.

    The couple follows from the law: it works on no motion that the joint allows.
    """

    centred: ClassVar[bool] = False
    """Whether it passes on its couple alone only where a housing centres its shafts, as statics takes it."""

    loose: ClassVar[bool] = False
    """Whether it holds nothing of its shafts but the turn: no force acts in its centre."""

    rubbing: ClassVar[tuple[str, ...]] = ()
    """Keys of the sizes that tell, with `friction`, what rubs in a joint without a cross; none where nothing does."""

    static_pressure: ClassVar[float] = 4200e6
    """Pressure of Hertz at which the contacts in it keep a mark [Pa]: that of balls in grooves behind ISO 76."""

    pressed: ClassVar[tuple[str, ...]] = ()
    """Keys of the sizes that tell the pressure of its balls or rollers; none where it has none."""

    rated: ClassVar[tuple[str, ...]] = ()
    """Keys of the sizes that tell, with `bearing_capacity` among them, the life of bearings in it; none without any."""

    many_angles: ClassVar[bool] = False
    """Whether its law takes many joint angles at once, array (m, 1) beside angles (p,)."""

    law_sizes: ClassVar[tuple[str, ...]] = ()
    """Keys of its sizes that its law follows: what of them is off, or may be, is told beside them."""

    place_sizes: ClassVar[tuple[str, ...]] = ()
    """Keys of its sizes, or of the errors of its cross, that the place of its driven shaft follows."""

    stays: ClassVar[str] = mark("it holds both shafts in one centre, whatever its sizes")
    """Why errors inside it do not move its driven shaft where none is `placing`, marked for translation."""

    slides: ClassVar[bool] = False
    """Whether it lets its shafts slide along each other."""

    steepest: ClassVar[float] = math.pi / 4
    """Joint angle [rad] above which no real joint of this kind works."""

    refusals: ClassVar[Mapping[str, str]] = REFUSALS
    """Question -> why this kind does not answer it, marked for translation."""

    name: str = plain("", doc="name of the joint, for tables and pictures")
    type: str = plain("", doc="type of joint in the catalogue, with its limits")
    size: str = plain("", doc="size of a maker's series in the catalogue, with its dimensions and ratings")
    centre: Point | None = quantity("length", None, doc="joint centre [x, y, z], z up")
    joint_angle: float | None = quantity(
        "angle", None, doc="joint angle between the joint's two shafts", low=0.0, below=math.pi / 2
    )
    plane_twist: float | None = quantity(
        "angle",
        None,
        doc="angle from the plane of the joint before to this joint's plane, about the shaft between them",
    )
    move_within: Box | None = quantity(
        "length", None, doc="box [[x0, x1], [y0, y1], [z0, z1]] in which layout synthesis may put the centre"
    )
    friction: float | None = plain(
        None,
        doc="reduced coefficient of friction of the journals in their bearings, or of rollers, balls and pins on their "
        "tracks",
        low=0.0,
    )
    material_friction: float | None = plain(
        None,
        doc="coefficient of friction of the materials of plain journals, from which the reduced one follows",
        low=0.0,
    )
    fit: str = plain(
        "new",
        doc="how plain journals bear: new (uniform pressure) or run in (pressure as a cosine)",
        choices=("new", "run_in"),
    )
    backlash: float = quantity("angle", 0.0, doc="whole angular play, as its driving shaft feels it", low=0.0)
    mass: float | None = quantity(
        "mass", None, doc="mass of the joint, its cross and both yokes; that of its size when not given", above=0.0
    )
    cross: Cross | None = plain(None, doc="cross of the joint")
    needles: Needles | None = plain(None, doc="needle bearings of the cross")
    yoke: Yoke | None = plain(None, doc="yokes of the joint")
    rating: Rating | None = plain(None, doc="what the maker allows")
    inspection: Inspection | None = plain(None, doc="what was measured on yoke and cross")
    error: Error | None = plain(None, doc="manufacturing errors of the joint, as measured")
    tolerance: Tolerance | None = plain(None, doc="tolerances of the joint, each to both sides")

    def pair(self, joint_angle: Array) -> mobius.Pair | None:
        """Return the joint's Möbius map, with real parts, for joint angles (...) [rad]; None where it has none."""
        return None

    def near_pair(self, joint_angle: Array) -> mobius.Pair:
        """Return the joint's Möbius map, or the one with the second order of its law: for loads, not for motion."""
        found = self.pair(joint_angle)
        if found is not None:
            return found
        bends, rows = np.unique(np.asarray(joint_angle), return_inverse=True)
        tau = np.reshape(_second_orders(self, tuple(bends.tolist()))[rows], np.shape(joint_angle))
        root = np.sqrt(1.0 - tau * tau)
        return (1.0 + 0.0j) / root, (-1.0 + 0.0j) * tau / root

    def deviation(self, angle: Array, joint_angle: Array) -> tuple[Array, Array, Array]:
        """Return how far the driven side runs ahead of the driving side, with two derivatives.

        Parameters
        ----------
        angle : array (...) [rad]
            θ, angle of the driving mark from the plane of the shafts.
        joint_angle : array (...) [rad]
            α.

        Returns
        -------
        angle_error, ratio, slope : arrays (...) [rad, 1, 1/rad]
            T(θ) - θ, T' and T'', T the angle of the driven mark, less a quarter turn where the joint has a cross.
        """
        pair = self.pair(joint_angle)
        if pair is None:
            raise NotImplementedError(self.kind)  # a kind without a map has its own
        return mobius.course(pair, unit_complex(2.0 * angle))

    @property
    def has_map(self) -> bool:
        """Whether it turns by tan θ' = κ tan θ, as a Hooke joint at some joint angle does."""
        return self.pair(np.asarray(0.1)) is not None

    @property
    def even(self) -> bool:
        """Whether it turns its driven shaft as its driving one, at every joint angle."""
        pair = self.pair(np.asarray(0.1))
        return pair is not None and bool(abs(pair[1]) == 0.0)

    @classmethod
    def size_keys(cls) -> dict[str, Key]:
        """Return what the sizes mean that its law or the place of its driven shaft follows."""
        given = {one.name: one.metadata[KEY] for one in fields(cls) if KEY in one.metadata}
        return {name: given[name] for name in cls._counting()}

    @classmethod
    def _counting(cls) -> tuple[str, ...]:
        """Return the keys of the sizes that its law or the place of its driven shaft follows."""
        return () if cls.single_cross else tuple(dict.fromkeys((*cls.law_sizes, *cls.place_sizes)))

    @classmethod
    def tables(cls) -> Mapping[str, Any]:
        """Return the classes of its keys `error` and `tolerance`, where they are not those of a cross joint."""
        alike: Any = cls if cls.size_keys() else Joint
        return {} if cls.single_cross else departures.tables(alike)

    def sizes(self) -> dict[str, float | None]:
        """Return the sizes that its law or the place of its driven shaft follows, None where one is not given."""
        return {name: getattr(self, name) for name in self._counting()}

    def placing(self) -> tuple[str, ...]:
        """Return the keys of the errors by which its driven shaft leaves its place, as far as its sizes are given."""
        return tuple(name for name in self.place_sizes if getattr(self, name) is not None)

    def sized(self, sizes: Mapping[str, Any]) -> Joint:
        """Return it with other sizes of those that its law follows."""
        return replace(self, **sizes)

    def stuck(self, joint_angle: float) -> str:
        """Return in a sentence that it does not turn at a joint angle [rad], and why where it is known."""
        text = _("a joint of kind {kind} with these sizes does not turn at its joint angle of {joint_angle:.6g}°")
        return text.format(kind=self.kind, joint_angle=math.degrees(joint_angle))

    @property
    def tolerated(self) -> bool:
        """Whether pairs of its `mechanism` tell how far they may be off; by these its `head` shifts by `SHIFTS`."""
        return False

    @property
    def twist_spring(self) -> tuple[float, float] | None:
        """Its stiffness and damping against turning [N·m/rad, N·m·s/rad]; None where it does not give."""
        return None

    @classmethod
    def own_fields(cls) -> frozenset[str]:
        """Return the names of the fields that joints of other kinds do not have."""
        return frozenset(one.name for one in fields(cls)) - {one.name for one in fields(Joint)}

    def refusal(self, question: str) -> str:
        """Return in a sentence why it does not answer a question, "" where it does.

        Parameters
        ----------
        question : str
            A key of `REFUSALS`.
        """
        known = {"forces": self.told, "losses": bool(self.rubbing), "life": bool(self.rated)}.get(question, False)
        return "" if known else _(self.refusals.get(question, ""))

    def without(self, names: Iterable[str]) -> tuple[str, ...]:
        """Return those of its keys that it does not give."""
        return tuple(name for name in names if getattr(self, name) is None)

    @property
    def rubs(self) -> bool:
        """Whether it tells what rubs in it besides the journals of a cross: friction and sizes are given."""
        return bool(self.rubbing and self.friction) and not self.without(self.rubbing)

    @property
    def told(self) -> bool:
        """Whether its sizes tell the forces that go with its torque."""
        return self.fixed

    @classmethod
    def in_words(cls) -> str:
        """Return what the kind is called."""
        return _(cls.title) if cls.title else cls.kind.replace("_", " ")

    def inside(self, joint_angle: float) -> Iterator[Inside]:
        """Yield what else moves in it at a joint angle [rad], as far as its sizes are given."""
        yield from ()

    def mechanism(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the pairs of its inner mechanism, which work as it does at every place of a turn.

        Its stance is at one place of a turn or at many (...); points and axes of the pairs have the same axes. By
        default, and where sizes are missing, those of what holds and frees as much.
        """
        if self.loose:
            yield from inner.touching(stance)
        elif self.slides:
            yield from inner.sliding(stance)
        elif self.crossed:
            sizes = (self.cross.journal, self.cross.span) if self.cross else (None, None)
            slides = self.cross.slides if self.cross else False
            yield from inner.crossed(stance, slides=slides, journal=sizes[0] or 0.0, span=sizes[1] or math.inf)
        else:
            yield from inner.bending(stance)

    def centring(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield what holds its centre beside the pairs of its mechanism: a cage, a centre ball."""
        yield from ()

    @property
    def repeated(self) -> int:
        """How many constraints parts of it that are alike repeat; play or give lets them share the load."""
        return 0

    def loaded(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the pairs whose loads it tells, as many as carry its torque; none where its sizes are not given."""
        yield from ()

    def strained(self, joint_angle: float) -> Iterator[Strain]:
        """Yield what it does to both shafts beside the torque, as they do not lie in line; joint_angle [rad]."""
        yield from ()

    def shared(self, joint_angle: float, torque: float) -> Iterator[Strain]:
        """Yield what its parts alike carry of a torque [N·m] by their stiffness, where that is given."""
        yield from ()

    def carried(self, stance: Stance) -> Iterator[InnerPair]:
        """Yield the pairs that hold both its shafts in the frame, so that it turns once and is held but once."""
        yield from inner.carried(stance, loose=self.loose, slides=self.slides)

    @property
    def bend_spring(self) -> float:
        """Its stiffness against the joint angle [N·m/rad]."""
        return 0.0

    def sprung(self, joint_angle: Array) -> Array | None:
        """Return the force that its stiffness puts on its driven shaft, array (..., 3) [N]; None where it has none.

        joint_angle (...) [rad]. Along the driving shaft e, N × e and the normal N of the plane, whatever the torque.
        """
        return None

    @property
    def free_ways(self) -> int:
        """In how many directions its shafts can shift against each other in its centre."""
        return 3 if self.loose else int(self.slides)

    def freed(self, angle: Array, joint_angle: Array) -> Array:
        """Return these directions, array (..., `free_ways`, 3).

        angle, joint_angle (...) [rad]: θ of its driving mark from the plane of the shafts, and α. Along the driving
        shaft e, N × e and the normal N of the plane. In them it passes on what `push` tells and nothing else, across
        them any force.
        """
        return 0.0 * (np.asarray(angle) + joint_angle)[..., None, None] + np.eye(3)[: self.free_ways]

    def push(self, angle: Array, joint_angle: Array) -> Array | None:
        """Return the force of the joint on its driven shaft over the torque of this, array (..., 3) [1/m].

        As `freed` has it, of which the parts in those directions count; None where no force goes with its couple.
        """
        return None

    def shaft_behind(self, stance: Stance) -> tuple[Array, Array]:
        """Return a point of the driven shaft [m] and its direction, as it moves: arrays (..., 3)."""
        return stance.centre, stance.after

    @property
    def wobbles(self) -> bool:
        """Whether its driven shaft wobbles while it turns, by the sizes given."""
        return False

    @property
    def felt_beyond(self) -> bool:
        """Whether its driven shaft pivots in a joint beyond, of constant velocity, that the file does not hold."""
        return False

    def head(self, stance: Stance, off: Mapping[str, Any] = EXACT) -> Array:
        """Return where its driven shaft starts, array (..., 3) [m].

        off: key of its errors -> error (...) [SI], as far as its driven shaft leaves its place by them.
        """
        return stance.centre

    def held(self, length: float | None, off: Mapping[str, Any] = EXACT) -> float | Array | None:
        """Return how far from the joint centre its driven shaft is held and swivels [m]; None where nobody says.

        length [m]: of that shaft up to the next joint; None where it is not known or there is none. off: as `head`.
        """
        return length

    @property
    def ball(self) -> float | None:
        """How far from the joint centre a sliding ball of its own holds its driven shaft [m]; None where none does."""
        return None

    def half_length(self, apart: float) -> float:
        """Return how far its yokes swing off its centre [m], ``apart`` where it has two crosses that stand so."""
        return 0.0

    def fitting(self) -> Joint:
        """Return the joint that tells what rubs in it: itself, unless parts that share the torque do not fit at once.

        Rigid, such parts would press each other with any force; with their play they rub as those that fit.
        """
        return self

    @property
    def alike(self) -> int:
        """How many parts alike it has around its axis, after each of which it stands as before."""
        return 1

    @property
    def span(self) -> float | None:
        """Distance of the middles of its opposite bearings [m], None where the file does not say."""
        if self.cross is not None and self.cross.span is not None:
            return self.cross.span
        outer = self.rating.outer if self.rating is not None else None
        return self.own_span if outer is None else 0.78 * outer

    @property
    def own_span(self) -> float | None:
        """The same by the sizes of its kind."""
        return None

    @property
    def estimable(self) -> bool:
        """Whether it does not say what it weighs, and its cross says how large it is: span and journals."""
        cross = self.cross if self.single_cross and self.mass is None else None
        return cross is not None and None not in (cross.span, cross.journal, cross.journal_length)

    def solid(self, site: Any) -> None:
        """Add its bodies; site: a `cardan.drive.joints.common.site.Site`."""
        if self.crossed:
            drawn().yokes_and_cross(site)
        else:
            drawn().bell_and_balls(site)

    def own_problems(self) -> Iterator[Problem]:
        """Yield what contradicts itself in the fields of this kind, each path from the joint on."""
        yield from ()


def both_or_none(joint: Joint, *names: str) -> Iterator[Problem]:
    """Yield those fields that are missing where another one of them is given."""
    missing = [name for name in names if getattr(joint, name) is None]
    if len(missing) < len(names):
        given = next(name for name in names if name not in missing)
        for name in missing:
            yield Problem(name, _("missing; it goes with {other}").format(other=given), "missing")


@lru_cache(maxsize=4096)
def _second_order(joint: Joint, joint_angle: float) -> float:
    """Return the amplitude of the second order of a law at a bend [rad]: many loads and variants ask for few bends."""
    return float(_second(joint, np.asarray([joint_angle]))[0])


@lru_cache(maxsize=256)
def _second_orders(joint: Joint, bends: tuple[float, ...]) -> Array:
    """Return the same at several bends [rad], array (m,): of many at once, but where the law does not turn at some."""
    if len(bends) == 1 or not joint.many_angles:
        return np.asarray([_second_order(joint, one) for one in bends])
    found = []
    for first in range(0, len(bends), TOGETHER):
        some = bends[first : first + TOGETHER]
        told = _second(joint, np.asarray(some))
        found.append(told if np.all(np.isfinite(told)) else np.asarray([_second_order(joint, one) for one in some]))
    return np.concatenate(found)


def _second(joint: Joint, bends: Array) -> Array:
    """Return the second order of a law at bends (m,) [rad], from as many places of a turn as tell it."""
    found, open_, count = np.zeros(len(bends)), np.arange(len(bends)), PLACES
    while len(open_):
        theta = np.arange(count) * (2.0 * np.pi / count)
        alpha = bends[open_, None] if len(open_) > 1 else bends[open_[0]]
        with np.errstate(invalid="ignore", divide="ignore"):
            ahead = np.broadcast_to(joint.deviation(theta, alpha)[0], (len(open_), count))
        found[open_] = ahead @ np.sin(2.0 * theta) * (2.0 / count)
        open_ = open_[~_followed(ahead)] if count < MOST else open_[:0]
        count *= 4
    return found


def _followed(ahead: Array) -> Array:
    """Tell whether leads (m, p) [rad] at even places tell the curve between them, and that it never turns back.

    A contact that is lost, or turns back, between two places shows at more of them.
    """
    count = ahead.shape[-1]
    wave = np.fft.rfft(ahead) * (2.0 / count)
    faded = np.max(np.abs(wave[..., count // 4 :]), axis=-1) < TOLD
    rate = np.fft.irfft(1j * np.arange(wave.shape[-1]) * wave, 8 * count) * (4.0 * count)
    told: Array = ~np.isfinite(np.sum(ahead, axis=-1)) | (faded & (np.min(rate, axis=-1) > -1.0))
    return told


# One measure of what else moves inside a joint: wobble, orbits, strokes, play, planes that are missed.


@dataclass(frozen=True, kw_only=True)
class Inside:
    """One measure of what moves inside a joint."""

    key: str  # short name, without unit
    meaning: str  # one sentence
    value: float  # in SI
    dimension: str | None = "angle"  # a key of `cardan.units.DIMENSIONS`; None for a pure number, or 1/m


@dataclass(frozen=True, kw_only=True)
class Strain:
    """What a joint that gives does to both its shafts, one way on the one and the other way on the other."""

    name: str  # marked for translation
    force: float = 0.0  # [N]: the largest of parts alike
    couple: float = 0.0  # [N·m]
    least: float | None = None  # [N]: the least force of parts alike, where they differ
    count: int = 1  # how many parts alike there are


def missed(tilt: float) -> Inside:
    """Return how far a plane of contact is from the one that halves the joint angle [rad]."""
    return Inside(key="plane_tilt", meaning=_("angle by which the plane of contact misses the middle"), value=tilt)
