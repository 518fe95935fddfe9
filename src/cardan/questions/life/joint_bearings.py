"""What the bearings of the joints of a drive are rated for, from what its file says."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.formulas.joint_rating import critical_swing, needle_rating
from cardan.maths.arrays import Array
from cardan.texts import _


@dataclass(frozen=True, kw_only=True, slots=True)
class Missing:
    """A life that could not be told: the path of the key to add, and what is left out without it."""

    field: str
    message: str
    key: bool = True  # whether a key is missing; else the kind of the joint has no such life


@dataclass(frozen=True, eq=False, kw_only=True)
class JointBearings:
    """Bearings of the joints of a drive; nan where the drive does not say."""

    span: Array  # (n,) [m]: d, between the middles of opposite bearings
    capacity: Array  # capacity, static_capacity (n,) [N]: C and C_0 of one bearing
    static_capacity: Array  # (n,) [N]
    rating: Array  # (n,) [N·m]: torque that the maker names
    convention: tuple[str, ...]  # tuple of str (n,): what it means; empty where there is none
    critical_swing: Array  # (n,) [rad]: bend below which needles do not reach their neighbours' tracks
    inner: (
        Array  # (n,) of bool: whether they are inside of a joint without a cross of its own; their span counts as 1 m
    )
    assumed: tuple[str, ...] = ()  # paths of capacities computed from the needles

    @property
    def rated(self) -> Array:
        """Whether ISO 281 can rate each joint, array of bool (n,)."""
        return ~np.isnan(self.span * self.capacity)


def joint_bearings(drive: Drive) -> tuple[JointBearings, tuple[Missing, ...]]:
    """Return the bearings of every joint, and the keys that are missing to rate them by ISO 281.

    A capacity that is not given follows from the needles by ISO 281 and ISO 76, a full row of one length.

    >>> from cardan.joints import Hooke
    >>> from cardan.parts import Cross, Needles
    >>> needles = Needles(count=22, diameter=2.5e-3, length=14e-3)
    >>> joint = Hooke(joint_angle=0.1, cross=Cross(span=0.08, journal=0.016), needles=needles)
    >>> bearings, missing = joint_bearings(Drive(joints=(joint,)))
    >>> print(bearings.capacity.round(0), bearings.assumed)
    [18514.] ('joints[0].needles.capacity', 'joints[0].needles.static_capacity')
    """
    rows: list[list[float]] = []
    convention: list[str] = []
    assumed: list[str] = []
    missing: list[Missing] = []
    for i, joint in enumerate(drive.joints):
        why = joint.refusal("life")
        row, found = ([float("nan")] * 5, []) if why else _inner_figures(joint) if joint.rated else _figures(joint)
        rows.append(row)
        assumed += [f"joints[{i}].needles.{name}" for name in found]
        rating = joint.rating
        named = rating is not None and rating.torque is not None and not why and not joint.rated
        convention.append(rating.convention if named and rating is not None else "")
        inner = _inner_lacking(joint, i) if joint.rated else _lacking(joint, i, row)
        missing += [_told_by_none(i, why)] if why else inner
    table = np.asarray(rows, dtype=float).T
    names = ("span", "capacity", "static_capacity", "rating", "critical_swing")
    bearings = JointBearings(
        **dict(zip(names, table, strict=True)),
        inner=np.asarray([bool(joint.rated) for joint in drive.joints]),
        convention=tuple(convention),
        assumed=tuple(assumed),
    )
    return bearings, tuple(missing)


def _told_by_none(i: int, why: str) -> Missing:
    """Return why the life of a joint is not told."""
    text = _("the life of joint {number} is not told: {why}")
    return Missing(field=f"joints[{i}].kind", message=text.format(number=i + 1, why=why), key=False)


def _figures(joint: Joint) -> tuple[list[float], list[str]]:
    """Return span, capacities, rating and critical swing of a joint, and which of them were computed."""
    nan = float("nan")
    cross, needles = joint.cross, joint.needles
    span = nan if cross is None or cross.span is None else cross.span
    rating = nan if joint.rating is None or joint.rating.torque is None else joint.rating.torque
    if needles is None:
        return [span, nan, nan, rating, nan], []
    found: list[str] = []
    journal = None if cross is None else cross.journal
    count, diameter, length = needles.count, needles.diameter, needles.length
    capacity, static, swing = needles.capacity, needles.static_capacity, nan
    if journal is not None and count is not None and diameter is not None:
        swing = float(critical_swing(count, diameter, journal)[0])
        if length is not None:
            rated = needle_rating(count, diameter, length, journal)
            if capacity is None:
                capacity, found = float(rated.dynamic), [*found, "capacity"]
            if static is None:
                static, found = float(rated.static), [*found, "static_capacity"]
    return [span, nan if capacity is None else capacity, nan if static is None else static, rating, swing], found


def _inner_figures(joint: Joint) -> tuple[list[float], list[str]]:
    """Return the same of the bearings inside of a joint, whose loads are forces."""
    nan = float("nan")
    capacity = nan if joint.without(joint.rated) else float(getattr(joint, joint.rated[-1]))
    return [1.0, capacity, nan, nan, nan], []


def _inner_lacking(joint: Joint, i: int) -> Iterator[Missing]:
    """Yield what the bearings inside of a joint lack for ISO 281."""
    for name in joint.without(joint.rated):
        text = _("missing; without it ISO 281 cannot rate joint {number}")
        yield Missing(field=f"joints[{i}].{name}", message=text.format(number=i + 1))


def _lacking(joint: Joint, i: int, row: list[float]) -> Iterator[Missing]:
    """Yield what a joint lacks for ISO 281."""
    span, capacity = row[:2]
    if np.isnan(span):
        text = _("missing; without it ISO 281 cannot rate joint {number}")
        yield Missing(field=f"joints[{i}].cross.span", message=text.format(number=i + 1))
    if np.isnan(capacity):
        text = _(
            "missing; without it, or count, diameter and length of the needles, ISO 281 cannot rate joint {number}"
        )
        needles = joint.needles
        inner = needles is not None and None not in (needles.count, needles.diameter, needles.length)
        field = "cross.journal" if inner else "needles.capacity"
        yield Missing(field=f"joints[{i}].{field}", message=text.format(number=i + 1))
