"""What there is to say of the strength of a drive: utilisation of every limit, what governs, what is left out."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from cardan.answers.answer import FILE, Answer, Column, Depth, KeyFigure, Remark, Table, Tone, heads
from cardan.answers.quantity import Joined, Quantity, Say, Text, listed, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.catalogue import Catalogue
from cardan.checks.event_loads import plays
from cardan.checks.verdict import AMBER, Verdict
from cardan.checks.verdict_table import (
    least_needs,
    missing_table,
    share,
    unconfirmed_remark,
    verdict_records,
    verdict_table,
)
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import written
from cardan.drive.torsional_layout import has_torsion
from cardan.later import later
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.stability.in_use import larger_in_use
from cardan.texts import _, mark, plural

from .event_damage import cheapest, event_damages, events_lost, ramp_damages
from .omitted import LeftOut, Vibration
from .part_strength import ShaftStrength
from .strength import LITTLE, Strength, left_out, reached, strength

drawn = later("cardan.checks.strength.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "otherwise"]

HEAVY = 0.2
"""Share of the secondary couple from which a shaft's own weight is told."""

SAME = 1e-9
"""Share by which two utilisations may differ that are the same."""

SIZED = {
    "tube_strength": "tube",
    "tube_fatigue": "tube",
    "shaft_life": "tube",
    "tube_buckling": "tube",
    "ply_strength": "tube",
    "journal_strength": "journal",
    "needle_static": "needles",
    "bearing_life": "needles",
    "joint_torque": "joint",
    "rated_torque": "joint",
    "yoke_strength": "joint",
}
"""Check -> what ``--size`` calls the part that it judges."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for its strength."""
    duty = drive.duty
    given = duty.torque_history is not None or any(case.torque is not None for case in load_cases(duty))
    return absent((given, "duty.torque", "duty.cases", "duty.blocks", "duty.torque_history"))


def ask(drive: Drive, *, known: Catalogue | None = None) -> Strength | None:
    """Return the strength of a drive with what its stresses leave out; None where nothing is judged."""
    found = strength(drive, known=known)
    if not (found.binding or found.surpassed) or not found.torque > 0.0:
        return None
    return with_events(drive, replace(found, left_out=left_out(drive, found)))


def otherwise(drive: Drive) -> str | Lacking:
    """Return why nothing can be told."""
    return least_needs(strength(drive).verdicts) or _("There is nothing to be told of this drive.")


def answer(drive: Drive, result: Strength) -> Answer:
    """Return what there is to say of the strength of a drive."""
    unknown = bool(result.lost or _undecided(result))
    close = unknown or any(float(one.utilisation) >= AMBER or not one.sure for one in result.binding)
    tired = [one for one in result.shafts if result.events and one.fatigue_used > 1.0]
    enough = False if tired else result.enough
    tone: Tone = "plain" if enough is None else "failed" if not enough else "warning" if close else "good"
    return Answer(
        name="strength",
        title=_("Strength"),
        sentence=_sentence(drive, result) if not tired else _ending(drive, result, tired),
        tone=tone,
        figures=lambda: drawn().strength_figures(result),
        tables=tuple(_tables(drive, result)),
        remarks=(
            *_remarks(drive, result),
            *(replace(one, aside=True) for one in larger_in_use(drive)),  # torsional vibration tells it too
            *(yokes_estimated(drive) if has_torsion(drive) else ()),
        ),
        keys=tuple(_keys(result)),
        facts=_facts(result) | {"enough": enough},
        full=lambda: verdict_records(result.verdicts, "", torque=_rated(result), flat=True),
        code=1 if enough is False else 0,
    )


def _torque(value: float) -> Quantity:
    return Quantity(value, "torque")


def _rated(result: Strength) -> float:
    """Return the torque that limits are rated with [N·m]; nan where they are not."""
    return math.nan if result.surpassed else result.torque


