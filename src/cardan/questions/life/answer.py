"""What there is to say of the life of joints and supports: lives side by side, parts of the duty, what to mind."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone, heads
from cardan.answers.quantity import Quantity, Say, Text, Written, listed, numbered, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.catalogue import catalogue, filled
from cardan.catalogue.provenance import rows_behind, unconfirmed
from cardan.catalogue.rows import Bearing
from cardan.drive.conditions import load_cases
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import in_a_joint, spelled
from cardan.drive.fields.wording import written
from cardan.drive.torsional_layout import has_torsion
from cardan.formulas.ball_bearing import POWER
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.stability.in_use import larger_in_use
from cardan.texts import _, mark

from .figure import life_figures, part_names
from .joint_bearings import joint_bearings
from .life import life as ask
from .life_cautions import LEAST
from .lives import METHODS, Life
from .support_loads import SupportLives, rated_supports

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

RATED = ("needles.capacity", "needles.count", "cross.span", "rating.torque")
"""Fields of a joint that its life rests on."""

BORNE = ("capacity", "static_capacity")
"""Fields of a support that the life of its bearing rests on."""

PARTLY = ("duty.cases", "duty.blocks", "duty.torque_history")
"""Duties in parts, that stand for one torque and one speed."""

SHOWN = 12
"""Parts of a duty cycle that people are shown."""

CLOSE = 0.9
"""Share of the life asked for from which it is near the limit."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the life of its joints and supports."""
    duty = drive.duty
    timed = [case for case in load_cases(duty) if case.share > 0.0 and case.path != "duty"]
    parts = bool(timed) or duty.torque_history is not None
    own = joint_bearings(drive)[0]
    rated = bool(np.any(own.rated) or any(own.convention) or rated_supports(drive)[0])
    cross = absent(
        (not np.all(np.isnan(own.span)), *in_a_joint(drive, "cross", ".span")),
        (not np.all(np.isnan(own.capacity)), *in_a_joint(drive, "needles", ".capacity")),
    )
    return (
        *absent(
            (parts or duty.torque is not None, "duty.torque", *PARTLY),
            ((parts and all(case.speed for case in timed)) or duty.speed is not None, "duty.speed", *PARTLY),
            (parts or duty.life is not None, "duty.life", *PARTLY),
        ),
        *(() if rated else cross or (("joints[0].rating.torque",),)),
    )


def answer(drive: Drive, result: Life) -> Answer:
    """Return what there is to say of the life of the joints and supports of a drive."""
    tone: Tone = "plain" if result.enough is None else "good" if result.enough else "failed"
    loose = _unconfirmed(drive)
    if loose and tone == "good":
        tone = "warning"
    return Answer(
        name="life",
        title=_("Life"),
        sentence=_sentence(drive, result),
        tone=tone,
        figures=lambda: life_figures(result),
        tables=(_joints(drive, result), *_supports(drive, result), *_duty_cycle(result)),
        remarks=(*_remarks(drive, result, loose), *(yokes_estimated(drive) if has_torsion(drive) else ())),
        keys=tuple(_keys(result, loose)),
        facts={**_facts(result), "provenance": loose},
        full=lambda: _everything(result),
        code=1 if result.enough is False else 0,
    )


def _unconfirmed(drive: Drive) -> tuple[str, ...]:
    """Return in words the sizes that the lives rest on and that nothing confirms."""
    whole = filled(drive)
    paths = [f"joints[{i}].{name}" for i in range(len(whole.joints)) for name in RATED]
    paths += [f"supports[{k}].{name}" for k in range(len(whole.supports)) for name in BORNE]
    return unconfirmed(rows_behind(whole, catalogue(), *paths))


def _hours(seconds: float) -> Quantity:
    return Quantity(seconds, "duration")


def _sentence(drive: Drive, result: Life) -> Say:
    if math.isinf(result.drive):
        return say(_("nothing wears; no joint both oscillates and carries torque."))
    number = result.governing_support
    if number:
        held = {"support": numbered(number, drive.supports[number - 1].name), "life": _hours(result.drive)}
        if result.demanded is None:
            return say(_("support {support} fails first, after {life}."), **held)
        text = _("too short; support {support} fails after {life}, and {asked} are asked for.")
        if result.enough:
            text = _("lasts; support {support} fails first, after {life}, and {asked} are asked for.")
        return say(text, asked=_hours(result.demanded), **held)
    joint = numbered(result.governing, drive.joints[result.governing - 1].name)
    values = {"joint": joint, "life": _hours(result.drive)}
    if result.demanded is None:
        return say(_("joint {joint} fails first, after {life}."), **values)
    text = _("too short; joint {joint} fails after {life}, and {asked} are asked for.")
    if result.enough:
        text = _("lasts; joint {joint} fails first, after {life}, and {asked} are asked for.")
    return say(text, asked=_hours(result.demanded), **values)


