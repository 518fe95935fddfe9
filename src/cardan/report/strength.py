"""How strong the parts of the drive are, and how much torque the whole of it may carry."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.checks.strength.figure import strength_figures
from cardan.checks.strength.strength import Strength, strength
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.wording import fixed, significant
from cardan.questions.forces.figures.arrows import senses
from cardan.questions.forces.forces import forces
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.texts import _, plural
from cardan.units import deg, rpm

from .balance import refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Tone, Words, number, of_shaft, words
from .lacking import of_forces, of_strength, of_torsion
from .subject import Subject

MPA = 1e6

HOUR = 3600.0

LITTLE = 1.02
"""Times the torque counted up to which torsional vibration is not worth a word."""

SLIGHT = 0.005
"""Share by which all forces together must raise the load of a journal to be told."""

AMBER = 0.9
"""Share of the torque rating from which the drive is close to it."""


def bearing_up(on: Subject) -> Page | None:
    """Return the page of the strength; None where the drive carries no torque, or nothing could be judged."""
    title = _("Strength")
    if of_strength(on.drive):
        return None
    try:
        found = strength(on.drive, known=on.known)
    except InputError as error:
        return refused("strength", title, error)
    if not found.binding or not found.torque > 0.0:
        return None
    figures = strength_figures(found)
    blocks: list[Block] = [Picture(figure=figure) for figure in figures]
    blocks += [_shafts(on.drive, found), _joints(on.drive, found)]
    answer = figures[0].sentence
    alarms = [Words(text=answer, tone="failed")] if found.enough is False else []
    swung = _swinging(on, found)
    if swung is not None:
        blocks.insert(0, swung)
        alarms.append(swung)
    blocks.append(Points(title=_("To mind"), items=list(_notes(on, found))))
    return Page(name="strength", title=title, answer=answer, blocks=blocks, keys=list(_keys(found)), alarms=alarms)


def _keys(found: Strength) -> Iterator[list[Cell]]:
    first = found.governing
    if first is None or not math.isfinite(found.rated_torque):
        return
    used = found.torque / found.rated_torque
    tone: Tone = "failed" if used > 1.0 else "warning" if used >= AMBER else "good"
    said = {"failed": _("too weak"), "warning": _("near the limit"), "good": _("passed")}[tone]
    yield [
        words(_("torque rating of the whole drive, ended by {title}").format(title=first.title)),
        number(significant(found.rated_torque), found.rated_torque),
        words(_("N·m")),
        number(f"≥ {significant(found.torque)}", found.torque),
        number(fixed(used), used),
        words(said, tone),
    ]


def _cell(value: float | None, digits: int = 4) -> Cell:
    if value is None or math.isnan(value):
        return words("–")
    if math.isinf(value):
        return words("∞")
    return number(significant(value, digits), value)


def _shafts(drive: Drive, found: Strength) -> Table:
    rows = [
        [
            of_shaft(one.number, shaft.name),
            _cell(one.torque),
            _cell(one.bending),
            _cell(None if one.stress is None else float(one.stress.torsion) / MPA),
            _cell(None if one.stress is None else float(one.stress.bending) / MPA),
            _cell(one.twist / deg, 3),
            _cell(None if one.fatigue is None else float(one.fatigue.safety), 3),
            _cell(one.fatigue_life / HOUR, 3),
        ]
        for one, shaft in zip(found.shafts, drive.shafts, strict=True)
    ]
    return Table(
        title=_("Shafts"),
        columns=(
            Column(heading=_("shaft"), left=True),
            Column(heading=_("torque"), unit="N·m"),
            Column(heading=_("secondary couple, larger end"), unit="N·m"),
            Column(heading=_("torsion"), unit="MPa"),
            Column(heading=_("bending"), unit="MPa"),
            Column(heading=_("twist"), unit="°"),
            Column(heading=_("safety against fatigue")),
            Column(heading=_("lasts"), unit="h"),
        ),
        rows=rows,
        note=_("Torque, couple and stresses are the largest over the turn, with the factor {shock} for shocks.").format(
            shock=fixed(found.shock_factor)
        ),
    )


def _joints(drive: Drive, found: Strength) -> Table:
    rows = [
        [
            words(f"{one.number} {joint.name}".strip()),
            _cell(one.torque),
            _cell(one.journal_force),
            _cell(None if one.journal is None else float(one.journal.mises) / MPA),
            _cell(None if one.yoke is None else float(one.yoke.mises) / MPA),
            _cell(None if one.contact is None else float(one.contact.pressure) / MPA),
            _cell(one.static_capacity),
        ]
        for one, joint in zip(found.joints, drive.joints, strict=True)
    ]
    return Table(
        title=_("Joints"),
        columns=(
            Column(heading=_("joint"), left=True),
            Column(heading=_("torque"), unit="N·m"),
            Column(heading=_("load of a journal"), unit="N"),
            Column(heading=_("its root"), unit="MPa"),
            Column(heading=_("yoke"), unit="MPa"),
            Column(heading=_("pressure on needles"), unit="MPa"),
            Column(heading=_("static capacity"), unit="N"),
        ),
        rows=rows,
    )


def _swinging(on: Subject, found: Strength) -> Words | None:
    """Return what torsional vibration adds at the speed of the duty; None where it adds little or is not known.

    The torque of a steady motion that grows is none that the drive keeps, so none is told of it.
    """
    if of_torsion(on.drive):
        return None
    try:
        runs = on.swings
    except InputError:
        return None
    if runs is None or not bool(runs.steady.found):
        return None
    speed = significant(abs(float(runs.speed)) / rpm, 3)
    if int(runs.floquet.verdict) == Verdict.UNSTABLE:
        text = _(
            "The strength leaves torsional vibration out: at {speed} rpm that grows by itself, so what torque the "
            "shafts reach cannot be told."
        )
        return Words(text=text.format(speed=speed), tone="failed")
    most = np.maximum(np.abs(runs.torque_lowest), np.abs(runs.torque_highest))
    model = runs.train.model
    plain = np.asarray(
        [np.max([case.shaft_torque[model.shaft[a]] for case in found.cases]) for a, _b in model.elements]
    )
    own = [e for e, (_a, b) in enumerate(model.elements) if runs.train.hangs[b] is None and plain[e] > 0.0]
    if not own:
        return None
    e = max(own, key=lambda one: float(most[one] / plain[one]))
    more = float(most[e] / plain[e])
    if more <= LITTLE:
        return None
    text = _(
        "The strength leaves torsional vibration out: at {speed} rpm that takes the torque in {name} to {most} N·m, "
        "{more} times what is counted."
    )
    said = text.format(
        speed=speed,
        name=runs.train.element_names[e],
        most=significant(float(most[e]), 3),
        more=significant(more, 3),
    )
    beyond = found.torque_factor < more
    if beyond:
        said += " " + _("That is more than the torque rating of the drive.")
    if on.drive.duty.run_up is not None:
        said += " " + _("While running up it may be more: see Running up.")
    return Words(text=said, tone="failed" if beyond else "warning")


def _heavier(on: Subject, found: Strength) -> tuple[int, float, float] | None:
    """Return joint, load [N] and excess of the journal whose load all forces together raise most; None if unknown."""
    if of_forces(on.drive) or found.cases[0].name:
        return None
    try:
        every = forces(on.drive)
    except InputError:
        return None
    load = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in senses(every)], axis=0)
    couple = found.cases[0].couple
    span = np.asarray([one.couple / one.journal_force if one.journal_force > 0.0 else math.nan for one in found.joints])
    more = load * span / np.where(couple > 0.0, couple, math.nan) - 1.0
    if not np.any(np.isfinite(more)):
        return None
    i = int(np.nanargmax(more))
    return (i + 1, float(load[i]), float(more[i])) if more[i] > SLIGHT else None


def _notes(on: Subject, found: Strength) -> Iterator[str]:
    yield _(
        "Stresses count what the torque of the duty makes without friction and masses; axial forces of splines, "
        "weights and torsional vibration are not in them."
    )
    if not of_forces(on.drive):
        yield _(
            "The larger of the couples at its two ends bends a shaft; the chapter Forces adds both, as its supports do."
        )
    heavier = _heavier(on, found)
    left = sum(not one.run for one in found.verdicts)
    if left:
        yield plural(
            "One limit could not be judged; the drive may carry less.",
            "{count} limits could not be judged; the drive may carry less.",
            left,
        ).format(count=left)
    if heavier is not None:
        number, load, more = heavier
        text = _(
            "With friction, masses, weights and axial forces a journal of joint {number} carries {load} N, {more} % "
            "more than counted here before the factor for shocks."
        )
        yield text.format(number=number, load=significant(load), more=fixed(100.0 * more, 1))
    elif found.dynamic_factor > 1.02:
        text = _("Masses and friction raise the largest couple of a cross by {more} %, which the stresses leave out.")
        yield text.format(more=fixed(100.0 * (found.dynamic_factor - 1.0), 1))
    for one in found.shafts:
        if one.bending > 0.0 and one.weight_bending > 0.2 * one.bending:
            text = _("The weight of shaft {number} bends it by {moment} N·m, which the stresses leave out.")
            yield text.format(number=one.number, moment=significant(one.weight_bending, 3))
    if found.extrapolated:
        which = ", ".join(map(str, found.extrapolated))
        yield _("Shafts {which} are wider than those behind the fatigue formula.").format(which=which)
