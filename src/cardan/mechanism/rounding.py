"""A drawing with few digits, and the smallest changes of it with which its loops close all round.

Axes that meet, and whatever else is held more than once, close only as exactly as the numbers of a file are. Sought are
small shifts and turns of the halves of all pairs in their links with which all loops close at `PLACES` of the input's
way at once, as small as they can be: Levenberg's and Marquardt's method, with the links where they settle best.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.texts import _
from cardan.units import deg, mm

from .closing import Linkage, moved_along
from .mechanism import Mechanism, Pair, Point

PLACES = 16
"""Places of the input's way at which the loops are to close."""

STEP = 4.0 * deg
"""Largest step of the input from one place to the next while links are followed; of one that slides over the size."""

ROUNDS = 40
"""Most steps; a drawing with three digits takes seven."""

CLOSED = 1e-12
"""Misfit, lengths over the size, at which the loops are closed: rounding is a tenth of it."""

FIRST, FALL, LAST = 1e-4, 0.3, 1e-10
"""Damping of the steps: the first one, its share from step to step, the least one."""

LOOSE = 1e-10
"""Share of the largest square that keeps links which spin by themselves where they are."""

MEET = 1e-9
"""Sine below which shafts are parallel, and do not meet."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Fitted:
    """A mechanism with its loops closed, and what was changed for that."""

    mechanism: Mechanism
    shift: float  # [m]: largest way of a pair, as far as it holds something that way
    turn: float  # [rad]: largest turn of an axis
    pair: str  # name of the pair that was moved most


def exactly(mechanism: Mechanism) -> Mechanism:
    """Return a mechanism as it is meant: with closed loops where its file says that its numbers are rounded.

    Raises InputError: loops that open by more.
    """
    return mechanism if mechanism.rounding is None else fitted(mechanism).mechanism


@lru_cache(maxsize=64)
def fitted(mechanism: Mechanism) -> Fitted:
    """Return a mechanism whose numbers are rounded with its loops closed, and how far its pairs were moved.

    Raises InputError: loops that do not close, or not by so little.
    """
    driven = mechanism.driving
    assert driven is not None
    met = _met(mechanism)
    fixed = [mechanism.joints.index(driven), *([] if met is None else [met[0]])]
    if met is not None:
        mechanism = replace(mechanism, joints=_with(mechanism.joints, *met))
    linkage = Linkage(mechanism.joints)
    poses = _closed(linkage, _followed(mechanism, linkage), mechanism, fixed)
    found = [_pair(pair, *place) for pair, *place in zip(mechanism.joints, *linkage.placed(poses), strict=True)]
    assert mechanism.rounding is not None
    moved = [_moved(old, new) for old, new in zip(mechanism.joints, found, strict=True)]
    reach = [max(shift, turn * linkage.size) for shift, turn in moved]
    most = int(np.argmax(reach))
    shift, turn = (max(one) for one in zip(*moved, strict=True))
    if reach[most] > mechanism.rounding:
        text = _(
            "{pair} would have to move by {shift:.3g} mm and {turn:.3g}° for the loops to close; as rounding "
            "{allowed:.4g} mm is allowed, of an axis over {size:.4g} mm"
        )
        said = text.format(
            pair=repr(mechanism.joints[most].id),
            shift=moved[most][0] / mm,
            turn=moved[most][1] / deg,
            allowed=mechanism.rounding / mm,
            size=linkage.size / mm,
        )
        raise refuse("rounding", said, "out_of_range")
    if met is not None:
        shift = max(shift, met[2])
    exact = replace(mechanism, joints=tuple(found), rounding=None)
    return Fitted(mechanism=exact, shift=shift, turn=turn, pair=mechanism.joints[most].id)


def _met(mechanism: Mechanism) -> tuple[int, Point, float] | None:
    """Return how the bearing of the output is moved so that its axis meets that of the input, where they nearly do.

    Which pair, its point, and how far it is moved [m].
    """
    driven, allowed = mechanism.driving, mechanism.rounding or 0.0
    ends = {mechanism.frame, mechanism.output_link}
    bearings = [k for k, pair in enumerate(mechanism.joints) if set(pair.links) == ends and pair.axis is not None]
    shafts = not mechanism.slides and mechanism.base == mechanism.frame
    if driven is None or not shafts or len(bearings) != 1 or mechanism.output_link == mechanism.input_link:
        return None
    bearing = mechanism.joints[bearings[0]]
    normal = frames.cross(driven.along, bearing.along)
    sine = float(frames.norm(normal))
    if sine < MEET:
        return None
    point = np.asarray(bearing.point, dtype=float)
    gap = float((point - np.asarray(driven.point)) @ normal) / sine
    if abs(gap) > allowed:
        return None
    return bearings[0], _row(point - gap * normal / sine), abs(gap)


def _with(joints: tuple[Pair, ...], number: int, point: Point, _gap: float) -> tuple[Pair, ...]:
    return (*joints[:number], replace(joints[number], point=point), *joints[number + 1 :])


def _followed(mechanism: Mechanism, linkage: Linkage) -> Array:
    """Return where links stand best at `PLACES` of the input's way, array (p, n, 4, 4); the first is the drawing."""
    assert mechanism.driving is not None
    about = mechanism.driving.freedoms[0]
    fast, below = (linkage.links.index(one) for one in (mechanism.input_link, mechanism.base))
    moving, tied = _moving(mechanism, linkage)
    step = STEP * (linkage.size if mechanism.slides else 1.0)
    ends = [end for end in mechanism.travel or () if end]
    rows = [linkage.drawn()]
    for end in ends:
        count = PLACES // len(ends)
        each = max(1, math.ceil(abs(end) / count / step))
        here = before = rows[0]
        for k in range(1, count * each + 1):
            ahead = here @ np.linalg.inv(before) @ here
            ahead[fast] = ahead[below] @ moved_along(about, np.asarray(k * end / (count * each)))
            before, here = here, linkage.settled(ahead, moving, tied)[0]
            if k % each == 0:
                rows.append(here)
    return np.stack(rows)


