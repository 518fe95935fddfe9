"""What the drive carries: torques, secondary couples, journals and supports."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.palette import colour, shaft
from cardan.figures.wording import significant
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.maths.ties import foremost, foremost_on
from cardan.questions.forces.figures.arrows import loads_figures, senses, worst
from cardan.questions.forces.figures.forces import reactions_figure, torques_figure
from cardan.questions.forces.figures.moving_forces import moving_forces_figures
from cardan.questions.forces.forces import Forces, forces
from cardan.questions.forces.moving_forces import moving_forces
from cardan.questions.forces.reactions import Held
from cardan.texts import _, plural
from cardan.units import deg

from .balance import ROUNDING, checks, refused
from .block import Block, Cell, Column, Page, Picture, Table, Words, key, number, of_shaft
from .lacking import of_forces
from .subject import Subject

NOTHING = 1e-9
"""Share of the largest force below which a force is rounding."""


def carrying(on: Subject) -> Page | None:
    """Return the page of the forces; None where the drive carries no torque or nothing holds its shafts."""
    if of_forces(on.drive):
        return None
    remark: list[Block] = []
    try:
        found = forces(on.drive)
    except InputError as error:
        try:
            found = forces(replace(on.drive, supports=()))
        except InputError:
            return refused("forces", _("Forces"), error)
        remark = [Words(text=f"{one.field}: {one.message}", tone="warning") for one in error.problems]
    turned = torques_figure(found)
    if found.reaction is None:
        blocks: list[Block] = [*remark, Picture(figure=turned), _shafts(on.drive, found), _checks(found)]
        alarms = [one for one in remark if isinstance(one, Words)][:1]
        keys = list(_keys(on.drive, found))
        return Page(name="forces", title=_("Forces"), answer=turned.sentence, blocks=blocks, keys=keys, alarms=alarms)
    held = reactions_figure(found, [one.name for one in on.drive.supports])
    if int(np.max(np.asarray(found.status))) == int(Held.INDETERMINATE):
        text = _(
            "The supports hold the drive more often than needed, so that statics alone cannot tell what they take: "
            "they share the forces by their stiffness."
        )
        remark = [Words(text=text, tone="warning")]
    moved = _moving(on.drive)
    blocks = [
        *remark,
        Picture(figure=turned),
        _shafts(on.drive, found),
        *(Picture(figure=drawn) for drawn in loads_figures(found, on.drive)),
        Picture(figure=held),
        _supports(on.drive, found),
        *moved[0],
        _checks(found),
    ]
    return Page(
        name="forces",
        title=_("Forces"),
        answer=_answer(on.drive, found),
        blocks=blocks,
        keys=[*_keys(on.drive, found), *moved[1]],
    )


def _moving(drive: Drive) -> tuple[list[Block], list[list[Cell]]]:
    """Return what the supports take while the drive moves, and its row of the first page; nothing where it stands."""
    if not drive.movements or not drive.duty.speed:
        return [], []
    try:
        found = moving_forces(drive)
    except InputError as error:
        text = _("Forces while the drive moves are not calculated: {first}")
        problem = error.problems[0]
        return [Words(text=text.format(first=f"{problem.field}: {problem.message}"), tone="warning")], []
    most = found.extreme(found.reaction_size)
    k = int(foremost(most.high))
    figures = moving_forces_figures(found, [one.name for one in drive.supports])
    name = _("the same while moving, {name}").format(name=_called(drive, k))
    return [Picture(figure=figure) for figure in figures], [key(name, float(most.high[k]), "N")]


def _keys(drive: Drive, found: Forces) -> Iterator[list[Cell]]:
    """Yield the largest couple, journal load and reaction, for the first page."""
    couple = np.max(np.asarray(found.bending_couple), axis=-1)
    bent = int(foremost(couple))
    if couple[bent] > NOTHING * float(np.max(np.abs(np.asarray(found.shaft_torque)), initial=0.0)):
        yield key(_("largest secondary couple, shaft {k}").format(k=bent + 1), float(couple[bent]), "N·m")
    journal = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in senses(found)], axis=0)
    if np.any(np.isfinite(journal)):
        most = int(foremost(journal))
        yield key(_("largest load of a journal, joint {k}").format(k=most + 1), float(journal[most]), "N")
    if found.reaction is not None:
        top = worst(found)
        name = _("largest force on a support, {name}").format(name=_called(drive, top.support))
        yield key(name, top.size, "N")


def _answer(drive: Drive, found: Forces) -> str:
    top = worst(found)
    entering = np.asarray(found.input_torque)
    return _("To carry its torque the drive takes {low} to {high} N·m; support {name} takes most, {most} N.").format(
        low=significant(float(np.min(entering))),
        high=significant(float(np.max(entering))),
        name=_called(drive, top.support),
        most=significant(top.size),
    )


def _called(drive: Drive, support: int) -> str:
    name = drive.supports[support].name
    return f"{support + 1} ({name})" if name else str(support + 1)


def _peak(row: Array) -> tuple[float, int]:
    at = int(foremost_on(row))
    return float(row[at]), at


def _shafts(drive: Drive, found: Forces) -> Table:
    torque, couple = np.asarray(found.shaft_torque), np.asarray(found.bending_couple)
    journal = np.max([np.max(np.asarray(one.journals.size), axis=(-1, -2)) for one in senses(found)], axis=0)
    known = np.isfinite(journal)
    rows = []
    for k, one in enumerate(drive.shafts):
        row = [
            of_shaft(k + 1, one.name),
            _amount(float(np.min(torque[k]))),
            _amount(float(np.max(torque[k]))),
            _amount(float(np.max(couple[k])), float(np.max(np.abs(torque)))),
        ]
        if np.any(known):
            last = k + 1 == len(drive.shafts)
            row.append(Cell(text="–") if last or not known[k] else _amount(float(journal[k])))
        rows.append(row)
    note = " ".join(
        [
            _("Least and greatest over a turn in steps of a degree."),
            _("The secondary couple is that of both ends of a shaft together, which its supports balance."),
            *_assumed(found.assumed),
        ]
    )
    journals = (Column(heading=_("greatest load of a journal of the joint behind"), unit="N"),) if np.any(known) else ()
    return Table(
        title=_("Shafts and joints"),
        columns=(
            Column(heading=_("shaft"), left=True),
            Column(heading=_("least torque"), unit="N·m"),
            Column(heading=_("greatest torque"), unit="N·m"),
            Column(heading=_("greatest secondary couple"), unit="N·m"),
            *journals,
        ),
        rows=rows,
        note=note,
    )


def _assumed(paths: Sequence[str]) -> Iterator[str]:
    """Yield in words what the drive does not say and the forces assume."""
    light = [path.split("[")[1].split("]")[0] for path in paths if path.endswith(".inertia")]
    numbers = ", ".join(str(int(one) + 1) for one in light)
    if "duty.speed" in paths:
        yield _("Without a speed inertia does not count.")
    elif light:
        text = plural(
            "Shaft {numbers} counts as without inertia, as none is given.",
            "Shafts {numbers} count as without inertia, as none is given.",
            len(light),
        )
        yield text.format(numbers=numbers)
    others = [path for path in paths if path != "duty.speed" and not path.endswith(".inertia")]
    if others:
        yield _("Not given, so assumed: {paths}.").format(paths=", ".join(others))


def _supports(drive: Drive, found: Forces) -> Table:
    angle = np.asarray(found.angle) / deg
    ways = senses(found)
    # One sense of sliding behind the other along the angle: the table takes the worse.
    radial, axial, whole, turn = (
        np.concatenate([part(one) for one in ways], axis=-1)
        for part in (
            lambda one: np.asarray(one.radial),
            lambda one: np.asarray(one.axial),
            lambda one: frames.norm(np.asarray(one.reaction)),
            lambda one: frames.norm(np.asarray(one.support_couple)),
        )
    )
    top = max(float(np.max(radial)), float(np.max(np.abs(axial))))
    tilts = any(support.tilt for support in drive.supports)
    pushed = bool(np.any(np.abs(axial) > NOTHING * top))
    rows: list[Sequence[Cell]] = []
    for k, support in enumerate(drive.supports):
        most, at = _peak(radial[k])
        row = [
            Cell(text=" ".join((str(k + 1), support.name)).strip(), chip=colour(shaft(support.shaft))),
            _amount(most, top),
            number(f"{angle[at % len(angle)]:.0f}", float(angle[at % len(angle)])),
            _amount(float(np.mean(radial[k])), top),
            _amount(float(np.min(axial[k])), top) if support.axial else Cell(text="–"),
            _amount(float(np.max(axial[k])), top) if support.axial else Cell(text="–"),
        ]
        if pushed:
            row.append(_amount(float(np.max(whole[k])), top))
        if tilts:
            row.append(_amount(float(np.max(turn[k])), top) if support.tilt else Cell(text="–"))
        rows.append(row)
    return Table(
        title=_("Supports"),
        columns=(
            Column(heading=_("support, colour of its shaft"), left=True),
            Column(heading=_("greatest radial force"), unit="N"),
            Column(heading=_("at"), unit="°"),
            Column(heading=_("mean radial force"), unit="N"),
            Column(heading=_("axial force from"), unit="N"),
            Column(heading=_("to"), unit="N"),
            *((Column(heading=_("greatest force in all"), unit="N"),) if pushed else ()),
            *((Column(heading=_("greatest couple"), unit="N·m"),) if tilts else ()),
        ),
        rows=rows,
        note=_("The worse of both ways that the splines slide.") if len(ways) > 1 else "",
    )


def _checks(found: Forces) -> Table:
    rows = [
        (
            _("power"),
            _("what enters less what leaves, what friction takes and what inertia stores, over the largest of them"),
            float(np.max(np.asarray(found.power_left))),
            ROUNDING,
        )
    ]
    if found.force_left is not None and found.moment_left is not None:
        text = _("all that acts on the whole drive from outside, over the largest of it")
        rows.append((_("forces"), text, float(np.max(np.asarray(found.force_left))), ROUNDING))
        rows.append((_("moments"), text, float(np.max(np.asarray(found.moment_left))), ROUNDING))
    return checks(rows)


def _amount(value: float, top: float = 0.0) -> Cell:
    return number("0" if abs(value) <= NOTHING * top else significant(value), value)
