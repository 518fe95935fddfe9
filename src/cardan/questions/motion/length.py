"""How far does a sliding shaft slide, and does its spline allow it?"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.drive import Drive
from cardan.drive.duty import Limits
from cardan.drive.shaft import Spline
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import Series, crossings, turning_points, values_at
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost_on
from cardan.texts import _

from .moving_chain import Shafts

STIFF = 1e-6
"""A shaft whose length changes by less than this share of it does not slide: rounded coordinates do as much."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Flag:
    """A limit passed, with when and where."""

    field: str  # path of what is short, ``shafts[1].spline.engaged``
    message: Text  # what happens, in one sentence
    time: float  # [s]: instant of the worst value
    value: float  # [m]: the worst value
    limit: float  # [m]: what it should not fall below (or reach)
    spans: tuple[tuple[float, float], ...]  # [s]: from when until when the limit is passed


@dataclass(frozen=True, kw_only=True, slots=True)
class Plunge:
    """How far joints that take up the length of a shaft may plunge."""

    joints: tuple[int, ...]  # which, from 0
    out: float | None  # [m]: together, pulled out of where they are drawn; None where one does not say it
    back: float | None  # [m]: pushed in


@dataclass(frozen=True, kw_only=True, slots=True)
class LengthCompensation:
    """What the sliding of one shaft amounts to over a movement."""

    shaft: int
    drawn: float  # [m]: length in the drawn position, in which engaged length and gap of the spline are given
    length_min: float  # length_min, length_max [m]: shortest and longest
    length_max: float  # [m]
    time_min: float  # time_min, time_max [s]: when it is
    time_max: float  # [s]
    max_rate: float  # max_rate, max_acceleration [m/s, m/s²]: largest sliding speed and acceleration, as magnitudes
    max_acceleration: float  # [m/s²]
    slip_path: float  # [m]: total way slid, back and forth
    # [m]: shortest engaged length of the spline; None when the drive does not say the drawn one
    engaged_min: float | None
    gap_min: float | None  # [m]: least way left to bottoming; None when the drive does not say the drawn one
    flags: tuple[Flag, ...]  # limits passed

    @property
    def stroke(self) -> float:
        """Longest less shortest length [m]."""
        return self.length_max - self.length_min

    @property
    def slides(self) -> bool:
        """Whether the length changes at all, see `STIFF`."""
        return self.stroke > STIFF * self.drawn


def length_compensation(
    times: ArrayLike,
    length: ArrayLike,
    rate: ArrayLike,
    acceleration: ArrayLike,
    *,
    spline: Spline | None = None,
    limits: Limits | None = None,
    drawn: float | None = None,
    shaft: int = 2,
    plunge: Plunge | None = None,
) -> LengthCompensation:
    """Return stroke, sliding speed, slip path, engaged length and gap of one shaft over a movement.

    times (t,) [s]: instants, rising.
    length, rate, acceleration (t,) [m, m/s, m/s²]: L, its first and second time derivative.
    spline: engaged length and gap in the drawn position.
    limits: smallest engaged length allowed, ``spline_overlap``; more than zero when not given.
    drawn [m]: length L_0 in the drawn position; that of the first instant by default.
    shaft: number of the shaft, for the flags.
    plunge: how far joints at its ends that take up its length may be pulled out and pushed in.
    Raises InputError: times that do not rise, arrays of different lengths.

    engaged = engaged_0 - (L - L_0), gap = gap_0 + (L - L_0). Between the instants the length follows the quintic
    through values, rates and accelerations: the extremes lie where the rate vanishes, and the slip path ∫|L̇|dt
    is the sum of the ways between them, not a sum over instants. Sliding does not change how the shafts turn.

    The lengths follow from the centres, which the movement gives. Where several neighbouring shafts slide and the
    centre between them is held by nothing, no movement can say where it is, and neither can this function.
    """
    series = _series(times, length, rate, acceleration)
    base = float(series[1][0]) if drawn is None else drawn
    at, values = turning_points(series)
    low, high = int(foremost_on(values, least=True)), int(foremost_on(values))
    engaged = spline.engaged if spline else None
    gap = spline.gap if spline else None
    flags = (
        *_short(series, base, engaged, limits, shaft, at, values),
        *_bottoms(series, base, gap, shaft, at, values),
        *(_plunged(series, base, plunge, shaft, at, values) if plunge is not None else ()),
    )
    return LengthCompensation(
        shaft=shaft,
        drawn=base,
        length_min=float(values[low]),
        length_max=float(values[high]),
        time_min=float(at[low]),
        time_max=float(at[high]),
        max_rate=_largest_rate(series),
        max_acceleration=float(np.max(np.abs(series[3]))),
        slip_path=float(np.sum(np.abs(np.diff(values)))),
        engaged_min=None if engaged is None else engaged - (float(values[high]) - base),
        gap_min=None if gap is None else gap + (float(values[low]) - base),
        flags=flags,
    )