def _moving(mechanism: Mechanism, linkage: Linkage) -> tuple[list[int], tuple[int, int] | None]:
    """Return the links that settle, and the input with the link that it is driven against, where that settles too."""
    fast, below, frame = map(linkage.links.index, (mechanism.input_link, mechanism.base, mechanism.frame))
    moving = [k for k in range(len(linkage.links)) if k not in (fast, frame)]
    return moving, (fast, below) if below in moving else None


def _closed(linkage: Linkage, poses: Array, mechanism: Mechanism, fixed: list[int]) -> Array:
    """Change the halves of pairs in a linkage until all loops close at places (p, n, 4, 4); return the first of these.

    fixed: pairs that stay as they are.
    """
    free, tied = _moving(mechanism, linkage)
    here, count = linkage.scaled(poses, 1.0), len(poses)
    for step in range(ROUNDS):
        slope, rest = linkage.slopes(here, free, tied)
        change = _changes(linkage, here)
        change[..., fixed, :] = 0.0
        change = np.reshape(change, (*rest.shape, -1))
        square = np.swapaxes(slope, -1, -2) @ slope
        most = np.max(np.diagonal(square, axis1=-2, axis2=-1), axis=-1)
        square = square + (LOOSE * most)[..., None, None] * np.eye(square.shape[-1])
        whole = np.concatenate((change, rest[..., None]), axis=-1)
        taken = np.linalg.solve(square, np.swapaxes(slope, -1, -2) @ whole)
        left = whole - slope @ taken  # what the links cannot take up by standing otherwise
        by, gap = left[..., :-1], left[..., -1]
        damped = np.einsum("psa,psb->ab", by, by) + count * max(FIRST * FALL**step, LAST) * np.eye(by.shape[-1])
        moved = -np.linalg.solve(damped, np.einsum("psa,ps->a", by, gap))
        linkage.step(here, -(taken[..., -1] + taken[..., :-1] @ moved), free, tied)
        _change(linkage, np.reshape(moved, (-1, 12)))
        if np.max(np.abs(linkage.rows(here)[1])) < CLOSED:
            return np.asarray(linkage.scaled(here, -1.0)[0])
    rest = np.abs(linkage.rows(here)[1])
    worst = linkage.joints[linkage.row_pair[int(np.argmax(np.max(rest, axis=0)))]].id
    text = _("no small changes of its pairs close its loops: {pair} stays open, by {gap:.3g} mm at least somewhere")
    said = text.format(pair=repr(worst), gap=float(np.max(rest)) * linkage.size / mm)
    raise refuse("rounding", said, "out_of_range")