def _sentence(drive: Drive, result: Strength) -> Say | str:
    first = result.governing
    if first is None and result.surpassed:
        return _("not judged: {why}.").format(why=result.surpassed)
    if first is None and result.judged:
        return _("rules of thumb alone could be judged; the drive file lacks what the other checks need.")
    if first is None:
        return _("nothing could be judged; the drive file lacks what the checks need.")
    text = _("too weak for {torque}; torque rating {rated}, governed by {title}.")
    if result.enough:
        text = _("carries {torque}; torque rating {rated}, governed by {title}.")
    if result.surpassed:
        text = _("too weak for {torque}, first {title}; not rated: {why}.")
    elif not result.rated_torque:
        text = _("too weak for {torque} and even without load, by torsional vibration alone; governed by {title}.")
    torque: Text = _torque(result.torque)
    if result.case:
        torque = say("{torque} ({case})", torque=torque, case=result.case)
    return say(text, torque=torque, rated=_torque(result.rated_torque), title=first.title, why=result.surpassed)


def _ending(drive: Drive, result: Strength, tired: Sequence[ShaftStrength]) -> Say:
    """Return that starts and events use up a shaft before the life asked for, or by their number alone."""
    first = max(tired, key=lambda one: one.fatigue_used)
    values = {"number": first.number, "rated": _torque(result.rated_torque), "why": result.surpassed}
    if drive.duty.life is None or math.isnan(first.fatigue_life):
        text = _(
            "starts and events take {share} of the fatigue life of shaft {number}; torque rating without their damage "
            "{rated}."
        )
        if result.surpassed:
            text = _("starts and events take {share} of the fatigue life of shaft {number}; not rated: {why}.")
        return say(text, share=Quantity(first.fatigue_used, "share", 3), **values)
    text = _(
        "shaft {number} lasts {life} of the {asked} asked, with its starts and events; torque rating without their "
        "damage {rated}."
    )
    if result.surpassed:
        text = _("shaft {number} lasts {life} of the {asked} asked, with its starts and events; not rated: {why}.")
    life, asked = Quantity(first.fatigue_life, "duration"), Quantity(drive.duty.life, "duration")
    return say(text, life=life, asked=asked, **values)


def _undecided(result: Strength) -> list[int]:
    """Return the numbers of the shafts of which nobody can tell whether starts, events and running use them up."""
    return [
        one.number
        for one in result.shafts
        if result.events and one.fatigue is not None and math.isnan(one.fatigue_used)
    ]


def with_events(drive: Drive, found: Strength) -> Strength:
    """Return a strength with what starts and events cost."""
    return replace(found, events=event_damages(drive), ramps=ramp_damages(drive), lost=events_lost(drive))


def _tables(drive: Drive, result: Strength) -> Iterator[Table]:
    if result.judged:
        order = sorted(result.judged, key=lambda one: (one.advice, reached(one)))
        yield replace(verdict_table(order, _("Limits of the parts"), torque=_rated(result)), aside=True)
    yield _shafts(drive, result)
    yield _joints(drive, result)
    yield from _events(drive, result)
    missing = [one for one in result.verdicts if not one.run]
    if missing:
        depth: Depth = "full" if result.judged else "brief"
        yield replace(missing_table(missing, depth), aside=bool(result.judged))
    yield verdict_records(result.verdicts, "limits", torque=_rated(result))