def _worst_part(result: Life) -> Iterator[Column]:
    """Yield in which load case the journals of each joint carry most, where the duty has several."""
    names = [part.name for part in result.parts]
    if len(names) > 1 and all(names):
        worst = [names[int(foremost(column))] for column in result.journal_force.T]
        yield Column(key="journal_case", heading=_("load case"), values=worst, left=True)


def _joints(drive: Drive, result: Life) -> Table:
    own = result.bearings
    titles = {"iso": _("ISO 281"), "simple": _("mean load"), "maker": _("maker"), "book": _("handbook")}
    rated = bool(np.any(np.isfinite(own.capacity)))
    sides = {"iso_driving": result.combined(result.driving), "iso_driven": result.combined(result.driven)}
    return Table(
        name="joints",
        records=True,
        columns=(
            *heads(_("joint"), [joint.name for joint in drive.joints]),
            Column(
                key="joint_angle",
                heading=_("joint angle"),
                values=result.share @ result.joint_angle,
                dimension="angle",
                decimals=2,
            ),
            Column(
                key="equivalent_torque",
                heading=_("equivalent torque"),
                values=result.equivalent_torque,
                dimension="torque",
            ),
            Column(
                key="journal_force",
                heading=_("largest journal force"),
                values=np.max(result.journal_force, axis=0),
                dimension="force",
            ),
            *_worst_part(result),
            Column(
                key="capacity",
                heading=_("dynamic capacity"),
                values=own.capacity,
                dimension="force",
                depth="full" if rated else "data",
            ),
            Column(key="needed_capacity", values=result.needed_capacity, dimension="force", depth="data"),
            Column(key="convention", values=list(own.convention), depth="data"),
            Column(key="speed_angle", heading="n·α", values=result.speed_angle, dimension="speed_angle"),
            *(Column(key=key, values=values, dimension="duration", depth="data") for key, values in sides.items()),
            *(
                Column(key=method, heading=titles[method], values=result.of(method), dimension="duration")
                for method in METHODS
            ),
        ),
        note=say(
            _(
                "{share} of the joints reach these lives (a1 = {factor}); the service factor is {shock}. The joint "
                "angle is the mean over the time."
            ),
            share=Quantity(result.reliability, "share", 6, trim=True),
            factor=Quantity(result.reliability_factor, digits=3, trim=True),
            shock=Quantity(result.shock_factor, digits=3, trim=True),
        ),
    )


def _supports(drive: Drive, result: Life) -> Iterator[Table]:
    """Yield the table of the bearings of the supports, where any is rated."""
    if result.supports is None:
        return
    own, loads = result.supports, result.supports.loads
    supports = [drive.supports[number - 1] for number in own.number]
    names = [f"{number} {one.name}".strip() for number, one in zip(own.number, supports, strict=True)]
    most = {name: np.max(getattr(loads, name), axis=0) for name in ("radial", "axial", "static")}
    axial = [float(force) if one.axial else None for force, one in zip(most["axial"], supports, strict=True)]
    yield Table(
        name="supports",
        title=_("Bearings of the supports"),
        records=True,
        columns=(
            Column(key="", heading=_("support"), values=names),
            Column(key="number", values=list(own.number), depth="data"),
            Column(key="name", values=[one.name for one in supports], depth="data"),
            Column(key="bearing", heading=_("bearing"), values=[one.bearing for one in supports]),
            Column(key="radial_force", heading=_("radial, largest"), values=most["radial"], dimension="force"),
            Column(key="axial_force", heading=_("axial, largest"), values=axial, dimension="force"),
            Column(
                key="equivalent_load", heading=_("equivalent load"), values=_equivalent(result, own), dimension="force"
            ),
            Column(key="capacity", heading=_("dynamic capacity"), values=own.capacity, dimension="force"),
            Column(key="static_safety", heading=_("static safety"), values=_safety(own, most["static"]), decimals=1),
            Column(key="life", heading=_("life"), values=result.of_supports, dimension="duration"),
        ),
        note=_(
            "Equivalent load: the constant radial one that damages as much, ISO 281; static safety: C0/P0 at the "
            "largest load, ISO 76."
        ),
    )


