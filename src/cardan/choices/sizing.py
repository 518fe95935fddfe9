"""How large must a part be? The smallest size at which its checks pass: exactly at the limit, then as it is made."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from cardan.catalogue import Catalogue, catalogue, completed, filled
from cardan.catalogue.rows import JointSize
from cardan.checks import Verdict, as_tried, design
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.joint_parts import Needles
from cardan.errors import refuse
from cardan.maths.ties import foremost_of
from cardan.texts import _

from .size_search import CHECKS, HOLDS, PARTS, SERIES, Hold, Sizing, Tried, solved, used

WALL = 0.04
"""Wall over outer diameter of a tube where the drive gives none."""


def size(
    drive: Drive,
    duty: Duty | None,
    part: str,
    *,
    hold: Hold = "ratio",
    series: str = "step",
    known: Catalogue | None = None,
) -> Sizing:
    """Return the smallest size of a part at which its checks pass.

    Parameters
    ----------
    drive : Drive
    duty : Duty or None
        The drive's own when None.
    part : str
        ``tube:2`` or ``shaft:2`` (a solid one), all stretches of a stepped shaft in proportion; ``journal:1``,
        ``needles:1`` (capacities of its bearings), ``joint:1`` (a row of the catalogue); ``joint`` gives all joints
        the same row. The number may be left out where there is only one such part.
    hold : "ratio", "wall" or "outer"
        What a tube keeps: wall over outer diameter, its wall, or its outer diameter.
    series : str
        What the size is rounded up to: ``step`` (whole mm, tenths for walls), ``R10``, ``R20``, ``R40``.
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    Sizing

    Raises
    ------
    InputError
        No such part; what the checks need is missing; no size passes.

    See Also
    --------
    strength, trade_off

    Notes
    -----
    The checks are inverted, not written a second time: many sizes are judged at once, and the range in which the first
    one passes is narrowed down to the last digits. So the checks themselves say that the size is just at its limit.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, size
    >>> from cardan.parts import Duty, Material, Shaft
    >>> tube = Shaft(number=2, outer=0.09, wall=0.003, length=1.0, material=Material(grade="C45"))
    >>> found = size(replace(Drive.from_angles([0.2, 0.2]), shafts=(tube,)), Duty(torque=800.0), "tube", hold="wall")
    >>> print(f"{found.exact['shafts[1].outer_mm']:.3f}", found.values, found.governing.check)
    40.089 {'shafts[1].outer_mm': 41.0} tube_fatigue
    """
    rows = known or catalogue()
    whole = filled(drive if duty is None else replace(drive, duty=duty), rows)
    kind, number = _named(whole, part)
    if series not in SERIES:
        raise refuse("series", _("{value} is none of {choices}").format(value=repr(series), choices=", ".join(SERIES)))
    if kind == "joint":
        return smallest_row(whole, number, rows)
    if kind in ("needles", "journal"):
        refuse_other(whole, number)
    if kind == "needles":
        return _needles(whole, number, series, rows)
    if kind == "journal":
        return _journal(whole, number, series, rows)
    return _tube(whole, number, hold, series, rows, solid=kind == "shaft")


def _named(drive: Drive, part: str) -> tuple[str, int]:
    """Return kind and number of a part; 0 for all joints alike."""
    kind, _colon, text = part.partition(":")
    if kind not in PARTS:
        raise refuse("part", _("{value} is none of {choices}").format(value=repr(part), choices=", ".join(PARTS)))
    of_shaft = kind in ("tube", "shaft")
    numbers = range(2, len(drive.joints) + 1) if of_shaft else range(1, len(drive.joints) + 1)
    if of_shaft:
        own = [shaft.number for shaft in drive.shafts if shaft.has_body]
        numbers = range(1, len(drive.joints) + 2) if text else numbers if len(numbers) else own  # type: ignore[assignment]
    if not text:
        if kind == "joint":
            return kind, 0
        if len(numbers) == 1:
            return kind, numbers[0]
        raise refuse("part", _("say which: {choices}").format(choices=", ".join(f"{kind}:{k}" for k in numbers)))
    if not text.isdigit() or int(text) not in numbers:
        choices = ", ".join(f"{kind}:{k}" for k in numbers)
        raise refuse("part", _("{value} is none of {choices}").format(value=repr(part), choices=choices))
    return kind, int(text)


def _tube(drive: Drive, number: int, hold: Hold, series: str, rows: Catalogue, *, solid: bool) -> Sizing:
    k, path = number - 1, f"shafts[{number - 1}]"
    if hold not in HOLDS:
        raise refuse("hold", _("{value} is none of {choices}").format(value=repr(hold), choices=", ".join(HOLDS)))
    shaft = drive.shafts[k]
    if shaft.segments:
        return _stepped(drive, number, hold, series, rows, solid=solid)
    if shaft.profile is not None:
        raise refuse(
            f"{path}.profile", _("profile tubes come in the sizes of their maker; round tubes alone are sized")
        )
    before = {f"{path}.outer_mm": _mm(shaft.outer), f"{path}.wall_mm": _mm(shaft.wall)}
    layered = shaft.layup is not None
    thin = "layup.ply_thickness" if shaft.layup is not None else "wall"
    if solid:
        if layered:
            raise refuse(f"{path}.layup", _("a solid shaft is not made of plies; size it as tube:{k}").format(k=number))
        start = replace(shaft, outer=shaft.outer or 0.05, wall=None, inner=None)
        free, kept = {f"{path}.outer_mm": 1e3 * (start.outer or 0.05)}, {}
    else:
        outer = shaft.outer or 0.08
        wall = shaft.wall or (0.5 * (outer - shaft.inner) if shaft.inner else WALL * outer)
        if shaft.layup is not None:
            wall, start = shaft.layup.ply_thickness, replace(shaft, outer=outer)
            before[f"{path}.{thin}_mm"] = _mm(wall)
            before.pop(f"{path}.wall_mm")
        else:
            start = replace(shaft, outer=outer, wall=wall, inner=None)
        sizes = {f"{path}.outer_mm": 1e3 * outer, f"{path}.{thin}_mm": 1e3 * wall}
        held = {"ratio": (), "wall": (f"{path}.{thin}_mm",), "outer": (f"{path}.outer_mm",)}[hold]
        free = {name: value for name, value in sizes.items() if name not in held}
        kept = {name: value for name, value in sizes.items() if name in held}
    base = replace(drive, shafts=(*drive.shafts[:k], start, *drive.shafts[k + 1 :]))
    if solid:
        before.pop(f"{path}.wall_mm")
    else:
        before = {name: value for name, value in before.items() if name in free or value is None}
    plies = len(shaft.layup.angles) if shaft.layup is not None else 1
    most = _most_wall(free, kept, plies, thin)
    kind = "shaft" if solid else "tube"
    need = ("tube_buckling",) if layered else ("tube_strength",)
    found = solved(base, kind, path, free, before, series, rows, need=need, most=most)
    given = {f"{path}.{name}_mm": getattr(shaft, name) for name in ("outer", "wall", "inner")}
    beside = {name: round(value, 9) for name, value in kept.items() if given.get(name, value) is None}
    left_out = [f"{path}.inner_mm", *([f"{path}.wall_mm"] if solid else [])]
    return replace(
        found,
        exact={**found.exact, **beside},
        values={**found.values, **beside, **{name: None for name in left_out if given[name] is not None}},
        before={**found.before, **{name: _mm(given[name]) for name in left_out if given[name] is not None}},
    )


def _stepped(drive: Drive, number: int, hold: Hold, series: str, rows: Catalogue, *, solid: bool) -> Sizing:
    """Size all stretches of a shaft together, each in proportion."""
    k, path = number - 1, f"shafts[{number - 1}]"
    if hold != "ratio":
        raise refuse("hold", _("a stepped shaft keeps the proportions of its stretches; it is sized by ratio alone"))
    shaft = drive.shafts[k]
    bores = {f"{path}.segments[{s}].inner_mm": 1e3 * one.inner for s, one in enumerate(shaft.segments) if one.inner}
    outers = {f"{path}.segments[{s}].outer_mm": 1e3 * one.outer for s, one in enumerate(shaft.segments)}
    before = {**outers, **bores}
    if not solid:
        return solved(drive, "tube", path, before, before, series, rows, need=("tube_strength",))
    stretches = tuple(replace(one, inner=0.0) for one in shaft.segments)
    full = replace(drive, shafts=(*drive.shafts[:k], replace(shaft, segments=stretches), *drive.shafts[k + 1 :]))
    found = solved(full, "shaft", path, outers, before, series, rows, need=("tube_strength",))
    return replace(found, values={**found.values, **dict.fromkeys(bores)})


def _most_wall(free: Mapping[str, float], kept: Mapping[str, float], plies: int, thin: str) -> float:
    """Return the largest share of a wall, or the smallest of an outer diameter, at which the tube is still a tube."""
    if len(free) == 1 and kept:
        (name, value), (_other, held) = next(iter(free.items())), next(iter(kept.items()))
        return 0.5 * held / (plies * value) if thin in name else -2.0 * plies * held / value
    return math.inf


def _journal(drive: Drive, number: int, series: str, rows: Catalogue) -> Sizing:
    i, path = number - 1, f"joints[{number - 1}].cross"
    cross = drive.joints[i].cross or Cross()
    key = f"{path}.journal_mm"
    start = replace(cross, journal=cross.journal or 0.02)
    base = with_joint(drive, i, cross=start)
    least = max(start.journal_bore, _room(drive.joints[i].needles)) / (start.journal or 0.02)
    most = -least if least > 0.0 else math.inf
    free = {key: 1e3 * (start.journal or 0.02)}
    return solved(base, "journal", f"joints[{i}]", free, {key: _mm(cross.journal)}, series, rows, most=most)


def _room(needles: Needles | None) -> float:
    """Return the smallest journal around which needles have room [m]; 0 where they are not given."""
    if needles is None or needles.count is None or needles.diameter is None:
        return 0.0
    return needles.diameter * (1.0 / math.sin(math.pi / needles.count) - 1.0)


def _needles(drive: Drive, number: int, series: str, rows: Catalogue) -> Sizing:
    """Size dynamic and static capacity, each by its own check."""
    i, path = number - 1, f"joints[{number - 1}]"
    now = drive.joints[i].needles or Needles()
    start = replace(now, capacity=now.capacity or 2e4, static_capacity=now.static_capacity or 2e4)
    base = with_joint(drive, i, needles=start)
    parts = []
    for name, judge in (("capacity", "bearing_life"), ("static_capacity", "needle_static")):
        key, before = f"{path}.needles.{name}_N", getattr(now, name)
        if name == "capacity" and drive.duty.life is None:
            continue
        free = {key: getattr(start, name)}
        found = solved(base, "needles", path, free, {key: before}, series, rows, need=(judge,), only=(judge,))
        base = found.drive
        parts.append(found)
    last = parts[-1]
    return replace(
        last,
        exact={name: value for one in parts for name, value in one.exact.items()},
        values={name: value for one in parts for name, value in one.values.items()},
        before={name: value for one in parts for name, value in one.before.items()},
        limits=tuple(v for one in parts for v in one.limits),
        made=tuple(v for one in parts for v in one.made),
        skipped=tuple(path for one in parts for path in one.skipped)
        + (("duty.life",) if drive.duty.life is None else ()),
    )


def _mm(value: float | None) -> float | None:
    return None if value is None else 1e3 * value


__all__ = ["HOLDS", "PARTS", "Hold", "Sizing", "Tried", "size"]


# The smallest row of the catalogue at which a joint's checks pass.

LIVES = ("bearing_life", "rated_torque")
"""Checks that judge the running time asked of a joint; a size that none of them can judge is not taken."""

CARRIES = ("joint_torque", "rated_torque", "journal_strength", "yoke_strength")
"""Checks that judge the torque that a joint carries; a size that none of them can judge is not taken either."""


def smallest_row(drive: Drive, number: int, rows: Catalogue) -> Sizing:
    """Return the smallest row of the catalogue that passes, for one joint or for all alike."""
    if number:
        refuse_other(drive, number)
    chosen = [number - 1] if number else [i for i, joint in enumerate(drive.joints) if not joint.refusal("sizing")]
    if not chosen:
        raise refuse("part", _("no joint of the drive is a cross joint, and rows of the catalogue are of such"))
    subjects = [f"joints[{i}]" for i in chosen]
    sizes = rows.offered(next((drive.joints[i].size for i in chosen if drive.joints[i].size), ""))
    if not sizes:
        raise refuse("catalogue", _("holds no sizes of joints"), "empty")
    if not design(drive, known=rows).loaded:
        raise refuse("duty.torque", _("missing; the size depends on it"), "missing")
    asked_life = drive.duty.life is not None
    tried: list[Tried] = []
    best: tuple[Drive, tuple[Verdict, ...], JointSize] | None = None
    for row in sizes:
        whole = drive
        for i in chosen:
            whole = with_joint(whole, i, size=row.id, type="", cross=None, needles=None, yoke=None, rating=None)
        whole = completed(whole, rows)
        every = [one for one in as_tried(whole, CHECKS["joint"], known=rows) if one.subject in subjects]
        judged = tuple(one for one in every if one.run and not one.advice)
        worst = foremost_of(judged, used) if judged else None
        names = {one.check for one in judged}
        if row.rating is None or row.rating.max_torque is None:
            names.discard("joint_torque")  # it was judged by what is usual for its type
        unknown = "torque" if names.isdisjoint(CARRIES) else "life" if asked_life and names.isdisjoint(LIVES) else ""
        passed = worst is not None and used(worst) <= 1.0 and not unknown
        tried.append(
            Tried(
                id=row.id,
                outer=math.nan if row.rating is None or row.rating.outer is None else row.rating.outer,
                mass=math.nan if row.mass is None else row.mass,
                utilisation=math.nan if worst is None else used(worst),
                passed=passed,
                unknown=unknown,
                worst=worst,
                missing=tuple(dict.fromkeys(path for one in every for path in one.missing)),
            )
        )
        if passed and best is None:
            best = whole, judged, row
    subject = subjects[0] if number else ""
    before = {f"{one}.size": drive.joints[i].size or None for one, i in zip(subjects, chosen, strict=True)}
    if best is None:
        return Sizing(
            part="joint",
            subject=subject,
            exact={},
            values={},
            before=before,
            limits=(),
            made=(),
            drive=drive,
            tried=tuple(tried),
        )
    whole, judged, row = best
    at = next(one for one in tried if one.id == row.id)
    return Sizing(
        part="joint",
        subject=subject,
        exact={},
        values={f"{one}.size": row.id for one in subjects},
        before=before,
        limits=judged,
        made=judged,
        drive=whole,
        tried=tuple(tried),
        skipped=at.missing,
    )


def refuse_other(drive: Drive, number: int) -> None:
    """Refuse a joint that is no cross joint: its parts are not sized."""
    joint = drive.joints[number - 1]
    if joint.refusal("sizing"):
        text = _("joint {number} is of kind {kind}; only cross joints are sized")
        raise refuse("part", text.format(number=number, kind=joint.kind), "out_of_range")


def with_joint(drive: Drive, i: int, **changes: object) -> Drive:
    """Return a drive with some fields of a joint, counted from 0, changed."""
    joints = list(drive.joints)
    joints[i] = replace(joints[i], **changes)  # type: ignore[arg-type]
    return replace(drive, joints=tuple(joints))
