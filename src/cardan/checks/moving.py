"""What the movements of a drive, its poses, starts and other events make of its parts."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.drive.conditions import in_poses
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import bare_path
from cardan.drive.models.geometry import in_form
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import tops
from cardan.questions.motion.moving_points import default_times
from cardan.questions.motion.standing import still, worst_instants
from cardan.questions.torsion.road.answer import lacking
from cardan.questions.torsion.road.road import standing_torques
from cardan.texts import _

from .design import Design
from .event_loads import event_name
from .movement_loads import FEW, INSTANTS, moving_rows
from .verdict import Verdict, joined

WORSE = 1.0 + 1e-9
"""A pose is worse than another from here on; less is rounding."""

NOISE = 1e-12
"""Share of a limit that comes from rounding alone."""


def largest_joint_angle(design: Design, i: int) -> tuple[Array | float, Text]:
    """Return the largest angle of a joint while the drive moves, counted from 0 (...) [rad], and when; 0 where not."""
    if not design.drive.movements:
        return 0.0, ""
    moved = design.moving_joint_angle
    return moved.most[..., i], moved.when(i)


def at_its_most(design: Design, ask: Callable[[Array], Array]) -> tuple[Array, Text]:
    """Return the largest answers on the joint angles, as drawn and moving (..., k), and a word where it moves.

    design: of Hooke joints; ask: from bends (..., n) [rad] to answers (..., k).
    """
    drawn = ask(design.joint_angle)
    moved = design.while_moving(lambda chain: ask(chain.joint_angle))
    if moved is None:
        return drawn, ""
    return np.maximum(drawn, moved.most), moved.when() if np.all(moved.most > drawn * WORSE) else ""


def posed(design: Design) -> list[tuple[str, Design]]:
    """Return the name of every pose of a drive and the design in it; what the pose sets does not vary there."""
    found = []
    stands = in_poses(design.drive)[1:] if design.drive.poses else ()
    for pose, stand in zip(design.drive.poses, stands, strict=True):
        own = [bare_path(design.drive, path) for path, _value in pose.set]
        varied = {
            path: values
            for path, values in design.varied.items()
            if not any(path == one or path.startswith((f"{one}[", f"{one}.")) for one in own)
        }
        one = stand.drive
        found.append(
            (stand.pose, replace(design, drive=one, duty=one.duty, varied=varied, drawn=design, pose=stand.pose))
        )
    return found


def stood(design: Design) -> list[tuple[Text, Design]]:
    """Return the design in every pose, and which that is."""
    return [(_("in the pose {name}").format(name=name), one) for name, one in posed(design)]


def happening(design: Design) -> list[tuple[Text, Design]]:
    """Return the design in every start and event that can be followed in time, as drawn, and which that is."""
    if design.drawn is not None or not (design.loaded and has_torsion(design.drive)):
        return []
    every = [(event_name(event), replace(design, event=k)) for k, event, _count in design.events]
    text = _("largest in time: {event}")
    return [(text.format(event=name), one) for name, one in every if one.cases[0].vibration is not None]


def stopped(
    design: Design, judge: Callable[[Design], Sequence[Verdict]], *, slides: bool = False
) -> Iterator[tuple[Text, Sequence[Verdict], float | None]]:
    """Yield the verdicts on a design, as drawn and in every pose, where its movements make them worst, and when [s].

    judge: by what the joint angles, planes and lengths of an instant decide.
    slides: at the instants, too, at which a shaft is longest or shortest, where the modes of a line may change places.
    Of one drive at the instants at which a verdict uses most of its limit, found over the whole movement; of many that
    of each of them, without when.
    """
    for pose, one in (("", design), *stood(design)):
        if one.varied and one.drive.movements:
            yield Joined([pose, _("while the drive moves")]), _worst_of_instants(one, judge), None
        else:
            for time, here in _stops(one, judge, slides=slides):
                yield Joined([pose, _at(time)]), judge(here), time


def stops(design: Design, judge: Callable[[Design], Sequence[Verdict]]) -> Iterator[tuple[Text, Design]]:
    """Yield the instants at which `stopped` looks at one drive, and the design that stands still there."""
    for pose, one in (("", design), *stood(design)):
        yield from ((Joined([pose, _at(time)]), here) for time, here in _stops(one, judge, slides=False))


def instant(design: Design, time: float) -> list[Design]:
    """Return one drive as drawn and in every pose as it stands at an instant of its movements [s]."""
    return [_still(one, time) for one in (design, *(one for _said, one in stood(design))) if one.drive.movements]


def _at(time: float) -> Text:
    """Return when a moving drive is looked at."""
    return say(_("while the drive moves, at {time}"), time=Quantity(time, "time", 3, trim=True))


def _still(design: Design, time: float) -> Design:
    """Return a design that stands as it does at an instant [s]."""
    here = still(design.drive, time)
    return replace(design, drive=here, duty=here.duty, drawn=design.drawn or design)


def _stops(
    design: Design, judge: Callable[[Design], Sequence[Verdict]], *, slides: bool
) -> Iterator[tuple[float, Design]]:
    """Yield the instants [s] of the movements of one drive at which verdicts use most of their limits, as `stops`."""
    if not design.drive.movements:
        return
    for time in worst_instants(design.drive, _course(design, judge, slides=slides), rounds=1):
        yield time, _still(design, time)


def _course(design: Design, judge: Callable[[Design], Sequence[Verdict]], *, slides: bool) -> Callable[[Array], Array]:
    """Return how much of their limits verdicts use: from instants (t,) [s], all of the movement first, to (v, t).

    Beside them the torques of torsional vibration where it stands so, which the verdicts of all instants know but as
    drawn.
    """
    rows: list[tuple[str, str]] = []
    vibrates = not slides and not lacking(design.drive)

    def used(times: Array) -> Array:
        here = along(design, times)
        found = {(one.check, one.title): one.utilisation for one in judge(here) if one.run}
        rows[:] = rows or list(found)
        none = np.full(times.shape, -np.inf)
        ends = [np.asarray(here.length(k), dtype=float) for k in range(1, design.joints)] if slides else []
        each = (found.get(row, none) for row in rows)
        swung = _swung(design.drive, times) if vibrates else []
        table: Array = np.stack(np.broadcast_arrays(none, *each, *ends, *(-one for one in ends), *swung))[1:]
        return table

    return used


def _swung(drive: Drive, times: Array) -> Array:
    """Return the torques of torsional vibration at instants; none where it is not answered for a kind of joint."""
    try:
        return standing_torques(drive, times)
    except InputError:
        return np.zeros((0, times.size))


def _worst_of_instants(design: Design, judge: Callable[[Design], Sequence[Verdict]]) -> list[Verdict]:
    """Return the verdicts on many drives (...), each at the instant at which it is worst, beside it by a parabola."""
    times = default_times(design.drive.movements)
    if math.prod(design.shape) > FEW:
        times = times[:: -(-times.size // INSTANTS)]
    found = []
    for one in judge(along(design, times)):
        if not one.run:
            found.append(one)
            continue
        every = np.empty((*design.shape, times.size))  # a verdict may be one for all drives and instants
        used, value, _every = np.broadcast_arrays(one.utilisation, one.value, every)
        k = np.argmax(used, axis=-1)[..., None]
        most, worst = (np.take_along_axis(table, k, axis=-1)[..., 0] for table in (used, value))
        if one.sense in ("at_most", "at_least"):
            with np.errstate(invalid="ignore", divide="ignore"):
                more = np.where(np.isfinite(most) & (most > 0.0), np.max(tops(used), axis=-1) / most, 1.0)
            worst = worst * more if one.sense == "at_most" else worst / more
        ends = one.limit if isinstance(one.limit, tuple) else (one.limit,)
        limits = [np.take_along_axis(np.broadcast_to(end, used.shape), k, axis=-1)[..., 0] for end in ends]
        found.append(replace(one, value=worst, limit=(limits[0], limits[1]) if len(limits) > 1 else limits[0]))
    return found


def along(design: Design, times: Array) -> Design:
    """Return a design at instants of its movements: drives (..., t) that stand so.

    times (t,) [s].
    Where a joint bends 90° or more, the drive as drawn stands in.
    """
    return at_points(design, moving_rows(design.points, design.drive.movements, times))


def at_points(design: Design, points: Array) -> Design:
    """Return a design with its points elsewhere (..., t, n+2, 3) [m]: drives (..., t) that stand so."""
    bare = in_form(replace(design.drive, movements=()), "points")
    shape = (*design.shape, points.shape[-3])
    varied = {
        path: np.broadcast_to(values, design.shape)[..., None]
        for path, values in design.varied.items()
        if path not in design.replaced or path.endswith((".yoke_angle", ".start_phase"))
    }
    rows = ["input.point", *(f"joints[{i}].centre" for i in range(design.joints)), "output.point"]
    for k, row in enumerate(rows):
        varied |= {f"{row}[{axis}]": np.broadcast_to(points[..., k, axis], shape) for axis in range(3)}
    return replace(design, drive=bare, duty=bare.duty, varied=varied, drawn=design.drawn or design)


def stands(design: Design) -> list[tuple[float, Design]]:
    """Return the share of the time of every pose with the design in it; each counts wholly where no share is known."""
    if not design.drive.poses:
        return [(1.0, design)]
    shares = [one.share for one in in_poses(design.drive)]
    every = [design, *(one for _name, one in posed(design))]
    return [(1.0 if share is None else share, one) for share, one in zip(shares, every, strict=True)]


def worst_of_poses(drawn: Sequence[Verdict], poses: Sequence[tuple[Text, Sequence[Verdict]]]) -> tuple[Verdict, ...]:
    """Return for each verdict the worst of the drive as drawn and in its poses, with a word on which pose it is.

    drawn: of the drive as drawn, or of many.
    poses, sequence of (Text, sequence of Verdict): which pose or instant it is, and the verdicts there; one that is
    reached only there counts too. Where one of them does not fit, what does not fail is not judged.
    """
    known = [(one.check, one.title) for one in drawn]
    there = {(one.check, one.title): one for _said, verdicts in poses[::-1] for one in verdicts if one.run}
    found: list[Verdict] = []
    for one in (*drawn, *(one for row, one in there.items() if row not in known)):
        worst = one if len(found) < len(known) else None
        for said, verdicts in poses:
            other = next((its for its in verdicts if (its.check, its.title) == (one.check, one.title)), None)
            if other is None or other.missing:
                continue
            if worst is None or not (worst.run and other.run):
                worst = _foremost(worst, other, said)
            else:
                worst = _worse(worst, other, said)
        assert worst is not None
        found.append(worst)
    return tuple(found)


def _foremost(worst: Verdict | None, other: Verdict, said: Text) -> Verdict:
    """Return of two verdicts that were not both run the one that tells more: what fails, then what does not fit."""
    fails = worst is not None and worst.run and not np.all(worst.passed)
    if worst is not None and not worst.missing and (fails or (worst.unfit and (other.unfit or np.all(other.passed)))):
        return worst
    return replace(other, note=joined(other.note, said))


def _worse(worst: Verdict, other: Verdict, said: Text) -> Verdict:
    """Return the worse of two verdicts, of many drives place by place; the other one with a word on its pose."""
    worse = np.asarray(other.utilisation > np.asarray(worst.utilisation) * WORSE + NOISE)
    if not np.any(worse):
        return worst
    if np.all(worse):
        return replace(other, note=joined(other.note, said))
    limit: Any = np.where(worse, other.limit, worst.limit)
    if isinstance(other.limit, tuple) and isinstance(worst.limit, tuple):
        limit = tuple(np.where(worse, *ends) for ends in zip(other.limit, worst.limit, strict=True))
    return replace(worst, value=np.where(worse, other.value, worst.value), limit=limit)