def _shafts(drive: Drive, result: Strength) -> Table:
    shafts = result.shafts
    torsion, bending = (
        [None if one.stress is None else float(getattr(one.stress, name)) for one in shafts]
        for name in ("torsion", "bending")
    )
    return Table(
        name="shafts",
        title=_("Shafts"),
        records=True,
        columns=(
            *heads(_("shaft"), [shaft.name for shaft in drive.shafts]),
            Column(key="torque", heading=_("torque"), values=[one.torque for one in shafts], dimension="torque"),
            *_cases("case", _("load case"), [one.case for one in shafts]),
            Column(
                key="secondary_couple",
                heading=_("secondary couple"),
                values=[one.bending for one in shafts],
                dimension="torque",
            ),
            Column(key="torsion", heading=_("torsion"), values=torsion, dimension="stress"),
            Column(key="bending", heading=_("bending"), values=bending, dimension="stress"),
            Column(
                key="twist", heading=_("twist"), values=[one.twist for one in shafts], dimension="angle", decimals=2
            ),
            Column(
                key="safety",
                heading=_("safety, fatigue"),
                values=[None if one.fatigue is None else one.safety for one in shafts],
                decimals=2,
            ),
            *_cases("fatigue_case", _("load case, fatigue"), [one.fatigue_case for one in shafts]),
            Column(
                key="life", heading=_("fatigue life"), values=[one.fatigue_life for one in shafts], dimension="duration"
            ),
        ),
        note=_counted(drive, result),
    )


def _events(drive: Drive, result: Strength) -> Iterator[Table]:
    """Yield what starts and events cost, and what a start costs with other times of its run-up."""
    for name, title, rows in (
        ("events", _("Damage by starts and events"), result.events),
        ("ramps", _("Run-ups of other times"), result.ramps),
    ):
        if not rows:
            continue
        best = cheapest(rows) if name == "ramps" else None
        said: list[Text] = [_("Each in time, its cycles by rainflow; of the shaft that it tires most.")]
        if plays(drive):
            said.append(_("Backlash of joints and splines counts as closed; cardan torsion simulate follows it open."))
        head = Column(key="name", heading=_("event"), values=[one.name for one in rows], left=True)
        if best is not None:
            words = [_("least damage") if k == best else "" for k in range(len(rows))]
            head = Column(key="choice", heading=_("choice"), values=words, left=True)
        yield Table(
            name=name,
            title=title,
            records=True,
            columns=(
                head,
                Column(
                    key="time", heading=_("time"), values=[one.duration for one in rows], dimension="time", trim=True
                ),
                Column(key="count", heading=_("count"), values=[Quantity(one.count, trim=True) for one in rows]),
                Column(key="shaft", heading=_("shaft"), values=[one.shaft for one in rows]),
                Column(
                    key="torque", heading=_("largest torque"), values=[one.torque for one in rows], dimension="torque"
                ),
                Column(
                    key="damage",
                    heading=_("damage per event"),
                    values=[one.damage for one in rows],
                    dimension="share",
                    digits=3,
                ),
                Column(
                    key="life_used",
                    heading=_("in the life"),
                    values=[one.share for one in rows],
                    dimension="share",
                    digits=3,
                ),
            ),
            tones=["good" if k == best else "plain" for k in range(len(rows))] if best is not None else (),
            note=(Joined(said, between=" ") if len(said) > 1 else said[0])
            if best is None
            else _("A faster run-up asks more of what drives it; at no damage the least torque counts."),
        )


def _stands(drive: Drive) -> bool:
    """Tell whether a drive stands otherwise than drawn, too."""
    return bool(drive.poses or drive.movements)


def _cases(key: str, heading: str, names: Sequence[str]) -> Iterator[Column]:
    """Yield the column that tells in which load case a number arises, where there are several."""
    if any(names):
        yield Column(key=key, heading=heading, values=list(names), left=True)


def _counted(drive: Drive, result: Strength) -> Text:
    """Return what the tables count."""
    said: list[Text] = [_("Largest over the turn; the couple is that of the larger end.")]
    if _stands(drive):
        said = [
            _(
                "Largest over the turn of the drive as drawn, while the limits count its poses and movements, too; the "
                "couple is that of the larger end."
            )
        ]
    if result.case:
        said.append(
            _(
                "Every load case counts with its own torque: the worst stands here, and the fatigue life adds the "
                "damage of all by their shares."
            )
        )
    low, high = (pick(result.shock_factor * one.severity for one in result.cases) for pick in (min, max))
    if high != 1.0:
        more = _("Torques and stresses are with the service factor {shock}; twist and fatigue are without.")
        if low != high:
            more = _(
                "Torques and stresses are with the service factor of each load case, {low} to {shock}; twist and "
                "fatigue are without."
            )
        factors = {"low": Quantity(low, digits=3, trim=True), "shock": Quantity(high, digits=3, trim=True)}
        said.append(say(more, **factors))
    return Joined(said, between=" ") if len(said) > 1 else said[0]


