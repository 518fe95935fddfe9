"""Tubes, stubs, slip splines, flanges and what else a shaft carries between its yokes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise

import numpy as np

from cardan.drive.body import pieces
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.shapes.yoke import ACROSS
from cardan.maths.kernel.meshes import Surface, joined, placed, plate, revolved, toothed

SHOWN_TEETH = 40
"""Teeth of a spline that are drawn at most."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Stretch:
    """A piece of a shaft with one cross section, along the shaft [m]."""

    start: float
    stop: float
    outer: float
    inner: float = 0.0


@dataclass(frozen=True, kw_only=True, slots=True)
class Slip:
    """Where a slip spline stands along its shaft [m], and which way it is put together."""

    start: float  # start, stop: ends of the engagement
    stop: float
    back: float  # where the bore of the sleeve ends
    out: float  # where the teeth end beyond the sleeve
    tip: float  # tip, root: radii of the teeth
    root: float
    teeth: int
    sleeve_first: bool  # whether the sleeve belongs to the start of the shaft


@dataclass(frozen=True, eq=False, kw_only=True)
class Piece:
    """A body of a shaft, along x from the joint before it, and whether it belongs to the shaft's start."""

    part: str
    surface: Surface
    first: bool


def shaft_stretches(
    shaft: Shaft, low: float, high: float, length: float | None, radius: float, necks: Sequence[tuple[float, float]]
) -> list[Stretch]:
    """Return the stretches of a shaft between its yokes: those of its file, else one with a neck at each support.

    low, high [m]: where it begins and ends, from the joint before it; on shaft 1 from joint 1.
    length [m]: between its joints; None for an end shaft.
    radius [m]: where it is thickest; necks [m]: places of supports and the radius there.
    """
    stretches = _stretches(shaft, low, high, length, radius)
    return stretches if shaft.segments else _necked(stretches, necks, radius)


def shaft_pieces(shaft: Shaft, low: float, high: float, radius: float, stretches: Sequence[Stretch]) -> Iterator[Piece]:
    """Yield the bodies of a shaft between its yokes.

    low, high [m]: where it begins and ends; radius [m]: where it is thickest.
    """
    slip = None if shaft.spline is None or high - low < 0.4 * radius else slip_of(shaft.spline, low, high, radius)
    if slip is None:
        for one in (*stretches, *_plugs(stretches)):
            yield Piece(part="tube", surface=_bar(one, welded=_hollow(one)), first=True)
        return
    end, begin = (slip.back, slip.out) if slip.sleeve_first else (slip.out, slip.back)
    for stretch in (*stretches, *_plugs(stretches)):
        before = replace(stretch, stop=min(stretch.stop, end))
        behind = replace(stretch, start=max(stretch.start, begin))
        for part, first in ((before, True), (behind, False)):
            if part.stop - part.start > 1e-3 * radius:
                yield Piece(part="tube", surface=_bar(part, welded=_hollow(part)), first=first)
    yield Piece(part="tube", surface=_neck(slip, stretches, low, high), first=not slip.sleeve_first)
    body = max(_radius_at(stretches, 0.5 * (slip.start + slip.stop)), slip.tip)
    yield Piece(part="spline sleeve", surface=_sleeve(slip, body, low, high), first=slip.sleeve_first)
    yield Piece(part="spline shaft", surface=_toothed_shaft(slip), first=not slip.sleeve_first)


def slip_of(spline: Spline, low: float, high: float, radius: float) -> Slip:
    """Return where a slip spline stands between the yokes of its shaft.

    spline: what the file says of it; low, high [m]: ends of the shaft beside its yokes; radius [m].
    """
    mean = 0.5 * spline.mean_diameter if spline.mean_diameter is not None else 0.62 * radius
    teeth = min(spline.teeth or 16, SHOWN_TEETH)
    height = min(0.9 * math.pi * mean / teeth, 0.2 * mean)
    tip = 0.5 * spline.outer if spline.outer is not None else mean + 0.5 * height
    root = 0.5 * spline.root if spline.root is not None else min(mean - 0.5 * height, 0.96 * tip)
    root = min(root, 0.97 * tip)
    room = high - low
    engaged = spline.engaged or spline.length or 2.6 * mean
    gap = spline.gap if spline.gap is not None else 0.5 * engaged
    engaged = min(engaged, 0.55 * room)
    gap, out = min(gap, 0.3 * room), min(max(0.7 * engaged, gap), 0.3 * room)
    middle = 0.5 * (low + high) if spline.position is None else spline.position
    middle = min(max(middle, low + 0.5 * engaged), high - 0.5 * engaged)
    first = middle - low <= high - middle
    start, stop = middle - 0.5 * engaged, middle + 0.5 * engaged
    if first:
        back, beyond = max(start - gap, low), min(stop + out, high)
    else:
        back, beyond = min(stop + gap, high), max(start - out, low)
    return Slip(
        start=start, stop=stop, back=back, out=beyond, tip=tip, root=root, teeth=max(teeth, 4), sleeve_first=first
    )


def _stretches(shaft: Shaft, low: float, high: float, length: float | None, radius: float) -> list[Stretch]:
    origin = 0.0
    if shaft.number == 1:
        origin = low if shaft.outer is not None else -sum(one.length for one in shaft.segments)
    whole = length if length is not None else high - origin
    if shaft.segments and length is None:
        whole = sum(one.length for one in shaft.segments)
    found = []
    for one in pieces(shaft, whole):
        start, stop = origin + one.start, origin + one.start + one.length
        found.append(Stretch(start=start, stop=stop, outer=0.5 * one.outer, inner=0.5 * one.inner))
    if not found:
        return [Stretch(start=low, stop=high, outer=radius, inner=0.9 * radius if length is not None else 0.0)]
    found[0] = replace(found[0], start=min(found[0].start, low))
    found[-1] = replace(found[-1], stop=max(found[-1].stop, high))
    cut = [replace(one, start=max(one.start, low), stop=min(one.stop, high)) for one in found]
    return [one for one in cut if one.stop - one.start > 1e-6] or [Stretch(start=low, stop=high, outer=radius)]


