"""A mechanism while its input link turns or slides: where every link stands, and how it moves, over its range.

Loops are closed as `closing` closes them. What rolls is followed along its way (Munthe-Kaas' fourth-order steps), and
the loops are closed again after each.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from cardan.errors import InputError, Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.texts import _, plural
from cardan.units import deg, label, mm

from .closing import CLOSED, Linkage, by_rounding, moved_along, open_by
from .constraints import FRAME
from .kinetostatics import Placed, Rates, rates, speeds
from .mechanism import Mechanism
from .rounding import exactly

STEP = 4.0 * deg
"""Largest step from one position to the next while loops are followed; of what slides a path over the size."""

ROLLED = 2.0 * deg
"""The same where something rolls: what a step leaves out is a billionth of what is rolled."""

HELD = 1e-6
"""Share of a small motion that is none."""

LOOKED = (0.21, 0.47, 0.83)
"""Places of the range at which it is looked at what is held: at no special angle."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Turned:
    """A mechanism at positions of its input link: angles of one that turns, paths of one that slides."""

    mechanism: Mechanism
    position: Array  # (p,) [rad], of an input that slides [m]: of the input link, from where it is drawn
    displacement: Array  # (p, n, 4, 4): of every moving link, from where it is drawn
    misfit: Array  # (p, m, 2): gap [m] and lean [rad] that each pair keeps
    placed: Placed  # pairs where they stand
    rates: Rates  # at an input speed of 1 rad/s or 1 m/s
    about: Array  # (p, 6): twist of the input link against its base
    drive: Array  # (p, 6): wrench of 1 N·m, on what slides 1 N, that drives it
    base: int  # moving link against which the input is driven; `FRAME`

    @property
    def input_link(self) -> int:
        """Which moving link is the input."""
        return self.mechanism.links.index(self.mechanism.input_link)

    @property
    def driven(self) -> dict[str, Any]:
        """Which link drives, and how, as `kinetostatics.carried` asks for it."""
        return {"input_link": self.input_link, "base": self.base, "about": self.about, "drive": self.drive}

    @cached_property
    def loose(self) -> tuple[str, ...]:
        """Links that can move while the input stands still, wherever it stands."""
        some = self.rates.count == np.min(self.rates.count)
        moves = np.max(np.abs(self.rates.free[some]), axis=(0, 1, 3), initial=0.0)
        return tuple(link for link, size in zip(self.mechanism.links, moves, strict=True) if size > HELD)

    @property
    def special(self) -> Array:
        """Where something can move that is held elsewhere, array of bool (p,): change points and dead centres."""
        found: Array = self.rates.count > np.min(self.rates.count)
        return found


def turned(mechanism: Mechanism, position: Array | None = None) -> Turned:
    """Return a mechanism at angles of its input link (p,) [rad]; each degree of its range when not given.

    Of an input that slides at paths [m]. Raises InputError: no input link that turns or slides in the frame, a link
    that more than the input moves, or a pair that opens: which link, at which angle and how far.
    """
    check_driven(mechanism)
    mechanism = exactly(mechanism)
    low, high = travel(mechanism)
    wanted = grid(mechanism) if position is None else np.asarray(position, dtype=float)
    way = _Way(mechanism, Linkage(mechanism.joints))
    way.walk(min(low, float(np.min(wanted))), max(high, float(np.max(wanted))))
    _check_held(way, np.asarray([low + share * (high - low) for share in LOOKED]))
    poses, misfit = way.at(wanted)
    placed = way.placed(poses)
    return Turned(
        mechanism=mechanism,
        position=wanted,
        displacement=poses[:, way.order],
        misfit=misfit * np.asarray([way.linkage.size, 1.0]),
        placed=placed,
        rates=rates(placed, input_link=way.input, about=way.twist(placed), base=way.base),
        about=way.twist(placed),
        drive=way.drive(placed),
        base=way.base,
    )


def grid(mechanism: Mechanism, step: float = 1.0 * deg) -> Array:
    """Return the angles of the input link over its range, both ends included, array (p,) [rad].

    Of an input that slides paths [m], as many over its stroke as of a whole turn.
    """
    low, high = travel(mechanism)
    way = 2.0 * math.pi if mechanism.slides else high - low
    return np.linspace(low, high, max(2, math.ceil(way / step - 1e-9) + 1))


def travel(mechanism: Mechanism) -> tuple[float, float]:
    """Return between where the input link moves [rad or m]; refuse one that slides and has no stroke."""
    if mechanism.travel is None:
        text = _("missing: {link} slides, and no turn brings it back; say between which paths it moves")
        raise refuse("input_stroke", text.format(link=repr(mechanism.input_link)), "missing")
    return mechanism.travel


def check_driven(mechanism: Mechanism) -> None:
    """Refuse a mechanism without a link that turns or slides in the frame and drives it."""
    if not mechanism.input_link:
        raise refuse("input_link", _("missing: it says which link is driven"), "missing")
    if mechanism.driving is None:
        text = _(
            "{link} needs a pair of type R or P with the frame, {frame}: it tells about or along which axis the input "
            "moves"
        )
        said = text.format(link=repr(mechanism.input_link), frame=repr(mechanism.frame))
        raise refuse("input_link", said, "inconsistent")