def _changes(linkage: Linkage, poses: Array) -> Array:
    """Return how turns and shifts of the halves of each pair in their links change what pairs miss, (..., s, m, 12).

    The second half first; turns about the point of the pair, both in the axes of the link as drawn.
    """
    wrench = linkage.rows(poses)[0]
    out = np.zeros((*wrench.shape[:-1], len(linkage.joints), 12))
    rows = np.arange(len(linkage.row_pair))
    for part, sign, link, own in ((0, 1.0, linkage.second, linkage.own_point), (6, -1.0, linkage.first, linkage.point)):
        turn = poses[..., link, :3, :3]
        point = (turn @ own[..., None])[..., 0] + poses[..., :3, 3][..., link, :]
        ways = np.swapaxes(turn, -1, -2)
        turns = np.concatenate((ways, frames.cross(point[..., None, :] + 0.0 * ways, ways)), axis=-1)
        twists = np.concatenate((turns, np.concatenate((0.0 * ways, ways), axis=-1)), axis=-2)
        power = (twists[..., linkage.row_pair, :, :] @ wrench[..., None])[..., 0]
        out[..., rows, linkage.row_pair, part : part + 6] = sign * power
    return out


def _change(linkage: Linkage, moved: Array) -> None:
    """Turn and shift the halves of each pair in their links, (m, 12)."""
    for part in (0, 6):
        about = np.concatenate((moved[:, part : part + 3], np.zeros((len(moved), 3))), axis=-1)
        turn = screws.exponential(about, np.ones(len(moved)))[:, :3, :3]
        shift, back = moved[:, part + 3 : part + 6], np.swapaxes(turn, -1, -2)
        if part:
            linkage.point, linkage.frame = linkage.point + shift, linkage.frame @ back
        else:
            linkage.own_point, linkage.own_frame = linkage.own_point + shift, linkage.own_frame @ back
            linkage.own_second = (turn @ linkage.own_second[..., None])[..., 0]


def _pair(pair: Pair, point: Array, axis: Array, second: Array) -> Pair:
    """Return a pair where it stands, its axes as long as they were."""
    lengths = (float(np.linalg.norm(one)) if one else 0.0 for one in (pair.axis, pair.axis2))
    first, other = (_row(way * length) if length else None for way, length in zip((axis, second), lengths, strict=True))
    return replace(pair, point=_row(point), axis=first, axis2=other)


def _moved(old: Pair, new: Pair) -> tuple[float, float]:
    """Return how far a pair went where that counts, a hinge across its axis [m], and how far its axes turned [rad]."""
    way = np.asarray(new.point) - np.asarray(old.point)
    along = abs(float(way @ old.along))
    across = float(frames.norm(way - (way @ old.along) * old.along))
    gone = {"": 0.0, "axis": along if old.kind.slides == "across" else across}
    turns = [_lean(a, b) for a, b in _axes(old, new)]
    return gone.get(old.kind.turns, math.hypot(along, across)), max(turns, default=0.0)


def _axes(old: Pair, new: Pair) -> Iterator[tuple[Point, Point]]:
    for one, other in ((old.axis, new.axis), (old.axis2, new.axis2)):
        if one is not None and other is not None:
            yield one, other


def _lean(one: Point, other: Point) -> float:
    a, b = np.asarray(one, dtype=float), np.asarray(other, dtype=float)
    return float(np.arctan2(frames.norm(frames.cross(a, b)), a @ b))


def _row(vector: Array) -> Point:
    x, y, z = (float(one) for one in vector)
    return x, y, z