def _necked(stretches: list[Stretch], necks: Sequence[tuple[float, float]], radius: float) -> list[Stretch]:
    """Return stretches with a thinner piece where a support holds the shaft."""
    found = stretches
    for place, thin in necks:
        if thin >= 0.97 * radius:
            continue
        half = max(0.9 * thin, 0.3 * radius)
        made: list[Stretch] = []
        for one in found:
            if one.stop <= place - half or one.start >= place + half or one.outer <= thin:
                made.append(one)
                continue
            start = place - half if place - half - one.start > 0.4 * radius else one.start
            stop = place + half if one.stop - place - half > 0.4 * radius else one.stop
            made += [replace(one, stop=start), Stretch(start=start, stop=stop, outer=thin), replace(one, start=stop)]
        found = [one for one in made if one.stop - one.start > 1e-6]
    return found


def _plugs(stretches: Sequence[Stretch]) -> Iterator[Stretch]:
    """Yield what closes a tube where a thinner stretch is welded into it."""
    for one, other in pairwise(stretches):
        for tube, thin, end, sense in ((one, other, one.stop, -1.0), (other, one, other.start, 1.0)):
            if tube.inner > thin.outer:
                ends = sorted((end, end + sense * min(0.2 * tube.inner, tube.stop - tube.start)))
                yield Stretch(start=ends[0], stop=ends[1], outer=tube.inner)


def _radius_at(stretches: Sequence[Stretch], place: float) -> float:
    return next((one.outer for one in stretches if one.start <= place <= one.stop), stretches[-1].outer)


def _hollow(one: Stretch) -> bool:
    return one.inner > 0.3 * one.outer and one.stop - one.start > 0.6 * one.outer


def _bar(one: Stretch, *, welded: bool = False) -> Surface:
    made = _bar_of(round(one.stop - one.start, 9), one.outer, one.inner, welded)
    return placed(made, None, (one.start, 0.0, 0.0))


@lru_cache(maxsize=128)
def _bar_of(length: float, outer: float, inner: float, welded: bool) -> Surface:
    """Return a tube or bar from 0 to its length, with weld seams at its ends."""
    bead = min(0.09 * outer, 0.2 * length) if welded else 0.0
    if bead:
        hump = [(0.0, 1.0), (0.3, 1.06), (0.7, 1.06), (1.0, 1.0)]
        side = [(bead * x, outer * r) for x, r in hump] + [(length - bead * x, outer * r) for x, r in hump[::-1]]
    else:
        edge = min(0.04 * outer, 0.2 * length)
        side = [(0.0, outer - edge), (edge, outer), (length - edge, outer), (length, outer - edge)]
    if inner > 0.0:
        return revolved([(0.0, inner), *side, (length, inner), (0.0, inner)], 28)
    return revolved([(0.0, 0.0), *side, (length, 0.0)], 28)


def _sleeve(slip: Slip, body: float, low: float, high: float) -> Surface:
    """Return the sleeve of a slip spline, toothed inside at its open end."""
    open_, sense = (slip.stop, 1.0) if slip.sleeve_first else (slip.start, -1.0)
    shut = slip.back
    wall = max(1.32 * slip.tip, min(1.5 * slip.tip, 0.92 * body))
    mouth = min(0.3 * (slip.stop - slip.start), 0.6 * slip.tip)
    length = abs(open_ - shut) - mouth
    neck = min(0.25 * length, 0.4 * abs(body - wall))
    profile = [
        (0.0, 0.0),
        (0.0, body),
        (neck, wall),
        (length - 0.2 * mouth, wall),
        (length, 1.09 * wall),
        (length, 0.0),
    ]
    solid = revolved(profile, 28)
    teeth = toothed(1.03 * slip.root, 1.03 * slip.tip, slip.teeth)
    ring = placed(plate(1.09 * wall * teeth / np.linalg.norm(teeth, axis=-1, keepdims=True), 0.0, mouth, teeth), ACROSS)
    whole = joined(solid, placed(ring, None, (length, 0.0, 0.0)))
    return placed(whole, np.diag([sense, 1.0, sense]), (shut, 0.0, 0.0))


def _neck(slip: Slip, stretches: Sequence[Stretch], low: float, high: float) -> Surface:
    """Return what joins the toothed shaft to the tube behind it: a plug that narrows toward the teeth."""
    sense = 1.0 if slip.sleeve_first else -1.0
    body = _radius_at(stretches, slip.out + sense * 1e-6)
    room = abs((high if slip.sleeve_first else low) - slip.out)
    long, thin = max(min(0.9 * body, 0.9 * room), 0.02 * body), min(0.97 * slip.root, body)
    side = [
        (-0.35 * long, thin),
        (0.0, max(0.8 * body, thin)),
        (0.05 * long, 0.985 * body),
        (0.35 * long, 0.985 * body),
    ]
    made = revolved([(-0.35 * long, 0.0), *side, (0.35 * long, 0.0)], 24)
    return placed(made, np.diag([sense, 1.0, sense]), (slip.out, 0.0, 0.0))


def _toothed_shaft(slip: Slip) -> Surface:
    teeth = toothed(slip.root, slip.tip, slip.teeth)
    low, high = (slip.start, slip.out) if slip.sleeve_first else (slip.out, slip.stop)
    return placed(plate(teeth, low, high), ACROSS)
