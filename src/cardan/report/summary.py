"""Page 1: is this drive good, and what should be changed?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.figures.wording import excess, fixed, half_turn, percent
from cardan.questions.motion.equivalence import WARN_BEND
from cardan.questions.motion.kinds import too_steep
from cardan.questions.phases.setting import YokeSetting
from cardan.texts import _, plural
from cardan.units import deg

from .block import Cell, Column, Page, Table, Tone, Words, number, words
from .key_figures import CALM, UTMOST
from .subject import Subject

ILL = 80.0
"""Bend [°] above which rounding grows so much that the last digits mean nothing."""

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
    posed, pose = _in_poses(on)
    if on.even:
        tone: Tone = "good"
        text = _("{name} is synchronous as built: the output turns exactly evenly.").format(name=name)
        if on.moving is not None:
            text = _("{name} is synchronous as drawn, standing still.").format(name=name)
        elif posed > UTMOST:
            text = _("{name} is synchronous as drawn.").format(name=name)
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
    limit = on.drive.limits.irregularity
    if float(on.whole.irregularity) < (CALM if limit is None else min(CALM, limit)):
        tone = "good"
    swings = _while_moving(on)
    if swings > UTMOST:
        tone = "warning" if tone == "good" and swings > CALM else tone
        text += " " + _("While it moves, the output is up to {share} irregular.").format(share=percent(swings))
    if posed > max(swings, float(on.whole.irregularity)) + UTMOST:
        tone = "warning" if tone == "good" and posed > CALM else tone
        text += " " + _("In the pose {name}, the output is {share} irregular.").format(name=pose, share=percent(posed))
    if on.moving is not None and any(one.flags for one in on.moving.splines):
        text += " " + _("A spline does not follow the movement.")
        tone = "failed"
    return Words(text=text, tone="failed" if steep else tone)


def _while_moving(on: Subject) -> float:
    """Return the largest irregularity over the movement, the movement counted where a speed is known."""
    found = {one.what: one.value for one in on.moving.worst} if on.moving else {}
    return float(found.get("moving_irregularity", found.get("irregularity", 0.0)))


def _in_poses(on: Subject) -> tuple[float, str]:
    """Return the irregularity as built in the pose where it is largest, and the name of that; 0 without poses."""
    share = on.phasing.as_built.pose_irregularity
    return (float(np.max(share)), on.phasing.poses[int(np.argmax(share))]) if share.size else (0.0, "")


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
        if not joint.single_cross:
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
    uneven = not on.rounding(min(float(on.whole.irregularity), on.phasing.irregularity_min))
    if on.joints > 1 and uneven and not on.phasing.feasible and on.phasing.limiting_joint is not None:
        why = _("Joints tied by held yokes act as one that is too uneven for the others.")
        if len(on.phasing.limiting_joints) == 1:
            limiting = on.phasing.limiting_joint - 1
            why = excess(
                on.phasing, on.joints, float(on.bend[limiting]), single_cross=on.drive.joints[limiting].single_cross
            )
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


def changes(on: Subject) -> Table | Words:
    """Return the changes that help most, with their effect, at most three."""
    drawn = _("This concerns the drive as drawn, standing still.") if on.drive.movements else ""
    if on.even or on.rounded:
        little, moving, posed = max(UTMOST, 2.0 * float(on.whole.irregularity)), _while_moving(on), _in_poses(on)[0]
        for one in on.phasing.pose_settings[:1]:
            left = float(np.max(one.pose_irregularity))
            if posed > little and posed - left > max(UTMOST, 0.01 * posed):
                text = _("The drive is even as drawn; “{label}” leaves {left} in the worst pose instead of {now}.")
                return Words(text=text.format(label=one.label, left=percent(left), now=percent(posed)))
        if moving > little:
            return Words(
                text=_("The yokes stand right; what is left comes from bends that differ while the drive moves.")
            )
        if posed > little:
            return Words(text=_("The yokes stand right; what is left comes from bends that differ in the poses."))
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
    plain = on.drive.joints[on.closing.longest - 1].single_cross
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