class _Way:
    """The way of a mechanism from where it is drawn."""

    def __init__(self, mechanism: Mechanism, linkage: Linkage) -> None:
        self.mechanism, self.linkage = mechanism, linkage
        index = linkage.links.index
        self.order = [index(link) for link in mechanism.links]
        self.input = mechanism.links.index(mechanism.input_link)
        self.fast = index(mechanism.input_link)
        self.moving = [k for k in self.order if k != self.fast]
        assert mechanism.driving is not None
        self.driven = mechanism.joints.index(mechanism.driving)
        self.about = mechanism.driving.freedoms[0]
        self.below = index(mechanism.base)
        self.base = FRAME if mechanism.base == mechanism.frame else mechanism.links.index(mechanism.base)
        self.rolls = any(pair.kind.rolls for pair in mechanism.joints)
        self.step = (ROLLED if self.rolls else STEP) * (linkage.size if mechanism.slides else 1.0)

    def walk(self, low: float, high: float) -> None:
        """Go from where it is drawn to both ends of a range of angles [rad]."""
        nodes = [(0.0, self.linkage.drawn()), *self._walked(low), *self._walked(high)]
        nodes.sort(key=lambda one: one[0])
        self.places = np.asarray([one for one, _pose in nodes])
        self.known = np.stack([pose for _one, pose in nodes])

    def at(self, angle: Array) -> tuple[Array, Array]:
        """Return poses (p, n, 4, 4) and misfits (p, m, 2) at angles (p,) [rad] within the range walked."""
        if self.rolls:
            near = np.argmin(np.abs(self.places - angle[:, None]), axis=1)
            return self._stepped(self.known[near], self.places[near], angle)
        k = np.clip(np.searchsorted(self.places, angle) - 1, 0, len(self.places) - 2)
        share = (angle - self.places[k]) / (self.places[k + 1] - self.places[k])
        apart = self.known[k + 1] @ np.linalg.inv(self.known[k])
        turn = screws.turned_by(apart)
        twist = np.concatenate((turn, apart[..., :3, 3] - 0.5 * frames.cross(turn, apart[..., :3, 3])), axis=-1)
        between = screws.exponential(share[:, None, None] * twist, np.ones(twist.shape[:-1])) @ self.known[k]
        return self._stepped(self.known[k], self.places[k], angle, between)

    def _walked(self, end: float) -> list[tuple[float, Array]]:
        """Return where the links stand on the way to an angle."""
        count = math.ceil(abs(end) / self.step - 1e-9)
        found: list[tuple[float, Array]] = []
        last = before = self.linkage.drawn()
        for k in range(1, count + 1):
            start, stop = (k - 1) * end / count, k * end / count
            ahead = None if self.rolls else last @ np.linalg.inv(before) @ last
            before, last = last, self._stepped(last, np.asarray(start), np.asarray(stop), ahead)[0]
            found.append((stop, last))
        return found

    def _stepped(self, poses: Array, start: Array, stop: Array, ahead: Array | None = None) -> tuple[Array, Array]:
        """Return poses (..., n, 4, 4) led from one angle to another, with misfits; refuse those whose pairs open."""
        guess = np.array(ahead if ahead is not None else self._led(poses, stop - start))
        guess[..., self.fast, :, :] = guess[..., self.below, :, :] @ moved_along(self.about, stop)
        tied = None if self.base == FRAME else (self.fast, self.below)
        found, misfit = self.linkage.settled(guess, self.moving, tied)
        worst = np.max(misfit, axis=(-2, -1))
        if np.max(worst) > CLOSED:
            where = int(np.argmax(np.ravel(worst) > CLOSED))
            self._refuse(
                np.reshape(misfit, (-1, *misfit.shape[-2:]))[where], float(np.ravel(stop + 0.0 * worst)[where])
            )
        return found, misfit

    def _led(self, poses: Array, step: Array) -> Array:
        """Return poses led on by a step (...) [rad] of the input as the pairs let them move."""

        def slope(ahead: Array) -> Array:
            here = screws.exponential(ahead, np.ones(ahead.shape[:-1])) @ poses
            at = self.placed(here)
            found = speeds(at, input_link=self.input, about=self.twist(at), base=self.base)
            whole = np.zeros((*found.shape[:-2], len(self.linkage.links), 6))
            whole[..., self.order, :] = found
            return _drawn_back(ahead, whole)

        size = step[..., None, None]
        none = np.zeros((*poses.shape[:-2], 6))
        one = slope(none)
        two = slope(0.5 * size * one)
        three = slope(0.5 * size * two)
        four = slope(size * three)
        whole = size * (one + 2.0 * two + 2.0 * three + four) / 6.0
        return screws.exponential(whole, np.ones(whole.shape[:-1])) @ poses

    def placed(self, poses: Array) -> Placed:
        """Return the pairs of the mechanism where they stand with its links."""
        mechanism, linkage = self.mechanism, self.linkage
        number = {link: k for k, link in enumerate(mechanism.links)} | {mechanism.frame: FRAME}
        point, axis, second = linkage.placed(poses)
        carriers: list[int | None] = []
        for k, pair in enumerate(mechanism.joints):
            carriers.append(number[pair.carrier or mechanism.frame] if pair.kind.rolls else None)
            if pair.kind.rolls:
                link = linkage.links.index(pair.carrier or mechanism.frame)
                there = poses[..., link, :, :]
                point[..., k, :] = there[..., :3, :3] @ np.asarray(pair.point) + there[..., :3, 3]
                axis[..., k, :] = there[..., :3, :3] @ pair.along
        return Placed(
            links=len(mechanism.links),
            ends=tuple((number[a], number[b]) for a, b in (pair.links for pair in mechanism.joints)),
            kinds=tuple(pair.kind for pair in mechanism.joints),
            point=point,
            axis=axis,
            second=second,
            pitch=tuple(pair.pitch or 0.0 for pair in mechanism.joints),
            carriers=tuple(carriers),
        )

    def twist(self, placed: Placed) -> Array:
        """Return the twist of the input link against its base, array (..., 6)."""
        axis = placed.axis[..., self.driven, :]
        if self.mechanism.slides:
            return screws.translation(axis)
        return screws.rotation(axis, placed.point[..., self.driven, :])

    def drive(self, placed: Placed) -> Array:
        """Return the wrench on the input link that drives it, array (..., 6): a couple, or a force along its axis."""
        axis, point = placed.axis[..., self.driven, :], placed.point[..., self.driven, :]
        turn, push = (frames.cross(point, axis), axis) if self.mechanism.slides else (axis, 0.0 * axis)
        return np.concatenate((turn, push), axis=-1)

    def _refuse(self, misfit: Array, angle: float) -> None:
        """Refuse a mechanism whose pairs do not close: which link cannot follow, at which angle, what is lacking."""
        pair = self.linkage.joints[int(np.argmax(np.max(misfit, axis=-1)))]
        gap, lean = open_by(misfit)
        link = next(
            (one for one in pair.links[::-1] if one not in (self.mechanism.frame, self.mechanism.input_link)), ""
        )
        text = _(
            "{link} cannot follow: with {input} turned by {angle:.4g}°, {pair} stays open: its pairs lack {gap:.3g} mm "
            "and {lean:.3g}°; an input that does not go round needs its range, input_range_deg"
        )
        if self.mechanism.slides:
            text = _(
                "{link} cannot follow: with {input} moved by {path:.4g} mm, {pair} stays open: its pairs lack "
                "{gap:.3g} mm and {lean:.3g}°; input_stroke_mm must end before that"
            )
        said = text.format(
            link=repr(link or pair.links[1]),
            input=repr(self.mechanism.input_link),
            pair=repr(pair.id),
            gap=gap * self.linkage.size / mm,
            lean=lean / deg,
            angle=angle / deg,
            path=angle / mm,
        )
        raise InputError([Problem("input_link", said + by_rounding(gap), "out_of_range")])


