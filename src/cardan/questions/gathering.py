"""A question asked in every condition of a drive: which of its answers governs, and all of them side by side.

What a question gathers by itself, and what it leaves out and why, stands in the register, see
`cardan.answers.question.Question`; in all else that a drive has it is asked here, so that no question can forget it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.answers.answer import Answer, Cell, Column, Depth, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.answers.quantity import told as words
from cardan.answers.question import Aspect, Question
from cardan.answers.reader import reader
from cardan.drive.conditions import Condition, acting, conditions, in_poses, load_cases
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import key_of
from cardan.errors import InputError
from cardan.later import later
from cardan.maths.ties import alike, foremost
from cardan.texts import _, mark

from .motion.moving_points import default_times
from .motion.standing import BESIDE, outermost, still, worst_instants

optimize = later("scipy.optimize")
made = later("cardan.questions.accuracy.as_made", of="made")
"""How a drive turns with the errors of its joints as made: few drives have any."""

WORSE: tuple[Tone, ...] = ("good", "plain", "next", "warning", "failed")
"""Tones from the best to the worst."""

OUTERMOST = mark(
    "Of the movement only those instants are looked at where a joint bends most, a shaft is longest or shortest, or a "
    "shaft turns least uniformly: each takes too long for all of them."
)

LOOKS = 12
"""Instants of a movement, beside those where the drive lies outermost, at which a quick question is asked."""

CLOSER = 8
"""Times that a quick question is asked beside the worst of them, by Brent's method: the top of a smooth curve is met to
a millionth."""


@dataclass(frozen=True, kw_only=True)
class Way:
    """A condition in which a question is asked by itself: its name, its share of the time, the drive there."""

    name: Text
    share: float | None
    drive: Drive


@dataclass(frozen=True, kw_only=True)
class Told:
    """What is said in one condition."""

    way: Way
    answer: Answer


def has(drive: Drive) -> dict[Aspect, bool]:
    """Return what a drive has that makes conditions of their own: poses, movements, several load cases, errors.

    >>> has(Drive.from_angles([0.1]))["pose"]
    False
    """
    return {
        "pose": bool(drive.poses),
        "movement": bool(drive.movements),
        "case": len(load_cases(drive.duty)) > 1,
        "error": any(joint.error is not None for joint in drive.joints),
    }


def ways(question: Question, drive: Drive) -> tuple[Way, ...]:
    """Return the conditions in which a question is to be asked, the drive as drawn first.

    question: which leaves out what it gathers by itself or does not depend on.
    Of a movement the instants at which a key figure is worst.
    """
    asks = {aspect for aspect in has(drive) if aspect not in (*question.gathered, *question.without)}
    every: Sequence[Condition] = (Condition(drive=drive, moving=bool(drive.movements)),)
    if "case" in asks:
        free = tuple(case if "pose" in asks else replace(case, pose="") for case in drive.duty.cases)
        poses = drive.poses if "pose" in asks else ()
        every = conditions(replace(drive, poses=poses, duty=replace(drive.duty, cases=free)))
    elif "pose" in asks:
        every = [replace(one, drive=acting(one.drive, one.pose)) for one in in_poses(drive)]
    found = []
    for one in every:
        found.append(Way(name=one.name, share=one.share, drive=one.drive))
        if "movement" in asks and one.moving:
            found += _moving(question, one)
    return tuple(found)


def _moving(question: Question, one: Condition) -> Iterator[Way]:
    """Yield the instants of a movement at which a key figure is worst."""
    for time in _instants(question, one.drive):
        at = say(_("at {time} of the movement"), time=Quantity(time, "time", 3, trim=True))
        yield Way(name=Joined([one.name, at]), share=None, drive=still(one.drive, time))


def _instants(question: Question, drive: Drive) -> tuple[float, ...]:
    """Return the instants [s] of the movements of a drive at which the key figures of a question are worst.

    Where the question tells their course, over the whole movement; else they are asked for where the drive lies
    outermost and, of quick questions, at `LOOKS` instants between, and each is followed from the worst to its top.
    """
    known = getattr(question.home, "over_movement", None)
    course = None if known is None else known(drive)
    if course is not None:
        return worst_instants(drive, course)
    first, every = outermost(drive), default_times(drive.movements)
    asked: dict[float, dict[str, float]] = {}

    def ask(time: float) -> dict[str, float]:
        if time not in asked:
            asked[time] = _figures(question, drive, time)
        return asked[time]

    names = dict.fromkeys(name for time in first for name in ask(time)) if question.quick else {}
    if not names:
        return first
    middles = every[0] + (np.arange(LOOKS) + 0.5) * (np.ptp(every) / LOOKS)
    looked = sorted({*first, float(every[0]), float(every[-1]), *middles.tolist()})
    found: list[float] = []
    for name in names:
        values = np.asarray([ask(time).get(name, np.nan) for time in looked])
        if np.all(alike(values) | np.isnan(values)):
            continue
        k = int(foremost(values))
        between = looked[max(k - 1, 0)], looked[min(k + 1, len(looked) - 1)]

        def less(time: float, name: str = name) -> float:
            return -ask(float(time)).get(name, -np.inf)

        optimize().minimize_scalar(less, bounds=between, method="bounded", options={"maxiter": CLOSER})
        best = min(asked, key=less)
        if all(abs(best - one) > BESIDE * np.ptp(every) for one in found):
            found.append(best)
    return tuple(found) or first[:1]


def _figures(question: Question, drive: Drive, time: float) -> dict[str, float]:
    """Return the key figures at an instant, larger where they are worse; none where nothing can be told."""
    try:
        here = still(drive, time)
        result = None if question.lacking(here) else question.ask(here)
    except InputError:
        return {}
    if result is None:
        return {}
    keys = [one for one in question.brief(here, result).keys if one.better]
    return {
        one.name: float(one.value.value) * (1.0 if one.better == "less" else -1.0)
        if one.utilisation is None
        else one.utilisation
        for one in keys
    }


def principal(question: Question, drive: Drive) -> Drive:
    """Return the drive that a question is asked of: as it is, or in its heaviest load case where it wants a torque."""
    instead = _heaviest(question, drive)
    if instead is None:
        return drive
    return replace(drive, duty=instead.drive.duty) if drive.poses else instead.drive


def _heaviest(question: Question, drive: Drive) -> Condition | None:
    """Return the load case in which a question is asked instead of the duty itself; None where it is not."""
    unloaded = question.loaded and drive.duty.torque is None and drive.duty.load is None
    if "case" in question.gathered or not (unloaded or question.lacking(drive)):
        return None
    bare = replace(drive, poses=()) if drive.poses else drive
    heaviest = max(
        (one for one in conditions(bare) if one.torque is not None),
        key=lambda one: abs(one.torque or 0.0),
        default=None,
    )
    if heaviest is None or heaviest.drive.duty == drive.duty:
        return None
    fewer = len(question.lacking(drive)) - len(question.lacking(replace(drive, duty=heaviest.drive.duty)))
    return heaviest if fewer > 0 or (unloaded and fewer == 0) else None


def gather(question: Question, drive: Drive, answer: Answer) -> Answer:
    """Return an answer with what is said in the other conditions of its drive, and what it leaves out and why.

    drive: with all its poses, movements and load cases; answer: of it as drawn.
    Returns Answer: its key figures are those of the condition that governs, which they name; a table has those of all.
    """
    left = [aspect for aspect, there in has(drive).items() if there and aspect in question.without]
    remarks = [Remark(text=_(question.without[aspect]), code=f"without_{aspect}") for aspect in left]
    keys: list[KeyFigure] = []
    if has(drive)["error"] and "error" not in (*question.gathered, *question.without):
        figures, remark = _as_made(drive)
        keys += figures
        remarks.append(remark)
    followed = question.quick or hasattr(question.home, "over_movement")
    if has(drive)["movement"] and not followed and "movement" not in (*question.gathered, *question.without):
        remarks.append(Remark(text=_(OUTERMOST), code="outermost"))
    every = ways(question, drive)
    instead = _heaviest(question, drive)
    if instead is not None:
        remarks.insert(0, Remark(text=_of(instead.name), code="heaviest"))
    if len(every) < 2:
        if not remarks:
            return answer
        return replace(answer, keys=(*answer.keys, *keys), remarks=_after(answer, remarks))
    told: list[Told] = []
    whole = not question.lacking(every[0].drive)
    left_out: dict[str, list[Text]] = {}
    for way in every:
        if whole and (lacking := question.lacking(way.drive)):
            missing = ", ".join(_(" or ").join(map(key_of, some)) for some in lacking)
            left_out.setdefault(missing, []).append(_called(way.name))
            continue
        try:
            result = question.ask(way.drive)
            found = None if result is None else question.brief(way.drive, result)
        except InputError as error:
            problem = error.problems[0]
            text = _("Warning: not calculated in this condition, {condition}: {field}: {message}")
            said = say(text, condition=_called(way.name), field=problem.field, message=problem.message)
            remarks.append(Remark(text=said, tone="warning"))
            continue
        if found is not None:
            told.append(Told(way=way, answer=found))
    for missing, names in left_out.items():
        text = _("Left out for want of {keys}: {conditions}.")
        remarks.append(Remark(text=say(text, keys=missing, conditions=Joined(names)), code="left_out"))
    if len(told) < (2 if left_out else 1):
        return replace(answer, keys=(*answer.keys, *keys), remarks=_after(answer, remarks))
    worst = max(told, key=lambda one: WORSE.index(one.answer.tone))
    if WORSE.index(worst.answer.tone) > WORSE.index(answer.tone):
        at, bad = _called(worst.way.name), worst.answer.tone
        if bad in ("warning", "failed"):
            why = say(_("In this condition: {condition}: {answer}"), condition=at, answer=worst.answer.sentence)
            remarks.append(Remark(text=why, tone=bad, alarm=bad == "failed"))
        answer = replace(answer, tone=worst.answer.tone, code=max(answer.code, worst.answer.code))
    before = {key.name: key for one in (answer, *(one.answer for one in told[::-1])) for key in one.keys}
    before |= {key.name: key for key in answer.keys}
    governing = [(key, _governing(key, told)) for key in before.values()]
    keys = [*(one for _key, one in governing), *keys]
    same = _same(told)
    if same and not left_out:
        remarks.append(Remark(text=_("The same holds in every pose, load case and movement."), code="same"))
    elif not same:
        remarks[:0] = _worst([one for key, one in governing if one is not key], len(told))
    note = _of(every[0].name) if instead is None and told[0].way is every[0] else ""
    return replace(
        answer,
        keys=keys,
        tables=answer.tables if same else (*answer.tables, replace(_table(told), note=note)),
        remarks=_after(answer, remarks),
        full=answer.full or ((lambda: answer.tables[-1]) if answer.tables else None),
    )


def _after(answer: Answer, more: Sequence[Remark]) -> tuple[Remark, ...]:
    """Return the remarks of an answer and more of them, what to do next at the end."""
    own = answer.remarks
    return (*(one for one in own if one.tone != "next"), *more, *(one for one in own if one.tone == "next"))


def _worst(keys: Sequence[KeyFigure], count: int) -> Iterator[Remark]:
    """Yield the key figures that a condition governs."""
    said: list[Text] = [
        say("{title} {value} ({place})", title=one.title, value=one.value, place=one.place) for one in keys
    ]
    if said:
        text = _("The worst of {count} conditions: {figures}.")
        figures = Joined(said, between="; ")
        yield Remark(text=say(text, count=Quantity(float(count), trim=True), figures=figures), aside=True)


def _as_made(drive: Drive) -> tuple[tuple[KeyFigure, ...], Remark]:
    """Return what the errors of the joints as made add to the motion, or why that is not told."""
    found = made()(drive)
    if isinstance(found, str):
        text = _("The errors of its joints as made are not in this: {why}.")
        return (), Remark(text=say(text, why=found), code="as_made")
    share, angle_error = Quantity(found.fluctuation, "share"), Quantity(found.angle_error, "angle")
    text = _(
        "With the errors of its joints as made the speed fluctuation is {share}, "
        "the angle error of the output ±{angle_error}."
    )
    titles = _("speed fluctuation δ with the errors as made"), _("angle error with the errors as made, ±")
    figures = (
        KeyFigure(name="speed_fluctuation_as_made", title=titles[0], value=share),
        KeyFigure(name="angle_error_as_made", title=titles[1], value=angle_error),
    )
    return figures, Remark(text=say(text, share=share, angle_error=angle_error), code="as_made")


def _of(name: Text) -> Text:
    """Return that the rest of an answer is of a condition."""
    text = _("Where nothing else is said, figures are of this condition: {condition}.")
    return say(text, condition=_called(name))


def _called(name: Text) -> Text:
    return name if name != "" else _("as drawn")


def _named(told: Told, name: str) -> KeyFigure | None:
    return next((one for one in told.answer.keys if one.name == name), None)


def _governing(key: KeyFigure, told: Sequence[Told]) -> KeyFigure:
    """Return a key figure of the condition in which it is worst, with the name of that."""
    others = [(one.way, its) for one in told if (its := _named(one, key.name)) is not None]
    if not others or not key.better:
        return key
    least = key.better == "more"
    values = np.asarray([float(its.value.value) for _way, its in others])
    used = [its.utilisation for _way, its in others]
    if all(one is not None for one in used):
        values, least = np.asarray(used, dtype=float), False
    way, worst = others[int(np.argmax(alike(values, least=least)))]
    if np.all(alike(values, least=least)):
        return key
    return replace(worst, place=Joined([worst.place, _called(way.name)]))


def _same(told: Sequence[Told]) -> bool:
    """Tell whether all conditions have the same key figures, or without any the same answer."""
    if not told[0].answer.keys:
        return len({words(one.answer.sentence, reader()) for one in told}) == 1
    return not any(_varies(told, key.name) for key in told[0].answer.keys)


def _varies(told: Sequence[Told], name: str) -> bool:
    values = [float(its.value.value) for one in told if (its := _named(one, name)) is not None]
    return len(values) < len(told) or not bool(np.all(alike(values)) and np.all(alike(values, least=True)))


def _table(told: Sequence[Told]) -> Table:
    """Return the key figures of all conditions side by side; sentences where there are none.

    What is the same in all of them stands with the rest of the answer, and here for programs only.
    """
    keys = list({key.name: key for one in told for key in one.answer.keys}.values())
    shares = [one.way.share for one in told]
    columns = [Column(key="condition", heading=_("condition"), values=[_called(one.way.name) for one in told])]
    if any(share is not None and 0.0 < share < 1.0 for share in shares):
        columns.append(Column(key="share", heading=_("time"), values=shares, dimension="share", decimals=1))
    for key in keys:
        found = [_named(one, key.name) for one in told]
        cells = [None if its is None else Cell(value=its.value.value, tone=its.tone) for its in found]
        value = key.value
        columns.append(
            Column(
                key=key.name,
                heading=key.title,
                values=cells,
                dimension=value.dimension,
                unit=value.unit,
                digits=value.digits,
                decimals=value.decimals,
                depth="brief" if _varies(told, key.name) else "data",
            )
        )
    if not keys:
        said = [one.answer.sentence for one in told]
        columns.append(Column(key="answer", heading=_("answer"), values=said, wrap=True))
    depth: Depth = "full" if keys else "brief"
    return Table(name="conditions", title=_("In each condition"), columns=columns, records=True, depth=depth)