def _equivalent(result: Life, own: SupportLives) -> Array:
    """Return the constant load of each bearing that damages as much as the whole duty, array (m,) [N]."""
    speed = np.asarray([abs(part.speed or 0.0) for part in result.parts])
    rate = (result.share * speed)[:, None]
    found: Array = (np.sum(rate * own.loads.load**POWER, axis=0) / np.sum(rate)) ** (1.0 / POWER)
    return found


def _safety(own: SupportLives, load: Array) -> list[float | None]:
    """Return the static capacity of each bearing over its largest load at rest; None where one of them is none."""
    pairs = zip(own.static_capacity.tolist(), load.tolist(), strict=True)
    return [capacity / most if most > 0.0 and not math.isnan(capacity) else None for capacity, most in pairs]


def _duty_cycle(result: Life) -> Iterator[Table]:
    """Yield the table of the parts of a duty cycle, where there are several and not too many."""
    if not 1 < len(result.parts) <= SHOWN:
        return
    parts = result.parts
    yield Table(
        title=_("Parts of the duty cycle, and their share of the damage"),
        columns=(
            *((Column(key="condition", heading=_("condition"), values=part_names(result)),) if result.named else ()),
            Column(key="torque", heading=_("torque"), values=[part.torque for part in parts], dimension="torque"),
            Column(key="speed", heading=_("speed"), values=[part.speed for part in parts], dimension="angular_speed"),
            Column(key="share", heading=_("time"), values=result.share, dimension="share", decimals=1),
            *(
                Column(
                    key=f"joint_{i}_damage",
                    heading=_("joint {number}").format(number=i),
                    values=damage,
                    dimension="share",
                    decimals=1,
                )
                for i, damage in enumerate(result.damage.T, 1)
            ),
            *(
                Column(
                    key=f"support_{number}_damage",
                    heading=_("support {number}").format(number=number),
                    values=damage,
                    dimension="share",
                    decimals=1,
                )
                for number, damage in zip(_numbers(result), result.support_damage.T, strict=True)
            ),
        ),
    )


def _numbers(result: Life) -> tuple[int, ...]:
    """Return the numbers of the supports whose bearings are rated."""
    return () if result.supports is None else result.supports.number


def _everything(result: Life) -> Table:
    """Return every part, with every joint and the bearing of every support that has one."""
    held = _numbers(result)
    parts, joints = result.joint_angle.shape
    count = joints + len(held)
    every: dict[str, tuple[Any, str]] = {
        "share": (np.repeat(result.share, count), "share"),
        "torque": (np.repeat([part.torque for part in result.parts], count), "torque"),
        "speed": (np.repeat([part.speed for part in result.parts], count), "angular_speed"),
        **{
            name: (np.pad(values, ((0, 0), (0, len(held))), constant_values=np.nan), unit)
            for name, (values, unit) in {
                "joint_torque": (result.torque, "torque"),
                "joint_angle": (result.joint_angle, "angle"),
                "journal_force": (result.journal_force, "force"),
                "iso_driving": (result.driving, "duration"),
                "iso_driven": (result.driven, "duration"),
                "simple": (result.simple, "duration"),
                "maker": (result.maker, "duration"),
                "book": (result.book, "duration"),
            }.items()
        },
        "damage": (np.append(result.damage, result.support_damage, axis=1), "share"),
    }
    if result.supports is not None:
        loads = result.supports.loads
        every |= {
            name: (np.pad(values, ((0, 0), (joints, 0)), constant_values=np.nan), unit)
            for name, (values, unit) in {
                "radial_force": (loads.radial, "force"),
                "axial_force": (loads.axial, "force"),
                "equivalent_load": (loads.load, "force"),
                "support_life": (loads.life, "duration"),
            }.items()
        }
    numbers = [*range(1, joints + 1), *(None for _one in held)]
    return Table(
        name="parts",
        columns=(
            Column(key="part", values=np.repeat(np.arange(1, parts + 1), count)),
            Column(key="condition", values=np.repeat(part_names(result), count).tolist()),
            Column(key="joint", values=numbers * parts),
            *((Column(key="support", values=[*(None for _one in range(joints)), *held] * parts),) if held else ()),
            *(Column(key=key, values=np.ravel(values), dimension=unit) for key, (values, unit) in every.items()),
        ),
    )


