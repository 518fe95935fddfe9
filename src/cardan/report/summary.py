"""Page 1: is this drive good, and what should be changed?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.analysis.equivalence import SPECK, WARN_BEND
from cardan.checks.checks import check
from cardan.checks.design import Design
from cardan.checks.moving import WORSE, posed
from cardan.checks.verdict import AMBER, Verdict
from cardan.errors import InputError
from cardan.figures.kinds import too_steep
from cardan.figures.wording import excess, fixed, half_turn, percent, significant
from cardan.maths.arrays import Array
from cardan.synthesis.setting import YokeSetting
from cardan.texts import _, plural
from cardan.units import deg, mm, rpm

from .block import Cell, Column, Page, Table, Tone, Words, key, number, verdict_columns, words
from .subject import Subject

ILL = 80.0
"""Bend [°] above which rounding grows so much that the last digits mean nothing."""

CALM = 1e-3
"""Irregularity below which a drive is called nearly even: some tenth of what one joint of 5° does."""

UTMOST = 1e-9
"""Changes of the irregularity smaller than this help nobody."""


SAME = 1e-6
"""Yokes that differ by less than this [rad] are one and the same setting."""


def judgement(on: Subject, pages: Sequence[Page] = ()) -> Words:
    """Return the one sentence the reader came for: whether the drive keeps its limits, else how evenly it turns.

    It is red where a limit or a part of the report fails, amber where a limit is nearly used up or what follows asks
    for attention, and then says so; rules of thumb colour nothing.

    Parameters
    ----------
    on : Subject
        The drive.
    pages : sequence of Page
        Parts of the report; one that failed is not hidden behind an even motion.
    """
    turns, alarms = evenness(on), {alarm.tone for page in pages for alarm in page.alarms}
    limits = _limits(pages)
    failed = turns.tone == "failed" or "failed" in alarms
    if limits is None:
        tone: Tone = "failed" if failed else "warning" if "warning" in alarms and turns.tone == "good" else turns.tone
        return Words(text=turns.text, tone=tone)
    said = _("{name}: {answer}").format(
        name=on.drive.name or _("The drive"), answer=limits.answer[:1].lower() + limits.answer[1:]
    )
    if failed and not limits.alarms:
        said += " " + _("But what follows fails.")
    elif "warning" in alarms and not failed:
        said += " " + _("But what follows asks for attention.")
    return Words(text=said, tone="failed" if failed else "warning" if "warning" in alarms or _close(limits) else "good")


def _close(limits: Page) -> bool:
    """Tell whether a limit that must be kept is nearly used up: the first table of the page has them."""
    table = next((one for one in limits.blocks if isinstance(one, Table)), None)
    return table is not None and any(cell.tone == "warning" for row in table.rows for cell in row)


def _limits(pages: Sequence[Page]) -> Page | None:
    """Return the page of the limits; None where none could be judged."""
    page = next((one for one in pages if one.name == "limits"), None)
    return None if page is None or any(alarm.tone == "warning" for alarm in page.alarms) else page


def evenness(on: Subject) -> Words:
    """Return a sentence on how evenly the drive turns."""
    name = on.drive.name or _("The drive")
    share = percent(float(on.whole.irregularity))
    best = on.best
    steep = any(too_steep(joint, 1, float(bend)) for joint, bend in zip(on.drive.joints, on.bend, strict=True))
    if on.even:
        tone: Tone = "good"
        text = _("{name} is synchronous as built: the output turns exactly evenly.").format(name=name)
        if on.moving is not None:
            text = _("{name} is synchronous as drawn, standing still.").format(name=name)
    elif on.rounded:
        tone = "good"
        text = _("{name} is synchronous as built but for the rounding of its figures, which leaves {share}.").format(
            name=name, share=share
        )
    elif on.curable and best is not None:
        tone = "warning"
        text = _("{name} is {share} irregular as built; with its yokes set differently it turns exactly evenly.")
        if not on.phasing.feasible:
            text = _(
                "{name} is {share} irregular as built; with its yokes set differently it turns evenly to rounding."
            )
        text = text.format(name=name, share=share)
    elif best is None:
        tone = "warning"
        text = _("{name} has one joint and turns {share} irregularly; one joint alone is never even.")
        if on.mixed:
            text = _("{name} has one joint and turns {share} irregularly.")
        text = text.format(name=name, share=share)
    elif float(on.whole.irregularity) - best.irregularity > UTMOST:
        tone = "warning"
        text = _(
            "{name} is {share} irregular as built; no setting of the yokes makes it even, the best one leaves {least}."
        ).format(name=name, share=share, least=percent(best.irregularity))
    else:
        tone = "warning"
        text = _("{name} is {share} irregular, and no setting of the yokes makes it any better.").format(
            name=name, share=share
        )
    if float(on.whole.irregularity) < CALM:
        tone = "good"
    swings = _while_moving(on)
    if swings > UTMOST:
        tone = "warning" if tone == "good" and swings > CALM else tone
        text += " " + _("While it moves, the output is up to {share} irregular.").format(share=percent(swings))
    if on.moving is not None and any(one.flags for one in on.moving.splines):
        text += " " + _("A spline does not follow the movement.")
        tone = "failed"
    return Words(text=text, tone="failed" if steep else tone)


def _while_moving(on: Subject) -> float:
    """Return the largest irregularity over the movement, the movement counted where a speed is known."""
    found = {one.what: one.value for one in on.moving.worst} if on.moving else {}
    return float(found.get("moving_irregularity", found.get("irregularity", 0.0)))


def warnings(on: Subject, pages: Sequence[Page] = ()) -> Iterator[Words]:
    """Yield what the reader must not overlook.

    Parameters
    ----------
    on : Subject
        The drive.
    pages : sequence of Page
        Parts of the report that may have such of their own.
    """
    limits = _limits(pages)
    yield from (alarm for page in pages if page is not limits for alarm in page.alarms)
    if limits is not None:
        yield evenness(on)
    for k, (joint, bend) in enumerate(zip(on.drive.joints, on.bend / deg, strict=True), start=1):
        if joint.kind != "hooke":
            text = too_steep(joint, k, bend * deg)
            yield from [Words(text=text, tone="failed")] if text else []
        elif bend > ILL:
            yield Words(
                text=_(
                    "Joint {k} bends {bend}°: the motion is so steep that rounding costs digits; see the residuals in "
                    "the last part."
                ).format(k=k, bend=fixed(bend, 1)),
                tone="failed",
            )
        elif bend > WARN_BEND:
            yield Words(
                text=_("Joint {k} bends {bend}°; no real cross joint works above {limit:g}°.").format(
                    k=k, bend=fixed(bend, 1), limit=WARN_BEND
                ),
                tone="failed",
            )
    uneven = min(float(on.whole.irregularity), on.phasing.irregularity_min) > SPECK
    if on.joints > 1 and uneven and not on.phasing.feasible and on.phasing.limiting_joint is not None:
        why = _("Joints tied by held yokes act as one that is too uneven for the others.")
        if len(on.phasing.limiting_joints) == 1:
            limiting = on.phasing.limiting_joint - 1
            why = excess(on.phasing, on.joints, float(on.bend[limiting]), on.drive.joints[limiting].kind)
        yield Words(text=_("It cannot be made synchronous. {why}").format(why=why), tone="warning")
    if on.phasing.spline_refusal:
        yield Words(text=on.phasing.spline_refusal, tone="warning")
    if on.moving is not None:
        failed = {flag.message for one in on.moving.splines for flag in one.flags}
        yield from (Words(text=text, tone="failed" if text in failed else "warning") for text in on.moving.warnings)
    if not on.complete:
        yield Words(text=_("Stopped by the reader: what was not calculated by then is left out."), tone="warning")
    if not all(check.passed for check in on.checks):
        yield Words(text=_("A self-check failed; see the last part."), tone="failed")


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
        worst, name = float(np.max(share)), on.phasing.poses[int(np.argmax(share))]
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
            for pose, bends in poses:
                if bends[k - 1] > most * WORSE:
                    most, note = float(bends[k - 1]), _("in the pose {name}").format(name=pose)
            found.append((most / kind.steepest, k, most, kind.steepest, note))
        elif not isinstance(one.limit, tuple):
            found.append((float(one.utilisation), k, float(one.value), float(one.limit), one.note))
    use, joint, bend, limit, note = max(found, key=lambda one: (round(one[0], 9), -one[1]))
    name = _("largest bend, joint {k}")
    if note == _("while the drive moves"):
        name, note = _("largest bend while moving, joint {k}"), ""
    title = ", ".join(part for part in (name.format(k=joint), note) if part)
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


def _posed_bends(on: Subject) -> list[tuple[str, Array]]:
    """Return the name of every pose and the largest bend of each joint in it, moving too, array (n) [rad]."""
    if not on.drive.poses:
        return []
    each = posed(Design(drive=on.drive, duty=on.drive.duty))
    return [(name, np.maximum(one.bend, one.moving_bend) if one.drive.movements else one.bend) for name, one in each]


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
        return key(_("largest acceleration of the output over ω₁²"), 0.0 if even else relative, "–", words(""))
    value = 0.0 if even else relative * speed**2
    name = _("largest acceleration of the output at {speed} rpm").format(speed=significant(abs(speed) / rpm))
    return key(name, value, "rad/s²", words(""))


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
        path = f"shafts[{spline.shaft - 1}].spline"
        if spline.engaged_min is not None:
            name = _("shortest engaged length of the spline of shaft {k}").format(k=spline.shaft)
            worst = posed.get(f"{path}.engaged")
            left = spline.engaged_min if worst is None else float(worst.value)
            yield _travel(name, left, overlap, failed="engaged" in failed or (worst is not None and not worst.passed))
        if spline.gap_min is not None:
            name = _("least way left to bottoming of shaft {k}").format(k=spline.shaft)
            worst = posed.get(f"{path}.gap")
            left = spline.gap_min if worst is None else float(worst.value)
            yield _travel(name, left, None, failed="gap" in failed or (worst is not None and not worst.passed))


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


def changes(on: Subject) -> Table | Words:
    """Return the changes that help most, with their effect, at most three."""
    drawn = _("This concerns the drive as drawn, standing still.") if on.drive.movements else ""
    if on.even or on.rounded:
        if _while_moving(on) > max(UTMOST, 2.0 * float(on.whole.irregularity)):
            return Words(
                text=_("The yokes stand right; what is left comes from bends that differ while the drive moves.")
            )
        return Words(text=_("Nothing needs to be changed for an even output."))
    now = float(on.whole.irregularity)
    found = sorted((after, text) for text, after in _changes(on) if now - after > max(UTMOST, 0.01 * now))
    rows = [_change(text, now, after) for after, text in found[:3]]
    if not rows:
        if on.joints == 1 and on.mixed:
            return Words(text=_("Nothing but other sizes or another bend of the joint helps."))
        if on.joints == 1:
            return Words(
                text=_("Add a second joint of the same bend, its yokes set to undo the first: then the output is even.")
            )
        return Words(text=f"{_('No change of the yokes helps; only other bends do.')} {drawn}".strip())
    return Table(
        columns=(
            Column(heading=_("change"), left=True),
            Column(heading=_("irregularity now"), unit="%"),
            Column(heading=_("afterwards"), unit="%"),
        ),
        rows=rows,
        title=_("Changes that make the output more even"),
        note=drawn,
    )


def _changes(on: Subject) -> Iterator[tuple[str, float]]:
    """Yield changes and the irregularity each would leave."""
    told: list[YokeSetting] = []

    def new(one: YokeSetting) -> bool:
        fresh = all(np.max(np.abs(np.sin(one.yoke_angle - other.yoke_angle))) > SAME for other in told)
        told.append(one)
        return bool(fresh)

    for one in (*on.phasing.settings[:1], *on.phasing.spline_settings[:1]):
        if new(one):
            yield _set_to(one, one.label, on), one.irregularity
    for k, one in on.alone[:2]:
        if not new(one):
            continue
        angle = fixed(half_turn(float(one.yoke_angle[k - 2]) / deg))
        yield _("turn only the yokes of shaft {k}: to {angle}°").format(k=k, angle=angle), one.irregularity
    plain = on.drive.joints[on.closing.longest - 1].kind == "hooke"
    if on.joints > 1 and plain and not on.phasing.feasible and not on.phasing.fixed:
        bend = fixed(on.closing.bend_allowed / deg)
        now = fixed(float(on.bend[on.closing.longest - 1]) / deg)
        text = _("bend joint {k} by {bend}° instead of {now}° and set the yokes anew")
        if bend != now:
            yield text.format(k=on.closing.longest, bend=bend, now=now), 0.0


def _set_to(one: YokeSetting, label: str, on: Subject) -> str:
    moved = [k for k, change in enumerate(one.change, start=2) if abs(float(change)) > 1e-6]
    angles = ", ".join(f"{fixed(float(one.yoke_angle[k - 2]) / deg)}°" for k in moved[:6])
    if len(moved) > 6:
        return _("set the yokes of {count} shafts as in setting {label}").format(count=len(moved), label=label)
    numbers = ", ".join(map(str, moved))
    return plural(
        "setting {label}: yokes of shaft {numbers} to {angles}",
        "setting {label}: yokes of shafts {numbers} to {angles}",
        len(moved),
    ).format(label=label, numbers=numbers, angles=angles)


def _change(text: str, before: float, after: float) -> list[Cell]:
    tone: Tone = "good" if after < UTMOST else "plain"
    return [
        words(text),
        number(percent(before).removesuffix(" %"), 100.0 * before),
        number(percent(after).removesuffix(" %"), 100.0 * after, tone),
    ]