def plunging(drive: Drive, k: int) -> list[int]:
    """Return which joints take up the length of a shaft counted from 0: those that plunge at its ends.

    None where a spline does, its own or that of an end shaft beside it.
    """
    ends = {0, len(drive.shafts) - 1} & {k - 1, k + 1}
    if any(drive.shafts[one].spline is not None for one in (k, *ends)):
        return []
    joints = drive.joints
    return [i for i in (k - 1, k) if "plunge_out" in joints[i].own_fields() and joints[i].slides]


def plunge_of(drive: Drive, k: int) -> Plunge | None:
    """Return how far the joints that take up the length of a shaft counted from 0 may plunge; None where none does."""
    taken = plunging(drive, k) if 0 < k < len(drive.joints) else []
    if not taken:
        return None
    out, back = ([getattr(drive.joints[i], key) for i in taken] for key in ("plunge_out", "plunge_in"))
    ways = (None if None in own else sum(own) for own in (out, back))
    return Plunge(joints=tuple(taken), out=next(ways), back=next(ways))


def slip_ends(drive: Drive) -> tuple[int, ...]:
    """Return the end shafts, from 0, whose splines take up the length of the shaft beside them, which has none."""
    last = len(drive.shafts) - 1
    beside = {0: 1, last: last - 1} if last > 1 else {}
    return tuple(k for k, j in beside.items() if drive.shafts[k].spline and not drive.shafts[j].spline)


def slipping(shafts: Shafts, rest: ArrayLike, ends: Sequence[int]) -> Shafts:
    """Return the shafts with lengths as splines of end shafts make them: those beside keep theirs.

    rest (..., n+1) [m]: lengths as drawn; ends: of `slip_ends`. A movement puts the joint of an end shaft at the
    distance L from the next one, and that shaft has the length L_0. So the yoke slips along the end shaft by
    s = q - √W, W = L_0² - L² + q², q = L cos α. Between two such ends each is taken to slip by all of it.
    """
    length, rate, acceleration = (
        np.array(one) for one in (shafts.length, shafts.length_rate, shafts.length_acceleration)
    )
    for end in ends:
        k = 1 if end == 0 else end - 1
        (e, e1, e2), (a, a1, a2) = (
            (shafts.axis[..., i, :], shafts.axis_rate[..., i, :], shafts.axis_acceleration[..., i, :]) for i in (end, k)
        )
        c, c1 = frames.dot(e, a), frames.dot(e1, a) + frames.dot(e, a1)
        c2 = frames.dot(e2, a) + 2.0 * frames.dot(e1, a1) + frames.dot(e, a2)
        x, x1, x2 = (one[..., k] for one in (shafts.length, shafts.length_rate, shafts.length_acceleration))
        q, q1, q2 = x * c, x1 * c + x * c1, x2 * c + 2.0 * x1 * c1 + x * c2
        own = np.asarray(rest, dtype=float)[..., k]
        root = np.sqrt(own**2 - x**2 + q**2)
        root1 = (q * q1 - x * x1) / root
        root2 = (q1**2 + q * q2 - x1**2 - x * x2 - root1**2) / root
        for whole, slip, still in ((length, q - root, own), (rate, q1 - root1, 0.0), (acceleration, q2 - root2, 0.0)):
            whole[..., end] += slip
            whole[..., k] = still
    return replace(shafts, length=length, length_rate=rate, length_acceleration=acceleration)


def _series(times: ArrayLike, length: ArrayLike, rate: ArrayLike, acceleration: ArrayLike) -> Series:
    t, x, v, a = (np.atleast_1d(np.asarray(part, dtype=float)) for part in (times, length, rate, acceleration))
    for name, part in (("length", x), ("rate", v), ("acceleration", a)):
        if part.shape != t.shape:
            raise refuse(name, _("{given} values given, {wanted} needed").format(given=part.size, wanted=t.size))
    if t.size == 0 or bool(np.any(np.diff(t) <= 0.0)):
        raise refuse("times", _("the instants must rise from one to the next"))
    return t, x, v, a