def _remarks(drive: Drive, result: Life, loose: tuple[str, ...]) -> Iterator[Remark]:
    if result.enough is False:
        need, now = _needed(result)
        text = _("Failed: it would last with {share} of its loads.")
        if math.isfinite(need):
            text = _("Failed: it would last with {share} of its loads, or with a capacity of {need} instead of {now}.")
        values = {"need": Quantity(need, "force"), "now": Quantity(now, "force")}
        share = Quantity(result.torque_margin, "share")
        yield Remark(text=say(text, share=share, **values), tone="failed", alarm=True)
        yield from _larger(drive, result, need)
    if loose:
        text = _("The lives rest on ratings that nothing confirms: {rows}.")
        yield Remark(text=say(text, rows=", ".join(loose)), tone="warning")
    if result.history is not None and result.cycles is not None:
        levels = result.history
        text = _(
            "The measured torque runs from {low:bare} to {high}, {mean} on average; for the bearings it is equivalent "
            "to a constant {same}, and by rainflow it has {count} cycles, the largest of {most}."
        )
        torques = {"low": levels.low, "high": levels.high, "mean": levels.mean, "same": levels.equivalent}
        torques["most"] = float(max(result.cycles.range, default=0.0))
        told = {name: Quantity(value, "torque") for name, value in torques.items()}
        yield Remark(text=say(text, count=Quantity(result.cycles.total, trim=True), **told))
    yield from _conditions(result)
    yield _vibration(drive, result)
    yield from (replace(one, aside=True) for one in larger_in_use(drive))  # torsional vibration tells it too
    if result.supports is not None:
        text = _(
            "Forces on the supports count weights where masses are given; torsional vibration, unbalance and "
            "misalignment are not in them."
        )
        yield Remark(text=text, code="support_forces")
    yield from _cautions(result)
    for one in result.uncounted:
        if not one.key:
            yield Remark(text=say(_("Not counted: {message}."), message=one.message))
    if any(one.key for one in result.uncounted):
        keys = written(*(one.field for one in result.uncounted if one.key))
        text = _("Warning: some joints are not rated; the file lacks {keys}.")
        yield Remark(text=say(text, keys=keys), tone="warning")
    if len(result.parts) > 1:
        text = _("Every part on its own, joint by joint:")
        yield Remark(text=text, command=("cardan", "life", FILE, "--csv"), tone="next")


def _larger(drive: Drive, result: Life, need: float) -> Iterator[Remark]:
    """Yield which bearings of the same bore have a capacity, where a support fails first."""
    bore = drive.supports[result.governing_support - 1].bore if result.governing_support else None
    rows = [row for row in catalogue().rows(Bearing).values() if bore and math.isclose(row.bore, bore)]
    fit = sorted((row for row in rows if row.capacity >= need), key=lambda row: row.capacity)
    if fit:
        text = _("Of the bearings with a bore of {bore} these have that capacity: {rows}.")
        yield Remark(text=say(text, bore=Quantity(bore, "length", trim=True), rows=", ".join(row.id for row in fit)))


def _needed(result: Life) -> tuple[float, float]:
    """Return the dynamic capacity that what fails first needs for the life asked for, and the one it has [N]."""
    number, own = result.governing_support, result.supports
    if own is None or not number:
        i = result.governing - 1
        return float(result.needed_capacity[i]), float(result.bearings.capacity[i])
    now = float(own.capacity[own.number.index(number)])
    return now * float((result.demanded or 0.0) / result.drive) ** (1.0 / POWER), now


def _conditions(result: Life) -> Iterator[Remark]:
    """Yield how the life was gathered over poses and movements."""
    if result.worst_pose:
        text = _("Warning: no {key} tells how long each pose lasts; this is the life in the worst of them, {pose}.")
        yield Remark(
            text=say(text, pose=result.worst_pose, key=Written("share_percent", _("share of the time"))),
            tone="warning",
            code="no_share",
            alarm=True,
        )
    named = [bool(part.name) for part in result.parts]
    if len(named) > 1 and sum(named) >= len(named) - 1:
        damage, number = result.first_damage, result.governing_support
        k = int(foremost(damage))
        text = _(
            "Most damage to joint {joint} arises in this condition: {condition}; {damage} of it in {share} of the time."
        )
        if number:
            text = _(
                "Most damage to support {joint} arises in this condition: {condition}; {damage} of it in {share} of "
                "the time."
            )
        values = {
            "damage": Quantity(float(damage[k]), "share", 3),
            "share": Quantity(float(result.share[k]), "share", 3),
        }
        said = say(text, joint=number or result.governing, condition=part_names(result)[k], **values)
        yield Remark(text=said, code="governing_condition")
    if result.moving:
        yield Remark(text=_("Damage is summed over the movement; joint angles and torques are its means."))