def _drawn_back(ahead: Array, twist: Array) -> Array:
    """Return how fast exponential coordinates grow for twists (..., 6), up to their third order."""
    inner = screws.bracket(ahead, twist)
    return twist - 0.5 * inner + screws.bracket(ahead, inner) / 12.0


def _check_held(way: _Way, angle: Array) -> None:
    """Refuse a mechanism that one input does not move alone: which link moves beside it, and in how many ways."""
    mechanism = way.mechanism
    placed = way.placed(way.at(angle)[0])
    found = rates(placed, input_link=way.input, about=way.twist(placed), base=way.base)
    k = int(np.argmin(found.count))
    free = found.free[k, : found.count[k]] if found.count[k] else found.free[k, :0]
    for name in [mechanism.output_link] if mechanism.output_link else mechanism.links:
        own = free[:, mechanism.links.index(name)]
        ways = int(np.linalg.matrix_rank(own, tol=HELD)) if len(own) else 0
        if ways and (mechanism.output_link or not _spins(free, mechanism.links.index(name))):
            text = plural(
                "{link} is not held: with {input} at rest at {place} it has {count} motion left; a mechanism has one "
                "input",
                "{link} is not held: with {input} at rest at {place} it has {count} motions left; a mechanism has one "
                "input",
                ways,
            )
            at = float(angle[k])
            place = f"{at / mm:.4g} {label('mm')}" if mechanism.slides else f"{at / deg:.4g}°"
            said = text.format(link=repr(name), input=repr(mechanism.input_link), count=ways, place=place)
            raise refuse("input_link", said, "inconsistent")


def _spins(free: Array, link: int) -> bool:
    """Tell whether what is left (w, n, 6) of a link and of all others does not hang together: it but spins."""
    own, others = free[:, link], np.reshape(np.delete(free, link, axis=1), (len(free), -1))
    return bool(np.linalg.matrix_rank(own, tol=HELD) + np.linalg.matrix_rank(others, tol=HELD) == len(free))