def _joints(drive: Drive, result: Strength) -> Table:
    joints = result.joints
    mises = {
        name: [None if getattr(one, name) is None else float(getattr(one, name).mises) for one in joints]
        for name in ("journal", "yoke")
    }
    return Table(
        name="joints",
        title=_("Joints"),
        records=True,
        columns=(
            *heads(_("joint"), [joint.name for joint in drive.joints]),
            Column(key="torque", heading=_("torque"), values=[one.torque for one in joints], dimension="torque"),
            *_cases("case", _("load case"), [one.case for one in joints]),
            Column(
                key="journal",
                heading=_("journal load"),
                values=[one.journal_force for one in joints],
                dimension="force",
            ),
            Column(key="journal", heading=_("journal root"), values=mises["journal"], dimension="stress"),
            Column(key="yoke", heading=_("yoke"), values=mises["yoke"], dimension="stress"),
            Column(
                key="contact",
                heading=_("needles"),
                values=[None if one.contact is None else float(one.contact.pressure) for one in joints],
                dimension="stress",
            ),
            Column(key="static", heading="C0", values=[one.static_capacity for one in joints], dimension="force"),
        ),
    )


def _remarks(drive: Drive, result: Strength) -> Iterator[Remark]:
    yield from _failed(result)
    yield from (replace(one, aside=True) for one in unconfirmed_remark(result.binding))  # the checks tell it too
    out = result.left_out
    yield from _vibrating(drive, result, runs_up=out is not None and out.runs_up)
    duty = drive.duty
    if result.vibration is not None and result.governing and (duty.engine or duty.motor or duty.load or duty.torques):
        text = _(
            "Engine, motor, load and further torques keep their laws: the torque rating is in proportion to the "
            "torques of the duty and what they make of them."
        )
        yield Remark(text=text)
    if out is not None:
        yield from _left_out(out)
    left = sum(not one.run for one in result.verdicts)
    if left and result.judged:
        text = plural(
            "One limit could not be judged; the drive may carry less.",
            "{count} limits could not be judged; the drive may carry less.",
            left,
        )
        yield Remark(text=text.format(count=left), tone="warning")
        yield Remark(text=_("Which keys it lacks:"), command=("cardan", "check", FILE, "--missing"), tone="next")
    for name, why in result.lost:
        text = _("Warning: damage and peak torque of {event} are not counted, as it cannot be followed in time: {why}.")
        yield Remark(text=say(text, event=name, why=why), tone="warning")
    if undecided := _undecided(result):
        text = _(
            "Warning: whether shaft {which} lasts through starts, events and running is not judged; the file lacks "
            "{keys}."
        )
        yield Remark(text=say(text, which=listed(undecided), keys=written("duty.life")), tone="warning")
    yield from _ramp(result)
    counted = result.vibration is not None or (out is not None and out.journal is not None)
    if result.dynamic_factor > LITTLE and not counted:
        text = _("Masses and friction raise the largest couple of a cross by {more}, which the stresses leave out.")
        covered = result.shock_factor >= result.dynamic_factor
        if covered:
            text = _("Masses and friction raise the largest couple of a cross by {more}; the service factor covers it.")
        more = Quantity(result.dynamic_factor - 1.0, "share", decimals=1)
        yield Remark(text=say(text, more=more), tone="plain" if covered else "warning")
    if result.extrapolated:
        text = _("Shafts over {width} are beyond the tests behind the fatigue formula; here shafts {which}.")
        which = ", ".join(map(str, result.extrapolated))
        yield Remark(text=say(text, width=Quantity(0.254, "length", 3), which=which), tone="warning")
    for one in result.shafts:
        if one.bending > 0.0 and one.weight_bending > HEAVY * one.bending:
            text = _("The weight of shaft {number} bends it by {moment}, which the stresses leave out.")
            moment = Quantity(one.weight_bending, "torque", 3)
            yield Remark(text=say(text, number=one.number, moment=moment), tone="warning")
    if result.enough:
        text = _("Every limit on its own, with where it comes from:")
        yield Remark(text=text, command=("cardan", "strength", FILE, "--csv"), tone="next")


