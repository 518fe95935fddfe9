"""Page 1: is this drive good, and what should be changed?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers import answer
from cardan.answers.answer import Cell, Column
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.answers.reader import half_turn
from cardan.drive.drive import Drive
from cardan.drive.fields.plausibility import doubts
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.accuracy.as_made import made
from cardan.questions.motion.articulation import Worst
from cardan.questions.motion.articulation_answer import rate_counts
from cardan.questions.motion.kinds import steep
from cardan.questions.phases.answer import CALM, UTMOST, excess, steers, wants_fluctuation
from cardan.questions.phases.setting import YokeSetting
from cardan.texts import _, plural
from cardan.units import deg

from .block import Page, Table, Tone, Words, capital, shown, table
from .subject import Subject

ILL = 80.0  # joint angle [°] above which rounding grows so much that the last digits mean nothing
SAME = 1e-6  # yokes that differ by less than this [rad] are one and the same setting


def judgement(on: Subject, pages: Sequence[Page] = ()) -> Words:
    """Return the one sentence the reader came for: whether the drive keeps its limits, else how uniformly it turns.

    It is red where a limit or a part of the report fails, amber where a limit is nearly used up or what follows asks
    for attention, and then says so; rules of thumb colour nothing.
    pages: parts of the report; one that failed is not hidden behind a uniform motion.
    """
    turns, alarms = uniformity(on), {alarm.tone for page in pages for alarm in page.alarms}
    limits = _limits(pages)
    failed = turns.tone == "failed" or "failed" in alarms
    if limits is None:
        tone: Tone = "failed" if failed else "warning" if "warning" in alarms and turns.tone == "good" else turns.tone
        return Words(text=turns.text, tone=tone)
    said = f"{on.drive.name or _('The drive')}: {limits.answer[:1].lower()}{limits.answer[1:]}"
    if failed and not limits.alarms:
        said += " " + _("But what follows fails.")
    elif "warning" in alarms and not failed:
        said += " " + _("See the warnings below.")
    return Words(text=said, tone="failed" if failed else "warning" if "warning" in alarms or _close(limits) else "good")


def _close(limits: Page) -> bool:
    """Tell whether a limit that must be kept is nearly used up: the first table of the page has them."""
    found = next((one for one in limits.blocks if isinstance(one, Table)), None)
    return found is not None and any(cell.tone == "warning" for row in found.rows for cell in row)


def _limits(pages: Sequence[Page]) -> Page | None:
    """Return the page of the checks; None where none could be judged."""
    page = next((one for one in pages if one.name == "check"), None)
    return None if page is None or any(alarm.tone == "warning" for alarm in page.alarms) else page


def uniformity(on: Subject) -> Words:
    """Return a sentence on how uniformly the drive turns; of a steering column on its ratio from lock to lock."""
    for steering in steers(on.drive, on.phasing):
        as_wanted = steering.tone == "good"
        bad = any(steep_joints(on.drive, on.joint_angle))
        said = Joined([steering.text, *_errors_told(on)], between=" ")
        return Words(text=said, tone="failed" if bad else "good" if as_wanted else "warning")
    share = Quantity(on.fluctuation, "share", 3)
    posed, pose = _in_poses(on)
    toothed = _on_teeth(on)
    text, tone = _as_specified(on, posed, toothed)
    parts: list[Text] = [
        say(
            text,
            name=on.drive.name or _("The drive"),
            share=share,
            least=_share(toothed or (on.best.speed_fluctuation if on.best else 0.0)),
        )
    ]
    parts += _errors_told(on)
    limit = on.drive.limits.speed_fluctuation
    if on.fluctuation < (CALM if limit is None else min(CALM, limit)):
        tone = "good"
    swings = _while_moving(on)
    if swings > UTMOST:
        tone = "warning" if tone == "good" and swings > CALM else tone
        parts += _moving_words(on)
    if posed > max(swings, on.fluctuation) + UTMOST:
        tone = "warning" if tone == "good" and posed > CALM else tone
        parts.append(say(_("In the pose {name} the speed fluctuation is {share}."), name=pose, share=_share(posed)))
    flags = [flag.field for one in (on.moving.splines if on.moving is not None else ()) for flag in one.flags]
    if any(".spline." in field for field in flags):
        parts.append(_("A spline does not follow the movement."))
    if any(".plunge_" in field for field in flags):
        parts.append(_("A joint does not plunge as far as the movement asks."))
    tone = "failed" if flags else tone
    return Words(
        text=Joined(parts, between=" "), tone="failed" if any(steep_joints(on.drive, on.joint_angle)) else tone
    )


def _errors_told(on: Subject) -> Iterator[Text]:
    """Yield what the errors of the joints as made leave, where there are any and it can be told."""
    found = made(on.drive) if _errs(on) else ""
    if not isinstance(found, str):
        text = _("With the errors of its joints as made the speed fluctuation is {share}.")
        yield say(text, share=Quantity(found.fluctuation, "share"))


def _errs(on: Subject) -> bool:
    return any(joint.error is not None for joint in on.drive.joints)


def _as_specified(on: Subject, posed: float, toothed: float) -> tuple[str, Tone]:
    """Return what is said of the drive as specified, with its tone."""
    if _errs(on) and (on.even or on.rounded):
        return _("{name} is uniform as specified but for the errors of its joints as made."), "good"
    if on.even:
        if on.moving is not None:
            return _("{name} is uniform as drawn, standing still."), "good"
        if posed > UTMOST:
            return _("{name} is uniform as drawn."), "good"
        return _("{name} is uniform as specified: the output turns at exactly constant speed."), "good"
    if on.rounded:
        return _("{name} is uniform as specified but for the rounding of its figures, which leaves {share}."), "good"
    if on.curable and on.best is not None:
        if _errs(on):
            text = _(
                "{name} has {share} speed fluctuation as specified; with its yokes re-phased it is uniform but for the "
                "errors of its joints as made."
            )
            return text, "warning"
        if toothed:
            text = _(
                "{name} has {share} speed fluctuation as specified; with its yokes re-phased it is exactly uniform, "
                "{least} is left where they keep to the teeth of its splines."
            )
            return text, "warning"
        if on.phasing.feasible:
            text = _(
                "{name} has {share} speed fluctuation as specified; with its yokes re-phased it is exactly uniform."
            )
            return text, "warning"
        text = _(
            "{name} has {share} speed fluctuation as specified; with its yokes re-phased it is uniform to rounding."
        )
        return text, "warning"
    if on.best is None:
        if on.mixed:
            return _("{name} has one joint and {share} speed fluctuation."), "warning"
        return _("{name} has one joint and {share} speed fluctuation; a single joint always fluctuates."), "warning"
    if on.fluctuation - on.best.speed_fluctuation > UTMOST:
        text = _(
            "{name} has {share} speed fluctuation as specified; no phasing of the yokes makes it uniform, the best "
            "leaves {least}."
        )
        return text, "warning"
    return _("{name} has {share} speed fluctuation, and no phasing of the yokes reduces it."), "warning"


def _on_teeth(on: Subject) -> float:
    """Return what the yokes leave at best on the teeth of the splines where none of these makes the drive uniform."""
    least = min((one.speed_fluctuation for one in on.phasing.spline_settings), default=0.0)
    return least if on.curable and least > UTMOST else 0.0


def _share(value: float) -> Quantity:
    return Quantity(value, "share", 3)


def _while_moving(on: Subject) -> float:
    """Return the largest speed fluctuation over the movement, the movement counted too where a speed is known."""
    return max((one.value for what in MOVING for _pose, one in _worst(on, what)), default=0.0)


MOVING = ("speed_fluctuation", "moving_speed_fluctuation")
"""What is told of the output while the drive moves: as if it stopped on its way, and the movement counted."""


def _worst(on: Subject, what: str) -> list[tuple[str, Worst]]:
    """Return the worst instant in a respect, with its pose, as drawn and in every pose."""
    return [(pose, one) for pose, found in on.swept for one in found.worst if one.what == what]


def _moving_words(on: Subject) -> Iterator[Text]:
    """Yield how unevenly the output turns while the drive moves, when and in which pose."""
    stopped, moving = (_worst(on, what) for what in MOVING)
    share = 0.0
    if stopped:
        pose, one = stopped[int(foremost([one.value for _pose, one in stopped]))]
        share, at = one.value, say(_("at {time} of the movement"), time=Quantity(one.time, "time", 3, trim=True))
        text = _("While it moves, the speed fluctuation reaches {share} ({place}).")
        yield say(text, share=_share(share), place=Joined([pose, at]))
    counted = max((one.value for _pose, one in moving), default=0.0)
    if rate_counts(counted, share):
        yield say(_("Including the articulation rate it reaches {share}."), share=_share(counted))


def _in_poses(on: Subject) -> tuple[float, str]:
    """Return the speed fluctuation in the pose where it is largest, and the name of that; 0 without poses."""
    share = on.phasing.as_built.pose_speed_fluctuation
    return (float(np.max(share)), on.phasing.poses[int(foremost(share))]) if share.size else (0.0, "")


def warnings(on: Subject, pages: Sequence[Page] = ()) -> Iterator[Words]:
    """Yield what the reader must not overlook. pages: parts of the report that may have such of their own."""
    limits = _limits(pages)
    yield from (Words(text=one.text, tone="warning") for one in doubts(on.drive))
    yield from (alarm for page in pages if page is not limits for alarm in page.alarms)
    if limits is not None:
        yield uniformity(on)
    yield from steep_joints(on.drive, on.joint_angle)
    fluctuating = not on.rounding(min(on.fluctuation, on.phasing.speed_fluctuation_min))
    if (
        on.joints > 1
        and fluctuating
        and not wants_fluctuation(on.drive)
        and not on.phasing.feasible
        and on.phasing.limiting_joint is not None
    ):
        why: Text = _("Joints tied by fixed yokes act as one whose joint angle is too large for the others.")
        if len(on.phasing.limiting_joints) == 1:
            limiting = on.phasing.limiting_joint - 1
            why = excess(
                on.phasing, on.joints, float(on.joint_angle[limiting]), plain=on.drive.joints[limiting].single_cross
            )
        yield Words(text=say(_("It cannot be made uniform. {why}"), why=why), tone="warning")
    if on.phasing.spline_refusal:
        yield Words(text=on.phasing.spline_refusal, tone="warning")
    if on.moving is not None:
        failed = [flag.message for one in on.moving.splines for flag in one.flags]
        yield from (Words(text=text, tone="failed" if text in failed else "warning") for text in on.moving.warnings)
    if not on.complete:
        yield Words(text=_("Stopped by the reader: what was not calculated by then is left out."), tone="warning")
    for check in on.checks:
        if not check.passed:
            yield Words(text=_("A self-check failed: {name}.").format(name=check.name), tone="failed")


def steep_joints(drive: Drive, joint_angles: Array) -> Iterator[Words]:
    """Yield joints whose angle no joint of their kind works at."""
    for k, (joint, joint_angle) in enumerate(zip(drive.joints, joint_angles, strict=True), start=1):
        found = steep(joint, k, float(joint_angle))
        if joint.single_cross and joint_angle > ILL * deg:
            text = _("joint {number} has a joint angle of {angle}: the motion is so steep that rounding costs digits.")
            found = say(text, number=k, angle=Quantity(float(joint_angle), "angle", decimals=1))
        if found is not None:
            yield Words(text=capital(shown(found)), tone="failed")


def changes(on: Subject) -> Table | Words:
    """Return the changes that help most, with their effect, at most three."""
    drawn = _("This concerns the drive as drawn, standing still.") if on.drive.movements else ""
    steering = [one.text for one in steers(on.drive, on.phasing)]
    if steering:
        as_wanted = _("Nothing needs to be changed for the speed ratio wanted.")
        return Words(text=Joined(steering[1:], between=" ") if len(steering) > 1 else as_wanted)
    if on.even or on.rounded:
        return Words(text=_nothing_as_drawn(on))
    now = on.fluctuation
    found = sorted(((after, text) for text, after in _changes(on) if now - after > max(UTMOST, 0.01 * now)), key=_first)
    if not found:
        if on.joints == 1 and on.mixed:
            return Words(text=_("Nothing but other sizes or another joint angle helps."))
        if on.joints == 1:
            text = _(
                "Add a second joint at the same joint angle, phased to undo the first: then the output is uniform."
            )
            return Words(text=text)
        return Words(text=f"{_('No phasing of the yokes helps; only other joint angles do.')} {drawn}".strip())
    best = found[:3]
    afterwards = [Cell(value=after, tone="good" if after < UTMOST else "plain") for after, _text in best]
    return table(
        answer.Table(
            columns=(
                Column(key="change", heading=_("change"), values=[text for _after, text in best], left=True),
                Column(
                    key="now", heading=_("speed fluctuation now"), values=[now] * len(best), dimension="share", digits=3
                ),
                Column(key="afterwards", heading=_("afterwards"), values=afterwards, dimension="share", digits=3),
            ),
            title=_("Changes that make the output more uniform"),
            note=drawn,
        )
    )


def _first(change: tuple[float, Text]) -> tuple[float, str]:
    """Return what changes are sorted by: what they leave, then their words."""
    return change[0], shown(change[1])


def _nothing_as_drawn(on: Subject) -> Text:
    """Return what is left to be done where the drive as drawn is uniform."""
    little, moving, posed = max(UTMOST, 2.0 * on.fluctuation), _while_moving(on), _in_poses(on)[0]
    for one in on.phasing.pose_settings[:1]:
        left = float(np.max(one.pose_speed_fluctuation))
        if posed > little and posed - left > max(UTMOST, 0.01 * posed):
            text = _("The drive is uniform as drawn; “{label}” leaves {left} in the worst pose instead of {now}.")
            return say(text, label=one.label, left=_share(left), now=_share(posed))
    if moving > little:
        return _("The yokes are phased right; what is left comes from joint angles that differ while the drive moves.")
    if posed > little:
        return _("The yokes are phased right; what is left comes from joint angles that differ in the poses.")
    if _errs(on):
        return _("The yokes are phased right; what is left comes from the errors of the joints as made.")
    return _("Nothing needs to be changed for a uniform output.")


def _changes(on: Subject) -> Iterator[tuple[Text, float]]:
    """Yield changes and the speed fluctuation each would leave."""
    seen: list[YokeSetting] = []

    def new(one: YokeSetting) -> bool:
        fresh = all(np.max(np.abs(np.sin(one.yoke_angle - other.yoke_angle))) > SAME for other in seen)
        seen.append(one)
        return bool(fresh)

    for one in (*on.phasing.settings[:1], *on.phasing.spline_settings[:1]):
        if new(one):
            yield _set_to(one), one.speed_fluctuation
    for k, one in on.alone[:2]:
        if new(one):
            text = _("turn only the yokes of shaft {k}: to {angle}")
            yield say(text, k=k, angle=_yoke_angle(one, k)), one.speed_fluctuation
    plain = on.drive.joints[on.closing.longest - 1].single_cross
    if on.joints > 1 and plain and not on.phasing.feasible and not on.phasing.fixed:
        closing, now = float(on.closing.joint_angle_allowed), float(on.joint_angle[on.closing.longest - 1])
        if round(closing / deg, 2) != round(now / deg, 2):
            text = _("reduce joint angle {k} from {now} to {closing} and re-phase the yokes")
            angles = {"closing": Quantity(closing, "angle", decimals=2), "now": Quantity(now, "angle", decimals=2)}
            yield say(text, k=on.closing.longest, **angles), 0.0


def _set_to(one: YokeSetting) -> Text:
    """Return what is to be turned for a setting of the yokes."""
    moved = [k for k, change in enumerate(one.change, start=2) if abs(float(change)) > SAME]
    if len(moved) > 6:
        text = _("set the yokes of {count} shafts as in setting {label}")
        return say(text, count=len(moved), label=one.label)
    text = plural(
        "setting {label}: yokes of shaft {numbers} to {angles}",
        "setting {label}: yokes of shafts {numbers} to {angles}",
        len(moved),
    )
    angles = Joined([_yoke_angle(one, k, line=False) for k in moved])
    return say(text, label=one.label, numbers=", ".join(map(str, moved)), angles=angles)


def _yoke_angle(one: YokeSetting, shaft: int, *, line: bool = True) -> Quantity:
    angle = float(one.yoke_angle[shaft - 2])
    return Quantity(half_turn(angle / deg) * deg if line else angle, "angle", decimals=2)
