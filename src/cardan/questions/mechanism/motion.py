"""How every link of a mechanism moves while its input link moves: transfer functions, first and second order."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.mechanism.kinetostatics import carried
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.turning import Turned, turned
from cardan.texts import mark

Way: TypeAlias = Literal["rests", "turns", "slides", "screws", "shifts", "plane", "space"]

WAYS: dict[Way, str] = {
    "rests": mark("rests"),
    "turns": mark("rotates"),
    "slides": mark("slides"),
    "screws": mark("rotates and slides"),
    "shifts": mark("translates"),
    "plane": mark("plane motion"),
    "space": mark("space motion"),
}
"""How a link moves, in words: about a fixed axis, along a line, both, without turning, in a plane, in space."""

STILL = 1e-7
"""Speeds below this, lengths over the size, are none: what closing loops next to a change point leaves is a tenth."""


EVEN = 1e-9
"""Fluctuation of a ratio below which it is constant."""


@dataclass(frozen=True, eq=False, kw_only=True)
class LinkMotion:
    """How a link moves, at an input speed of 1 rad/s; nan at change points, where its speed is not told.

    Of an input that slides, at 1 m/s: the transfer functions are by its path [m] instead of its angle [rad].

    Attributes
    ----------
    link : str
    way : str
        How it moves, a key of `WAYS`.
    moves : bool
        Whether its point moves, and does not but turn about a fixed axis.
    axis : array (3,)
        Direction about which it turns where this is always the same, else that along which it slides.
    angle : array (p,) [rad]
        How far it turned about its axis; nought where it has none.
    ratio : array (p,)
        First transfer function: its angular speed over that of the input, about its axis; without one, its amount.
    slope : array (p,) [1/rad]
        Second transfer function: rate of the first by the input angle.
    path : array (p,) [m]
        How far its point went along the axis of a link that slides; nought elsewhere.
    speed : array (p,) [m/rad]
        First transfer function of its point: along the axis of a link that slides, else its amount.
    curve : array (p,) [m/rad²]
        Second one: rate of the speed along the axis, else the amount of the acceleration.
    point : array (p, 3) [m]
        Its point: the centre of mass where the file has one, the middle of its pairs where not.
    blur : array (p,)
        What rounding may make of the ratio; of slope and curve such is told as nought.
    """

    link: str
    way: Way
    moves: bool
    axis: Array
    angle: Array
    ratio: Array
    slope: Array
    path: Array
    speed: Array
    curve: Array
    point: Array
    blur: Array

    @property
    def turns(self) -> bool:
        """Whether it turns."""
        return self.way in ("turns", "screws", "plane", "space")

    @property
    def constant(self) -> bool:
        """Whether its ratio is the same everywhere, but for rounding."""
        low, high = float(np.nanmin(self.ratio + self.blur)), float(np.nanmax(self.ratio - self.blur))
        return high - low <= EVEN * max(abs(high), abs(low))


@dataclass(frozen=True, eq=False, kw_only=True)
class PartErrors:
    """How far the tolerances of joints move the output while the input rests, to first order; nan at change points.

    An error of a joint works with what the joint carries as the load on the output does with the error of this: by
    virtual power the output goes F·d + M·δ for a shift d and a turn δ of the second half, F and M for a load of one.
    """

    each: Array  # (p, m) [rad or m]: largest by each joint
    turns: bool  # whether the output turns, else it slides

    @property
    def worst(self) -> Array:
        """All at the end of their tolerances and adding up, array (p,)."""
        return np.asarray(np.sum(self.each, axis=-1))

    @property
    def likely(self) -> Array:
        """Root of the sum of squares, array (p,)."""
        return np.asarray(np.sqrt(np.sum(self.each**2, axis=-1)))


@dataclass(frozen=True, eq=False, kw_only=True)
class MechanismMotion:
    """How every link of a mechanism moves while its input link turns.

    Attributes
    ----------
    turned : Turned
        Where links and pairs stand.
    links : tuple of LinkMotion
        The moving links, in the order of the file.
    errors : PartErrors or None
        What the tolerances of the joints do to the output; None without any, or where it neither turns nor slides.
    """

    turned: Turned
    links: tuple[LinkMotion, ...]
    errors: PartErrors | None = None

    @property
    def mechanism(self) -> Mechanism:
        """What was asked about."""
        return self.turned.mechanism

    @property
    def position(self) -> Array:
        """Where the input link is, from where it is drawn, array (p,): angles [rad]; paths [m] of one that slides."""
        return self.turned.position

    @property
    def output(self) -> LinkMotion | None:
        """The output link; None where none is named."""
        named = [one for one in self.links if one.link == self.mechanism.output_link]
        return named[0] if named else None


def mechanism_motion(mechanism: Mechanism, position: Array | None = None) -> MechanismMotion:
    """Return how every link of a mechanism moves while its input link turns or slides.

    Parameters
    ----------
    mechanism : Mechanism
        With an input link that turns in its frame, or slides in it over a stroke.
    position : array (p,) [rad], optional
        Angles of the input link from where it is drawn; each degree of its range by default. Paths [m] of an input
        that slides.

    Returns
    -------
    MechanismMotion

    Raises
    ------
    InputError
        A link that cannot follow: which, at which angle, what its pairs lack; one that moves while the input rests.

    See Also
    --------
    mechanism_forces, mobility

    Examples
    --------
    A crank of 50 mm turns once, and a piston goes to and fro over twice its length:

    >>> from cardan.mechanisms import mechanism_motion
    >>> import numpy as np
    >>> from cardan.mechanisms import example_mechanism
    >>> found = mechanism_motion(example_mechanism("crank-slider"), np.radians(np.arange(0.0, 361.0, 4.0)))
    >>> found.output.way, round(float(np.ptp(found.output.path)), 4)
    ('slides', 0.1)
    """
    found = turned(mechanism, position)
    size = found.placed.size
    links = tuple(_moved(found, k, size) for k in range(len(mechanism.links)))
    whole = MechanismMotion(turned=found, links=links)
    return replace(whole, errors=_part_errors(whole))


def _part_errors(motion: MechanismMotion) -> PartErrors | None:
    """Return what the tolerances of the joints do to the output."""
    turned_, output = motion.turned, motion.output
    ways = np.asarray([[one.tolerance_turn or 0.0, one.tolerance or 0.0] for one in motion.mechanism.joints])
    if output is None or output.way not in ("turns", "slides") or not np.any(ways):
        return None
    load = np.zeros((*turned_.displacement.shape[:2], 6))
    k = motion.mechanism.links.index(output.link)
    turns = output.way == "turns"
    if turns:
        load[:, k, :3] = output.axis
    else:
        load[:, k, :3], load[:, k, 3:] = frames.cross(output.point, output.axis + 0.0 * output.point), output.axis
    found = carried(turned_.placed, load=load, **turned_.driven)
    held = np.stack((frames.norm(found.reaction[..., :3]), frames.norm(found.reaction[..., 3:])), axis=-1)
    each = np.sum(held * ways, axis=-1)
    return PartErrors(each=np.where(turned_.special[:, None], np.nan, each), turns=turns)


def _moved(found: Turned, k: int, size: float) -> LinkMotion:
    mechanism, link = found.mechanism, found.mechanism.links[k]
    at = reference(mechanism, link)
    pose = found.displacement[:, k]
    point = pose[:, :3, :3] @ at + pose[:, :3, 3]
    per = size if mechanism.slides else 1.0  # a path of the input over the size counts as an angle does
    twist, rate = per * found.rates.speed[:, k], per**2 * found.rates.acceleration[:, k]
    told = ~found.special
    spin, steep = twist[:, :3], rate[:, :3]
    pace = twist[:, 3:] + frames.cross(spin, point)
    swept = rate[:, 3:] + frames.cross(steep, point) + frames.cross(spin, pace)
    about, along = _direction(spin[told], 1.0), _direction(pace[told], size)
    turns, moves = _some(spin[told], 1.0), _some(pace[told], size)
    fixed = None if about is None else _fixed_point(twist[told], size)
    way: Way = "rests"
    if turns:
        way = "space"
        if about is not None:
            flat = np.max(np.abs(pace[told] @ about), initial=0.0) <= STILL * size
            way = "plane" if flat else "space"
            if fixed is not None:
                slid = np.max(np.abs(_speed_at(twist, fixed)[told]), initial=0.0) > STILL * size
                way = "screws" if slid else "turns"
    elif moves:
        way = "slides" if along is not None else "shifts"
    axis = about if about is not None else along if along is not None else np.zeros(3)
    ratio = spin @ about if about is not None else frames.norm(spin)
    slope = steep @ about if about is not None else _rate_of_amount(spin, steep)
    straight = way in ("slides", "screws")
    if way == "screws":
        assert fixed is not None
        speed = _speed_at(twist, fixed) @ axis
        curve = (rate[:, 3:] + frames.cross(steep, np.broadcast_to(fixed, steep.shape))) @ axis
    else:
        speed = pace @ axis if straight else frames.norm(pace)
        curve = swept @ axis if straight else frames.norm(swept)
    slope, curve = _beyond(slope, found.rates.blur(2)), _beyond(curve, size * found.rates.blur(2))
    blank = np.where(told, 1.0, np.nan)
    return LinkMotion(
        link=link,
        way=way,
        moves=moves and way != "turns",
        axis=axis,
        angle=_angle(pose[:, :3, :3], about, ratio, found.position / per),
        ratio=ratio * blank / per,
        slope=slope * blank / per**2,
        path=(point - at) @ axis if straight else np.zeros(len(point)),
        speed=speed * blank / per,
        curve=curve * blank / per**2,
        point=point,
        blur=found.rates.blur(1) / per,
    )


def _beyond(values: Array, blur: Array) -> Array:
    """Return values, nought where rounding alone may make them."""
    return np.where(np.abs(values) > blur, values, 0.0)


def reference(mechanism: Mechanism, link: str) -> Array:
    """Return the point of a link that is told of, where it is drawn, array (3,) [m]."""
    for one in mechanism.masses:
        if one.link == link:
            return np.asarray(one.mass_centre, dtype=float)
    found: Array = np.mean([pair.point for pair in mechanism.joints if link in pair.links], axis=0)
    return found


def _some(values: Array, size: float) -> bool:
    return bool(np.max(np.abs(values), initial=0.0) > STILL * size)


def _direction(values: Array, size: float) -> Array | None:
    """Return the unit vector along which all vectors (p, 3) lie, seen at the first of some length; None if none is."""
    length = frames.norm(values)
    if not _some(values, size):
        return None
    way = frames.unit(values[int(np.argmax(length))])
    way = way * np.sign(way[int(np.argmax(np.abs(way)))])
    off = np.max(np.abs(values - (values @ way)[:, None] * way))
    return way if off <= STILL * max(float(np.max(length)), size) else None


def _fixed_point(twist: Array, size: float) -> Array | None:
    """Return a point of the axis about which a link turns (p, 6) always; None where the axis goes elsewhere."""
    k = int(np.argmax(frames.norm(twist[:, :3])))
    spin = twist[k, :3]
    point = frames.cross(spin, twist[k, 3:]) / (spin @ spin)
    across = frames.cross(frames.unit(spin)[None, :], _speed_at(twist, point))
    return point if np.max(np.abs(across), initial=0.0) <= STILL * size else None


def _speed_at(twist: Array, point: Array) -> Array:
    """Return the speed that a link with twists (p, 6) has at a point (3,) of the frame, array (p, 3)."""
    found: Array = twist[:, 3:] + frames.cross(twist[:, :3], np.broadcast_to(point, twist[:, :3].shape))
    return found


def _rate_of_amount(spin: Array, steep: Array) -> Array:
    size = frames.norm(spin)
    return np.where(size > STILL, frames.dot(spin, steep) / np.where(size > STILL, size, 1.0), frames.norm(steep))


def _angle(turn: Array, about: Array | None, ratio: Array, angle: Array) -> Array:
    """Return how far a link turned about its axis (p,) [rad]: its rotation, whole turns by the way that it went."""
    if about is None:
        return np.zeros(len(turn))
    aside = frames.perpendicular(about)
    now = turn @ aside
    wrapped = np.arctan2(now @ frames.cross(about, aside), now @ aside)
    order = np.argsort(angle)
    start = int(np.argmin(np.abs(angle[order])))
    rough = np.concatenate(([0.0], np.cumsum(0.5 * (ratio[order][1:] + ratio[order][:-1]) * np.diff(angle[order]))))
    rough = rough - rough[start] + ratio[order][start] * angle[order][start]
    told = np.empty(len(turn))
    told[order] = wrapped[order] + 2.0 * np.pi * np.round((rough - wrapped[order]) / (2.0 * np.pi))
    return told


def peak(values: Array) -> float:
    """Return the largest size of values of any shape, leaving out what is not a number."""
    return float(np.nanmax(np.abs(values)))