def _ramp(result: Strength) -> Iterator[Remark]:
    """Yield which run-up costs least where it is another one than that of the duty."""
    if not result.ramps or not result.events:
        return
    best, now = result.ramps[cheapest(result.ramps)], result.events[0]
    if best.damage < now.damage:
        text = _("A run-up in {time} would cost {least} of the fatigue life per start, that in {own} costs {damage}.")
        values = {"time": Quantity(best.duration, "time", trim=True), "own": Quantity(now.duration, "time", trim=True)}
        shares = {"least": Quantity(best.damage, "share", 3), "damage": Quantity(now.damage, "share", 3)}
        yield Remark(text=say(text, **values, **shares))


def _failed(result: Strength) -> Iterator[Remark]:
    """Yield what fails, and what to do; or what is used most where another limit governs."""
    first = result.governing
    if first is None:
        return
    if result.enough is False:
        failed = [one for one in result.binding if float(one.utilisation) > 1.0]
        worst = max(failed, key=lambda one: float(one.utilisation))
        text = _("Failed: {title}, at {used} of its limit.")
        if len(failed) > 1:
            text = _("{count} limits failed; worst: {title}, at {used} of its limit.")
        said = say(text, title=worst.title, used=share(float(worst.utilisation)), count=len(failed))
        yield Remark(text=said, tone="failed", aside=True)  # in a report the page of the checks tells it
        if first.check in SIZED:
            command = ("cardan", "strength", FILE, "--size", f"{SIZED[first.check]}:{first.number}")
            yield Remark(text=_("What it would take:"), command=command, tone="next")
    elif float(first.utilisation) < result.utilisation * (1.0 - SAME):
        text = _(
            "Another limit has a higher utilisation now, but {title} is reached first as the torque grows: a life "
            "falls with the power 10/3 of the torque, a contact pressure grows with its root."
        )
        yield Remark(text=say(text, title=first.title))


def _left_out(out: LeftOut) -> Iterator[Remark]:
    """Yield what the stresses leave out."""
    text = _(
        "Stresses count what the torque of the duty makes without friction, masses only in torsional vibration; axial "
        "forces of splines and weights are not in them."
    )
    yield Remark(text=text, tone="warning")
    if out.supported:
        text = _(
            "The larger of the couples at its two ends bends a shaft; the chapter Forces adds both, as its supports do."
        )
        yield Remark(text=text, tone="warning")
    if out.journal is not None:
        text = _(
            "With friction, masses, weights and axial forces a journal of joint {number} carries {load}, {more} more "
            "than counted here before the service factor."
        )
        if out.journal.several:
            text = _(
                "Under the torque of the duty a journal of joint {number} carries {load} with friction, masses, "
                "weights and axial forces, {more} more than without them."
            )
        load, more = Quantity(out.journal.load, "force"), Quantity(out.journal.more, "share", decimals=1)
        yield Remark(text=say(text, number=out.journal.joint, load=load, more=more), tone="warning")