def _largest_rate(series: Series) -> float:
    """Return max |L̇|: at the instants, and between them where the acceleration changes its sign."""
    times, _length, rate, acceleration = series
    largest = float(np.max(np.abs(rate)))
    inside = np.flatnonzero(acceleration[:-1] * acceleration[1:] < 0.0)
    if inside.size:
        share = acceleration[inside] / (acceleration[inside] - acceleration[inside + 1])
        at = times[inside] + share * (times[inside + 1] - times[inside])
        largest = max(largest, float(np.max(np.abs(values_at(series, at, order=1)))))
    return largest


def _short(
    series: Series, base: float, engaged: float | None, limits: Limits | None, shaft: int, at: Array, values: Array
) -> tuple[Flag, ...]:
    """Flag an engaged length below the limit, or none left."""
    if engaged is None:
        return ()
    stated = limits.spline_overlap if limits else None
    limit = stated or 0.0
    spans = _spans(series, base + engaged - limit, longer=True, touching=stated is None)
    if not spans:
        return ()
    worst = int(foremost_on(values))
    least = engaged - (float(values[worst]) - base)
    if least <= 0.0:
        text = _("the spline of shaft {shaft} comes apart: its engaged length falls to {value} at {time}")
    else:
        text = _("the engaged length of the spline of shaft {shaft} falls to {value} at {time}; allowed is {limit}")
    return (_flag(f"shafts[{shaft - 1}].spline.engaged", text, shaft, float(at[worst]), least, limit, spans),)


def _bottoms(series: Series, base: float, gap: float | None, shaft: int, at: Array, values: Array) -> tuple[Flag, ...]:
    """Flag a gap used up."""
    if gap is None:
        return ()
    spans = _spans(series, base - gap, longer=False, touching=True)
    if not spans:
        return ()
    worst = int(foremost_on(values, least=True))
    least = gap + (float(values[worst]) - base)
    text = _("the spline of shaft {shaft} bottoms: the way left falls to {value} at {time}")
    return (_flag(f"shafts[{shaft - 1}].spline.gap", text, shaft, float(at[worst]), least, 0.0, spans),)


def _plunged(series: Series, base: float, plunge: Plunge, shaft: int, at: Array, values: Array) -> tuple[Flag, ...]:
    """Flag joints pulled out or pushed in farther than they may."""
    texts = {
        "plunge_out": _("shaft {shaft} pulls its joint out by {value} at {time}; allowed is {limit}"),
        "plunge_in": _("shaft {shaft} pushes its joint in by {value} at {time}; allowed is {limit}"),
    }
    found = []
    for (key, text), sign, limit in zip(texts.items(), (1.0, -1.0), (plunge.out, plunge.back), strict=True):
        spans = () if limit is None else _spans(series, base + sign * limit, longer=sign > 0.0, touching=False)
        if spans and limit is not None:
            worst = int(foremost_on(values, least=sign < 0.0))
            way = sign * (float(values[worst]) - base)
            field = f"joints[{plunge.joints[0]}].{key}"
            found.append(_flag(field, text, shaft, float(at[worst]), way, limit, spans))
    return tuple(found)


def _flag(
    field: str, text: str, shaft: int, time: float, value: float, limit: float, spans: tuple[tuple[float, float], ...]
) -> Flag:
    message = say(
        text,
        shaft=shaft,
        value=Quantity(value, "length", decimals=1),
        time=Quantity(time, "time", trim=True),
        limit=Quantity(limit, "length", decimals=1, trim=True),
    )
    return Flag(field=field, message=message, time=time, value=value, limit=limit, spans=spans)


def _spans(series: Series, level: float, *, longer: bool, touching: bool) -> tuple[tuple[float, float], ...]:
    """Return from when until when the length is beyond a level (or, with ``touching``, at it)."""
    times = series[0]
    at, values = turning_points(series)
    edges = np.unique(np.concatenate((at, crossings(series, level) if times.size > 1 else times)))
    sign = 1.0 if longer else -1.0
    tolerance = 1e-12 * abs(level)

    def beyond(value: float) -> bool:
        over = sign * (value - level)
        return over >= -tolerance if touching else over > tolerance

    if edges.size == 1:
        return ((float(edges[0]), float(edges[0])),) if beyond(float(values[0])) else ()
    middles = values_at(series, 0.5 * (edges[1:] + edges[:-1]))
    spans: list[tuple[float, float]] = []
    for start, end, value in zip(edges[:-1], edges[1:], middles, strict=True):
        if not beyond(float(value)):
            continue
        if spans and math.isclose(spans[-1][1], start):
            spans[-1] = (spans[-1][0], float(end))
        else:
            spans.append((float(start), float(end)))
    if not spans and touching:
        spans = [(float(t), float(t)) for t, value in zip(at, values, strict=True) if beyond(float(value))]
    return tuple(spans)
