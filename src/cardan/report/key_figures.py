"""The key figures on page 1, by which drives are compared."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.checks.checks import check
from cardan.checks.design import Design
from cardan.checks.moving import WORSE, posed
from cardan.checks.verdict import AMBER, Verdict
from cardan.errors import InputError
from cardan.figures.wording import fixed, percent, significant
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.texts import _
from cardan.units import deg, mm, rpm

from .block import Cell, Page, Table, Tone, key, number, verdict_columns, words
from .subject import Subject

CALM = 1e-3
"""Irregularity below which a drive is called nearly even: some tenth of what one joint of 5° does."""

UTMOST = 1e-9
"""Changes of the irregularity smaller than this help nobody."""


def key_figures(on: Subject, pages: Sequence[Page] = ()) -> Table:
    """Return the figures a reader compares drives by, with their limits where there are any.

    Parameters
    ----------
    on : Subject
        The drive.
    pages : sequence of Page
        Parts of the report whose own key figures stand below.
    """
    share = float(on.whole.irregularity)
    rows = [
        key(_("irregularity δ of the output"), 100.0 * share, "%", _evenness(on), percent(share, 4).removesuffix(" %")),
        *_uneven_pose(on),
        _unless_even(on, _("the same as one joint bent by"), float(on.whole.bend) / deg),
        _unless_even(on, _("output ahead and back of its mean by"), float(on.whole.max_lead) / deg),
        _acceleration(on),
        _bend(on),
    ]
    if on.moving is not None:
        rows += list(_moving(on))
    rows += [list(row) for page in pages for row in page.keys]
    return Table(columns=verdict_columns(), rows=rows)


def _uneven_pose(on: Subject) -> Iterator[list[Cell]]:
    """Yield the irregularity in the worst pose, where it is worse than as drawn."""
    share = on.phasing.as_built.pose_irregularity
    if share.size and float(np.max(share)) > float(on.whole.irregularity) + UTMOST:
        worst, name = float(np.max(share)), on.phasing.poses[int(foremost(share))]
        title = _("irregularity δ of the output, in the pose {name}").format(name=name)
        yield key(title, 100.0 * worst, "%", words(""), percent(worst, 4).removesuffix(" %"))


def _unless_even(on: Subject, name: str, angle: float) -> list[Cell]:
    """Return the row of an angle [°] that is nothing but rounding where the drive is even."""
    return key(name, angle, "°", words(""), "0" if on.even else significant(angle))


def _bend(on: Subject) -> list[Cell]:
    """Return the bend that comes nearest to its limit: the one of the page on limits, else the utmost of its kind."""
    allowed = {one.subject: one for one in _bends(on) if one.run}
    moving = {one.number: one.value for one in on.moving.worst if one.what == "bend"} if on.moving else {}
    poses = [] if len(allowed) == on.joints else _posed_bends(on)
    found = []
    for k, (kind, drawn) in enumerate(zip(on.drive.joints, on.bend, strict=True), start=1):
        one = allowed.get(f"joints[{k - 1}]")
        if one is None:
            most = max(float(drawn), moving.get(k, 0.0))
            note = _("while the drive moves") if most > drawn else ""
            for pose, stands, reaches in poses:
                bend = max(stands[k - 1], reaches[k - 1])
                if bend > most * WORSE:
                    most, note = float(bend), _("in the pose {name}").format(name=pose)
                    note = f"{_('while the drive moves')}; {note}" if bend > stands[k - 1] * WORSE else note
            found.append((most / kind.steepest, k, most, kind.steepest, note))
        elif not isinstance(one.limit, tuple):
            found.append((float(one.utilisation), k, float(one.value), float(one.limit), one.note))
    use, joint, bend, limit, note = max(found, key=lambda one: (round(one[0], 9), -one[1]))
    moves, place = _parted(note)
    name = _("largest bend while moving, joint {k}") if moves else _("largest bend, joint {k}")
    title = ", ".join((name.format(k=joint), *place))
    if f"joints[{joint - 1}]" not in allowed and use < AMBER:
        return key(title, bend / deg, "°", words(""))
    tone: Tone = "failed" if use > 1.0 else "warning" if use >= AMBER else "good"
    verdict = {"failed": _("too much"), "warning": _("near the limit"), "good": _("passed")}[tone]
    return [
        words(title),
        number(significant(bend / deg), bend / deg),
        words("°"),
        number(f"≤ {round(limit / deg, 6):g}", limit / deg),
        number(fixed(use, 2), use),
        words(verdict, tone),
    ]


def _parted(note: str) -> tuple[bool, list[str]]:
    """Return whether a note says that the drive moves, and what else it says."""
    said = [part for part in note.split("; ") if part]
    moves = _("while the drive moves")
    return moves in said, [part for part in said if part != moves]


def _posed_bends(on: Subject) -> list[tuple[str, Array, Array]]:
    """Return the name of every pose, the bend of each joint in it and the largest while it moves, arrays (n) [rad]."""
    if not on.drive.poses:
        return []
    each = posed(Design(drive=on.drive, duty=on.drive.duty))
    return [(name, one.bend, one.moving_bend if one.drive.movements else one.bend) for name, one in each]


def _bends(on: Subject) -> tuple[Verdict, ...]:
    """Return the verdicts on the bends of the joints; none where the drive cannot be judged."""
    try:
        return check(on.drive, only=["bend"], known=on.known)
    except InputError:
        return ()


def _acceleration(on: Subject) -> list[Cell]:
    relative = float(on.whole.max_acceleration)
    speed = on.drive.duty.speed
    even = on.even
    if speed is None:
        name, value = _("largest acceleration of the output over ω₁²"), 0.0 if even else relative
        return key(name, value, "–", words(""), "0" if even else significant(value))
    value = 0.0 if even else relative * speed**2
    name = _("largest acceleration of the output at {speed} rpm").format(speed=significant(abs(speed) / rpm))
    return key(name, value, "rad/s²", words(""), "0" if even else significant(value))


def _evenness(on: Subject) -> Cell:
    if on.even:
        return words(_("exactly even"), "good")
    if on.rounded:
        return words(_("even but for rounding"), "good")
    if float(on.whole.irregularity) < CALM:
        return words(_("nearly even"))
    if on.curable:
        return words(_("can be made even"), "warning")
    return words(_("cannot be even"), "warning")


def _moving(on: Subject) -> Iterator[list[Cell]]:
    assert on.moving is not None
    for one in on.moving.worst:
        if one.what in ("irregularity", "moving_irregularity"):
            name = {
                "irregularity": _("largest irregularity if it stopped on its way, at {time} s"),
                "moving_irregularity": _("largest irregularity while moving, at {time} s"),
            }[one.what].format(time=significant(one.time, 3))
            yield key(name, 100.0 * one.value, "%", words(""), percent(one.value).removesuffix(" %"))
    overlap, posed = on.drive.limits.spline_overlap, _worst_of_poses(on)
    for spline in on.moving.splines:
        failed = {flag.field.rpartition(".")[2] for flag in spline.flags}
        engaged = _("shortest engaged length of the spline of shaft {k}")
        gap = _("least way left to bottoming of shaft {k}")
        for field, title, left, limit in (
            ("engaged", engaged, spline.engaged_min, overlap),
            ("gap", gap, spline.gap_min, None),
        ):
            if left is None:
                continue
            name, bad = title.format(k=spline.shaft), field in failed
            worst = posed.get(f"shafts[{spline.shaft - 1}].spline.{field}")
            if worst is not None:
                name, left = ", ".join((name, *_parted(worst.note)[1])), float(worst.value)
                bad = bad or not worst.passed
            yield _travel(name, left, limit, failed=bad)


def _worst_of_poses(on: Subject) -> dict[str, Verdict]:
    """Return the verdicts on splines by their lever, where the drive has poses that may be worse than as drawn."""
    found = check(on.drive, only=["spline_overlap"], known=on.known) if on.drive.poses else ()
    return {one.levers[0]: one for one in found if one.run}


def _travel(name: str, value: float, limit: float | None, *, failed: bool) -> list[Cell]:
    use = limit / value if limit is not None and value > 0.0 else None
    tone: Tone = "failed" if failed else "warning" if use is not None and use >= 0.9 else "good"
    verdict = {"failed": _("too little"), "warning": _("near the limit"), "good": _("passed")}[tone]
    return [
        words(name),
        number(fixed(value / mm, 1), value / mm),
        words(_("mm")),
        words("–") if limit is None else number(f"≥ {limit / mm:g}", limit / mm),
        words("–") if use is None else number(fixed(use, 2), use),
        words(verdict, tone),
    ]