def _vibrating(drive: Drive, result: Strength, *, runs_up: bool) -> Iterator[Remark]:
    """Yield what torsional vibration makes of the torque, or that it is not counted."""
    found = result.vibration
    if found is None:
        text = _("Torsional vibration is not counted: the file says nothing of masses and stiffness (stations).")
        measured = result.vibrates and any(case.history for case in result.cases)
        if measured:
            text = _("Torsional vibration counts as far as the measured torque holds it.")
        elif result.vibrates:
            text = _("Torsional vibration is not counted: the file has masses or stiffness, but no motion can be told.")
        yield Remark(text=text, tone="plain" if measured else "warning", alarm=result.vibrates and not measured)
        return
    speed: Text = Quantity(found.speed, "angular_speed", 3)
    if _stands(drive):
        speed = say(_("{speed}, as drawn,"), speed=speed)
    if not found.stable:
        return  # `larger_in_use` tells it
    text = _(
        "Torsional vibration is counted: at {speed} the torque in {name} runs from {low:bare} to {high}, {more} times "
        "that without it."
    )
    if math.isinf(found.factor):
        text = _("Torsional vibration is counted: at {speed} the torque in {name} runs from {low:bare} to {high}.")
    torques = {"low": found.low, "high": found.high}
    told = {name: Quantity(value, "torque", 4) for name, value in torques.items()}
    more = Quantity(found.factor, digits=3)
    grows = found.factor > LITTLE
    tone: Tone = "plain" if not grows else "failed" if result.enough is False else "warning"
    yield Remark(text=say(text, speed=speed, name=found.name, more=more, **told), tone=tone, alarm=grows)
    if runs_up:
        yield Remark(text=_("While running up it may be more: see Run-up."), tone=tone)


def _keys(result: Strength) -> Iterator[KeyFigure]:
    first = result.governing
    if first is None or not math.isfinite(result.rated_torque):
        return
    used = result.torque / result.rated_torque if result.rated_torque else math.inf
    tone: Tone = "failed" if used > 1.0 else "warning" if used >= AMBER or not first.sure else "good"
    near = _("near the limit") if used >= AMBER else _("met, unconfirmed rating")
    yield KeyFigure(
        name="rated_torque",
        title=_("torque rating of the whole drive"),
        place=Joined([say(_("governed by {title}"), title=first.title), result.case]),
        value=_torque(result.rated_torque),
        limit=_torque(result.torque),
        better="more",
        verdict={"failed": _("too weak"), "warning": near, "good": _("passed")}[tone],
        tone=tone,
    )


def _facts(result: Strength) -> dict[str, Any]:
    return {
        "torque": _torque(result.torque),
        "load_case": result.case or None,
        "rated_torque": _torque(result.rated_torque),
        "torque_factor": result.torque_factor,
        "enough": result.enough,
        "utilisation": result.utilisation,
        "governing": _named(result.governing),
        "shock_factor": result.shock_factor,
        "dynamic_factor": result.dynamic_factor,
        "torsional_vibration": _vibration_facts(result.vibration),
        "extrapolated_shafts": result.extrapolated,
    }


def _vibration_facts(found: Vibration | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "speed": Quantity(found.speed, "angular_speed"),
        "low": Quantity(found.low, "torque"),
        "high": Quantity(found.high, "torque"),
        "factor": found.factor if math.isfinite(found.factor) else None,
        "stable": found.stable,
    }


def _named(one: Verdict | None) -> dict[str, Any] | None:
    return None if one is None else {"check": one.check, "subject": one.subject, "title": one.title}


def _column_values(drive: Drive) -> tuple[float, float, float]:
    found = strength(drive)
    return (found.utilisation, found.rated_torque, float(sum(not one.sure for one in found.binding)))


COLUMNS = (
    SweepQuestion(
        name="strength",
        doc=mark(
            "greatest use of the strength of a part, the torque at which it is used up, and how many limits rest on "
            "unconfirmed ratings"
        ),
        told=(
            OutputColumn.of("strength_used_percent", mark("greatest use of the strength of a part")),
            OutputColumn.of("rated_torque_Nm", mark("torque that uses the strength up")),
            OutputColumn(name="unconfirmed_limits", text=mark("how many limits rest on unconfirmed ratings")),
        ),
        of_one=_column_values,
        counts=("pose", "movement", "case"),
    ),
)
"""What a sweep may ask of strength."""