def _vibration(drive: Drive, result: Life) -> Remark:
    """Return whether torsional vibration is counted."""
    most = max((one for one in result.vibration if not math.isnan(one)), default=math.nan)
    if not math.isnan(most):
        text = _("Torsional vibration is counted: the alternating torque reaches ±{share} of the mean.")
        return Remark(text=say(text, share=Quantity(most, "share", 3)))
    text = _("Torsional vibration is not counted: the file says nothing of masses and stiffness (stations).")
    if result.history is not None:
        text = _("Torsional vibration counts as far as the measured torque holds it.")
    elif has_torsion(drive):
        text = _("Warning: torsional vibration is not counted: no steady motion could be told.")
    return Remark(text=text, tone="warning" if has_torsion(drive) and result.history is None else "plain")


def _cautions(result: Life) -> Iterator[Remark]:
    """Yield cautions, those that several joints share together."""
    alike = {
        "small_oscillation": _(
            "joints {which} oscillate so little that roller paths do not overlap: false brinelling, and the computed "
            "life is optimistic"
        ),
        "angle_clamped_3deg": _(
            "joints {which} have joint angles below {least}, as which handbook and makers count them"
        ),
        "extrapolated": _("joints {which} are outside the handbook's tables, 10 to 35 000 rpm·° and 100 to 100 000 h"),
        "no_swing": _("joints {which} are straight: needles do not roll, and ISO 281 rates no life for that"),
        "heavy_load": _("journals of joints {which} carry over half their capacity; ISO 281 ends there"),
    }
    for code in dict.fromkeys(one.code for one in result.cautions):
        own = [one for one in result.cautions if one.code == code]
        joints = [one.joint for one in own if one.joint]
        several = len(joints) > 1
        said: list[Text] = [say(alike[code], which=listed(joints), least=LEAST)] if several else []
        said.extend(one.message for one in own if not (several and one.joint))
        for message in said:
            yield Remark(text=say(_("Warning: {what}."), what=message), tone="warning", code=code)


def _keys(result: Life, loose: tuple[str, ...]) -> Iterator[KeyFigure]:
    if not math.isfinite(result.drive):
        return
    title, place = _("life of the joint that fails first"), say(_("joint {number}"), number=result.governing)
    if result.governing_support:
        title, place = (
            _("life of the support that fails first"),
            say(_("support {number}"), number=result.governing_support),
        )
    if result.demanded is None:
        yield KeyFigure(name="life", title=title, place=place, value=_hours(result.drive), better="more")
        return
    used = result.demanded / result.drive
    tone: Tone = "failed" if used > 1.0 else "warning" if used >= CLOSE or loose else "good"
    near = _("near the limit") if used >= CLOSE else _("met, unconfirmed rating")
    yield KeyFigure(
        name="life",
        title=title,
        place=place,
        value=_hours(result.drive),
        limit=_hours(result.demanded),
        better="more",
        tone=tone,
        verdict={"failed": _("too short"), "warning": near, "good": _("passed")}[tone],
        check="support_life" if result.governing_support else "bearing_life",
    )


def _facts(result: Life) -> dict[str, Any]:
    facts: dict[str, Any] = {
        "method": result.method,
        "life": _hours(result.drive),
        "governing_joint": None if result.governing_support else result.governing,
        "governing_support": result.governing_support or None,
        "demanded": None if result.demanded is None else _hours(result.demanded),
        "enough": result.enough,
        "torque_margin": result.torque_margin,
        "reliability": Quantity(result.reliability, "share"),
        "reliability_factor": result.reliability_factor,
        "shock_factor": result.shock_factor,
        "warnings": [{"code": one.code, "joint": one.joint, "message": one.message} for one in result.cautions],
        "not_rated": [{"field": spelled(one.field), "message": one.message} for one in result.uncounted],
        "vibration": result.vibration,
        "assumed": result.assumed,
    }
    levels, cycles = result.history, result.cycles
    if levels is not None and cycles is not None:
        facts["history"] = {
            "duration": Quantity(levels.duration, "time"),
            "mean": Quantity(levels.mean, "torque"),
            "low": Quantity(levels.low, "torque"),
            "high": Quantity(levels.high, "torque"),
            "equivalent": Quantity(levels.equivalent, "torque"),
            "edges": Quantity(levels.edge, "torque"),
            "share": Quantity(levels.share, "share"),
            "cycles": {
                "range": Quantity(cycles.range, "torque"),
                "mean": Quantity(cycles.mean, "torque"),
                "count": cycles.count,
            },
        }
    return facts


COLUMNS = (
    SweepQuestion(
        name="life",
        doc=mark("life of the bearings of joints and supports, the shortest of them"),
        told=(OutputColumn.of("life_h", mark("life of the drive")),),
        of_one=lambda drive: (ask(drive).drive,),
        counts=("pose", "movement", "case"),
    ),
)
"""What a sweep may ask of life."""
